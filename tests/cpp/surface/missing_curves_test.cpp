// Curves of the domain that are found from those of space, against those that were left away.
#include "surface/missing_curves.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <doctest/doctest.h>

#include "support/surface_models.h"
#include "surface/inversion.h"

using namespace sf;

namespace {

struct Read {
  Work work;
  Charge charge{work};
  Model model;
  std::vector<ModelFault> faults;
  explicit Read(const ModelBuilder& builder) {
    const std::vector<uint32_t> shape = builder.shape();
    const std::vector<double> numbers = builder.numbers();
    REQUIRE(readModel({shape, numbers}, work, charge, model, faults));
  }
  /// The most that the curve of a use is off in space.
  double off(uint32_t number) const {
    const ModelUse& use = model.uses[number];
    const ModelEdge& edge = model.edges[use.edge];
    double most = 0;
    for (int i = 0; i <= 1000; ++i) {
      const double t = edge.from + (edge.to - edge.from) * i / 1000;
      const Point2 p = use.curve.at(t);
      most = std::max(
          most, distance(edge.curve->placeAt(t), model.faces[use.face].surface->at(p.x, p.y).at));
    }
    return most;
  }
  Point2 begin(uint32_t number) const { return end(number, model.uses[number].isReversed); }
  Point2 end(uint32_t number) const { return end(number, !model.uses[number].isReversed); }

 private:
  Point2 end(uint32_t number, bool isAtEnd) const {
    const ModelUse& use = model.uses[number];
    return use.curve.at(isAtEnd ? model.edges[use.edge].to : model.edges[use.edge].from);
  }
};

void checkNear(Point2 a, Point2 b, double within = 1e-6) {
  CHECK(std::fabs(a.x - b.x) <= within);
  CHECK(std::fabs(a.y - b.y) <= within);
}

/// A solid cylinder whose side has no curves in its domain; the way around may begin anywhere, and the side may be reversed.
ModelBuilder bareCylinder(double radius, double height, uint32_t first, bool isReversed) {
  ModelBuilder m;
  const TestSpline flat = circle({0, 0}, radius);
  const TestSpline low = lifted(flat, 0), high = lifted(flat, height);
  const TestSpline seam{1, {0, 0, 1, 1}, {radius, 0, 0, radius, 0, height}, {}, 0, {}};
  const uint32_t e0 = m.addEdge(0, 4, &low), e1 = m.addEdge(0, 4, &high),
                 e2 = m.addEdge(0, 1, &seam);
  std::vector<ModelBuilder::Use> loop = {
      {e0, false, {}}, {e2, false, {}, true}, {e1, true, {}}, {e2, true, {}, true}};
  std::rotate(loop.begin(), loop.begin() + first, loop.end());
  m.addFace(cylinderSide(radius, height), {loop}, isReversed);
  return m;
}

/// The meridian of `sphere()` at its seam, from pole to pole.
TestSpline meridian(double radius) {
  const double h = std::sqrt(0.5);
  TestSpline c{2, {0, 0, 0, 1, 1, 2, 2, 2}, {}, {1, h, 1, h, 1}, 0, {}};
  const double profile[5][2] = {{0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}};
  for (const auto& p : profile) c.poles.insert(c.poles.end(), {radius * p[0], 0, radius * p[1]});
  return c;
}

/// The surface of `sphere()`.
TestSpline sphereSurface(double radius) {
  const TestSpline around = circle({0, 0}, 1), profile = meridian(radius);
  TestSpline s{2, around.knots, {}, {}, 2, profile.knots};
  for (int k = 0; k < 9; ++k)
    for (int i = 0; i < 5; ++i) {
      const double r = profile.poles[3 * i];
      s.poles.insert(s.poles.end(), {r * around.poles[2 * k], r * around.poles[2 * k + 1],
                                     profile.poles[3 * i + 2]});
      s.weights.push_back(around.weights[k] * profile.weights[i]);
    }
  return s;
}

}  // namespace

TEST_CASE("findMissingCurves: a seam lies on both sides of a cylinder, wherever the loop begins") {
  for (const bool isReversed : {false, true})
    for (uint32_t first = 0; first < 4; ++first) {
      const Read read(bareCylinder(1.5, 3, first, isReversed));
      REQUIRE(read.faults.empty());
      const Point2 corners[4] = {{0, 0}, {4, 0}, {4, 3}, {0, 3}};
      for (uint32_t k = 0; k < 4; ++k) {
        checkNear(read.begin(k), corners[(first + k) % 4]);
        checkNear(read.end(k), corners[(first + k + 1) % 4]);
        CHECK(read.off(k) < 1e-6);
      }
    }
}

