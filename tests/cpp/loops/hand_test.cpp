// Loops as hands draw them, on all default paths, spaces and objectives, each ended early. The larger ones
// are in tests/cpp/long.
#include <doctest/doctest.h>

#include "support/hand_runs.h"

using namespace sf;
using namespace sftest;

namespace {

/// Calls of the progress function, for each million units of work: enough to get from the first space to the
/// next, not to end in each.
constexpr uint32_t kTicks = 16, kTicksOfMany = 80;

void expectAnswers(Hand kind, int count, uint32_t most) {
  const uint32_t ticks = kind == Hand::ManySmall ? kTicksOfMany : kTicks;
  const uint32_t seed = 1400 + uint32_t(kind);
  MESSAGE("seed " << seed);
  Random random(seed);
  int found = 0;
  for (int i = 0; i < count; ++i) {
    const Problem problem = handProblem(kind, most, random);
    const HandRun run = spanUntil(problem, random.below(4) == 0 ? random.below(4) : ticks);
    found += run.outcome.ok() && run.span.found;
    INFO(nameOf(kind) << " " << i << "\n" << problem.text());
    CHECK(run.fault == "");
  }
  // Else nothing was shown.
  CHECK(found > count / 2);
}

}  // namespace

TEST_CASE("hand-drawn: single strokes have answers") { expectAnswers(Hand::Stroke, 250, 330); }
TEST_CASE("hand-drawn: pairs of strokes have answers") { expectAnswers(Hand::Pair, 400, 160); }
TEST_CASE("hand-drawn: several strokes have answers") { expectAnswers(Hand::Several, 250, 120); }
TEST_CASE("hand-drawn: strokes near themselves have answers") {
  expectAnswers(Hand::SelfApproaching, 250, 330);
}
TEST_CASE("hand-drawn: dense curves have answers") { expectAnswers(Hand::DenseCurve, 150, 400); }
TEST_CASE("hand-drawn: rims of one mesh have answers") { expectAnswers(Hand::Rims, 250, 160); }
TEST_CASE("hand-drawn: linked rings have answers") { expectAnswers(Hand::Linked, 150, 120); }
TEST_CASE("hand-drawn: knots have answers") { expectAnswers(Hand::Knot, 150, 330); }
TEST_CASE("hand-drawn: many small loops have answers") { expectAnswers(Hand::ManySmall, 150, 0); }
