#include "polygon/fill/flood.h"

#include "base/turn.h"

namespace sf {
namespace {

// The largest number of half-edges and their far sides. It leaves as many numbers again below 2^32
// for edges to be closed.
constexpr uint64_t kMostHalves = (uint64_t(1) << 31) - 8;

}  // namespace

bool Flood::run(const LinkedPolygon& loops, const Visibility& seen, Work& work, Charge& kept,
                std::vector<FloodStep>* trace, bool paired) {
  out_ = corners_.data();
  uint32_t bridges = 0;
  for (uint32_t v : seen.order) bridges += loops.kind[v] != VertexKind::Bottom;
  // Every triangle takes one corner away; a bridge adds two.
  const uint64_t most = loops.at.size() + 2 * uint64_t(bridges);
  if (3 * most + 2 * uint64_t(bridges) + 4 > kMostHalves) {
    work.fail(Status::TooLarge);
    return false;
  }
  Charge charge(work);
  const uint64_t perNode = sizeof(Node) + 2 * sizeof(void*);
  if (!charge.add(most * perNode + uint64_t(bridges) * 2 * sizeof(Chain)) ||
      !kept.add(most * (paired ? 7 : 3) * sizeof(uint32_t)))
    return false;
  // Buffers only grow: what they hold needs no clearing.
  if (nodes_.size() < most) nodes_.resize(most);
  if (corners_.size() < 3 * most) corners_.resize(3 * most);
  out_ = corners_.data();
  if (paired) twins_.reset(uint32_t(3 * most), bridges);
  paired_ = paired, trace_ = trace;
  error_ = errorOfTurns(loops.least, loops.greatest);
  return begin(loops, seen, work) && floodGorges(work);
}

bool Flood::begin(const LinkedPolygon& loops, const Visibility& seen, Work& work) {
  const size_t m = loops.at.size();
  Node* const nodes = nodes_.data();
  for (size_t v = 0; v < m; ++v)
    nodes[v] = {loops.at[v], nodes + loops.next[v], nodes + loops.prev[v],
                uint32_t(v), twins_.outside,        nullptr,
                nullptr,     loops.kind[v]};
  unused_ = nodes + m;
  bottoms_.clear(), pending_.clear();
  nextBottom_ = spilled_ = 0, spilledTo_ = nullptr;
  for (size_t i = seen.order.size(); i-- > 0;) {
    // From the highest to the lowest, so that each comes before those above it.
    Node* const v = nodes + seen.order[i];
    if (v->kind == VertexKind::Bottom) bottoms_.push_back(v);
    if (v->kind != VertexKind::Sag && v->kind != VertexKind::Island) continue;
    const uint32_t edge = seen.left[seen.order[i]];
    if (edge == kNone) return false;
    v->jump = nodes[edge].sag;
    nodes[edge].sag = v;
  }
  return work.tick(uint32_t(m < (1u << 26) ? m * 4 : 1u << 28));
}

bool Flood::floodGorges(Work& work) {
  uint32_t steps = 0;
  while (start()) {
    for (Step now = Step::On; now == Step::On;) {
      now = step();
      if (now == Step::Forbidden) return false;
      if (++steps % 1024 == 0 && !work.tick(30 * 1024)) return false;
    }
  }
  return spilled_ == 0;
}

/// The next gorge: the one that was spilled into, else the last that a bridge has cut off, else
/// that of the lowest bottom.
bool Flood::start() {
  if (!spilledTo_ && !pending_.empty()) {
    chain_ = pending_.back();
    pending_.pop_back();
    note(FloodAction::Start);
    return true;
  }
  Node* bottom = spilledTo_;
  spilledTo_ = nullptr;
  while (!bottom && nextBottom_ < bottoms_.size()) {
    bottom = bottoms_[bottoms_.size() - ++nextBottom_];
    if (bottom->kind != VertexKind::Bottom) bottom = nullptr;
  }
  if (!bottom) return false;
  bottom->kind = VertexKind::Unused;
  chain_ = {bottom, bottom, bottom};
  note(FloodAction::Start);
  return true;
}

/// One transition: the decision tree of fig. 9.
Flood::Step Flood::step() {
  Node *const nextLeft = chain_.left->prev, *const nextRight = chain_.right->next;
  const bool left = below(nextLeft->at, nextRight->at);
  Node *const next = left ? nextLeft : nextRight, *const end = left ? chain_.left : chain_.right;
  if (end->kind == VertexKind::Top) {
    Node* const jump = end->jump;
    if (!jump) {
      spill(end, left);
      return Step::Done;
    }
    (left ? chain_.left : chain_.right) = jump;
    chain_.highest = end;
    end->kind = VertexKind::Unused;
    --spilled_;
    note(FloodAction::Jump);
    return Step::On;
  }
  Node* const sag = chain_.left->sag;
  if (sag && below(sag->at, next->at)) return bridge(sag) ? Step::On : Step::Forbidden;
  if (nextLeft == nextRight) {
    fill(next);
    return Step::Done;
  }
  return (left ? raiseLeft(next) : raiseRight(next)) ? Step::On : Step::Forbidden;
}

/// Adds v to the left end of the chain, and makes the wedge of triangles that v sees there.
bool Flood::raiseLeft(Node* v) {
  if (v->kind == VertexKind::LeftBank)
    v->kind = VertexKind::Unused;
  else if (v->kind != VertexKind::Top)
    return false;
  wedgeAhead(v, chain_.left, chain_.right);
  chain_.left = chain_.highest = v;
  note(FloodAction::Raise);
  return true;
}

bool Flood::raiseRight(Node* v) {
  if (v->kind == VertexKind::RightBank)
    v->kind = VertexKind::Unused;
  else if (v->kind != VertexKind::Top)
    return false;
  wedgeBehind(v, chain_.right, chain_.left);
  chain_.right = chain_.highest = v;
  note(FloodAction::Raise);
  return true;
}

/// Makes the triangles that v sees along the chain from c to `end`, and links v to the rest of it.
void Flood::wedgeAhead(Node* v, Node* c, Node* end) {
  while (c != end) {
    Node* const d = c->next;
    if (!(turn(v->at, c->at, d->at, error_) > 0)) break;
    if (paired_) {
      const uint32_t h = nextHalf();
      twins_.pair(h, c->below), twins_.pair(h + 2, v->below);
      v->below = h + 1;
    }
    emit(v, c, d);
    c = d;
  }
  link(v, c);
}

/// The same for the chain from c back to `end`.
void Flood::wedgeBehind(Node* v, Node* c, Node* end) {
  while (c != end) {
    Node* const d = c->prev;
    if (!(turn(d->at, c->at, v->at, error_) > 0)) break;
    if (paired_) {
      const uint32_t h = nextHalf();
      twins_.pair(h, d->below), twins_.pair(h + 1, c->below);
      d->below = h + 2;
    }
    emit(v, d, c);
    c = d;
  }
  link(c, v);
}

void Flood::fill(Node* ceiling) {
  for (Node* c = chain_.left; c != chain_.right; c = c->next) {
    if (paired_) {
      const uint32_t h = nextHalf();
      twins_.pair(h, c->below), twins_.pair(h + 2, ceiling->below);
      ceiling->below = h + 1;
    }
    emit(ceiling, c, c->next);
  }
  if (paired_) twins_.pair(ceiling->below, chain_.right->below);
  note(FloodAction::Fill);
}

/// Joins the sag to the highest vertex of the chain, both ways. The gorge to the left goes on, the
/// one to the right waits.
bool Flood::bridge(Node* sag) {
  chain_.left->sag = sag->jump;
  sag->jump = nullptr;
  if (sag->kind == VertexKind::Island) {
    bridgeIsland(sag);
    return true;
  }
  if (sag->kind != VertexKind::Sag) return false;
  Node *const high = chain_.highest, *const afterHigh = high->next, *const afterSag = sag->next;
  // Sags are kept under nodes of left banks, so these nodes stay, and the others are copied.
  Node *const highOnRight = copyOf(*high), *const sagOnLeft = copyOf(*sag);
  if (paired_) high->below = twins_.addClosed(), sag->below = high->below + 1;
  link(high, sagOnLeft), link(sagOnLeft, afterSag);
  link(sag, highOnRight), link(highOnRight, afterHigh);
  sag->kind = VertexKind::LeftBank, sagOnLeft->kind = VertexKind::RightBank;
  pending_.push_back({highOnRight, high == chain_.right ? highOnRight : chain_.right, highOnRight});
  chain_.right = chain_.highest = high;
  note(FloodAction::Bridge);
  return true;
}

/// The same for an isolated vertex, whose two gorges join at once: it becomes part of the chain,
/// with a wedge of triangles on either side.
void Flood::bridgeIsland(Node* sag) {
  Node *const high = chain_.highest, *const afterHigh = high->next;
  Node* const highOnRight = copyOf(*high);
  if (paired_) high->below = twins_.addClosed(), sag->below = high->below + 1;
  if (high == chain_.right) chain_.right = highOnRight;
  link(highOnRight, afterHigh);
  sag->kind = VertexKind::Unused;
  wedgeBehind(sag, high, chain_.left);
  wedgeAhead(sag, highOnRight, chain_.right);
  chain_.highest = sag;
  note(FloodAction::Bridge);
}

/// Lets this side of a top wait for the other one, and looks for the bottom of that.
void Flood::spill(Node* top, bool left) {
  top->jump = left ? chain_.right : chain_.left;
  ++spilled_;
  const VertexKind bank = left ? VertexKind::RightBank : VertexKind::LeftBank;
  Node* v = top;
  do v = left ? v->prev : v->next;
  while (v->kind == bank);
  if (v->kind == VertexKind::Bottom) spilledTo_ = v;
  note(FloodAction::Spill);
}

Flood::Node* Flood::copyOf(const Node& v) {
  *unused_ = v;
  unused_->sag = unused_->jump = nullptr;
  return unused_++;
}

void Flood::append(FloodAction action) {
  trace_->push_back({uint32_t(action), chain_.left->node, chain_.right->node, nextHalf() / 3});
}

}  // namespace sf
