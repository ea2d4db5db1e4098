// Polygons with holes in the plane, and the loops of vertices that the triangulators work on.
// Source: Ronfard, Rossignac 1994, sec. 1 (loops, non-manifold vertices) and sec. 3 (kinds of
// vertices, the data structure).
#pragma once
#include <cstdint>
#include <vector>

#include "base/array_view.h"
#include "base/buffer.h"
#include "base/point2.h"
#include "base/status.h"

namespace sf {

/// A polygon: the part of the plane inside the first ring and outside all others. Turn the first
/// ring counter-clockwise and the others clockwise: the polygon is valid if the rings then wind 0
/// or 1 times around every point off them, and share no segment of positive length, with themselves
/// or each other. So rings may touch, at vertices or where a vertex lies on an edge, but not cross.
/// Consecutive vertices may be equal. A last vertex that equals the first closes the ring and is
/// not counted as a vertex.
struct PolygonView {
  ArrayView<const double> positions;  // [2n] x y
  ArrayView<const uint32_t> starts;   // [r+1] from 0 to n; ring c is starts[c] .. starts[c+1]
  ArrayView<const double> points;     // [2p] isolated vertices strictly inside, numbered from n on;
                                      // in errors, point i is vertex 0 of loop r + i
  // Whether rings are taken as they turn, the polygon to the left of each: it may then have several parts, and
  // parts may lie in holes of others.
  bool isOriented = false;
};

/// What the two edges at a vertex make of it. Sec. 3, fig. 1; "monotonic" vertices are divided by
/// the bank of the gorge on which they lie.
enum class VertexKind : uint8_t {
  LeftBank,   // one edge up, one down, the polygon to the right
  RightBank,  // one edge up, one down, the polygon to the left
  Bottom,     // convex local minimum
  Sag,        // concave local minimum
  Top,        // concave local maximum
  Ceiling,    // convex local maximum
  Island,     // an isolated vertex: a sag and a top in one
  Unused,     // repeats its predecessor's position, so that no loop visits it
};

/// The loops of a polygon as doubly linked lists of nodes. A node is a corner of the polygon: where
/// rings touch, vertices have more corners than occurrences in rings, and each is a node.
/// The polygon lies to the left of every link u -> next[u]; an island is linked to itself.
struct LinkedPolygon {
  Buffer<Point2> at;           // [m] scaled by a power of two, if need be, and turned if `turned`
  Point2 least{}, greatest{};  // corners of the box around all nodes
  double smallest = 0;      // the least magnitude of their coordinates that is not 0, or infinity
  bool turned = false;      // by a quarter, counter-clockwise: input x runs upwards
  Buffer<uint32_t> vertex;  // [m] index in the input
  Buffer<uint32_t> next, prev;
  Buffer<VertexKind> kind;
  // [3z] zero-area triangles of input vertices between the links and the input's edges. They occur
  // where a vertex repeats its predecessor, or lies on an edge, so that the edge's link is divided.
  // Together with a triangulation of the loops they have exactly the edges of
  // the rings as boundary.
  std::vector<uint32_t> flat;
};

}  // namespace sf
