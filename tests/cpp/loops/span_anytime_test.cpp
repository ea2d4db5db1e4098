// Spans that a limit ends: the best surface so far, valid, with a bound that holds.
#include <doctest/doctest.h>

#include <algorithm>

#include "loops/span.h"
#include "support/cases.h"
#include "support/generators.h"
#include "support/surface.h"

using namespace sf;
using namespace sftest;

namespace {

struct Watch {
  const LoopSet* loops;
  const SpanOptions* options;
  uint32_t calls = 0, most = 0;
  double last = 1.0 / 0.0;
  int told = 0;
};

bool until(void* user, double, double, double) {
  Watch& watch = *static_cast<Watch*>(user);
  return ++watch.calls <= watch.most;
}

void heard(void* user, const Span& best) {
  Watch& watch = *static_cast<Watch*>(user);
  CHECK(spanFault(*watch.loops, *watch.options, best) == "");
  CHECK(!best.optimal);
  // Surfaces with the same largest angle may follow one another, each of a smaller sum.
  CHECK(best.cost <= watch.last + 1e-9);
  watch.last = best.cost;
  ++watch.told;
}

}  // namespace

TEST_CASE("anytime: whenever the work ends, the best surface so far with a proven bound") {
  Random random(321);
  MESSAGE("seed 321");
  int early = 0, empty = 0, whole = 0, told = 0;
  for (int i = 0; i < 10; ++i) {
    const uint32_t k = 2 + uint32_t(i) % 4;
    const LoopSet loops = loopSet(regularSaddles(k, 8, random));
    SpanOptions options;
    options.space = i % 5 == 4 ? Space::Auto : Space::Delaunay;
    options.objective = i % 3 == 2 ? Objective::WorstDihedral : Objective::Sum;
    options.areaWeight = i % 3 == 1;
    options.dihedralWeight = i % 3 != 1;
    Work unlimited;
    Span best;
    REQUIRE(spanLoops(loops, options, unlimited, best).ok());
    REQUIRE(best.found);
    options.bestSoFar = true;
    options.onBest = heard;
    for (const uint32_t most : {0u, 1u, 3u, 10u, 40u, 1000000u}) {
      Watch watch{&loops, &options, 0, most};
      options.user = &watch;
      Work work(size_t(-1), until, &watch);
      Span span;
      const Outcome outcome = spanLoops(loops, options, work, span);
      CHECK(work.used() == 0);
      told += watch.told;
      if (!outcome.ok()) {
        CHECK(outcome.status == Status::Stopped);
        CHECK(!span.found);
        CHECK(watch.told == 0);
        ++empty;
        continue;
      }
      REQUIRE(span.found);
      CHECK(spanFault(loops, options, span) == "");
      CHECK(span.cost <= watch.last + 1e-9);
      CHECK(span.lowerBound <= best.cost * (1 + 1e-9) + 1e-9);
      CHECK(span.cost >= best.cost * (1 - 1e-9) - 1e-9);
      CHECK(span.optimal == work.going());
      if (span.optimal) CHECK(span.cost == doctest::Approx(best.cost).epsilon(1e-9));
      ++(span.optimal ? whole : early);
    }
  }
  MESSAGE(early << " ended early with a surface, " << empty << " without, " << whole << " whole, "
                << told << " told on the way");
  CHECK(early > 10);
  CHECK(whole >= 10);
  CHECK(told > 20);
}

TEST_CASE("anytime: a memory limit ends the work with the best surface so far") {
  Random random(322);
  MESSAGE("seed 322");
  const LoopSet loops = loopSet(regularSaddles(6, 8, random));
  SpanOptions options;
  options.space = Space::Delaunay;
  options.areaWeight = 1;
  options.dihedralWeight = 0;
  Work tight(size_t(3) << 20, nullptr, nullptr);
  Span span;
  CHECK(spanLoops(loops, options, tight, span).status == Status::OutOfMemory);
  options.bestSoFar = true;
  Work again(size_t(3) << 20, nullptr, nullptr);
  REQUIRE(spanLoops(loops, options, again, span).ok());
  CHECK(span.found);
  CHECK(!span.optimal);
  CHECK(span.lowerBound > 0);
  CHECK(span.lowerBound < span.cost);
  CHECK(spanFault(loops, options, span) == "");
}

