// Loops at unit size and weights near 1, as the solver takes them,
// and the way back to the caller's units.
#pragma once
#include <cmath>

#include "loops/problem/loop_set.h"

namespace sf {

/// Weights for loops at unit size, times the power of two that brings the largest of them near 1.
/// So sums of very large or very small weights neither overflow nor vanish. All factors are exact.
struct ScaledWeights {
  double area = 0, perimeter = 0, dihedral = 0;
  int lengthExponent = 0;  // the caller's lengths are 2^lengthExponent times those at unit size
  int costExponent = 0;    // the caller's costs are 2^costExponent times those here

  double length(double atUnitSize) const { return std::ldexp(atUnitSize, lengthExponent); }
  double cost(double byTheseWeights) const { return std::ldexp(byTheseWeights, costExponent); }
  /// A candidate's own weight in these units.
  double own(double callers) const { return std::ldexp(callers, -costExponent); }
};

/// Scales weights in the caller's units.
///   area            NaN: 1e-3 / (bounding-box diagonal)^2
///   own             candidates' own weights, or empty
///   unit            the caller's loops times 2^-lengthExponent
ScaledWeights scaleWeights(double area, double perimeter, double dihedral,
                           ArrayView<const double> own, const LoopSet& unit, int lengthExponent);

}  // namespace sf
