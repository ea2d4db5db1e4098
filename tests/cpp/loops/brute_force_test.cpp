// The solver against direct enumeration.
#include <doctest/doctest.h>

#include <cmath>

#include "support/brute_force.h"
#include "support/cases.h"
#include "support/surface.h"

using namespace sftest;

namespace {

/// Whether the solver finds what enumeration finds; tells doctest if not.
bool agrees(const Problem& problem, const std::string& what) {
  sf::LoopSet loops = loopSet(problem.curves);
  sf::SpanOptions options = problem.view();
  BruteForceAnswer expected = bruteForceOptimum(loops, options);
  Answer answer = solve(problem);
  const sf::Span& span = answer.span;
  INFO(what, "\n", problem.text());
  CHECK(answer.outcome.status == sf::Status::Ok);
  CHECK(span.found == expected.found);
  if (!answer.outcome.ok() || !span.found || !expected.found) return expected.found;
  CHECK(spanFault(loops, options, span) == "");
  CHECK(span.optimal);
  CHECK(span.inserted.empty());
  CHECK(std::fabs(span.cost - expected.cost) <= 1e-9 * (1 + std::fabs(expected.cost)));
  double sum = weightedSum(options, span.terms);
  CHECK(std::fabs(sum - expected.sum) <= 1e-9 * (1 + std::fabs(expected.sum)));
  return true;
}

struct Tally {
  int cases = 0, found = 0;
};

/// `rounds` problems over loops of these sizes, through all shapes and weights.
Tally compareAll(const std::vector<uint32_t>& sizes, int rounds, uint32_t seed) {
  Tally tally;
  for (int round = 0; round < rounds; ++round) {
    Random random(seed + uint32_t(round));
    // Two strides without a common factor visit every pair of shape and weights.
    Shape shape = Shape(round % int(Shape::Count));
    Problem problem;
    problem.curves = loopsOf(shape, sizes, random);
    const char* weights = setWeights(round % kWeightings, problem.curves, problem.options);
    problem.options.space = sf::Space::All;
    if (random.chance(0.3)) problem.normals = randomNormals(problem.curves, 0.7, random);
    if (random.chance(0.4)) {
      problem.options.space = sf::Space::Given;
      double keep = random.chance(0.3) ? 1 : random.range(0.35, 0.9);
      problem.triangles = randomTriples(problem.curves, keep, random);
      if (random.chance(0.5))
        for (size_t i = 0; i < problem.triangles.size() / 3; ++i)
          problem.triangleWeights.push_back(random.below(5) / 4.0 - (round % 2) * 0.5);
    }
    char what[100];
    std::snprintf(what, sizeof what, "seed %u, %s, %s", seed + unsigned(round), nameOf(shape),
                  weights);
    ++tally.cases;
    tally.found += agrees(problem, what);
  }
  return tally;
}

}  // namespace

TEST_CASE("brute force: counts the surfaces of the class over all triples") {
  const std::pair<std::vector<uint32_t>, uint64_t> known[] = {
      {{3}, 1},     {{4}, 2},      {{5}, 5},       {{6}, 14},      {{7}, 42},         {{8}, 132},
      {{3, 3}, 42}, {{3, 4}, 264}, {{4, 4}, 1688}, {{3, 5}, 1290}, {{3, 3, 3}, 72576}};
  for (const auto& [sizes, count] : known) CHECK(countSurfaces(sizes) == count);
}

TEST_CASE("brute force: one loop of up to nine vertices has the optimum found by enumeration") {
  Tally tally;
  for (uint32_t n = 3; n <= 9; ++n) {
    Tally more = compareAll({n}, 42, 1000 * n);
    tally.cases += more.cases, tally.found += more.found;
  }
  MESSAGE(tally.cases << " problems, " << tally.found << " with a surface");
  CHECK(tally.found > tally.cases / 2);
  CHECK(tally.found < tally.cases);
}

TEST_CASE("brute force: two loops of up to nine vertices have the optimum found by enumeration") {
  const std::vector<uint32_t> sizes[] = {{3, 3}, {3, 4}, {4, 3}, {4, 4}, {3, 5}, {4, 5}, {6, 3}};
  Tally tally;
  uint32_t seed = 20000;
  for (const auto& pair : sizes) {
    Tally more = compareAll(pair, 42, seed += 1000);
    tally.cases += more.cases, tally.found += more.found;
  }
  MESSAGE(tally.cases << " problems, " << tally.found << " with a surface");
  CHECK(tally.found > tally.cases / 2);
  CHECK(tally.found < tally.cases);
}

TEST_CASE("brute force: three triangles have the optimum found by enumeration") {
  Tally tally = compareAll({3, 3, 3}, 84, 50000);
  MESSAGE(tally.cases << " problems, " << tally.found << " with a surface");
  CHECK(tally.found > tally.cases / 2);
}

TEST_CASE("brute force: four triangles with few candidates have the optimum found by enumeration") {
  int found = 0;
  for (uint32_t seed = 60000; seed < 60012; ++seed) {
    Random random(seed);
    Problem problem;
    problem.curves = loopsOf(Shape::Random, {3, 3, 3, 3}, random);
    setWeights(int(seed % kWeightings), problem.curves, problem.options);
    problem.options.space = sf::Space::Given;
    problem.triangles = randomTriples(problem.curves, 0.4, random);
    char what[40];
    std::snprintf(what, sizeof what, "seed %u", seed);
    found += agrees(problem, what);
  }
  MESSAGE(found << " of twelve with a surface");
  CHECK(found > 0);
}
