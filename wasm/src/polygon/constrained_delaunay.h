// Constrained Delaunay triangles from any triangles of a polygon.
//
// The list of triangles is taken in blocks. Within a block, edges are flipped until all are legal. Those
// between blocks are fixed at first, then given up one after the other, between neighbours in the list
// first, between its halves last; each time the triangles to the left and to the right of the edge,
// constrained Delaunay by themselves, are merged. All that a merge makes crosses the edge, from one end
// to the other: a circle that rises along the edge finds them in that order, and meets nothing that it
// would have to take back.
//
// Source: Guibas, Stolfi 1985, "Primitives for the manipulation of general subdivisions and the
// computation of Voronoi diagrams", sec. 9, for the merge; Chew 1989, "Constrained Delaunay
// triangulations", for merges between fixed edges; Lawson 1977, "Software for C1 surface
// interpolation", for flips.
// Differs: parts are separated by an edge that both have, not by a line, so that the circle starts at
// its end; both sides may be connected elsewhere, around a hole or an isolated point. Flips alone would
// take O(n) a vertex on smooth curves, since water leaves thin triangles side by side. PAPERS.md has why
// merges work.
#pragma once
#include <cstdint>
#include <vector>

#include "base/work.h"
#include "polygon/polygon.h"

namespace sf {

class ConstrainedDelaunay {
 public:
  /// Makes the triangles constrained Delaunay: no node that a triangle sees past none of the loops'
  /// edges lies inside its circle, by exact incircle for coordinates in the range of the predicates.
  ///   triangles  [3m] nodes, a triangulation of the loops; m stays
  ///   twins      [3m] as of findTwins (triangle_mesh.h); changed likewise
  /// Triangles that are Delaunay stay, also where more than three nodes lie on one circle.
  /// False, and both lists undefined, once `work` is to end. O(n log n) time for all but unnatural
  /// polygons; memory is charged, and kept for the next call.
  bool run(const LinkedPolygon& loops, Work& work, ArrayView<uint32_t> triangles,
           ArrayView<uint32_t> twins);

 private:
  /// An edge of the border of what a merge has taken away: from the vertex of the one below it in the
  /// list to `vertex`; `outer` is the twin of what will come to lie on it.
  struct Border {
    uint32_t vertex, outer;
  };

  bool flipBlocks(Work& work);
  void orderEdges();
  bool giveUpEdges(Work& work);
  bool isIllegal(uint32_t h) const;
  uint32_t merge(uint32_t h);
  void takeLeft(uint32_t left, uint32_t right);
  void takeRight(uint32_t left, uint32_t right);
  uint32_t create(uint32_t a, uint32_t b, uint32_t c);
  void setTwin(uint32_t h, uint32_t g);
  void flip(uint32_t h);
  void push(uint32_t h);
  bool flipStacked(Work& work);

  uint32_t *corners_ = nullptr, *twins_ = nullptr;
  uint32_t count_ = 0;
  const Point2 *at_ = nullptr, *metric_ = nullptr;
  bool isExact_ = true;  // the circles of `metric` are those of `at`
  std::vector<Point2> scaled_;
  std::vector<uint32_t> halves_;  // the half-edges of fixed edges, two by two
  std::vector<uint32_t> order_;
  std::vector<Border> left_, right_;
  std::vector<uint32_t> free_;  // triangles taken away
  // The half-edges of edges to look at, none twice.
  std::vector<uint32_t> stack_;
  uint32_t waiting_ = 0;
  // [3m] Whether a half-edge is among them. Bytes would do, but the compiler takes whatever it knows
  // to be changed by one that is written.
  std::vector<uint16_t> waits_;
};

}  // namespace sf
