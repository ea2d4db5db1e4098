// Meshes of models that are the same in another form: scaled, turned, with u and v exchanged, with knots inserted. And trims that are
// hard to sample.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "support/surface_checks.h"

using namespace sf;

namespace {

/// A face over [0, 1]² with holes, all of whose edges are its own.
struct Plate {
  TestSpline surface;
  std::vector<TestSpline> holes;
  bool isReversed = false;

  ModelBuilder model() const {
    ModelBuilder m;
    std::vector<std::vector<ModelBuilder::Use>> loops(1);
    const Point2 corners[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (int k = 0; k < 4; ++k)
      loops[0].push_back({m.addEdge(0, 1), false, segment(corners[k], corners[(k + 1) % 4])});
    for (const TestSpline& hole : holes)
      loops.push_back(
          {{m.addEdge(hole.knots[hole.degree], hole.knots[hole.count()]), false, hole}});
    m.addFace(surface, loops, isReversed);
    return m;
  }
};

const std::vector<double> kKnots = {0, 0, 0, 0, 0.25, 0.5, 0.75, 1, 1, 1, 1};

Plate wavy(std::mt19937& random, int holes) {
  std::uniform_real_distribution<double> heights(-0.3, 0.3), radii(0.03, 0.1);
  Plate plate{{3, kKnots, {}, {}, 3, kKnots}, {}};
  for (int i = 0; i < 7; ++i)
    for (int j = 0; j < 7; ++j)
      plate.surface.poles.insert(plate.surface.poles.end(),
                                 {i / 6.0, 1.3 * j / 6.0, heights(random)});
  for (int k = 0; k < holes; ++k)
    plate.holes.push_back(
        circle({0.2 + 0.3 * (k % 3), 0.2 + 0.3 * (k / 3)}, radii(random), random() % 2 == 0));
  return plate;
}

Plate exchanged(Plate plate) {
  TestSpline& s = plate.surface;
  const TestSpline old = s;
  std::swap(s.degree, s.degreeV), std::swap(s.knots, s.knotsV);
  s.poles.clear();
  for (uint32_t j = 0; j < old.countV(); ++j)
    for (uint32_t i = 0; i < old.count(); ++i)
      for (int axis = 0; axis < 3; ++axis)
        s.poles.push_back(old.poles[3 * (i * old.countV() + j) + axis]);
  for (TestSpline& hole : plate.holes)
    for (size_t i = 0; i < hole.poles.size(); i += 2) std::swap(hole.poles[i], hole.poles[i + 1]);
  plate.isReversed = !plate.isReversed;
  return plate;
}

/// Inserts a knot along u (Boehm 1980).
Plate refined(Plate plate, double t) {
  TestSpline& s = plate.surface;
  const TestSpline old = s;
  const uint32_t p = old.degree, columns = old.countV();
  uint32_t span = p;
  while (old.knots[span + 1] <= t) ++span;
  s.knots.insert(s.knots.begin() + span + 1, t);
  s.poles.clear();
  for (uint32_t i = 0; i < old.count() + 1; ++i) {
    const double share = i + p <= span ? 1
                         : i > span    ? 0
                                       : (t - old.knots[i]) / (old.knots[i + p] - old.knots[i]);
    for (uint32_t k = 0; k < 3 * columns; ++k)
      s.poles.push_back((share > 0 ? share * old.poles[3 * columns * i + k] : 0) +
                        (share < 1 ? (1 - share) * old.poles[3 * columns * (i - 1) + k] : 0));
  }
  return plate;
}

struct Meshed {
  Opened opened;
  Tessellation told;
  Facts facts;

