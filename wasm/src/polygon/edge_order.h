// The edges that cross the sweep line, from left to right: a list for neighbours, and a treap over
// the same records for finding the place of a new vertex.
// Source: Seidel, Aragon 1996, "Randomized search trees". Differs: priorities are hashes of the
// records' numbers, so that every run is the same.
#pragma once
#include <cstdint>
#include <vector>

#include "base/status.h"
#include "polygon/polygon.h"

namespace sf {

/// One monotone chain of edges, of which the sweep line crosses `lo`-`hi`. One cache line.
struct CrossedEdge {
  Point2 lo, hi;              // ends of the input edge, lo below hi
  uint32_t lower, upper;      // nodes at the ends of the link; `lower` moves up where it is divided
  uint32_t input : 31;        // vertex where the input edge starts, along the oriented ring
  uint32_t down : 1;          // the link leads down, so that the polygon is to the right
  uint32_t left, right;       // neighbours along the sweep line, kNone at the ends
  uint32_t parent, child[2];  // treap
};

class EdgeOrder {
 public:
  /// Forgets all edges, and keeps the memory for `capacity` of them at once.
  void reset(size_t capacity);
  static size_t bytes(size_t capacity) { return capacity * sizeof(CrossedEdge); }

  CrossedEdge& operator[](uint32_t e) { return edges_[e]; }
  const CrossedEdge& operator[](uint32_t e) const { return edges_[e]; }
  uint32_t root() const { return root_; }
  uint32_t leftmost() const { return leftmost_; }

  /// A new record directly right of `left`, or leftmost if that is kNone. O(log n) expected.
  uint32_t insertAfter(uint32_t left);
  /// Takes a record out. O(log n) expected.
  void remove(uint32_t e);

 private:
  void attach(uint32_t e, uint32_t parent, int side);
  void rotateUp(uint32_t e);
  void replaceChild(uint32_t parent, uint32_t old, uint32_t now);

  std::vector<CrossedEdge> edges_;
  std::vector<uint32_t> free_;
  size_t used_ = 0;
  uint32_t root_ = kNone, leftmost_ = kNone;
};

}  // namespace sf
