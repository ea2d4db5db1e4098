#include "polygon/input/fault_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sf {
namespace {

struct Edge {
  Point2 from, to;
};

/// The edge from a vertex to the next one that lies elsewhere.
Edge edgeAt(const PolygonView& polygon, uint32_t ring, uint32_t vertex) {
  const uint32_t first = polygon.starts[ring], count = polygon.starts[ring + 1] - first;
  const auto at = [&](uint32_t v) {
    const size_t i = 2 * (size_t(first) + v % count);
    return Point2{polygon.positions[i], polygon.positions[i + 1]};
  };
  const Point2 from = at(vertex);
  for (uint32_t step = 1; step < count; ++step)
    if (!(at(vertex + step) == from)) return {from, at(vertex + step)};
  return {from, from};
}

bool isInBox(Point2 p, const Edge& e) {
  const auto between = [](double a, double b, double c) {
    return std::min(a, c) <= b && b <= std::max(a, c);
  };
  return between(e.from.x, p.x, e.to.x) && between(e.from.y, p.y, e.to.y);
}

/// Differences are halved, so that none overflows.
Point2 meetingPoint(const Edge& a, const Edge& b) {
  const double ux = a.to.x / 2 - a.from.x / 2, uy = a.to.y / 2 - a.from.y / 2;
  const double vx = b.to.x / 2 - b.from.x / 2, vy = b.to.y / 2 - b.from.y / 2;
  const double wx = b.from.x / 2 - a.from.x / 2, wy = b.from.y / 2 - a.from.y / 2;
  const double size = std::max({std::fabs(ux), std::fabs(uy), std::fabs(vx), std::fabs(vy)});
  // Divided by their size, so that no product overflows or vanishes.
  const double across = (ux / size) * (vy / size) - (uy / size) * (vx / size);
  const double along = (wx / size) * (vy / size) - (wy / size) * (vx / size);
  const double t = along / across;
  if (std::fabs(across) > 1e-12 && t >= 0 && t <= 1)
    return {a.from.x + 2 * t * ux, a.from.y + 2 * t * uy};
  // Nearly parallel: an end of one that lies along the other.
  for (const Point2 p : {b.from, b.to})
    if (isInBox(p, a)) return p;
  for (const Point2 p : {a.from, a.to})
    if (isInBox(p, b)) return p;
  return b.from;
}

}  // namespace

Point2 faultPoint(const PolygonView& polygon, const Outcome& outcome) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const uint32_t rings = uint32_t(polygon.starts.size()) - 1;
  if (outcome.status == Status::NotFinite || outcome.loop == kNone) return {nan, nan};
  if (outcome.loop >= rings) {
    const size_t i = 2 * size_t(outcome.loop - rings);
    return {polygon.points[i], polygon.points[i + 1]};
  }
  if (polygon.starts[outcome.loop] == polygon.starts[outcome.loop + 1]) return {nan, nan};
  const Edge edge = edgeAt(polygon, outcome.loop, outcome.vertex == kNone ? 0 : outcome.vertex);
  if (outcome.otherVertex == kNone) return edge.from;
  return meetingPoint(edge, edgeAt(polygon, outcome.otherLoop, outcome.otherVertex));
}

}  // namespace sf
