// Triangulation of a uni-monotone polygon by a u-tree.
//
// A uni-monotone polygon is a base edge and a chain of vertices between its ends that is monotone
// in v and lies on one side of it. A node of the u-tree is the vertex nearest to the base among
// those of its part of the chain; the vertices above it are in its left subtree and those below in
// its right one. With the top v_t and the bottom v_b of that part, it forms the triangle v_t, v_m,
// v_b, whose sides v_t v_m and v_m v_b are the bases of the two subtrees.
//
// Invariant: no vertex of the part is nearer to the base than v_t or v_b. So the triangle lies
// within the distance of v_m, where no vertex but those three is, and all triangles are inside the
// polygon. While no local minimum is left in a part, its nearest vertex is next to v_t or to v_b,
// whichever of these neighbours is nearer: the advancing strip of the paper.
//
// Source: Kumar, sec. 4.1 and fig. 4.
// Differs:
// - Distances are measured from the base, not along u. The paper's rule holds while the base is
//   short and upright; by the distance from the base the invariant holds for every base.
// - All vertices of the chain are nodes, not the local minima alone. Then strips and splits are one
//   rule.
// - The tree is built in O(n) by a stack over the chain (the tree of Vuillemin 1980), whatever the
//   number k of minima, where the paper needs O(n + k^2), or O(n + k log k) in random order.
#pragma once
#include <cstdint>
#include <vector>

#include "polygon/input/polygon.h"

namespace sf {

/// Triangulates one uni-monotone polygon after another; keeps its arrays.
class UTree {
 public:
  /// Writes the triangles, counter-clockwise, to out[0 .. 3 (chain.size() - 2)), strips in one
  /// piece; returns the end of what it wrote. O(n) time, exact.
  ///   at     [n] positions, of any magnitude up to 1e150
  ///   chain  indices of vertices, the ends of the base first and last; at least 2
  ///   left   whether the chain lies to the left of the base from its first end to its last
  /// A vertex of the chain on the base itself makes one triangle of no area, with both ends of the
  /// base or with another such vertex and one end; all others have positive area.
  uint32_t* triangulate(ArrayView<const Point2> at, ArrayView<const uint32_t> chain, bool left,
                        uint32_t* out);

 private:
  void build(ArrayView<const Point2> at, ArrayView<const uint32_t> chain, bool left);

  struct Part {
    uint32_t bottom, top, root;  // numbers in the chain
  };
  std::vector<double> distance_;         // of each vertex from the base, rounded
  std::vector<uint32_t> above_, below_;  // subtrees: numbers in the chain, 0 for none
  std::vector<uint32_t> stack_;
  std::vector<Part> parts_;
};

}  // namespace sf
