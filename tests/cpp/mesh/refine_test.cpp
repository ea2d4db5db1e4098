#include "mesh/refine.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "support/patches.h"

using namespace sftest;
using sf::LocalSurface;
using sf::RefineOptions;
using sf::Status;
using sf::Vec3;
using sf::Work;

namespace {

/// What refining must not change.
void checkFixed(const LocalSurface& before, const LocalSurface& after) {
  CHECK(after.fixedVertices == before.fixedVertices);
  CHECK(after.fixedTriangles == before.fixedTriangles);
  REQUIRE(after.positions.size() >= before.positions.size());
  CHECK(std::equal(before.positions.begin(), before.positions.begin() + 3 * before.fixedVertices,
                   after.positions.begin()));
  CHECK(std::equal(before.triangles.begin(), before.triangles.begin() + 3 * before.fixedTriangles,
                   after.triangles.begin()));
  for (const double x : after.positions) CHECK(std::isfinite(x));
  const uint32_t added = uint32_t(after.positions.size() - before.positions.size()) / 3;
  CHECK(after.triangles.size() == before.triangles.size() + 6 * size_t(added));
}

LocalSurface refined(const LocalSurface& before, const RefineOptions& options = {}) {
  LocalSurface after = before;
  Work work;
  CHECK(sf::refine(after, options, work) == Status::Ok);
  CHECK(work.used() == 0);
  checkFixed(before, after);
  return after;
}

}  // namespace

TEST_CASE("refine: a patch as dense as the surface, of good triangles") {
  const auto check = [](const Hole& hole) {
    const LocalSurface after = refined(hole.surface);
    const PatchShape shape = shapeOf(after);
    CHECK(shape.isManifold);
    CHECK(shape.triangles <= 1.5 * double(hole.cutAway.size()) / 3);
    CHECK(shape.triangles >= 0.7 * double(hole.cutAway.size()) / 3);
    CHECK(shape.meanLeastAngle > 42);
    CHECK(shape.leastAngle > 12);
  };
  check(cutHole(graphSheet(40, [](double, double) { return 0.0; }),
                [](Vec3 p) { return length(p) < 0.6; }));
  check(cutHole(sphereSheet(4), cap(20)));
  check(cutHole(cylinderSheet(60, 40, 4), [](Vec3 p) { return std::fabs(p.z) < 0.7; }));
  // With an island.
  check(cutHole(graphSheet(50, [](double, double) { return 0.0; }),
                [](Vec3 p) { return length(p) < 0.7 && length(p) > 0.25; }));
}

TEST_CASE("refine: never more vertices than allowed, and near that many where more would fit") {
  const Hole hole = cutHole(sphereSheet(5), cap(70));
  const uint32_t free =
      uint32_t(refined(hole.surface).positions.size() / 3) - hole.surface.fixedVertices;
  CHECK(free > 1000);
  for (const uint32_t most : {0u, 1u, 10u, 100u, 500u}) {
    RefineOptions options;
    options.maxNewVertices = most;
    const uint32_t added =
        uint32_t(refined(hole.surface, options).positions.size() / 3) - hole.surface.fixedVertices;
    CHECK(added <= most);
    if (most >= 100) CHECK(added * 4 >= most);
  }
}

TEST_CASE("refine: density zero changes nothing, and a higher one gives more") {
  const Hole hole = cutHole(sphereSheet(4), cap(30));
  RefineOptions options;
  options.density = 0;
  CHECK(refined(hole.surface, options).triangles == hole.surface.triangles);
  size_t last = hole.surface.triangles.size();
  for (const double density : {1.0, 1.5, 2.5, 4.0}) {
    options.density = density;
    const size_t size = refined(hole.surface, options).triangles.size();
    CHECK(size > last);
    last = size;
  }
}

TEST_CASE("refine: far away, tiny and huge surfaces come out alike") {
  const Hole hole = cutHole(sphereSheet(3), cap(40));
  const LocalSurface plain = refined(hole.surface);
  for (const double size : {0x1p-100, 0x1p100}) {
    LocalSurface scaled = hole.surface;
    for (double& x : scaled.positions) x *= size;
    const LocalSurface after = refined(scaled);
    CHECK(after.triangles == plain.triangles);
  }
  LocalSurface far = hole.surface;
  for (double& x : far.positions) x += 1e6;
  CHECK(std::fabs(double(refined(far).triangles.size()) / double(plain.triangles.size()) - 1) <
        0.1);
}

TEST_CASE("refine: works without surroundings") {
  const Hole hole = cutHole(sphereSheet(4), cap(30), 0);
  CHECK(hole.surface.fixedTriangles == 0);
  const LocalSurface after = refined(hole.surface);
  CHECK(shapeOf(after).isManifold);
  CHECK(after.positions.size() > hole.surface.positions.size());
}

TEST_CASE("refine: ends on degenerate patches, with finite places") {
  std::mt19937 random(5);
  for (int round = 0; round < 40; ++round) {
    Hole hole = cutHole(sphereSheet(3), cap(50));
    // Vertices of the rim and around it fall together, on lines and into planes.
    for (uint32_t v = 0; v < hole.surface.fixedVertices; ++v) {
      const uint32_t what = random() % 6;
      double* p = &hole.surface.positions[3 * v];
      if (what == 0) p[0] = p[1] = p[2] = 0.25;
      if (what == 1) p[1] = p[2] = 0;
      if (what == 2) p[2] = 0;
      if (round % 4 == 0) p[2] = 0;
      if (round % 8 == 0) p[1] = 0;
    }
    RefineOptions options;
    options.maxNewVertices = 2000;
    const LocalSurface after = refined(hole.surface, options);
    CHECK(shapeOf(after).isManifold);
  }
}

TEST_CASE("refine: work that may not go on leaves the surface as it was") {
  const Hole hole = cutHole(sphereSheet(4), cap(60));
  for (const size_t bytes : {size_t(0), size_t(10'000), size_t(100'000)}) {
    LocalSurface after = hole.surface;
    Work work(bytes, nullptr, nullptr);
    CHECK(sf::refine(after, {}, work) == Status::OutOfMemory);
    CHECK(after.triangles == hole.surface.triangles);
    CHECK(after.positions == hole.surface.positions);
    CHECK(work.used() == 0);
  }
}
