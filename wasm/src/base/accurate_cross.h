// Normals of nearly collinear triangles, whose direction plain arithmetic would lose.
#pragma once
#include "base/expansion.h"
#include "base/vec.h"

namespace sf {

/// Whether a cross product has lost more than a few digits to cancellation. `crossSquared` is its
/// squared length, `aSquared` and `bSquared` are those of its factors.
inline bool isThin(double crossSquared, double aSquared, double bSquared) {
  return crossSquared < 1e-8 * aSquared * bSquared;
}

/// (b - a) x (c - a) to nearly full precision, if it is longer than 1e-30 times the product of the
/// lengths of its factors. Points must be in the range of the predicates (base/predicates.h).
inline Vec3 accurateCross(Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 u = b - a, w = c - a;
  const Vec3 plain = cross(u, w);
  if (!isThin(dot(plain, plain), dot(u, u), dot(w, w))) return plain;
  const auto minor = [](Pair ux, Pair uy, Pair wx, Pair wy) {
    const Pair p = twoProduct(ux.hi, wy.hi), q = twoProduct(uy.hi, wx.hi);
    const Pair high = twoDiff(p.hi, q.hi);
    return high.hi + (high.lo + (p.lo - q.lo) +
                      ((ux.hi * wy.lo + ux.lo * wy.hi) - (uy.hi * wx.lo + uy.lo * wx.hi)));
  };
  const Pair ux = twoDiff(b.x, a.x), uy = twoDiff(b.y, a.y), uz = twoDiff(b.z, a.z);
  const Pair wx = twoDiff(c.x, a.x), wy = twoDiff(c.y, a.y), wz = twoDiff(c.z, a.z);
  return {minor(uy, uz, wy, wz), minor(uz, ux, wz, wx), minor(ux, uy, wx, wy)};
}

}  // namespace sf
