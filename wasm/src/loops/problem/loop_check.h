// Checks what all else takes for granted of the input curves.
#pragma once
#include "base/status.h"
#include "base/work.h"
#include "loops/problem/loop_set.h"

namespace sf {

/// Status Ok if the loops are simple and disjoint, else the first fault found, in this order:
///   NotFinite       `loop` and `vertex` of a coordinate that is NaN or beyond kLargestCoordinate
///   TooFewVertices  `loop` with fewer than 3 vertices
///   RepeatedVertex  two vertices of the whole input with the same position, consecutive or not, in
///                   one loop or in two; positions that differ by less than 2^-200 of the largest
///                   coordinate can count as the same
///   LoopsIntersect  two edges, given by their first vertices, that cross, touch or overlap; edges
///                   with a common vertex only if they fold back onto each other. Exact. Looked for
///                   only if `intersections`
///   OutOfMemory, Stopped
/// O(n log n) time where edges' boxes overlap few others, O(n) memory.
Outcome checkLoops(const LoopSet& loops, bool intersections, Work& work);

}  // namespace sf
