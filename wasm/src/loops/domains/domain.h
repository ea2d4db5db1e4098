// Domains: what a partial surface still has to fill, and how a triangle splits one.
// Source: Zou, Ju, Carr 2013, sec. 3.2.1 (boundary, holes, access edge, cases I and II).
// Differs: a domain and its mirror image hold the same surfaces, so only one of the two is kept.
// The access edge is always one of the newest. Splits are not made if they cannot give a manifold
// surface (a loop edge or a spanning edge would be closed twice).
#pragma once
#include <cstdint>
#include <vector>

#include "base/array_view.h"
#include "base/status.h"
#include "loops/problem/loop_set.h"

namespace sf {

/// A run of one loop on the boundary of a domain, in the direction of the boundary. If start and
/// end are the same it is one vertex, or with `whole` the whole loop from that
/// vertex back to itself.
struct Segment {
  uint32_t start, end;
  bool reversed;  // passed against the direction of the loop
  bool whole;

  bool isVertex() const { return start == end && !whole; }
};

/// The shape of a domain as plain words: the set of its holes, then its m segments in the order of
/// the boundary. Spanning edge i joins the end of segment i to the start of segment i + 1; the last
/// one, from the end of segment m - 1 to the start of segment 0, is the access edge.
using Shape = ArrayView<const uint32_t>;

/// How a part of a split domain ends the recursion, if it does.
enum class PartKind {
  EmptyEdge,  // a loop edge: nothing to fill
  EmptyPair,  // two vertices of two loops: two triangles meet at their common edge
  Segment,    // one segment, no holes: in the SegmentTable
  Domain,     // anything else
};

/// One sub-domain after a split by a triangle t. Its access edge is an edge of t.
struct SplitPart {
  PartKind kind;
  std::vector<uint32_t> shape;
  uint32_t apexOpposite;    // the vertex of t that is not on the part's access edge
  uint32_t firstInherited;  // spanning edges [firstInherited, +inheritedCount) of the domain are
  uint32_t inheritedCount;  // the part's first ones
};

/// A split. Case I: one part, which has t across a second new spanning edge, the one after the
/// inherited ones. Case II: two parts.
struct Split {
  uint32_t partCount;
  SplitPart part[2];
};

/// Shapes over one LoopSet. Holds scratch memory: one object for each thread of work.
class Domains {
 public:
  explicit Domains(const LoopSet& loops)
      : loops_(loops), holeWords_((loops.loopCount() + 31) / 32) {}

  /// The domain of all loops. Its boundary is the loop of `v` without the edge from v to the next
  /// vertex, which is the access edge. The other loops are holes.
  std::vector<uint32_t> root(uint32_t v) const;

  uint32_t segmentCount(Shape d) const { return (uint32_t(d.size()) - holeWords_) / 2; }
  Segment segment(Shape d, uint32_t i) const {
    const uint32_t w = d[holeWords_ + 2 * i];
    return {w & kVertexMask, d[holeWords_ + 2 * i + 1], (w & kReversed) != 0, (w & kWhole) != 0};
  }
  bool hasHole(Shape d, uint32_t loop) const { return (d[loop / 32] >> (loop % 32)) & 1; }
  bool hasHoles(Shape d) const {
    for (uint32_t i = 0; i < holeWords_; ++i)
      if (d[i]) return true;
    return false;
  }
  /// The ends of spanning edge i; i = m - 1 is the access edge.
  uint32_t spanStart(Shape d, uint32_t i) const { return segment(d, i).end; }
  uint32_t spanEnd(Shape d, uint32_t i) const {
    return segment(d, i + 1 == segmentCount(d) ? 0 : i + 1).start;
  }
  /// How many words at the start of a shape hold its set of holes.
  uint32_t holeWords() const { return holeWords_; }
  /// Writes segment i. The direction of a single vertex is not kept.
  void setSegment(std::vector<uint32_t>& d, uint32_t i, Segment s) const {
    if (s.isVertex()) s.reversed = false;
    d[holeWords_ + 2 * i] = s.start | (s.reversed ? kReversed : 0) | (s.whole ? kWhole : 0);
    d[holeWords_ + 2 * i + 1] = s.end;
  }
  /// Makes segment i pass its loop forward; for single vertices setSegment does so itself.
  void setForward(std::vector<uint32_t>& d, uint32_t i) const {
    d[holeWords_ + 2 * i] &= ~kReversed;
  }
  /// Whether the segment has v, a vertex of any loop.
  bool contains(Segment s, uint32_t v) const;
  /// In keys shared by all shapes that differ in one end of a segment only, this stands for that
  /// end. No vertex has this number.
  static constexpr uint32_t kAnyVertex = (1u << 30) - 1;
  /// Whether v is an end of one of the segments: the only vertices that weak edges join.
  bool isEnd(Shape d, uint32_t v) const;

