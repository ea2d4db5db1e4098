// Models as they are read: what is wrong with one, and where; and arrays that do not fit together.
#include "surface/model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <doctest/doctest.h>

#include "support/surface_models.h"
#include "surface/trimmed_surfaces.h"

using namespace sf;

namespace {

struct Read {
  Work work;
  Charge charge{work};
  Model model;
  std::vector<ModelFault> faults;
  bool isRead;

  explicit Read(const ModelBuilder& builder) : Read(builder.shape(), builder.numbers()) {}
  Read(const std::vector<uint32_t>& shape, const std::vector<double>& numbers)
      : isRead(readModel({shape, numbers}, work, charge, model, faults)) {}

  /// Whether there is this fault and no other.
  bool has(SurfaceFault fault, uint32_t loop, uint32_t use) const {
    return isRead && faults.size() == 1 && faults[0].fault == fault && faults[0].face == 0 &&
           faults[0].loop == loop && faults[0].use == use;
  }
};

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

using Sides = std::vector<ModelBuilder::Use>;

/// A square plate, a side an edge, with a round hole. `spoil` may change its parts before they are put together.
struct Plate {
  TestSpline surface = square(1, 0);
  std::vector<TestSpline> space, flat;
  std::vector<double> tolerances = std::vector<double>(5, 1e-9);
  std::vector<double> ends = {1, 1, 1, 1, 4};
  std::vector<bool> hasSpace = std::vector<bool>(5, true);
  uint32_t outer = 0, edgeOfHole = 4;
  bool hasHole = true;

  Plate() {
    const Point2 corners[4] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (int k = 0; k < 4; ++k) flat.push_back(segment(corners[k], corners[(k + 1) % 4]));
    flat.push_back(circle({0, 0}, 0.5, true));
    for (const TestSpline& c : flat) space.push_back(lifted(c, 0));
  }
  ModelBuilder made() const {
    ModelBuilder m;
    for (size_t k = 0; k < 5; ++k)
      m.addEdge(0, ends[k], hasSpace[k] ? &space[k] : nullptr, tolerances[k]);
    std::vector<Sides> loops(1);
    for (uint32_t k = 0; k < 4; ++k) loops[0].push_back({k, false, flat[k]});
    if (hasHole) loops.push_back({{edgeOfHole, false, flat[4]}});
    m.addFace(surface, loops, false, outer);
    return m;
  }
};

}  // namespace

TEST_CASE("Model: a square with a hole has a loop around it and one inside, and five vertices") {
  const Read plate(Plate().made());
  REQUIRE(plate.isRead);
  REQUIRE(plate.faults.empty());
  CHECK(plate.model.loops.size() == 2);
  CHECK(plate.model.loops[0].isOuter);
  CHECK(!plate.model.loops[1].isOuter);
  CHECK(plate.model.vertices == 5);
  CHECK(plate.model.diagonal() == doctest::Approx(std::sqrt(8.0)));
  CHECK(plate.model.edges[4].fromVertex == plate.model.edges[4].toVertex);
  for (uint32_t k = 0; k < 4; ++k)
    CHECK(plate.model.edges[k].toVertex == plate.model.edges[(k + 1) % 4].fromVertex);
}

TEST_CASE(
    "Model: a cylinder's seam is one edge with two uses, and all ends on it are two vertices") {
  const Read cylinder(solidCylinder());
  REQUIRE(cylinder.faults.empty());
  CHECK(cylinder.model.edges[2].uses == 2);
  CHECK(cylinder.model.vertices == 2);
}

TEST_CASE("Model: a face without loops gets one, with a seam where it closes and points at poles") {
  const Read ball(sphere());
  REQUIRE(ball.faults.empty());
  REQUIRE(ball.model.uses.size() == 4);
  REQUIRE(ball.model.edges.size() == 3);
  uint32_t degenerate = 0;
  for (const ModelEdge& edge : ball.model.edges) degenerate += edge.isDegenerate;
  CHECK(degenerate == 2);
  CHECK(ball.model.vertices == 2);
}

