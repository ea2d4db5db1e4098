#include "triangles/insertion_order.h"

#include <algorithm>
#include <limits>

namespace sf {
namespace {

constexpr int kBits = 13;
constexpr size_t kFirstRound = 64;

// The number of cell (x, y) along the curve.
uint32_t hilbertNumber(uint32_t x, uint32_t y) {
  uint32_t number = 0;
  for (uint32_t half = 1u << (kBits - 1); half > 0; half >>= 1) {
    const uint32_t right = (x & half) != 0, top = (y & half) != 0;
    number = number << 2 | ((3 * right) ^ top);
    // Into the frame of the quarter: the first and the last are transposed, the last turned as
    // well.
    if (top == 0) {
      if (right != 0) x = ~x, y = ~y;
      std::swap(x, y);
    }
  }
  return number;
}

// Scatters the bits of an index (Wellons 2018, "Prospecting for hash functions").
uint32_t mix(uint32_t x) {
  x ^= x >> 16, x *= 0x7feb352du;
  x ^= x >> 15, x *= 0x846ca68bu;
  return x ^ x >> 16;
}

}  // namespace

void sortForInsertion(ArrayView<const Point2> at, std::vector<uint32_t>& indices) {
  if (indices.size() < 2) return;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Point2 low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
  for (const uint32_t i : indices) {
    low = {std::min(low.x, at[i].x), std::min(low.y, at[i].y)};
    high = {std::max(high.x, at[i].x), std::max(high.y, at[i].y)};
  }
  const double side = std::max(high.x - low.x, high.y - low.y);
  // Points so close together that the quotient may overflow are in one cell.
  const double scale = side > 0x1p-1000 ? ((1 << kBits) - 1) / side : 0;
  std::vector<uint64_t> keys;
  keys.reserve(indices.size());
  uint32_t rounds = 0;
  while (indices.size() >> rounds > kFirstRound) ++rounds;
  for (const uint32_t i : indices) {
    const uint32_t x = uint32_t((at[i].x - low.x) * scale), y = uint32_t((at[i].y - low.y) * scale);
    uint32_t round = rounds;
    for (uint32_t h = mix(i); round > 0 && (h & 1) != 0; h >>= 1) --round;
    const uint32_t place = round << (2 * kBits) | hilbertNumber(x, y);
    keys.push_back(uint64_t(place) << 32 | i);
  }
  std::sort(keys.begin(), keys.end());
  for (size_t k = 0; k < keys.size(); ++k) indices[k] = uint32_t(keys[k]);
}

}  // namespace sf
