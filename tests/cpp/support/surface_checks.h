// Opened models, and what has to hold for every mesh of them.
#pragma once
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "support/surface_models.h"
#include "surface/trimmed_surfaces.h"

namespace sf {

struct Opened {
  Work work;
  Charge charge{work};
  std::vector<ModelFault> faults;
  std::unique_ptr<TrimmedSurfaces> surfaces;

  explicit Opened(const ModelBuilder& builder) {
    Model model;
    const std::vector<uint32_t> shape = builder.shape();
    const std::vector<double> numbers = builder.numbers();
    REQUIRE(readModel({shape, numbers}, work, charge, model, faults));
    surfaces = TrimmedSurfaces::open(std::move(model), work, charge, faults);
    REQUIRE(surfaces);
  }
};

inline Sampling samplingOf(double tolerance, double angle = 10, double aspect = 3) {
  Sampling s;
  s.tolerance = tolerance, s.angle = angle, s.aspect = aspect;
  return s;
}

inline Vec3 at(const MeshLayout& mesh, uint32_t v) {
  return {mesh.positions[3 * v], mesh.positions[3 * v + 1], mesh.positions[3 * v + 2]};
}

struct Facts {
  size_t triangles = 0, openEdges = 0, vertices = 0, edges = 0;
  double area = 0, volume = 0;
};

/// Checks what has to hold for every mesh, and measures it. Vertices at one place count as one.
inline Facts check(const TrimmedSurfaces& surfaces, const Tessellation& told) {
  const MeshLayout& mesh = surfaces.layout();
  Facts facts;
  std::map<std::pair<uint32_t, uint32_t>, int> sides;
  std::set<uint32_t> places;
  std::multiset<std::vector<uint32_t>> drawn;
  const auto turned = [](uint32_t a, uint32_t b, uint32_t c) {
    std::vector<uint32_t> t = {a, b, c};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
  };
  size_t bad = 0;
  for (size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const uint32_t* t = &mesh.triangles[i];
    if (t[0] == t[1] && t[1] == t[2]) continue;  // room
    ++facts.triangles;
    const Vec3 a = at(mesh, t[0]), b = at(mesh, t[1]), c = at(mesh, t[2]), n = cross(b - a, c - a);
    bad += !(length(n) > 0);
    facts.area += length(n) / 2, facts.volume += dot(a, cross(b, c)) / 6;
    drawn.insert(turned(t[0], t[1], t[2]));
    for (int k = 0; k < 3; ++k) {
      const uint32_t p = told.same[t[k]], q = told.same[t[(k + 1) % 3]];
      bad += !(at(mesh, t[k]) == at(mesh, p));
      ++sides[{p, q}];
      places.insert(p);
    }
  }
  CHECK(bad == 0);
  for (const auto& [side, count] : sides) {
    CHECK(count == 1);
    facts.openEdges += !sides.count({side.second, side.first});
  }
  facts.vertices = places.size(), facts.edges = (sides.size() + facts.openEdges) / 2;
  // Strips draw the same triangles.
  std::multiset<std::vector<uint32_t>> inStrips;
  for (size_t s = 0; s + 1 < mesh.stripStarts.size(); ++s)
    for (uint32_t i = mesh.stripStarts[s]; i + 2 < mesh.stripStarts[s + 1]; ++i) {
      uint32_t a = mesh.strips[i], b = mesh.strips[i + 1];
      const uint32_t c = mesh.strips[i + 2];
      if (a == b || b == c || c == a) continue;
      if ((i - mesh.stripStarts[s]) % 2) std::swap(a, b);
      inStrips.insert(turned(a, b, c));
    }
  CHECK(inStrips == drawn);
  return facts;
}

/// The largest distance of the surface from the planes of the triangles that it lies over, looked at in many places of each.
inline double deviation(const TrimmedSurfaces& surfaces, uint32_t face, Vec3 origin) {
  const MeshLayout& mesh = surfaces.layout();
  const NurbsSurface& surface = *surfaces.model().faces[face].surface;
  double most = 0;
  for (uint32_t t = mesh.faceStarts[face]; t < mesh.faceStarts[face + 1]; ++t) {
    const uint32_t* c = &mesh.triangles[3 * t];
    if (c[0] == c[1]) continue;
    const Vec3 a = at(mesh, c[0]) + origin, b = at(mesh, c[1]) + origin,
               d = at(mesh, c[2]) + origin;
    for (int i = 1; i < 6; ++i)
      for (int j = 1; i + j < 6; ++j) {
        const double x = i / 6.0, y = j / 6.0, z = 1 - x - y;
        const auto mix = [&](int axis) {
          return x * mesh.uvs[2 * c[0] + axis] + y * mesh.uvs[2 * c[1] + axis] +
                 z * mesh.uvs[2 * c[2] + axis];
        };
        const SurfacePoint p = surface.at(mix(0), mix(1));
        const Vec3 n = p.normal(), off = p.at - (x * a + y * b + z * d);
        most = std::max(most, std::fabs(dot(off, n)) / length(n));
      }
  }
  return most;
}

}  // namespace sf
