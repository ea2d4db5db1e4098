#include "loops/solver.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/sort.h"
#include "loops/bounds/fan_bound.h"
#include "loops/bounds/fan_filter.h"
#include "loops/domains/lower_bound.h"

namespace sf {
namespace {

/// Splits of domains to try first, for each vertex: the cost of fans is proportional to the
/// vertices too.
constexpr uint64_t kSplitsOfFew = 30000;
constexpr uint64_t kSplitsOfMany = 1000;
/// Domains are few if loops and candidates are. Limits: loops; candidates for each triangle of a
/// surface, and at each edge.
constexpr uint32_t kFewLoops = 4;
constexpr double kFewCandidates = 32, kFewAtEdge = 8;
/// Growth of the number of splits from round to round.
constexpr uint64_t kGrowth = 6;
/// Time of a split in R, in nanoseconds.
constexpr double kTimeOfSplit = 200;

/// Cuts to try before anything else, if surfaces on the way are of use, and between fans.
constexpr uint32_t kFirstTries = 64, kFirstTriesOfFew = 8;
constexpr uint32_t kTriesPerRound = 24;

/// Sums in another order differ in the last digits.
double withRounding(double cost) { return cost + 1e-9 * std::fabs(cost); }

/// What the costs of triangles alone prove: a surface has n + 2k - 4 of them, each at most once, and angles cost
/// nothing at least. Infinity if so many triangles are not allowed.
double boundOfCosts(const Task& task) {
  if (task.measure.isWorst()) return 0;
  double negative = 0, least = kInfinity;
  size_t allowed = 0;
  for (const double cost : task.triangleCost) {
    if (cost == kInfinity) continue;
    ++allowed;
    negative += std::min(cost, 0.0);
    least = std::min(least, cost);
  }
  const size_t count = size_t(task.loops.vertexCount()) + 2 * size_t(task.loops.loopCount()) - 4;
  if (allowed < count) return kInfinity;
  return negative < 0 ? negative : double(count) * least;
}

/// Solves one pass: keeps the best surface and the bound as they get better.
class PassSolver {
 public:
  PassSolver(const Task& task, const SolveOptions& options, Surface& surface)
      : task_(task),
        options_(options),
        surface_(surface),
        lowerBound_(boundOfCosts(task)),
        best_(task.measure, options.listener, task.isObjective ? lowerBound_ : surface.lowerBound) {
  }

  /// Looks for the optimum, from fraction `from` to `to` of the work. False when the work ended.
  bool run(double from, double to);

  Incumbent& best() { return best_; }
  double lowerBound() const { return lowerBound_; }

 private:
  bool beginSearch();
  bool lookForFirst(uint32_t tries);
  bool solveByDomains(const Task& task, uint64_t maxSplits, Optimum& optimum);
  bool solveSubset(const std::vector<uint32_t>& kept, uint64_t maxSplits, bool& reached);
  bool solveByFans(uint64_t maxSplits);
  bool solveWorst(uint64_t maxSplits);
  bool solveAll(uint64_t maxSplits, bool& solved);
  bool solveBetter(const FanBound& fans, uint64_t maxSplits, bool& solved);
  void raise(double lowerBound) {
    lowerBound_ = std::max(lowerBound_, std::min(lowerBound, best_.cost()));
    if (task_.isObjective) best_.raise(lowerBound_);
    task_.tell(best_.cost(), lowerBound_);
  }

