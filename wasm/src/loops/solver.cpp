#include "loops/solver.h"

#include <algorithm>
#include <cmath>

#include "loops/fan_bound.h"
#include "loops/relaxed_bound.h"
#include "loops/two_loop_bound.h"

namespace sf {
namespace {

/// The loop edge with the fewest triangles, by its first vertex: the fewest splits at the root.
/// kNone if some loop edge has no triangle at all, so that no surface can reach it.
uint32_t chooseRoot(const LoopSet& loops, const CandidateSet& set) {
  uint32_t root = 0;
  for (uint32_t v = 0; v < loops.vertexCount(); ++v) {
    if (set.loopEdges[v] == kNone) return kNone;
    if (set.degree(set.loopEdges[v]) < set.degree(set.loopEdges[root])) root = v;
  }
  return root;
}

/// A pass over one set of candidates: what to minimise, and where the recursion begins.
struct Task {
  const LoopSet& loops;
  const CandidateSet& set;
  const std::vector<double>& triangleCost;
  Measure measure;
  Work& work;
  bool isObjective;  // whether costs are in the unit of the objective, to be told of on the way

  void tell(double bestCost, double lowerBound) const {
    if (isObjective) work.setBounds(bestCost, std::max(0.0, std::min(lowerBound, bestCost)));
  }
};

/// The optimum of a task, if it was reached.
struct Optimum {
  bool reached = false;
  double cost = kInfinity;  // infinity: there is no surface
  SplitOrder order;
};

/// Whether the candidates are many for the surface: dense arrays pay then, and fans do not, which
/// have multipliers for each of them.
bool isLarge(const LoopSet& loops, const CandidateSet& set) {
  return double(set.size()) > 24 * (double(loops.vertexCount()) + 2.0 * loops.loopCount() - 4);
}

constexpr uint64_t kUnlimited = ~uint64_t(0);

/// Solves a task by the domains of all its candidates, unless that takes more than `maxSplits` splits.
/// False when the work ended.
bool solveDirectly(const Task& task, uint64_t maxSplits, Optimum& optimum, Surface& surface) {
  optimum = {};
  const LoopSet& loops = task.loops;
  const CandidateSet& set = task.set;
  Work& work = task.work;
  const uint32_t root = chooseRoot(loops, set);
  if (root == kNone) {
    optimum.reached = true;
    return work.going();
  }
  SegmentTable segments;
  if (!segments.compute(loops, set, task.triangleCost, task.measure, work)) return false;
  const Pass pass{loops, set, task.triangleCost, task.measure, segments, work};
  if (loops.loopCount() == 1) {
    const uint32_t edge = set.loopEdges[root];
    const ClosedSegment all{edge, segments.sideFrom(edge, loops.next(root))};
    const uint32_t slot = segments.bestSplit(all, kNone);
    optimum.reached = true;
    optimum.cost = slot == kNone ? kInfinity : segments.splitValue(all, slot);
    traceSegment(pass, all, kNone, optimum.order);
    surface.domains += set.slotTriangle.size();
    surface.minimalSets += set.slotTriangle.size();
    return true;
  }
  const auto solveExactly = [&](LowerBound& bound) {
    task.tell(kInfinity, bound.rootBound());
    ExactSolver solver(pass, bound, root);
    const bool solved = solver.solve(optimum.cost, optimum.order);
    surface.domains += solver.domainCount();
    surface.minimalSets += solver.minimalSetCount();
    return solved;
  };
  if (loops.loopCount() == 2 && isLarge(loops, set)) {
    TwoLoopBound bound(pass, root);
    optimum.reached = bound.compute();
    surface.domains += bound.domainCount();
    return optimum.reached && solveExactly(bound);
  }
  RelaxedBound bound(pass);
  const std::vector<uint32_t> rootShape = Domains(loops).root(root);
  optimum.reached = bound.compute(rootShape, maxSplits);
  surface.domains += bound.domainCount();
  if (!optimum.reached) return work.going();
  return solveExactly(bound);
}

/// The same over some of the candidates only; the order is in numbers of the whole set.
bool solveSubset(const Task& task, const std::vector<uint32_t>& kept, uint64_t maxSplits,
                 Optimum& optimum, Surface& surface) {
  const uint64_t before = task.work.used();
  CandidateSet subset;
  std::vector<double> cost;
  for (const uint32_t t : kept) cost.push_back(task.triangleCost[t]);
  const bool good = buildSubset(task.loops, task.set, kept, task.work, subset) &&
                    solveDirectly({task.loops, subset, cost, task.measure, task.work, false},
                                  maxSplits, optimum, surface);
  task.work.release(task.work.used() - before);
  for (uint32_t& t : optimum.order) t = kept[t];
  return good;
}

/// Solves a task that is too large for all its domains: bounds it by its fans, finds a surface among
/// the triangles that look best by that bound, and then solves it over the triangles that the bound
/// and this surface leave. Both get better from round to round, and the rounds longer.
bool solveByFans(const Task& task, Optimum& optimum, Surface& surface) {
  FanBound fans(task.loops, task.set, task.triangleCost, task.measure, task.work);
  const double wanted = double(task.loops.vertexCount()) + 2.0 * task.loops.loopCount() - 4;
  std::vector<double> excess;
  std::vector<uint32_t> byExcess;
  Optimum best;
  double share = 1.25;  // candidates to look for a surface in, as a multiple of its triangles
  uint64_t maxSplits = 400000;  // of each subset, some hundredths of a second
  for (uint32_t round = 0; task.work.going(); ++round) {
    task.work.setFraction(1 - 1 / (1 + 0.3 * round));
    if (!fans.ascend(300, best.cost) || !fans.excess(excess)) return false;
    if (fans.lowerBound() == kInfinity) break;
    task.tell(best.cost, fans.lowerBound());
    byExcess.clear();
    for (uint32_t t = 0; t < excess.size(); ++t)
      if (excess[t] < kInfinity) byExcess.push_back(t);
    std::sort(byExcess.begin(), byExcess.end(), [&](uint32_t a, uint32_t b) {
      return excess[a] < excess[b] || (excess[a] == excess[b] && a < b);
    });
    // How many of them a surface that is better than the best one can have.
    const auto left = [&] {
      // Sums in another order differ in the last digits.
      const double most = best.cost + 1e-9 * std::fabs(best.cost) - fans.lowerBound();
      const auto end = std::partition_point(byExcess.begin(), byExcess.end(),
                                            [&](uint32_t t) { return !(excess[t] > most); });
      return size_t(end - byExcess.begin());
    };
    for (;;) {
      const size_t tried = std::min(left(), size_t(share * wanted) + 1);
      std::vector<uint32_t> kept(byExcess.begin(), byExcess.begin() + std::ptrdiff_t(tried));
      std::sort(kept.begin(), kept.end());
      Optimum found;
      if (!solveSubset(task, kept, maxSplits, found, surface)) return false;
      if (found.cost < best.cost) best = found;
      task.tell(best.cost, fans.lowerBound());
      // Whatever uses a triangle that was left out costs more than the best surface.
      if (found.reached && left() <= tried) {
        optimum = best;
        optimum.reached = true;
        return true;
      }
      if (!found.reached) break;
      share *= 1.5;
    }
    maxSplits *= 3;
    share = std::max(1.25, share / 1.5);
  }
  optimum.reached = true;  // there is no surface, if the work has not ended
  return task.work.going();
}

/// The optimum of one pass, from fraction `from` to `to` of the work.
bool runPass(const Task& task, double from, double to, uint64_t splitsPerVertex, Optimum& optimum,
             Surface& surface) {
  // Hubs make fans expensive: their labels may take what some times the candidates do.
  const double fanBytes = FanBound::bytesFor(task.loops, task.set);
  const bool direct = task.loops.loopCount() == 1 || task.measure.isWorst() ||
                      isLarge(task.loops, task.set) || !task.work.fits(fanBytes) ||
                      fanBytes > 40 * CandidateSet::bytesFor(double(task.set.size()));
  const uint64_t n = task.loops.vertexCount();
  const uint64_t firstSplits = splitsPerVertex < kUnlimited / n ? splitsPerVertex * n : kUnlimited;
  task.work.phase(from, direct ? to : from + 0.2 * (to - from));
  if (!solveDirectly(task, direct ? kUnlimited : firstSplits, optimum, surface)) return false;
  if (optimum.reached) return true;
  task.work.phase(from + 0.2 * (to - from), to);
  return solveByFans(task, optimum, surface);
}

}  // namespace

bool solveSurface(const LoopSet& loops, const CandidateSet& set, double dihedralWeight,
                  Objective objective, Work& work, Surface& surface, uint64_t splitsPerVertex) {
  surface = {};
  Optimum optimum;
  if (objective == Objective::Sum) {
    const Task task{loops, set, set.weight, Measure::sum(dihedralWeight), work, true};
    if (!runPass(task, 0, 1, splitsPerVertex, optimum, surface)) return false;
    surface.lowerBound = optimum.cost;
  } else {
    const std::vector<double> angle =
        set.boundaryAngle.empty() ? std::vector<double>(set.size(), 0) : set.boundaryAngle;
    if (!runPass({loops, set, angle, Measure::worst(), work, true}, 0, 0.5, splitsPerVertex,
                 optimum, surface))
      return false;
    if (optimum.cost == kInfinity) return true;
    surface.lowerBound = optimum.cost;
    const double cap = optimum.cost + kAngleTie;
    std::vector<double> weight = set.weight;
    for (size_t t = 0; t < weight.size(); ++t)
      if (angle[t] > cap) weight[t] = kInfinity;
    const Task task{loops, set, weight, Measure::sum(dihedralWeight, cap), work, false};
    if (!runPass(task, 0.5, 1, splitsPerVertex, optimum, surface)) return false;
    SF_ASSERT(optimum.cost < kInfinity);
  }
  surface.found = optimum.cost < kInfinity;
  surface.order = std::move(optimum.order);
  return true;
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
