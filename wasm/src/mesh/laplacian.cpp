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
  TriangleMesh mesh;                // its corners and twins
  std::vector<double> lengths;      // [3m] of half-edges
  std::vector<double> doubleAreas;  // [m]
  std::vector<double> cotangents;   // [3m] of the angles opposite half-edges

  void measure(uint32_t t);
  bool flip(uint32_t h);
};

/// Area and cotangents of a triangle from its lengths.
void Intrinsic::measure(uint32_t t) {
  const double* l = &lengths[3 * size_t(t)];
  // Kahan's formula.
  double a = l[0], b = l[1], c = l[2];
  if (a < b) std::swap(a, b);
  if (a < c) std::swap(a, c);
  if (b < c) std::swap(b, c);
  const double square = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
  const double area = square > 0 ? 0.5 * std::sqrt(square) : 0, below = 2 * area;
  doubleAreas[t] = area;
  for (int k = 0; k < 3; ++k) {
    const double side = l[k], next = l[(k + 1) % 3], last = l[(k + 2) % 3];
    const double above = (next - side) * (next + side) + last * last;
    cotangents[3 * size_t(t) + k] = std::fabs(above) < kLargestCotangent * below ? above / below
                                    : above > 0                                  ? kLargestCotangent
                                    : above < 0 ? -kLargestCotangent
                                                : 0;
  }
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
  apexOf(base, lengths[prevInTriangle(h)], lengths[h1], doubleAreas[h / 3], cx, cy);
  apexOf(base, lengths[g1], lengths[prevInTriangle(g)], doubleAreas[g / 3], dx, dy);
  const double length = std::hypot(cx - dx, cy + dy);
  const double crossing = cx + (dx - cx) * (cy + dy > 0 ? cy / (cy + dy) : 0.5);
  if (!(length > 0) || crossing <= 0 || crossing >= base) return false;
  const double fromA = lengths[g1], fromB = lengths[h1];
  mesh.flip(h);
  lengths[h] = fromA, lengths[g] = fromB, lengths[h1] = lengths[g1] = length;
  measure(h / 3), measure(g / 3);
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
    if (margin - slack > most) most = margin - slack;
  }
  if (most > 0)
    for (double& length : surface.lengths) length += most;
  surface.doubleAreas.resize(corners.size() / 3), surface.cotangents.resize(corners.size());
  for (uint32_t t = 0; t < corners.size() / 3; ++t) surface.measure(t);
}

/// Flips edges until the two angles opposite each sum to at most pi. False when the work ended.
bool makeDelaunay(Intrinsic& surface, Work& work) {
  std::vector<uint32_t> stack;
  const TriangleMesh& mesh = surface.mesh;
  const auto wantsFlip = [&](uint32_t h) {
    const uint32_t g = mesh.twins[h];
    return g != kNone && surface.cotangents[h] + surface.cotangents[g] < -1e-9;
  };
  for (uint32_t h = uint32_t(mesh.corners.size()); h-- > 0;)
    if (mesh.twins[h] > h && wantsFlip(h)) stack.push_back(h);
  // It ends by itself, in theory; rounding may turn an edge of four points on a circle for ever.
  size_t budget = 20 * mesh.corners.size();
  while (!stack.empty() && budget > 0) {
    const uint32_t h = stack.back(), g = mesh.twins[h];
    stack.pop_back();
    if (!work.tick(60)) return false;
    if (!wantsFlip(h) || !surface.flip(h)) continue;
    --budget;
    for (const uint32_t side : {h, prevInTriangle(h), g, prevInTriangle(g)}) stack.push_back(side);
  }
  return true;
}

