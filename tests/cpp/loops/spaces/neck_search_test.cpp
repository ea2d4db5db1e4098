#include "loops/spaces/neck_search.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <set>

#include "support/cases.h"
#include "support/generators.h"
#include "support/surface.h"

using namespace sf;
using namespace sftest;

namespace {

using Triple = std::array<uint32_t, 3>;

Triple sorted(const uint32_t* v) {
  Triple t{v[0], v[1], v[2]};
  std::sort(t.begin(), t.end());
  return t;
}

}  // namespace

TEST_CASE("neck search: holds the optimum where that is two discs and a ring of six triangles") {
  Random random(85);
  MESSAGE("seed 85");
  int necks = 0;
  for (int i = 0; i < 60; ++i) {
    CAPTURE(i);
    Problem problem;
    problem.curves = randomLoops({4 + random.below(6), 4 + random.below(6)}, 0.4, random);
    for (Vec3& p : problem.curves[1]) p = p + Vec3{0, 0, 0.5 + 0.1 * (i % 10)};
    problem.options.areaWeight = 1;
    problem.options.dihedralWeight = 0;
    problem.options.space = Space::All;
    const Answer all = solve(problem);
    REQUIRE(all.outcome.ok());
    REQUIRE(all.span.optimal);
    const LoopSet loops = loopSet(problem.curves);
    int mixed = 0;
    for (size_t t = 0; t < all.span.triangles.size(); t += 3) {
      const uint32_t* v = &all.span.triangles[t];
      mixed += loops.loopOf(v[0]) != loops.loopOf(v[1]) || loops.loopOf(v[0]) != loops.loopOf(v[2]);
    }
    if (mixed != 6) continue;
    ++necks;
    TriangleWeights w;
    w.area = 1;
    std::vector<uint32_t> triples;
    Work work;
    REQUIRE(neckTriples(loops, TripleWeights(loops, w), work, triples));
    std::set<Triple> found;
    for (size_t t = 0; t < triples.size(); t += 3) found.insert(sorted(&triples[t]));
    for (size_t t = 0; t < all.span.triangles.size(); t += 3)
      CHECK(found.count(sorted(&all.span.triangles[t])) == 1);
  }
  CHECK(necks >= 20);
}

TEST_CASE("neck search: triangles over three vertices each, and the work ends when told to") {
  Random random(86);
  MESSAGE("seed 86");
  const LoopSet loops = loopSet(randomLoops({40, 40}, 1, random));
  TriangleWeights w;
  w.perimeter = 1;
  const TripleWeights weights(loops, w);
  std::vector<uint32_t> triples;
  Work work;
  REQUIRE(neckTriples(loops, weights, work, triples));
  REQUIRE(triples.size() >= 3 * 80);
  for (size_t t = 0; t < triples.size(); t += 3)
    CHECK(weights(triples[t], triples[t + 1], triples[t + 2]) < 1e300);
  Work stopped(
      size_t(-1), [](void*, double, double, double) { return false; }, nullptr);
  CHECK_FALSE(neckTriples(loops, weights, stopped, triples));
  CHECK(stopped.status() == Status::Stopped);
}
