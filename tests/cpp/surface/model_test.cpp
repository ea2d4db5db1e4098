// Models as they are read: what is wrong with one, and where; and arrays that do not fit together.
#include "surface/model.h"

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
