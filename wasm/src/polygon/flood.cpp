#include "polygon/flood.h"

#include <cstring>

#include "base/charge.h"
#include "polygon/turn.h"

namespace sf {

bool Flood::run(const LinkedPolygon& loops, const Visibility& seen, Work& work,
                std::vector<uint32_t>& triangles, std::vector<FloodStep>* trace,
                std::vector<uint32_t>* twins) {
  Charge charge(work);
  const size_t m = loops.at.size();
  size_t bridges = 0;
  for (uint32_t v : seen.order) bridges += loops.kind[v] != VertexKind::Bottom;
  const uint64_t perNode = sizeof(Node) + (twins ? 4 * sizeof(uint32_t) : 0);
  if (!charge.add((m + 2 * bridges) * perNode)) return false;
  // They only grow: what is there needs no clearing.
  const size_t most = m + 2 * bridges;
  if (nodes_.size() < most) nodes_.resize(most);
  twins_ = nullptr;
  if (twins) {
    if (below_.size() < most) below_.resize(most);
    std::memset(below_.data(), 0xFF, most * sizeof(uint32_t));  // kNone
    bridges_.clear();
    twins->resize(3 * most);
    twins_ = twins->data();
  }
  // Every triangle takes one corner away; a bridge adds two.
  const size_t before = triangles.size();
  triangles.resize(before + 3 * most);
  out_ = outBegin_ = triangles.data() + before;
  trace_ = trace;
  const bool done = begin(loops, seen, work) && floodGorges(work);
  triangles.resize(before + nextHalf());
  if (twins) twins->resize(nextHalf());
  return done;
}

bool Flood::begin(const LinkedPolygon& loops, const Visibility& seen, Work& work) {
  const size_t m = loops.at.size();
  for (size_t v = 0; v < m; ++v)
    nodes_[v] = {loops.at[v], loops.next[v], loops.prev[v], uint32_t(v),
                 kNone,       kNone,         loops.kind[v]};
  used_ = m;
  bottoms_.clear(), pending_.clear();
  nextBottom_ = spilled_ = 0, spilledTo_ = kNone;
  for (size_t i = seen.order.size(); i-- > 0;) {
    // From the highest to the lowest, so that each comes before those above it.
    const uint32_t v = seen.order[i];
    if (nodes_[v].kind == VertexKind::Bottom) bottoms_.push_back(v);
    if (nodes_[v].kind != VertexKind::Sag && nodes_[v].kind != VertexKind::Island) continue;
    const uint32_t edge = seen.left[v];
    if (edge == kNone) return false;
    nodes_[v].jump = nodes_[edge].sag;
    nodes_[edge].sag = v;
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
  if (spilledTo_ == kNone && !pending_.empty()) {
    chain_ = pending_.back();
    pending_.pop_back();
    note(FloodAction::Start);
    return true;
  }
  uint32_t bottom = spilledTo_;
  spilledTo_ = kNone;
  while (bottom == kNone && nextBottom_ < bottoms_.size()) {
    bottom = bottoms_[bottoms_.size() - ++nextBottom_];
    if (nodes_[bottom].kind != VertexKind::Bottom) bottom = kNone;
  }
  if (bottom == kNone) return false;
  nodes_[bottom].kind = VertexKind::Unused;
  chain_ = {bottom, bottom, bottom};
  note(FloodAction::Start);
  return true;
}

/// One transition: the decision tree of fig. 9.
Flood::Step Flood::step() {
  const uint32_t nextLeft = nodes_[chain_.left].prev, nextRight = nodes_[chain_.right].next;
  const bool left = below(nodes_[nextLeft].at, nodes_[nextRight].at);
  const uint32_t next = left ? nextLeft : nextRight, end = left ? chain_.left : chain_.right;
  if (nodes_[end].kind == VertexKind::Top) {
    uint32_t& jump = nodes_[end].jump;
    if (jump == kNone) {
      spill(end, left);
      return Step::Done;
    }
    (left ? chain_.left : chain_.right) = jump;
    chain_.highest = end;
    nodes_[end].kind = VertexKind::Unused;
    --spilled_;
    note(FloodAction::Jump);
    return Step::On;
  }
  const uint32_t sag = nodes_[chain_.left].sag;
  if (sag != kNone && below(nodes_[sag].at, nodes_[next].at))
    return bridge(sag) ? Step::On : Step::Forbidden;
  if (nextLeft == nextRight) {
    fill(next);
    return Step::Done;
  }
  return (left ? raiseLeft(next) : raiseRight(next)) ? Step::On : Step::Forbidden;
}

/// Adds v to the left end of the chain, and the wedge of triangles that v sees of it.
bool Flood::raiseLeft(uint32_t v) {
  Node& apex = nodes_[v];
  if (apex.kind == VertexKind::LeftBank)
    apex.kind = VertexKind::Unused;
  else if (apex.kind != VertexKind::Top)
    return false;
  wedgeAhead(v, chain_.left, chain_.right);
  chain_.left = chain_.highest = v;
  note(FloodAction::Raise);
  return true;
}

bool Flood::raiseRight(uint32_t v) {
  Node& apex = nodes_[v];
  if (apex.kind == VertexKind::RightBank)
    apex.kind = VertexKind::Unused;
  else if (apex.kind != VertexKind::Top)
    return false;
  wedgeBehind(v, chain_.right, chain_.left);
  chain_.right = chain_.highest = v;
  note(FloodAction::Raise);
  return true;
}

/// The triangles that v sees of the chain from c on to `end`; v is linked to what they leave of it.
void Flood::wedgeAhead(uint32_t v, uint32_t c, uint32_t end) {
  const Node& apex = nodes_[v];
  while (c != end) {
    const uint32_t d = nodes_[c].next;
    if (!(turn(apex.at, nodes_[c].at, nodes_[d].at) > 0)) break;
    if (twins_) {
      const uint32_t h = nextHalf();
      pair(h, below_[v]), pair(h + 1, below_[c]);
      below_[v] = h + 2;
    }
    emit(apex, nodes_[c], nodes_[d]);
    c = d;
  }
  link(v, c);
}

/// The same for the chain from c back to `end`.
void Flood::wedgeBehind(uint32_t v, uint32_t c, uint32_t end) {
  const Node& apex = nodes_[v];
  while (c != end) {
    const uint32_t d = nodes_[c].prev;
    if (!(turn(nodes_[d].at, nodes_[c].at, apex.at) > 0)) break;
    if (twins_) {
      const uint32_t h = nextHalf();
      pair(h, below_[d]), pair(h + 1, below_[c]);
      below_[d] = h + 2;
    }
    emit(nodes_[d], nodes_[c], apex);
    c = d;
  }
  link(c, v);
}

void Flood::fill(uint32_t ceiling) {
  for (uint32_t c = chain_.left; c != chain_.right; c = nodes_[c].next) {
    if (twins_) {
      const uint32_t h = nextHalf();
      pair(h, below_[ceiling]), pair(h + 1, below_[c]);
      below_[ceiling] = h + 2;
    }
    emit(nodes_[ceiling], nodes_[c], nodes_[nodes_[c].next]);
  }
  if (twins_) pair(below_[ceiling], below_[chain_.right]);
  note(FloodAction::Fill);
}

/// Notes the twin of h, which is what lies below a link.
void Flood::pair(uint32_t h, uint32_t below) {
  if (below >= kBridge && below != kNone) {
    uint32_t& other = bridges_[below - kBridge];
    below = other;
    other = h;
  }
  twins_[h] = below;
  if (below != kNone) twins_[below] = h;
}

/// Joins the sag to the highest vertex of the chain, both ways. The gorge to the left goes on, the
/// one to the right waits.
bool Flood::bridge(uint32_t sag) {
  nodes_[chain_.left].sag = nodes_[sag].jump;
  nodes_[sag].jump = kNone;
  if (nodes_[sag].kind == VertexKind::Island) {
    bridgeIsland(sag);
    return true;
  }
  if (nodes_[sag].kind != VertexKind::Sag) return false;
  const uint32_t high = chain_.highest, afterHigh = nodes_[high].next, afterSag = nodes_[sag].next;
  // Sags are kept under nodes of left banks, which therefore stay themselves.
  const uint32_t highOnRight = copyOf(high), sagOnLeft = copyOf(sag);
  if (twins_) below_[high] = below_[sag] = newBridge();
  link(high, sagOnLeft), link(sagOnLeft, afterSag);
  link(sag, highOnRight), link(highOnRight, afterHigh);
  nodes_[sag].kind = VertexKind::LeftBank, nodes_[sagOnLeft].kind = VertexKind::RightBank;
  pending_.push_back({highOnRight, high == chain_.right ? highOnRight : chain_.right, highOnRight});
  chain_.right = chain_.highest = high;
  note(FloodAction::Bridge);
  return true;
}

/// The same for an isolated vertex, whose two gorges join at once: it becomes part of the chain,
/// with a wedge of triangles on either side.
void Flood::bridgeIsland(uint32_t sag) {
  const uint32_t high = chain_.highest, afterHigh = nodes_[high].next;
  const uint32_t highOnRight = copyOf(high);
  if (twins_) below_[high] = below_[sag] = newBridge();
  if (high == chain_.right) chain_.right = highOnRight;
  link(highOnRight, afterHigh);
  nodes_[sag].kind = VertexKind::Unused;
  wedgeBehind(sag, high, chain_.left);
  wedgeAhead(sag, highOnRight, chain_.right);
  chain_.highest = sag;
  note(FloodAction::Bridge);
}

/// Leaves this side of a top waiting for the other one, and looks for the bottom of that.
void Flood::spill(uint32_t top, bool left) {
  nodes_[top].jump = left ? chain_.right : chain_.left;
  ++spilled_;
  const VertexKind bank = left ? VertexKind::RightBank : VertexKind::LeftBank;
  uint32_t v = top;
  do v = left ? nodes_[v].prev : nodes_[v].next;
  while (nodes_[v].kind == bank);
  if (nodes_[v].kind == VertexKind::Bottom) spilledTo_ = v;
  note(FloodAction::Spill);
}

/// What lies below both sides of a bridge.
uint32_t Flood::newBridge() {
  bridges_.push_back(kNone);
  return kBridge + uint32_t(bridges_.size()) - 1;
}

uint32_t Flood::copyOf(uint32_t v) {
  const uint32_t copy = uint32_t(used_++);
  nodes_[copy] = nodes_[v];
  nodes_[copy].sag = nodes_[copy].jump = kNone;
  if (twins_) below_[copy] = below_[v];
  return copy;
}

void Flood::note(FloodAction action) {
  if (!trace_) return;
  trace_->push_back(
      {uint32_t(action), nodes_[chain_.left].node, nodes_[chain_.right].node, nextHalf() / 3});
}

}  // namespace sf