TEST_CASE("findMissingCurves: a sphere's poles join the two sides of its seam") {
  for (uint32_t first = 0; first < 4; ++first) {
    ModelBuilder m;
    const TestSpline side = meridian(2);
    const uint32_t seam = m.addEdge(0, 2, &side), south = m.addEdge(0, 1, nullptr, 1e-9, true),
                   north = m.addEdge(0, 1, nullptr, 1e-9, true);
    std::vector<ModelBuilder::Use> loop = {
        {south, false, {}}, {seam, false, {}, true}, {north, true, {}}, {seam, true, {}, true}};
    std::rotate(loop.begin(), loop.begin() + first, loop.end());
    m.addFace(sphereSurface(2), {loop});
    const Read read(m);
    REQUIRE(read.faults.empty());
    const Point2 corners[4] = {{0, 0}, {4, 0}, {4, 2}, {0, 2}};
    for (uint32_t k = 0; k < 4; ++k) {
      checkNear(read.begin(k), corners[(first + k) % 4]);
      checkNear(read.end(k), corners[(first + k + 1) % 4]);
    }
  }
}

TEST_CASE("findMissingCurves: circles on a sphere close to a pole are followed around it") {
  // A plane that leans a little cuts off the cap; its circle begins on the seam.
  for (const double lean : {0.0, 0.3, 0.45}) {
    // Around the axis (sin lean, 0, cos lean), at an angle of half a radian.
    const double angle = 0.5, a = std::sin(lean), c = std::cos(lean);
    TestSpline cut = circle({0, 0}, std::sin(angle));
    TestSpline space = cut;
    space.poles.clear();
    for (size_t i = 0; i < cut.poles.size(); i += 2) {
      const double x = cut.poles[i], y = cut.poles[i + 1], z = std::cos(angle);
      space.poles.insert(space.poles.end(), {c * x + a * z, y, -a * x + c * z});
    }
    ModelBuilder m;
    const TestSpline side = meridian(1);
    // The meridian up to where the circle begins.
    const double latitude = kPi / 2 - angle - lean;
    const uint32_t around = m.addEdge(0, 4, &space);
    const uint32_t south = m.addEdge(0, 1, nullptr, 1e-9, true);
    double low = 1, high = 2;
    const NurbsCurve whole({{side.degree, side.knots}, 3, side.poles, side.weights});
    for (int k = 0; k < 80; ++k) {
      const double middle = 0.5 * (low + high);
      const Vec3 p = whole.placeAt(middle);
      (std::atan2(p.z, p.x) < latitude ? low : high) = middle;
    }
    const uint32_t seam = m.addEdge(0, low, &side);
    m.addFace(sphereSurface(1), {{{south, false, {}},
                                  {seam, false, {}, true},
                                  {around, true, {}},
                                  {seam, true, {}, true}}});
    const Read read(m);
    REQUIRE(read.faults.empty());
    checkNear(read.begin(0), {0, 0});
    checkNear(read.end(0), {4, 0});
    checkNear(read.end(1), {4, low}, 1e-5);
    checkNear(read.end(2), {0, low}, 1e-5);
    CHECK(read.off(2) < 1e-6);
  }
}

