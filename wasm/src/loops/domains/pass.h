// What one pass of the solver minimises, and over what. There may be two passes: see weight.h.
#pragma once
#include <algorithm>
#include <vector>

#include "base/work.h"
#include "loops/one_loop/segment_table.h"
#include "loops/problem/candidate_set.h"
#include "loops/problem/weight.h"

namespace sf {

struct Task {
  const LoopSet& loops;
  const CandidateSet& set;
  const std::vector<double>& triangleCost;  // [c] w(t) in the measure; infinity: not allowed
  Measure measure;
  Work& work;
  bool isObjective =
      false;  // whether costs are in the unit of the objective, to be reported on the way

  /// Reports a cost and a bound that are now known.
  void tell(double bestCost, double lowerBound) const {
    if (isObjective) work.setBounds(bestCost, std::min(lowerBound, bestCost));
  }
};

/// A task with its table of segments, which all solvers by domains need.
struct Pass : Task {
  const SegmentTable& segments;  // of the same loops, set, costs and measure

  /// The segment that fills a part made of one segment without holes; its access edge closes it.
  ClosedSegment closedSegment(uint32_t edge, bool reversed, uint32_t start, uint32_t end) const {
    return {edge, segments.sideFrom(edge, reversed ? end : start)};
  }
};

}  // namespace sf