  /// Replaces the shape by its mirror image if that is the one of the two that is kept, and returns
  /// whether it did. All spanning edges but the access edge are then in reverse order.
  bool makeCanonical(std::vector<uint32_t>& shape) const;

  /// Calls visit(const Split&) for every split of d by the triangle on its access edge with this
  /// third vertex, until visit returns false. Leaves out splits that no manifold surface can have.
  /// There are none if the apex is neither on the boundary nor on a hole, or is an end of the
  /// access edge. With h holes, an apex on the boundary has up to 2^h splits.
  template <class Visit>
  void forEachSplit(Shape d, uint32_t apex, Visit&& visit);

 private:
  static constexpr uint32_t kReversed = 1u << 30, kWhole = 1u << 31, kVertexMask = kReversed - 1;

  /// Sets the kind of a part; false if no surface can fill it.
  bool classify(SplitPart& part, bool repeatsSpanningEdge) const;
  void splitAtHole(Shape d, uint32_t apex, bool reversed);
  void splitAtBoundary(Shape d, uint32_t apex, uint32_t j, Segment before, Segment after);
  /// Starts the distributions of the holes of d. nextDistribution() goes on, and returns false
  /// after the last.
  void firstDistribution(Shape d);
  bool nextDistribution();
  void distribute();

  const LoopSet& loops_;
  uint32_t holeWords_;
  Split split_{};
  bool repeats_[2] = {false, false};
  std::vector<uint32_t> holes_;   // loops to distribute
  std::vector<uint8_t> toFirst_;  // which of them go to part 0
  bool oneDistribution_ = false;
};

template <class Visit>
void Domains::forEachSplit(Shape d, uint32_t apex, Visit&& visit) {
  const uint32_t m = segmentCount(d);
  const uint32_t p = spanStart(d, m - 1), q = spanEnd(d, m - 1);
  if (apex == p || apex == q) return;
  if (hasHole(d, loops_.loopOf(apex))) {
    for (const bool reversed : {false, true}) {
      splitAtHole(d, apex, reversed);
      if (!visit(const_cast<const Split&>(split_))) return;
    }
    return;
  }
  for (uint32_t j = 0; j < m; ++j) {
    const Segment s = segment(d, j);
    if (!contains(s, apex)) continue;
    const Segment vertex{apex, apex, false, false};
    // A loop that is passed whole has two copies of its end vertex on the boundary.
    const bool twice = s.whole && apex == s.start;
    for (int copy = 0; copy < (twice ? 2 : 1); ++copy) {
      Segment before{s.start, apex, s.reversed, false}, after{apex, s.end, s.reversed, false};
      if (twice) before = copy == 0 ? vertex : s, after = copy == 0 ? s : vertex;
      splitAtBoundary(d, apex, j, before, after);
      for (bool more = true; more; more = nextDistribution()) {
        distribute();
        if (classify(split_.part[0], repeats_[0]) && classify(split_.part[1], repeats_[1]) &&
            !visit(const_cast<const Split&>(split_)))
          return;
      }
    }
    return;
  }
}

}  // namespace sf
