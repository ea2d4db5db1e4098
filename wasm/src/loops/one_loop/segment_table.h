// Optimal triangulations of all domains that are one segment of one loop and have no holes.
// Source: Zou, Ju, Carr 2013, sec. 3.1, eq. 2 (Barequet, Dickerson, Eppstein 1996).
// Differs: bottom-up by segment length in place of memoised recursion. For one polygon this table
// is the whole answer; for several the recursion of the solver ends in it.
#pragma once
#include <cstdint>
#include <vector>

#include "base/work.h"
#include "loops/problem/candidate_set.h"
#include "loops/problem/weight.h"

namespace sf {

/// A run of a loop from vertex `start` forward to vertex `end`, with the candidate edge that
/// closes it. `side` says which of the two runs between the ends of the edge is meant.
struct ClosedSegment {
  uint32_t edge;
  uint32_t side;  // 0: from the lower-numbered end forward; 1: from the higher one, wrapping round
};

class SegmentTable {
 public:
  /// Fills the table. False when `work` ended. O(sum over edges of degree^2) time,
  /// 16 bytes a slot.
  bool compute(const LoopSet& loops, const CandidateSet& set,
               const std::vector<double>& triangleCost, Measure measure, Work& work);
  ~SegmentTable();

  /// W(D) for the segment closed by the slot's edge, with the slot's triangle as access triangle:
  /// its bi-triangle weight is counted, its own weight is not.
  /// Infinity if there is no triangulation.
  /// Precondition: both ends of the edge lie on one loop; the apex is not inside the segment.
  double value(uint32_t slot, uint32_t side) const { return values_[2 * size_t(slot) + side]; }

  /// The slot of the triangle that splits the segment best for this slot of the access triangle.
  /// kNone as access slot is the root, where the segment is all of a loop but its closing edge.
  /// Returns kNone if the segment is a single loop edge, which is empty, or has no triangulation.
  uint32_t bestSplit(ClosedSegment segment, uint32_t accessSlot) const;

  /// W of the split of the segment by the triangle at `slot`, its own weight included, without
  /// the bi-triangle weight to an access triangle.
  double splitValue(ClosedSegment segment, uint32_t slot) const;

  /// The two segments that a split by the triangle at `slot` leaves.
  void parts(ClosedSegment segment, uint32_t slot, ClosedSegment part[2]) const;

  /// The side of `edge` whose segment starts at `start`, one of the edge's ends.
  uint32_t sideFrom(uint32_t edge, uint32_t start) const {
    return set_->edgeVertices[2 * size_t(edge)] == start ? 0 : 1;
  }

 private:
  bool isInside(ClosedSegment segment, uint32_t v) const;
  uint32_t segmentLength(ClosedSegment segment) const;

  const LoopSet* loops_ = nullptr;
  const CandidateSet* set_ = nullptr;
  const std::vector<double>* triangleCost_ = nullptr;
  Work* work_ = nullptr;
  Measure measure_ = Measure::sum(1);
  std::vector<double> values_;  // [2 slots]
};

}  // namespace sf
