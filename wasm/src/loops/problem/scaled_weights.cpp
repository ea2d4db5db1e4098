#include "loops/problem/scaled_weights.h"

#include <algorithm>
#include <limits>

namespace sf {
namespace {

double squaredDiagonal(const LoopSet& loops) {
  Vec3 low = loops.position(0), high = low;
  for (const Vec3& p : loops.positions()) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return dot(high - low, high - low);
}

}  // namespace

ScaledWeights scaleWeights(double area, double perimeter, double dihedral,
                           ArrayView<const double> own, const LoopSet& unit, int lengthExponent) {
  const bool isDefault = std::isnan(area);
  if (isDefault) area = 1e-3 / squaredDiagonal(unit);
  const int areaExponent = isDefault ? 0 : 2 * lengthExponent;
  double largestOwn = 0;
  for (const double w : own) largestOwn = std::max(largestOwn, std::fabs(w));
  ScaledWeights scaled;
  scaled.lengthExponent = lengthExponent;
  scaled.costExponent = std::numeric_limits<int>::min();
  const auto consider = [&](double w, int exponent) {
    if (w > 0) scaled.costExponent = std::max(scaled.costExponent, std::ilogb(w) + exponent);
  };
  consider(area, areaExponent);
  consider(perimeter, lengthExponent);
  consider(dihedral, 0);
  consider(largestOwn, 0);
  scaled.area = std::ldexp(area, areaExponent - scaled.costExponent);
  scaled.perimeter = std::ldexp(perimeter, lengthExponent - scaled.costExponent);
  scaled.dihedral = std::ldexp(dihedral, -scaled.costExponent);
  return scaled;
}

}  // namespace sf
