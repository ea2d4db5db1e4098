// Trapezoids of a polygon, their diagonals, the uni-monotone polygons between these, and triangles.
//
// The horizontal visibility lines of all nodes cut the polygon into trapezoids. Each has one node
// on its lower side and one on its upper side; a diagonal joins the two unless an edge of the
// polygon does. The diagonals cut the polygon into uni-monotone polygons.
//
// Each edge of the polygon is the base ("monotone segment") of exactly one of these, and its chain
// consists of the nodes whose visibility lines end on that edge: the trapezoids along an edge are
// stacked, two of them that follow each other share the node between them, and so the chain runs
// through their diagonals and short edges. Hence the uni-monotone polygons are a counting sort of
// visibility lines by the edges that they end on; neither trapezoids nor diagonals need be kept.
//
// Source: Kumar, sec. 4, after Fournier, Montuno 1984, and Seidel 1991; sec. 4.1 for thin
// trapezoids.
// Differs:
// - Visibility lines come from a plane sweep (sweep.h), not from Seidel's randomised construction.
// - Isolated vertices take part in the sweep, but not in the trapezoids of TrapezoidTriangulator: a
//   grid would be rows of trapezoids as wide as the polygon and of no height. Over 20 x 20 points
//   in a blob the mean smallest angle is 3.8 degrees that way, whatever the monotone triangulation.
//   They are inserted into the finished triangles, in random rounds, and edges around them flipped.
// - Diagonals of thin trapezoids are made like all others, and the triangles are then made
//   constrained Delaunay (constrained_delaunay.h), which takes as long as the u-trees. That
//   does what leaving the diagonals out would do, since the chains on both sides then exchange
//   triangles; but it needs no monotone polygons of two chains. Flips alone would do for most
//   polygons, but would take O(n) time a vertex across the inside of a densely sampled curve, where
//   most trapezoids are thin.
#pragma once
#include <cstdint>
#include <vector>

#include "base/work.h"
#include "polygon/fill/constrained_delaunay.h"
#include "polygon/fill/u_tree.h"
#include "polygon/input/polygon.h"
#include "polygon/strips/strip_flips.h"
#include "polygon/sweep/sweep.h"
#include "triangles/triangle_mesh.h"

namespace sf {

/// The part of the polygon between two consecutive visibility lines that end on its two edges.
struct Trapezoid {
  uint32_t bottom, top;  // nodes
  uint32_t left, right;  // edges, by their lower nodes as in Visibility
};

/// All trapezoids, by increasing height of their tops: two for each top, none for a bottom, one for
/// every other node. False when the work ended. O(m) time.
bool findTrapezoids(const LinkedPolygon& linked, const Visibility& seen, Work& work,
                    std::vector<Trapezoid>& trapezoids);

/// Polygon 2u has the base u - prev[u] and its chain to the right, polygon 2u + 1 the base
/// u - next[u] and its chain to the left. Polygon i is chain[starts[i]] .. chain[starts[i+1] - 1],
/// from its lowest vertex to its highest. It is empty if node u has no such edge upwards, or if no
/// node sees that edge.
struct UniMonotonePolygons {
  std::vector<uint32_t> starts;  // [2m+1]
  std::vector<uint32_t> chain;
};

/// Finds the uni-monotone polygons. O(m) time.
///   islands  whether isolated vertices take part; they are left out otherwise
bool findUniMonotonePolygons(const LinkedPolygon& linked, const Visibility& seen, bool islands,
                             Work& work, UniMonotonePolygons& polygons);

/// Triangulates polygons by trapezoids and u-trees; keeps its memory from one to the next.
class TrapezoidTriangulator {
 public:
  /// Appends the triangles, as nodes, counter-clockwise and of positive area, to `triangles`.
  /// Islands are among their vertices. False when the work ended.
  ///   seen       of all nodes, not of sags alone
  ///   delaunay   whether triangles are made constrained Delaunay, or left as the u-trees make
  ///              them; around very many islands some may not be
  ///   forStrips  whether some edges are flipped so that strips get longer, at a small loss in
  ///              angles
  bool triangulate(const LinkedPolygon& linked, const Visibility& seen, bool delaunay,
                   bool forStrips, Work& work, std::vector<uint32_t>& triangles);

 private:
  bool improve(const LinkedPolygon& linked, const Visibility& seen, bool delaunay, Work& work);
  bool insertIslands(const LinkedPolygon& linked, const Visibility& seen, Work& work);
  TriangleMesh::Place followSight(uint32_t e, uint32_t p) const;

  UniMonotonePolygons polygons_;
  UTree tree_;
  TriangleMesh mesh_;
  ConstrainedDelaunay delaunay_;
  ClosableTwins twins_;  // while it works
  StripFlips stripFlips_;
  std::vector<uint32_t> edges_;
  std::vector<uint32_t> islands_;
  std::vector<Point2> scaled_;
};

}  // namespace sf
