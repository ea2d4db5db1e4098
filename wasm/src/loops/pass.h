// What one pass of the solver works on; see weight.h for why there may be two passes.
#pragma once
#include <vector>

#include "loops/candidate_set.h"
#include "loops/segment_table.h"
#include "loops/weight.h"

namespace sf {

struct Pass {
  const LoopSet& loops;
  const CandidateSet& set;
  const std::vector<double>& triangleCost;  // [c] w(t) in the measure; infinity: not allowed
  Measure measure;
  const SegmentTable& segments;  // of the same loops, set, costs and measure
  Work& work;

  /// The segment that fills a part of one segment without holes, closed by its access edge.
  ClosedSegment closedSegment(uint32_t edge, bool reversed, uint32_t start, uint32_t end) const {
    return {edge, segments.sideFrom(edge, reversed ? end : start)};
  }
};

}  // namespace sf