/// The matrix of the triangles that count: an edge has half of the cotangents on either side.
///   counts  [m]
void assemble(const Intrinsic& surface, uint32_t n, ArrayView<const uint8_t> counts,
              SparseRows& rows) {
  const std::vector<uint32_t>&corners = surface.mesh.corners, &twins = surface.mesh.twins;
  // Calls `put` for each end of each edge that is known from there, by its half-edge or as the only one of the edge.
  const auto forEntries = [&](auto&& put) {
    for (uint32_t t = 0; t < counts.size(); ++t)
      for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t h = 3 * t + k, g = twins[h], a = corners[h],
                       b = corners[3 * t + (k + 1) % 3];
        const bool isWithin = g != kNone && counts[g / 3];
        // An edge from a vertex to itself says nothing.
        if (a == b || (!counts[t] && !isWithin)) continue;
        const double w = 0.5 * ((counts[t] ? surface.cotangents[h] : 0) +
                                (isWithin ? surface.cotangents[g] : 0));
        put(a, b, w);
        if (g == kNone) put(b, a, w);
      }
  };
  rows.starts.assign(n + 1, 1);
  forEntries([&](uint32_t a, uint32_t, double) { ++rows.starts[a]; });
  for (uint32_t v = 0, sum = 0; v <= n; ++v) {
    const uint32_t count = rows.starts[v];
    rows.starts[v] = sum, sum += count;
  }
  rows.columns.resize(rows.starts[n]), rows.values.resize(rows.starts[n]);
  std::vector<uint32_t> next(n);
  for (uint32_t v = 0; v < n; ++v) {
    rows.columns[rows.starts[v]] = v, rows.values[rows.starts[v]] = 0;
    next[v] = rows.starts[v] + 1;
  }
  forEntries([&](uint32_t a, uint32_t b, double w) {
    const uint32_t e = next[a]++;
    rows.columns[e] = b, rows.values[e] = -w, rows.values[rows.starts[a]] += w;
  });
}

}  // namespace

bool buildLaplacian(ArrayView<const double> positions, const TriangleMesh& mesh,
                    ArrayView<const Clamp> clamps, bool withInner, Work& work, Laplacian& result) {
  const uint32_t n = uint32_t(positions.size() / 3), m = mesh.triangleCount();
  Charge charge(work);
  // Corners, twins, lengths, cotangents, areas, and the stack.
  if (!charge.add(uint64_t(m) * (3 * (4 + 4 + 8 + 8 + 4) + 8) + uint64_t(n) * 16)) return false;
  Intrinsic surface;
  surface.mesh.corners = mesh.corners, surface.mesh.twins = mesh.twins;
  measure(positions, surface);

  result.isBoundary.assign(n, 1);
  for (const uint32_t v : mesh.corners) result.isBoundary[v] = 0;
  for (uint32_t h = 0; h < 3 * m; ++h)
    if (mesh.twins[h] == kNone) result.isBoundary[mesh.from(h)] = result.isBoundary[mesh.to(h)] = 1;
  for (const Clamp& clamp : clamps) result.isBoundary[clamp.vertex] = 0;
  result.clamps.assign(clamps.begin(), clamps.end());
  if (!makeDelaunay(surface, work)) return false;

  // Areas of Voronoi cells, which in a Delaunay triangulation are positive: with them the curvature of a sphere
  // comes out exactly at every vertex, however irregular. Corners without area would make the surface infinitely
  // stiff there.
  result.mass.assign(n, 0);
  double total = 0;
  std::vector<double> third(n, 0.0);
  std::vector<uint8_t> areAll(m, 1), areInner(m, 1);
  for (uint32_t t = 0; t < m; ++t) {
    const uint32_t* v = &surface.mesh.corners[3 * size_t(t)];
    const double share = surface.doubleAreas[t] / 6;
    total += 3 * share;
    for (uint32_t k = 0; k < 3; ++k) {
      const size_t h = 3 * size_t(t) + k;
      const double cell = surface.cotangents[h] * surface.lengths[h] * surface.lengths[h] / 8;
      result.mass[v[k]] += cell, result.mass[v[(k + 1) % 3]] += cell;
      third[v[k]] += share;
      if (result.isBoundary[v[k]]) areInner[t] = 0;
    }
  }
  const double mean = total > 0 ? total / n : 1;
  result.unit = mean;
  for (uint32_t v = 0; v < n; ++v)
    result.mass[v] = std::fmax(std::fmax(result.mass[v], 0.2 * third[v]) / mean, 1e-6);
  assemble(surface, n, areAll, result.whole);
  if (withInner) assemble(surface, n, areInner, result.inner);
  return work.tick(150 * uint64_t(m));
}

}  // namespace sf
