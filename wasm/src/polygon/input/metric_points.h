// The points of a polygon in the range of the predicates for circles and angles.
#pragma once
#include <vector>

#include "base/array_view.h"
#include "base/metric.h"
#include "polygon/input/polygon.h"

namespace sf {

/// The nodes' own points if they are in the range of base/predicates.h; else scaled copies in
/// `scaled`, with the largest magnitude in [1/2, 1). O(1), or O(n) if they have to be scaled.
///   exponent  out: the result is the nodes' points times 2^-exponent; 0 for their own points
///   isExact   out: whether scaling lost nothing; if it did, the predicates may be wrong
ArrayView<const Point2> metricPoints(const LinkedPolygon& loops, std::vector<Point2>& scaled,
                                     int& exponent, bool& isExact);

}  // namespace sf
