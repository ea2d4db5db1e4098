// R of relaxed_bound.h, only for the domains that a surface of at most a given cost can have: a small
// part of all where there are many loops.
// Source: none in Zou, Ju, Carr 2013. Best-first search of AND/OR graphs (Martelli, Montanari 1978),
// level by level.
//
// Top-down, from domains of more triangles to those of fewer, each knows what all that is outside of it
// costs at least. With an estimate for what is inside, domains that are too dear together are never made.
// Bottom-up, the estimates of those that were made become R, as far as it is below the given cost, or
// better estimates: what was left out counts by its own. So the next time, with a higher limit, fewer
// domains pass than would have at once.
#pragma once
#include <cstdint>
#include <vector>

#include "base/arena.h"
#include "base/charge.h"
#include "loops/bounds/fan_estimate.h"
#include "loops/domains/domain.h"
#include "loops/domains/domain_table.h"
#include "loops/domains/lower_bound.h"
#include "loops/domains/pass.h"
#include "loops/one_loop/angular_transform.h"

namespace sf {

class FocusedBound final : public LowerBound {
 public:
  /// For sums only. `estimate` and `leastPair` are of the same pass.
  FocusedBound(const Pass& pass, const std::vector<double>& leastPair, FanEstimate& estimate);

  /// Computes R for what surfaces that cost at most `most` have of the root's domains; `most` rises from
  /// call to call. Takes its splits of domains from `splitsLeft`. False when these are used up, or the
  /// work ended: then values are bounds as before, but not to be searched by.
  bool compute(ArrayView<const uint32_t> root, double most, uint64_t& splitsLeft);

  /// No surface costs less. R of the root, if that is at most what surfaces might cost.
  double rootBound() const override { return rootBound_; }
  /// Infinity for domains that are left out.
  double value(Shape shape, uint32_t slot) override;
  double limit(Shape shape, uint32_t slot) override;
  uint64_t domainCount() const { return table_.size(); }

 private:
  /// A domain, by number; both costs by the place of the access triangle at the access edge.
  struct Node {
    double* inside;   // at least, bi-triangle weight included
    double* outside;  // at least, in this round
    uint32_t round;   // when it was last made
    uint32_t next;    // of as many triangles, kNone after the last
  };
  /// A way to split a domain that is not too dear.
  struct Entry {
    uint32_t index;         // of the triangle, at the access edge
    uint32_t part[2];       // nodes, kNone for a part whose cost is in `cost`
    uint32_t partIndex[2];  // of the triangle at the part's access edge
    double cost;            // w(t) and parts that are not domains
  };
  struct Visit {
    uint32_t node;
    size_t firstEntry, firstDear;
  };
  struct Part {
    uint32_t node = kNone;  // if it is known already
    uint32_t index = 0;
    double inside = 0;
    std::vector<uint32_t> key;  // empty: no domain
  };

  uint32_t reach(ArrayView<const uint32_t> key);
  bool visit(uint32_t node, uint64_t& splitsLeft);
  bool addSplit(const Split& split, uint32_t t, uint32_t index, double outside, double& dear);
  void improve(const Visit& visit, size_t endOfEntries);

  const Pass& pass_;
  const std::vector<double>& leastPair_;
  FanEstimate& estimate_;
  Charge memory_;
  Domains domains_;
  DomainTable table_;
  Arena arena_;
  AngularTransform transform_;
  std::vector<Node> nodes_;
  std::vector<uint32_t> bySize_;  // by triangles: the first node to visit
  std::vector<Visit> visits_;     // of this round
  std::vector<Entry> entries_;    // by visit
  std::vector<double> dear_;      // by visit and triangle: the cheapest split that was left out
  uint32_t round_ = 0;
  double most_ = -kInfinity;
  double rootBound_ = -kInfinity;
  // Scratch.
  Part part_[2];
  std::vector<double> theta_, base_, at_, best_;
};

}  // namespace sf
