#include "mesh/touch.h"

#include "base/sort.h"

namespace sf {
namespace {

using Edge = std::pair<uint32_t, uint32_t>;

/// The edge that a rim goes on to at its end, of rims of the group alone.
uint32_t goesOnTo(const Rims& rims, const std::vector<uint32_t>& sorted, uint32_t edge) {
  for (uint32_t before = edge;;) {
    const auto touch = std::lower_bound(rims.touches.begin(), rims.touches.end(), before,
                                        [](const RimTouch& t, uint32_t e) { return t.before < e; });
    const uint32_t rim = rims.rimOf(before);
    if (touch == rims.touches.end() || touch->before != before) return rims.nextEdge(rim, before);
    const uint32_t other = rims.rimOf(touch->after);
    if (std::binary_search(sorted.begin(), sorted.end(), other)) return touch->after;
    // Past a rim of another hole: on from where that comes to the vertex.
    before = touch->after == rims.starts[other] ? rims.starts[other + 1] - 1 : touch->after - 1;
  }
}

}  // namespace

RimLoops loopsAround(const Rims& rims, ArrayView<const uint32_t> group) {
  std::vector<uint32_t> sorted(group.begin(), group.end());
  sf::sort(sorted.begin(), sorted.end());
  std::vector<size_t> firsts{0};  // of each rim, in `isDone`
  for (const uint32_t r : sorted)
    firsts.push_back(firsts.back() + rims.starts[r + 1] - rims.starts[r]);
  std::vector<uint8_t> isDone(firsts.back());
  const auto done = [&](uint32_t e) -> uint8_t& {
    const uint32_t r = rims.rimOf(e);
    const auto place = std::lower_bound(sorted.begin(), sorted.end(), r) - sorted.begin();
    return isDone[firsts[size_t(place)] + e - rims.starts[r]];
  };
  RimLoops loops{{}, {0}};
  for (const uint32_t r : group)
    for (uint32_t first = rims.starts[r]; first < rims.starts[r + 1]; ++first) {
      if (done(first)) continue;
      for (uint32_t e = first; !done(e); e = goesOnTo(rims, sorted, e)) {
        done(e) = 1;
        loops.edges.push_back(e);
      }
      loops.starts.push_back(uint32_t(loops.edges.size()));
    }
  return loops;
}

bool isFan(const std::vector<uint32_t>& triangles, uint32_t vertex) {
  std::vector<Edge> opposite;
  for (size_t t = 0; t < triangles.size(); t += 3)
    for (int k = 0; k < 3; ++k)
      if (triangles[t + k] == vertex)
        opposite.emplace_back(triangles[t + (k + 1) % 3], triangles[t + (k + 2) % 3]);
  sf::sort(opposite.begin(), opposite.end());
  if (opposite.empty()) return false;
  size_t steps = 0;
  uint32_t at = opposite[0].first;
  do {
    const auto next = std::lower_bound(opposite.begin(), opposite.end(), Edge(at, 0));
    if (next == opposite.end() || next->first != at) return false;
    at = next->second, ++steps;
  } while (at != opposite[0].first && steps <= opposite.size());
  return steps == opposite.size();
}

bool hasSimpleEdges(ArrayView<const uint32_t> triangles) {
  std::vector<Edge> edges;
  for (size_t t = 0; t < triangles.size(); t += 3)
    for (int k = 0; k < 3; ++k) {
      edges.emplace_back(triangles[t + k], triangles[t + (k + 1) % 3]);
      if (edges.back().first == edges.back().second) return false;
    }
  sf::sort(edges.begin(), edges.end());
  return std::adjacent_find(edges.begin(), edges.end()) == edges.end();
}

}  // namespace sf
