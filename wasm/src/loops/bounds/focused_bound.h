// R of relaxed_bound.h, only for the domains that a surface of at most a given cost can have: a
// small part of all domains if there are many loops.
// Source: none in Zou, Ju, Carr 2013. Best-first search of AND/OR graphs (Martelli, Montanari
// 1978), level by level.
//
// Top-down, from domains of more triangles to those of fewer, each domain gets a lower bound on the
// cost of everything outside of it. If that and the estimate of its inside are too dear together,
// the domain is never made. Bottom-up, the estimates of the domains made become R if R is below the
// given cost, and better estimates otherwise, since splits that were left out count by their own
// estimates. So when the limit rises, fewer domains pass than would have passed at once.
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

  /// Computes R for those domains of the root that a surface of cost `most` or less can have;
  /// `most` rises from call to call. Takes its splits of domains from `splitsLeft`. False when
  /// these are used up or the work ended: values are still bounds then, but the exact solver must
  /// not search by them.
  bool compute(ArrayView<const uint32_t> root, double most, uint64_t& splitsLeft);

  /// No surface costs less. It is R of the root if that is at most `most`.
  double rootBound() const override { return rootBound_; }
  /// Infinity for domains that are left out.
  double value(Shape shape, uint32_t slot) override;
  double limit(Shape shape, uint32_t slot) override;
  uint64_t domainCount() const { return table_.size(); }

 private:
  /// A domain, by number. Both arrays have one cost for each triangle at the access edge.
  struct Node {
    double* inside;   // lower bounds, bi-triangle weight included
    double* outside;  // lower bounds, in this round
    uint32_t round;   // when it was last made
    uint32_t next;    // node with as many triangles, kNone after the last
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
    uint32_t node = kNone;  // kNone while it is not known
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
  std::vector<uint32_t> bySize_;  // by number of triangles: the first node to visit
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
