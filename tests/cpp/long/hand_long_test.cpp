// Loops as hands draw them, up to the largest: more of what tests/cpp/loops/hand_test.cpp has.
#include <doctest/doctest.h>

#include "support/hand_runs.h"

using namespace sf;
using namespace sftest;

namespace {

constexpr uint32_t kTicks = 40, kTicksOfMany = 100;

void expectAnswers(Hand kind, int count, uint32_t most) {
  const uint32_t seed = 2400 + uint32_t(kind);
  MESSAGE("seed " << seed);
  Random random(seed);
  int found = 0;
  for (int i = 0; i < count; ++i) {
    const Problem problem = handProblem(kind, most, random);
    const uint32_t all = kind == Hand::ManySmall ? kTicksOfMany : kTicks;
    const HandRun run = spanUntil(problem, random.below(4) == 0 ? random.below(all) : all);
    found += run.outcome.ok() && run.span.found;
    INFO(nameOf(kind) << " " << i << "\n" << problem.text());
    CHECK(run.fault == "");
  }
  CHECK(found > count / 2);
}

}  // namespace

TEST_CASE("hand-drawn, large: single strokes have answers") {
  expectAnswers(Hand::Stroke, 1500, 900);
}
TEST_CASE("hand-drawn, large: pairs of strokes have answers") {
  expectAnswers(Hand::Pair, 2000, 800);
}
TEST_CASE("hand-drawn, large: several strokes have answers") {
  expectAnswers(Hand::Several, 1500, 600);
}
TEST_CASE("hand-drawn, large: strokes near themselves have answers") {
  expectAnswers(Hand::SelfApproaching, 1200, 900);
}
TEST_CASE("hand-drawn, large: dense curves have answers") {
  expectAnswers(Hand::DenseCurve, 800, 900);
}
TEST_CASE("hand-drawn, large: rims of one mesh have answers") {
  expectAnswers(Hand::Rims, 1200, 400);
}
TEST_CASE("hand-drawn, large: linked rings have answers") { expectAnswers(Hand::Linked, 600, 400); }
TEST_CASE("hand-drawn, large: knots have answers") { expectAnswers(Hand::Knot, 600, 900); }
TEST_CASE("hand-drawn, large: many small loops have answers") {
  expectAnswers(Hand::ManySmall, 600, 0);
}
