// orient2d on points of any magnitude, its filter inline: the one geometric test of the sweep and of
// flooding.
// Source: Shewchuk 1997, orient2d, stage A; Ronfard, Rossignac 1994, sec. 5, `convex`.
#pragma once
#include <cmath>
#include "base/point2.h"

namespace sf {

/// turn for what the filter cannot tell: base/predicates.h where its range allows, else a sum in
/// integers of some thousand bits.
double turnExactly(Point2 a, Point2 b, Point2 c);

/// What the filter's determinant may be wrong by, for products whose sizes have that sum: Shewchuk's
/// (3 + 16 u) u with u = 2^-53, rounded up; the last number is above all underflows.
inline double errorOfTurn(double sizes) { return 0x1p-51 * sizes + 1e-290; }

/// Positive if a, b, c turn left, negative if right, 0 if collinear. Exact for all points that
/// are accepted.
inline double turn(Point2 a, Point2 b, Point2 c) {
  const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
  const double det = left - right;
  if (std::fabs(det) > errorOfTurn(std::fabs(left) + std::fabs(right))) return det;
  return turnExactly(a, b, c);
}

/// An error of the determinants of all points of a box.
inline double errorOfTurns(Point2 least, Point2 greatest) {
  return errorOfTurn(2.01 * (greatest.x - least.x) * (greatest.y - least.y));
}

/// The same, quicker, for points of a box of which that is the error.
inline double turn(Point2 a, Point2 b, Point2 c, double error) {
  const double det = (a.x - c.x) * (b.y - c.y) - (a.y - c.y) * (b.x - c.x);
  if (std::fabs(det) > error) return det;
  return turn(a, b, c);
}

/// +1 if the direction from c to d is left of that from a to b, -1 right, 0 parallel. Exact alike.
int turnBetween(Point2 a, Point2 b, Point2 c, Point2 d);

}  // namespace sf
