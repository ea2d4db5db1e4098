#include "polygon/sweep/edge_order.h"

#include "base/assert.h"

namespace sf {
namespace {

// This many steps along the list cost about as much as a search in the tree.
constexpr int kSteps = 12;

// One edge of this many is in the tree.
constexpr uint32_t kPerIndexed = 8;

uint32_t priorityOf(uint32_t e) {
  e = (e ^ (e >> 16)) * 0x7feb352du;
  e = (e ^ (e >> 15)) * 0x846ca68bu;
  return e ^ (e >> 16);
}

bool isIndexed(uint32_t e) { return priorityOf(e) % kPerIndexed == 0; }

}  // namespace

void EdgeOrder::reset(size_t capacity, double least, double greatest) {
  if (edges_.size() < capacity) edges_.resize(capacity);
  root_ = leftmost_ = kNone;
  size_ = 0;
  hasTree_ = takesHints(capacity);
  if (!hasTree_) return;
  least_ = least;
  columnsPerX_ = double(capacity) / (greatest - least);
  if (!(columnsPerX_ < 1e300)) columnsPerX_ = 0;
  near_.assign(capacity + 2, kNone);
}

bool EdgeOrder::find(Point2 p, uint32_t hint, uint32_t& left, uint32_t& right) const {
  if (!hasTree_) return walkRight(leftmost_, p, left, right);
  if (findFrom(hint, p, left, right) || findFrom(near_[columnOf(p.x)], p, left, right))
    return left == right && left != kNone;
  left = kNone;
  for (uint32_t e = root_; e != kNone;) {
    const bool goRight = side(e, p) <= 0;
    if (goRight) left = e;
    e = edges_[e].child[goRight];
  }
  return walkRight(left == kNone ? leftmost_ : left, p, left, right);
}

/// find, by steps along the list from e. p must not be left of e, unless e is leftmost.
bool EdgeOrder::walkRight(uint32_t e, Point2 p, uint32_t& left, uint32_t& right) const {
  left = e == kNone ? kNone : edges_[e].left;
  right = kNone;
  for (; e != kNone; e = edges_[e].right) {
    const double s = side(e, p);
    if (s > 0) {
      right = e;
      return false;
    }
    left = e;
    if (s == 0) return true;
  }
  return false;
}

/// find, by steps along the list from e; false if that is too far off. If an edge runs through p it
/// is both `left` and `right`.
bool EdgeOrder::findFrom(uint32_t e, Point2 p, uint32_t& left, uint32_t& right) const {
  if (e == kNone || edges_[e].lower == kNone) return false;
  double s = side(e, p);
  if (s == 0) {
    left = right = e;
    return true;
  }
  const bool goRight = s < 0;
  for (int steps = 0; steps < kSteps; ++steps) {
    const uint32_t next = goRight ? edges_[e].right : edges_[e].left;
    s = next == kNone ? (goRight ? 1 : -1) : side(next, p);
    if (s == 0) {
      left = right = next;
      return true;
    }
    if ((s > 0) == goRight) {
      left = goRight ? e : next, right = goRight ? next : e;
      return true;
    }
    e = next;
  }
  return false;
}

void EdgeOrder::insertAfter(uint32_t left, uint32_t e) {
  SF_ASSERT(e < edges_.size());
  ++size_;
  CrossedEdge& edge = edges_[e];
  const uint32_t right = left == kNone ? leftmost_ : edges_[left].right;
  edge.left = left, edge.right = right;
  edge.child[0] = edge.child[1] = kNone;
  (left == kNone ? leftmost_ : edges_[left].right) = e;
  if (right != kNone) edges_[right].left = e;
  if (hasTree_ && isIndexed(e)) index(e);
}

/// Puts an edge into the tree, next to the nearest tree edge on its left.
void EdgeOrder::index(uint32_t e) {
  uint32_t before = edges_[e].left;
  while (before != kNone && !isIndexed(before)) before = edges_[before].left;
  if (before != kNone && edges_[before].child[1] == kNone) {
    attach(e, before, 1);
    return;
  }
  // Its successor has no left child.
  uint32_t after = before == kNone ? root_ : edges_[before].child[1];
  while (after != kNone && edges_[after].child[0] != kNone) after = edges_[after].child[0];
  attach(e, after, 0);
}

void EdgeOrder::attach(uint32_t e, uint32_t parent, int side) {
  edges_[e].parent = parent;
  if (parent == kNone) {
    root_ = e;
    return;
  }
  edges_[parent].child[side] = e;
  const uint32_t priority = priorityOf(e);
  while (edges_[e].parent != kNone && priority > priorityOf(edges_[e].parent)) rotateUp(e);
}

void EdgeOrder::replaceChild(uint32_t parent, uint32_t old, uint32_t now) {
  if (parent == kNone)
    root_ = now;
  else
    edges_[parent].child[edges_[parent].child[1] == old] = now;
  if (now != kNone) edges_[now].parent = parent;
}

void EdgeOrder::rotateUp(uint32_t e) {
  const uint32_t p = edges_[e].parent;
  const int side = edges_[p].child[1] == e;
  const uint32_t inner = edges_[e].child[1 - side];
  replaceChild(edges_[p].parent, p, e);
  edges_[p].child[side] = inner;
  if (inner != kNone) edges_[inner].parent = p;
  edges_[e].child[1 - side] = p;
  edges_[p].parent = e;
}

void EdgeOrder::unindex(uint32_t e) {
  for (;;) {
    const uint32_t a = edges_[e].child[0], b = edges_[e].child[1];
    if (a == kNone || b == kNone) {
      replaceChild(edges_[e].parent, e, a == kNone ? b : a);
      return;
    }
    rotateUp(priorityOf(a) > priorityOf(b) ? a : b);
  }
}

void EdgeOrder::remove(uint32_t e) {
  edges_[e].lower = kNone;
  --size_;
  if (hasTree_ && isIndexed(e)) unindex(e);
  const uint32_t left = edges_[e].left, right = edges_[e].right;
  (left == kNone ? leftmost_ : edges_[left].right) = right;
  if (right != kNone) edges_[right].left = left;
}

}  // namespace sf
