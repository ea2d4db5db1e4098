// Surfaces found by cuts along bridges: valid whatever they begin from, and nearly always the best.
#include "loops/search/surface_search.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "base/sort.h"
#include "loops/solver.h"
#include "support/generators.h"
#include "support/surface.h"

using namespace sf;
using namespace sftest;

namespace {

struct Prepared {
  LoopSet loops;
  CandidateSet set;
  SpanOptions options;  // the weights, for the checker
};

Prepared prepared(const Curves& curves, double area, double dihedral) {
  Prepared p;
  p.loops = loopSet(curves);
  p.options.space = Space::All;
  p.options.areaWeight = area;
  p.options.dihedralWeight = dihedral;
  TriangleWeights weights;
  weights.area = area;
  weights.dihedral = dihedral;
  Work work;
  std::vector<uint32_t> triples;
  REQUIRE(allTriples(p.loops, work, triples));
  REQUIRE(buildCandidateSet(p.loops, weights, triples, work, p.set));
  return p;
}

/// Checks every surface that the search comes to.
class Judge final : public SurfaceListener {
 public:
  explicit Judge(const Prepared& p) : p_(p) {}
  void better(const SplitOrder& order, double lowerBound) override {
    CHECK(lowerBound == 0);
    std::vector<uint32_t> triangles;
    for (const uint32_t t : order)
      triangles.insert(triangles.end(), &p_.set.triangles[3 * size_t(t)],
                       &p_.set.triangles[3 * size_t(t)] + 3);
    const Span span = spanOf(p_.loops, p_.options, triangles);
    CHECK(spanFault(p_.loops, p_.options, span) == "");
    CHECK(span.cost < last);
    last = span.cost;
    ++count;
  }

  double last = kInfinity;
  int count = 0;

 private:
  const Prepared& p_;
};

double optimumOf(const Prepared& p) {
  SolveOptions solving;
  solving.dihedralWeight = p.options.dihedralWeight;
  solving.firstSplits = kUnlimited;
  Work work;
  Surface surface;
  REQUIRE(solveSurface(p.loops, p.set, solving, work, surface));
  return surface.found ? surface.lowerBound : kInfinity;
}

}  // namespace

TEST_CASE("surface search: valid surfaces of falling cost, hardly ever above the optimum") {
  Random random(301);
  MESSAGE("seed 301");
  const std::vector<std::vector<uint32_t>> sizes = {{4, 4}, {6, 5}, {8, 8}, {3, 4, 3}, {4, 4, 4}};
  int problems = 0, optimal = 0, surfaces = 0;
  for (int i = 0; i < 30; ++i) {
    const double area = i % 3 == 0 ? 1 : i % 3 == 1 ? 0.3 : 0, dihedral = i % 3 == 0 ? 0 : 1;
    const Prepared p =
        prepared(randomLoops(sizes[size_t(i) % sizes.size()], 1.2, random), area, dihedral);
    Work work;
    const Task task{p.loops, p.set, p.set.weight, Measure::sum(dihedral), work, true};
    Judge judge(p);
    Incumbent best(task.measure, &judge);
    {
      SurfaceSearch search(task, best);
      REQUIRE(search.search(150));
    }
    CHECK(work.used() == 0);
    const double optimum = optimumOf(p);
    CHECK((best.cost() == kInfinity || best.cost() >= optimum * (1 - 1e-12)));
    CHECK(best.cost() == doctest::Approx(judge.last).epsilon(1e-12));
    ++problems;
    surfaces += judge.count;
    optimal += best.cost() <= optimum * (1 + 1e-9);
  }
  MESSAGE(optimal << " of " << problems << " optimal, " << surfaces << " surfaces seen");
  CHECK(surfaces > 50);
  CHECK(4 * optimal > 3 * problems);
}

TEST_CASE("surface search: begins from the bridges of a surface that edits have made invalid") {
  Random random(302);
  MESSAGE("seed 302");
  Curves curves = regularSaddles(4, 8, random);
  const Prepared before = prepared(curves, 0, 1);
  Work work;
  const Task task{before.loops, before.set, before.set.weight, Measure::sum(1), work, true};
  Incumbent best(task.measure, nullptr);
  SurfaceSearch search(task, best);
  REQUIRE(search.search(80));
  REQUIRE(best.cost() < kInfinity);
  std::vector<uint32_t> triangles;
  for (const uint32_t t : best.order())
    triangles.insert(triangles.end(), &before.set.triangles[3 * size_t(t)],
                     &before.set.triangles[3 * size_t(t)] + 3);
  curves[1][3] = curves[1][3] + Vec3{0.05, -0.02, 0.04};
  const Prepared after = prepared(curves, 0, 1);
  const Task edited{after.loops, after.set, after.set.weight, Measure::sum(1), work, true};
  Incumbent found(edited.measure, nullptr);
  SurfaceSearch again(edited, found);
  REQUIRE(again.startFrom({after.loops, triangles}));
  CHECK(found.cost() < 1.3 * best.cost());
  // Whatever it is given, the search only begins there.
  for (uint32_t& v : triangles) v = random.below(32);
  REQUIRE(again.startFrom({after.loops, triangles}));
  CHECK(found.cost() < 1.3 * best.cost());
}

TEST_CASE("surface search: knows surfaces of the class from lists of candidates that are none") {
  Random random(303);
  MESSAGE("seed 303");
  int good = 0, bad = 0;
  for (int i = 0; i < 60; ++i) {
    const Prepared p = prepared(regularSaddles(2 + uint32_t(i) % 3, 5, random), 0, 1);
    Work work;
    const Task task{p.loops, p.set, p.set.weight, Measure::sum(1), work, true};
    Incumbent best(task.measure, nullptr);
    SurfaceSearch search(task, best);
    REQUIRE(search.search(20));
    if (best.cost() == kInfinity) continue;
    for (uint32_t changes = 0; changes < 4; ++changes) {
      SplitOrder order = best.order();
      for (uint32_t c = 0; c < changes; ++c)
        order[random.below(uint32_t(order.size()))] = random.below(uint32_t(p.set.size()));
      sf::sort(order.begin(), order.end());
      if (std::adjacent_find(order.begin(), order.end()) != order.end()) continue;
      const bool found = isSurface(p.loops, p.set, order);
      if (changes == 0) CHECK(found);
      if (found) {
        std::vector<uint32_t> triangles;
        for (const uint32_t t : order)
          triangles.insert(triangles.end(), &p.set.triangles[3 * size_t(t)],
                           &p.set.triangles[3 * size_t(t)] + 3);
        CHECK(spanFault(p.loops, p.options, spanOf(p.loops, p.options, triangles)) == "");
      }
      (found ? good : bad) += 1;
    }
    SplitOrder fewer = best.order();
    fewer.pop_back();
    CHECK_FALSE(isSurface(p.loops, p.set, fewer));
  }
  CHECK(good > 20);
  CHECK(bad > 20);
}
