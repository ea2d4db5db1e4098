// Orders of points: equal ones together, and the order in which to insert them.
#pragma once
#include <cstdint>
#include <vector>

#include "base/array_view.h"
#include "base/vec.h"
#include "base/work.h"

namespace sf {

/// firstOf[i] becomes the least j with points[j] == points[i] (-0 equals 0). O(n) expected time.
///   points   [n] finite
///   firstOf  [n] the result
/// False once the work has to end; firstOf is then undefined.
bool findEqualPoints(ArrayView<const Vec3> points, Work& work, std::vector<uint32_t>& firstOf);

/// Puts point numbers into a biased randomized insertion order. A fixed hash of the number divides
/// them into rounds, each about twice as large as the one before; within a round they are in
/// Hilbert order. False once the work has to end.
/// Source: Amenta, Choi, Rote 2003, "Incremental constructions con BRIO"; Skilling 2004,
/// "Programming the Hilbert curve", for the curve.
///   points  all points, of magnitude at most 1
///   order   the numbers to sort; reordered in place
bool sortForInsertion(ArrayView<const Vec3> points, Work& work, std::vector<uint32_t>& order);

}  // namespace sf
