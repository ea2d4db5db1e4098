// Fans without large angles: what the filter takes away is in no surface, what it bounds is a bound.
#include "loops/bounds/fan_filter.h"

#include <doctest/doctest.h>

#include <cmath>

#include "loops/bounds/direct_solver.h"
#include "loops/solver.h"
#include "support/generators.h"

using namespace sf;
using namespace sftest;

namespace {

struct Prepared {
  LoopSet loops;
  CandidateSet set;
  std::vector<double> angle;
};

Prepared prepared(const Curves& curves, ArrayView<const double> normals) {
  Prepared p;
  p.loops = loopSet(curves);
  TriangleWeights weights;
  weights.area = 1;
  weights.normals = normals;
  Work work;
  std::vector<uint32_t> triples;
  REQUIRE(allTriples(p.loops, work, triples));
  REQUIRE(buildCandidateSet(p.loops, weights, triples, work, p.set));
  p.angle =
      p.set.boundaryAngle.empty() ? std::vector<double>(p.set.size(), 0) : p.set.boundaryAngle;
  return p;
}

/// The least largest angle, by domains alone.
Optimum leastWorst(const Prepared& p) {
  Work work;
  Optimum optimum;
  SolverCounts counts;
  REQUIRE(solveDirectly({p.loops, p.set, p.angle, Measure::worst(), work, true}, kUnlimited,
                        kInfinity, optimum, counts));
  REQUIRE(optimum.reached);
  return optimum;
}

}  // namespace

TEST_CASE("fan filter: keeps the optimum's triangles, and bounds the largest angle from below") {
  Random random(311);
  MESSAGE("seed 311");
  const std::vector<std::vector<uint32_t>> sizes = {{4, 4}, {6, 5}, {3, 4, 3}, {4, 4, 4}};
  int tight = 0, emptied = 0;
  for (int i = 0; i < 24; ++i) {
    const Curves curves = randomLoops(sizes[size_t(i) % sizes.size()], 1.2, random);
    std::vector<double> normals;
    if (i % 2) {
      for (const Curve& curve : curves)
        for (size_t v = 0; v < 3 * curve.size(); ++v) normals.push_back(random.range(-1, 1));
    }
    const Prepared p = prepared(curves, normals);
    const Optimum optimum = leastWorst(p);
    REQUIRE(optimum.cost < kInfinity);
    Work work;
    {
      FanFilter filter(p.loops, p.set, p.angle, work);
      std::vector<uint32_t> kept;
      REQUIRE(filter.filter(optimum.cost, kept));
      for (const uint32_t t : optimum.order) CHECK(std::binary_search(kept.begin(), kept.end(), t));
      double bound = -1;
      REQUIRE(filter.bound(optimum.cost, bound));
      CHECK(bound <= optimum.cost);
      tight += bound > optimum.cost - 2e-3;
      REQUIRE(filter.filter(std::nextafter(optimum.cost, 0.0), kept));
      emptied += kept.empty();
    }
    CHECK(work.used() == 0);
  }
  MESSAGE(tight << " bounds as good as the optimum, " << emptied << " filters empty below it");
  CHECK(tight > 0);
  CHECK(emptied > 0);
}

TEST_CASE("fan filter: the least worst angle is the same with it and without") {
  Random random(312);
  MESSAGE("seed 312");
  const std::vector<std::vector<uint32_t>> sizes = {{5, 6}, {4, 4, 3}, {3, 3, 3}, {5, 4, 4}};
  for (int i = 0; i < 20; ++i) {
    const Prepared p = prepared(randomLoops(sizes[size_t(i) % sizes.size()], 1.2, random), {});
    SolveOptions solving;
    solving.objective = Objective::WorstDihedral;
    Surface with, without;
    Work work;
    solving.firstSplits = 1;
    REQUIRE(solveSurface(p.loops, p.set, solving, work, with));
    solving.firstSplits = kUnlimited;
    REQUIRE(solveSurface(p.loops, p.set, solving, work, without));
    REQUIRE(with.found == without.found);
    CHECK(with.optimal);
    CHECK(with.lowerBound == without.lowerBound);
  }
}
