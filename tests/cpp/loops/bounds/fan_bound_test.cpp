#include "loops/bounds/fan_bound.h"

#include <doctest/doctest.h>

#include <cmath>

#include "delaunay/delaunay.h"
#include "loops/domains/lower_bound.h"
#include "loops/solver.h"
#include "support/generators.h"

using namespace sf;
using namespace sftest;

namespace {

CandidateSet candidates(const LoopSet& loops, const TriangleWeights& weights, bool all,
                        Work& work) {
  std::vector<uint32_t> triples;
  if (all) {
    REQUIRE(allTriples(loops, work, triples));
  } else {
    Delaunay cells;
    REQUIRE(delaunay(loops.positions(), work, cells) == Status::Ok);
    REQUIRE(facetTriples(loops, cells.facets, work, triples));
  }
  CandidateSet set;
  REQUIRE(buildCandidateSet(loops, weights, triples, work, set));
  return set;
}

Surface solved(const LoopSet& loops, const CandidateSet& set, double dihedral,
               uint64_t firstSplits) {
  Work work;
  Surface surface;
  SolveOptions options;
  options.dihedralWeight = dihedral;
  options.firstSplits = firstSplits;
  REQUIRE(solveSurface(loops, set, options, work, surface));
  CHECK(work.used() == 0);
  return surface;
}

}  // namespace

TEST_CASE("fan bound: no surface costs less, nor with any triangle less than its excess more") {
  Random random(101);
  MESSAGE("seed 101");
  int tight = 0;
  for (int i = 0; i < 30; ++i) {
    const LoopSet loops = loopSet(i % 3 == 0   ? randomLoops({7}, 0, random)
                                  : i % 3 == 1 ? randomLoops({5, 4}, 0.8, random)
                                               : randomLoops({4, 3, 3}, 1, random));
    TriangleWeights weights;
    weights.dihedral = i % 4 == 3 ? 0 : 1;
    weights.area = i % 2 || i % 4 == 3;
    Work work;
    const CandidateSet set = candidates(loops, weights, i % 5 < 3, work);
    const Surface best = solved(loops, set, weights.dihedral, ~uint64_t(0));
    FanBound fans(loops, set, set.weight, Measure::sum(weights.dihedral), work);
    REQUIRE(fans.ascend(200, kInfinity));
    CAPTURE(i);
    if (!best.found) continue;
    CHECK(fans.lowerBound() <= best.lowerBound + 1e-9);
    tight += fans.lowerBound() > 0.8 * best.lowerBound;
    const std::vector<double> least = leastPairs(set, Measure::sum(weights.dihedral));
    FanEstimate estimate(loops, fans.links(), least, Measure::sum(weights.dihedral), fans.costs(),
                         work);
    REQUIRE(estimate.compute());
    std::vector<double> excess;
    estimate.excess(excess);
    for (uint32_t t = 0; t < set.size(); t += 1 + uint32_t(set.size() / 12)) {
      // A reward makes the optimum use the triangle, if any surface can.
      constexpr double kReward = 1000;
      CandidateSet forced = set;
      forced.weight[t] -= kReward;
      const Surface with = solved(loops, forced, weights.dihedral, ~uint64_t(0));
      REQUIRE(with.found);
      const double cost = with.lowerBound + kReward;
      if (cost < kReward / 2) CHECK(fans.lowerBound() + excess[t] <= cost + 1e-8);
    }
  }
  CHECK(tight > 15);
}

TEST_CASE("fan bound: infinite where a vertex has no fan") {
  // Without triangles at the first loop edge there is no surface.
  const LoopSet loops = loopSet({circle(6)});
  Work work;
  std::vector<uint32_t> triples = {1, 2, 3, 1, 3, 4, 1, 4, 5};
  CandidateSet set;
  REQUIRE(buildCandidateSet(loops, {}, triples, work, set));
  FanBound fans(loops, set, set.weight, Measure::sum(1), work);
  REQUIRE(fans.ascend(10, kInfinity));
  CHECK(fans.lowerBound() == kInfinity);
}

TEST_CASE("solver: by fans first or by domains alone, the optimum is the same") {
  Random random(102);
  MESSAGE("seed 102");
  int found = 0;
  for (int i = 0; i < 60; ++i) {
    const Curves curves = i % 4 == 0   ? regularSaddles(2 + i % 4, 8, random)
                          : i % 4 == 1 ? randomLoops({9, 8}, 1, random)
                          : i % 4 == 2 ? randomLoops({6, 5, 5}, 1, random)
                                       : regularSaddles(4, 6, random);
    const LoopSet loops = loopSet(curves);
    TriangleWeights weights;
    weights.dihedral = i % 3 == 2 ? 0 : 1;
    weights.area = i % 3 ? 1 : 0;
    Work work;
    const CandidateSet set = candidates(loops, weights, false, work);
    const Surface direct = solved(loops, set, weights.dihedral, ~uint64_t(0));
    const Surface byFans = solved(loops, set, weights.dihedral, 1);
    CAPTURE(i);
    CHECK(direct.found == byFans.found);
    if (!direct.found) continue;
    ++found;
    CHECK(byFans.lowerBound == doctest::Approx(direct.lowerBound).epsilon(1e-11));
    CHECK(byFans.order.size() == direct.order.size());
  }
  CHECK(found > 30);
}
