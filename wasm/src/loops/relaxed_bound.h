// R: a lower bound on the cost of every domain, from a relaxation that forgets the triangles across
// all spanning edges but the access edge, and with them most of the state. Where such an edge closes
// at last, the least bi-triangle weight that the triangle on the near side can have is charged.
// Source: none in Zou, Ju, Carr 2013; it bounds eq. 2 for the domains of sec. 3.2.1 and leaves out
// the weak edge sets of sec. 3.2.2.
#pragma once
#include <cstdint>
#include <vector>

#include "base/arena.h"
#include "loops/angular_transform.h"
#include "loops/domain.h"
#include "loops/domain_table.h"
#include "loops/lower_bound.h"
#include "loops/pass.h"

namespace sf {

class RelaxedBound final : public LowerBound {
 public:
  explicit RelaxedBound(const Pass& pass);
  ~RelaxedBound() override;

  /// Computes R for the root and all that it can split into; false when the work ended, or after
  /// `maxSplits` splits of domains.
  /// Explicit stack. Memory: one double for each domain shape and triangle on its access edge.
  bool compute(ArrayView<const uint32_t> root, uint64_t maxSplits);

  double rootBound() const override { return rootBound_; }

  double value(Shape shape, uint32_t slot) override;
  uint64_t domainCount() const { return table_.size(); }

 private:
  /// One way to split the domain under work: a triangle and up to two parts that are domains.
  struct Entry {
    uint32_t slot;      // of the triangle, at the access edge
    uint32_t part[2];   // numbers of the parts, kNone for a part whose cost is in `cost`
    uint32_t index[2];  // of the triangle at the part's access edge
    double cost;        // w(t) joined with the costs of the parts that are not domains
  };
  struct Frame {
    uint32_t domain;
    size_t firstEntry, cursor;
  };
  bool open(uint32_t domain);
  bool addEntry(const Split& split, uint32_t slot);
  bool close(const Frame& frame);

  const Pass& pass_;
  Domains domains_;
  DomainTable table_;
  Arena arena_;
  std::vector<double*> values_;    // by domain: [degree of the access edge], null until computed
  std::vector<double> leastPair_;  // [slots]
  std::vector<Entry> entries_;     // of all open frames, one after the other
  size_t entriesCharged_ = 0;
  std::vector<Frame> frames_;
  // Scratch of close(): by index of the slot at the access edge, and of those that are finite.
  std::vector<double> best_, innerTheta_, innerBase_;
  AngularTransform transform_;
  std::vector<uint32_t> scratchKey_;
  double rootBound_ = kInfinity;
  uint64_t splitsLeft_ = 0;
};

}  // namespace sf
