#include "delaunay/insertion_order.h"

#include <algorithm>

#include "base/hash.h"
#include "base/sort.h"

namespace sf {
namespace {

constexpr int kBits = 20;  // per axis

// Place along a Hilbert curve of a cell of the 2^20 cube, after Skilling.
uint64_t hilbertPlace(uint32_t x, uint32_t y, uint32_t z) {
  uint32_t c[3] = {x, y, z};
  for (uint32_t q = 1u << (kBits - 1); q > 1; q >>= 1) {
    uint32_t low = q - 1;
    for (uint32_t& ci : c) {
      if (ci & q) {
        c[0] ^= low;
      } else {
        uint32_t swap = (c[0] ^ ci) & low;
        c[0] ^= swap;
        ci ^= swap;
      }
    }
  }
  c[1] ^= c[0];
  c[2] ^= c[1];
  uint32_t flip = 0;
  for (uint32_t q = 1u << (kBits - 1); q > 1; q >>= 1)
    if (c[2] & q) flip ^= q - 1;
  uint64_t place = 0;
  for (int b = kBits - 1; b >= 0; --b)
    for (uint32_t ci : c) place = place << 1 | (((ci ^ flip) >> b) & 1);
  return place;
}

}  // namespace

bool findEqualPoints(ArrayView<const Vec3> points, Work& work, std::vector<uint32_t>& firstOf) {
  size_t n = points.size(), size = 16;
  while (size < 2 * n) size *= 2;
  size_t bytes = size * sizeof(uint32_t);
  if (!work.charge(bytes)) {
    work.release(bytes);
    return false;
  }
  firstOf.resize(n);
  std::vector<uint32_t> table(size, kNone);
  for (uint32_t i = 0; i < n && work.tick(20); ++i) {
    size_t slot = size_t(hashOf(points[i])) & (size - 1);
    while (table[slot] != kNone && !(points[table[slot]] == points[i]))
      slot = (slot + 1) & (size - 1);
    if (table[slot] == kNone) table[slot] = i;
    firstOf[i] = table[slot];
  }
  work.release(bytes);
  return work.going();
}

bool sortForInsertion(ArrayView<const Vec3> points, Work& work, std::vector<uint32_t>& order) {
  struct Key {
    uint64_t place;
    uint32_t number;
    bool operator<(const Key& o) const {
      return place != o.place ? place < o.place : number < o.number;
    }
  };
  const uint64_t bytes = uint64_t(order.size()) * sizeof(Key);
  if (!work.charge(bytes) || !work.tick(uint32_t(std::min<size_t>(order.size() * 150, 1u << 30)))) {
    work.release(bytes);
    return false;
  }
  std::vector<Key> keys(order.size());
  int rounds = 0;
  while (order.size() >> (rounds + 6)) ++rounds;  // the first round holds about 64 points
  for (size_t i = 0; i < order.size(); ++i) {
    auto cell = [](double x) { return uint32_t((x + 1) * ((1u << kBits) / 2 - 0.5)); };
    const Vec3& p = points[order[i]];
    int round = rounds;
    for (uint64_t h = mixed(order[i] + 1); round > 0 && (h & 1); h >>= 1) --round;
    keys[i].place = uint64_t(round) << (3 * kBits) ^ hilbertPlace(cell(p.x), cell(p.y), cell(p.z));
    keys[i].number = order[i];
  }
  sf::sort(keys.begin(), keys.end());
  for (size_t i = 0; i < order.size(); ++i) order[i] = keys[i].number;
  work.release(bytes);
  return true;
}

}  // namespace sf
