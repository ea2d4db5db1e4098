// What is left of a frame around a polygon when the polygon is taken out of it.
// Source: Ronfard, Rossignac 1994, sec. 6.
#pragma once
#include "polygon/sweep/sweep.h"

namespace sf {

/// Finds loops and visibility of the complement, as a sweep of its own would: the polygon's links
/// the other way round, and the corners of a frame (frameAround) as four more nodes at the end.
///   polygon, seen  as PlaneSweep::run leaves them for sags only; no rings may touch
///                  (PlaneSweep::isPlain)
/// Isolated points are left out. O(m) time.
void takeComplement(const LinkedPolygon& polygon, const Visibility& seen, LinkedPolygon& complement,
                    Visibility& outside);

}  // namespace sf
