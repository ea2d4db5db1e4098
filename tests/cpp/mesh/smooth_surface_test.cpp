// Surfaces smoothed between their boundary: against the ones that are known.
#include "mesh/smooth_surface.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

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
  std::vector<uint32_t> kept = result.boundary;
  kept.insert(kept.end(), result.fixed.begin(), result.fixed.end());
  REQUIRE(kept.size() <= result.positions.size() / 3);
  for (size_t i = 0; i < kept.size(); ++i)
    for (int k = 0; k < 3; ++k)
      CHECK(result.positions[3 * i + k] == mesh.positions[3 * kept[i] + k]);
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

/// A fan over a ring of radius 1 in the plane z = 0. Triangles run as the vertices do, or against them.
TestMesh fanMesh(uint32_t n, bool isTurned = false) {
  TestMesh mesh;
  for (uint32_t i = 0; i < n; ++i) {
    const double angle = 2 * std::acos(-1.0) * i / n;
    mesh.addVertex({std::cos(angle), std::sin(angle), 0});
  }
  for (uint32_t i = 1; i + 1 < n; ++i)
    if (isTurned)
      mesh.addFace(0, i + 1, i);
    else
      mesh.addFace(0, i, i + 1);
  return mesh;
}

/// The normals that a function gives in the middle of the edges of rings of n vertices.
std::vector<double> normalsAlong(const TestMesh& mesh, uint32_t n,
                                 const std::function<Vec3(Vec3)>& normal,
                                 const std::vector<uint32_t>& firsts = {0}) {
  std::vector<double> normals;
  for (const uint32_t first : firsts)
    for (uint32_t i = 0; i < n; ++i) {
      const Vec3 at = normal(0.5 * (pointAt(mesh.positions, first + i) +
                                    pointAt(mesh.positions, first + (i + 1) % n)));
      normals.insert(normals.end(), {at.x, at.y, at.z});
    }
  return normals;
}

SmoothOptions clamped(SurfaceKind kind, const std::vector<double>& normals) {
  SmoothOptions options;
  options.kind = kind, options.isClamped = true, options.boundaryNormals = normals;
  return options;
}

/// The largest of a distance over the free vertices.
double farthest(const SmoothSurface& surface, const std::function<double(Vec3)>& distance) {
  double most = 0;
  for (size_t v = surface.boundary.size() + surface.fixed.size(); v < surface.positions.size() / 3;
       ++v)
    most = std::fmax(most, std::fabs(distance(pointAt(surface.positions, uint32_t(v)))));
  return most;
}

constexpr SurfaceKind kPlates[] = {SurfaceKind::ThinPlate, SurfaceKind::Curvature};

}  // namespace

TEST_CASE("smoothSurface: with a sphere's normals a disc becomes the sphere's cap") {
  for (const double degrees : {20.0, 60.0, 90.0, 110.0})
    for (const SurfaceKind kind : kPlates) {
      CAPTURE(degrees);
      CAPTURE(int(kind));
      const double angle = degrees * std::acos(-1.0) / 180, radius = 1 / std::sin(angle);
      const Vec3 centre{0, 0, -radius * std::cos(angle)};
      const TestMesh disc = fanMesh(80);
      const std::vector<double> normals =
          normalsAlong(disc, 80, [&](Vec3 p) { return p - centre; });
      const auto off = [&](Vec3 p) { return length(p - centre) / radius - 1; };
      const SmoothSurface cap = smoothed(disc, clamped(kind, normals));
      CHECK(cap.positions.size() / 3 > 800);
      CHECK(farthest(cap, off) < 1e-3);
      // The triangles may run against the list: nothing else has changed.
      CHECK(farthest(smoothed(fanMesh(80, true), clamped(kind, normals)), off) < 1e-3);
      // Normals that point the other way are those of a surface below, with the rim's outer side turned up.
      std::vector<double> turned = normals;
      for (size_t i = 0; i < turned.size(); i += 3) turned[i] *= -1, turned[i + 1] *= -1;
      const SmoothSurface cup = smoothed(disc, clamped(kind, turned));
      CHECK(farthest(cup, [&](Vec3 p) { return off({p.x, p.y, -p.z}); }) < 1e-3);
    }
}

TEST_CASE("smoothSurface: with normals of a plane a bump goes, with those of a cylinder a belly") {
  TestMesh sheet = saddleMesh(8, 0);
  for (uint32_t v = 0; v < sheet.vertexCount(); ++v) {
    double* p = sheet.positions.data() + 3 * v;
    if (std::fabs(p[0]) < 0.9 && std::fabs(p[1]) < 0.9) p[2] = 0.3;
  }
  std::vector<double> up;
  for (int i = 0; i < 32; ++i) up.insert(up.end(), {0, 0, 3e200});
  for (const SurfaceKind kind : kPlates)
    CHECK(farthest(smoothed(sheet, clamped(kind, up)), [](Vec3 p) { return p.z; }) < 1e-9);

  const TestMesh tube = mapped(tubeMesh(60, 6, 1.2), [](Vec3 p) {
    const double more = 1 + 0.3 * (0.36 - p.z * p.z);
    return Vec3{more * p.x, more * p.y, p.z};
  });
  // The triangles run against the second ring.
  const std::vector<double> normals = normalsAlong(tube, 60,
                                                   [](Vec3 p) {
                                                     return (p.z < 0 ? 1 : -1) * Vec3{p.x, p.y, 0};
                                                   },
                                                   {0, 360});
  const auto off = [](Vec3 p) { return std::hypot(p.x, p.y) - 1; };
  const SmoothSurface straight = smoothed(tube, clamped(SurfaceKind::Curvature, normals));
  CHECK(straight.positions.size() / 3 > 800);
  CHECK(farthest(straight, off) < 3e-3);
}

