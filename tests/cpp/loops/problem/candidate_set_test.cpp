#include "loops/problem/candidate_set.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "delaunay/delaunay.h"
#include "loops/problem/weight.h"
#include "support/generators.h"

using namespace sf;
using namespace sftest;

namespace {

CandidateSet built(const LoopSet& loops, std::vector<uint32_t> triples,
                   const TriangleWeights& w = {}) {
  Work work;
  CandidateSet set;
  REQUIRE(buildCandidateSet(loops, w, std::move(triples), work, set));
  return set;
}

std::vector<uint32_t> all(const LoopSet& loops) {
  Work work;
  std::vector<uint32_t> triples;
  REQUIRE(allTriples(loops, work, triples));
  return triples;
}

std::set<std::vector<uint32_t>> asSet(const std::vector<uint32_t>& triples) {
  std::set<std::vector<uint32_t>> result;
  for (size_t i = 0; i < triples.size(); i += 3)
    CHECK(result.insert({triples[i], triples[i + 1], triples[i + 2]}).second);
  return result;
}

}  // namespace

TEST_CASE("candidate set: all triples but the collinear ones") {
  const LoopSet loops = loopSet({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {0, 1, 0}}});
  const std::vector<uint32_t> triples = all(loops);
  CHECK(triples.size() / 3 == 10 - 4);
  for (size_t i = 0; i < triples.size(); i += 3) CHECK(triples[i + 2] == 4);
}

TEST_CASE("candidate set: slots, edges and angles agree with the triangles") {
  Random random(41);
  MESSAGE("seed 41");
  const LoopSet loops = loopSet(randomLoops({6, 5}, 0.5, random));
  TriangleWeights weights;
  weights.area = 2;
  weights.perimeter = 3;
  const CandidateSet set = built(loops, all(loops), weights);
  REQUIRE(set.size() == 165);
  REQUIRE(set.edgeCount() == 55);
  for (uint32_t e = 0; e < set.edgeCount(); ++e) {
    const uint32_t u = set.edgeVertices[2 * e], v = set.edgeVertices[2 * e + 1];
    CHECK(set.edgeBetween(v, u) == e);
    CHECK(bool(set.isLoopEdge[e]) == loops.isLoopEdge(u, v));
    CHECK(set.degree(e) == 9);
    for (uint32_t s = set.edgeSlots[e]; s < set.edgeSlots[e + 1]; ++s) {
      const uint32_t t = set.slotTriangle[s];
      CHECK(set.edgeOpposite(t, set.slotApex[s]) == e);
      CHECK(set.slotOpposite(t, set.slotApex[s]) == s);
      // The dihedral angle by theta is that of consistently oriented normals.
      const uint32_t other = set.edgeSlots[e];
      if (other == s) continue;
      const Vec3 p = loops.position(u), q = loops.position(v);
      const Vec3 a = cross(q - p, loops.position(set.slotApex[s]) - p);
      const Vec3 b = cross(p - q, loops.position(set.slotApex[other]) - q);
      CHECK(dihedralAngle(set.slotTheta[s], set.slotTheta[other]) ==
            doctest::Approx(angleBetween(a, b)).epsilon(1e-12));
    }
  }
  for (uint32_t t = 0; t < set.size(); ++t) {
    const Vec3 a = loops.position(set.triangles[3 * t]),
               b = loops.position(set.triangles[3 * t + 1]),
               c = loops.position(set.triangles[3 * t + 2]);
    const double expected =
        length(cross(b - a, c - a)) + 3 * (distance(a, b) + distance(b, c) + distance(c, a));
    CHECK(set.weight[t] == doctest::Approx(expected).epsilon(1e-14));
  }
  for (uint32_t v = 0; v < loops.vertexCount(); ++v)
    CHECK(set.loopEdges[v] == set.edgeBetween(v, loops.next(v)));
}

TEST_CASE("candidate set: a face across a loop edge weighs its angle, wound along the loop") {
  const LoopSet loops = loopSet({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
  const double none = std::nan("");
  const std::vector<double> normals = {0, 1, 0, none, none, none, 0, 0, -2};
  TriangleWeights weights;
  weights.dihedral = 1;
  weights.normals = normals;
  const CandidateSet set = built(loops, all(loops), weights);
  // The triangle's normal along the loop is +z: 90 degrees to +y, 180 to -z.
  CHECK(set.weight[0] == doctest::Approx(1.5 * kPi));
  CHECK(set.boundaryAngle[0] == doctest::Approx(kPi));
}

TEST_CASE("candidate set: near triples hold the facets and every loop edge, and widen to all") {
  Random random(42);
  MESSAGE("seed 42");
  const LoopSet loops = loopSet(randomLoops({14, 11}, 0.2, random));
  Work work;
  Delaunay cells;
  REQUIRE(delaunay(loops.positions(), work, cells) == Status::Ok);
  std::vector<uint32_t> facets, near, wide;
  REQUIRE(facetTriples(loops, cells.facets, work, facets));
  REQUIRE(nearTriples(loops, cells.facets, 4, work, near));
  REQUIRE(nearTriples(loops, cells.facets, 64, work, wide));
  const auto facetSet = asSet(facets), nearSet = asSet(near), wideSet = asSet(wide);
  CHECK(std::includes(nearSet.begin(), nearSet.end(), facetSet.begin(), facetSet.end()));
  CHECK(std::includes(wideSet.begin(), wideSet.end(), nearSet.begin(), nearSet.end()));
  CHECK(nearSet.size() > facetSet.size());
  for (uint32_t v = 0; v < loops.vertexCount(); ++v) {
    const auto has = [&](const std::vector<uint32_t>& t) {
      return std::count(t.begin(), t.end(), v) && std::count(t.begin(), t.end(), loops.next(v));
    };
    CHECK(std::any_of(nearSet.begin(), nearSet.end(), has));
  }
}

TEST_CASE("candidate set: the first bad triangle of a caller's list is named") {
  const LoopSet loops = loopSet({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}}});
  Work work;
  std::vector<uint32_t> triples, order;
  const auto check = [&](std::vector<uint32_t> list) {
    return givenTriples(loops, list, work, triples, order);
  };
  CHECK(check({2, 3, 1, 3, 0, 1}).ok());
  CHECK(triples == std::vector<uint32_t>{0, 1, 3, 1, 2, 3});
  CHECK(order == std::vector<uint32_t>{1, 0});
  CHECK(check({0, 1, 3, 1, 2, 4}).vertex == 1);           // out of range
  CHECK(check({0, 0, 3}).vertex == 0);                    // not three vertices
  CHECK(check({1, 2, 3, 0, 1, 2}).vertex == 1);           // collinear
  CHECK(check({1, 2, 3, 0, 1, 3, 3, 2, 1}).vertex == 2);  // there already, in another order
  CHECK(check({0, 1, 7}).status == Status::BadCandidates);
}

TEST_CASE("candidate set: memory is charged before it is taken") {
  Random random(43);
  const LoopSet loops = loopSet(randomLoops({40}, 0, random));
  Work work(1000, nullptr, nullptr);
  CandidateSet set;
  CHECK_FALSE(buildCandidateSet(loops, {}, all(loops), work, set));
  CHECK(work.status() == Status::OutOfMemory);
}
