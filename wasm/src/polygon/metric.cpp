#include "polygon/metric.h"

#include <limits>

#include "base/double2.h"

namespace sf {

ArrayView<const Point2> metricPoints(ArrayView<const Point2> at, std::vector<Point2>& scaled,
                                     bool& isExact) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Double2 infinite = {kInfinity, kInfinity};
  Double2 greatest = {0, 0}, least2 = infinite;
  for (const Point2 p : at) {
    const Double2 xy = {p.x, p.y}, m = magnitudes(xy);
    greatest = greater(m, greatest);
    least2 = lesser(m > 0 ? m : infinite, least2);
  }
  const double largest = greatest[0] > greatest[1] ? greatest[0] : greatest[1];
  const double least = least2[0] < least2[1] ? least2[0] : least2[1];
  isExact = true;
  if (largest <= 0x1p60 && least >= 0x1p-150) return at;
  int exponent;
  std::frexp(largest, &exponent);
  scaled.resize(at.size());
  for (size_t v = 0; v < at.size(); ++v) scaled[v] = scaledDown(at[v], exponent);
  isExact = std::ldexp(least, -exponent) >= 0x1p-200;
  return scaled;
}

}  // namespace sf
