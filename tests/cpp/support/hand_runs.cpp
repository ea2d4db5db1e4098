#include "support/hand_runs.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/surface.h"

namespace sftest {
namespace {

struct Watch {
  const sf::LoopSet* loops = nullptr;
  const sf::SpanOptions* options = nullptr;
  uint32_t left = 0;
  double bestTold = 1.0 / 0.0;
  double fraction = 0, bestCost = 1.0 / 0.0, bound = 0;
  bool isStopped = false;
  std::string fault;

  void blame(const std::string& what) {
    if (fault.empty()) fault = what;
  }
};

bool onProgress(void* user, double fraction, double bestCost, double lowerBound) {
  Watch& watch = *static_cast<Watch*>(user);
  if (!(fraction >= watch.fraction && fraction <= 1)) watch.blame("the fraction falls");
  watch.fraction = fraction;
  if (!(lowerBound >= 0)) watch.blame("on the way: a bound below zero");
  if (lowerBound > bestCost + 1e-9 * std::fabs(bestCost))
    watch.blame("on the way: bound above cost");
  if (bestCost > watch.bestCost + 1e-9 * std::fabs(watch.bestCost))
    watch.blame("on the way: the best cost rises");
  watch.bestCost = bestCost;
  watch.bound = std::max(watch.bound, lowerBound);
  watch.isStopped = watch.isStopped || watch.left == 0;
  if (watch.left > 0) --watch.left;
  return !watch.isStopped;
}

void onBest(void* user, const sf::Span& span) {
  Watch& watch = *static_cast<Watch*>(user);
  const std::string fault = spanFault(*watch.loops, *watch.options, span);
  if (!fault.empty()) watch.blame("on the way: " + fault);
  if (span.cost > watch.bestTold + 1e-9) watch.blame("on the way: dearer than the one before");
  if (!(span.lowerBound >= 0)) watch.blame("on the way: a bound below zero");
  watch.bestTold = span.cost;
}

}  // namespace

HandRun spanUntil(const Problem& problem, uint32_t ticks, bool bestSoFar) {
  HandRun run;
  const sf::LoopSet loops = loopSet(problem.curves);
  sf::SpanOptions options = problem.view(), checked = options;
  // What the default stands for, so that costs can be told from it.
  if (std::isnan(checked.areaWeight)) setWeights(kDefaultWeights, problem.curves, checked);
  Watch watch;
  watch.loops = &loops, watch.options = &checked, watch.left = ticks;
  options.bestSoFar = bestSoFar;
  options.onBest = onBest;
  options.user = &watch;
  sf::Work work(size_t(1) << 30, onProgress, &watch);
  run.outcome = sf::spanLoops(loops, options, work, run.span);
  if (work.used() != 0) watch.blame("memory was kept");
  const bool isOk = run.outcome.status == sf::Status::Ok;
  if (watch.isStopped && isOk && !bestSoFar) watch.blame("a stop was ignored");
  if (watch.isStopped && isOk && run.span.optimal) watch.blame("a proof though it was stopped");
  switch (run.outcome.status) {
    case sf::Status::Ok:
      if (!run.span.found) break;
      if (const std::string fault = spanFault(loops, checked, run.span); !fault.empty())
        watch.blame(fault);
      if (!(run.span.lowerBound >= 0)) watch.blame("a bound below zero");
      if (run.span.cost > watch.bestTold + 1e-9) watch.blame("dearer than one on the way");
      if (options.space != sf::Space::Auto && options.space != sf::Space::Near &&
          watch.bound > run.span.cost + 1e-9 * std::fabs(run.span.cost))
        watch.blame("a bound on the way above the answer");
      break;
    case sf::Status::Stopped:
      if (watch.bestTold < 1.0 / 0.0) watch.blame("a surface was lost");
      break;
    case sf::Status::LoopsIntersect:
      if (!loopsMeet(problem.curves)) watch.blame("loops that do not meet are refused");
      break;
    case sf::Status::TooLarge:
    case sf::Status::OutOfMemory:
      break;
    default:
      watch.blame("status " + std::to_string(int(run.outcome.status)));
  }
  run.fault = watch.fault;
  return run;
}

Problem handProblem(Hand kind, uint32_t most, Random& random) {
  Problem problem;
  problem.curves = handLoops(kind, logUniform(3, most, random), random);
  sf::SpanOptions& options = problem.options;
  // Mostly what people have who set nothing.
  if (random.chance(0.5))
    setWeights(int(random.below(kWeightings)), problem.curves, options);
  else
    options.areaWeight = NAN;
  const sf::Space kSpaces[] = {sf::Space::Auto, sf::Space::Auto,     sf::Space::Auto,
                               sf::Space::Near, sf::Space::Delaunay, sf::Space::All};
  options.space = kSpaces[random.below(6)];
  if (random.chance(0.15)) problem.normals = randomNormals(problem.curves, 0.5, random);
  if (random.chance(0.15))
    for (uint32_t i = 0; i < 30; ++i)
      problem.start.push_back(random.below(problem.vertexCount() + 3));
  return problem;
}

void expectHandAnswers(Hand kind, uint32_t seed, int count, uint32_t most, uint32_t ticks) {
  MESSAGE("seed " << seed);
  Random random(seed);
  int found = 0, wanted = 0;
  for (int i = 0; i < count; ++i) {
    const Problem problem = handProblem(kind, most, random);
    const bool isSoon = random.below(4) == 0, bestSoFar = random.below(5) != 0;
    const HandRun run = spanUntil(problem, isSoon ? random.below(ticks) : ticks, bestSoFar);
    found += run.outcome.ok() && run.span.found;
    wanted += bestSoFar;
    INFO(nameOf(kind) << " " << i << "\n" << problem.text());
    CHECK(run.fault == "");
  }
  // Else little was shown.
  CHECK(found >= wanted / 2);
}

}  // namespace sftest
