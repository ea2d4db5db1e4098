// The points of a polygon as the predicates for circles and angles take them.
#pragma once
#include <vector>

#include "base/array_view.h"
#include "base/metric.h"
#include "polygon/input/polygon.h"

namespace sf {

/// The points of the nodes themselves where they are in the range of base/predicates.h; else `scaled`, with
/// the largest magnitude in [1/2, 1). O(1), or O(n) where they have to be scaled.
///   exponent  out: the points are those of the nodes times 2^-exponent; 0 for the nodes' own
///   isExact   out: whether nothing was lost; if not, what the predicates say may be wrong
ArrayView<const Point2> metricPoints(const LinkedPolygon& loops, std::vector<Point2>& scaled,
                                     int& exponent, bool& isExact);

}  // namespace sf
