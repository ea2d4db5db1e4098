// Constrained Delaunay triangles from any triangles of a polygon.
//
// The list of triangles is taken in blocks. Within a block edges are flipped until all are legal.
// If the triangles come from flooding, each was made for a vertex; flips start around that vertex,
// as if it were inserted. Edges between blocks, and bridges, are closed at first. Then they are
// given up one after the other: those between neighbours in the list first, those between its two
// halves last. Each time the triangles to the left and to the right of the edge, constrained
// Delaunay by themselves, are merged. All edges that a merge makes cross this edge, in a row from
// one end to the other. A circle that rises along the edge finds them in that order and never has
// to take one back.
//
// Source: Guibas, Stolfi 1985, "Primitives for the manipulation of general subdivisions and the
// computation of Voronoi diagrams", sec. 9, for the merge; Chew 1989, "Constrained Delaunay
// triangulations", for merges between fixed edges; Lawson 1977, "Software for C1 surface
// interpolation", for flips.
// Differs: the two parts are separated by a common edge, not by a line, so the circle starts at the
// end of that edge. Both sides may be connected elsewhere, around a hole or an isolated point.
// Flips alone would take O(n) time a vertex on smooth curves, since flooding leaves thin triangles
// side by side. PAPERS.md explains why merges work.
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
  /// Makes the triangles constrained Delaunay: no node inside a triangle's circle can be seen from
  /// the triangle without crossing an edge of the loops. Circle tests are exact for coordinates in
  /// the range of the predicates.
  ///   triangles  [3m] nodes, a triangulation of the loops; their number stays
  ///   twins      of these, with any edges closed; all are open afterwards
  /// Triangles that are Delaunay stay, even if more than three nodes lie on one circle. False once
  /// `work` is to end; both lists are then undefined. O(n log n) time for all but unnatural
  /// polygons. Memory is charged, and kept for the next call.
  bool run(const LinkedPolygon& loops, Work& work, ArrayView<uint32_t> triangles,
           ClosableTwins& twins);
  /// The same, but faster, for the triangles and twins of a Flood that has run with `paired`.
  bool runFlooded(const LinkedPolygon& loops, Work& work, Flood& flood);

 private:
  /// An edge on the border of the triangles that a merge has taken away. It runs from the vertex of
  /// the entry below it in the list to `vertex`. `outer` will be the twin of the half-edge that is
  /// made along it.
  struct Border {
    uint32_t vertex, outer;
  };
  /// A stack in memory reserved beforehand, as much as a merge can need.
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
  // Half-edges of edges to look at, none twice;
  // or triangles whose edge opposite the apex is illegal.
  std::vector<uint32_t> stack_;
  uint32_t waiting_ = 0;
  // [3m] Whether a half-edge is among them. Not bytes: the compiler takes a write to a byte to
  // change whatever else it knows.
  std::vector<uint16_t> waits_;
};

}  // namespace sf
