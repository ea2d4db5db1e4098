// The triangles that a surface without large dihedral angles can have, from what happens around
// single vertices.
// Source: none in Zou, Ju, Carr 2013. As fan_bound.h, for the largest angle in place of the sum: the
// triangles at a vertex form one fan, from the one loop edge there to the other.
#pragma once
#include <cstdint>
#include <vector>

#include "base/charge.h"
#include "loops/problem/candidate_set.h"
#include "loops/problem/weight.h"

namespace sf {

class FanFilter {
 public:
  /// `triangleCost` [c]: the largest angle of a triangle to a given face, 0 if there is none.
  FanFilter(const LoopSet& loops, const CandidateSet& set, const std::vector<double>& triangleCost,
            Work& work);

  /// Keeps the triangles that are, at each of their corners, in some fan of triangles that are kept,
  /// without an angle above `cap`. All triangles of all surfaces without such an angle are among
  /// them; if none is left, there is no such surface. False when the work ended.
  /// Time: candidates times their neighbours, for each time that some of them go.
  ///   kept  triangles, increasing
  bool filter(double cap, std::vector<uint32_t>& kept);

  /// An angle below which the largest one of no surface is, at most `best` and to within 1e-3 rad as
  /// good as the filter can tell. False when the work ended.
  bool bound(double best, double& lowerBound);

 private:
  /// A triangle at one of its edges, seen from one end of that edge: twice the slot, plus 1 for the
  /// higher-numbered end. A walk round that end leaves the triangle through the edge.
  uint32_t spoke(uint32_t slot, uint32_t v) const;
  uint32_t vertexOf(uint32_t spoke) const;
  /// The spoke of the same triangle and vertex at the triangle's other edge there.
  uint32_t partner(uint32_t spoke) const;
  bool passes(uint32_t slot, uint32_t other) const;
  bool walk(bool backward, std::vector<uint8_t>& reached);

  const LoopSet& loops_;
  const CandidateSet& set_;
  const std::vector<double>& triangleCost_;
  Work& work_;
  Charge memory_;
  double cap_ = 0;
  std::vector<uint32_t> edgeOfSlot_;         // [slots]
  std::vector<uint8_t> alive_;               // [c]
  std::vector<uint8_t> forward_, backward_;  // [2 slots]
  std::vector<uint32_t> queue_;
};

}  // namespace sf