TEST_CASE("Model: each fault is named with its place") {
  const auto faultOf = [](auto&& spoil) {
    Plate plate;
    spoil(plate);
    return Read(plate.made());
  };
  // Of the surface.
  CHECK(faultOf([](Plate& p) {
          p.surface.knots = {-1, 1, -1, 1};
        }).has(SurfaceFault::BadKnots, kNone, kNone));
  CHECK(faultOf([](Plate& p) {
          p.surface.poles[4] = kNaN;
        }).has(SurfaceFault::NotFinite, kNone, kNone));
  CHECK(faultOf([](Plate& p) {
          p.surface.weights = {1, 1, 0, 1};
        }).has(SurfaceFault::BadWeights, kNone, kNone));
  CHECK(faultOf([](Plate& p) {
          p.surface.weights = {1, 1, -2, 1};
        }).has(SurfaceFault::BadWeights, kNone, kNone));
  // Of curves.
  CHECK(faultOf([](Plate& p) { p.flat[2].poles[0] = kNaN; }).has(SurfaceFault::NotFinite, 0, 2));
  CHECK(faultOf([](Plate& p) { p.flat[4].weights[3] = 0; }).has(SurfaceFault::BadWeights, 1, 0));
  CHECK(faultOf([](Plate& p) {
          std::swap(p.flat[4].knots[4], p.flat[4].knots[6]);
        }).has(SurfaceFault::BadKnots, 1, 0));
  CHECK(
      faultOf([](Plate& p) { p.space[3].poles[1] = INFINITY; }).has(SurfaceFault::NotFinite, 0, 3));
  // Of edges.
  CHECK(faultOf([](Plate& p) { p.edgeOfHole = 5; }).has(SurfaceFault::BadEdge, 1, 0));
  CHECK(faultOf([](Plate& p) { p.tolerances[1] = kNaN; }).has(SurfaceFault::NotFinite, 0, 1));
  CHECK(faultOf([](Plate& p) { p.tolerances[1] = -1; }).has(SurfaceFault::NotFinite, 0, 1));
  CHECK(faultOf([](Plate& p) { p.ends[2] = 0; }).has(SurfaceFault::BadDomain, 0, 2));
  CHECK(faultOf([](Plate& p) { p.ends[2] = 2; }).has(SurfaceFault::BadDomain, 0, 2));
  CHECK(faultOf([](Plate& p) {
          p.flat[1] = segment({1, -1}, {1, 1}, 0, 0.5);
        }).has(SurfaceFault::BadDomain, 0, 1));
  CHECK(faultOf([](Plate& p) {
          for (size_t i = 0; i < p.space[4].poles.size(); i += 3) p.space[4].poles[i + 2] = 0.01;
        }).has(SurfaceFault::EdgeApart, 1, 0));
  CHECK(faultOf([](Plate& p) {
          p.flat[2] = {}, p.hasSpace[2] = false;
        }).has(SurfaceFault::BadEdge, 0, 2));
  CHECK(faultOf([](Plate& p) { p.flat[4].weights[3] = 1e12; }).has(SurfaceFault::BadWeights, 1, 0));
  // An edge without a curve, used twice: the two lie elsewhere.
  CHECK(faultOf([](Plate& p) {
          p.hasSpace[0] = false, p.edgeOfHole = 0, p.flat[4] = segment({-0.5, 0}, {0.5, 0});
        }).has(SurfaceFault::EdgeApart, 1, 0));
  // Of loops.
  CHECK(faultOf([](Plate& p) {
          p.hasSpace[4] = false, p.flat[4] = circle({0.8, 0}, 0.5, true);
        }).has(SurfaceFault::TrimOutside, 1, 0));
  CHECK(faultOf([](Plate& p) {
          p.hasSpace[1] = false, p.flat[1] = segment({1, -1}, {1, 0.8});
        }).has(SurfaceFault::TrimOpen, 0, 1));
  CHECK(faultOf([](Plate& p) { p.outer = 2; }).has(SurfaceFault::Degenerate, kNone, kNone));
}

