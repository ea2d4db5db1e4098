// Constrained Delaunay triangles from any triangles of a polygon, by flips.
// Source: Lawson 1977, "Software for C1 surface interpolation"; Lee, Lin 1986, "Generalized Delaunay
// triangulation for planar graphs", for flips that stop at fixed edges.
// Differs: points on one circle are never flipped, so ties stay as they came. Flooding leaves thin
// triangles side by side, which may need O(n) flips a vertex: after a few flips a triangle the
// vertices are inserted into a Delaunay triangulation instead (delaunay_insertion.h).
#pragma once
#include <cstdint>
#include <vector>

#include "base/work.h"
#include "polygon/polygon.h"
#include "polygon/triangle_mesh.h"

namespace sf {

class DelaunayFlips {
 public:
  /// Makes the triangles constrained Delaunay: no node that a triangle sees past none of the loops'
  /// edges lies inside its circle, by exact incircle for coordinates in the range of the predicates.
  ///   triangles  [3t] nodes, a triangulation of the loops; t stays
  /// False, and `triangles` undefined, once `work` is to end. Near-linear time but for unnatural input.
  bool run(const LinkedPolygon& loops, Work& work, std::vector<uint32_t>& triangles);

 private:
  void takeAllEdges();

  TriangleMesh mesh_;
  std::vector<uint32_t> edges_;
  std::vector<Point2> scaled_;
};

}  // namespace sf
