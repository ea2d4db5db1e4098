#include "mesh/smooth_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/adjacency.h"
#include "mesh/smooth_patch.h"
#include "mesh/soap_film.h"

namespace sf {
namespace {

// The sine of the least angle between a normal and its edge: below it, they are one direction.
constexpr double kAlong = 1e-6;
// Steps to the least energy, at most: a flat patch may become half a sphere.
constexpr uint32_t kClampedSteps = 12;

/// The first face with some vertices.
uint32_t firstFaceWith(const MeshView& mesh, const std::vector<uint32_t>& vertices) {
  for (uint32_t f = 0; f < mesh.faces.size() / 3; ++f) {
    const uint32_t* c = mesh.faces.data() + 3 * size_t(f);
    if (std::all_of(vertices.begin(), vertices.end(),
                    [&](uint32_t v) { return v == c[0] || v == c[1] || v == c[2]; }))
      return f;
  }
  return kNone;
}

/// A face of a defect.
uint32_t faceOf(const MeshView& mesh, const Defect& defect) {
  if (!defect.faces.empty()) return defect.faces[0];
  if (!defect.vertices.empty()) return firstFaceWith(mesh, {defect.vertices[0]});
  return firstFaceWith(mesh, {defect.edges[0], defect.edges[1]});
}

/// An edge of a face among edges [2e], as a pair of vertices; kNone if there is none.
std::pair<uint32_t, uint32_t> edgeOf(const MeshView& mesh, uint32_t face,
                                     const std::vector<uint32_t>& edges) {
  const uint32_t* c = mesh.faces.data() + 3 * size_t(face);
  const auto has = [&](uint32_t v) { return v == c[0] || v == c[1] || v == c[2]; };
  for (size_t e = 0; e < edges.size(); e += 2)
    if (has(edges[e]) && has(edges[e + 1])) return {edges[e], edges[e + 1]};
  return {kNone, kNone};
}

/// What keeps the mesh from being a manifold, oriented surface with a boundary in each part: that of the first face.
Outcome faultOf(const MeshView& mesh, const Adjacency& adjacency) {
  const Defect* first = nullptr;
  uint32_t face = kNone;
  for (const Defect& defect : adjacency.defects) {
    if (defect.kind == DefectKind::UnusedVertex) continue;
    const uint32_t f = faceOf(mesh, defect);
    if (f < face) face = f, first = &defect;
  }
  if (first) {
    const auto [a, b] = edgeOf(mesh, face, first->edges);
    return {Status::BadSurface, kNone, face, a, b};
  }
  std::vector<uint8_t> isBounded(adjacency.components, 0);
  for (uint32_t h = 0; h < mesh.faces.size(); ++h)
    if (adjacency.twins[h] == kNone) isBounded[adjacency.component[h / 3]] = 1;
  // A closed part has nothing that holds it.
  for (uint32_t f = 0; f < mesh.faces.size() / 3; ++f)
    if (!isBounded[adjacency.component[f]]) return {Status::BadSurface, kNone, f};
  return {};
}

/// An edge of the boundary, in a loop that runs as its half-edge does, or against it.
struct BoundaryEdge {
  uint32_t half;
  bool runsAlong;
};

/// The edges of the boundary, in the order of SmoothOptions::boundaryNormals.
std::vector<BoundaryEdge> boundaryEdges(const Adjacency& adjacency) {
  std::vector<uint32_t> leaving(adjacency.vertices, kNone), arriving(leaving);
  for (uint32_t h = 0; h < adjacency.twins.size(); ++h)
    if (adjacency.twins[h] == kNone)
      leaving[adjacency.tail(h)] = h, arriving[adjacency.head(h)] = h;
  std::vector<BoundaryEdge> edges;
  for (uint32_t first = 0; first < adjacency.vertices; ++first) {
    if (leaving[first] == kNone) continue;
    const bool isAlong = adjacency.head(leaving[first]) < adjacency.tail(arriving[first]);
    for (uint32_t v = first; leaving[v] != kNone;) {
      const uint32_t h = isAlong ? leaving[v] : arriving[v];
      edges.push_back({h, isAlong});
      leaving[v] = kNone;
      v = isAlong ? adjacency.head(h) : adjacency.tail(h);
    }
  }
  return edges;
}

bool isUnknown(const double* n) { return std::isnan(n[0]) && std::isnan(n[1]) && std::isnan(n[2]); }

/// A normal of about unit length, or zero if it is none.
Vec3 scaled(const double* n) {
  double size = 0;
  for (int k = 0; k < 3; ++k) {
    if (!std::isfinite(n[k])) return {0, 0, 0};
    size = std::fmax(size, std::fabs(n[k]));
  }
  return size > 0 ? Vec3{n[0] / size, n[1] / size, n[2] / size} : Vec3{0, 0, 0};
}

/// The clamps of the boundary's vertices, which are the first of a surface; both edges of each have to be known.
///   number  [n] of the mesh's vertices in that surface
Outcome findClamps(const MeshView& mesh, const Adjacency& adjacency,
                   ArrayView<const double> normals, ArrayView<const uint32_t> number,
                   std::vector<Clamp>& clamps) {
  const std::vector<BoundaryEdge> edges = boundaryEdges(adjacency);
  const uint32_t b = uint32_t(edges.size());
  if (normals.size() != 3 * size_t(b)) return {Status::BadNormalCount, kNone, b};
  std::vector<Clamp> sums(b, Clamp{0, {0, 0, 0}, {0, 0, 0}});
  std::vector<uint8_t> known(b, 0);
  for (uint32_t i = 0; i < b; ++i) {
    const double* n = &normals[3 * size_t(i)];
    if (isUnknown(n)) continue;
    const uint32_t from = adjacency.tail(edges[i].half), to = adjacency.head(edges[i].half);
    const Vec3 edge = pointAt(mesh.positions, to) - pointAt(mesh.positions, from);
    const double l = length(edge);
    // Between vertices in one place there is no way out.
    const Vec3 along = l > 0 ? (1 / l) * edge : Vec3{0, 0, 0};
    const Vec3 across = cross(along, (edges[i].runsAlong ? 1 : -1) * scaled(n));
    const double sine = length(across);
    const bool isNone = dot(scaled(n), scaled(n)) == 0 || (l > 0 && !(sine > kAlong));
    if (isNone) return {Status::BadNormals, kNone, i, std::min(from, to), std::max(from, to)};
    if (!(l > 0)) continue;
    const Vec3 out = (1 / sine) * across;
    for (const uint32_t v : {number[from], number[to]}) {
      // The middle of the shorter edge is nearer.
      sums[v].normal = sums[v].normal + (1 / l) * cross(out, along);
      sums[v].pull = sums[v].pull + (l / 2) * out;
      ++known[v];
    }
  }
  for (uint32_t v = 0; v < b; ++v) {
    const double l = length(sums[v].normal);
    if (known[v] == 2 && l > 0) clamps.push_back({v, (1 / l) * sums[v].normal, sums[v].pull});
  }
  return {};
}

}  // namespace

Outcome smoothSurface(const MeshView& mesh, const SmoothOptions& options, Work& work,
                      SmoothSurface& result) {
  Charge charge(work);
  Adjacency adjacency;
  if (!buildAdjacency(mesh, work, charge, adjacency)) return {work.status()};
  Outcome outcome = faultOf(mesh, adjacency);
  if (!outcome.ok()) return outcome;

  // What stays first.
  const size_t n = mesh.positions.size() / 3, m = mesh.faces.size() / 3;
  if (!charge.add(n * 4 + m * 24)) return {work.status()};
  std::vector<uint32_t> number(n, kNone);
  LocalSurface surface;
  const auto add = [&](uint32_t v) {
    if (number[v] != kNone) return false;
    number[v] = uint32_t(surface.positions.size() / 3);
    const Vec3 p = pointAt(mesh.positions, v);
    surface.positions.insert(surface.positions.end(), {p.x, p.y, p.z});
    return true;
  };
  for (uint32_t h = 0; h < 3 * m; ++h)
    if (adjacency.twins[h] == kNone)
      for (const uint32_t v : {adjacency.tail(h), adjacency.head(h)})
        if (add(v)) result.boundary.push_back(v);
  std::vector<uint8_t> isUsed(n, 0);
  for (const uint32_t v : mesh.faces) isUsed[v] = 1;
  for (const uint32_t v : options.fixed) {
    if (v >= n) return {Status::BadOption};
    if (isUsed[v] && add(v)) result.fixed.push_back(v);
  }
  surface.fixedVertices = uint32_t(surface.positions.size() / 3);
  for (const uint32_t v : mesh.faces) add(v);
  for (const uint32_t v : mesh.faces) surface.triangles.push_back(number[v]);
  if (options.isClamped) {
    if (!charge.add(n * 8 + result.boundary.size() * (2 * sizeof(Clamp) + 16)))
      return {work.status()};
    outcome = findClamps(mesh, adjacency, options.boundaryNormals, number, surface.clamps);
    if (!outcome.ok()) return outcome;
  }

  if (m > 0 && options.kind == SurfaceKind::SoapFilm) {
    FilmOptions film;
    film.refining = options.refining;
    Film found;
    const Status status = relaxToFilm(surface, film, work, found);
    if (status != Status::Ok) return {status};
    result.isMinimal = found.isMinimal;
    result.collapsed = std::move(found.collapsed);
  } else if (m > 0) {
    FairOptions fairing;
    fairing.order = options.kind == SurfaceKind::ThinPlate ? 2 : 3;
    if (!surface.clamps.empty()) fairing.bendingSteps = fairing.curvatureSteps = kClampedSteps;
    Fairness fairness;
    const Status status = smoothPatch(surface, options.refining, fairing, work, fairness);
    if (status != Status::Ok) return {status};
  }
  for (size_t t = 0; t < surface.triangles.size(); t += 3) {
    const Vec3 a = pointAt(surface.positions, surface.triangles[t]);
    result.area += 0.5 * length(cross(pointAt(surface.positions, surface.triangles[t + 1]) - a,
                                      pointAt(surface.positions, surface.triangles[t + 2]) - a));
  }
  result.positions = std::move(surface.positions);
  result.triangles = std::move(surface.triangles);
  return {};
}

}  // namespace sf