TEST_CASE("anytime: beginning from an earlier surface changes the way, not the answer") {
  Random random(323);
  MESSAGE("seed 323");
  const LoopSet loops = loopSet(regularSaddles(5, 8, random));
  SpanOptions options;
  options.space = Space::Delaunay;
  options.dihedralWeight = 1;
  Work work;
  Span plain, again;
  REQUIRE(spanLoops(loops, options, work, plain).ok());
  options.start = plain.triangles;
  REQUIRE(spanLoops(loops, options, work, again).ok());
  CHECK(again.optimal);
  CHECK(again.cost == doctest::Approx(plain.cost).epsilon(1e-12));
  std::vector<uint32_t> nonsense;
  for (int i = 0; i < 60; ++i) nonsense.push_back(random.below(60));
  options.start = nonsense;
  REQUIRE(spanLoops(loops, options, work, again).ok());
  CHECK(again.optimal);
  CHECK(again.cost == doctest::Approx(plain.cost).epsilon(1e-12));
}

TEST_CASE("anytime: one loop over all triples falls back to the near ones' surface") {
  Random random(324);
  MESSAGE("seed 324");
  const LoopSet loops = loopSet({noisyCircle(300, 0.05, random)});
  SpanOptions options;
  options.space = Space::All;
  options.areaWeight = 1;
  Work unlimited;
  Span best;
  REQUIRE(spanLoops(loops, options, unlimited, best).ok());
  options.bestSoFar = true;
  Span whole;
  REQUIRE(spanLoops(loops, options, unlimited, whole).ok());
  CHECK(whole.optimal);
  CHECK(whole.cost == doctest::Approx(best.cost).epsilon(1e-12));
  // Memory for the near triples, and not for all of them.
  Work tight(size_t(14) << 20, nullptr, nullptr);
  Span span;
  REQUIRE(spanLoops(loops, options, tight, span).ok());
  REQUIRE(span.found);
  CHECK(spanFault(loops, options, span) == "");
  CHECK(!span.optimal);
  CHECK(span.space == Space::All);
  CHECK(span.cost >= best.cost * (1 - 1e-12));
  CHECK(span.lowerBound > 0);
  CHECK(span.lowerBound <= best.cost);
  options.bestSoFar = false;
  Work again(size_t(14) << 20, nullptr, nullptr);
  CHECK(spanLoops(loops, options, again, span).status == Status::TooLarge);
}

TEST_CASE("anytime: bounds are what weights prove, below zero only where weights are") {
  Random random(322);
  MESSAGE("seed 322");
  for (const bool isNegative : {false, true}) {
    CAPTURE(isNegative);
    const Curves curves{noisyCircle(7, 0.1, random), circle(6, 0.8, {0, 0, 1})};
    Problem problem;
    problem.curves = curves;
    problem.options.space = Space::Given;
    problem.options.dihedralWeight = 1;
    problem.triangles = randomTriples(curves, 1, random);
    double least = 0;
    for (size_t t = 0; t < problem.triangles.size() / 3; ++t) {
      problem.triangleWeights.push_back(isNegative ? random.range(-3, 0) : random.range(0, 3));
      least += std::min(0.0, problem.triangleWeights.back());
    }
    const LoopSet loops = loopSet(curves);
    SpanOptions options = problem.view();
    const Answer optimum = solve(problem);
    REQUIRE(optimum.outcome.ok());
    REQUIRE(optimum.span.found);
    CHECK((optimum.span.cost < 0) == isNegative);
    struct Bounds {
      uint32_t left;
      double least, most;
    };
    options.bestSoFar = true;
    for (uint32_t ticks = 0; ticks < 12; ++ticks) {
      Bounds bounds{ticks, 1.0 / 0.0, -1.0 / 0.0};
      options.user = &bounds;
      const auto watch = [](void* user, double, double best, double bound) {
        Bounds& seen = *static_cast<Bounds*>(user);
        CHECK(bound <= best);
        seen.least = std::min(seen.least, bound), seen.most = std::max(seen.most, bound);
        return seen.left-- > 0;
      };
      Work work(size_t(-1), watch, &bounds);
      Span span;
      const Outcome outcome = spanLoops(loops, options, work, span);
      CHECK(bounds.most <= optimum.span.cost + 1e-9);
      if (bounds.least < 1.0 / 0.0) CHECK(bounds.least >= least - 1e-9);
      if (!outcome.ok()) continue;
      CHECK(span.lowerBound >= least - 1e-9);
      CHECK(span.lowerBound <= optimum.span.cost + 1e-9);
      CHECK(span.cost >= optimum.span.cost - 1e-9);
    }
  }
}
