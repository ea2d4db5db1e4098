// Points where two segments cross: exact tests on them, though no double need hold their places.
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

/// The point inside two segments that are not parallel, and where it is but for 2^-50 of either
/// coordinate.
struct CrossingPoint {
  Line s, t;
  Point2 at;
};

/// Computes `at` for two segments that cross.
CrossingPoint crossingPoint(const Line& s, const Line& t);

/// Negative if p is below q (polygon/input/polygon.h), positive above, 0 at the same place.
int compare(const CrossingPoint& p, Point2 q);
int compare(const CrossingPoint& p, const CrossingPoint& q);

/// Positive if p is left of the line through a segment, negative right, 0 on it.
int sideOf(const Line& segment, const CrossingPoint& p);

/// Twice the signed area of a ring as a sign, exact.
///   ring  [n] points; the last is joined to the first
int areaSign(ArrayView<const Point2> ring);

}  // namespace sf
