// Exact integer arithmetic for oracles: independent of the core's predicates.
#pragma once
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "base/vec.h"

namespace exact {

/// A signed integer of 64 N bits in two's complement; the caller picks an N that never overflows.
template <int N>
struct Int {
  uint64_t limb[N] = {};

  Int() = default;
  Int(int64_t v) {
    limb[0] = uint64_t(v);
    for (int i = 1; i < N; ++i) limb[i] = v < 0 ? ~uint64_t(0) : 0;
  }
  /// x 2^shift, which has to be an integer.
  static Int fromDouble(double x, int shift) {
    int exponent;
    int64_t mantissa = int64_t(std::ldexp(std::frexp(std::fabs(x), &exponent), 53));
    int by = exponent - 53 + shift;
    while (by < 0 && mantissa % 2 == 0) mantissa /= 2, ++by;
    if (mantissa == 0) return Int(0);
    if (by < 0 || by + 54 > 64 * N) std::abort();  // not an integer, or too large
    Int r;
    unsigned __int128 wide = (unsigned __int128)uint64_t(mantissa) << (by % 64);
    r.limb[by / 64] = uint64_t(wide);
    if (by / 64 + 1 < N) r.limb[by / 64 + 1] = uint64_t(wide >> 64);
    return x < 0 ? -r : r;
  }
  int sign() const {
    if (limb[N - 1] >> 63) return -1;
    for (uint64_t l : limb)
      if (l) return 1;
    return 0;
  }
  friend Int operator+(const Int& a, const Int& b) {
    Int r;
    unsigned __int128 carry = 0;
    for (int i = 0; i < N; ++i) {
      carry += (unsigned __int128)a.limb[i] + b.limb[i];
      r.limb[i] = uint64_t(carry);
      carry >>= 64;
    }
    return r;
  }
  friend Int operator-(const Int& a) {
    Int r;
    for (int i = 0; i < N; ++i) r.limb[i] = ~a.limb[i];
    return r + Int(1);
  }
  friend Int operator-(const Int& a, const Int& b) { return a + -b; }
  friend Int operator*(const Int& a, const Int& b) {
    Int r;
    for (int i = 0; i < N; ++i) {
      unsigned __int128 carry = 0;
      for (int j = 0; i + j < N; ++j) {
        carry += (unsigned __int128)a.limb[i] * b.limb[j] + r.limb[i + j];
        r.limb[i + j] = uint64_t(carry);
        carry >>= 64;
      }
    }
    return r;
  }
  friend bool operator==(const Int& a, const Int& b) { return (a - b).sign() == 0; }
};

template <int N>
struct Point {
  Int<N> x, y, z;
};
template <int N>
Point<N> operator-(const Point<N>& a, const Point<N>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <int N>
Int<N> dot(const Point<N>& a, const Point<N>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <int N>
Point<N> cross(const Point<N>& a, const Point<N>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// 2^shift p, which has to be a point of integers.
template <int N>
Point<N> point(const sf::Vec3& p, int shift) {
  return {Int<N>::fromDouble(p.x, shift), Int<N>::fromDouble(p.y, shift),
          Int<N>::fromDouble(p.z, shift)};
}

/// Six times the signed volume of a tetrahedron, positive if a, b, c turn left seen from d.
template <int N>
Int<N> volume6(const Point<N>& a, const Point<N>& b, const Point<N>& c, const Point<N>& d) {
  return dot(cross(b - a, c - a), d - a);
}

/// Positive if e is inside the sphere through the positively oriented a, b, c, d. With weights l_i
/// such that e = sum l_i p_i, e is inside if and only if sum l_i |p_i - e|^2 > 0. The weights are
/// the volumes of the tetrahedra with one corner replaced by e.
///   lift  [5] added to the squared distances of a, b, c, d and e, or null
template <int N>
Int<N> inSphere(const Point<N>& a, const Point<N>& b, const Point<N>& c, const Point<N>& d,
                const Point<N>& e, const Int<N>* lift = nullptr) {
  auto square = [&](const Point<N>& p, int i) {
    Int<N> r = dot(p - e, p - e);
    return lift ? r + lift[i] - lift[4] : r;
  };
  return square(a, 0) * volume6(e, b, c, d) + square(b, 1) * volume6(a, e, c, d) +
         square(c, 2) * volume6(a, b, e, d) + square(d, 3) * volume6(a, b, c, e);
}

}  // namespace exact
