// Normals of triangles that are all but collinear, whose directions plain arithmetic loses.
#pragma once
#include "base/expansion.h"
#include "base/vec.h"

namespace sf {

/// Whether a cross product this long, of vectors of these squared lengths, has lost more than a
/// few digits to cancellation.
inline bool isThin(double crossSquared, double aSquared, double bSquared) {
  return crossSquared < 1e-8 * aSquared * bSquared;
}

/// (b - a) x (c - a) to nearly full precision, as far as its length is above 1e-30 of its factors.
/// Points in the range of the predicates (base/predicates.h).
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
