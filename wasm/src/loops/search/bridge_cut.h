// Cuts a surface over several loops along some of its bridges, the edges from loop to loop, and
// solves the problem over fewer loops that is left.
// Source: none in Zou, Ju, Carr 2013; see surface_search.h.
#pragma once
#include <cstdint>
#include <vector>

#include "loops/bounds/direct_solver.h"

namespace sf {

/// The loops that a cut leaves. Vertices repeat in them:
/// each side of a bridge is one of their edges.
struct BridgeCut {
  std::vector<uint32_t> origin;   // [N] vertex at each position
  std::vector<uint32_t> across;   // [N] slot of the triangle across the side from each
                                  // position to the next; kNone: no bridge, or not known
  std::vector<uint32_t> starts;   // [j+1] of the loops that are left, as in a LoopSet
  std::vector<uint32_t> bridges;  // edges that were cut, increasing

  bool isEmpty() const { return origin.empty(); }
};

/// An edge of a surface with one of its triangles.
struct EdgeUse {
  uint32_t edge, triangle;
  bool operator<(const EdgeUse& u) const {
    return edge < u.edge || (edge == u.edge && triangle < u.triangle);
  }
};

/// The edges of a surface's triangles, sorted. [3m]
std::vector<EdgeUse> edgeUses(const CandidateSet& set, const SplitOrder& order);

/// Whether triangles are a surface over the loops by definition 3.2 of Zou, Ju, Carr 2013. Puts
/// them in the order of splitting, each but the first beside an earlier one. O(m log m).
///   triangles  numbers in the set, no two alike
bool isSurface(const LoopSet& loops, const CandidateSet& set, SplitOrder& triangles);

/// Cuts a valid surface along `bridges` (increasing), which must not join loops in a circle.
///   uses  of the surface, see edgeUses
BridgeCut cutSurface(const CandidateSet& set, const std::vector<EdgeUse>& uses,
                     std::vector<uint32_t> bridges);

/// The candidates over the positions of a cut. Bridges and loop edges occur in triangles only as
/// sides. The pair weight across a bridge is charged half to each of its sides.
class CutProblem {
 public:
  /// `task` and `cut` have to outlive it.
  CutProblem(const Task& task, const BridgeCut& cut) : task_(task), cut_(cut) {}
  ~CutProblem() { task_.work.release(charged_); }
  CutProblem(const CutProblem&) = delete;
  CutProblem& operator=(const CutProblem&) = delete;

  /// From the triangles `kept` of the task's set. False when the work ended.
  ///   leastPair  [slots] charged across bridges where nothing is known to stand
  bool build(ArrayView<const uint32_t> kept, const std::vector<double>& leastPair);

  /// Finds the best surface; `order` is in numbers of the task's set. False when the work ended.
  bool solve(uint64_t maxSplits, double& cost, SplitOrder& order);

  /// Chords of the last solution that stand for this edge of the task's set.
  /// forbid() rules one out.
  std::vector<uint32_t> chordsOf(uint32_t edge) const;
  void forbid(uint32_t chord);

 private:
  void addCopy(uint32_t t, const uint32_t place[3], const std::vector<double>& leastPair);

  const Task& task_;
  const BridgeCut& cut_;
  uint64_t charged_ = 0;
  LoopSet loops_;
  CandidateSet set_;
  std::vector<uint32_t> triples_;  // [3c] before they move into set_
  std::vector<uint32_t> parent_;   // [c] triangle of the task's set
  std::vector<double> cost_;       // [c]
  SplitOrder solution_;            // in numbers of set_
};

}  // namespace sf
