#include "loops/bounds/focused_bound.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "loops/bounds/direct_solver.h"
#include "loops/bounds/fan_bound.h"
#include "loops/bounds/relaxed_bound.h"
#include "loops/search/bridge_cut.h"
#include "support/domains.h"
#include "support/generators.h"

using namespace sf;
using namespace sftest;

namespace {

/// A pass over some loops, with what fans tell of it and R to compare with.
struct Fixture {
  Fixture(const Curves& curves, const TriangleWeights& weights, double cap, Random& random)
      : loops(loopSet(curves)), measure(Measure::sum(weights.dihedral, cap)) {
    std::vector<uint32_t> all, triples;
    REQUIRE(allTriples(loops, work, all));
    for (size_t i = 0; i < all.size(); i += 3)
      if (random.unit() < 0.8) triples.insert(triples.end(), &all[i], &all[i] + 3);
    REQUIRE(buildCandidateSet(loops, weights, triples, work, set));
    hasRoot = std::count(set.loopEdges.begin(), set.loopEdges.end(), kNone) == 0;
    REQUIRE(segments.compute(loops, set, set.weight, measure, work));
    least = leastPairs(set, measure);
  }
  /// The optimum at weights that are off by up to `noise`: some surface, unless its cost is infinite.
  Optimum someSurface(double noise, Random& random) {
    std::vector<double> cost = set.weight;
    for (double& w : cost) w += noise * random.unit();
    Optimum optimum;
    SolverCounts counts;
    const Task task{loops, set, cost, measure, work, false};
    REQUIRE(solveDirectly(task, kUnlimited, kInfinity, optimum, counts));
    return optimum;
  }
  double costOf(const SplitOrder& order) {
    double cost = 0;
    for (const uint32_t t : order) cost += set.weight[t];
    const std::vector<EdgeUse> uses = edgeUses(set, order);
    for (size_t i = 0; i + 1 < uses.size(); ++i)
      if (uses[i].edge == uses[i + 1].edge)
        cost += measure.pair(set.slotTheta[set.slotAt(uses[i].triangle, uses[i].edge)],
                             set.slotTheta[set.slotAt(uses[i + 1].triangle, uses[i].edge)]);
    return cost;
  }
  Pass pass() { return {{loops, set, set.weight, measure, work}, segments}; }

  LoopSet loops;
  Measure measure;
  Work work;
  CandidateSet set;
  SegmentTable segments;
  std::vector<double> least;
  bool hasRoot = false;
};

/// Four loops take a hundred times as long as two.
Curves someLoops(int i, Random& random) {
  return i % 4 == 0   ? randomLoops({5, 4}, 0.8, random)
         : i % 8 == 2 ? randomLoops({3, 3, 3, 3}, 1, random)
         : i % 4 == 3 ? regularSaddles(3, 4, random)
                      : randomLoops({4, 3, 3}, 1, random);
}

/// How many surfaces to take of a problem: those of four loops have many more domains.
int surfaceCount(const Fixture& f) { return f.loops.loopCount() > 3 ? 4 : 12; }

template <class Check>
void forProblems(uint32_t seed, int count, Check&& check) {
  Random random(seed);
  MESSAGE("seed ", seed);
  for (int i = 0; i < count; ++i) {
    TriangleWeights weights;
    weights.dihedral = i % 5 == 4 ? 0 : 1;
    weights.area = i % 3 || i % 5 == 4;
    Fixture f(someLoops(i, random), weights, i % 7 == 6 ? 2.5 : kInfinity, random);
    FanBound fans(f.loops, f.set, f.set.weight, f.measure, f.work);
    REQUIRE(fans.ascend(i % 2 ? 5 : 80, kInfinity));
    if (!f.hasRoot || fans.lowerBound() == kInfinity) continue;
    CAPTURE(i);
    const uint64_t before = f.work.used();
    {
      FanEstimate estimate(f.loops, fans.links(), f.least, f.measure, fans.costs(), f.work);
      REQUIRE(estimate.compute());
      check(f, estimate, random);
    }
    CHECK(f.work.used() == before);
  }
}

}  // namespace

TEST_CASE("fan estimate: no domain of any surface costs less, and many not much more") {
  int compared = 0, near = 0;
  forProblems(131, 42, [&](Fixture& f, FanEstimate& estimate, Random& random) {
    const Pass pass = f.pass();
    const uint32_t root = random.below(f.loops.vertexCount());
    for (int i = 0; i < surfaceCount(f); ++i) {
      const Optimum surface = f.someSurface(random.range(0, 2), random);
      if (surface.cost == kInfinity) return;
      const std::vector<FilledDomain> domains = domainsOf(pass, root, surface.order);
      CHECK(!domains.empty());
      for (const FilledDomain& domain : domains) {
        const double least = estimate.value(domain.shape, domain.accessSlot);
        CHECK(least <= domain.cost + 1e-9);
        ++compared;
        near += least > 0.8 * domain.cost;
      }
    }
  });
  CHECK(compared > 2000);
  CHECK(4 * near > compared);
}

