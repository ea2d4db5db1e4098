#include "polygon/input/metric_points.h"

#include <algorithm>

namespace sf {

ArrayView<const Point2> metricPoints(const LinkedPolygon& loops, std::vector<Point2>& scaled,
                                     int& exponent, bool& isExact) {
  const Point2 low = loops.least, high = loops.greatest;
  const double largest =
      std::max({std::fabs(low.x), std::fabs(low.y), std::fabs(high.x), std::fabs(high.y)});
  isExact = true, exponent = 0;
  if (largest <= 0x1p60 && loops.smallest >= 0x1p-150) return loops.at;
  std::frexp(largest, &exponent);
  scaled.resize(loops.at.size());
  for (size_t v = 0; v < scaled.size(); ++v) scaled[v] = scaledDown(loops.at[v], exponent);
  isExact = std::ldexp(loops.smallest, -exponent) >= 0x1p-200;
  return scaled;
}

}  // namespace sf
