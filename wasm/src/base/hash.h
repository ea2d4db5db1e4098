// Hashes of points.
#pragma once
#include <cstdint>
#include <cstring>

#include "base/vec.h"

namespace sf {

/// The finalizer of splitmix64 (Steele, Lea, Flood 2014).
inline uint64_t mixed(uint64_t x) {
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

/// Equal coordinates have equal hashes; so have 0 and -0.
inline uint64_t hashOf(Vec3 p) {
  const auto bitsOf = [](double x) {
    x += 0.0;  // no -0
    uint64_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    return bits;
  };
  return mixed(bitsOf(p.x) + mixed(bitsOf(p.y) + mixed(bitsOf(p.z) + 0x9E3779B97F4A7C15u)));
}

}  // namespace sf
