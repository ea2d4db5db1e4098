// Polygons in space: the plane of a ring, and coordinates in it.
//
// Source: Newell's sum of cross products for the normal (Sutherland, Sproull, Schumacker 1974, "A
// characterization of ten hidden-surface algorithms").
// Differs: validity is judged by two of the three space coordinates, not by lengths along axes in
// the plane. The coordinate along which the normal is largest is left out. So nothing is rounded,
// vertices on edges stay on them, and rings that touch still do.
#pragma once
#include <cstdint>
#include <vector>

#include "base/array_view.h"
#include "base/vec.h"

namespace sf {

/// A plane on which a ring runs counter-clockwise.
struct Plane {
  Vec3 through;      // a point of it
  double normal[3];  // of any length; component `dropped` is the largest, and not 0
  uint32_t u, v;     // the axes whose coordinates are kept, in this order
  uint32_t dropped;

  /// Whether two axes of space lie in it, so that the coordinates kept are lengths.
  bool isAcrossAxis() const { return normal[u] == 0 && normal[v] == 0; }
  /// The point of the plane with the coordinates x along u and y along v.
  Vec3 lift(double x, double y) const;
};

/// The plane through the first vertex that fits a ring best: perpendicular to Newell's normal, or,
/// if that nearly vanishes because the ring winds both ways, to the direction of least variance.
/// Any plane for a ring of collinear points, or with coordinates that are not finite. O(n) time.
///   ring  [3n] xyz
Plane planeOf(ArrayView<const double> ring);

/// Coordinates in the plane, counter-clockwise as the plane's ring.
///   from       [3n] xyz
///   to         [2n] out: the coordinates along u and v unchanged; or, if `isometric`, lengths
///              along axes in the plane, rounded
void flatten(const Plane& plane, bool isometric, ArrayView<const double> from,
             std::vector<double>& to);

}  // namespace sf
