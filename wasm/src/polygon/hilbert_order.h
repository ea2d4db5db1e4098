// Points of the plane in the order in which a Hilbert curve meets them: neighbours in the order are
// near each other.
#pragma once
#include <cstdint>
#include <vector>

#include "polygon/polygon.h"

namespace sf {

/// Reorders indices of points along a Hilbert curve through 2^16 x 2^16 cells over their bounding box;
/// within a cell by index. O(n log n) time.
void sortAlongHilbertCurve(ArrayView<const Point2> at, std::vector<uint32_t>& indices);

}  // namespace sf
