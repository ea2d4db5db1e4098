#include "loops/two_loop_bound.h"

#include <doctest/doctest.h>

#include "loops/exact_solver.h"
#include "loops/relaxed_bound.h"
#include "support/generators.h"

using namespace sf;
using namespace sftest;

namespace {

struct Fixture {
  LoopSet loops;
  Work work;
  CandidateSet set;
  std::vector<double> cost;

  Fixture(const Curves& curves, const TriangleWeights& weights, Random* drop)
      : loops(loopSet(curves)) {
    std::vector<uint32_t> triples, kept;
    REQUIRE(allTriples(loops, work, triples));
    for (size_t t = 0; t < triples.size(); t += 3)
      if (!drop || drop->chance(0.7)) kept.insert(kept.end(), &triples[t], &triples[t] + 3);
    REQUIRE(buildCandidateSet(loops, weights, kept, work, set));
    cost = set.weight;
  }
};

/// Whether v lies on a segment of the domain, not at an end of it: no triangle outside has its apex there.
bool isInside(const LoopSet& loops, const Domains& domains, Shape shape, uint32_t v) {
  for (uint32_t i = 0; i < domains.segmentCount(shape); ++i) {
    const Segment s = domains.segment(shape, i);
    uint32_t at = s.start;
    do {
      at = s.reversed ? loops.previous(at) : loops.next(at);
      if (at == v && at != s.end && at != s.start) return !s.isVertex();
    } while (at != s.end && at != s.start);
  }
  return false;
}

}  // namespace

TEST_CASE("two-loop bound: the same numbers as the bound over hashed domains, for every domain") {
  Random random(111);
  MESSAGE("seed 111");
  int compared = 0;
  for (int i = 0; i < 24; ++i) {
    TriangleWeights weights;
    weights.area = i % 3;
    weights.dihedral = i % 4 == 3 ? 0 : 1;
    const uint32_t a = 4 + random.below(4), b = 3 + random.below(4);
    Fixture f(randomLoops({a, b}, 0.7, random), weights, i % 2 ? &random : nullptr);
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
    TwoLoopBound dense(pass, root);
    REQUIRE(dense.compute());
    CHECK((dense.rootBound() == hashed.rootBound() ||
           dense.rootBound() == doctest::Approx(hashed.rootBound()).epsilon(1e-12)));
    // Down random splits from the root.
    for (int walk = 0; walk < 60; ++walk) {
      std::vector<uint32_t> shape = domains.root(root);
      for (int depth = 0; depth < 12; ++depth) {
        const uint32_t m = domains.segmentCount(shape);
        const uint32_t edge =
            f.set.edgeBetween(domains.spanStart(shape, m - 1), domains.spanEnd(shape, m - 1));
        if (edge == kNone) break;
        if (depth > 0) {
          for (uint32_t s = f.set.edgeSlots[edge]; s < f.set.edgeSlots[edge + 1]; ++s) {
            const double expected = hashed.value(shape, s), got = dense.value(shape, s);
            // The hashed bound does not hold domains that no split of finite cost leads to.
            if (expected == kInfinity || isInside(f.loops, domains, shape, f.set.slotApex[s]))
              continue;
            CHECK(got == doctest::Approx(expected).epsilon(1e-12));
            ++compared;
          }
        }
        std::vector<std::vector<uint32_t>> parts;
        for (uint32_t s = f.set.edgeSlots[edge]; s < f.set.edgeSlots[edge + 1]; ++s)
          domains.forEachSplit(shape, f.set.slotApex[s], [&](const Split& split) {
            for (uint32_t p = 0; p < split.partCount; ++p)
              if (split.part[p].kind == PartKind::Domain) parts.push_back(split.part[p].shape);
            return true;
          });
        if (parts.empty()) break;
        shape = parts[random.below(uint32_t(parts.size()))];
        domains.makeCanonical(shape);
      }
    }
  }
  CHECK(compared > 5000);
}

TEST_CASE("two-loop bound: memory is given back, and a small limit refused before work begins") {
  Random random(112);
  TriangleWeights weights;
  weights.dihedral = 1;
  Fixture f(randomLoops({9, 8}, 0.5, random), weights, nullptr);
  SegmentTable segments;
  REQUIRE(segments.compute(f.loops, f.set, f.cost, Measure::sum(1), f.work));
  const size_t before = f.work.used();
  const Pass pass{f.loops, f.set, f.cost, Measure::sum(1), segments, f.work};
  {
    TwoLoopBound bound(pass, 0);
    REQUIRE(bound.compute());
    ExactSolver solver(pass, bound, 0);
    double cost;
    SplitOrder order;
    REQUIRE(solver.solve(cost, order));
    CHECK(bound.rootBound() <= cost * (1 + 1e-12));
    CHECK(order.size() == 17);
  }
  CHECK(f.work.used() == before);
  Work little(1000, nullptr, nullptr);
  const Pass small{f.loops, f.set, f.cost, Measure::sum(1), segments, little};
  TwoLoopBound refused(small, 0);
  CHECK_FALSE(refused.compute());
  CHECK(little.status() == Status::TooLarge);
}
