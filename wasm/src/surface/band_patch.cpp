#include "surface/band_patch.h"

#include <algorithm>

#include "base/sort.h"
#include "triangles/triangle_mesh.h"

namespace sf {
namespace {

bool overlaps(const Box2& box, Point2 a, Point2 b, Point2 c) {
  return std::max({a.x, b.x, c.x}) > box.u0 && std::min({a.x, b.x, c.x}) < box.u1 &&
         std::max({a.y, b.y, c.y}) > box.v0 && std::min({a.y, b.y, c.y}) < box.v1;
}

/// Rises as a direction turns counter-clockwise, from 0 to 4.
double turnOf(Point2 d) {
  const double s = std::fabs(d.x) + std::fabs(d.y), x = d.x / s;
  return d.y >= 0 ? 1 - x : 3 + x;
}

}  // namespace

bool BandPatch::run(const Band& band, PolygonTriangulator& triangulator, Work& work,
                    ArrayView<const uint32_t> twins, std::vector<uint32_t>& corners, size_t& kept,
                    std::vector<uint8_t>& stays) {
  const size_t count = corners.size() / 3;
  stays.assign(count, 1);
  for (size_t t = 0; t < count; ++t) {
    const uint32_t *c = &corners[3 * t], n = uint32_t(band.isGone.size());
    if (c[0] >= n || c[1] >= n || c[2] >= n) return false;
    const Point2 p = band.at[c[0]], q = band.at[c[1]], r = band.at[c[2]];
    stays[t] = !band.isGone[c[0]] && !band.isGone[c[1]] && !band.isGone[c[2]] &&
               std::none_of(band.changed.begin(), band.changed.end(),
                            [&](const Box2& box) { return overlaps(box, p, q, r); });
  }
  if (!findHole(band, corners, twins, stays, work) || !linkRings(band)) return false;
  // Islands that what stays does not have.
  isUsed_.assign(band.at.size(), 0);
  for (size_t t = 0; t < count; ++t)
    for (size_t k = 0; k < 3 && stays[t]; ++k) isUsed_[corners[3 * t + k]] = 1;
  islands_.clear(), islandVertices_.clear();
  for (const uint32_t v : band.islands)
    if (!isUsed_[v]) {
      islands_.push_back(band.at[v].x), islands_.push_back(band.at[v].y);
      islandVertices_.push_back(v);
    }
  found_.clear();
  if (!rings_.empty()) {
    if (!triangulator.floodDelaunay({xy_, starts_, islands_, true}, work, found_).ok())
      return false;
  } else if (!islands_.empty()) {
    return false;
  }
  size_t to = 0;
  for (size_t t = 0; t < count; ++t)
    if (stays[t]) {
      std::copy(&corners[3 * t], &corners[3 * t] + 3, &corners[3 * to]);
      ++to;
    }
  corners.resize(3 * to);
  kept = to;
  const uint32_t onRings = uint32_t(rings_.size());
  for (const uint32_t v : found_)
    corners.push_back(v < onRings ? rings_[v] : islandVertices_[v - onRings]);
  return true;
}

/// The border of the hole: the new border without that of what stays, and what is left of the latter, turned round.
bool BandPatch::findHole(const Band& band, const std::vector<uint32_t>& corners,
                         ArrayView<const uint32_t> twins, const std::vector<uint8_t>& stays,
                         Work& work) {
  const size_t n = band.at.size();
  if (!work.tick(4 * (band.border.size() + corners.size()))) return false;
  // The new border, by first vertices.
  firsts_.assign(n + 1, 0);
  for (size_t i = 0; i < band.border.size(); i += 2) ++firsts_[band.border[i] + 1];
  for (size_t v = 0; v < n; ++v) firsts_[v + 1] += firsts_[v];
  edges_.resize(band.border.size() / 2);
  for (size_t i = band.border.size(); i > 0; i -= 2)
    edges_[--firsts_[band.border[i - 2] + 1]] = {band.border[i - 2], band.border[i - 1]};
  // Now firsts_[v + 1] is where those from v begin.
  isTaken_.assign(edges_.size(), 0);
  hole_.clear();
  for (uint32_t h = 0; h < corners.size(); ++h) {
    if (!stays[h / 3]) continue;
    const uint32_t twin = twins[h];
    if (twin != kNone && stays[twin / 3]) continue;
    const uint32_t a = corners[h], b = corners[nextInTriangle(h)];
    bool isFound = false;
    for (size_t i = firsts_[a + 1]; i < edges_.size() && edges_[i].from == a && !isFound; ++i)
      if (edges_[i].to == b && !isTaken_[i]) isTaken_[i] = 1, isFound = true;
    if (isFound) continue;
    hole_.push_back({b, a});
  }
  for (size_t i = 0; i < edges_.size(); ++i)
    if (!isTaken_[i]) hole_.push_back(edges_[i]);
  return true;
}

/// Rings from the edges of the hole. Where several meet at a vertex, each goes on along its own part of the hole.
bool BandPatch::linkRings(const Band& band) {
  rings_.clear(), starts_.assign(1, 0), xy_.clear();
  // Edges that run to and fro enclose nothing.
  const auto less = [](const Edge& a, const Edge& b) {
    return a.from < b.from || (a.from == b.from && a.to < b.to);
  };
  sf::sort(hole_.begin(), hole_.end(), less);
  const auto firstFrom = [&](uint32_t v) {
    return size_t(std::lower_bound(hole_.begin(), hole_.end(), Edge{v, 0}, less) - hole_.begin());
  };
  isTaken_.assign(hole_.size(), 0);
  for (size_t i = 0; i < hole_.size(); ++i) {
    if (isTaken_[i] || hole_[i].from > hole_[i].to) continue;
    const Edge back{hole_[i].to, hole_[i].from};
    const auto found = std::lower_bound(hole_.begin(), hole_.end(), back, less);
    if (found != hole_.end() && found->from == back.from && found->to == back.to)
      isTaken_[i] = isTaken_[size_t(found - hole_.begin())] = 1;
  }
  for (size_t first = 0; first < hole_.size(); ++first) {
    if (isTaken_[first]) continue;
    size_t e = first;
    for (;;) {
      isTaken_[e] = 1;
      rings_.push_back(hole_[e].from);
      const uint32_t v = hole_[e].to;
      const Point2 at = band.at[v], from = band.at[hole_[e].from];
      const double back = turnOf({from.x - at.x, from.y - at.y});
      size_t next = hole_.size();
      double least = 5;
      for (size_t k = firstFrom(v); k < hole_.size() && hole_[k].from == v; ++k) {
        if (isTaken_[k] && k != first) continue;
        const Point2 to = band.at[hole_[k].to];
        // How far clockwise from the way back.
        double turn = back - turnOf({to.x - at.x, to.y - at.y});
        if (turn <= 0) turn += 4;
        if (turn < least) least = turn, next = k;
      }
      if (next == hole_.size()) return false;
      if (next == first) break;
      e = next;
    }
    starts_.push_back(uint32_t(rings_.size()));
  }
  for (const uint32_t v : rings_) xy_.push_back(band.at[v].x), xy_.push_back(band.at[v].y);
  return true;
}

}  // namespace sf
