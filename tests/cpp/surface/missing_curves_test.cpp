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

/// A surface of revolution around z: u from 0 to 4 around, v along a profile of points (r, z) with weights.
TestSpline revolved(const TestSpline& profile) {
  const TestSpline around = circle({0, 0}, 1);
  TestSpline s{2, around.knots, {}, {}, profile.degree, profile.knots};
  for (size_t k = 0; k < 9; ++k)
    for (size_t i = 0; i < profile.poles.size() / 2; ++i) {
      const double r = profile.poles[2 * i];
      s.poles.insert(s.poles.end(), {r * around.poles[2 * k], r * around.poles[2 * k + 1],
                                     profile.poles[2 * i + 1]});
      s.weights.push_back(around.weights[k] * (profile.weights.empty() ? 1 : profile.weights[i]));
    }
  return s;
}

/// A ring around z: closed in u, and in v, both from 0 to 4.
TestSpline ring(double radius, double thickness) {
  return revolved(circle({radius, 0}, thickness));
}

/// A cone around z of height 1, whose tip is the side v = 1.
TestSpline cone(double radius) { return revolved(segment({radius, 0}, {0, 1})); }

NurbsSurface surfaceOf(const TestSpline& s) {
  return NurbsSurface({{s.degree, s.knots}, {s.degreeV, s.knotsV}, s.poles, s.weights});
}

/// A way in the domain, and beyond where the surface closes.
struct Way {
  Point2 from, to;
  double bend = 0;  // how far it sways to its left, in its length

  Point2 at(double t) const {
    const double off = bend * std::sin(4 * t);
    return {from.x + t * (to.x - from.x) - off * (to.y - from.y),
            from.y + t * (to.y - from.y) + off * (to.x - from.x)};
  }
  Point2 derivative(double t) const {
    const double off = 4 * bend * std::cos(4 * t);
    return {to.x - from.x - off * (to.y - from.y), to.y - from.y + off * (to.x - from.x)};
  }
};

double within(double x, double from, double to, double period) {
  if (period > 0) x -= period * std::floor((x - from) / period);
  return std::clamp(x, from, to);
}

/// The curve of space that runs along a way on a surface, in so many cubic pieces from 0 to 1 that it is off by rounding alone.
///   period  of u and v, or 0
TestSpline onSurface(const NurbsSurface& surface, const Way& way, Point2 period) {
  constexpr int kPieces = 1024;
  const ArrayView<const double> u = surface.u().breaks(), v = surface.v().breaks();
  // Where it crosses breaks, beyond seams too, a piece ends.
  std::vector<double> stops{0};
  const auto side = [](ArrayView<const double> breaks, double x) {
    const double size = breaks[breaks.size() - 1] - breaks[0],
                 turns = std::floor((x - breaks[0]) / size);
    return turns * double(breaks.size()) +
           double(std::upper_bound(breaks.begin(), breaks.end(), x - turns * size) -
                  breaks.begin());
  };
  const auto cell = [&](double t) {
    const Point2 p = way.at(t);
    return std::pair<double, double>(side(u, p.x), side(v, p.y));
  };
  for (int i = 0; i < kPieces; ++i) {
    double low = i / double(kPieces), high = (i + 1) / double(kPieces);
    stops.push_back(high);
    if (cell(low) == cell(high)) continue;
    const auto before = cell(low);
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (cell(middle) == before ? low : high) = middle;
    }
    const double end = (i + 1) / double(kPieces);
    if (high - i / double(kPieces) > 1e-9 && end - high > 1e-9) stops.insert(stops.end() - 1, high);
  }
  TestSpline c{3, {0}, {}, {}, 0, {}};
  const auto put = [&](Vec3 p) { c.poles.insert(c.poles.end(), {p.x, p.y, p.z}); };
  const auto at = [&](double t) {
    const Point2 p = way.at(t), d = way.derivative(t);
    const TangentPoint s = surface.tangentsAt(within(p.x, u[0], u[u.size() - 1], period.x),
                                              within(p.y, v[0], v[v.size() - 1], period.y));
    return std::pair<Vec3, Vec3>(s.at, d.x * s.u + d.y * s.v);
  };
  put(at(0).first);
  for (size_t i = 0; i + 1 < stops.size(); ++i) {
    const double h = stops[i + 1] - stops[i];
    const auto a = at(stops[i]), b = at(stops[i + 1]);
    put(a.first + (h / 3) * a.second), put(b.first - (h / 3) * b.second), put(b.first);
    c.knots.insert(c.knots.end(), 3, stops[i]);
  }
  c.knots.insert(c.knots.end(), 4, 1.0);
  return c;
}

