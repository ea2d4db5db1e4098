#include "loops/spaces/near_space.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "loops/one_loop/polygon_solver.h"
#include "loops/problem/weight.h"
#include "loops/spaces/polygon_chart.h"
#include "loops/span.h"
#include "support/cases.h"
#include "support/generators.h"
#include "support/surface.h"

using namespace sf;
using namespace sftest;

namespace {

std::vector<PolygonChart::Corner> cornersOf(const LoopSet& loops) {
  std::vector<PolygonChart::Corner> corners;
  for (uint32_t v = 0; v < loops.vertexCount(); ++v) corners.push_back({v, false, {}});
  return corners;
}

/// Sum over triangles and inner edges, by normals alone; and how far the chart's angles may be off.
struct Cost {
  double sum, allowance;
};
Cost costOf(const LoopSet& loops, const std::vector<PolygonChart::Triangle>& surface,
            const TriangleWeights& w) {
  const auto normal = [&](const PolygonChart::Triangle& t) {
    const Vec3 p = loops.position(t.corner[0]);
    return cross(loops.position(t.corner[1]) - p, loops.position(t.corner[2]) - p);
  };
  double sum = 0, allowance = 1e-4;
  for (size_t i = 0; i < surface.size(); ++i) {
    sum += 0.5 * w.area * length(normal(surface[i]));
    for (size_t j = 0; j < i; ++j) {
      int shared = 0;
      for (const uint32_t a : surface[i].corner)
        for (const uint32_t b : surface[j].corner) shared += a == b;
      if (shared != 2) continue;
      const double angle = angleBetween(normal(surface[i]), normal(surface[j]));
      sum += w.dihedral * angle;
      allowance += w.dihedral * (angle < 2.6 ? 0.011 : 0.3);
    }
  }
  return {sum, allowance};
}

double spanCost(const Curves& curves, Space space, double area, double dihedral) {
  Problem problem;
  problem.curves = curves;
  problem.options.areaWeight = area;
  problem.options.dihedralWeight = dihedral;
  problem.options.space = space;
  const Answer answer = solve(problem);
  REQUIRE(answer.outcome.ok());
  return answer.span.found ? answer.span.cost : kInfinity;
}

}  // namespace

TEST_CASE("polygon chart: its best surface costs what it says, and no less than the optimum") {
  MESSAGE("seeds 61000 to 61029");
  for (uint32_t seed = 61000; seed < 61030; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const LoopSet loops = loopSet(randomLoops({4 + random.below(30)}, 0, random));
    TriangleWeights weights;
    weights.area = random.chance(0.5) ? 1 : 0;
    weights.dihedral = weights.area == 0 || random.chance(0.7) ? 1 : 0;
    Work work;
    PolygonChart chart(loops, weights, work);
    REQUIRE(chart.compute(cornersOf(loops)));
    std::vector<PolygonChart::Triangle> surface;
    chart.trace(surface);
    REQUIRE(surface.size() == loops.vertexCount() - 2);
    const auto [cost, allowance] = costOf(loops, surface, weights);
    CHECK(std::fabs(chart.best() - cost) < allowance);
    PolygonSurface optimum;
    REQUIRE(solvePolygon(loops, weights, Objective::Sum, work, optimum));
    CHECK(cost >= optimum.lowerBound * (1 - 1e-9));
    CHECK(cost <= optimum.lowerBound * 1.1);
  }
}

TEST_CASE("polygon chart: near triangles hold the best surface, by increasing excess") {
  Random random(62);
  MESSAGE("seed 62");
  const LoopSet loops = loopSet(randomLoops({40}, 0, random));
  TriangleWeights weights;
  weights.dihedral = 1;
  Work work;
  PolygonChart chart(loops, weights, work);
  REQUIRE(chart.compute(cornersOf(loops)));
  std::vector<PolygonChart::Triangle> surface, few, many;
  chart.trace(surface);
  chart.nearBest(1e-4 * chart.best(), 1000, few);
  chart.nearBest(0.2 * chart.best(), 100000, many);
  CHECK(few.size() < many.size());
  for (const PolygonChart::Triangle& t : surface) {
    const auto isSame = [&](const PolygonChart::Triangle& o) {
      return std::equal(t.corner, t.corner + 3, o.corner);
    };
    CHECK(std::any_of(few.begin(), few.end(), isSame));
  }
  for (const PolygonChart::Triangle& t : many) CHECK(double(t.excess) <= 0.2 * chart.best());
  chart.nearBest(0.2 * chart.best(), 50, few);
  CHECK(few.size() == 50);
}

TEST_CASE("near space: near the optimum over all triples, and no dearer than the facets") {
  MESSAGE("seeds 63000 to 63019");
  double ratios = 0;
  int count = 0, close = 0;
  for (uint32_t seed = 63000; seed < 63020; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const bool two = seed % 2 == 1;
    const Curves curves = two ? randomLoops({6 + random.below(4), 6 + random.below(4)}, 0.5, random)
                              : Curves{noisyCircle(20 + random.below(30), 0.3, random)};
    if (loopsMeet(curves)) continue;
    const double dihedral = seed % 4 < 2 ? 1 : 0.1, area = seed % 4 < 2 ? 0 : 1;
    const double all = spanCost(curves, Space::All, area, dihedral);
    const double near = spanCost(curves, Space::Near, area, dihedral);
    CHECK(near >= all * (1 - 1e-9));
    ratios += near / all;
    close += near <= 1.02 * all;
    ++count;
  }
  REQUIRE(count > 10);
  CHECK(close >= count - 1);
  CHECK(ratios <= 1.02 * count);
}

