// The optimal surface over several loops.
// Source: Zou, Ju, Carr 2013, sec. 3.2 and fig. 6: domains with the triangles across all their
// spanning edges, weak edge sets, minimal sets, traceback.
// Differs: top-down on an explicit stack, with splits in the order of their lower bound
// (lower_bound.h). The rest of the splits is skipped once their bound cannot improve on a surface
// without critical edges. It is also skipped once their bound, together with the bound on
// everything outside of the domain, exceeds a limit on the whole cost. The limit starts near the
// root's bound and rises until a surface is found within it, so parts that the optimum does not
// have are hardly looked at. Weak edges are tracked lazily: at first none. If the optimum then
// closes an edge twice, that edge becomes critical, and the pass is repeated. This is exact, since
// an optimum of the relaxed problem that is a manifold is optimal; and it ends, since every round
// adds an edge.
#pragma once
#include <cstdint>
#include <vector>

#include "loops/domains/domain.h"
#include "loops/domains/domain_table.h"
#include "loops/domains/lower_bound.h"
#include "loops/domains/pass.h"
#include "loops/domains/weak_edge_set.h"

namespace sf {

/// Candidate triangles of a surface, in the order of splitting: each but the first shares an edge
/// with an earlier one.
using SplitOrder = std::vector<uint32_t>;

/// Appends the triangles that fill a segment whose access triangle stands at `accessSlot` (kNone
/// at the root). Explicit stack, O(triangles times degree).
void traceSegment(const Pass& pass, ClosedSegment segment, uint32_t accessSlot, SplitOrder& order);

/// Rounds of lazily found critical edges before all edges are tracked.
constexpr int kLazyRounds = 12;

class ExactSolver {
 public:
  /// `bound` is of the same pass and computed from the same root, the edge from `rootVertex` to the
  /// next vertex of its loop.
  ///   lazyRounds  changes the time, not the cost; 0: all edges are tracked from the start
  ExactSolver(const Pass& pass, LowerBound& bound, uint32_t rootVertex,
              int lazyRounds = kLazyRounds);
  ~ExactSolver();

  /// Finds the least cost; infinity if no surface costs `most` or less. A cost above `most` can
  /// come back as well; it need not be the least. False when the work ended.
  bool solve(double most, double& cost, SplitOrder& order);

  uint64_t domainCount() const { return domainCount_; }
  uint64_t minimalSetCount() const { return minimalSetCount_; }

 private:
  struct Solution;
  /// A part of a split; if it is not empty, with its optimal triangulation.
  struct PartRef {
    PartKind kind;
    uint32_t a, b;             // Domain: number. Segment: slot of the access triangle, side.
    const Solution* solution;  // Domain: which, once chosen
  };
  /// The best triangulation of a domain with one weak edge set: an element of W(D, E).
  struct Solution {
    double cost;
    const uint32_t* edges;
    uint32_t edgeCount;
    uint32_t triangle;
    PartRef part[2];

    WeakEdgeSet weakEdges() const { return {edges, edgeCount}; }
  };
  /// A split and its lower bound: the `ordinal`-th split by the triangle at `slot`.
  struct Candidate {
    double bound;
    uint32_t slot, ordinal;
  };
  struct Draft {
    Solution solution;
    std::vector<uint32_t> edges;
  };
  struct Frame {
    uint32_t domain;
    size_t cursor;
    uint64_t bytes;  // charged for the candidates
    double cut;      // cost of the solution that uses no critical edge
    double asked;    // solutions up to this cost are needed
    double limit;    // the same, or less if the bound shows that dearer ones are useless
    std::vector<Candidate> candidates;
    std::vector<Draft> drafts;
  };
  /// A part of the split that is being combined.
  struct OpenPart {
    PartRef ref;
    double cost;                     // of parts other than domains
    double bound;                    // of domains: lower bound
    std::vector<uint32_t> spanning;  // critical ones among its spanning edges
  };

  bool solveBelow(double most, double& cost);
  bool open(uint32_t domain, double asked);
  bool close(Frame& frame);
  bool take(Frame& frame, const Candidate& candidate, uint32_t& missing, double& asked);
  bool makeParts(const Frame& frame, const Candidate& candidate);
  void combine(Frame& frame, const Candidate& candidate);
  void addDraft(Frame& frame, Draft&& draft);
  void trace(SplitOrder& order) const;
  /// Makes the edges of wrong valence in the surface critical; returns whether there are any.
  bool addCriticalEdges(const SplitOrder& order);

  uint32_t segmentsOf(uint32_t domain) const {
    return uint32_t(table_.key(domain).size() - holeWords_) / 3;
  }
  Shape shapeOf(uint32_t domain) const {
    return table_.key(domain).slice(0, holeWords_ + 2 * size_t(segmentsOf(domain)));
  }
  /// Triangles across the spanning edges, by number plus 1, the access triangle first (0: root).
  ArrayView<const uint32_t> trianglesOf(uint32_t domain) const {
    const uint32_t m = segmentsOf(domain);
    return table_.key(domain).slice(holeWords_ + 2 * size_t(m), m);
  }
  double bound(const Split& split, uint32_t slot, ArrayView<const uint32_t> triangles);
  double emptyPairCost(const SplitPart& part, uint32_t t,
                       ArrayView<const uint32_t> triangles) const;
  double segmentCost(const SplitPart& part, uint32_t t, uint32_t& side) const;
  uint32_t insertPart(const Split& split, uint32_t i, uint32_t t,
                      ArrayView<const uint32_t> triangles);
  bool isCritical(uint32_t edge) const { return allCritical_ || contains(critical_, edge); }
  void criticalSpanningEdges(Shape shape, std::vector<uint32_t>& edges) const;

  const Pass& pass_;
  LowerBound& bound_;
  uint32_t rootVertex_;
  int lazyRounds_;
  uint32_t holeWords_;
  Domains domains_;
  DomainTable table_;
  Arena arena_;
  std::vector<ArrayView<const Solution>> solutions_;  // by domain
  std::vector<double> solved_;                        // by domain: up to this cost
  std::vector<uint32_t> critical_;                    // increasing
  bool allCritical_ = false;
  std::vector<Frame> frames_;
  OpenPart parts_[2];
  uint32_t partCount_ = 0;
  std::vector<uint32_t> scratch_, scratch2_;
  uint64_t domainCount_ = 0, minimalSetCount_ = 0;
};

}  // namespace sf
