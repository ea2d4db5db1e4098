// The order in which to insert points of the plane into a triangulation.
// Source: Amenta, Choi, Rote 2003, "Incremental constructions con BRIO".
#pragma once
#include <cstdint>
#include <vector>
#include "base/array_view.h"
#include "base/point2.h"

namespace sf {

/// Puts indices of points into a biased randomized insertion order: rounds, each about twice as
/// large as the one before, chosen by a fixed hash of the index; in each, points along a Hilbert
/// curve through 2^13 x 2^13 cells of their bounding box. So the next point is near the last, and
/// yet points along a smooth curve do not come one after the other, which would change most
/// triangles every time. O(n log n) time.
void sortForInsertion(ArrayView<const Point2> at, std::vector<uint32_t>& indices);

}  // namespace sf
