// Loops as hands draw them, on all default paths, spaces and objectives, each ended early. The largest ones are
// in tests/cpp/long.
#include <doctest/doctest.h>

#include <cmath>

#include "support/hand_runs.h"

using namespace sftest;

namespace {

/// Calls of the progress function, one for each million units of work: enough to get from the first space to the
/// next, not to end in each.
constexpr uint32_t kTicks = 12, kTicksOfMany = 40;

}  // namespace

TEST_CASE("hand-drawn: single strokes have answers") {
  expectHandAnswers(Hand::Stroke, 1400, 250, 330, kTicks);
}
TEST_CASE("hand-drawn: pairs of strokes have answers") {
  expectHandAnswers(Hand::Pair, 1401, 250, 160, kTicks);
}
TEST_CASE("hand-drawn: more pairs of strokes have answers") {
  expectHandAnswers(Hand::Pair, 1402, 200, 160, kTicks);
}
TEST_CASE("hand-drawn: several strokes have answers") {
  expectHandAnswers(Hand::Several, 1403, 300, 120, kTicks);
}
TEST_CASE("hand-drawn: strokes near themselves have answers") {
  expectHandAnswers(Hand::SelfApproaching, 1404, 250, 330, kTicks);
}
TEST_CASE("hand-drawn: dense curves have answers") {
  expectHandAnswers(Hand::DenseCurve, 1405, 150, 400, kTicks);
}
TEST_CASE("hand-drawn: rims of one mesh have answers") {
  expectHandAnswers(Hand::Rims, 1406, 250, 160, kTicks);
}
TEST_CASE("hand-drawn: linked rings have answers") {
  expectHandAnswers(Hand::Linked, 1407, 150, 120, kTicks);
}
TEST_CASE("hand-drawn: knots have answers") {
  expectHandAnswers(Hand::Knot, 1408, 150, 330, kTicks);
}
TEST_CASE("hand-drawn: many small loops have answers") {
  expectHandAnswers(Hand::ManySmall, 1409, 50, 0, kTicksOfMany);
}

TEST_CASE("hand-drawn: with bestSoFar and without, a call that nobody stops gives the same proof") {
  Random random(1420);
  MESSAGE("seed 1420");
  const Hand kinds[] = {Hand::Stroke, Hand::Pair, Hand::SelfApproaching, Hand::Linked, Hand::Knot};
  for (int i = 0; i < 60; ++i) {
    Problem problem = handProblem(kinds[i % 5], 24, random);
    problem.start.clear();
    if (problem.options.space == sf::Space::Near) problem.options.space = sf::Space::Auto;
    const HandRun plain = spanUntil(problem, 1u << 30, false),
                  watched = spanUntil(problem, 1u << 30);
    INFO(problem.text());
    CHECK(plain.fault == "");
    CHECK(watched.fault == "");
    REQUIRE(plain.outcome.status == watched.outcome.status);
    if (!plain.span.found) continue;
    CHECK(watched.span.cost <= plain.span.cost + 1e-9 * (1 + std::fabs(plain.span.cost)));
    CHECK((watched.span.optimal || !plain.span.optimal));
  }
  // One loop that is large enough for near triples to stand in for all of them.
  Problem problem;
  problem.curves = {noisyCircle(295, 0.05, random)};
  problem.options.space = sf::Space::All;
  const HandRun plain = spanUntil(problem, 1u << 30, false), watched = spanUntil(problem, 1u << 30);
  CHECK(watched.fault == "");
  CHECK(plain.span.optimal);
  CHECK(watched.span.optimal);
  CHECK(watched.span.cost == doctest::Approx(plain.span.cost).epsilon(1e-9));
}
