#include "loops/domains/exact_solver.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>

#include "loops/bounds/relaxed_bound.h"
#include "support/generators.h"

using namespace sf;
using namespace sftest;

namespace {

struct Fixture {
  LoopSet loops;
  Work work;
  CandidateSet set;
  SegmentTable segments;
  Measure measure;

  Fixture(const Curves& curves, double area, double dihedral)
      : loops(loopSet(curves)), measure(Measure::sum(dihedral)) {
    TriangleWeights weights;
    weights.area = area;
    std::vector<uint32_t> triples;
    REQUIRE(allTriples(loops, work, triples));
    REQUIRE(buildCandidateSet(loops, weights, triples, work, set));
    REQUIRE(segments.compute(loops, set, set.weight, measure, work));
  }
  Pass pass(Work& charged) const { return {{loops, set, set.weight, measure, charged}, segments}; }
};

/// R, lowered by a share of itself that differs from shape to shape: still a bound.
class LowerStill final : public LowerBound {
 public:
  LowerStill(LowerBound& bound, double least) : bound_(bound), least_(least) {}
  double value(Shape shape, uint32_t slot) override {
    uint32_t mixed = slot;
    for (const uint32_t word : shape) mixed = mixed * 31 + word;
    return (least_ + (1 - least_) * double(mixed % 97) / 97) * bound_.value(shape, slot);
  }
  double rootBound() const override { return least_ * bound_.rootBound(); }

 private:
  LowerBound& bound_;
  double least_;
};

struct Solved {
  double cost = 0;
  SplitOrder order;
  uint64_t domains = 0, minimalSets = 0;
};

Solved solved(const Pass& pass, LowerBound& bound, uint32_t root, int lazyRounds) {
  Solved result;
  ExactSolver solver(pass, bound, root, lazyRounds);
  REQUIRE(solver.solve(kInfinity, result.cost, result.order));
  result.domains = solver.domainCount();
  result.minimalSets = solver.minimalSetCount();
  return result;
}

/// How many edges of the triangles are closed once too often, or not at all.
int wrongEdges(const Fixture& f, const SplitOrder& order) {
  std::map<uint32_t, uint32_t> uses;
  for (const uint32_t t : order)
    for (int i = 0; i < 3; ++i) ++uses[f.set.triangleEdges[3 * size_t(t) + i]];
  int wrong = 0;
  for (const auto& [edge, count] : uses) wrong += count != (f.set.isLoopEdge[edge] ? 1u : 2u);
  for (const uint32_t edge : f.set.loopEdges) wrong += !uses.count(edge);
  return wrong;
}

Curves someLoops(int i, Random& random) {
  return i % 3 == 0   ? randomLoops({4, 3, 3}, 0.6, random)
         : i % 3 == 1 ? randomLoops({5, 4}, 0.2, random)
                      : randomLoops({4, 4}, 0.1, random);
}

}  // namespace

TEST_CASE(
    "exact solver: the rounds before all edges are tracked change neither cost nor validity") {
  Random random(131);
  MESSAGE("seed 131");
  int repeated = 0;
  for (int i = 0; i < 36; ++i) {
    Fixture f(someLoops(i, random), i % 4 == 3 ? 0 : 1, i % 4 == 1 ? 0 : 0.3);
    const Pass pass = f.pass(f.work);
    const uint32_t root = random.below(f.loops.vertexCount());
    RelaxedBound bound(pass);
    REQUIRE(bound.compute(Domains(f.loops).root(root), ~uint64_t(0)));
    const Solved all = solved(pass, bound, root, 0);
    const Solved one = solved(pass, bound, root, 1), usual = solved(pass, bound, root, kLazyRounds);
    CAPTURE(i);
    CHECK(one.cost == doctest::Approx(all.cost).epsilon(1e-12));
    CHECK(usual.cost == doctest::Approx(all.cost).epsilon(1e-12));
    for (const Solved* s : {&all, &one, &usual}) {
      CHECK(wrongEdges(f, s->order) == 0);
      CHECK(s->order.size() == f.loops.vertexCount() + 2 * f.loops.loopCount() - 4);
    }
    // They count the same unless the first round's optimum is no manifold.
    repeated += one.domains != usual.domains || one.minimalSets != usual.minimalSets;
  }
  CHECK(repeated > 5);
}

TEST_CASE(
    "exact solver: any bound that is one gives the same optimum, a better one fewer domains") {
  Random random(132);
  MESSAGE("seed 132");
  uint64_t tight = 0, loose = 0;
  for (int i = 0; i < 9; ++i) {
    Fixture f(someLoops(i, random), 1, 0.3);
    const Pass pass = f.pass(f.work);
    RelaxedBound bound(pass);
    REQUIRE(bound.compute(Domains(f.loops).root(0), ~uint64_t(0)));
    LowerStill lower(bound, 0.7);
    const Solved expected = solved(pass, bound, 0, kLazyRounds);
    const Solved got = solved(pass, lower, 0, kLazyRounds);
    CAPTURE(i);
    CHECK(got.cost == doctest::Approx(expected.cost).epsilon(1e-12));
    CHECK(wrongEdges(f, got.order) == 0);
    tight += expected.domains, loose += got.domains;
  }
  CHECK(loose > 2 * tight);
}

TEST_CASE("exact solver: each triangle but the first shares an edge with an earlier one") {
  Random random(133);
  MESSAGE("seed 133");
  for (int i = 0; i < 12; ++i) {
    Fixture f(someLoops(i, random), 1, 0.3);
    const Pass pass = f.pass(f.work);
    RelaxedBound bound(pass);
    REQUIRE(bound.compute(Domains(f.loops).root(0), ~uint64_t(0)));
    const Solved result = solved(pass, bound, 0, kLazyRounds);
    std::vector<uint32_t> edges;
    for (const uint32_t t : result.order) {
      bool touches = edges.empty();
      for (int j = 0; j < 3; ++j) {
        const uint32_t edge = f.set.triangleEdges[3 * size_t(t) + j];
        touches |= std::find(edges.begin(), edges.end(), edge) != edges.end();
      }
      CHECK(touches);
      edges.insert(edges.end(), &f.set.triangleEdges[3 * size_t(t)],
                   &f.set.triangleEdges[3 * size_t(t)] + 3);
    }
    // The root's triangle comes first.
    CHECK(std::count(edges.begin(), edges.begin() + 3, f.set.loopEdges[0]) == 1);
  }
}

TEST_CASE("exact solver: what it charges it gives back, and it ends with the work") {
  Random random(134);
  Fixture f(randomLoops({4, 4, 3}, 0.4, random), 1, 0.3);
  const Pass free = f.pass(f.work);
  RelaxedBound relaxed(free);
  REQUIRE(relaxed.compute(Domains(f.loops).root(0), ~uint64_t(0)));
  const auto tryWith = [&](Work& work) {
    const Pass pass = f.pass(work);
    ExactSolver solver(pass, relaxed, 0, 0);
    double cost;
    SplitOrder order;
    return solver.solve(kInfinity, cost, order);
  };
  Work enough;
  CHECK(tryWith(enough));
  CHECK(enough.used() == 0);
  CHECK(enough.peak() > 10000);
  Work little(size_t(enough.peak() / 2), nullptr, nullptr);
  CHECK_FALSE(tryWith(little));
  CHECK(little.status() == Status::OutOfMemory);
  CHECK(little.used() == 0);
  Work stopped(
      size_t(-1), [](void*, double, double, double) { return false; }, nullptr);
  CHECK_FALSE(tryWith(stopped));
  CHECK(stopped.status() == Status::Stopped);
  CHECK(stopped.used() == 0);
}
