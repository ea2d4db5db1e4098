// Finds the triangles that a surface without large dihedral angles can have, by looking around
// single vertices.
// Source: none in Zou, Ju, Carr 2013. Like fan_bound.h, for the largest angle in place of the sum:
// the triangles at a vertex form one fan, from the one loop edge there to the other.
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

  /// Keeps a triangle if each of its corners has a fan through it, made of kept triangles and
  /// without an angle above `cap`. All surfaces without such an angle consist of kept triangles; if
  /// none is kept, there is no such surface. False when the work ended.
  /// Time: candidates times their neighbours, for each round in which some are dropped.
  ///   kept  triangles, increasing
  bool filter(double cap, std::vector<uint32_t>& kept);

  /// A lower bound on the largest angle of every surface: at most `best`, and within 1e-3 rad of
  /// the best bound that the filter can prove. False when the work ended.
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
