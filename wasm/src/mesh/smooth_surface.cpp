#include "mesh/smooth_surface.h"

#include <algorithm>

#include "mesh/adjacency.h"
#include "mesh/smooth_patch.h"
#include "mesh/soap_film.h"

namespace sf {
namespace {

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

/// The first face that keeps the mesh from being a manifold, oriented surface with a boundary in each part, or kNone.
uint32_t faultyFace(const MeshView& mesh, const Adjacency& adjacency) {
  uint32_t first = kNone;
  for (const Defect& defect : adjacency.defects)
    if (defect.kind != DefectKind::UnusedVertex) first = std::min(first, faceOf(mesh, defect));
  if (first != kNone) return first;
  std::vector<uint8_t> isBounded(adjacency.components, 0);
  for (uint32_t h = 0; h < mesh.faces.size(); ++h)
    if (adjacency.twins[h] == kNone) isBounded[adjacency.component[h / 3]] = 1;
  // A closed part has nothing that holds it.
  for (uint32_t f = 0; f < mesh.faces.size() / 3; ++f)
    if (!isBounded[adjacency.component[f]]) return f;
  return kNone;
}

}  // namespace

Outcome smoothSurface(const MeshView& mesh, const SmoothOptions& options, Work& work,
                      SmoothSurface& result) {
  Charge charge(work);
  Adjacency adjacency;
  if (!buildAdjacency(mesh, work, charge, adjacency)) return {work.status()};
  const uint32_t fault = faultyFace(mesh, adjacency);
  if (fault != kNone) return {Status::BadSurface, kNone, fault};

  // The boundary first.
  const size_t n = mesh.positions.size() / 3, m = mesh.faces.size() / 3;
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
  surface.fixedVertices = uint32_t(surface.positions.size() / 3);
  for (const uint32_t v : mesh.faces) add(v);
  for (const uint32_t v : mesh.faces) surface.triangles.push_back(number[v]);

  RefineOptions refining;
  refining.density = options.density;
  refining.maxNewVertices = options.maxNewVertices;
  if (m > 0 && options.kind == SurfaceKind::SoapFilm) {
    FilmOptions film;
    film.refining = refining;
    Film found;
    const Status status = relaxToFilm(surface, film, work, found);
    if (status != Status::Ok) return {status};
    result.isMinimal = found.isMinimal;
    result.collapsed = std::move(found.collapsed);
  } else if (m > 0) {
    FairOptions fairing;
    fairing.order = options.kind == SurfaceKind::ThinPlate ? 2 : 3;
    Fairness fairness;
    const Status status = smoothPatch(surface, refining, fairing, work, fairness);
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
