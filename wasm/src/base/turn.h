// orient2d on points of any magnitude, its filter inline: the one geometric test of the sweep and
// of flooding.
// Source: Shewchuk 1997, orient2d, stage A; Ronfard, Rossignac 1994, sec. 5, `convex`.
#pragma once
#include <cmath>
#include "base/point2.h"

namespace sf {

/// turn where the filter leaves the sign open: by base/predicates.h if its range allows, else by an
/// exact sum in integers of some thousand bits.
double turnExactly(Point2 a, Point2 b, Point2 c);

/// The largest error of the filter's determinant if the magnitudes of its two products sum to
/// `sizes`: Shewchuk's (3 + 16 u) u with u = 2^-53, rounded up.
/// The last number exceeds all underflows.
inline double errorOfTurn(double sizes) { return 0x1p-51 * sizes + 1e-290; }

/// Positive if a, b, c turn left, negative if right, 0 if collinear.
/// Exact for all accepted points (isAccepted).
inline double turn(Point2 a, Point2 b, Point2 c) {
  const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
  const double det = left - right;
  if (std::fabs(det) > errorOfTurn(std::fabs(left) + std::fabs(right))) return det;
  return turnExactly(a, b, c);
}

/// The largest error of a determinant, for all points of a box.
inline double errorOfTurns(Point2 least, Point2 greatest) {
  return errorOfTurn(2.01 * (greatest.x - least.x) * (greatest.y - least.y));
}

/// The same, but faster: `error` is errorOfTurns of a box that holds the points.
inline double turn(Point2 a, Point2 b, Point2 c, double error) {
  const double det = (a.x - c.x) * (b.y - c.y) - (a.y - c.y) * (b.x - c.x);
  if (std::fabs(det) > error) return det;
  return turn(a, b, c);
}

/// +1 if the direction from c to d is left of that from a to b, -1 right, 0 parallel.
/// As exact as turn.
int turnBetween(Point2 a, Point2 b, Point2 c, Point2 d);

}  // namespace sf
