// The segments along a sweep line from left to right: a list of neighbours,
// and a treap to find places.
// Source: Seidel, Aragon 1996, "Randomized search trees". Differs: priorities are hashes of the
// segments' numbers, so that every run is the same.
#pragma once
#include <cstdint>
#include <vector>

#include "base/assert.h"
#include "base/status.h"

namespace sf {

/// An ordered set of numbers below a capacity. Where a number is inserted decides its order.
class SegmentOrder {
 public:
  /// Empties the set and makes room for the numbers below `capacity`.
  void reset(size_t capacity) {
    nodes_.assign(capacity, Node{});
    root_ = leftmost_ = kNone;
  }
  static size_t bytes(size_t capacity) { return capacity * sizeof(Node); }

  uint32_t leftOf(uint32_t s) const { return nodes_[s].left; }
  uint32_t rightOf(uint32_t s) const { return s == kNone ? leftmost_ : nodes_[s].right; }

  /// The last segment for which `isLeft` holds, kNone if there is none; those for which it holds
  /// come before all others. O(log n) expected.
  template <class F>
  uint32_t lastThat(F&& isLeft) const {
    uint32_t last = kNone;
    for (uint32_t s = root_; s != kNone;) {
      const bool goesRight = isLeft(s);
      if (goesRight) last = s;
      s = nodes_[s].child[goesRight];
    }
    return last;
  }

  /// Puts s directly right of `left`, or first if that is kNone. O(log n) expected.
  void insertAfter(uint32_t left, uint32_t s) {
    const uint32_t right = rightOf(left);
    nodes_[s] = {left, right, kNone, {kNone, kNone}};
    (left == kNone ? leftmost_ : nodes_[left].right) = s;
    if (right != kNone) nodes_[right].left = s;
    // Of two neighbours in order, one has no child on the side of the other.
    const bool below = left != kNone && nodes_[left].child[1] == kNone;
    const uint32_t parent = below ? left : right;
    nodes_[s].parent = parent;
    if (parent == kNone)
      root_ = s;
    else
      nodes_[parent].child[below] = s;
    while (nodes_[s].parent != kNone && priorityOf(s) > priorityOf(nodes_[s].parent)) rotateUp(s);
  }

  /// Takes s out. O(log n) expected.
  void remove(uint32_t s) {
    for (;;) {
      const uint32_t a = nodes_[s].child[0], b = nodes_[s].child[1];
      if (a == kNone || b == kNone) {
        replaceChild(nodes_[s].parent, s, a == kNone ? b : a);
        break;
      }
      rotateUp(priorityOf(a) > priorityOf(b) ? a : b);
    }
    const uint32_t left = nodes_[s].left, right = nodes_[s].right;
    (left == kNone ? leftmost_ : nodes_[left].right) = right;
    if (right != kNone) nodes_[right].left = left;
  }

 private:
  struct Node {
    uint32_t left = kNone, right = kNone;  // neighbours
    uint32_t parent = kNone, child[2] = {kNone, kNone};
  };

  static uint32_t priorityOf(uint32_t s) {
    s = (s ^ (s >> 16)) * 0x7feb352du;
    s = (s ^ (s >> 15)) * 0x846ca68bu;
    return s ^ (s >> 16);
  }
  void replaceChild(uint32_t parent, uint32_t old, uint32_t now) {
    if (parent == kNone)
      root_ = now;
    else
      nodes_[parent].child[nodes_[parent].child[1] == old] = now;
    if (now != kNone) nodes_[now].parent = parent;
  }
  void rotateUp(uint32_t s) {
    const uint32_t p = nodes_[s].parent;
    const int side = nodes_[p].child[1] == s;
    const uint32_t inner = nodes_[s].child[1 - side];
    replaceChild(nodes_[p].parent, p, s);
    nodes_[p].child[side] = inner;
    if (inner != kNone) nodes_[inner].parent = p;
    nodes_[s].child[1 - side] = p;
    nodes_[p].parent = s;
  }

  std::vector<Node> nodes_;
  uint32_t root_ = kNone, leftmost_ = kNone;
};

}  // namespace sf
