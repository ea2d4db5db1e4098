// The order in which to insert points of the plane into a triangulation.
// Source: Amenta, Choi, Rote 2003, "Incremental constructions con BRIO".
#pragma once
#include <cstdint>
#include <vector>
#include "base/array_view.h"
#include "base/point2.h"

namespace sf {

/// Puts indices of points into a biased randomized insertion order. A fixed hash of the index
/// divides them into rounds, each about twice as large as the one before. Within a round the points
/// follow a Hilbert curve through 2^13 x 2^13 cells of their bounding box. So each point is near
/// the last one, and yet points along a smooth curve do not come one after the other, which would
/// change most triangles every time. O(n log n) time.
void sortForInsertion(ArrayView<const Point2> at, std::vector<uint32_t>& indices);

}  // namespace sf
