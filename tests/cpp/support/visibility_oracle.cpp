#include "support/visibility_oracle.h"

#include <algorithm>
#include <cmath>

#include "base/predicates.h"

namespace sftest {

using namespace sf;

namespace {

int orient(const LinkedPolygon& p, uint32_t a, uint32_t b, uint32_t c) {
  return orient2d(p.at[a].x, p.at[a].y, p.at[b].x, p.at[b].y, p.at[c].x, p.at[c].y);
}

struct Edge {
  uint32_t low, high, name;
};

// Whether of two edges that cross the line through some node, a is to the right of b.
bool isRightOf(const LinkedPolygon& p, const Edge& a, const Edge& b) {
  if (a.low == b.low) return orient(p, b.low, b.high, a.high) < 0;
  if (below(p.at[b.low], p.at[a.low])) return orient(p, b.low, b.high, a.low) < 0;
  return orient(p, a.low, a.high, b.low) > 0;
}

VertexKind kindOf(const LinkedPolygon& p, uint32_t v) {
  const uint32_t a = p.prev[v], b = p.next[v];
  if (a == v) return VertexKind::Island;
  const bool up = below(p.at[v], p.at[a]), on = below(p.at[v], p.at[b]);
  const bool convex = orient(p, a, v, b) > 0;
  if (up && on) return convex ? VertexKind::Bottom : VertexKind::Sag;
  if (!up && !on) return convex ? VertexKind::Ceiling : VertexKind::Top;
  return up ? VertexKind::LeftBank : VertexKind::RightBank;
}

void addRing(LinkedPolygon& p, uint32_t first, uint32_t last, bool hole) {
  double area = 0;  // rings here are fat enough for a rounded sum
  for (uint32_t v = first; v < last; ++v) {
    const Point2 a = p.at[v], b = p.at[v + 1 == last ? first : v + 1], o = p.at[first];
    area += (a.x - o.x) * (b.y - o.y) - (b.x - o.x) * (a.y - o.y);
  }
  const bool turned = (area < 0) != hole;
  for (uint32_t v = first; v < last; ++v) {
    const uint32_t after = v + 1 == last ? first : v + 1, before = v == first ? last - 1 : v - 1;
    p.next[v] = turned ? before : after;
    p.prev[v] = turned ? after : before;
  }
}

}  // namespace

Sight lookAround(const Polygon& polygon, const std::vector<Point>& islands) {
  Sight sight;
  LinkedPolygon& p = sight.linked;
  const uint32_t n = polygon.vertexCount(), m = n + uint32_t(islands.size());
  for (uint32_t v = 0; v < n; ++v) p.at.push_back({polygon.point(v).x, polygon.point(v).y});
  for (const Point q : islands) p.at.push_back({q.x, q.y});
  p.least = p.greatest = p.at[0], p.smallest = HUGE_VAL;
  for (const Point2 q : p.at) {
    p.least = {std::min(p.least.x, q.x), std::min(p.least.y, q.y)};
    p.greatest = {std::max(p.greatest.x, q.x), std::max(p.greatest.y, q.y)};
    for (const double x : {std::fabs(q.x), std::fabs(q.y)})
      if (x > 0) p.smallest = std::min(p.smallest, x);
  }
  p.next.resize(m), p.prev.resize(m), p.kind.resize(m), p.vertex.resize(m);
  for (uint32_t v = 0; v < m; ++v) p.vertex[v] = p.next[v] = p.prev[v] = v;
  for (uint32_t r = 0; r < polygon.ringCount(); ++r)
    addRing(p, polygon.starts[r], polygon.starts[r + 1], r > 0);
  for (uint32_t v = 0; v < m; ++v) p.kind[v] = kindOf(p, v);

  Visibility& seen = sight.seen;
  for (uint32_t v = 0; v < m; ++v) seen.order.push_back(v);
  std::sort(seen.order.begin(), seen.order.end(),
            [&](uint32_t a, uint32_t b) { return below(p.at[a], p.at[b]); });
  seen.left.assign(m, kNone), seen.right.assign(m, kNone);
  for (uint32_t v = 0; v < m; ++v) {
    const VertexKind kind = p.kind[v];
    const bool both =
        kind == VertexKind::Sag || kind == VertexKind::Top || kind == VertexKind::Island;
    const bool toLeft = both || kind == VertexKind::RightBank;
    const bool toRight = both || kind == VertexKind::LeftBank;
    Edge left{kNone, kNone, kNone}, right = left;
    for (uint32_t u = 0; u < n; ++u) {
      Edge e{u, p.next[u], u};
      if (below(p.at[e.high], p.at[e.low])) e = {p.next[u], u, p.next[u]};
      if (!below(p.at[e.low], p.at[v]) || !below(p.at[v], p.at[e.high])) continue;
      const bool isLeft = orient(p, e.low, e.high, v) < 0;
      if (isLeft && (left.low == kNone || isRightOf(p, e, left))) left = e;
      if (!isLeft && (right.low == kNone || isRightOf(p, right, e))) right = e;
    }
    if (toLeft) seen.left[v] = left.name;
    if (toRight) seen.right[v] = right.name;
  }
  return sight;
}

}  // namespace sftest