  const Task& task_;
  const SolveOptions& options_;
  Surface& surface_;  // where domains are counted
  double lowerBound_;
  Incumbent best_;
  std::unique_ptr<SurfaceSearch> search_;
  std::vector<double> leastPair_;
};

bool PassSolver::solveByDomains(const Task& task, uint64_t maxSplits, Optimum& optimum) {
  SolverCounts counts;
  const bool good = solveDirectly(task, maxSplits, best_.cost(), optimum, counts);
  surface_.domains += counts.domains;
  surface_.minimalSets += counts.minimalSets;
  return good;
}

/// Looks for a surface made of the triangles `kept` only.
bool PassSolver::solveSubset(const std::vector<uint32_t>& kept, uint64_t maxSplits, bool& reached) {
  const uint64_t before = task_.work.used();
  CandidateSet subset;
  std::vector<double> cost;
  cost.reserve(kept.size());
  for (const uint32_t t : kept) cost.push_back(task_.triangleCost[t]);
  Optimum found;
  const bool good = buildSubset(task_.loops, task_.set, kept, task_.work, subset) &&
                    solveByDomains({task_.loops, subset, cost, task_.measure, task_.work, false},
                                   maxSplits, found);
  task_.work.release(task_.work.used() - before);
  for (uint32_t& t : found.order) t = kept[t];
  reached = found.reached;
  if (reached) best_.offer(std::move(found.order), found.cost);
  return good;
}

/// Solves by all domains, unless those are too many for `maxSplits`.
bool PassSolver::solveAll(uint64_t maxSplits, bool& solved) {
  Optimum optimum;
  const bool good = solveByDomains(task_, maxSplits, optimum);
  raise(optimum.lowerBound);
  solved = good && optimum.reached;
  if (!solved) return good;
  best_.offer(std::move(optimum.order), optimum.cost);
  raise(optimum.cost);
  return true;
}

/// Solves by the domains that a surface better than the best one can have by the fans' bounds.
/// Gives up if those are too many for `maxSplits`.
bool PassSolver::solveBetter(const FanBound& fans, uint64_t maxSplits, bool& solved) {
  const uint64_t before = task_.work.used();
  Optimum found;
  bool good;
  {
    FanEstimate estimate(task_.loops, fans.links(), leastPair_, task_.measure, fans.costs(),
                         task_.work);
    good = estimate.compute();
    if (good) {
      std::vector<double> excess, cost(task_.triangleCost);
      estimate.excess(excess);
      const double most = withRounding(best_.cost()) - fans.lowerBound();
      for (size_t t = 0; t < cost.size(); ++t)
        if (excess[t] > most) cost[t] = kInfinity;
      const Task within{task_.loops, task_.set, cost, task_.measure, task_.work, task_.isObjective};
      SolverCounts counts;
      good = solveWithin(within, estimate, leastPair_, best_.cost(), maxSplits, found, counts);
      surface_.domains += counts.domains;
      surface_.minimalSets += counts.minimalSets;
    }
  }
  task_.work.release(task_.work.used() - before);
  solved = found.reached;
  if (found.cost < kInfinity) best_.offer(std::move(found.order), found.cost);
  raise(solved ? best_.cost() : found.lowerBound);
  return good;
}

/// Solves a task that is too large for all its domains. Bounds it by its fans, finds surfaces by
/// cuts, and then solves it by the domains that both leave. All three get better from round to
/// round, and the rounds get longer.
bool PassSolver::solveByFans(uint64_t maxSplits) {
  FanBound fans(task_.loops, task_.set, task_.triangleCost, task_.measure, task_.work);
  if (!search_ && !beginSearch()) return false;
  leastPair_ = leastPairs(task_.set, task_.measure);
  for (uint32_t round = 0; task_.work.going(); ++round) {
    task_.work.setFraction(1 - 1 / (1 + 0.3 * round));
    // Neither of the two may take much more time than the other, since either may get there first.
    const double steps = kTimeOfSplit * double(maxSplits) / fans.timeOfStep();
    if (!fans.ascend(uint32_t(std::clamp(steps, 10.0, 300.0)), best_.cost())) return false;
    raise(fans.lowerBound());
    if (fans.lowerBound() == kInfinity) break;  // there is no surface
    if (!search_->search(kTriesPerRound)) return false;
    bool solved;
    if (best_.cost() < kInfinity ? !solveBetter(fans, maxSplits, solved)
                                 : !solveAll(maxSplits, solved))
      return false;
    if (solved) return true;
    maxSplits = maxSplits < kUnlimited / kGrowth ? kGrowth * maxSplits : kUnlimited;
  }
  return task_.work.going();
}

bool PassSolver::beginSearch() {
  search_ = std::make_unique<SurfaceSearch>(task_, best_);
  return !options_.start || options_.start->isEmpty() || search_->startFrom(*options_.start);
}

bool PassSolver::lookForFirst(uint32_t tries) {
  return task_.loops.loopCount() == 1 || !options_.anytime ||
         (beginSearch() && search_->search(tries));
}

/// The least largest angle over several loops: finds a surface by cuts, and then solves over the
/// triangles that a surface of smaller angles can have. These are few: only angles near the least
/// one have to be told apart.
bool PassSolver::solveWorst(uint64_t maxSplits) {
  FanFilter filter(task_.loops, task_.set, task_.triangleCost, task_.work);
  if (!search_ && !beginSearch()) return false;
  std::vector<uint32_t> kept;
  for (uint32_t round = 0; task_.work.going(); ++round) {
    task_.work.setFraction(1 - 1 / (1 + 0.3 * round));
    double lowerBound = -kInfinity;
    if (!search_->search(kTriesPerRound) || !filter.bound(best_.cost(), lowerBound)) return false;
    raise(lowerBound);
    bool reached = true;
    if (!filter.filter(std::nextafter(std::min(best_.cost(), 4.0), 0.0), kept)) return false;
    if (!kept.empty() && !solveSubset(kept, maxSplits, reached)) return false;
    if (reached) {
      raise(best_.cost());
      return true;
    }
    maxSplits = maxSplits < kUnlimited / kGrowth ? kGrowth * maxSplits : kUnlimited;
  }
  return false;
}

bool PassSolver::run(double from, double to) {
  const LoopSet& loops = task_.loops;
  Work& work = task_.work;
  const uint32_t k = loops.loopCount();
  const bool large = isLarge(loops, task_.set), worst = task_.measure.isWorst();
  const bool dense = large && isDense(loops, task_.set);
  // Hubs make fans expensive: their labels may take several times what the candidates do.
  const double fanBytes = worst ? 0 : FanBound::bytesFor(loops, task_.set);
  // If some loop edge has no triangle there is no surface, which shows at once.
  const bool gap = std::count(task_.set.loopEdges.begin(), task_.set.loopEdges.end(), kNone) > 0;
  const bool direct = k == 1 || gap || dense || (worst && large && k > 2) || !work.fits(fanBytes) ||
                      fanBytes > 40 * CandidateSet::bytesFor(double(task_.set.size()));
  // Domains are few where loops and candidates are.
  const bool areSparse =
      candidatesPerTriangle(loops, task_.set) <= kFewCandidates &&
      double(task_.set.slotTriangle.size()) <= kFewAtEdge * double(task_.set.edgeCount());
  const bool areFew = (k == 2 || (k <= kFewLoops && areSparse)) && !worst;
  const uint64_t splits = options_.firstSplits
                              ? options_.firstSplits
                              : loops.vertexCount() * (areFew ? kSplitsOfFew : kSplitsOfMany);
  work.phase(from, direct ? to : from + 0.2 * (to - from));
  if (!lookForFirst(areFew ? kFirstTriesOfFew : kFirstTries)) return false;
  if (direct || areFew || splits == kUnlimited) {
    bool solved;
    if (!solveAll(direct ? kUnlimited : splits, solved)) return false;
    if (solved) return true;
  }
  work.phase(from + 0.2 * (to - from), to);
  return worst ? solveWorst(splits) : solveByFans(splits);
}

}  // namespace

bool solveSurface(const LoopSet& loops, const CandidateSet& set, const SolveOptions& options,
                  Work& work, Surface& surface) {
  surface = {};
  const auto handBack = [&](PassSolver& pass, bool optimal) {
    if (pass.best().cost() == kInfinity) return;
    surface.found = true;
    surface.order = pass.best().order();
    surface.optimal = optimal;
  };
  if (options.objective == Objective::Sum) {
    const Task task{loops, set, set.weight, Measure::sum(options.dihedralWeight), work, true};
    PassSolver pass(task, options, surface);
    const bool done = pass.run(0, 1);
    surface.lowerBound = pass.lowerBound();
    handBack(pass, done);
    return done;
  }
  const std::vector<double> angle =
      set.boundaryAngle.empty() ? std::vector<double>(set.size(), 0) : set.boundaryAngle;
  const Task worst{loops, set, angle, Measure::worst(), work, true};
  PassSolver first(worst, options, surface);
  const bool worstKnown = first.run(0, 0.5);
  surface.lowerBound = first.lowerBound();
  handBack(first, false);
  if (!worstKnown || !surface.found) return worstKnown;
  const double cap = first.best().cost() + kAngleTie;
  std::vector<double> weight(set.size(), kInfinity);
  if (loops.loopCount() > 1 && !isDense(loops, set) &&
      !(loops.loopCount() > 2 && isLarge(loops, set))) {
    std::vector<uint32_t> kept;
    if (!FanFilter(loops, set, angle, work).filter(cap, kept)) return false;
    for (const uint32_t t : kept) weight[t] = set.weight[t];
  } else {
    for (size_t t = 0; t < weight.size(); ++t)
      if (angle[t] <= cap) weight[t] = set.weight[t];
  }
  const Task sum{loops, set, weight, Measure::sum(options.dihedralWeight, cap), work, false};
  PassSolver second(sum, options, surface);
  const bool done = second.run(0.5, 1);
  SF_ASSERT(!done || second.best().cost() < kInfinity);
  handBack(second, done);
  return done;
}

double predictedTimeOfAllTriples(const LoopSet& loops) {
  const double n = loops.vertexCount();
  if (loops.loopCount() == 1) return 12 * n * n * n;
  // Domain shapes: the ends of a segment on each loop, its direction, and the order of the loops.
  double shapes = 1;
  for (uint32_t c = 0; c < loops.loopCount(); ++c)
    shapes *= double(loops.size(c)) * loops.size(c) * (c < 2 ? 1 : 2.0 * c);
  return shapes * n * (loops.loopCount() == 2 ? 20 : 300);
}

}  // namespace sf
