// A good surface over several loops, fast and without a proof: by cutting along bridges.
// Source: none in Zou, Ju, Carr 2013; large neighbourhood search (Shaw 1998) over the paper's own
// easy case, one polygon.
//
// A surface over k loops has edges that join different loops, its *bridges*. Cut along k - 1 of them
// that make the loops a tree, it becomes a disc whose boundary is one polygon, with the ends of the
// bridges repeated, and that polygon is solved in near-linear time: the best of all surfaces with
// these bridges. So any tree of bridges gives a first surface, if there is one with them, and a
// surface is improved by cutting it along others of its own bridges, now and then along one or two
// fewer, so that two or three loops are solved for at once. What is left out, the angles across the
// bridges, is charged by what stands across them now.
#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "base/charge.h"
#include "loops/direct_solver.h"

namespace sf {

/// Is told of every surface that is better than the one before.
class SurfaceListener {
 public:
  virtual ~SurfaceListener() = default;
  /// The triangles, in numbers of the candidate set.
  virtual void better(const SplitOrder& order) = 0;
};

/// The best surface of a pass so far.
class Incumbent {
 public:
  Incumbent(Measure measure, SurfaceListener* listener) : measure_(measure), listener_(listener) {}

  /// Takes a valid surface if it is better.
  void offer(SplitOrder order, double cost) {
    if (!(cost < kInfinity) || !measure_.improves(cost, cost_)) return;
    cost_ = cost;
    order_ = std::move(order);
    if (listener_) listener_->better(order_);
  }
  /// Infinity while there is none.
  double cost() const { return cost_; }
  const SplitOrder& order() const { return order_; }

 private:
  Measure measure_;
  SurfaceListener* listener_;
  double cost_ = kInfinity;
  SplitOrder order_;
};

class SurfaceSearch {
 public:
  /// For several loops. O(c log c) time, some 100 bytes a candidate.
  SurfaceSearch(const Task& task, Incumbent& best);

  /// Begins from the bridges that are edges of these triangles: of an earlier answer to loops that
  /// have been edited, say. [3m] vertices; those that are no candidates any more do no harm.
  bool startFrom(ArrayView<const uint32_t> triangles);

  /// Up to `tries` cuts, each about as expensive as one polygon of n + 2k - 2 vertices; fewer after
  /// many in a row without success. False when the work ended.
  bool search(uint32_t tries);

 private:
  static constexpr uint32_t kMostIdle = 200;

  /// Loops with repeated vertices, which a cut along bridges leaves.
  struct Cut {
    std::vector<uint32_t> origin;   // [N] vertex at each position
    std::vector<uint32_t> across;   // [N] slot across the side from each position to the next, the
                                    // triangle that stands there now; kNone: none is known
    std::vector<uint32_t> starts;   // [j+1] of the loops that are left
    std::vector<uint32_t> bridges;  // edges that were cut
    void clear();
  };
  /// An edge of the best surface with one of its triangles.
  struct Use {
    uint32_t edge, triangle;
    bool operator<(const Use& u) const {
      return edge < u.edge || (edge == u.edge && triangle < u.triangle);
    }
  };
  struct Bridge {
    double key;
    uint32_t edge;
  };
  class Forest;

  double random();
  void keepNear();
  bool measureSurface(const SplitOrder& order, double& cost, std::vector<uint32_t>& badEdges) const;
  /// A cut along random bridges of the candidates, which need not be in any surface.
  void cutAtRandom(Cut& cut, const std::vector<uint32_t>& preferred);
  /// A cut of the best surface that leaves `loops` loops.
  void cutBest(uint32_t loops, Cut& cut);
  uint32_t mate(uint32_t edge, uint32_t triangle) const;
  bool solveCut(const Cut& cut, uint64_t maxSplits);
  double costInCut(const Cut& cut, const LoopSet& loops, uint32_t t, const uint32_t place[3]) const;
  void lookAtBest();

  const Task& task_;
  Incumbent& best_;
  Charge memory_;
  std::vector<uint32_t> kept_;     // triangles that are looked at
  std::vector<Bridge> bridges_;    // edges between loops
  std::vector<double> leastPair_;  // [slots]
  std::vector<uint8_t> isBridge_;  // [e] of the cut at work
  double costOfUses_ = kInfinity;  // of the surface that uses_ is of
  std::vector<Use> uses_;          // edges of the best surface, sorted
  uint64_t seed_ = 1;
  uint32_t idle_ = 0;
};

}  // namespace sf