TEST_CASE(
    "findMissingCurves: wherever a point of a wavy plate is, its parameters are found again") {
  const uint32_t seed = 4711;
  MESSAGE("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> heights(-0.15, 0.15), ends(0, 1);
  for (int i = 0; i < 40; ++i) {
    // A Bézier plate, x and y of which are u and v.
    TestSpline s{2, {0, 0, 0, 1, 1, 1}, {}, {}, 2, {0, 0, 0, 1, 1, 1}};
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        s.poles.insert(s.poles.end(), {a / 2.0, b / 2.0, heights(random)});
    const NurbsSurface surface({{2, s.knots}, {2, s.knotsV}, s.poles, {}});
    // A straight way across, which is a curve of degree 4.
    const Point2 from{ends(random), ends(random)}, to{ends(random), ends(random)};
    const auto at = [&](double t) {
      return surface.at(from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)).at;
    };
    // Its Bézier points from five of its points, by solving for them.
    double rows[5][8];
    for (int r = 0; r < 5; ++r) {
      const double t = r / 4.0;
      Bernstein b;
      b.firstAt(4, t);
      for (int k = 0; k < 5; ++k) rows[r][k] = b.value[k];
      const Vec3 p = at(t);
      rows[r][5] = p.x, rows[r][6] = p.y, rows[r][7] = p.z;
    }
    for (int k = 0; k < 5; ++k) {
      int pivot = k;
      for (int r = k + 1; r < 5; ++r)
        if (std::fabs(rows[r][k]) > std::fabs(rows[pivot][k])) pivot = r;
      std::swap(rows[k], rows[pivot]);
      for (int r = 0; r < 5; ++r) {
        if (r == k) continue;
        const double f = rows[r][k] / rows[k][k];
        for (int j = k; j < 8; ++j) rows[r][j] -= f * rows[k][j];
      }
    }
    std::vector<double> poles;
    for (int k = 0; k < 5; ++k)
      for (int j = 5; j < 8; ++j) poles.push_back(rows[k][j] / rows[k][k]);
    const std::vector<double> knots = {0, 0, 0, 0, 0, 1, 1, 1, 1, 1};
    const NurbsCurve curve({{4, knots}, 3, poles, {}});
    Work work;
    FoundCurve found;
    REQUIRE(Inversion(surface, 1e-5).find(curve, 0, 1, 1e-5, work, found));
    const TrimCurve trim(found.breaks, found.points);
    for (double t = 0; t <= 1; t += 0.01)
      checkNear(trim.at(t), {from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)}, 1e-6);
    std::vector<double> corners;
    trim.appendBreaks(0, 1, corners);
    CHECK(corners.empty());
  }
}

TEST_CASE("findMissingCurves: a curve that is not on the surface is named, with its place") {
  const TestSpline flat = circle({0, 0}, 0.5, true), lies = lifted(flat, 0),
                   floats = lifted(flat, 0.01);
  for (const TestSpline* hole : {&lies, &floats}) {
    ModelBuilder plate;
    std::vector<ModelBuilder::Use> sides;
    const Point2 corners[4] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (int k = 0; k < 4; ++k)
      sides.push_back({plate.addEdge(0, 1), false, segment(corners[k], corners[(k + 1) % 4])});
    const uint32_t edge = plate.addEdge(0, 4, hole);
    plate.addFace(square(1, 0), {sides, {{edge, false, {}}}});
    const Read read(plate);
    REQUIRE(read.faults.size() == (hole == &floats ? 1 : 0));
    if (hole != &floats) continue;
    CHECK(read.faults[0].fault == SurfaceFault::EdgeApart);
    CHECK(read.faults[0].loop == 1);
    CHECK(read.faults[0].use == 0);
  }
}

TEST_CASE("findMissingCurves: a curve that crosses a seam is named") {
  for (const bool crosses : {false, true}) {
    // Where a plane cuts through the side at a slant there is an ellipse all around; it begins beside the seam or on it.
    const double turn = crosses ? 0.3 : 0;
    TestSpline around = circle({0, 0}, 1), space = around;
    space.poles.clear();
    for (size_t i = 0; i < around.poles.size(); i += 2) {
      const double x = std::cos(turn) * around.poles[i] - std::sin(turn) * around.poles[i + 1],
                   y = std::sin(turn) * around.poles[i] + std::cos(turn) * around.poles[i + 1];
      space.poles.insert(space.poles.end(), {x, y, 2 + 0.5 * y});
    }
    ModelBuilder side;
    const TestSpline low = lifted(circle({0, 0}, 1), 0);
    const TestSpline seam{1, {0, 0, 1, 1}, {1, 0, 0, 1, 0, 2}, {}, 0, {}};
    const uint32_t e0 = side.addEdge(0, 4, &low), e1 = side.addEdge(0, 4, &space),
                   e2 = side.addEdge(0, 1, &seam);
    side.addFace(cylinderSide(1, 4),
                 {{{e0, false, {}}, {e2, false, {}, true}, {e1, true, {}}, {e2, true, {}, true}}});
    const Read read(side);
    REQUIRE(read.faults.size() == (crosses ? 1 : 0));
    if (!crosses) continue;
    const bool isNamed = read.faults[0].fault == SurfaceFault::TrimOutside ||
                         read.faults[0].fault == SurfaceFault::TrimOpen;
    CHECK(isNamed);
    CHECK(read.faults[0].loop == 0);
  }
}
