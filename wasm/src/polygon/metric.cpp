#include "polygon/metric.h"

#include <initializer_list>
#include <limits>

namespace sf {

ArrayView<const Point2> metricPoints(ArrayView<const Point2> at, std::vector<Point2>& scaled,
                                     bool& isExact) {
  double largest = 0, least = std::numeric_limits<double>::infinity();
  for (const Point2 p : at)
    for (const double m : {std::fabs(p.x), std::fabs(p.y)}) {
      if (m > largest) largest = m;
      if (m < least && m > 0) least = m;
    }
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