TEST_CASE("near space: a long noisy loop, whose chart keeps some of the segments only") {
  Random random(64);
  MESSAGE("seed 64");
  const Curves curves = {noisyCircle(700, 0.01, random)};
  const double near = spanCost(curves, Space::Near, 0, 1);
  const double facets = spanCost(curves, Space::Delaunay, 0, 1);
  CHECK(near < kInfinity);
  CHECK(near < facets);
}

TEST_CASE("near space: three loops and far too many vertices are left to wider spaces") {
  Random random(65);
  const Work work;
  CHECK(hasNearOptimalTriples(loopSet(randomLoops({9}, 0, random)), work));
  CHECK(hasNearOptimalTriples(loopSet(randomLoops({9, 9}, 1, random)), work));
  CHECK_FALSE(hasNearOptimalTriples(loopSet(randomLoops({5, 5, 5}, 2, random)), work));
  CHECK_FALSE(hasNearOptimalTriples(loopSet({circle(5000)}), work));
  const Work little(1000, nullptr, nullptr);
  CHECK_FALSE(hasNearOptimalTriples(loopSet(randomLoops({40}, 0, random)), little));
}

TEST_CASE(
    "near space: one loop without angles takes all triples, with the best so far or without") {
  Random random(67);
  MESSAGE("seed 67");
  Problem problem;
  problem.curves = {noisyCircle(320, 0.05, random)};
  problem.options.areaWeight = 1;
  problem.options.dihedralWeight = 0;
  double cost[2];
  for (const bool bestSoFar : {false, true}) {
    problem.options.space = Space::Near;
    problem.options.bestSoFar = bestSoFar;
    const Answer answer = solve(problem);
    REQUIRE(answer.outcome.ok());
    REQUIRE(answer.span.found);
    CHECK(answer.span.space == Space::All);
    CHECK(answer.span.optimal);
    cost[bestSoFar] = answer.span.cost;
  }
  CHECK(cost[0] == cost[1]);
}

TEST_CASE("near space: two loops without angles, apart or close, come near the optimum") {
  Random random(68);
  MESSAGE("seed 68");
  int good = 0;
  const int count = 30;
  for (int i = 0; i < count; ++i) {
    CAPTURE(i);
    Problem problem;
    problem.curves = randomLoops({8 + random.below(5), 8 + random.below(5)}, 0.3, random);
    const Vec3 apart = (0.1 * (i % 10)) * random.inCube(1);
    for (Vec3& p : problem.curves[1]) p = p + apart;
    problem.options.areaWeight = 1;
    problem.options.perimeterWeight = i % 3 == 0 ? 0.1 : 0;
    problem.options.dihedralWeight = 0;
    problem.options.space = Space::All;
    const Answer all = solve(problem);
    problem.options.space = Space::Near;
    const Answer near = solve(problem);
    REQUIRE(all.outcome.ok());
    REQUIRE(near.outcome.ok());
    REQUIRE(near.span.found);
    CHECK(near.span.space == Space::Near);
    CHECK(spanFault(loopSet(problem.curves), problem.options, near.span) == "");
    CHECK(near.span.cost >= all.span.cost * (1 - 1e-9));
    good += near.span.cost <= 1.02 * all.span.cost;
  }
  CHECK(good >= count * 95 / 100);
}

TEST_CASE("auto: facets where a large loop is smooth, near triples where it is rough or smaller") {
  Random random(69);
  MESSAGE("seed 69");
  const std::pair<uint32_t, double> cases[] = {{1200, 0.0}, {1200, 0.02}, {450, 0.0}};
  for (const auto& [n, noise] : cases) {
    CAPTURE(n);
    CAPTURE(noise);
    Curve curve = monkeySaddle(n);
    for (Vec3& p : curve) p = p + random.inCube(noise);
    Problem problem;
    problem.curves = {curve};
    problem.options.space = Space::Auto;
    const Answer chosen = solve(problem);
    REQUIRE(chosen.outcome.ok());
    REQUIRE(chosen.span.found);
    CHECK(chosen.span.space == (n > 1000 && noise == 0 ? Space::Delaunay : Space::Near));
    problem.options.space = Space::Delaunay;
    const Answer facets = solve(problem);
    REQUIRE(facets.outcome.ok());
    if (facets.span.found) CHECK(chosen.span.cost <= facets.span.cost * (1 + 1e-12));
  }
}

TEST_CASE("near space: the work ends when told to") {
  Random random(66);
  const LoopSet loops = loopSet({noisyCircle(300, 0.1, random)});
  TriangleWeights weights;
  weights.dihedral = 1;
  const auto stop = [](void*, double, double, double) { return false; };
  Work work(size_t(1) << 30, stop, nullptr);
  std::vector<uint32_t> triples;
  std::vector<BridgeTrial> trials;
  CHECK_FALSE(nearOptimalTriples(LoopTriangles(loops), weights, work, trials, triples));
  CHECK(work.status() == Status::Stopped);
}
