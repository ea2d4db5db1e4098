// Points as the predicates for circles and angles take them: those of base/predicates are exact in a
// range that is smaller than what coordinates may have.
#pragma once
#include <cmath>
#include <vector>

#include "base/array_view.h"
#include "polygon/polygon.h"

namespace sf {

/// A coordinate times 2^-exponent, or zero where that is too small for exact predicates.
inline double scaledDown(double x, int exponent) {
  const double s = std::ldexp(x, -exponent);
  return std::fabs(s) < 0x1p-200 ? 0.0 : s;
}
inline Point2 scaledDown(Point2 p, int exponent) {
  return {scaledDown(p.x, exponent), scaledDown(p.y, exponent)};
}

/// The points of the nodes themselves where they are in range, or else `scaled`, with the largest magnitude
/// in [1/2, 1): times 2^-exponent, which is 0 for those themselves. `isExact` tells whether nothing was lost: if not, what the predicates say may be wrong. O(1),
/// or O(n) where they have to be scaled.
ArrayView<const Point2> metricPoints(const LinkedPolygon& loops, std::vector<Point2>& scaled,
                                     int& exponent, bool& isExact);

}  // namespace sf
