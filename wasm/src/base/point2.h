// Points of the plane, and their order from below.
#pragma once
#include <cmath>

#include "base/status.h"

namespace sf {

struct Point2 {
  double x, y;
};
inline bool operator==(Point2 a, Point2 b) { return a.x == b.x && a.y == b.y; }

/// Whether a point may be given: NaN and what is beyond kLargestCoordinate may not.
inline bool isAccepted(Point2 p) {
  return std::fabs(p.x) <= kLargestCoordinate && std::fabs(p.y) <= kLargestCoordinate;
}

/// Whether a is lower than b: by y, at equal heights by x, as if horizontal lines rose a little
/// towards the right. Points at one place are not below each other.
/// Source: Ronfard, Rossignac 1994, sec. 5, `below`.
inline bool below(Point2 a, Point2 b) { return a.y < b.y || (a.y == b.y && a.x < b.x); }

}  // namespace sf
