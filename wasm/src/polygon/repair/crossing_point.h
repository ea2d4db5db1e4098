// Points where two segments cross. Tests on them are exact,
// though doubles may not hold their places.
// Source: Bentley, Ottmann 1979, "Algorithms for reporting and counting geometric intersections",
// for the tests that a sweep over crossings needs; Shewchuk 1997 for the arithmetic.
// Differs: every test has a filter on the rounded point, whose error is known, and then expansions.
//
// Coordinates: 0 or of magnitude in [2^-200, 1], as for base/predicates.
#pragma once
#include "polygon/input/polygon.h"

namespace sf {

/// A segment from its lower end to its upper one.
struct Line {
  Point2 low, high;
};

/// The point where two segments that are not parallel cross. `at` is its place, within 2^-50 of
/// either coordinate.
struct CrossingPoint {
  Line s, t;
  Point2 at;
};

/// Computes `at` for two segments that cross.
CrossingPoint crossingPoint(const Line& s, const Line& t);

/// Negative if p is below q (base/point2.h), positive if above, 0 at the same place.
int compare(const CrossingPoint& p, Point2 q);
int compare(const CrossingPoint& p, const CrossingPoint& q);

/// Positive if p is left of the line through a segment, negative right, 0 on it.
int sideOf(const Line& segment, const CrossingPoint& p);

/// The sign of the signed area of a ring, exact.
///   ring  [n] points; the last is joined to the first
int areaSign(ArrayView<const Point2> ring);

}  // namespace sf
