// Rims that cost less to span together than apart are of one hole.
#include "mesh/joint_cost.h"

#include <doctest/doctest.h>

#include "support/meshes.h"

using namespace sf;
using namespace sftest;

namespace {

/// Of the two rims of a mesh.
Verdict verdictOn(const TestMesh& mesh, Work& work) {
  Charge charge(work);
  Adjacency adjacency;
  Rims rims;
  REQUIRE(buildAdjacency(mesh.view(), work, charge, adjacency));
  REQUIRE(findRims(mesh.view(), adjacency, work, charge, rims));
  REQUIRE(rims.count() == 2);
  JointCost cost(mesh.view(), rims, work);
  Verdict verdict, again;
  REQUIRE(cost.compare(0, 1, verdict));
  REQUIRE(cost.compare(1, 0, again));
  CHECK(verdict == again);
  return verdict;
}

Verdict verdictOn(const TestMesh& mesh) {
  Work work;
  return verdictOn(mesh, work);
}

/// A sphere with a hole, and another one beside it, whose hole faces that at a distance.
TestMesh facing(double gap) {
  const TestMesh one = without(sphereMesh(3), isNear({0, 0, 1}, 0.4));
  return together(one, mapped(one, [=](Vec3 p) { return Vec3{p.x, -p.y, 2 + gap - p.z}; }));
}

}  // namespace

TEST_CASE("compare: an island and its rim, and the ends of a band, are together") {
  for (const double inner : {0.15, 0.3, 0.45})
    CHECK(verdictOn(without(sphereMesh(4), isBetween({0, 0, 1}, inner, 0.6))) == Verdict::Together);
  for (const double half : {0.1, 0.3})
    CHECK(verdictOn(without(sphereMesh(4), [=](Vec3 p) { return std::fabs(p.z) < half; })) ==
          Verdict::Together);
}

TEST_CASE("compare: holes side by side, or in walls that face each other, are apart") {
  TestMesh mesh = without(sphereMesh(4), isNear({0, 0, 1}, 0.3));
  CHECK(verdictOn(without(mesh, isNear({0.75, 0, 0.66}, 0.3))) == Verdict::Apart);
  for (const double gap : {0.05, 0.3}) CHECK(verdictOn(facing(gap)) == Verdict::Apart);
}

TEST_CASE("compare: the same at any scale and place") {
  MESSAGE("seed 47");
  Random random(47);
  const TestMesh ring = without(sphereMesh(3), isBetween({0, 0, 1}, 0.3, 0.7));
  for (const double scale : {1e-100, 1e-3, 1e90}) {
    const Rotation rotation = randomRotation(random);
    const auto map = [&](Vec3 p) { return scale * (rotation(p) + Vec3{9, 5, 0}); };
    CHECK(verdictOn(mapped(ring, map)) == Verdict::Together);
    CHECK(verdictOn(mapped(facing(0.2), map)) == Verdict::Apart);
  }
}

TEST_CASE("compare: rims of very many vertices are left open") {
  CHECK(verdictOn(without(tubeMesh(JointCost::kMostVertices / 2 + 1, 4, 1),
                          [](Vec3) { return false; })) == Verdict::Unknown);
}

TEST_CASE("compare: counts its work, ends with it, and gives memory back") {
  const TestMesh ring = without(sphereMesh(4), isBetween({0, 0, 1}, 0.25, 0.8));
  Work all;
  CHECK(verdictOn(ring, all) == Verdict::Together);
  CHECK(all.used() == 0);
  CHECK(all.spent() > 100'000);
  Charge charge(all);
  Adjacency adjacency;
  Rims rims;
  REQUIRE(buildAdjacency(ring.view(), all, charge, adjacency));
  REQUIRE(findRims(ring.view(), adjacency, all, charge, rims));
  Verdict verdict;
  Work small(1000, nullptr, nullptr);
  CHECK(!JointCost(ring.view(), rims, small).compare(0, 1, verdict));
  CHECK(small.status() == Status::OutOfMemory);
  Work stopped(
      size_t(-1), [](void*, double, double, double) { return false; }, nullptr);
  JointCost cost(ring.view(), rims, stopped);
  bool goesOn = true;
  for (int i = 0; i < 1000 && goesOn; ++i) goesOn = cost.compare(0, 1, verdict);
  CHECK(!goesOn);
  CHECK(stopped.status() == Status::Stopped);
}
