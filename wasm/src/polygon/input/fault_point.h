// Where in the plane a fault of a polygon is: for messages and pictures.
#pragma once
#include "base/status.h"
#include "polygon/input/polygon.h"

namespace sf {

/// A point of the fault, rounded: where two edges at fault meet, or the vertex at fault, or a
/// vertex of the ring at fault. NaN if the fault has no place.
///   outcome  as PlaneSweep::run gives it for the polygon
Point2 faultPoint(const PolygonView& polygon, const Outcome& outcome);

}  // namespace sf