TEST_CASE("fan estimate: knows how many triangles fill a domain") {
  forProblems(132, 12, [&](Fixture& f, FanEstimate& estimate, Random& random) {
    const Pass pass = f.pass();
    Domains domains(f.loops);
    const uint32_t total = f.loops.vertexCount() + 2 * f.loops.loopCount() - 4;
    CHECK(estimate.triangleCount(domains.root(0)) == total);
    walkDomains(pass, 0, random, [&](Shape shape, uint32_t slot) {
      // Each split takes one triangle, and hands the others on.
      const uint32_t count = estimate.triangleCount(shape);
      domains.forEachSplit(shape, f.set.slotApex[slot], [&](const Split& split) {
        uint32_t parts = 0;
        for (uint32_t p = 0; p < split.partCount; ++p)
          if (split.part[p].kind == PartKind::Domain || split.part[p].kind == PartKind::Segment)
            parts += estimate.triangleCount(split.part[p].shape);
        CHECK(parts + 1 == count);
        return true;
      });
    });
  });
}

TEST_CASE(
    "focused bound: no less than R within the limit, and nothing of cheap surfaces is left out") {
  int within = 0, left = 0, kept = 0;
  forProblems(133, 42, [&](Fixture& f, FanEstimate& estimate, Random& random) {
    const Pass pass = f.pass();
    const uint32_t root = random.below(f.loops.vertexCount());
    const std::vector<uint32_t> shape = Domains(f.loops).root(root);
    RelaxedBound relaxed(pass);
    REQUIRE(relaxed.compute(shape, kUnlimited));
    const Optimum best = f.someSurface(0, random);
    if (best.cost == kInfinity) return;
    FocusedBound focused(pass, f.least, estimate);
    const double from = estimate.lowerBound(), to = best.cost * random.range(1, 1.2);
    uint64_t splits = kUnlimited;
    for (int step = 1; step <= 3; ++step) {
      const double most = from + (to - from) * step / 3 + 1e-9;
      REQUIRE(focused.compute(shape, most, splits));
      CHECK(focused.rootBound() <= best.cost + 1e-9);
      CHECK(focused.rootBound() >= std::min(relaxed.rootBound(), most) - 1e-9);
      walkDomains(pass, root, random, [&](Shape domain, uint32_t slot) {
        const double expected = relaxed.value(domain, slot), got = focused.value(domain, slot);
        if (got == kInfinity) return void(++left);
        CHECK(got >= std::min(expected, focused.limit(domain, slot)) - 1e-9);
        ++within;
      });
    }
    for (int i = 0; i < surfaceCount(f); ++i) {
      const Optimum surface = f.someSurface(i ? random.range(0, 0.5) : 0, random);
      const double cost = f.costOf(surface.order);
      if (cost > to) continue;
      for (const FilledDomain& domain : domainsOf(pass, root, surface.order)) {
        CHECK(focused.value(domain.shape, domain.accessSlot) <= domain.cost + 1e-9);
        CHECK(focused.limit(domain.shape, domain.accessSlot) >= domain.cost - 1e-9);
        ++kept;
      }
    }
    CHECK(focused.domainCount() <= relaxed.domainCount());
  });
  CHECK(within > 1000);
  CHECK(left > 1000);
  CHECK(kept > 1000);
}

TEST_CASE("focused bound: stops when its splits are used up, or the memory") {
  forProblems(134, 8, [&](Fixture& f, FanEstimate& estimate, Random&) {
    const Pass pass = f.pass();
    const std::vector<uint32_t> shape = Domains(f.loops).root(0);
    {
      FocusedBound focused(pass, f.least, estimate);
      uint64_t splits = 3;
      CHECK(!focused.compute(shape, 1e3, splits));
      CHECK(f.work.going());
    }
    Work small(2000, nullptr, nullptr);
    const Pass narrow{{f.loops, f.set, f.set.weight, f.measure, small}, f.segments};
    {
      FocusedBound focused(narrow, f.least, estimate);
      uint64_t splits = kUnlimited;
      CHECK(!focused.compute(shape, 1e3, splits));
      CHECK(small.status() == Status::OutOfMemory);
    }
    CHECK(small.used() == 0);
  });
}

TEST_CASE("solve within: the optimum if it is cheap enough, else the proof that none is") {
  int found = 0, none = 0;
  forProblems(135, 42, [&](Fixture& f, FanEstimate& estimate, Random& random) {
    const Task task{f.loops, f.set, f.set.weight, f.measure, f.work, false};
    Optimum whole, part;
    SolverCounts counts;
    REQUIRE(solveDirectly(task, kUnlimited, kInfinity, whole, counts));
    if (whole.cost == kInfinity) return;
    const bool enough = random.below(2) == 0;
    const double most = enough
                            ? whole.cost * random.range(1, 1.3)
                            : estimate.lowerBound() + 0.99 * (whole.cost - estimate.lowerBound());
    REQUIRE(solveWithin(task, estimate, f.least, most, kUnlimited, part, counts));
    CHECK(part.reached);
    CHECK(part.lowerBound <= whole.cost + 1e-9);
    if (enough) {
      CHECK(part.cost == doctest::Approx(whole.cost).epsilon(1e-11));
      ++found;
    } else {
      CHECK(part.cost >= whole.cost * (1 - 1e-11));
      none += part.cost == kInfinity;
    }
  });
  CHECK(found > 10);
  CHECK(none > 5);
}