TEST_CASE(
    "Model: a curve that leaves the domain, or its edge, in a short part alone is found out") {
  const auto faultOf = [](auto&& spoil) {
    Plate plate;
    spoil(plate);
    return Read(plate.made());
  };
  // A side of one cubic, whose middle is outside by 4/9 of what its pole is, in domains of size 2.
  const auto side = [](double off) {
    return TestSpline{3, {0, 0, 0, 0, 1, 1, 1, 1}, {-1, -1, -0.5, -1 - off, 0.5, -1, 1, -1}, {}, 0,
                      {}};
  };
  for (const double off : {1e-6, 1e-5, 1e-3})
    CHECK(faultOf([&](Plate& p) {
            p.hasSpace[0] = false, p.flat[0] = side(off);
          }).has(SurfaceFault::TrimOutside, 0, 0) == (off > 4e-6));
  // One point of thousands, and of the edge's curve one that is not the domain's.
  TestSpline hole{1, {0, 0}, {0.5, 0}, {}, 0, {}};
  constexpr int kPoints = 20001;
  for (int i = 1; i <= kPoints; ++i) {
    const double angle = -2 * kPi * i / kPoints;
    hole.knots.push_back(4.0 * i / kPoints);
    hole.poles.insert(hole.poles.end(), {0.5 * std::cos(angle), 0.5 * std::sin(angle)});
  }
  hole.knots.push_back(4);
  const TestSpline space = lifted(hole, 0);
  CHECK(faultOf([&](Plate& p) { p.flat[4] = hole, p.space[4] = space; }).faults.empty());
  CHECK(faultOf([&](Plate& p) {
          p.flat[4] = hole, p.hasSpace[4] = false;
          p.flat[4].poles[2 * 7777] = 1.5;
        }).has(SurfaceFault::TrimOutside, 1, 0));
  CHECK(faultOf([&](Plate& p) {
          p.flat[4] = hole, p.space[4] = space;
          p.flat[4].poles[2 * 7777] += 0.1;
        }).has(SurfaceFault::EdgeApart, 1, 0));
  CHECK(faultOf([&](Plate& p) {
          p.flat[4] = hole, p.space[4] = space;
          p.space[4].poles[3 * 7777 + 2] = 0.1;
        }).has(SurfaceFault::EdgeApart, 1, 0));
}

TEST_CASE("Model: an edge that is a point is degenerate, whether it says so or not") {
  const TestSpline around = circle({0, 0}, 1);
  const double h = std::sqrt(0.5),
               profile[5][3] = {{0, -1, 1}, {1, -1, h}, {1, 0, 1}, {1, 1, h}, {0, 1, 1}};
  TestSpline ball{2, around.knots, {}, {}, 2, {0, 0, 0, 1, 1, 2, 2, 2}};
  for (int k = 0; k < 9; ++k)
    for (const auto& p : profile) {
      ball.poles.insert(ball.poles.end(),
                        {p[0] * around.poles[2 * k], p[0] * around.poles[2 * k + 1], p[1]});
      ball.weights.push_back(around.weights[k] * p[2]);
    }
  TestSpline side{2, ball.knotsV, {}, {}, 0, {}}, points[2];
  for (const auto& p : profile)
    side.poles.insert(side.poles.end(), {p[0], 0, p[1]}), side.weights.push_back(p[2]);
  for (const double z : {-1.0, 1.0})
    points[z > 0] = {1, {0, 0, 4, 4}, {0, 0, z, 0, 0, z}, {}, 0, {}};
  for (const bool isMarked : {true, false})
    for (const bool hasCurve : {true, false})
      for (const bool hasFlat : {true, false}) {
        if (!isMarked && !hasCurve && !hasFlat) continue;
        ModelBuilder m;
        const uint32_t seam = m.addEdge(0, 2, &side),
                       south = m.addEdge(0, 4, hasCurve ? &points[0] : nullptr, 1e-9, isMarked),
                       north = m.addEdge(0, 4, hasCurve ? &points[1] : nullptr, 1e-9, isMarked);
        const auto flat = [&](Point2 a, Point2 b, double to) {
          return hasFlat ? segment(a, b, 0, to) : TestSpline{1, {}, {}, {}, 0, {}};
        };
        m.addFace(ball, {{{south, false, flat({0, 0}, {4, 0}, 4)},
                          {seam, false, flat({4, 0}, {4, 2}, 2), true},
                          {north, true, flat({0, 2}, {4, 2}, 4)},
                          {seam, true, flat({0, 0}, {0, 2}, 2), true}}});
        const Read read(m);
        REQUIRE(read.faults.empty());
        CHECK(!read.model.edges[seam].isDegenerate);
        CHECK(read.model.edges[south].isDegenerate);
        CHECK(read.model.edges[north].isDegenerate);
        CHECK(read.model.vertices == 2);
      }
}

