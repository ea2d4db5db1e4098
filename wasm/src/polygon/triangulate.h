// Triangulation of polygons with holes. The one entry to src/polygon for polygons from outside.
// Source: Ronfard, Rossignac 1994 (flooding); Kumar, sec. 4 (trapezoids).
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "base/status.h"
#include "base/work.h"
#include "polygon/input/options.h"
#include "polygon/input/polygon.h"

namespace sf {

struct PolygonTriangulation {
  // [3m] counter-clockwise, vertices as in the input. m = n + 2 holes - 2 if rings do not touch; a
  // touch at vertices leaves out two triangles. Triangles of area 0 occur only where consecutive
  // vertices are equal, or where a vertex lies on an edge elsewhere in the rings.
  std::vector<uint32_t> triangles;
  std::vector<uint32_t> strips, stripStarts;  // if asked for: OpenGL order, strip i is
                                              // strips[stripStarts[i] .. stripStarts[i+1]]
  std::vector<double> added;                  // [2a] points that repair added, numbered from n on
  std::vector<uint32_t> addedOn;              // [2a] the two edges that each is on
  std::vector<FloodStep> trace;               // if asked for
};

/// Many polygons in flat arrays.
struct PolygonBatch {
  ArrayView<const double> positions;        // [2n]
  ArrayView<const uint32_t> ringStarts;     // [r+1] into vertices
  ArrayView<const uint32_t> polygonStarts;  // [p+1] into rings
};

struct PolygonFault {
  uint32_t polygon;
  Outcome outcome;  // `loop` counted in that polygon
};

struct PolygonBatchResult {
  std::vector<uint32_t> triangles;       // [3m] indices into the batch's positions
  std::vector<uint32_t> triangleStarts;  // [p+1] in triangles; an invalid polygon has none
  std::vector<PolygonFault> faults;      // the invalid polygons, in order
};

/// Triangulates polygons one after the other, with memory that is kept for the next one.
class PolygonTriangulator {
 public:
  PolygonTriangulator();
  ~PolygonTriangulator();

  /// Every triangle lies inside the polygon, and they cover it exactly, without T-junctions.
  /// Errors: those of PlaneSweep::run; with `repair` only NotFinite, BadStarts, OutOfMemory,
  /// TooLarge and Stopped. O(n log n) time, O(n) memory, charged to `work`.
  Outcome triangulate(const PolygonView& polygon, const PolygonOptions& options, Work& work,
                      PolygonTriangulation& result);

  /// The same by flooding, made constrained Delaunay, and no more: what callers of the core alone need.
  ///   triangles  [3m] out: empty before
  Outcome floodDelaunay(const PolygonView& polygon, Work& work, std::vector<uint32_t>& triangles);

  /// The same for many polygons; options `strips`, `trace` and `repair` do not apply. The outcome
  /// is about the batch as a whole: BadStarts, OutOfMemory, Stopped.
  Outcome triangulateBatch(const PolygonBatch& batch, const PolygonOptions& options, Work& work,
                           PolygonBatchResult& result);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// PolygonTriangulator::triangulate for a single polygon.
Outcome triangulatePolygon(const PolygonView& polygon, const PolygonOptions& options, Work& work,
                           PolygonTriangulation& result);

}  // namespace sf
