#include "loops/bounds/direct_solver.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "loops/bounds/focused_bound.h"
#include "loops/bounds/relaxed_bound.h"
#include "loops/bounds/two_loop_bound.h"

namespace sf {
namespace {

/// How many limits of cost are tried, one after the other.
constexpr int kLimits = 4;

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

/// Finds where the exact solver begins. False, with the bound infinite, if there is no surface.
bool findRoot(const Task& task, uint32_t& root, Optimum& optimum) {
  optimum = {};
  root = chooseRoot(task.loops, task.set);
  if (root != kNone) return true;
  optimum.reached = true;
  optimum.lowerBound = kInfinity;
  return false;
}

bool solveExactly(const Pass& pass, LowerBound& bound, uint32_t root, double most, double& cost,
                  SplitOrder& order, SolverCounts& counts) {
  ExactSolver solver(pass, bound, root);
  const bool solved = solver.solve(most, cost, order);
  counts.domains += solver.domainCount();
  counts.minimalSets += solver.minimalSetCount();
  return solved;
}

void solvePolygonTable(const Pass& pass, uint32_t root, Optimum& optimum, SolverCounts& counts) {
  const uint32_t edge = pass.set.loopEdges[root];
  const ClosedSegment all{edge, pass.segments.sideFrom(edge, pass.loops.next(root))};
  const uint32_t slot = pass.segments.bestSplit(all, kNone);
  optimum.reached = true;
  optimum.cost = slot == kNone ? kInfinity : pass.segments.splitValue(all, slot);
  traceSegment(pass, all, kNone, optimum.order);
  counts.domains += pass.set.slotTriangle.size();
  counts.minimalSets += pass.set.slotTriangle.size();
}

}  // namespace

double candidatesPerTriangle(const LoopSet& loops, const CandidateSet& set) {
  return double(set.size()) / (double(loops.vertexCount()) + 2.0 * loops.loopCount() - 4);
}

bool isLarge(const LoopSet& loops, const CandidateSet& set) {
  return candidatesPerTriangle(loops, set) > 24;
}

bool isDense(const LoopSet& loops, const CandidateSet& set) {
  if (loops.loopCount() != 2) return false;
  size_t across = 0;
  for (size_t e = 0; e < set.edgeVertices.size(); e += 2)
    across += loops.loopOf(set.edgeVertices[e]) != loops.loopOf(set.edgeVertices[e + 1]);
  return 4.0 * double(across) >= double(loops.size(0)) * loops.size(1);
}

bool solveDirectly(const Task& task, uint64_t maxSplits, double incumbent, Optimum& optimum,
                   SolverCounts& counts) {
  const LoopSet& loops = task.loops;
  const CandidateSet& set = task.set;
  uint32_t root;
  if (!findRoot(task, root, optimum)) return task.work.going();
  SegmentTable segments;
  if (!segments.compute(loops, set, task.triangleCost, task.measure, task.work)) return false;
  const Pass pass{task, segments};
  if (loops.loopCount() == 1) {
    solvePolygonTable(pass, root, optimum, counts);
    optimum.lowerBound = optimum.cost;
    return true;
  }
  const auto solve = [&](LowerBound& bound) {
    optimum.lowerBound = bound.rootBound();
    task.tell(incumbent, bound.rootBound());
    optimum.reached =
        solveExactly(pass, bound, root, kInfinity, optimum.cost, optimum.order, counts);
    if (optimum.reached)
      optimum.lowerBound = optimum.cost;
    else
      optimum.cost = kInfinity;
    return optimum.reached;
  };
  if (loops.loopCount() == 2) {
    TwoLoopBound bound(pass, root);
    const bool bounded = bound.compute(maxSplits);
    counts.domains += bound.domainCount();
    return bounded ? solve(bound) : task.work.going();
  }
  RelaxedBound bound(pass);
  const std::vector<uint32_t> rootShape = Domains(loops).root(root);
  const bool bounded = bound.compute(rootShape, maxSplits);
  counts.domains += bound.domainCount();
  return bounded ? solve(bound) : task.work.going();
}

bool solveWithin(const Task& task, FanEstimate& estimate, const std::vector<double>& leastPair,
                 double most, uint64_t maxSplits, Optimum& optimum, SolverCounts& counts) {
  uint32_t root;
  if (!findRoot(task, root, optimum)) return task.work.going();
  SegmentTable segments;
  if (!segments.compute(task.loops, task.set, task.triangleCost, task.measure, task.work))
    return false;
  const Pass pass{task, segments};
  FocusedBound bound(pass, leastPair, estimate);
  const std::vector<uint32_t> rootShape = Domains(task.loops).root(root);
  const double least = estimate.lowerBound();
  for (int i = 1; i <= kLimits && !optimum.reached; ++i) {
    const double limit = i == kLimits ? most : least + (most - least) * i / kLimits;
    // Sums in another order differ in the last digits.
    const double withRounding = limit + 1e-9 * std::fabs(limit) + estimate.rounding();
    if (!bound.compute(rootShape, withRounding, maxSplits)) break;
    const double proven = bound.rootBound() - estimate.rounding();
    optimum.lowerBound = std::max(optimum.lowerBound, std::min(proven, most));
    if (proven <= limit) {
      double cost;
      SplitOrder order;
      if (!solveExactly(pass, bound, root, limit, cost, order, counts)) break;
      if (cost < optimum.cost) optimum.cost = cost, optimum.order = std::move(order);
      // All surfaces that cost no more than the limit could be found.
      optimum.reached = optimum.cost <= limit;
      optimum.lowerBound = std::max(optimum.lowerBound, std::min(optimum.cost, limit));
    }
    optimum.reached = optimum.reached || i == kLimits;
    task.tell(std::min(most, optimum.cost), optimum.lowerBound);
  }
  counts.domains += bound.domainCount();
  return task.work.going();
}

}  // namespace sf
