// A good surface over several loops, fast and without a proof: by cutting along bridges.
// Source: none in Zou, Ju, Carr 2013; large neighbourhood search (Shaw 1998) over the paper's own
// easy case, one polygon.
//
// A surface over k loops has edges that join different loops, its *bridges*. Cut it along k - 1
// bridges that make the loops a tree: it becomes a disc, bounded by one polygon in which the ends
// of the bridges repeat. That polygon is solved in near-linear time, which gives the best of all
// surfaces with these bridges. So any tree of bridges gives a first surface, if there is one with
// them. A surface is improved by cutting it along others of its own bridges, now and then along one
// or two fewer, so that two or three loops are solved at once. The polygon does not see the angles
// across the bridges; they are charged against the triangles that stand there now.
#pragma once
#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/charge.h"
#include "loops/problem/loop_triangles.h"
#include "loops/search/bridge_cut.h"

namespace sf {

/// Receives every surface that is better than the one before.
class SurfaceListener {
 public:
  virtual ~SurfaceListener() = default;
  ///   order       the triangles, in numbers of the candidate set
  ///   lowerBound  of the objective, proven so far
  virtual void better(const SplitOrder& order, double lowerBound) = 0;
};

/// The best surface of a pass so far.
class Incumbent {
 public:
  ///   lowerBound  of the objective, proven; raise() increases it
  Incumbent(Measure measure, SurfaceListener* listener, double lowerBound = 0)
      : measure_(measure), listener_(listener), lowerBound_(lowerBound) {}

  /// Takes a valid surface if it is better.
  void offer(SplitOrder order, double cost) {
    if (!(cost < kInfinity) || !measure_.improves(cost, cost_)) return;
    cost_ = cost;
    order_ = std::move(order);
    if (listener_) listener_->better(order_, std::min(lowerBound_, cost));
  }
  void raise(double lowerBound) { lowerBound_ = std::max(lowerBound_, lowerBound); }
  /// Infinity while there is none.
  double cost() const { return cost_; }
  const SplitOrder& order() const { return order_; }

 private:
  Measure measure_;
  SurfaceListener* listener_;
  double lowerBound_;
  double cost_ = kInfinity;
  SplitOrder order_;
};

class SurfaceSearch {
 public:
  /// For several loops. O(c log c) time, some 100 bytes a candidate.
  SurfaceSearch(const Task& task, Incumbent& best);

  /// Begins from these triangles if they are a surface of candidates, else from those of their
  /// edges that are bridges. They may be an earlier answer, to loops that have been edited since.
  /// Triangles that are no longer candidates do no harm.
  ///   triangles  over the task's loops
  bool startFrom(const LoopTriangles& triangles);

  /// Up to `tries` cuts, each about as expensive as one polygon of n + 2k - 2 vertices; fewer if
  /// many in a row bring nothing better. False when the work ended.
  bool search(uint32_t tries);

 private:
  static constexpr uint32_t kMostIdle = 200;

  struct Bridge {
    double key;
    uint32_t edge;
  };
  class Forest;

  double random();
  void keepNear();
  /// Offers the triangles if they are a surface of candidates; returns whether they are.
  bool offerAsIs(const LoopTriangles& triangles);
  /// What the triangles cost together; false, with the edges at fault, if they are no surface.
  bool measureSurface(const SplitOrder& order, double& cost, std::vector<uint32_t>& badEdges) const;
  /// Edges that join the loops to one tree, or to `trees` trees; edges early in the list come
  /// first. Empty if the list does not suffice. Increasing.
  std::vector<uint32_t> chooseBridges(std::vector<Bridge>& byKey, uint32_t trees) const;
  /// A cut along random bridges, which need not be in any surface.
  ///   preferred  edges to take first, increasing
  BridgeCut cutAtRandom(const std::vector<uint32_t>& preferred);
  void joinLoop(std::vector<uint32_t>& polygon, uint32_t at, uint32_t v);
  /// A cut of the best surface that leaves `loops` loops.
  BridgeCut cutBest(uint32_t loops);
  bool solveCut(const BridgeCut& cut, uint64_t maxSplits);
  void lookAtBest();

  const Task& task_;
  Incumbent& best_;
  Charge memory_;
  std::vector<uint32_t> kept_;     // triangles to look at
  std::vector<Bridge> bridges_;    // edges between loops
  std::vector<double> leastPair_;  // [slots]
  double costOfUses_ = kInfinity;  // of the surface whose edges are in uses_
  std::vector<EdgeUse> uses_;      // edges of the best surface
  uint64_t seed_ = 1;
  uint32_t idle_ = 0;
};

}  // namespace sf
