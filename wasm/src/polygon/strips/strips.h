// Triangle strips over a triangulation, in the order OpenGL draws them.
//
// A strip s of indices stands for the triangles (s[i], s[i+1], s[i+2]), the odd ones with the first
// two exchanged; those with two equal indices are not drawn. A strip turns alternately right and
// left; to turn the same way twice it repeats an index (a swap), which costs less than a new strip.
//
// Source: Kumar, sec. 4.1: strips and no fans, with few indices.
// Differs: the paper writes strips while it triangulates each uni-monotone polygon. So no strip is
// longer than its polygon, a few triangles if many vertices are reflex. Here strips are found
// afterwards, over all triangles. Triangles are the nodes of the dual graph, strips are paths in
// it. Over a spanning forest the paths of least index count are found exactly, by dynamic
// programming from the leaves. The dual graph of a polygon without interior points and holes is a
// tree, so there they are the best there are. Elsewhere ends of paths are then joined across the
// other edges.
#pragma once
#include <cstdint>
#include <vector>

#include "base/array_view.h"
#include "base/work.h"
#include "triangles/triangle_mesh.h"

namespace sf {

/// Which edges strips cross: bit k of links[t] for half-edge 3t + k of a TriangleMesh. A triangle
/// has at most two; the triangles and the edges crossed form paths, the strips.
class StripLinks {
 public:
  std::vector<uint8_t> bits;

  bool linked(uint32_t h) const { return bits[h / 3] >> (h % 3) & 1; }
  void link(uint32_t h, uint32_t twin) {
    bits[h / 3] |= uint8_t(1u << (h % 3));
    bits[twin / 3] |= uint8_t(1u << (twin % 3));
  }
  void cut(uint32_t h, uint32_t twin) {
    bits[h / 3] &= uint8_t(~(1u << (h % 3)));
    bits[twin / 3] &= uint8_t(~(1u << (twin % 3)));
  }
  int count(uint32_t t) const { return (bits[t] & 1) + (bits[t] >> 1 & 1) + (bits[t] >> 2 & 1); }
  /// The linked half-edge of a triangle that has one alone; kNone if it has none.
  uint32_t only(uint32_t t) const {
    return bits[t] == 0 ? kNone : 3 * t + (bits[t] == 1 ? 0 : bits[t] == 2 ? 1 : 2);
  }
  /// The half-edge by which a strip leaves the triangle that it entered by h; kNone at its end.
  uint32_t exit(uint32_t h) const {
    if (linked(nextInTriangle(h))) return nextInTriangle(h);
    return linked(prevInTriangle(h)) ? prevInTriangle(h) : kNone;
  }
  /// Whether the strips that end in the triangles on both sides of h are one, or both are very long.
  bool onOnePath(ArrayView<const uint32_t> twins, uint32_t h) const;
  /// How many more swaps two strips need if they are joined across h, between their ends.
  uint32_t swapsToJoin(ArrayView<const uint32_t> twins, uint32_t h) const;
};

/// Joins strips that end in some triangles to those across their edges, as long as that saves indices: after a change, when
/// these triangles' strips were cut. O(1) time a triangle, but for walks along strips of some length.
///   mayCross  whether an edge may be crossed: a half-edge that has a twin
template <class F>
void joinStrips(ArrayView<const uint32_t> twins, ArrayView<const uint32_t> among, StripLinks& links,
                F&& mayCross) {
  for (uint32_t allowed = 0; allowed < 2; ++allowed)
    for (const uint32_t t : among)
      for (uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
        const uint32_t g = twins[h];
        if (g == kNone || links.linked(h) || !mayCross(h)) continue;
        if (links.count(t) > 1 || links.count(g / 3) > 1) continue;
        if (links.swapsToJoin(twins, h) > allowed || links.onOnePath(twins, h)) continue;
        links.link(h, g);
      }
}

/// Finds strips with few indices. False when the work ended.
///   twins  [3m] as findTwins gives them
///   links  out
/// O(m) time, 36 bytes of memory a triangle.
bool linkStrips(ArrayView<const uint32_t> twins, Work& work, StripLinks& links);

/// Joins strips end to end wherever they meet, while that saves indices: first where no swap is needed, then where one is, and so on.
/// False when the work ended. O(m) time, 4 bytes of memory a triangle.
///   mostSwaps  the most that a join may need. A strip less saves two indices, and a restart
bool joinStripEnds(ArrayView<const uint32_t> twins, uint32_t mostSwaps, Work& work,
                   StripLinks& links);

/// Writes the strips of some triangles. Each strip must lie among them wholly or not at all.
///   corners   [3m] triangles, counter-clockwise
///   among     triangles
///   vertices  out: the indices of all strips
///   starts    [s+1] out: strip i is vertices[starts[i]] .. vertices[starts[i + 1] - 1]
///   turned    whether the strips are those of the triangles' other sides
bool writeStrips(ArrayView<const uint32_t> corners, ArrayView<const uint32_t> twins,
                 const StripLinks& links, ArrayView<const uint32_t> among, Work& work,
                 std::vector<uint32_t>& vertices, std::vector<uint32_t>& starts,
                 bool turned = false);

/// Strips with every triangle in exactly one of them: finds and writes them.
bool makeStrips(ArrayView<const uint32_t> corners, ArrayView<const uint32_t> twins, Work& work,
                std::vector<uint32_t>& vertices, std::vector<uint32_t>& starts);

}  // namespace sf
