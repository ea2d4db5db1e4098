// Exact, slow judges of polygons and their triangulations, in integers: independent of the core.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "support/polygon_generators.h"

namespace sftest {

// What can be wrong with a polygon. Sets of faults are sums of these.
constexpr uint32_t kValid = 0;
constexpr uint32_t kNotFinite = 1;         // a coordinate is NaN, infinite or larger than 1e150
constexpr uint32_t kDegenerate = 2;        // a ring has a spike or fewer than 3 distinct points
constexpr uint32_t kSelfIntersecting = 4;  // a ring crosses itself or runs twice along a segment
constexpr uint32_t kHoleOutside = 8;       // a hole reaches outside or along the outer ring
constexpr uint32_t kHolesOverlap = 16;     // two holes share area or a segment
constexpr uint32_t kNestedHole = 32;       // a hole lies wholly inside another

/// The names in a set of faults, or "valid".
std::string faultNames(uint32_t faults);

/// Everything that is wrong with a polygon. It is valid if its edges meet only in single points,
/// each an end of at least one of the two, and if the winding number is 0 or 1 everywhere, once the
/// outer ring is turned counter-clockwise and the holes clockwise. Repeated consecutive points
/// count once. Exact for coordinates from 1e-150 to 1e150. O(n^2) time.
uint32_t faultsOf(const Polygon& polygon);

/// Whether a vertex has the place of another one, or lies on an edge that is not its own.
bool hasTouches(const Polygon& polygon);

/// Whether the closed edges that start at two vertices (indices into positions) have a common
/// point, other than the vertex that neighbours share.
bool edgesMeet(const Polygon& polygon, uint32_t first, uint32_t second);

/// What is wrong with a triangulation of a valid polygon; empty if nothing is. Exact.
///   triangles  [3m] indices into the polygon's positions
/// No triangle is turned over; signed areas sum to the polygon's; the boundary of their sum is that
/// of the rings; every vertex is used. Without touches also: no triangle has area 0, edges are used
/// once on the boundary and twice inside, and m = n + 2 holes - 2.
std::string faultOfTriangulation(const Polygon& polygon, const std::vector<uint32_t>& triangles);

/// Sign of the exact area of a minus that of b, rings counted by their own orientation.
int compareAreas(const Polygon& a, const Polygon& b);

enum class FillRule { EvenOdd, NonZero };

/// Area of the points whose winding number is odd, or not 0, by slabs between all heights of
/// vertices and crossings. The first ring is turned counter-clockwise and the others clockwise.
/// Good to about 1e-12 of the bounding box. O((n + k) n) for k crossings.
double filledArea(const Polygon& polygon, FillRule rule);

}  // namespace sftest
