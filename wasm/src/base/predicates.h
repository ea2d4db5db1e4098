// Geometric predicates whose signs are right for every input: filters first, exact arithmetic last.
// Source: Shewchuk 1997, "Adaptive precision floating-point arithmetic and fast robust geometric
// predicates"; Devillers, Teillaud 2011, "Perturbations for Delaunay and weighted Delaunay 3D
// triangulations", for the ties of insphere.
// Differs: one middle stage in double-double arithmetic in place of Shewchuk's stages B and C, and
// a test for small integers, which makes lattice points as fast as random ones.
//
// Range: the signs are exact if every coordinate is 0 or has a magnitude in [2^-200, 1];
// scaleToUnit brings points into this range. Far beyond it they stay exact as long as nothing
// under- or overflows. The predicates need rounding to nearest in double precision
// and no fused multiply-add.
#pragma once
#include <cstdint>
#include <vector>

#include "base/array_view.h"
#include "base/vec.h"

namespace sf {

/// Scales points by the power of two 2^-e that brings the largest magnitude into [1/2, 1).
/// Magnitudes that are then below 2^-200 become 0, and so does -0. Returns e, or 0 if all
/// coordinates are zero: points[i] = 2^e scaled[i], except where a coordinate became 0.
///   points  [n] finite, any magnitude
///   scaled  [n] the result; must not be the vector that `points` views
int scaleToUnit(ArrayView<const Vec3> points, std::vector<Vec3>& scaled);

/// +1 if a, b, c make a left turn in the plane, -1 for a right turn, 0 if collinear.
int orient2d(double ax, double ay, double bx, double by, double cx, double cy);

/// The sign of (b-a) x (d-c): +1 if the direction from c to d is left of that from a to b, -1 if
/// right, 0 if they are parallel. +1 also means that d lies farther than c to the left of the line
/// through a and b.
int turn2d(double ax, double ay, double bx, double by, double cx, double cy, double dx, double dy);

/// The sign of (b-a) x (c-a) . (d-a): +1 if a, b, c turn left when seen from d, 0 if coplanar.
int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Whether three points lie on one line; true as well if two of them are equal.
bool collinear(const Vec3& a, const Vec3& b, const Vec3& c);

/// +1 if d lies inside the circle through a, b, c, -1 outside, 0 on it; the other way round if
/// a, b, c turn right. 0 if they are collinear and d is on their line.
int incircle(double ax, double ay, double bx, double by, double cx, double cy, double dx,
             double dy);

/// +1 if e lies inside the sphere through a, b, c, d, -1 outside, 0 on it; the other way round if
/// orient3d(a, b, c, d) is negative.
int insphere(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e);

/// insphere with ties broken: every point is lifted off the paraboloid by an infinitely small
/// amount, points of higher rank by infinitely more. Never 0. Which spheres are empty depends on
/// the ranks alone, not on the order of the points, and the tetrahedra with empty spheres fill the
/// convex hull without overlaps.
///   p     the four corners, orient3d of them positive, and the point tested
///   rank  five different numbers
int insphereByRank(const Vec3* const p[5], const uint32_t rank[5]);

/// incircle with the ties broken in the same way.
///   x, y  the three corners, turning left, and the point tested
int incircleByRank(const double x[4], const double y[4], const uint32_t rank[4]);

}  // namespace sf
