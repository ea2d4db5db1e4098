// Scales coordinates into the range where the predicates for circles and angles are exact. This
// range is smaller than the range that input may have.
#pragma once
#include <cmath>

#include "base/point2.h"

namespace sf {

/// A coordinate times 2^-exponent, or zero if that is too small for exact predicates.
inline double scaledDown(double x, int exponent) {
  const double s = std::ldexp(x, -exponent);
  return std::fabs(s) < 0x1p-200 ? 0.0 : s;
}
inline Point2 scaledDown(Point2 p, int exponent) {
  return {scaledDown(p.x, exponent), scaledDown(p.y, exponent)};
}

}  // namespace sf
