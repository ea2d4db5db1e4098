#include "loops/solver.h"

#include <algorithm>
#include <cmath>

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

/// Whether the relaxed bound can be tried: at the root alone, each triangle with its apex on the
/// same loop splits the holes in 2^(k-1) ways.
bool holesFit(const LoopSet& loops, const CandidateSet& set, uint32_t root, const Work& work) {
  const uint32_t edge = set.loopEdges[root];
  double splits = 0;
  for (uint32_t s = set.edgeSlots[edge]; s < set.edgeSlots[edge + 1]; ++s) {
    const bool sameLoop = loops.loopOf(set.slotApex[s]) == loops.loopOf(root);
    if (sameLoop) splits += std::ldexp(1.0, int(std::min(loops.loopCount() - 1, 1000u)));
  }
  return work.fits(splits * RelaxedBound::kBytesPerSplit);
}

/// One pass in one measure, from fraction `from` to `to` of the work. The least cost, infinity if
/// there is no surface.
bool runPass(const LoopSet& loops, const CandidateSet& set, const std::vector<double>& triangleCost,
             Measure measure, uint32_t root, double from, double to, Work& work, double& cost,
             Surface& surface) {
  const bool single = loops.loopCount() == 1;
  SegmentTable segments;
  const double segmentShare = single ? 1 : 0.1;
  work.phase(from, from + segmentShare * (to - from));
  if (!segments.compute(loops, set, triangleCost, measure, work)) return false;
  const Pass pass{loops, set, triangleCost, measure, segments, work};
  if (single) {
    const uint32_t edge = set.loopEdges[root];
    const ClosedSegment all{edge, segments.sideFrom(edge, loops.next(root))};
    const uint32_t slot = segments.bestSplit(all, kNone);
    cost = slot == kNone ? kInfinity : segments.splitValue(all, slot);
    surface.order.clear();
    traceSegment(pass, all, kNone, surface.order);
    surface.domains += set.slotTriangle.size();
    surface.minimalSets += set.slotTriangle.size();
    return true;
  }
  if (!holesFit(loops, set, root, work)) {
    work.fail(Status::TooLarge);
    return false;
  }
  work.phase(from + segmentShare * (to - from), from + 0.95 * (to - from));
  RelaxedBound bound(pass);
  const std::vector<uint32_t> rootShape = Domains(loops).root(root);
  if (!bound.compute(rootShape)) return false;
  work.phase(from + 0.95 * (to - from), to);
  ExactSolver solver(pass, bound, root);
  if (!solver.solve(cost, surface.order)) return false;
  surface.domains += bound.domainCount() + solver.domainCount();
  surface.minimalSets += solver.minimalSetCount();
  return true;
}

}  // namespace

bool solveSurface(const LoopSet& loops, const CandidateSet& set, double dihedralWeight,
                  Objective objective, Work& work, Surface& surface) {
  surface = {};
  const uint32_t root = chooseRoot(loops, set);
  if (root == kNone) return work.going();

  double cost = kInfinity;
  if (objective == Objective::Sum) {
    if (!runPass(loops, set, set.weight, Measure::sum(dihedralWeight), root, 0, 1, work, cost,
                 surface))
      return false;
    surface.found = cost < kInfinity;
    surface.lowerBound = cost;
    return true;
  }

  const std::vector<double> angle =
      set.boundaryAngle.empty() ? std::vector<double>(set.size(), 0) : set.boundaryAngle;
  if (!runPass(loops, set, angle, Measure::worst(), root, 0, 0.5, work, cost, surface))
    return false;
  if (cost == kInfinity) return true;
  surface.lowerBound = cost;
  const double cap = cost + kAngleTie;
  std::vector<double> weight = set.weight;
  for (size_t t = 0; t < weight.size(); ++t)
    if (angle[t] > cap) weight[t] = kInfinity;
  if (!runPass(loops, set, weight, Measure::sum(dihedralWeight, cap), root, 0.5, 1, work, cost,
               surface))
    return false;
  SF_ASSERT(cost < kInfinity);
  surface.found = true;
  return true;
}

double predictedTimeOfAllTriples(const LoopSet& loops) {
  const double n = loops.vertexCount();
  if (loops.loopCount() == 1) return 12 * n * n * n;
  // Domain shapes: the ends of a segment on each loop, its direction, and the order of the loops.
  double shapes = 1;
  for (uint32_t c = 0; c < loops.loopCount(); ++c)
    shapes *= double(loops.size(c)) * loops.size(c) * (c < 2 ? 1 : 2.0 * c);
  return shapes * n * 300;
}

}  // namespace sf
