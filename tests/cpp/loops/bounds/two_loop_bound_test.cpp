#include "loops/bounds/two_loop_bound.h"

#include <doctest/doctest.h>

#include <memory>

#include "loops/bounds/relaxed_bound.h"
#include "loops/domains/exact_solver.h"
#include "support/domains.h"
#include "support/generators.h"
#include "support/relaxed_oracle.h"

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

TEST_CASE("relaxed bound and two-loop bound: they say what the oracle does, for every domain") {
  Random random(111);
  MESSAGE("seed 111");
  int compared = 0, several = 0;
  for (int i = 0; i < 48; ++i) {
    TriangleWeights weights;
    weights.area = i % 3;
    weights.dihedral = i % 4 == 3 ? 0 : 1;
    const uint32_t a = 4 + random.below(4), b = 3 + random.below(4);
    std::vector<uint32_t> sizes{a, b};
    if (i % 3 == 2) sizes = {4 + random.below(2), 3, 3 + random.below(2)};
    if (i % 12 == 5) sizes = {3, 3, 3, 3};
    const double fraction = sizes.size() == 4 ? 0.3 : i % 2 == 0 ? 1 : i % 4 == 1 ? 0.7 : 0.4;
    Fixture f(randomLoops(sizes, 0.7, random), weights, fraction, random);
    const Measure measure = i % 5 == 4 ? Measure::worst() : Measure::sum(weights.dihedral);
    if (measure.isWorst()) f.cost.assign(f.cost.size(), 0);
    SegmentTable segments;
    REQUIRE(segments.compute(f.loops, f.set, f.cost, measure, f.work));
    const Pass pass{{f.loops, f.set, f.cost, measure, f.work}, segments};
    // A root anywhere, in any loop, so that runs wrap around the ends of the numbering.
    const uint32_t root = random.below(f.loops.vertexCount());
    if (f.set.loopEdges[root] == kNone) continue;
    CAPTURE(i);
    RelaxedOracle oracle(pass);
    const double atRoot = oracle.bound(root);
    const auto isLike = [](double found, double expected) {
      return found == expected || found == doctest::Approx(expected).epsilon(1e-12);
    };
    RelaxedBound relaxed(pass);
    REQUIRE(relaxed.compute(Domains(f.loops).root(root), ~uint64_t(0)));
    CHECK(isLike(relaxed.rootBound(), atRoot));
    CHECK(relaxed.domainCount() <= oracle.domainCount() + 1);
    std::unique_ptr<TwoLoopBound> two;
    if (sizes.size() == 2) {
      two = std::make_unique<TwoLoopBound>(pass, root);
      REQUIRE(two->compute(~uint64_t(0)));
      CHECK(isLike(two->rootBound(), atRoot));
    }
    walkDomains(pass, root, random, [&](Shape shape, uint32_t slot) {
      // Neither bound holds domains that no split of finite cost leads to.
      const bool isReached = oracle.holds(shape);
      const double expected = oracle.value(shape, slot), found = relaxed.value(shape, slot);
      if (isReached || found < kInfinity) CHECK(isLike(found, expected));
      if (!isReached) return;
      if (two) CHECK(isLike(two->value(shape, slot), expected));
      ++(two ? compared : several);
    });
  }
  CHECK(compared > 5000);
  CHECK(several > 5000);
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
  const Pass pass{{f.loops, f.set, f.cost, Measure::sum(1), f.work}, segments};
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
  const Pass small{{f.loops, f.set, f.cost, Measure::sum(1), little}, segments};
  TwoLoopBound refused(small, 0);
  CHECK_FALSE(refused.compute(~uint64_t(0)));
  CHECK(little.status() == Status::TooLarge);
}
