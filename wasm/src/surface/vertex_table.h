// Vertices of a face by their places in the domain.
#pragma once
#include <cstdint>
#include <cstring>
#include <vector>

#include "base/array_view.h"
#include "base/point2.h"

namespace sf {

/// A hash table of numbers. Points are the same only bit by bit.
class VertexTable {
 public:
  /// Empties it, with room for `count` points.
  void reset(size_t count) {
    size_t size = 64;
    while (size < 2 * count + 2) size *= 2;
    slots_.assign(size, kNone);
    used_ = 0;
  }
  /// The number at a point for which `fits(number)` holds, or kNone.
  template <class F>
  uint32_t find(Point2 p, ArrayView<const Point2> points, F&& fits) const {
    for (size_t i = hash(p);; ++i) {
      const uint32_t v = slots_[i & (slots_.size() - 1)];
      if (v == kNone) return kNone;
      if (points[v] == p && fits(v)) return v;
    }
  }
  void add(uint32_t v, ArrayView<const Point2> points) {
    if (2 * (used_ + 1) > slots_.size()) grow(points);
    ++used_;
    put(v, points[v]);
  }

 private:
  static size_t hash(Point2 p) {
    uint64_t a, b;
    std::memcpy(&a, &p.x, 8), std::memcpy(&b, &p.y, 8);
    uint64_t x = a * 0x9E3779B97F4A7C15u ^ (b + 0x7F4A7C15u) * 0xC2B2AE3D27D4EB4Fu;
    x ^= x >> 29;
    x *= 0xBF58476D1CE4E5B9u;
    return size_t(x ^ x >> 32);
  }
  void put(uint32_t v, Point2 p) {
    size_t i = hash(p);
    while (slots_[i & (slots_.size() - 1)] != kNone) ++i;
    slots_[i & (slots_.size() - 1)] = v;
  }
  void grow(ArrayView<const Point2> points) {
    std::vector<uint32_t> old(2 * slots_.size(), kNone);
    old.swap(slots_);
    for (const uint32_t v : old)
      if (v != kNone) put(v, points[v]);
  }

  std::vector<uint32_t> slots_;
  size_t used_ = 0;
};

}  // namespace sf
