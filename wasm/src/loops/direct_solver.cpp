#include "loops/direct_solver.h"

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

bool isLarge(const LoopSet& loops, const CandidateSet& set) {
  return double(set.size()) > 24 * (double(loops.vertexCount()) + 2.0 * loops.loopCount() - 4);
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
  optimum = {};
  const LoopSet& loops = task.loops;
  const CandidateSet& set = task.set;
  Work& work = task.work;
  const uint32_t root = chooseRoot(loops, set);
  if (root == kNone) {
    optimum.reached = true;
    optimum.lowerBound = kInfinity;
    return work.going();
  }
  SegmentTable segments;
  if (!segments.compute(loops, set, task.triangleCost, task.measure, work)) return false;
  const Pass pass{loops, set, task.triangleCost, task.measure, segments, work};
  if (loops.loopCount() == 1) {
    solvePolygonTable(pass, root, optimum, counts);
    optimum.lowerBound = optimum.cost;
    return true;
  }
  const auto solveExactly = [&](LowerBound& bound) {
    optimum.lowerBound = bound.rootBound();
    task.tell(incumbent, bound.rootBound());
    ExactSolver solver(pass, bound, root);
    const bool solved = solver.solve(optimum.cost, optimum.order);
    counts.domains += solver.domainCount();
    counts.minimalSets += solver.minimalSetCount();
    optimum.reached = solved;
    if (solved)
      optimum.lowerBound = optimum.cost;
    else
      optimum.cost = kInfinity;
    return solved;
  };
  if (isLarge(loops, set) && isDense(loops, set)) {
    TwoLoopBound bound(pass, root);
    const bool bounded = bound.compute();
    counts.domains += bound.domainCount();
    return bounded && solveExactly(bound);
  }
  RelaxedBound bound(pass);
  const std::vector<uint32_t> rootShape = Domains(loops).root(root);
  const bool bounded = bound.compute(rootShape, maxSplits);
  counts.domains += bound.domainCount();
  if (!bounded) return work.going();
  return solveExactly(bound);
}

}  // namespace sf
