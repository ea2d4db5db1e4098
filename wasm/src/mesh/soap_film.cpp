#include "mesh/soap_film.h"

#include <cmath>

#include "base/charge.h"
#include "base/vec.h"
#include "mesh/fair_system.h"
#include "mesh/unit_box.h"

namespace sf {
namespace {

// Harmonic steps before the first of Newton's, and between flips.
constexpr uint32_t kHarmonic = 8;
constexpr uint32_t kPerRelaxing = 4;
// Of the mean area of a triangle: all triangles about a vertex of a thread have less.
constexpr double kThread = 1e-3;
// A step of Newton's beyond this share of the extent is none to trust.
constexpr double kLongest = 0.1;

double doubleAreaOf(ArrayView<const Vec3> at, const uint32_t* v) {
  return length(cross(at[v[1]] - at[v[0]], at[v[2]] - at[v[0]]));
}

double doubleAreaOfPatch(const LocalSurface& surface, ArrayView<const Vec3> at) {
  double sum = 0;
  for (size_t t = 3 * size_t(surface.fixedTriangles); t < surface.triangles.size(); t += 3)
    sum += doubleAreaOf(at, &surface.triangles[t]);
  return sum;
}

void findCollapsed(const LocalSurface& surface, ArrayView<const Vec3> at,
                   std::vector<uint32_t>& collapsed) {
  const size_t from = 3 * size_t(surface.fixedTriangles),
               count = (surface.triangles.size() - from) / 3;
  std::vector<double> largest(at.size(), 0.0);
  double sum = 0;
  for (size_t t = from; t < surface.triangles.size(); t += 3) {
    const double area = doubleAreaOf(at, &surface.triangles[t]);
    sum += area;
    for (size_t k = 0; k < 3; ++k)
      largest[surface.triangles[t + k]] = std::fmax(largest[surface.triangles[t + k]], area);
  }
  for (uint32_t v = surface.fixedVertices; v < at.size(); ++v)
    if (largest[v] < kThread * sum / double(count)) collapsed.push_back(v);
}

}  // namespace

Status relaxToFilm(LocalSurface& surface, const FilmOptions& options, Work& work, Film& result) {
  result = {};
  Status status = refine(surface, options.refining, work);
  if (status != Status::Ok) return status;
  const UnitBox box(surface.positions);
  const size_t n = surface.positions.size() / 3;
  // Nothing can move.
  result.isMinimal = n <= surface.fixedVertices || box.isPoint();
  if (result.isMinimal) return work.status();
  Charge charge(work);
  if (!charge.add(n * 350)) return work.status();
  std::vector<Vec3> at(n), before(n);
  const auto take = [&] {
    for (size_t v = 0; v < n; ++v) at[v] = box.in(&surface.positions[3 * v]);
  };
  const auto give = [&] {
    for (size_t v = surface.fixedVertices; v < n; ++v) box.out(at[v], &surface.positions[3 * v]);
  };
  take();
  std::vector<double> flat;
  TriangleMesh mesh;
  uint32_t harmonic = 0;
  bool isNewton = false;
  for (; result.steps < options.steps && !result.isMinimal; ++result.steps) {
    work.setFraction(double(result.steps) / options.steps);
    flat.clear();
    for (const Vec3& p : at) flat.insert(flat.end(), {p.x, p.y, p.z});
    Laplacian laplacian;
    if (mesh.twins.empty()) {
      mesh.corners = surface.triangles;
      if (!findTwins(mesh.corners, uint32_t(n), work, mesh.twins)) return work.status();
    }
    if (!buildLaplacian(flat, mesh, {}, false, work, laplacian)) return work.status();
    FairSystem system(laplacian, surface.fixedVertices, work);
    before = at;
    double most = 0;
    isNewton = isNewton || harmonic >= kHarmonic;
    if (isNewton) {
      const double area = doubleAreaOfPatch(surface, at);
      system.measure(at, surface.triangles);
      const bool isGood = system.step(1, at, most) && most < kLongest;
      if (!work.going()) return work.status();
      if (!isGood || !(doubleAreaOfPatch(surface, at) <= area * (1 + 1e-9))) {
        // Not near a stable film, or not yet.
        at = before, isNewton = false, harmonic = 0;
        continue;
      }
    } else {
      const bool isGood = system.solve(1, at);
      if (!work.going()) return work.status();
      if (!isGood) {
        at = before;
        break;
      }
      ++harmonic;
      for (size_t v = 0; v < n; ++v) most = std::fmax(most, distance(at[v], before[v]));
    }
    result.isMinimal = most <= options.tolerance;
    if (!isNewton && harmonic % kPerRelaxing == 0) {
      give();
      findCollapsed(surface, at, result.collapsed);
      if (!result.collapsed.empty()) break;
      status = relax(surface, 2, work);
      if (status != Status::Ok) return status;
      take();
      mesh.twins.clear();
      result.isMinimal = false;
    }
  }
  give();
  if (result.collapsed.empty()) findCollapsed(surface, at, result.collapsed);
  result.area = 0.5 * doubleAreaOfPatch(surface, at) * box.extent() * box.extent();
  return work.status();
}

}  // namespace sf
