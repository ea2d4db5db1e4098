// Constrained Delaunay triangles from any triangles of a polygon.
//
// The list of triangles is taken in blocks. Within a block, edges are flipped until all are legal: where
// triangles come from flooding, around the vertex that each was made for, as when it is inserted. Edges
// between blocks, and bridges, are closed at first, then given up one after the other, between neighbours
// in the list first, between its halves last; each time the triangles to the left and to the right of the
// edge, constrained Delaunay by themselves, are merged. All that a merge makes crosses the edge, from one end
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

#include "base/charge.h"
#include "polygon/fill/flood.h"
#include "polygon/input/polygon.h"
#include "triangles/triangle_mesh.h"

namespace sf {

class ConstrainedDelaunay {
 public:
  /// Makes the triangles constrained Delaunay: no node that a triangle sees past none of the loops'
  /// edges lies inside its circle, by exact incircle for coordinates in the range of the predicates.
  ///   triangles  [3m] nodes, a triangulation of the loops; m stays
  ///   twins      of these, with any edges closed; all are open afterwards
  /// Triangles that are Delaunay stay, also where more than three nodes lie on one circle.
  /// False, and both lists undefined, once `work` is to end. O(n log n) time for all but unnatural
  /// polygons; memory is charged, and kept for the next call.
  bool run(const LinkedPolygon& loops, Work& work, ArrayView<uint32_t> triangles,
           ClosableTwins& twins);
  /// The same, quicker, for the triangles and twins of a Flood that has run with `paired`.
  bool runFlooded(const LinkedPolygon& loops, Work& work, Flood& flood);

 private:
  /// An edge of the border of what a merge has taken away: from the vertex of the one below it in the
  /// list to `vertex`; `outer` is the twin of what will come to lie on it.
  struct Border {
    uint32_t vertex, outer;
  };
  /// What is pushed and popped, in memory that is there: as much as a merge can need.
  template <class T>
  struct Stack {
    Buffer<T> items;
    T* top = nullptr;  // past the last one
    void clear() { top = items.data(); }
    void push(const T& item) { *top++ = item; }
    T& last() { return top[-1]; }
    void pop() { --top; }
    size_t size() const { return size_t(top - items.data()); }
  };

  bool begin(const LinkedPolygon& loops, ArrayView<uint32_t> triangles, ClosableTwins& twins,
             Charge& charge);
  bool flipBlocks(Work& work);
  bool insertBlocks(Work& work);
  uint32_t insert(uint32_t first);
  bool isIllegal(uint32_t h) const;
  void flip(uint32_t h);
  void push(uint32_t h);
  bool flipStacked(Work& work);
  void orderEdges();
  bool giveUpEdges(Work& work);
  uint32_t merge(uint32_t h);
  void takeLeft(uint32_t left, uint32_t right);
  void takeRight(uint32_t left, uint32_t right);
  uint32_t create(uint32_t a, uint32_t b, uint32_t c);
  void pair(uint32_t h, uint32_t g) { twins_[h] = g, twins_[g] = h; }
  void close(uint32_t h);
  bool isOpen(uint32_t twin) const { return twin < count_; }

  // Half-edges are named as in ClosableTwins.
  ClosableTwins* closable_ = nullptr;
  uint32_t *corners_ = nullptr, *twins_ = nullptr;
  uint32_t count_ = 0;  // of half-edges
  const Point2 *at_ = nullptr, *metric_ = nullptr;
  bool isExact_ = true;  // the circles of `metric` are those of `at`
  double error_ = 0;     // of these circles
  std::vector<Point2> scaled_;
  std::vector<uint32_t> order_;  // closed edges, by the first of their far sides
  Stack<Border> left_, right_;
  Stack<uint32_t> free_;  // triangles taken away
  // The half-edges of edges to look at, none twice; or triangles whose edge below the apex is illegal.
  std::vector<uint32_t> stack_;
  uint32_t waiting_ = 0;
  // [3m] Whether a half-edge is among them. Bytes would do, but the compiler takes whatever it knows
  // to be changed by one that is written.
  std::vector<uint16_t> waits_;
};

}  // namespace sf
