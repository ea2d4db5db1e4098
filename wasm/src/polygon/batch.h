// All polygons of one call of the library, in the plane or in space, and what is wrong with the invalid ones.
#pragma once
#include <cstdint>
#include <vector>

#include "base/array_view.h"
#include "base/status.h"
#include "base/work.h"
#include "polygon/input/options.h"
#include "polygon/triangulate.h"

namespace sf {

/// Polygons as flat arrays that fit each other.
struct FlatPolygons {
  uint32_t dimension;                       // 2, or 3: each polygon lies near a plane of any tilt
  ArrayView<const double> positions;        // [dimension * n]
  ArrayView<const uint32_t> ringStarts;     // [r+1] in vertices, from 0 to n, rising
  ArrayView<const uint32_t> polygonStarts;  // [p+1] in rings, from 0 to r, never falling; a polygon
                                            // without rings is empty
  ArrayView<const double> points;  // [dimension * q] isolated vertices inside the only polygon
};

/// Vertices are numbered through all polygons. Isolated ones follow, then those that repair added.
struct FlatTriangulation {
  std::vector<uint32_t> triangles;       // [3m] counter-clockwise; in space, as the outer ring runs
  std::vector<uint32_t> triangleStarts;  // [p+1] in triangles; an invalid polygon has none
  std::vector<uint32_t> strips;          // if asked for, as in PolygonTriangulation
  std::vector<uint32_t> stripStarts;     // [s+1]
  std::vector<uint32_t> polygonStrips;   // [p+1] in strips
  std::vector<double> added;             // [dimension * a] points that repair added
  std::vector<uint32_t> addedOn;     // [2a] the two edges that each is on, by their first vertices
  std::vector<FloodStep> trace;      // if asked for
  std::vector<PolygonFault> faults;  // the invalid polygons, in order
  std::vector<double> faultPoints;   // [dimension * f] where each fault is, or NaN
};

/// Triangulates polygons one after the other, each as PolygonTriangulator::triangulate does. A polygon in
/// space is first flattened into a plane of its own: along an axis, or without distortion if lengths matter.
///   options  with a trace, as with isolated vertices, there may be only one polygon
///   result   out: empty before
/// The call as a whole fails only with OutOfMemory, TooLarge or Stopped, for which no polygon is to blame.
/// O(n log n) time, O(n) memory, charged to `work`.
Outcome triangulateAll(const FlatPolygons& polygons, const PolygonOptions& options,
                       PolygonTriangulator& triangulator, Work& work, FlatTriangulation& result);

}  // namespace sf
