// Surfaces smoothed between their boundary: against the ones that are known.
#include "mesh/smooth_surface.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>

#include "mesh/bvh.h"
#include "support/meshes.h"

using namespace sf;
using namespace sftest;

namespace {

SmoothSurface smoothed(const TestMesh& mesh, const SmoothOptions& options) {
  Work work;
  SmoothSurface result;
  CHECK(smoothSurface(mesh.view(), options, work, result).ok());
  CHECK(work.used() == 0);
  REQUIRE(result.boundary.size() <= result.positions.size() / 3);
  for (size_t i = 0; i < result.boundary.size(); ++i)
    for (int k = 0; k < 3; ++k)
      CHECK(result.positions[3 * i + k] == mesh.positions[3 * result.boundary[i] + k]);
  for (const double x : result.positions) CHECK(std::isfinite(x));
  return result;
}

/// The face that keeps a mesh from being smoothed, or kNone.
uint32_t faultOf(const TestMesh& mesh) {
  Work work;
  SmoothSurface result;
  const Outcome outcome = smoothSurface(mesh.view(), {}, work, result);
  CHECK(outcome.status == (outcome.vertex == kNone ? Status::Ok : Status::BadSurface));
  return outcome.vertex;
}

}  // namespace

TEST_CASE("smoothSurface: between two rings a catenoid, and a thread where there is none") {
  SmoothOptions options;
  options.refining.maxNewVertices = 1500;
  const double height = 0.8;
  const SmoothSurface film = smoothed(tubeMesh(96, 6, height), options);
  CHECK(film.isMinimal);
  CHECK(film.collapsed.empty());
  // r = c cosh(z / c) with r = 1 at the rings.
  double low = 0.6, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double c = (low + high) / 2;
    (c * std::cosh(height / 2 / c) < 1 ? low : high) = c;
  }
  double most = 0;
  for (size_t v = film.boundary.size(); v < film.positions.size() / 3; ++v) {
    const Vec3 p = pointAt(film.positions, uint32_t(v));
    most = std::fmax(most, std::fabs(std::hypot(p.x, p.y) - low * std::cosh(p.z / low)));
  }
  CHECK(most < 3e-3);
  CHECK_FALSE(smoothed(tubeMesh(48, 8, 2.0), options).collapsed.empty());
}

TEST_CASE("smoothSurface: over a flat boundary all kinds are flat") {
  TestMesh sheet = saddleMesh(8, 0);
  // A bump in the middle.
  for (uint32_t v = 0; v < sheet.vertexCount(); ++v) {
    double* p = sheet.positions.data() + 3 * v;
    if (std::fabs(p[0]) < 0.9 && std::fabs(p[1]) < 0.9) p[2] = 0.3;
  }
  for (const SurfaceKind kind :
       {SurfaceKind::SoapFilm, SurfaceKind::ThinPlate, SurfaceKind::Curvature}) {
    CAPTURE(int(kind));
    SmoothOptions options;
    options.kind = kind, options.refining.density = 0;
    const SmoothSurface surface = smoothed(sheet, options);
    CHECK(surface.area == doctest::Approx(4).epsilon(1e-3));
  }
}

TEST_CASE(
    "smoothSurface: what is no such surface is told with a face, and nothing at all is nothing") {
  CHECK(faultOf(sphereMesh(1)) == 0);
  TestMesh twice = saddleMesh(3, 0.2);
  const uint32_t last = uint32_t(twice.faces.size() / 3);
  twice.addFace(twice.faces[0], twice.faces[1], twice.faces[2]);
  CHECK(faultOf(twice) == last);
  CHECK(faultOf(moebiusMesh(12)) != kNone);
  // A part without a boundary beside one with.
  const TestMesh open = saddleMesh(3, 0.2);
  CHECK(faultOf(together(open, sphereMesh(1))) == open.faces.size() / 3);
  // Two triangles at one vertex, behind another part.
  TestMesh bow = open;
  const uint32_t n = uint32_t(bow.positions.size() / 3);
  for (const double x : {0.0, 1.0, 2.0, -1.0, -2.0}) bow.addVertex({x, x * x, 5});
  bow.addFace(n, n + 1, n + 2);
  bow.addFace(n, n + 3, n + 4);
  CHECK(faultOf(bow) == open.faces.size() / 3);
  CHECK(faultOf(TestMesh{}) == kNone);
}

namespace {

/// A fan over a ring of radius 1 at some height.
TestMesh fanMesh(uint32_t n, double height = 0) {
  TestMesh mesh;
  for (uint32_t i = 0; i < n; ++i) {
    const double angle = 2 * std::acos(-1.0) * i / n;
    mesh.addVertex({std::cos(angle), std::sin(angle), height});
  }
  for (uint32_t i = 1; i + 1 < n; ++i) mesh.addFace(0, i, i + 1);
  return mesh;
}

/// The normals that a function gives in the middle of the edges from each vertex to the next, of n.
std::vector<double> normalsAlong(const TestMesh& mesh, uint32_t n,
                                 const std::function<Vec3(Vec3)>& normal) {
  std::vector<double> normals;
  for (uint32_t i = 0; i < n; ++i) {
    const Vec3 middle =
        0.5 * (pointAt(mesh.positions, i) + pointAt(mesh.positions, (i + 1) % n));
    const Vec3 at = normal(middle);
    normals.insert(normals.end(), {at.x, at.y, at.z});
  }
  return normals;
}

/// The largest difference of a distance from 0 over the free vertices.
double farthest(const SmoothSurface& surface, const std::function<double(Vec3)>& distance) {
  double most = 0;
  for (size_t v = surface.boundary.size(); v < surface.positions.size() / 3; ++v)
    most = std::fmax(most, std::fabs(distance(pointAt(surface.positions, uint32_t(v)))));
  return most;
}

}  // namespace

TEST_CASE("smoothSurface: with a sphere's normals a disc becomes the sphere's cap") {
  for (const double degrees : {20.0, 60.0, 90.0, 110.0}) {
    const double angle = degrees * std::acos(-1.0) / 180, radius = 1 / std::sin(angle);
    const Vec3 centre{0, 0, -radius * std::cos(angle)};
    const TestMesh disc = fanMesh(80);
    const std::vector<double> normals =
        normalsAlong(disc, 80, [&](Vec3 p) { return p - centre; });
    for (const SurfaceKind kind : {SurfaceKind::ThinPlate, SurfaceKind::Curvature}) {
      SmoothOptions options;
      options.kind = kind, options.isClamped = true, options.boundaryNormals = normals;
      const SmoothSurface cap = smoothed(disc, options);
      const double off =
          farthest(cap, [&](Vec3 p) { return length(p - centre) / radius - 1; });
      MESSAGE(degrees << " " << int(kind) << " " << off << " " << cap.positions.size() / 3);
      CHECK(off < 2e-3);
    }
  }
}
