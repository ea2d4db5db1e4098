// One exact sweep over the plane. It proves a polygon valid or names what is wrong, resolves all
// touches, and finds for every vertex the edges directly to its left and right.
//
// Source: Shamos, Hoey 1976, "Geometric intersection problems", for the order of edges along the
// sweep line; Kumar, sec. 4 and 4.2, for horizontal visibility lines whose two ends contradict
// each other as the mark of a polygon that is not simple; Ronfard, Rossignac 1994, sec. 1, for the
// loops at non-manifold vertices.
// Differs: only vertices are tested against the edges next to them, never edges against edges. Two
// edges that become neighbours in order can change places only by crossing, and stay neighbours
// until one of them ends: that end then lies on the wrong side of the other (PAPERS.md). So two
// orient2d a vertex, on input coordinates alone, decide everything; no intersection is computed.
// Seidel's randomised trapezoidation finds the same visibility lines; the sweep is deterministic,
// O(n log n) in the worst case, and takes an edge that continues another without any search.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "base/status.h"
#include "base/work.h"
#include "polygon/input/polygon.h"

namespace sf {

/// What each node sees along the tilted horizontal through it, in each direction in which the
/// polygon lies. An edge is named by its lower node u: on the left it is the link prev[u] -> u, on
/// the right u -> next[u]. kNone where the polygon does not lie on that side.
struct Visibility {
  std::vector<uint32_t> order;   // used nodes by increasing height
  Buffer<uint32_t> left, right;  // [m]
};

struct SweepState;  // sweep_state.h

/// The sweep with the memory that it keeps from one polygon to the next.
class PlaneSweep {
 public:
  PlaneSweep();
  ~PlaneSweep();
  PlaneSweep(const PlaneSweep&) = delete;
  PlaneSweep& operator=(const PlaneSweep&) = delete;

  /// Checks the polygon and links its loops: outer ring counter-clockwise, holes clockwise,
  /// re-linked wherever rings touch, with a node for each corner and the kind of every node.
  ///   mayTurn  the sweep may run along x, if the polygon has far fewer local minima and maxima
  ///            that way: linked.turned. Faults are the same as those of a sweep along y
  ///   seen     what nodes see; if `sagsOnly`, `order` has bottoms, sags and islands alone, and
  ///            only their `left` is set: for bottoms the edge to the left outside the polygon
  /// Status Ok if the polygon is valid. Else the first of BadStarts, NotFinite and
  /// DegeneratePolygon that applies; or, if none does,
  /// the first of the others that the sweep meets:
  ///   BadStarts          as for loops
  ///   NotFinite          `loop` and `vertex` of a coordinate that is NaN, infinite or beyond 1e150
  ///   DegeneratePolygon  `loop` has fewer than 3 distinct points, or a spike at `vertex`, whose
  ///                      two edges leave it in one direction
  ///   SelfIntersecting   two edges of one ring, given by their first vertices, that cross, overlap
  ///                      or, at a common point, change sides
  ///   HolesOverlap       the same for edges of two holes
  ///   HoleOutside        the same for an edge of a hole (`loop`, `vertex`) and one of the outer
  ///                      ring; or hole `loop` lies outside; or an isolated point is not strictly
  ///                      inside
  ///   NestedHole         hole `loop` lies in hole `otherLoop`
  ///   OutOfMemory, Stopped
  /// O(n log n) time, O(n) memory, kept for the next call and charged to `work` during each.
  Outcome run(const PolygonView& polygon, bool sagsOnly, bool mayTurn, Work& work,
              LinkedPolygon& linked, Visibility& seen);

  /// The same for a frame around the polygon, less the polygon; nodes n to n + 3 are the frame's
  /// corners. Only sags are found, and the sweep may run either way. Isolated points are left out.
  Outcome runComplement(const PolygonView& polygon, Work& work, LinkedPolygon& linked,
                        Visibility& seen);

  /// Whether in the last call no two vertices were at one place and none was on an edge.
  bool isPlain() const;
  /// For each vertex of the last call the first vertex at the same place: for certificates.
  void findEqual(std::vector<uint32_t>& same) const;
  /// [r] 1 where the loop of the last call runs through its ring backwards.
  const std::vector<uint8_t>& reversed() const;

 private:
  Outcome run(const PolygonView& polygon, bool complement, bool sagsOnly, bool mayTurn, Work& work,
              LinkedPolygon& linked, Visibility& seen);

  std::unique_ptr<SweepState> state_;
};

}  // namespace sf
