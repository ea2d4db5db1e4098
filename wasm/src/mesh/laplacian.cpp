#include "mesh/laplacian.h"

#include <cmath>
#include <utility>

#include "base/charge.h"
#include "base/vec.h"
#include "mesh/mesh.h"
#include "triangles/triangle_mesh.h"

namespace sf {
namespace {

// By how much of the mean edge two sides of a triangle are made longer than the third.
constexpr double kMollify = 1e-6;
// Cotangents beyond this say no more about the surface, and cost digits.
constexpr double kLargestCotangent = 1e4;

/// A triangulation of the surface by lengths alone: no places, so that a flip changes nothing of the surface.
struct Intrinsic {
  TriangleMesh mesh;            // its corners and twins
  std::vector<double> lengths;  // [3m] of half-edges

  double doubleArea(uint32_t h) const;
  double cotangent(uint32_t h) const;
  bool flip(uint32_t h);
};

/// Twice the area of the triangle of a half-edge, by Kahan's formula.
double Intrinsic::doubleArea(uint32_t h) const {
  double a = lengths[h], b = lengths[nextInTriangle(h)], c = lengths[prevInTriangle(h)];
  if (a < b) std::swap(a, b);
  if (a < c) std::swap(a, c);
  if (b < c) std::swap(b, c);
  const double square = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
  return square > 0 ? 0.5 * std::sqrt(square) : 0;
}

/// The cotangent of the angle opposite a half-edge.
double Intrinsic::cotangent(uint32_t h) const {
  const double a = lengths[h], b = lengths[nextInTriangle(h)], c = lengths[prevInTriangle(h)];
  const double above = (b - a) * (b + a) + c * c, below = 2 * doubleArea(h);
  if (std::fabs(above) < kLargestCotangent * below) return above / below;
  return above > 0 ? kLargestCotangent : above < 0 ? -kLargestCotangent : 0;
}

/// Turns the edge of h in the quadrilateral of its two triangles, laid flat. False if that is not convex.
bool Intrinsic::flip(uint32_t h) {
  const uint32_t g = mesh.twins[h], h1 = nextInTriangle(h), g1 = nextInTriangle(g);
  if (h / 3 == g / 3 || mesh.twins[h1] == g1) return false;
  // a at the origin, b on the x axis, the apex of h above it and that of g below.
  const auto apexOf = [&](double base, double fromStart, double toEnd, double area, double& x,
                          double& y) {
    x = base > 0 ? (base * base + (fromStart - toEnd) * (fromStart + toEnd)) / (2 * base) : 0;
    y = base > 0 ? area / base : fromStart;
  };
  double cx, cy, dx, dy;
  const double base = lengths[h];
  apexOf(base, lengths[prevInTriangle(h)], lengths[h1], doubleArea(h), cx, cy);
  apexOf(base, lengths[g1], lengths[prevInTriangle(g)], doubleArea(g), dx, dy);
  const double length = std::hypot(cx - dx, cy + dy);
  const double crossing = cx + (dx - cx) * (cy + dy > 0 ? cy / (cy + dy) : 0.5);
  if (!(length > 0) || crossing <= 0 || crossing >= base) return false;
  const double fromA = lengths[g1], fromB = lengths[h1];
  mesh.flip(h);
  lengths[h] = fromA, lengths[g] = fromB, lengths[h1] = lengths[g1] = length;
  return true;
}

/// Lengths of all sides, all a little longer where some triangle would have next to no area.
void measure(ArrayView<const double> positions, Intrinsic& surface) {
  const std::vector<uint32_t>& corners = surface.mesh.corners;
  surface.lengths.resize(corners.size());
  const auto at = [&](uint32_t v) { return pointAt(positions, v); };
  double sum = 0;
  for (uint32_t h = 0; h < corners.size(); ++h)
    sum += surface.lengths[h] = distance(at(corners[h]), at(corners[nextInTriangle(h)]));
  const double margin = corners.empty() ? 0 : kMollify * sum / double(corners.size());
  double most = 0;
  for (uint32_t h = 0; h < corners.size(); ++h) {
    const double slack = surface.lengths[nextInTriangle(h)] + surface.lengths[prevInTriangle(h)] -
                         surface.lengths[h];
    most = std::fmax(most, margin - slack);
  }
  if (most > 0)
    for (double& length : surface.lengths) length += most;
}

/// Flips edges until the two angles opposite each sum to at most pi. False when the work ended.
bool makeDelaunay(Intrinsic& surface, Work& work) {
  std::vector<uint32_t> stack;
  const TriangleMesh& mesh = surface.mesh;
  for (uint32_t h = uint32_t(mesh.corners.size()); h-- > 0;)
    if (mesh.twins[h] != kNone && mesh.twins[h] > h) stack.push_back(h);
  // It ends by itself, in theory; rounding may turn an edge of four points on a circle for ever.
  size_t budget = 20 * mesh.corners.size();
  while (!stack.empty() && budget > 0) {
    const uint32_t h = stack.back();
    stack.pop_back();
    const uint32_t g = mesh.twins[h];
    if (g == kNone) continue;
    if (!work.tick(30)) return false;
    if (surface.cotangent(h) + surface.cotangent(g) >= -1e-9) continue;
    if (!surface.flip(h)) continue;
    --budget;
    for (const uint32_t side : {h, prevInTriangle(h), g, prevInTriangle(g)}) stack.push_back(side);
  }
  return true;
}

struct Weight {
  uint32_t column;
  double value;
};

/// The matrix of the triangles that count.
bool assemble(const Intrinsic& surface, uint32_t n, ArrayView<const uint8_t> isLeftOut, Work& work,
              SparseRows& rows) {
  const std::vector<uint32_t>& corners = surface.mesh.corners;
  const auto counts = [&](uint32_t h) {
    if (isLeftOut.empty()) return true;
    const uint32_t t = h - h % 3;
    return !isLeftOut[corners[t]] && !isLeftOut[corners[t + 1]] && !isLeftOut[corners[t + 2]];
  };
  // Every half-edge gives an entry to the row of either end.
  std::vector<uint32_t> starts(n + 1, 0);
  for (uint32_t h = 0; h < corners.size(); ++h)
    if (counts(h)) ++starts[corners[h]], ++starts[corners[nextInTriangle(h)]];
  for (uint32_t v = 0, sum = 0; v <= n; ++v) {
    const uint32_t count = starts[v];
    starts[v] = sum, sum += count;
  }
  std::vector<Weight> entries(starts[n]);
  std::vector<uint32_t> next(starts.begin(), starts.end() - 1);
  for (uint32_t h = 0; h < corners.size(); ++h) {
    if (!counts(h)) continue;
    const uint32_t a = corners[h], b = corners[nextInTriangle(h)];
    const double w = 0.5 * surface.cotangent(h);
    entries[next[a]++] = {b, w}, entries[next[b]++] = {a, w};
  }
  rows.starts.assign(1, 0), rows.columns.clear(), rows.values.clear();
  std::vector<uint32_t> at(n, kNone);
  for (uint32_t v = 0; v < n; ++v) {
    const size_t from = rows.columns.size();
    rows.columns.push_back(v), rows.values.push_back(0);
    at[v] = uint32_t(from);
    for (uint32_t e = starts[v]; e < starts[v + 1]; ++e) {
      const Weight& entry = entries[e];
      if (entry.column == v) continue;  // an edge from a vertex to itself says nothing
      if (at[entry.column] == kNone || at[entry.column] < from)
        at[entry.column] = uint32_t(rows.columns.size()), rows.columns.push_back(entry.column),
        rows.values.push_back(0);
      rows.values[at[entry.column]] -= entry.value;
      rows.values[from] += entry.value;
    }
    rows.starts.push_back(uint32_t(rows.columns.size()));
    if (!work.tick(100)) return false;
  }
  return true;
}

}  // namespace

bool buildLaplacian(ArrayView<const double> positions, ArrayView<const uint32_t> triangles,
                    ArrayView<const Clamp> clamps, Work& work, Laplacian& result) {
  const uint32_t n = uint32_t(positions.size() / 3), m = uint32_t(triangles.size() / 3);
  Charge charge(work);
  // Corners, twins, lengths, the stack, and entries of one matrix, with the search for twins less.
  if (!charge.add(uint64_t(m) * 3 * (4 + 4 + 8 + 8 + 32) + uint64_t(n) * 16)) return false;
  Intrinsic surface;
  surface.mesh.corners.assign(triangles.begin(), triangles.end());
  if (!findTwins(triangles, n, work, surface.mesh.twins)) return false;
  measure(positions, surface);

  result.isBoundary.assign(n, 1);
  for (const uint32_t v : triangles) result.isBoundary[v] = 0;
  for (uint32_t h = 0; h < 3 * m; ++h)
    if (surface.mesh.twins[h] == kNone)
      result.isBoundary[triangles[h]] = result.isBoundary[triangles[nextInTriangle(h)]] = 1;
  for (const Clamp& clamp : clamps) result.isBoundary[clamp.vertex] = 0;
  result.clamps.assign(clamps.begin(), clamps.end());
  if (!makeDelaunay(surface, work)) return false;

  // Areas of Voronoi cells, which in a Delaunay triangulation are positive: with them the curvature of a sphere
  // comes out exactly at every vertex, however irregular. Corners without area would make the surface infinitely
  // stiff there.
  result.mass.assign(n, 0);
  double total = 0;
  std::vector<double> third(n, 0.0);
  for (uint32_t h = 0; h < 3 * m; ++h) {
    const uint32_t a = surface.mesh.corners[h], b = surface.mesh.corners[nextInTriangle(h)];
    const double cell = surface.cotangent(h) * surface.lengths[h] * surface.lengths[h] / 8;
    result.mass[a] += cell, result.mass[b] += cell;
    const double share = surface.doubleArea(h) / 6;
    third[a] += share, total += share;
  }
  const double mean = total > 0 ? total / n : 1;
  result.unit = mean;
  for (uint32_t v = 0; v < n; ++v)
    result.mass[v] = std::fmax(std::fmax(result.mass[v], 0.2 * third[v]) / mean, 1e-6);
  return assemble(surface, n, {}, work, result.whole) &&
         assemble(surface, n, result.isBoundary, work, result.inner);
}

}  // namespace sf
