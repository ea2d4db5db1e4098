// Loops as hands draw them, up to the largest: more of what tests/cpp/loops/hand_test.cpp has.
#include <doctest/doctest.h>

#include "support/hand_runs.h"

using namespace sftest;

namespace {

constexpr uint32_t kTicks = 40, kTicksOfMany = 100;

}  // namespace

TEST_CASE("hand-drawn, large: single strokes have answers") {
  expectHandAnswers(Hand::Stroke, 2406, 1500, 900, kTicks);
}
TEST_CASE("hand-drawn, large: pairs of strokes have answers") {
  expectHandAnswers(Hand::Pair, 2404, 2000, 800, kTicks);
}
TEST_CASE("hand-drawn, large: several strokes have answers") {
  expectHandAnswers(Hand::Several, 2407, 1500, 600, kTicks);
}
TEST_CASE("hand-drawn, large: strokes near themselves have answers") {
  expectHandAnswers(Hand::SelfApproaching, 2415, 1200, 900, kTicks);
}
TEST_CASE("hand-drawn, large: dense curves have answers") {
  expectHandAnswers(Hand::DenseCurve, 2410, 800, 900, kTicks);
}
TEST_CASE("hand-drawn, large: rims of one mesh have answers") {
  expectHandAnswers(Hand::Rims, 2404, 1200, 400, kTicks);
}
TEST_CASE("hand-drawn, large: linked rings have answers") {
  expectHandAnswers(Hand::Linked, 2406, 600, 400, kTicks);
}
TEST_CASE("hand-drawn, large: knots have answers") {
  expectHandAnswers(Hand::Knot, 2404, 600, 900, kTicks);
}
TEST_CASE("hand-drawn, large: many small loops have answers") {
  expectHandAnswers(Hand::ManySmall, 2409, 600, 0, kTicksOfMany);
}
