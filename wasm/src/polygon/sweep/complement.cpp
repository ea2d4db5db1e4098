#include "polygon/sweep/complement.h"

#include <algorithm>
#include <cmath>

namespace sf {
namespace {

VertexKind seenFromOutside(VertexKind kind) {
  switch (kind) {
    case VertexKind::LeftBank:
      return VertexKind::RightBank;
    case VertexKind::RightBank:
      return VertexKind::LeftBank;
    case VertexKind::Bottom:
      return VertexKind::Sag;
    case VertexKind::Sag:
      return VertexKind::Bottom;
    case VertexKind::Top:
      return VertexKind::Ceiling;
    case VertexKind::Ceiling:
      return VertexKind::Top;
    default:
      return VertexKind::Unused;
  }
}

}  // namespace

void takeComplement(const LinkedPolygon& polygon, const Visibility& seen, LinkedPolygon& complement,
                    Visibility& outside) {
  const uint32_t m = uint32_t(polygon.at.size());
  complement.at = polygon.at, complement.vertex = polygon.vertex;
  complement.next = polygon.prev, complement.prev = polygon.next;
  complement.kind.resize(m);
  for (uint32_t v = 0; v < m; ++v) complement.kind[v] = seenFromOutside(polygon.kind[v]);
  const Point2 low = polygon.least, high = polygon.greatest;
  const double side =
      2 * std::max({std::fabs(low.x), std::fabs(low.y), std::fabs(high.x), std::fabs(high.y)});
  const Point2 corners[4] = {{-side, -side}, {side, -side}, {side, side}, {-side, side}};
  const VertexKind kinds[4] = {VertexKind::Bottom, VertexKind::RightBank, VertexKind::Ceiling,
                               VertexKind::LeftBank};
  // Numbered in the input's plane, so that a quarter turn takes each to the place of the next.
  const uint32_t turned = polygon.turned ? 1 : 0, lowest = m + 3 * turned;
  complement.turned = polygon.turned;
  complement.least = corners[0], complement.greatest = corners[2];
  complement.smallest = std::min(polygon.smallest, side);
  for (uint32_t k = 0; k < 4; ++k) {
    const uint32_t place = (k + turned) % 4;
    complement.at.push_back(corners[place]), complement.kind.push_back(kinds[place]);
    complement.vertex.push_back(m + k);
    complement.next.push_back(m + (k + 1) % 4), complement.prev.push_back(m + (k + 3) % 4);
  }
  complement.flat.clear();
  outside.left.resize(m + 4);
  outside.order.assign(1, lowest);
  for (const uint32_t v : seen.order) {
    if (complement.kind[v] == VertexKind::Unused) continue;
    outside.order.push_back(v);
    outside.left[v] = seen.left[v] == kNone ? lowest : seen.left[v];
  }
}

}  // namespace sf
