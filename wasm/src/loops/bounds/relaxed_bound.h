// R: a lower bound on the cost of every domain. The relaxation forgets the triangles across all
// spanning edges but the access edge, and with them most of the state. When such an edge is closed
// at last, it charges the least bi-triangle weight that the triangle on the near
// side can have there.
// Source: none in Zou, Ju, Carr 2013; it bounds eq. 2 for the domains of sec. 3.2.1 and leaves out
// the weak edge sets of sec. 3.2.2.
//
// Most triangles move one end of the access edge along a loop and leave everything else as it is. A
// *context* is a domain's shape but for its access edge, and all domains of one context are its
// *fronts*: entries of an array over the candidate edges between the two loops that the access edge
// joins. Only contexts are looked up in a hash table, and they are few. The splits are those of
// Domains::forEachSplit, written a second time in terms of segments: to build the words of every
// part's shape and look them up took most of the time. Tests compare the two, domain by domain.
#pragma once
#include <cstdint>
#include <vector>

#include "base/arena.h"
#include "base/charge.h"
#include "loops/domains/domain.h"
#include "loops/domains/domain_table.h"
#include "loops/domains/lower_bound.h"
#include "loops/domains/pass.h"
#include "loops/one_loop/angular_transform.h"

namespace sf {

class RelaxedBound final : public LowerBound {
 public:
  explicit RelaxedBound(const Pass& pass);

  /// Computes R for the root and all domains that it can split into. False when the work ended, or
  /// after `maxSplits` splits of domains.
  /// Explicit stack. Memory: one double for each domain and triangle on its access edge, and a
  /// pointer for each context and candidate edge between the loops that its access edges join.
  bool compute(ArrayView<const uint32_t> root, uint64_t maxSplits);

  double rootBound() const override { return rootBound_; }

  double value(Shape shape, uint32_t slot) override;
  uint64_t domainCount() const { return domainCount_; }

 private:
  /// Whether the first segment (bit 0) and the last one (bit 1) pass their whole loop. This matters
  /// if the front's edge ends at the vertex where the segment begins: the segment is then the whole
  /// loop or that single vertex.
  using Whole = uint32_t;
  static constexpr Whole kWholeFirst = 1, kWholeLast = 2, kWholes = 4;

  /// The fronts of one context: one for each candidate edge between its two loops. Within one loop
  /// there are two for each edge, one for either run between its ends.
  struct Block {
    uint32_t context;
    Whole whole;
    double** values;  // by front: [degree of its edge], null until computed
  };
  struct Context {
    uint32_t block[kWholes];  // kNone until it is needed
  };
  struct Front {
    uint32_t block, number;
  };
  /// One way to split the current domain: a triangle and up to two parts that are domains.
  struct Entry {
    uint32_t slot;      // of the triangle, at the access edge
    Front part[2];      // block kNone for a part whose cost is in `cost`
    uint32_t index[2];  // of the triangle at the part's access edge
    double cost;        // w(t) joined with the costs of the parts that are not domains
  };
  struct Frame {
    Front front;
    uint32_t edge;
    size_t firstEntry, cursor;
  };
  /// A part of a split: segments `from` to `to` of the domain, with `first` and `last` in place of
  /// the outer two.
  struct Part {
    uint32_t from, to;
    Segment first, last;    // the same where from = to
    uint32_t apexOpposite;  // the vertex of the triangle that is not on its access edge
    bool repeats;           // its access edge spans the domain already
  };

  void findEdges();
  /// All holes of the current domain, one bit each. With 64 or more there would be no end to the
  /// ways to distribute them.
  uint64_t all() const {
    return holes_.size() < 64 ? (uint64_t(1) << holes_.size()) - 1 : ~uint64_t(0);
  }
  uint32_t pairOf(uint32_t u, uint32_t v) const;
  // Out of line: copies at each call would cost more in size than they save in time.
  [[gnu::noinline]] Front insertFront(Segment first, Segment last, uint32_t edge);
  [[gnu::noinline]] Front insertFront(Shape shape);
  [[gnu::noinline]] Front frontOf(uint32_t context, Whole whole, Segment first, uint32_t edge);
  static Whole wholeOf(Segment first, Segment last) {
    return (first.whole ? kWholeFirst : 0) | (last.whole ? kWholeLast : 0);
  }
  double*& valuesOf(Front front) { return blocks_[front.block].values[front.number]; }
  bool open(Front front);
  uint32_t readDomain(Front front);
  [[gnu::noinline]] bool splitAtHole(uint32_t slot, uint32_t loop);
  bool splitAtBoundary(uint32_t slot, uint32_t segment);
  bool splitWith(uint32_t slot, const Part part[2]);
  [[gnu::noinline]] bool distribute(uint32_t slot, const Part part[2], uint64_t toFirst);
  bool isFilled(const Part& part, uint32_t t, bool hasHoles, double& cost, bool& isDomain) const;
  Front frontOfPart(const Part& part, uint32_t t, uint64_t holes);
  [[gnu::noinline]] bool addEntry(const Entry& entry);
  bool close(const Frame& frame);

  const Pass& pass_;
  Domains domains_;
  DomainTable table_;  // of contexts: shapes with kAnyVertex at the ends of the access edge
  Arena arena_;
  Charge memory_;
  // Candidate edges of each pair of loops, or for both runs within one loop; by pairOf.
  std::vector<uint32_t> firstOfPair_, edgesOfPair_;
  std::vector<uint32_t> numberInPair_;  // [edges]
  std::vector<Context> contexts_;
  std::vector<Block> blocks_;
  std::vector<double> leastPair_;  // [slots]
  std::vector<Entry> entries_;     // of all open frames, one after the other
  std::vector<Frame> frames_;
  // The current domain.
  std::vector<Segment> segments_;
  std::vector<uint32_t> holes_;  // loops
  uint32_t context_ = kNone;
  // Scratch of close(): best_ by slot at the access edge, the others for those that are finite.
  std::vector<double> best_, innerTheta_, innerBase_;
  AngularTransform transform_;
  std::vector<uint32_t> key_;
  double rootBound_ = kInfinity;
  uint64_t splitsLeft_ = 0, domainCount_ = 0;
};

}  // namespace sf