TEST_CASE("smoothSurface: a minimal surface bends least, with its normals and without") {
  // Scherk's first surface: z = log (cos x / cos y).
  const TestMesh flat = saddleMesh(16, 0);
  const auto height = [](Vec3 p) { return std::log(std::cos(p.x) / std::cos(p.y)); };
  const TestMesh scherk = mapped(flat, [&](Vec3 p) {
    const bool isInside = std::fabs(p.x) < 0.99 && std::fabs(p.y) < 0.99;
    return Vec3{p.x, p.y, isInside ? 0 : height(p)};
  });
  // From the corner on, the one loop of the square, with the normals of the surface itself.
  std::vector<uint32_t> loop;
  for (uint32_t i = 0; i < 16; ++i) loop.push_back(i);
  for (uint32_t i = 0; i < 16; ++i) loop.push_back(16 + 17 * i);
  for (uint32_t i = 0; i < 16; ++i) loop.push_back(17 * 17 - 1 - i);
  for (uint32_t i = 0; i < 16; ++i) loop.push_back(17 * (16 - i));
  std::vector<double> normals;
  for (size_t i = 0; i < loop.size(); ++i) {
    const Vec3 p = 0.5 * (pointAt(flat.positions, loop[i]) +
                          pointAt(flat.positions, loop[(i + 1) % loop.size()]));
    normals.insert(normals.end(), {std::tan(p.x), -std::tan(p.y), 1});
  }
  const auto off = [&](Vec3 p) { return p.z - height(p); };
  SmoothOptions options = clamped(SurfaceKind::ThinPlate, normals);
  CHECK(farthest(smoothed(scherk, options), off) < 2e-3);
  const std::vector<double> unknown(normals.size(), std::nan(""));
  const SmoothSurface without = smoothed(scherk, clamped(SurfaceKind::ThinPlate, unknown));
  CHECK(farthest(without, off) < 2e-3);
  options.isClamped = false;
  CHECK(smoothed(scherk, options).positions == without.positions);
}

TEST_CASE("smoothSurface: normals that are none are told with their edges") {
  const TestMesh disc = fanMesh(12);
  const std::vector<double> up = normalsAlong(disc, 12, [](Vec3) { return Vec3{0, 0, 1}; });
  const auto outcomeOf = [&](const std::vector<double>& normals) {
    Work work;
    SmoothSurface result;
    return smoothSurface(disc.view(), clamped(SurfaceKind::Curvature, normals), work, result);
  };
  CHECK(outcomeOf(up).ok());
  const Outcome few = outcomeOf({});
  CHECK(few.status == Status::BadNormalCount);
  CHECK(few.vertex == 12);
  const Vec3 along = pointAt(disc.positions, 0) - pointAt(disc.positions, 11);
  const double huge = std::numeric_limits<double>::infinity();
  for (const Vec3 wrong : {Vec3{0, 0, 0}, Vec3{std::nan(""), 0, 1}, Vec3{huge, 0, 1}, along}) {
    std::vector<double> normals = up;
    normals[33] = wrong.x, normals[34] = wrong.y, normals[35] = wrong.z;
    const Outcome outcome = outcomeOf(normals);
    CHECK(outcome.status == Status::BadNormals);
    CHECK(outcome.vertex == 11);
    CHECK(outcome.otherLoop == 0);
    CHECK(outcome.otherVertex == 11);
  }
}

TEST_CASE("smoothSurface: fixed vertices stay, and the surface goes through them") {
  TestMesh sheet = saddleMesh(8, 0);
  const uint32_t middle = 4 * 9 + 4;
  sheet.positions[3 * middle + 2] = 0.2;
  // One on the boundary, and one twice.
  const std::vector<uint32_t> fixed{middle, 0, middle, 4 * 9 + 6};
  for (const SurfaceKind kind :
       {SurfaceKind::SoapFilm, SurfaceKind::ThinPlate, SurfaceKind::Curvature}) {
    CAPTURE(int(kind));
    SmoothOptions options;
    options.kind = kind, options.fixed = fixed;
    const SmoothSurface surface = smoothed(sheet, options);
    REQUIRE(surface.fixed == std::vector<uint32_t>{middle, 4 * 9 + 6});
    CHECK(surface.boundary.size() == 32);
    CHECK(std::count(surface.triangles.begin(), surface.triangles.end(), 32u) >= 3);
    CHECK(surface.positions[3 * 33 + 2] == 0);
    // Near the first one it is up, and not only there.
    CHECK(surface.area > 4.001);
  }
  Work work;
  SmoothSurface result;
  SmoothOptions options;
  const std::vector<uint32_t> beyond{81};
  options.fixed = beyond;
  CHECK(smoothSurface(sheet.view(), options, work, result).status == Status::BadOption);
}

TEST_CASE("smoothSurface: an edge of three faces is told with its ends") {
  TestMesh mesh = saddleMesh(3, 0.2);
  mesh.addVertex({0, 0, 5});
  const uint32_t a = mesh.faces[0], b = mesh.faces[1], c = mesh.faces[2];
  for (const auto& [from, to] : {std::pair(b, c), std::pair(c, a)}) {
    TestMesh three = mesh;
    three.addFace(from, to, 16);
    Work work;
    SmoothSurface result;
    const Outcome outcome = smoothSurface(three.view(), {}, work, result);
    CHECK(outcome.status == Status::BadSurface);
    CHECK(outcome.vertex < 19);
    CHECK(outcome.otherLoop == std::min(from, to));
    CHECK(outcome.otherVertex == std::max(from, to));
  }
}
