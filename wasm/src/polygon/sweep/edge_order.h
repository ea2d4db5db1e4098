// The edges that cross the sweep line, from left to right. A list links neighbours; a treap over
// some of them finds the place of a new vertex. Before that, a few steps along the list are tried,
// from an edge that the caller thinks near, or from the edge last seen at about the same x.
// Source: Seidel, Aragon 1996, "Randomized search trees". Differs: priorities are hashes of the
// records' numbers, so that every run is the same; one edge of eight is in the tree, the others are
// reached along the list, and for few edges there is no tree.
#pragma once
#include <cstdint>
#include <vector>

#include "base/status.h"
#include "base/turn.h"
#include "polygon/input/polygon.h"

namespace sf {

/// One monotone chain of edges, of which the sweep line crosses `lo`-`hi`. One cache line.
struct CrossedEdge {
  Point2 lo, hi;              // ends of the input edge, lo below hi
  uint32_t lower, upper;      // nodes at the ends of the link; `lower` moves up where it is divided
  uint32_t input : 31;        // vertex where the input edge starts, along the oriented ring
  uint32_t down : 1;          // the link leads down, so that the polygon is to the right
  uint32_t left, right;       // neighbours along the sweep line, kNone at the ends
  uint32_t parent, child[2];  // treap, for those in it
};

class EdgeOrder {
 public:
  /// Forgets all edges, and makes room for `capacity` of them at once, over points with x from
  /// `least` to `greatest`.
  void reset(size_t capacity, double least, double greatest);
  static uint64_t bytes(uint64_t capacity) { return capacity * (sizeof(CrossedEdge) + 8); }

  CrossedEdge& operator[](uint32_t e) { return edges_[e]; }
  const CrossedEdge& operator[](uint32_t e) const { return edges_[e]; }
  size_t capacity() const { return edges_.size(); }
  /// How many edges there are now.
  size_t size() const { return size_; }
  uint32_t leftmost() const { return leftmost_; }
  /// Finds the edges between which p lies, kNone at the ends. If an edge passes through p, returns
  /// true, with this edge in `left`. O(log n) expected, O(1) if `hint` is an edge close to p; it
  /// may be kNone.
  bool find(Point2 p, uint32_t hint, uint32_t& left, uint32_t& right) const;
  /// Whether a hint is worth its search with that many edges.
  static bool takesHints(size_t capacity) { return capacity > kFew; }
  /// Remembers that edge e was seen near x.
  void remember(uint32_t e, double x) {
    if (hasTree_) near_[columnOf(x)] = e;
  }

  /// Puts the unused record e directly right of `left`, or leftmost if that is kNone. The caller
  /// chooses the record: neighbours in the order should be neighbours in memory. O(log n) expected.
  void insertAfter(uint32_t left, uint32_t e);
  /// Takes a record out. O(log n) expected.
  void remove(uint32_t e);

 private:
  // With at most this many edges the list is searched from its left end.
  static constexpr size_t kFew = 32;

  void index(uint32_t e);
  void unindex(uint32_t e);
  void attach(uint32_t e, uint32_t parent, int side);
  void rotateUp(uint32_t e);
  void replaceChild(uint32_t parent, uint32_t old, uint32_t now);

  /// Positive if p lies left of edge e, negative if right, 0 on it.
  double side(uint32_t e, Point2 p) const { return turn(edges_[e].lo, edges_[e].hi, p); }
  uint32_t columnOf(double x) const { return uint32_t((x - least_) * columnsPerX_); }
  bool walkRight(uint32_t e, Point2 p, uint32_t& left, uint32_t& right) const;
  bool findFrom(uint32_t e, Point2 p, uint32_t& left, uint32_t& right) const;

  std::vector<CrossedEdge> edges_;
  std::vector<uint32_t> near_;
  double least_ = 0, columnsPerX_ = 0;
  bool hasTree_ = false;
  size_t size_ = 0;
  uint32_t root_ = kNone, leftmost_ = kNone;
};

}  // namespace sf
