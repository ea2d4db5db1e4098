#include "loops/two_loop_bound.h"

#include <doctest/doctest.h>

#include "loops/exact_solver.h"
#include "loops/relaxed_bound.h"
#include "support/domains.h"
#include "support/generators.h"

using namespace sf;
using namespace sftest;

namespace {

struct Fixture {
  LoopSet loops;
  Work work;
  CandidateSet set;
  std::vector<double> cost;

  /// Over all triples, or about a fraction of them.
  Fixture(const Curves& curves, const TriangleWeights& weights, double fraction, Random& random)
      : loops(loopSet(curves)) {
    std::vector<uint32_t> triples, kept;
    REQUIRE(allTriples(loops, work, triples));
    for (size_t t = 0; t < triples.size(); t += 3)
      if (random.chance(fraction)) kept.insert(kept.end(), &triples[t], &triples[t] + 3);
    REQUIRE(buildCandidateSet(loops, weights, kept, work, set));
    cost = set.weight;
  }
};

}  // namespace

TEST_CASE("two-loop bound: the same numbers as the bound over hashed domains, for every domain") {
  Random random(111);
  MESSAGE("seed 111");
  int compared = 0;
  for (int i = 0; i < 32; ++i) {
    TriangleWeights weights;
    weights.area = i % 3;
    weights.dihedral = i % 4 == 3 ? 0 : 1;
    const uint32_t a = 4 + random.below(4), b = 3 + random.below(4);
    const double fraction = i % 2 == 0 ? 1 : i % 4 == 1 ? 0.7 : 0.4;
    Fixture f(randomLoops({a, b}, 0.7, random), weights, fraction, random);
    const Measure measure = i % 5 == 4 ? Measure::worst() : Measure::sum(weights.dihedral);
    if (measure.isWorst()) f.cost.assign(f.cost.size(), 0);
    SegmentTable segments;
    REQUIRE(segments.compute(f.loops, f.set, f.cost, measure, f.work));
    const Pass pass{f.loops, f.set, f.cost, measure, segments, f.work};
    // A root anywhere, in either loop, so that runs wrap around the ends of the numbering.
    const uint32_t root = random.below(a + b);
    if (f.set.loopEdges[root] == kNone) continue;
    CAPTURE(i);
    Domains domains(f.loops);
    RelaxedBound hashed(pass);
    REQUIRE(hashed.compute(domains.root(root), ~uint64_t(0)));
    TwoLoopBound arrays(pass, root);
    REQUIRE(arrays.compute(~uint64_t(0)));
    CHECK((arrays.rootBound() == hashed.rootBound() ||
           arrays.rootBound() == doctest::Approx(hashed.rootBound()).epsilon(1e-12)));
    walkDomains(pass, root, random, [&](Shape shape, uint32_t slot) {
      const double expected = hashed.value(shape, slot);
      // The hashed bound does not hold domains that no split of finite cost leads to.
      if (expected == kInfinity) return;
      CHECK(arrays.value(shape, slot) == doctest::Approx(expected).epsilon(1e-12));
      ++compared;
    });
  }
  CHECK(compared > 5000);
}

TEST_CASE(
    "two-loop bound: memory is given back, and what takes too much is refused before work begins") {
  Random random(112);
  TriangleWeights weights;
  weights.dihedral = 1;
  Fixture f(randomLoops({9, 8}, 0.5, random), weights, 1, random);
  SegmentTable segments;
  REQUIRE(segments.compute(f.loops, f.set, f.cost, Measure::sum(1), f.work));
  const size_t before = f.work.used();
  const Pass pass{f.loops, f.set, f.cost, Measure::sum(1), segments, f.work};
  {
    TwoLoopBound bound(pass, 0);
    REQUIRE(bound.compute(~uint64_t(0)));
    ExactSolver solver(pass, bound, 0);
    double cost;
    SplitOrder order;
    REQUIRE(solver.solve(kInfinity, cost, order));
    CHECK(bound.rootBound() <= cost * (1 + 1e-12));
    CHECK(order.size() == 17);
  }
  CHECK(f.work.used() == before);
  {
    TwoLoopBound tooLong(pass, 0);
    CHECK_FALSE(tooLong.compute(10));
    CHECK(tooLong.domainCount() == 0);
    CHECK(f.work.going());
  }
  CHECK(f.work.used() == before);
  Work little(1000, nullptr, nullptr);
  const Pass small{f.loops, f.set, f.cost, Measure::sum(1), segments, little};
  TwoLoopBound refused(small, 0);
  CHECK_FALSE(refused.compute(~uint64_t(0)));
  CHECK(little.status() == Status::TooLarge);
}
