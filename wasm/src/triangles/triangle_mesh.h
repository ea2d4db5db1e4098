// Triangles that share edges, as half-edges in flat arrays,
// and operations that change them in place.
//
// Triangle t has the corners corners[3t .. 3t+2], counter-clockwise. Half-edge 3t + k runs from
// corner k to corner k + 1 of t; its twin runs the other way in the triangle on its other side.
//
// Source: Lawson 1977, "Software for C1 surface interpolation", for flips; Guibas, Knuth, Sharir
// 1992, "Randomized incremental construction of Delaunay and Voronoi diagrams", for insertion.
#pragma once
#include <cstdint>
#include <vector>

#include "base/array_view.h"
#include "base/buffer.h"
#include "base/point2.h"
#include "base/work.h"

namespace sf {

/// The next half-edge of the same triangle, counter-clockwise, and the one before.
inline uint32_t nextInTriangle(uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
inline uint32_t prevInTriangle(uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }

/// Finds the twin of every half-edge. False when the work ended.
///   corners      [3m] indices below vertexCount, all triangles of one orientation
///   twins        [3m] out: half-edges, kNone where no other triangle has that edge
/// If more than two triangles share an edge, as where rings touch, they are paired in some way.
/// O(m) time for triangles that do not overlap, even if very many meet at one vertex.
bool findTwins(ArrayView<const uint32_t> corners, uint32_t vertexCount, Work& work,
               std::vector<uint32_t>& twins);

/// Twins for triangles whose common edges may be closed for a time. Half-edges have other numbers
/// here: 3t + k is the half-edge opposite corner k, so corners[h] is the vertex that h sees.
/// Whatever lies beyond the triangles has half-edges too, so that pairing needs no tests: `outside`
/// is the far side of all edges of the loops, and after it come the far sides of closed edges, two
/// by two. If the edge of half-edges h and g is closed, with far sides c and c + 1, then of[h] = c,
/// of[c] = h, of[g] = c + 1, of[c + 1] = g.
struct ClosableTwins {
  Buffer<uint32_t> of;   // [at least end]; of[outside] means nothing
  uint32_t outside = 0;  // even, not below the number of half-edges
  uint32_t end = 0;      // past the far sides of closed edges, which begin at outside + 2

  /// Forgets all twins and makes room for `halves` half-edges and the far sides of `closed` closed
  /// edges. The elements of `of` are not cleared.
  void reset(uint32_t halves, uint32_t closed) {
    outside = (halves + 1) & ~1u, end = outside + 2;
    if (of.size() < end + 2 * size_t(closed)) of.resize(end + 2 * size_t(closed));
  }
  void pair(uint32_t h, uint32_t g) { of[h] = g, of[g] = h; }
  /// Closes the edge of h, which must have a twin. Makes room for its far sides.
  void close(uint32_t h);
  /// Adds the far sides of one closed edge, for which there must be room; returns the first,
  /// even one.
  uint32_t addClosed() { return end += 2, end - 2; }
  /// Opens all closed edges.
  void open();
  /// Converts from the form of findTwins, and back to it; all edges are open afterwards.
  void fromPlain(ArrayView<const uint32_t> plain);
  void toPlain(ArrayView<uint32_t> plain);
};

/// Triangles of positive area.
struct TriangleMesh {
  ArrayView<const Point2> at;      // [n] positions
  ArrayView<const Point2> metric;  // [n] the same within the range of base/predicates: for angles
  std::vector<uint32_t> corners;   // [3m]
  std::vector<uint32_t> twins;     // [3m]
  // [n] for each vertex a half-edge that starts there; or empty. Flips and splits of other edges
  // renumber it, but keep its edge.
  std::vector<uint32_t> edgeFrom;
  std::vector<uint32_t> unused;  // triangles no longer in use, all three corners kNone

  uint32_t from(uint32_t h) const { return corners[h]; }
  uint32_t to(uint32_t h) const { return corners[nextInTriangle(h)]; }
  uint32_t apex(uint32_t h) const { return corners[prevInTriangle(h)]; }
  uint32_t triangleCount() const { return uint32_t(corners.size() / 3); }
  bool inUse(uint32_t t) const { return corners[3 * t] != kNone; }
  /// A new triangle without twins: its first half-edge.
  uint32_t create(uint32_t a, uint32_t b, uint32_t c);
  /// Frees a triangle. The twins of its neighbours are not changed.
  void discard(uint32_t t);
  /// Sets edgeFrom: at the boundary the half-edge without a twin, elsewhere any.
  void findEdges();
  /// +1 if the vertices turn left, -1 right, 0 collinear.
  int orient(uint32_t a, uint32_t b, uint32_t c) const;
  void setTwins(uint32_t h, uint32_t g) {
    if (h != kNone) twins[h] = g;
    if (g != kNone) twins[g] = h;
  }

  /// Whether the apex across h lies inside the circle through the triangle of h, and the two
  /// triangles form a strictly convex quadrilateral; false if there is no twin.
  bool isIllegal(uint32_t h) const;
  /// Replaces the edge of h by the other diagonal of its quadrilateral, which must be strictly
  /// convex. If g is the twin of h, next(h) and next(g) become the new diagonal. The other four
  /// half-edges become the sides; h and g keep their first vertices.
  void flip(uint32_t h);
  /// Divides the triangle of h by a vertex v strictly inside it: h stays, with apex v, and two
  /// triangles are created.
  void splitTriangle(uint32_t h, uint32_t v);
  /// Divides edge h, which must have a twin, by a vertex v strictly inside it;
  /// creates two triangles.
  void splitEdge(uint32_t h, uint32_t v);
  /// Where a vertex v lies. insert() splits the triangle or the edge there, and appends the edges
  /// opposite v to `opposite`.
  struct Place {
    uint32_t edge = kNone;  // v is in the triangle of this half-edge; kNone: not found
    bool onEdge = false;    // v lies on the edge itself
  };
  void insert(Place place, uint32_t v, std::vector<uint32_t>& opposite);

 private:
  void moveEdge(uint32_t oldHalf, uint32_t newHalf) {
    if (!edgeFrom.empty() && edgeFrom[corners[newHalf]] == oldHalf)
      edgeFrom[corners[newHalf]] = newHalf;
  }
};

/// Flips illegal edges until none is left among `edges` and those that flips put in question, or
/// until `budget` flips are done. Empties `edges`; returns how many flips are left of the budget.
/// By Lawson's theorem any order of flips ends; if all edges were given, the triangles are then
/// constrained Delaunay. The first few flips bring most of the gain in angles.
uint32_t legalize(TriangleMesh& mesh, std::vector<uint32_t>& edges, uint32_t budget, Work& work);

}  // namespace sf
