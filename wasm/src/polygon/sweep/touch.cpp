// The sweep at points where loops touch: several nodes at one place, or a node on an edge.
#include <algorithm>

#include "polygon/sweep/sweep_state.h"

namespace sf {

using State = SweepState;

uint32_t State::newNode(uint32_t vertex, Point2 at) {
  const uint32_t v = uint32_t(loops->at.size());
  loops->at.push_back(at);
  loops->vertex.push_back(vertex);
  loops->next.push_back(kNone), loops->prev.push_back(kNone);
  loops->kind.push_back(VertexKind::Unused);
  seen->left.push_back(kNone);
  if (!sagsOnly) seen->right.push_back(kNone);
  return v;
}

/// Passes all nodes at one point at once: finds the edges that end there or run through, divides
/// the latter, and links the corners of the polygon anew. False after a crossing.
bool State::passTouch(size_t i, size_t count) {
  const Point2 at = events[i].at;
  isPlain = false;
  for (size_t k = 0; k < count; ++k)
    if (loops->kind[events[i + k].node] == VertexKind::Island) {
      misplaced = {};  // reported first: nothing else is at an isolated point's place
      misplace(events[i + k].node, kNone);
      outcome = misplaced;
      return false;
    }
  uint32_t first = kNone, last = kNone, left = kNone;
  if (!findBlock(i, count, first, last, left)) return false;
  const uint32_t vertex = loops->vertex[events[i].node];
  for (uint32_t e = first; e != kNone; e = e == last ? kNone : edges[e].right)
    if (!(edges[e].hi == at)) divide(e, vertex, at);
  if (!collect(i, count, first, last, at)) return false;
  const uint32_t right =
      last == kNone ? (left == kNone ? edges.leftmost() : edges[left].right) : edges[last].right;
  if (alternates(left)) {
    if (misplaced.ok()) relink(left, right);
  } else if (!strandsPart()) {
    return false;
  }
  replaceBlock(left);
  return true;
}

/// The edges that end at the point or pass through it, which have to be consecutive. `left` is the
/// one before them. `first` and `last` are kNone if there are none.
bool State::findBlock(size_t i, size_t count, uint32_t& first, uint32_t& last, uint32_t& left) {
  const Point2 at = events[i].at;
  size_t ends = 0;
  uint32_t any = kNone;
  for (size_t k = 0; k < count; ++k) {
    const uint32_t v = events[i + k].node;
    const VertexKind kind = loops->kind[v];
    const bool up = kind == VertexKind::RightBank || kind == VertexKind::Ceiling;
    const bool down = kind == VertexKind::LeftBank || kind == VertexKind::Ceiling;
    ends += size_t(up) + size_t(down);
    if (up || down) any = events[i + k].edge;
  }
  if (any == kNone) {
    uint32_t right;
    if (edges.find(at, kNone, left, right)) any = left;
    if (any == kNone) return true;
  }
  const auto through = [&](uint32_t e) { return edges[e].hi == at || side(e, at) == 0; };
  first = last = any;
  while (edges[first].left != kNone && through(edges[first].left)) first = edges[first].left;
  while (edges[last].right != kNone && through(edges[last].right)) last = edges[last].right;
  left = edges[first].left;
  const uint32_t right = edges[last].right;
  for (uint32_t e = first;; e = edges[e].right) {
    ends -= edges[e].hi == at;
    if (e == last) break;
  }
  if (ends != 0 || (left != kNone && side(left, at) > 0) || (right != kNone && side(right, at) < 0))
    return reportDisorder(at);
  return true;
}

/// Reports two neighbours in the order that have changed places below the point.
bool State::reportDisorder(Point2 at) {
  double before = -1;
  uint32_t previous = kNone;
  for (uint32_t e = edges.leftmost(); e != kNone; e = edges[e].right) {
    const double s = edges[e].hi == at ? 0 : side(e, at);
    if (previous != kNone && (s > 0 ? 1 : s < 0 ? -1 : 0) < before)
      return crossing(edges[previous].input, edges[e].input);
    previous = e, before = s > 0 ? 1 : s < 0 ? -1 : 0;
  }
  SF_ASSERT(false);
  return crossing(events[0].node, events[0].node);
}

/// Divides the link of edge e at a point on it, by a node for `vertex`.
void State::divide(uint32_t e, uint32_t vertex, Point2 at) {
  const uint32_t t = newNode(vertex, at);
  CrossedEdge& edge = edges[e];
  const uint32_t lower = edge.lower, upper = edge.upper;
  const uint32_t from = edge.down ? upper : lower, to = edge.down ? lower : upper;
  loops->flat.insert(loops->flat.end(), {loops->vertex[from], loops->vertex[to], vertex});
  loops->next[from] = t, loops->prev[t] = from;
  loops->next[t] = to, loops->prev[to] = t;
  loops->kind[t] = edge.down ? VertexKind::LeftBank : VertexKind::RightBank;
}

/// Lists the half-edges at the point from left to right, those below it and those above. False if
/// two of those above have one direction.
bool State::collect(size_t i, size_t count, uint32_t first, uint32_t last, Point2 at) {
  lower.clear(), upper.clear();
  const auto addUpper = [&](uint32_t v, uint32_t e, uint32_t inputIn, uint32_t inputOut) {
    const uint32_t prev = loops->prev[v], next = loops->next[v];
    const bool in = below(at, loops->at[prev]), out = below(at, loops->at[next]);
    if (in) upper.push_back({v, prev, loops->at[prev], out ? e ^ 1 : e, inputIn, true});
    if (out) upper.push_back({v, next, loops->at[next], e, inputOut, false});
  };
  for (size_t k = 0; k < count; ++k) {
    const uint32_t v = events[i + k].node;
    addUpper(v, events[i + k].edge, loops->prev[v], v);
  }
  for (uint32_t e = first; e != kNone; e = e == last ? kNone : edges[e].right) {
    const CrossedEdge& edge = edges[e];
    const bool divided = !(edge.hi == at);
    const uint32_t v = !divided    ? edge.upper
                       : edge.down ? loops->prev[edge.lower]
                                   : loops->next[edge.lower];
    lower.push_back({v, edge.lower, edge.lo, e, edge.input, bool(edge.down)});
    if (divided) addUpper(v, e, edge.input, edge.input);
  }
  std::sort(upper.begin(), upper.end(),
            [&](const HalfEdge& a, const HalfEdge& b) { return turn(at, a.to, b.to) < 0; });
  for (size_t k = 1; k < upper.size(); ++k) {
    const HalfEdge &a = upper[k - 1], &b = upper[k];
    if (turn(at, a.to, b.to) != 0) continue;
    return crossing(a.input, b.input);  // findSpike reports spikes at the end
  }
  return true;
}

/// Whether the loops that pass the point only touch there: in circular order, the two half-edges of
/// one enclose both or none of another's.
bool State::strandsPart() {
  strands.clear();
  const size_t k = lower.size(), total = k + upper.size();
  const auto at = [&](size_t i) -> const HalfEdge& {
    return i < k ? lower[i] : upper[total - 1 - i];  // counter-clockwise
  };
  for (uint32_t i = 0; i < total; ++i) {
    const HalfEdge& half = at(i);
    if (!strands.empty() && at(strands.back()).node == half.node) {
      strands.pop_back();
      continue;
    }
    strands.push_back(i);
  }
  if (strands.empty()) return true;
  // What is left crosses: the innermost pair that closes around others which stay open.
  for (size_t j = 1; j < strands.size(); ++j)
    for (size_t i = 0; i < j; ++i)
      if (at(strands[i]).node == at(strands[j]).node)
        return crossing(at(strands[j]).input, at(strands[j - 1]).input);
  SF_ASSERT(false);
  return true;
}

/// Whether edges that lead down and up alternate at the point, as they do where the winding number
/// is 0 and 1 by turns. Loops may change sides at the point as long as that is so.
bool State::alternates(uint32_t left) {
  if (!misplaced.ok()) {  // nothing is known then of what lies below
    for (size_t k = 1; k < lower.size(); ++k)
      if (lower[k].down == lower[k - 1].down) return false;
  }
  if (upper.empty()) return true;
  bool down = !lower.empty() ? lower[0].down : misplaced.ok() ? !isInside(left) : upper[0].down;
  for (size_t k = 0; k < upper.size(); ++k, down = !down)
    if (upper[k].down != down) {
      const uint32_t before = k > 0           ? upper[k - 1].input
                              : lower.empty() ? inputOf(left)
                                              : lower[0].input;
      misplace(upper[k].input, before);
      return false;
    }
  return true;
}

/// Makes a node of each corner of the polygon at the point; `left` and `right` are the edges beside
/// the point. Source: Ronfard, Rossignac 1994, sec. 1: at non-manifold vertices the next edge is
/// the first one clockwise.
void State::relink(uint32_t left, uint32_t right) {
  const bool insideLeft = lower.empty() ? isInside(left) : !lower[0].down;
  const bool insideRight = lower.empty()   ? insideLeft
                           : upper.empty() ? lower.back().down
                                           : upper.back().down;
  HalfEdge *l = lower.data(), *lEnd = l + lower.size(), *u = upper.data(), *uEnd = u + upper.size();
  if (insideLeft && insideRight && l == lEnd) {
    corner(VertexKind::Sag, *--uEnd, *u, left, right), ++u;
  } else if (insideLeft && insideRight && u == uEnd) {
    --lEnd, corner(VertexKind::Top, *l, *lEnd, left, right), ++l;
  } else {
    if (insideLeft) corner(VertexKind::RightBank, *l, *u, left, kNone), ++l, ++u;
    if (insideRight) --lEnd, --uEnd, corner(VertexKind::LeftBank, *uEnd, *lEnd, kNone, right);
  }
  for (; l != lEnd; l += 2) corner(VertexKind::Ceiling, l[1], l[0], kNone, kNone);
  for (; u != uEnd; u += 2) corner(VertexKind::Bottom, u[0], u[1], kNone, kNone);
}

/// The corner from link `in` to link `out`; its node is that of `in`.
void State::corner(VertexKind kind, const HalfEdge& in, HalfEdge& out, uint32_t left,
                   uint32_t right) {
  const uint32_t v = in.node;
  out.node = v;
  loops->next[v] = out.other, loops->prev[out.other] = v;
  loops->kind[v] = kind;
  if (!sagsOnly || kind == VertexKind::Sag || kind == VertexKind::Bottom) see(v, left, right);
}

/// Puts the half-edges above the point in the places of those below it.
void State::replaceBlock(uint32_t left) {
  for (const HalfEdge& half : lower) edges.remove(half.edge);
  for (const HalfEdge& half : upper) {
    edges.insertAfter(left, half.edge);
    set(half.edge, half.node, half.other, half.input, half.down);
    left = half.edge;
  }
}

}  // namespace sf
