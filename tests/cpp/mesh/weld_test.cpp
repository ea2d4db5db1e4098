#include "mesh/weld.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "mesh/adjacency.h"
#include "support/meshes.h"

using namespace sf;
using namespace sftest;

namespace {

WeldedMesh welded(const TestMesh& mesh, double radius) {
  Work work;
  WeldedMesh result;
  {
    Charge charge(work);
    REQUIRE(weldVertices(mesh.view(), radius, work, charge, result));
  }
  CHECK(work.used() == 0);
  return result;
}

size_t componentsOf(const WeldedMesh& mesh) {
  Work work;
  Charge charge(work);
  Adjacency a;
  REQUIRE(buildAdjacency(mesh.view(), work, charge, a));
  return a.defects.empty() ? a.components : 0;
}

}  // namespace

TEST_CASE("weldVertices: a soup becomes the mesh that it was") {
  for (const double scale : {1.0, 1e-200, 1e149}) {
    const TestMesh mesh = mapped(torusMesh(9, 14), [&](Vec3 p) { return scale * p; });
    const WeldedMesh result = welded(soup(mesh), 0);
    CHECK(result.positions.size() == mesh.positions.size());
    CHECK(componentsOf(result) == 1);
  }
  CHECK(welded({}, 0).positions.empty());
}

TEST_CASE("weldVertices: 0 and -0 are the same place") {
  const WeldedMesh result = welded({{0, 1, 0, -0.0, 1, -0.0, 2, 2, 2}, {0, 1, 2}}, 0);
  CHECK(result.vertexMap == std::vector<uint32_t>{0, 0, 1});
  CHECK(result.faces == std::vector<uint32_t>{0, 0, 1});
}

TEST_CASE("weldVertices: within a radius, the first vertex stays where it is") {
  MESSAGE("seed 51");
  Random random(51);
  const TestMesh mesh = soup(sphereMesh(3));
  const WeldedMesh result = welded(noisy(mesh, 1e-4, random), 4e-4);
  CHECK(result.positions.size() == sphereMesh(3).positions.size());
  CHECK(componentsOf(result) == 1);
}

TEST_CASE("weldVertices: by comparing all pairs") {
  MESSAGE("seed 53");
  Random random(53);
  for (int i = 0; i < 300; ++i) {
    TestMesh mesh;
    const double radius = random.chance(0.2) ? 0 : random.range(0.001, 0.5);
    for (uint32_t v = random.below(60); v > 0; --v) {
      const Vec3 p = random.inCube(1);
      mesh.addVertex(random.chance(0.5) ? Vec3{std::round(p.x), std::round(p.y), 0} : p);
    }
    const WeldedMesh result = welded(mesh, radius);
    std::vector<uint32_t> kept;
    for (uint32_t v = 0; v < mesh.vertexCount(); ++v) {
      const auto at = std::find_if(kept.begin(), kept.end(), [&](uint32_t k) {
        return length((1 / std::max(radius, 1e-300)) * (mesh.at(k) - mesh.at(v))) <= 1;
      });
      CHECK(result.vertexMap[v] == uint32_t(at - kept.begin()));
      if (at == kept.end()) kept.push_back(v);
    }
    CHECK(result.positions.size() == 3 * kept.size());
  }
}