/// Finds the curve of space along a way. Checks that it is the way again, but for whole periods, and has no corner.
void checkFound(const TestSpline& spline, const Way& way, Point2 period, double near) {
  const NurbsSurface surface = surfaceOf(spline);
  const TestSpline space = onSurface(surface, way, period);
  const NurbsCurve curve({{3, space.knots}, 3, space.poles, {}});
  Work work;
  FoundCurve found;
  const Inversion inversion(surface, 1e-5);
  REQUIRE(inversion.period() == period);
  REQUIRE(inversion.find(curve, 0, 1, 1e-5, work, found));
  const TrimCurve trim(found.breaks, found.points);
  const Point2 middle = trim.at(0.5), wanted = way.at(0.5);
  const auto turns = [](double a, double b, double p) {
    return p > 0 ? p * std::round((b - a) / p) : 0;
  };
  const Point2 shift{turns(middle.x, wanted.x, period.x), turns(middle.y, wanted.y, period.y)};
  double off = 0;
  for (int i = 0; i <= 2000; ++i) {
    const Point2 p = trim.at(i / 2000.0), q = way.at(i / 2000.0);
    off = std::max(off, std::hypot(p.x + shift.x - q.x, p.y + shift.y - q.y));
  }
  CHECK(off < near);
  std::vector<double> corners;
  trim.appendBreaks(0, 1, corners);
  CHECK(corners.empty());
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

TEST_CASE("Inversion: ways on a cylinder and a ring, over their seams, are found again") {
  const uint32_t seed = 4712;
  MESSAGE("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> around(-1, 5), part(0.05, 0.95), bends(-0.3, 0.3);
  for (int i = 0; i < 15; ++i) {
    // Up to once around.
    const double first = around(random), turn = 4 * (part(random) - 0.5);
    checkFound(cylinderSide(1, 2), {{first, 2 * part(random)}, {first + turn, 2 * part(random)}},
               {4, 0}, 1e-11);
  }
  for (int i = 0; i < 15; ++i) {
    const Point2 from{around(random), around(random)};
    const Point2 to{from.x + 6 * (part(random) - 0.5), from.y + 6 * (part(random) - 0.5)};
    checkFound(ring(3, 1), {from, to}, {4, 4}, 1e-11);
    checkFound(ring(3, 1), {from, to, bends(random)}, {4, 4}, 1e-6);
  }
}

TEST_CASE(
    "Inversion: ways to the tip of a cone, and to a sphere's poles, arrive with their own "
    "direction") {
  const uint32_t seed = 4713;
  MESSAGE("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> around(-1, 5), part(0.05, 0.95);
  // Near the end all parameters around are nearly one point, and so a little less is known of them.
  for (int i = 0; i < 15; ++i) {
    const double first = around(random);
    const Way way{{first, part(random)}, {first + 3 * (part(random) - 0.5), 1}, 0};
    checkFound(cone(1), way, {4, 0}, 1e-8);
    checkFound(cone(1), {way.to, way.from}, {4, 0}, 1e-8);
  }
  for (int i = 0; i < 15; ++i) {
    const double first = around(random);
    const Way way{
        {first, 2 * part(random)}, {first + 3 * (part(random) - 0.5), i % 2 ? 2.0 : 0.0}, 0};
    checkFound(sphereSurface(1), way, {4, 0}, 1e-8);
    checkFound(sphereSurface(1), {way.to, way.from}, {4, 0}, 1e-8);
  }
}

TEST_CASE("findMissingCurves: both seams of a ring lie on both sides, wherever the loop begins") {
  const TestSpline surface = ring(3, 1);
  const NurbsSurface s = surfaceOf(surface);
  const TestSpline seamU = onSurface(s, {{0, 0}, {4, 0}}, {4, 4}),
                   seamV = onSurface(s, {{0, 0}, {0, 4}}, {4, 4});
  for (uint32_t first = 0; first < 4; ++first)
    for (const bool isBackwards : {false, true}) {
      ModelBuilder m;
      const uint32_t u = m.addEdge(0, 1, &seamU), v = m.addEdge(0, 1, &seamV);
      const TestSpline none;
      std::vector<ModelBuilder::Use> loop = {{u, false, none, true},
                                             {v, false, none, true},
                                             {u, true, none, true},
                                             {v, true, none, true}};
      std::rotate(loop.begin(), loop.begin() + first, loop.end());
      m.addFace(surface, {loop}, isBackwards);
      const Read read(m);
      REQUIRE(read.faults.empty());
      const Point2 corners[4] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
      for (uint32_t k = 0; k < 4; ++k) {
        checkNear(read.begin(k), corners[(first + k) % 4]);
        checkNear(read.end(k), corners[(first + k + 1) % 4]);
        CHECK(read.off(k) < 1e-6);
      }
      CHECK(read.model.vertices == 1);
    }
}

TEST_CASE("findMissingCurves: a seam in many pieces, and a loop of very many edges") {
  // A cylinder, its seam in pieces.
  constexpr uint32_t kPieces = 30;
  ModelBuilder m;
  const TestSpline low = lifted(circle({0, 0}, 1), 0), high = lifted(circle({0, 0}, 1), 3);
  const uint32_t e0 = m.addEdge(0, 4, &low), e1 = m.addEdge(0, 4, &high);
  std::vector<ModelBuilder::Use> loop{{e0, false, {}}};
  for (uint32_t k = 0; k < kPieces; ++k) {
    const TestSpline piece{
        1, {0, 0, 1, 1}, {1, 0, 3.0 * k / kPieces, 1, 0, 3.0 * (k + 1) / kPieces}, {}, 0, {}};
    loop.push_back({m.addEdge(0, 1, &piece), false, {}, true});
  }
  loop.push_back({e1, true, {}});
  for (uint32_t k = kPieces; k-- > 0;) loop.push_back({2 + k, true, {}, true});
  m.addFace(cylinderSide(1, 3), {loop});
  const Read seam(m);
  REQUIRE(seam.faults.empty());
  for (uint32_t k = 0; k < kPieces; ++k) {
    checkNear(seam.begin(1 + k), {4, 3.0 * k / kPieces});
    checkNear(seam.end(2 * kPieces + 1 - k), {0, 3.0 * k / kPieces});
  }
  // A polygon of as many edges as would be too deep for a search that calls itself for each.
  constexpr uint32_t kEdges = 25000;
  ModelBuilder plate;
  std::vector<ModelBuilder::Use> around;
  const auto corner = [](uint32_t k) {
    const double angle = 2 * kPi * k / kEdges;
    return Point2{0.9 * std::cos(angle), 0.9 * std::sin(angle)};
  };
  for (uint32_t k = 0; k < kEdges; ++k) {
    const TestSpline side = lifted(segment(corner(k), corner(k + 1)), 0);
    around.push_back({plate.addEdge(0, 1, &side), false, {}});
  }
  plate.addFace(square(1, 0), {around});
  const Read polygon(plate);
  REQUIRE(polygon.faults.empty());
  CHECK(polygon.model.vertices == kEdges);
  for (uint32_t k = 0; k < kEdges; k += 997) checkNear(polygon.begin(k), corner(k));
}
