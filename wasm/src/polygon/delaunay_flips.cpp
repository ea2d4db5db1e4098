#include "polygon/delaunay_flips.h"

#include <cmath>
#include <initializer_list>

#include "base/charge.h"
#include "polygon/delaunay_insertion.h"

namespace sf {
namespace {

// Flips a triangle before insertion is thought cheaper.
constexpr uint32_t kFlips = 2;

/// Points times the power of two that makes the largest coordinate about 1, if that is far off.
ArrayView<const Point2> inRange(const std::vector<Point2>& at, std::vector<Point2>& scaled) {
  double largest = 0;
  for (const Point2 p : at)
    for (const double x : {std::fabs(p.x), std::fabs(p.y)}) largest = x > largest ? x : largest;
  int exponent = 0;
  if (largest > 0) std::frexp(largest, &exponent);
  if (exponent > -40 && exponent < 40) return at;
  scaled.resize(at.size());
  const auto scale = [&](double x) {
    const double s = std::ldexp(x, -exponent);
    return std::fabs(s) < 0x1p-200 ? 0.0 : s;
  };
  for (size_t v = 0; v < at.size(); ++v) scaled[v] = {scale(at[v].x), scale(at[v].y)};
  return scaled;
}

}  // namespace

/// Lists every edge between two triangles once.
void DelaunayFlips::takeAllEdges() {
  const uint32_t* twins = mesh_.twins.data();
  const uint32_t count = uint32_t(mesh_.twins.size());
  edges_.resize(count);
  uint32_t edges = 0;
  for (uint32_t h = 0; h < count; ++h) {
    edges_[edges] = h;
    edges += h < twins[h] && twins[h] != kNone;
  }
  edges_.resize(edges);
}

bool DelaunayFlips::run(const LinkedPolygon& loops, Work& work, std::vector<uint32_t>& triangles) {
  if (triangles.size() < 6) return true;
  Charge charge(work);
  if (!charge.add(12 * uint64_t(triangles.size()) + 16 * uint64_t(loops.at.size()))) return false;
  mesh_.at = loops.at;
  mesh_.metric = inRange(loops.at, scaled_);
  mesh_.unused.clear(), mesh_.edgeFrom.clear();
  mesh_.corners.swap(triangles);
  const auto isDone = [&] {
    const uint32_t nodes = uint32_t(loops.at.size());
    if (!findTwins(mesh_.corners, nodes, work, mesh_.twins)) return false;
    takeAllEdges();
    const uint32_t budget = kFlips * uint32_t(mesh_.corners.size() / 3);
    if (legalize(mesh_, edges_, budget, work) > 0 || !work.going()) return work.going();
    if (delaunayByInsertion(loops, work, mesh_.corners) || !work.going()) return work.going();
    // Not for loops that touch: flip on.
    takeAllEdges();
    legalize(mesh_, edges_, ~0u, work);
    return work.going();
  };
  const bool done = isDone();
  mesh_.corners.swap(triangles);
  return done;
}

}  // namespace sf