TEST_CASE("Model: edges that say they are points, and are none, are named") {
  Plate plate;
  ModelBuilder m;
  for (uint32_t k = 0; k < 4; ++k) m.addEdge(0, 1, nullptr, 1e-9, k == 2);
  Sides sides;
  for (uint32_t k = 0; k < 4; ++k) sides.push_back({k, false, plate.flat[k]});
  m.addFace(plate.surface, {sides});
  CHECK(Read(m).has(SurfaceFault::EdgeApart, 0, 2));
}

TEST_CASE("Model: of curves that are missing the one that is not found is named") {
  for (uint32_t lost = 0; lost < 4; ++lost) {
    Plate plate;
    for (TestSpline& c : plate.flat) c = {1, {}, {}, {}, 0, {}};
    // Bent out of the plane, between its ends.
    TestSpline& bent = plate.space[lost];
    bent.degree = 2, bent.knots = {0, 0, 0, 1, 1, 1};
    bent.poles.insert(bent.poles.begin() + 3, {0.5 * (bent.poles[0] + bent.poles[3]),
                                               0.5 * (bent.poles[1] + bent.poles[4]), 0.1});
    CHECK(Read(plate.made()).has(SurfaceFault::EdgeApart, 0, lost));
  }
}

TEST_CASE("Model: spheres of all sizes, near and far, have a seam and two poles") {
  const uint32_t seed = 20262;
  MESSAGE("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-1, 1);
  const std::vector<uint32_t> shape = sphere().shape();
  // Knots first, then poles. See ModelArrays.
  const size_t firstPole = 12 + 8, count = 45;
  for (int round = 0; round < 60; ++round) {
    const double size = std::pow(10, 36.0 * any(random));
    const double away = round % 2 == 0 ? 0 : size * std::pow(10, 9 * std::fabs(any(random)));
    if (away > 1e36) continue;
    const Vec3 middle = {away * any(random), away * any(random), away * any(random)};
    // Turned, so that no coordinates are the same by chance.
    const double angle = kPi * any(random), c = std::cos(angle), s = std::sin(angle);
    std::vector<double> numbers = sphere().numbers();
    for (size_t i = firstPole; i < firstPole + 3 * count; i += 3) {
      const Vec3 p{numbers[i], c * numbers[i + 1] - s * numbers[i + 2],
                   s * numbers[i + 1] + c * numbers[i + 2]};
      numbers[i] = middle.x + size * (c * p.x - s * p.y);
      numbers[i + 1] = middle.y + size * (s * p.x + c * p.y);
      numbers[i + 2] = middle.z + size * p.z;
    }
    const Read read(shape, numbers);
    REQUIRE(read.isRead);
    // What does not fit into 32 bits, or is no larger than what these cannot tell.
    if (size < 1e-34) continue;
    REQUIRE(read.faults.empty());
    REQUIRE(read.model.edges.size() == 3);
    CHECK(read.model.vertices == 2);
    // South, seam, north.
    CHECK(read.model.edges[0].isDegenerate);
    CHECK(read.model.edges[2].isDegenerate);
  }
}

TEST_CASE("Model: what is beyond all sizes is refused") {
  const auto scaled = [](double poles, double knots) {
    Plate plate;
    ModelBuilder m;
    TestSpline s = plate.surface;
    for (double& x : s.poles) x *= poles;
    for (double& x : s.knots) x *= knots;
    m.addFace(s, {});
    return Read(m);
  };
  CHECK(scaled(1, 1).faults.empty());
  CHECK(scaled(1e30, 1e40).faults.empty());
  CHECK(scaled(1e-30, 1e-40).faults.empty());
  CHECK(scaled(1e40, 1).has(SurfaceFault::NotFinite, kNone, kNone));
  CHECK(scaled(1e151, 1).has(SurfaceFault::NotFinite, kNone, kNone));
  CHECK(scaled(1e-40, 1).has(SurfaceFault::Degenerate, kNone, kNone));
  CHECK(scaled(0, 1).has(SurfaceFault::Degenerate, kNone, kNone));
  CHECK(scaled(1, 1e60).has(SurfaceFault::BadKnots, kNone, kNone));
  CHECK(scaled(1, 1e-60).has(SurfaceFault::BadKnots, kNone, kNone));
}

TEST_CASE("Model: corners of holes that meet are one vertex, in columns and rows too") {
  const uint32_t seed = 20263;
  MESSAGE("seed " << seed);
  std::mt19937 random(seed);
  constexpr int kCells = 12;
  // Diamonds in cells of a grid: those of cells side by side share a corner.
  for (int round = 0; round < 10; ++round) {
    Plate plate;
    ModelBuilder m;
    Sides sides;
    for (uint32_t k = 0; k < 4; ++k) sides.push_back({m.addEdge(0, 1), false, plate.flat[k]});
    std::vector<Sides> loops{sides};
    std::vector<Point2> places;
    const double half = 0.9 / kCells;
    for (int i = 0; i < kCells; ++i)
      for (int k = 0; k < kCells; ++k) {
        if (random() % 3 == 0) continue;
        const Point2 at{-0.9 + half * (2 * i + 1), -0.9 + half * (2 * k + 1)};
        const Point2 corners[4] = {
            {at.x + half, at.y}, {at.x, at.y - half}, {at.x - half, at.y}, {at.x, at.y + half}};
        Sides diamond;
        for (uint32_t c = 0; c < 4; ++c) {
          diamond.push_back({m.addEdge(0, 1), false, segment(corners[c], corners[(c + 1) % 4])});
          const bool isNew = std::none_of(places.begin(), places.end(), [&](Point2 p) {
            return std::hypot(p.x - corners[c].x, p.y - corners[c].y) < 1e-9;
          });
          if (isNew) places.push_back(corners[c]);
        }
        loops.push_back(diamond);
      }
    m.addFace(plate.surface, loops);
    const Read read(m);
    REQUIRE(read.faults.empty());
    CHECK(read.model.vertices == 4 + places.size());
  }
}

TEST_CASE("Model: memory is charged before it is taken") {
  // Each pole of so high a degree begins a span, whose Bézier points are many.
  TestSpline s{25, {}, {}, {}, 25, {}};
  constexpr int kPoles = 60;
  for (int i = 0; i < kPoles + 26; ++i) s.knots.push_back(i);
  s.knotsV = s.knots;
  for (int i = 0; i < kPoles; ++i)
    for (int k = 0; k < kPoles; ++k) s.poles.insert(s.poles.end(), {1.0 * i, 1.0 * k, 0});
  ModelBuilder m;
  m.addFace(s, {});
  const std::vector<uint32_t> shape = m.shape();
  const std::vector<double> numbers = m.numbers();
  const uint64_t points = 35 * 35 * 26 * 26 * 4 * sizeof(double);
  for (const uint64_t limit : {points / 2, 2 * points}) {
    Work work(limit, nullptr, nullptr);
    Charge charge(work);
    Model model;
    std::vector<ModelFault> faults;
    const bool isRead = readModel({shape, numbers}, work, charge, model, faults);
    CHECK(isRead == (limit > points));
    CHECK((work.status() == Status::OutOfMemory) == (limit < points));
    CHECK(charge.bytes() > points);
    CHECK(model.faces.size() == (isRead ? 1 : 0));
  }
}

TEST_CASE("Model: within its edge's tolerance a curve may be off, and loops open") {
  const auto faultsOf = [](double tolerance) {
    Plate plate;
    plate.tolerances[4] = plate.tolerances[1] = tolerance;
    for (size_t i = 0; i < plate.space[4].poles.size(); i += 3) plate.space[4].poles[i + 2] = 0.01;
    plate.flat[1] = segment({1, -1}, {1, 0.99});
    return Read(plate.made()).faults.size();
  };
  CHECK(faultsOf(0.011) == 0);
  CHECK(faultsOf(0.005) == 1);
}

TEST_CASE("Model: of several faces only those at fault are left out") {
  ModelBuilder m = solidCylinder();
  TestSpline bad = square(1, 0);
  bad.poles[0] = kNaN;
  m.addFace(bad, {});
  const Read read(m);
  REQUIRE(read.isRead);
  REQUIRE(read.faults.size() == 1);
  CHECK(read.faults[0].face == 3);
  for (uint32_t f = 0; f < 4; ++f) CHECK(read.model.faces[f].isLeftOut == (f == 3));
}

TEST_CASE("Model: arrays that are too short or too long for their counts are refused") {
  const std::vector<uint32_t> shape = Plate().made().shape();
  const std::vector<double> numbers = Plate().made().numbers();
  for (size_t k = 0; k < shape.size(); ++k)
    CHECK(!Read(std::vector<uint32_t>(shape.begin(), shape.begin() + k), numbers).isRead);
  for (size_t k = 0; k < numbers.size(); ++k)
    CHECK(!Read(shape, std::vector<double>(numbers.begin(), numbers.begin() + k)).isRead);
  std::vector<uint32_t> longer = shape;
  longer.push_back(0);
  CHECK(!Read(longer, numbers).isRead);
}

TEST_CASE("Model: random lies in its arrays end in a fault or a mesh") {
  const uint32_t seed = 20261;
  MESSAGE("seed " << seed);
  std::mt19937 random(seed);
  Plate bare;
  for (TestSpline& c : bare.flat) c = {};
  const ModelBuilder builders[] = {Plate().made(), bare.made(), solidCylinder(), sphere(),
                                   wavyPlate(random, 0.1, 4)};
  uint32_t read = 0;
  for (int i = 0; i < 1500; ++i) {
    const ModelBuilder& builder = builders[random() % 5];
    std::vector<uint32_t> shape = builder.shape();
    std::vector<double> numbers = builder.numbers();
    const uint32_t lies = 1 + random() % 3;
    for (uint32_t k = 0; k < lies; ++k) {
      const uint32_t bigs[] = {0, 1, 2, 3, 25, 26, 1u << 16, 0x7fffffffu, 0xffffffffu};
      const double odd[] = {0, 1, -1, 1e-300, 1e300, kNaN, INFINITY, 0.5, 4, 1e15, 1e8, 1e-8};
      if (random() % 2 == 0)
        shape[random() % shape.size()] = bigs[random() % 9];
      else
        numbers[random() % numbers.size()] = odd[random() % 12];
    }
    Read spoilt(shape, numbers);
    if (!spoilt.isRead) continue;
    ++read;
    for (const ModelFault& fault : spoilt.faults) CHECK(fault.face < spoilt.model.faces.size());
    const auto surfaces =
        TrimmedSurfaces::open(std::move(spoilt.model), spoilt.work, spoilt.charge, spoilt.faults);
    if (!surfaces) continue;
    Sampling sampling;
    sampling.tolerance = 0.01 * surfaces->model().diagonal();
    Tessellation told;
    TessellationLimits limits;
    limits.maxTriangles = 20000;
    surfaces->tessellate(sampling, limits, spoilt.work, told);
  }
  CHECK(read > 500);
}
