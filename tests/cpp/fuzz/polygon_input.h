// Polygons out of bytes, small, degenerate and malformed ones of every kind, and what has to hold of
// all results.
#pragma once
#include <algorithm>
#include <utility>
#include <vector>

#include "fuzz/bytes.h"
#include "polygon/triangulate.h"

namespace sffuzz {

/// Mostly on a small grid, where coincidences are common; also what is a unit in the last place or
/// hundreds of orders of magnitude off it, and now and then any double at all.
inline double coordinate(Bytes& in) {
  const uint8_t b = in.byte();
  const double onGrid = double(b % 16) - 7;
  if (b == 255) return in.raw();
  if (b >= 248) return std::ldexp(onGrid, int(in.byte()) * 4 - 512);
  if (b >= 240) return std::nextafter(double(b % 4), in.byte() % 2 ? 100 : -100);
  return onGrid;
}

struct PolygonInput {
  std::vector<double> positions, points;
  std::vector<uint32_t> starts;
  sf::PolygonView view() const { return {positions, starts, points}; }
  size_t vertices() const { return (positions.size() + points.size()) / 2; }
};

inline PolygonInput readPolygon(Bytes& in) {
  PolygonInput result;
  result.starts = {in.below(64) == 63 ? 1u : 0u};
  const uint32_t rings = in.below(5);
  for (uint32_t c = 0; c < rings; ++c) result.starts.push_back(result.starts.back() + in.below(14));
  const uint32_t n = *std::max_element(result.starts.begin(), result.starts.end());
  if (in.below(32) == 31 && rings > 1) std::swap(result.starts[1], result.starts[rings]);
  const uint32_t points = in.below(4) == 0 ? in.below(5) : 0;
  for (uint32_t i = 0; i < 2 * n; ++i) result.positions.push_back(coordinate(in));
  for (uint32_t i = 0; i < 2 * points; ++i) result.points.push_back(coordinate(in));
  return result;
}

inline bool equal(const sf::Outcome& a, const sf::Outcome& b) {
  return a.status == b.status && a.loop == b.loop && a.vertex == b.vertex &&
         a.otherLoop == b.otherLoop && a.otherVertex == b.otherVertex;
}

/// Culprits have to be vertices of the polygon.
inline void checkPlace(const sf::Outcome& o, const sf::PolygonView& view) {
  const size_t rings = view.starts.size() - 1, points = view.points.size() / 2;
  const auto isPlace = [&](uint32_t loop, uint32_t vertex) {
    if (loop == sf::kNone) return vertex == sf::kNone;
    if (loop >= rings) return loop < rings + points && (vertex == sf::kNone || vertex == 0);
    return vertex == sf::kNone || vertex < view.starts[loop + 1] - view.starts[loop];
  };
  require(isPlace(o.loop, o.vertex) && isPlace(o.otherLoop, o.otherVertex), "culprits that exist");
}

inline void checkTriangles(sf::ArrayView<const uint32_t> triangles, size_t n) {
  require(triangles.size() % 3 == 0, "whole triangles");
  for (size_t i = 0; i < triangles.size(); i += 3) {
    const uint32_t a = triangles[i], b = triangles[i + 1], c = triangles[i + 2];
    require(a < n && b < n && c < n, "indices in range");
    require(a != b && b != c && c != a, "three vertices");
  }
}

/// Triangles with the least corner first, in order.
inline std::vector<std::vector<uint32_t>> sorted(sf::ArrayView<const uint32_t> list) {
  std::vector<std::vector<uint32_t>> result;
  for (size_t i = 0; i < list.size(); i += 3) {
    std::vector<uint32_t> t = {list[i], list[i + 1], list[i + 2]};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    result.push_back(t);
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// Strips have the triangles, wound alike.
inline void checkStrips(const std::vector<uint32_t>& strips, const std::vector<uint32_t>& starts,
                        sf::ArrayView<const uint32_t> triangles) {
  std::vector<uint32_t> list;
  require(!starts.empty() && starts.back() == strips.size(), "strips have starts");
  for (size_t s = 0; s + 1 < starts.size(); ++s)
    for (uint32_t i = starts[s]; i + 2 < starts[s + 1]; ++i) {
      const bool odd = (i - starts[s]) % 2;
      const uint32_t a = strips[i + odd], b = strips[i + !odd], c = strips[i + 2];
      if (a != b && b != c && c != a) list.insert(list.end(), {a, b, c});
    }
  require(sorted(list) == sorted(triangles), "strips have the triangles");
}

/// Triangulates, and checks all that can be said of the result by itself; a certificate that fails
/// aborts, since SF_ASSERT is armed.
inline sf::Outcome triangulateChecked(sf::PolygonTriangulator& triangulator,
                                      const PolygonInput& polygon,
                                      const sf::PolygonOptions& options) {
  sf::PolygonTriangulation result;
  sf::Work work;
  const sf::PolygonView view = polygon.view();
  const sf::Outcome outcome = triangulator.triangulate(view, options, work, result);
  require(work.used() == 0, "memory charged is given back");
  checkTriangles(result.triangles, polygon.vertices());
  require(outcome.ok() != result.triangles.empty(), "triangles exactly if all is well");
  if (outcome.status != sf::Status::BadStarts) checkPlace(outcome, view);
  if (outcome.ok() && options.strips)
    checkStrips(result.strips, result.stripStarts, result.triangles);
  return outcome;
}

}  // namespace sffuzz
