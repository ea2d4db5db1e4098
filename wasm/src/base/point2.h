// Points of the plane, and their order from below.
#pragma once
#include <cmath>

#include "base/status.h"

namespace sf {

struct Point2 {
  double x, y;
};
inline bool operator==(Point2 a, Point2 b) { return a.x == b.x && a.y == b.y; }

/// Whether a point is accepted as input: no coordinate is NaN or beyond kLargestCoordinate.
inline bool isAccepted(Point2 p) {
  return std::fabs(p.x) <= kLargestCoordinate && std::fabs(p.y) <= kLargestCoordinate;
}

/// Whether a is lower than b: by y, and at equal y by x, as if horizontal lines rose a little
/// towards the right. Of two points at one place neither is below the other.
/// Source: Ronfard, Rossignac 1994, sec. 5, `below`.
inline bool below(Point2 a, Point2 b) { return a.y < b.y || (a.y == b.y && a.x < b.x); }

}  // namespace sf
