#include "polygon/hilbert_order.h"

#include <algorithm>
#include <limits>

namespace sf {
namespace {

// The number of cell (x, y) along the curve.
uint32_t hilbertNumber(uint32_t x, uint32_t y) {
  uint32_t number = 0;
  for (uint32_t half = 1u << 15; half > 0; half >>= 1) {
    const uint32_t right = (x & half) != 0, top = (y & half) != 0;
    number = number << 2 | ((3 * right) ^ top);
    // Into the frame of the quarter: the first and the last are transposed, the last turned as well.
    if (top == 0) {
      if (right != 0) x = ~x, y = ~y;
      std::swap(x, y);
    }
  }
  return number;
}

}  // namespace

void sortAlongHilbertCurve(ArrayView<const Point2> at, std::vector<uint32_t>& indices) {
  if (indices.size() < 2) return;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Point2 low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
  for (const uint32_t i : indices) {
    low = {std::min(low.x, at[i].x), std::min(low.y, at[i].y)};
    high = {std::max(high.x, at[i].x), std::max(high.y, at[i].y)};
  }
  const double side = std::max(high.x - low.x, high.y - low.y);
  const double scale = side > 0 ? 65535 / side : 0;
  std::vector<uint64_t> keys;
  keys.reserve(indices.size());
  for (const uint32_t i : indices) {
    const uint32_t x = uint32_t((at[i].x - low.x) * scale), y = uint32_t((at[i].y - low.y) * scale);
    keys.push_back(uint64_t(hilbertNumber(x, y)) << 32 | i);
  }
  std::sort(keys.begin(), keys.end());
  for (size_t k = 0; k < keys.size(); ++k) indices[k] = uint32_t(keys[k]);
}

}  // namespace sf
