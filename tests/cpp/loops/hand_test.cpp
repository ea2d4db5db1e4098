// Loops as hands draw them, on all default paths, spaces and objectives, each ended early. The largest ones are
// in tests/cpp/long.
#include <doctest/doctest.h>

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
  expectHandAnswers(Hand::Pair, 1401, 200, 160, kTicks);
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
  expectHandAnswers(Hand::ManySmall, 1409, 100, 0, kTicksOfMany);
}
