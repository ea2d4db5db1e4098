// All crossings of segments in the plane, and the winding numbers of the faces they bound.
// Source: Bentley, Ottmann 1979, "Algorithms for reporting and counting geometric intersections".
// Differs: exact, so that touching, overlapping and concurrent segments need no care. An event
// takes all segments through its point out of the order along the sweep line, and puts back those
// that go on, by direction.
#pragma once
#include <cstdint>
#include <vector>

#include "base/array_view.h"
#include "base/charge.h"
#include "polygon/input/polygon.h"

namespace sf {

/// A segment between two points, given by their numbers in `below` order.
struct WeightedEdge {
  uint32_t low, high;
  int32_t weight;  // how much higher the winding number is to the left than to the right
  uint32_t input;  // first vertex of the input edge that it is a part of
};

/// A point in the inside of an edge.
struct EdgeCut {
  uint32_t edge;
  uint32_t point;  // number of a point; or the number of points + number of a crossing
};

struct EdgeCrossing {
  uint32_t first, second;  // two of the edges
  Point2 at;               // within 2^-50 of either coordinate
};

struct Crossings {
  std::vector<EdgeCrossing> crossings;  // points inside two edges or more that are no input points
  std::vector<EdgeCut> cuts;            // those of one edge from its lower end to its upper one
  // If there are no cuts:
  std::vector<int32_t> winding;  // [e] winding number to the left of the edge
  std::vector<uint32_t> left;    // [e] the edge directly left of the edge's lower end, or kNone
};

/// Finds where edges cross, and which points lie inside edges.
///   at     [m] different points in `below` order, in the range of polygon/repair/crossing_point.h
///   edges  [e] by increasing `low`, no two with the same ends
///   most   the most cuts to find: the sweep ends early if there are more
/// Overlapping edges are cut at each other's ends. O((m + e + k) log (m + e + k)) time for k cuts,
/// memory charged to `charge`. False once `work` has to end.
bool findCrossings(ArrayView<const Point2> at, ArrayView<const WeightedEdge> edges, size_t most,
                   Work& work, Charge& charge, Crossings& result);

}  // namespace sf
