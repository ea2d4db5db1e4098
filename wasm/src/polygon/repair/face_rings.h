// The rings around the chosen faces of edges that do not cross.
// Source: Ronfard, Rossignac 1994, sec. 1: at a vertex of several edges the next edge is the first
// one clockwise, so that each ring goes around the inside of one piece of the polygon.
// Differs: rings are cut wherever they come back to a vertex, so that all are simple.
#pragma once
#include "polygon/input/options.h"
#include "polygon/repair/crossing_sweep.h"

namespace sf {

struct FaceRings {
  std::vector<uint32_t> vertices;    // [m] numbers of points
  std::vector<uint32_t> ringStarts;  // [r+1] in vertices
  std::vector<uint32_t>
      polygonStarts;  // [p+1] in rings: outer, counter-clockwise; holes, clockwise
};

/// Rings of the faces whose winding number is odd (Repair::EvenOdd) or not 0 (Repair::NonZero).
///   at, edges, found  input and result of findCrossings, without cuts
/// Simple rings that meet in points alone; the inside of each polygon is connected.
/// O((m + e) log (m + e)). False once `work` has to end.
bool traceFaces(ArrayView<const Point2> at, ArrayView<const WeightedEdge> edges,
                const Crossings& found, Repair rule, Work& work, Charge& charge, FaceRings& result);

}  // namespace sf
