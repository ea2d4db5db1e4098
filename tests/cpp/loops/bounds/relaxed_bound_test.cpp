#include "loops/bounds/relaxed_bound.h"

#include <doctest/doctest.h>

#include "loops/domains/exact_solver.h"
#include "support/generators.h"

using namespace sf;
using namespace sftest;

namespace {

struct Bounds {
  double relaxed, exact;
  size_t leftInUse;
};

Bounds bounds(const LoopSet& loops, const TriangleWeights& weights, Measure measure,
              uint32_t root) {
  Work work;
  Bounds result{};
  {
    std::vector<uint32_t> triples;
    REQUIRE(allTriples(loops, work, triples));
    CandidateSet set;
    REQUIRE(buildCandidateSet(loops, weights, triples, work, set));
    const size_t before = work.used();
    const std::vector<double> zero(set.size(), 0);
    const std::vector<double>& cost = measure.isWorst() ? zero : set.weight;
    SegmentTable segments;
    REQUIRE(segments.compute(loops, set, cost, measure, work));
    const Pass pass{{loops, set, cost, measure, work}, segments};
    {
      RelaxedBound bound(pass);
      REQUIRE(bound.compute(Domains(loops).root(root), ~uint64_t(0)));
      ExactSolver solver(pass, bound, root);
      SplitOrder order;
      REQUIRE(solver.solve(kInfinity, result.exact, order));
      result.relaxed = bound.rootBound();
    }
    result.leftInUse = work.used() - before;
  }
  return result;
}

}  // namespace

TEST_CASE("relaxed bound: never above the optimum, which no choice of the root changes") {
  Random random(71);
  MESSAGE("seed 71");
  int tight = 0, cases = 0;
  for (int i = 0; i < 24; ++i) {
    const LoopSet loops = loopSet(i % 3 == 2 ? randomLoops({4, 3, 3}, 0.8, random)
                                             : randomLoops({5, 6}, 0.6, random));
    TriangleWeights weights;
    weights.area = i % 2;
    const Measure measure = i % 4 == 3 ? Measure::worst() : Measure::sum(i % 2 ? 0.3 : 1);
    const Bounds first = bounds(loops, weights, measure, 0);
    const Bounds second = bounds(loops, weights, measure, loops.first(1) + 1);
    CHECK(first.relaxed <= first.exact * (1 + 1e-12));
    CHECK(second.relaxed <= second.exact * (1 + 1e-12));
    CHECK(first.exact == doctest::Approx(second.exact).epsilon(1e-11));
    tight += first.relaxed > 0.9 * first.exact;
    ++cases;
  }
  CHECK(tight > cases / 2);
}

TEST_CASE("relaxed bound: all memory is given back") {
  Random random(72);
  const LoopSet loops = loopSet(randomLoops({6, 6}, 0.5, random));
  const Bounds b = bounds(loops, {}, Measure::sum(1), 0);
  // What remains is the segment table, which outlives this scope: 16 bytes for each of 3 slots.
  CHECK(b.leftInUse == 16 * 3 * 220);
}
