// Loops that people had trouble with: what is right for them with default options.
#include <doctest/doctest.h>

#include <cmath>

#include "support/hand_runs.h"
#include "support/surface.h"

using namespace sf;
using namespace sftest;

namespace {

Problem reported(const char* name) {
  Problem problem;
  problem.curves = readCurves(std::string(SF_FIXTURES) + "/reported/" + name + ".curve");
  REQUIRE_FALSE(problem.curves.empty());
  problem.options.areaWeight = NAN;
  return problem;
}

}  // namespace

TEST_CASE("reported: default options cost no more than the best space does") {
  // Two noisy strokes, of which the Delaunay surface has inserted vertices; rims of one mesh, of which it folds.
  const std::pair<const char*, double> cases[] = {{"noisy_pair_11_23", 17.28487},
                                                  {"noisy_pair_15_24", 16.97422},
                                                  {"linked_rings_2x30", 6.24034},
                                                  {"teapot_three_rims", 5.6656},
                                                  {"tunnel_two_rims", 1.7221}};
  for (const auto& [name, most] : cases) {
    CAPTURE(name);
    Problem problem = reported(name);
    const Answer answer = solve(problem);
    REQUIRE(answer.outcome.ok());
    REQUIRE(answer.span.found);
    CHECK(answer.span.cost <= most);
    setWeights(kDefaultWeights, problem.curves, problem.options);
    CHECK(spanFault(loopSet(problem.curves), problem.options, answer.span) == "");
  }
}

TEST_CASE("reported: many loops have a surface within the first hundred million units of work") {
  for (const char* name : {"noisy_40_loops_of_8", "flat_40_loops_of_8", "six_strokes_of_20"}) {
    CAPTURE(name);
    const HandRun run = spanUntil(reported(name), 100);
    CHECK(run.fault == "");
    CHECK(run.outcome.ok());
    CHECK(run.span.found);
  }
}
