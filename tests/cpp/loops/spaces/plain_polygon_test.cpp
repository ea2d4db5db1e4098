#include "loops/spaces/plain_polygon.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "loops/one_loop/polygon_solver.h"
#include "loops/problem/weight.h"
#include "support/generators.h"

using namespace sf;
using namespace sftest;

namespace {

std::vector<uint32_t> allOf(const LoopSet& loops) {
  std::vector<uint32_t> vertices(loops.vertexCount());
  std::iota(vertices.begin(), vertices.end(), 0u);
  return vertices;
}

TriangleWeights area() {
  TriangleWeights w;
  w.area = 1;
  return w;
}

/// Random loops, and the polygon over all their vertices in order.
struct Solved {
  LoopSet loops;
  TripleWeights weights;
  PlainPolygon polygon;
  explicit Solved(LoopSet given, const TriangleWeights& w = area())
      : loops(std::move(given)), weights(loops, w), polygon(loops, weights) {
    polygon.compute(allOf(loops));
  }
  Solved(const Solved&) = delete;
};

double sumOf(const std::vector<uint32_t>& triples, const TripleWeights& weights) {
  double sum = 0;
  for (size_t i = 0; i < triples.size(); i += 3)
    sum += weights(triples[i], triples[i + 1], triples[i + 2]);
  return sum;
}

/// The least cost of the polygon over the vertices from `first` on, by trying all apexes.
double leastByTrying(const std::vector<uint32_t>& vertices, uint32_t first, uint32_t steps,
                     const TripleWeights& weights) {
  if (steps < 2) return 0;
  const auto at = [&](uint32_t i) { return vertices[(first + i) % vertices.size()]; };
  double least = kInfinity;
  for (uint32_t k = 1; k < steps; ++k)
    least = std::min(least, leastByTrying(vertices, first, k, weights) +
                                leastByTrying(vertices, first + k, steps - k, weights) +
                                weights(at(0), at(k), at(steps)));
  return least;
}

}  // namespace

TEST_CASE("plain polygon: its best surface is the optimum over all triples") {
  Random random(81);
  MESSAGE("seed 81");
  for (int i = 0; i < 20; ++i) {
    TriangleWeights w = area();
    w.perimeter = i % 2;
    const Solved solved(loopSet(randomLoops({4 + random.below(30)}, 1, random)), w);
    const auto& [loops, weights, polygon] = solved;
    Work work;
    PolygonSurface optimum;
    REQUIRE(solvePolygon(loops, w, Objective::Sum, work, optimum));
    CHECK(polygon.best() == doctest::Approx(sumOf(optimum.triangles, weights)));
    std::vector<uint32_t> traced;
    polygon.trace(0, polygon.size() - 1, traced);
    CHECK(traced.size() == 3 * (size_t(loops.vertexCount()) - 2));
    CHECK(sumOf(traced, weights) == doctest::Approx(polygon.best()));
  }
}

TEST_CASE("plain polygon: every segment has its optimum, on either side") {
  Random random(82);
  MESSAGE("seed 82");
  const Solved solved(loopSet(randomLoops({9}, 1, random)));
  const auto& [loops, weights, polygon] = solved;
  const std::vector<uint32_t> vertices = allOf(loops);
  for (uint32_t first = 0; first < 9; ++first)
    for (uint32_t steps = 1; steps < 9; ++steps)
      CHECK(polygon.cost(first, (first + steps) % 9) ==
            doctest::Approx(leastByTrying(vertices, first, steps, weights)));
}

TEST_CASE(
    "plain polygon: near triangles are those of surfaces within the limit, the cheapest ones") {
  Random random(83);
  MESSAGE("seed 83");
  const Solved solved(loopSet(randomLoops({14}, 1, random)));
  const TripleWeights& weights = solved.weights;
  const PlainPolygon& polygon = solved.polygon;
  const auto through = [&](const uint32_t* t) {
    return polygon.cost(t[0], t[1]) + polygon.cost(t[1], t[2]) + polygon.cost(t[2], t[0]) +
           weights(t[0], t[1], t[2]);
  };
  const double limit = 1.2 * polygon.best();
  std::vector<uint32_t> all, few;
  polygon.nearBest(limit, 1000, all);
  size_t expected = 0;
  for (uint32_t i = 0; i < 14; ++i)
    for (uint32_t j = i + 1; j < 14; ++j)
      for (uint32_t k = j + 1; k < 14; ++k) {
        const uint32_t t[3] = {i, j, k};
        expected += through(t) <= limit;
      }
  CHECK(all.size() == 3 * expected);
  REQUIRE(expected > 15);
  polygon.nearBest(limit, 15, few);
  REQUIRE(few.size() == 45);
  double dearest = 0;
  for (size_t i = 0; i < few.size(); i += 3) dearest = std::max(dearest, through(&few[i]));
  size_t cheaper = 0;
  for (size_t i = 0; i < all.size(); i += 3) cheaper += through(&all[i]) < dearest;
  CHECK(cheaper < 15);
  // A surface of 12 triangles is among them.
  CHECK(dearest >= polygon.best() * (1 - 1e-12));
}

TEST_CASE(
    "plain polygon: of a polygon that comes back no segment is over a loop edge or a vertex") {
  Random random(84);
  MESSAGE("seed 84");
  const LoopSet loops = loopSet(randomLoops({6, 5}, 2, random));
  const TripleWeights weights(loops, area());
  // Round the first loop, across, round the second and back.
  const std::vector<uint32_t> vertices{0, 1, 2, 3, 4, 5, 0, 6, 7, 8, 9, 10, 6};
  PlainPolygon polygon(loops, weights);
  polygon.compute(vertices);
  REQUIRE(polygon.best() < kInfinity);
  std::vector<uint32_t> traced;
  polygon.trace(0, polygon.size() - 1, traced);
  REQUIRE(traced.size() == 3 * (vertices.size() - 2));
  uint32_t onEdge[11] = {};
  for (size_t i = 0; i < traced.size(); ++i) {
    const uint32_t u = traced[i], v = traced[i % 3 == 2 ? i - 2 : i + 1];
    REQUIRE(u != v);
    if (!loops.isLoopEdge(u, v)) continue;
    onEdge[loops.next(u) == v ? u : v] += 1;
  }
  for (uint32_t e = 0; e < 11; ++e) CHECK(onEdge[e] == 1);
}

TEST_CASE("triple weights: the same in any order, infinite for what is no triangle") {
  const LoopSet loops = loopSet({{{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {0, 3, 0}}});
  TriangleWeights w;
  w.area = 2;
  w.perimeter = 1;
  const TripleWeights weights(loops, w);
  CHECK(weights(0, 1, 2) == kInfinity);
  CHECK(weights(0, 0, 3) == kInfinity);
  const double expected = 2 * 3 + 2 + 3 + std::sqrt(13.0);
  uint32_t t[3] = {0, 1, 3};
  do CHECK(weights(t[0], t[1], t[2]) == doctest::Approx(expected));
  while (std::next_permutation(t, t + 3));
}
