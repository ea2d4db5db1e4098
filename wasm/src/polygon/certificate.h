// Proof that triangles are a triangulation, from the triangles alone.
// Source: Ronfard, Rossignac 1994, sec. 6: "we triangulate both the polygon and its complement, for
// verification purposes". That this finds every invalid input is a conjecture there and a theorem
// here: PAPERS.md has the argument.
#pragma once
#include "base/work.h"
#include "polygon/polygon.h"

namespace sf {

/// Whether the triangles prove by themselves that the polygon is valid and that they cover it:
/// none is turned over, by exact orient2d, those of area 0 have collinear corners, the sum of their
/// boundaries is that of the rings, and the same holds for the triangles of the complement, whose
/// boundary is that of a frame less the rings'.
///   at                  [m] points: the input's vertices, then the frame's four corners
///   rings               [2e] edges u -> v of the rings, the polygon to the left
///   inside, complement  [3t] triangles as indices into `at`
/// O(m + t) time and memory, charged to `work`; false too once `work` is to end.
bool certify(ArrayView<const Point2> at, ArrayView<const uint32_t> rings,
             ArrayView<const uint32_t> inside, ArrayView<const uint32_t> complement, Work& work);

}  // namespace sf