  explicit Meshed(const Plate& plate, double tolerance, double angle = 10) : opened(plate.model()) {
    REQUIRE(opened.faults.empty());
    REQUIRE(opened.surfaces->tessellate(samplingOf(tolerance, angle), {}, opened.work, told));
    facts = check(*opened.surfaces, told);
  }
  const MeshLayout& layout() const { return opened.surfaces->layout(); }
};

}  // namespace

TEST_CASE("TrimmedSurfaces: a model that is larger by a power of two has the same mesh, larger") {
  const unsigned seed = 31;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  for (int round = 0; round < 4; ++round)
    for (const double factor : {1.0 / 1024, 64.0}) {
      Plate plate = wavy(random, 5);
      const Meshed one(plate, 2e-3, 0.4);
      for (double& x : plate.surface.poles) x *= factor;
      const Meshed other(plate, 2e-3 * factor, 0.4);
      CHECK(one.layout().triangles == other.layout().triangles);
      CHECK(one.layout().strips == other.layout().strips);
      bool isScaled = one.layout().positions.size() == other.layout().positions.size();
      for (size_t i = 0; i < one.layout().positions.size() && isScaled; ++i)
        isScaled = float(factor) * one.layout().positions[i] == other.layout().positions[i];
      CHECK(isScaled);
    }
}

TEST_CASE(
    "TrimmedSurfaces: turned, with u and v exchanged, or with knots inserted: as near, of one "
    "area") {
  const unsigned seed = 32;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> knots(0.01, 0.99), turns(0, 6);
  for (int round = 0; round < 6; ++round) {
    CAPTURE(round);
    const Plate plate = wavy(random, 6);
    for (const double tolerance : {1e-2, 1e-3}) {
      CAPTURE(tolerance);
      const Meshed one(plate, tolerance);
      Plate turned = plate, finer = plate;
      const double c = std::cos(turns(random)), s = std::sqrt(1 - c * c);
      for (size_t i = 0; i < turned.surface.poles.size(); i += 3) {
        double* p = &turned.surface.poles[i];
        const double x = c * p[0] - s * p[2], z = s * p[0] + c * p[2];
        p[0] = x + 10, p[2] = z - 3;
      }
      for (int k = 0; k < 3; ++k) finer = refined(finer, knots(random));
      for (const Plate& changed : {turned, exchanged(plate), finer}) {
        const Meshed other(changed, tolerance);
        CHECK(other.facts.openEdges > 0);
        CHECK(int(other.facts.vertices) - int(other.facts.edges) + int(other.facts.triangles) ==
              1 - int(plate.holes.size()));
        CHECK(other.told.deviation <= tolerance);
        CHECK(deviation(*other.opened.surfaces, 0, other.told.origin) <= 1.02 * tolerance);
        CHECK(std::fabs(other.facts.area - one.facts.area) < 4 * tolerance);
        CHECK(double(other.facts.triangles) < 1.6 * double(one.facts.triangles));
        CHECK(double(other.facts.triangles) > 0.6 * double(one.facts.triangles));
      }
    }
  }
}

TEST_CASE(
    "TrimmedSurfaces: trims like spirals, stars and slivers are valid with few samples a span") {
  std::mt19937 random(33);
  // Closed cubic splines without ends, around control points.
  const auto smooth = [](const std::vector<Point2>& around) {
    TestSpline c{3, {}, {}, {}, 0, {}};
    for (size_t k = 0; k < around.size() + 3; ++k) {
      c.poles.push_back(around[k % around.size()].x);
      c.poles.push_back(around[k % around.size()].y);
    }
    for (size_t k = 0; k < around.size() + 7; ++k) c.knots.push_back(double(k));
    return c;
  };
  const auto closed = [](const std::vector<Point2>& around) {
    TestSpline c{1, {0}, {}, {}, 0, {}};
    for (size_t k = 0; k <= around.size(); ++k) {
      c.poles.push_back(around[k % around.size()].x);
      c.poles.push_back(around[k % around.size()].y);
      c.knots.push_back(double(k));
    }
    c.knots.push_back(double(around.size()));
    return c;
  };
  const auto polar = [](double radius, double angle) {
    return Point2{0.5 + radius * std::cos(angle), 0.5 + radius * std::sin(angle)};
  };
  std::vector<std::vector<Point2>> shapes;
  std::vector<Point2> shape;
  // A band that winds three times around.
  for (int k = 0; k <= 60; ++k) shape.push_back(polar(0.1 + 0.005 * k, 0.3 * k));
  for (int k = 60; k >= 0; --k) shape.push_back(polar(0.115 + 0.005 * k, 0.3 * k));
  shapes.push_back(shape);
  for (const double inner : {0.05, 0.2}) {
    shape.clear();
    for (int k = 0; k < 40; ++k) shape.push_back(polar(k % 2 ? inner : 0.42, 2 * kPi * k / 40));
    shapes.push_back(shape);
  }
  for (const double width : {1e-2, 1e-4, 1e-6})
    shapes.push_back({{0.1, 0.5}, {0.5, 0.5 - width}, {0.9, 0.5}, {0.5, 0.5 + width}});
  for (size_t k = 0; k < shapes.size(); ++k)
    for (const bool isSmooth : {false, true}) {
      CAPTURE(k);
      CAPTURE(isSmooth);
      Plate plate = wavy(random, 0);
      plate.holes = {isSmooth ? smooth(shapes[k]) : closed(shapes[k])};
      for (const double tolerance : {1.0, 0.1, 0.01, 0.001}) {
        CAPTURE(tolerance);
        const Meshed meshed(plate, tolerance);
        CHECK(int(meshed.facts.vertices) - int(meshed.facts.edges) + int(meshed.facts.triangles) ==
              0);
        CHECK(meshed.told.deviation <= tolerance);
        for (const Report& report : meshed.told.reports)
          CHECK(report.report == SurfaceReport::CrossingSamples);
      }
    }
}
