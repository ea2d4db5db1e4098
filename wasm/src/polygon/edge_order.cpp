#include "polygon/edge_order.h"

#include "base/assert.h"

namespace sf {
namespace {

uint32_t priorityOf(uint32_t e) {
  e = (e ^ (e >> 16)) * 0x7feb352du;
  e = (e ^ (e >> 15)) * 0x846ca68bu;
  return e ^ (e >> 16);
}

}  // namespace

void EdgeOrder::reset(size_t capacity) {
  if (edges_.size() < capacity) edges_.resize(capacity);
  free_.clear();
  used_ = 0;
  root_ = leftmost_ = kNone;
}

uint32_t EdgeOrder::insertAfter(uint32_t left) {
  uint32_t e;
  if (free_.empty()) {
    e = uint32_t(used_++);
    SF_ASSERT(e < edges_.size());
  } else {
    e = free_.back();
    free_.pop_back();
  }
  CrossedEdge& edge = edges_[e];
  const uint32_t right = left == kNone ? leftmost_ : edges_[left].right;
  edge.left = left, edge.right = right;
  edge.child[0] = edge.child[1] = kNone;
  (left == kNone ? leftmost_ : edges_[left].right) = e;
  if (right != kNone) edges_[right].left = e;
  // Of two neighbours in order, one has no child on the side of the other.
  if (left != kNone && edges_[left].child[1] == kNone)
    attach(e, left, 1);
  else
    attach(e, right, 0);
  return e;
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

void EdgeOrder::remove(uint32_t e) {
  for (;;) {
    const uint32_t a = edges_[e].child[0], b = edges_[e].child[1];
    if (a == kNone || b == kNone) {
      replaceChild(edges_[e].parent, e, a == kNone ? b : a);
      break;
    }
    rotateUp(priorityOf(a) > priorityOf(b) ? a : b);
  }
  const uint32_t left = edges_[e].left, right = edges_[e].right;
  (left == kNone ? leftmost_ : edges_[left].right) = right;
  if (right != kNone) edges_[right].left = left;
  free_.push_back(e);
}

}  // namespace sf
