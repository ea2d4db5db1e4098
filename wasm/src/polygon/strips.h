// Triangle strips over a triangulation, in the order OpenGL draws them.
//
// A strip s of indices stands for the triangles (s[i], s[i+1], s[i+2]), the odd ones with the first two
// exchanged; those with two equal indices are not drawn. A strip turns alternately right and left; to
// turn the same way twice it repeats an index (a swap), which costs less than a new strip.
//
// Source: Kumar 2000, sec. 4.1: strips and no fans, with few indices.
// Differs: the paper writes strips while it triangulates each uni-monotone polygon, so that none is
// longer than its polygon, a few triangles where many vertices are reflex. Here strips are found
// afterwards over all triangles. Triangles are the nodes of the dual graph, strips are paths in it.
// Over a spanning forest the paths of least index count are found exactly, by dynamic programming from
// the leaves; the dual graph of a polygon without interior points and holes is a tree, so there they are
// the best there are. Elsewhere ends of paths are then joined across the other edges.
#pragma once
#include <cstdint>
#include <vector>

#include "base/array_view.h"
#include "base/work.h"

namespace sf {

/// Strips with every triangle in exactly one of them. False when the work ended.
///   corners   [3m] triangles, counter-clockwise
///   twins     [3m] as findTwins gives them
///   vertices  out: the indices of all strips
///   starts    [s+1] out: strip i is vertices[starts[i]] .. vertices[starts[i + 1] - 1]
/// O(m) time, 40 bytes of memory a triangle.
bool makeStrips(ArrayView<const uint32_t> corners, ArrayView<const uint32_t> twins, Work& work,
                std::vector<uint32_t>& vertices, std::vector<uint32_t>& starts);

}  // namespace sf
