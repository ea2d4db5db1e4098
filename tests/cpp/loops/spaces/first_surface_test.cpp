#include "loops/spaces/first_surface.h"

#include <doctest/doctest.h>

#include "base/predicates.h"
#include "support/hand_runs.h"
#include "support/surface.h"

using namespace sf;
using namespace sftest;

TEST_CASE("first surface: loops of every kind have one, which is a surface of the class") {
  Random random(640);
  MESSAGE("seed 640");
  for (int i = 0; i < 300; ++i) {
    const Hand kind = Hand(i % int(Hand::Count));
    const Curves curves = handLoops(kind, logUniform(3, 200, random), random);
    if (loopsMeet(curves)) continue;
    std::vector<Vec3> unit;
    const LoopSet given = loopSet(curves);
    scaleToUnit(given.positions(), unit);
    const LoopSet loops(unit, given.starts());
    TriangleWeights weights;
    weights.area = random.below(2), weights.dihedral = random.below(2);
    Work work;
    std::vector<uint32_t> triangles;
    REQUIRE(firstSurface(loops, weights, work, triangles));
    INFO(nameOf(kind) << " " << i << " " << describe(curves));
    Boundary boundary;
    boundary.starts.assign(loops.starts().begin(), loops.starts().end());
    for (uint32_t v = 0; v < loops.vertexCount(); ++v) boundary.vertices.push_back(v);
    CHECK(surfaceFault(boundary, triangles) == "");
    for (size_t t = 0; t < triangles.size(); t += 3)
      CHECK_FALSE(collinear(loops.position(triangles[t]), loops.position(triangles[t + 1]),
                            loops.position(triangles[t + 2])));
  }
}

TEST_CASE("first surface: none where all points lie on one line, and the work ends when told to") {
  const LoopSet line =
      loopSet({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{3, 0, 0}, {4, 0, 0}, {5, 0, 0}}});
  TriangleWeights weights;
  weights.area = 1;
  Work work;
  std::vector<uint32_t> triangles{7};
  REQUIRE(firstSurface(line, weights, work, triangles));
  CHECK(triangles.empty());
  Random random(641);
  const LoopSet loops = loopSet(handLoops(Hand::ManySmall, 0, random));
  const auto stop = [](void*, double, double, double) { return false; };
  Work ended(size_t(1) << 30, stop, nullptr);
  CHECK_FALSE(firstSurface(loops, weights, ended, triangles));
  CHECK(ended.status() == Status::Stopped);
}
