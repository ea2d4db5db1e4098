#include "polygon/delaunay_insertion.h"

#include <doctest/doctest.h>

#include "polygon/triangle_mesh.h"
#include "support/polygon_oracle.h"
#include "support/visibility_oracle.h"

using namespace sf;
using namespace sftest;

namespace {

/// Edges that a constrained Delaunay triangulation may not have.
uint32_t illegalEdges(const LinkedPolygon& p, const std::vector<uint32_t>& triangles) {
  TriangleMesh mesh;
  mesh.at = mesh.metric = p.at;
  mesh.corners = triangles;
  Work work;
  REQUIRE(findTwins(mesh.corners, uint32_t(p.at.size()), work, mesh.twins));
  uint32_t count = 0;
  for (uint32_t h = 0; h < mesh.corners.size(); ++h) count += mesh.isIllegal(h);
  return count;
}

}  // namespace

TEST_CASE("delaunay insertion: polygons are covered by constrained Delaunay triangles") {
  constexpr uint32_t kSeed = 4300;
  CAPTURE(kSeed);
  Random random(kSeed);
  int done = 0;
  for (int instance = 0; instance < 400; ++instance) {
    CAPTURE(instance);
    const Polygon polygon = instance % 4 == 0
                                ? holeGrid(1 + random.below(4), 1 + random.below(4), false, random)
                                : smallPolygon(random);
    if (hasTouches(polygon)) continue;
    const Sight sight = lookAround(polygon);
    std::vector<uint32_t> triangles;
    Work work;
    if (!delaunayByInsertion(sight.linked, work, triangles)) continue;  // repeated vertices
    ++done;
    CHECK(work.used() == 0);
    CHECK(faultOfTriangulation(polygon, triangles) == "");
    CHECK(illegalEdges(sight.linked, triangles) == 0);
  }
  CHECK(done > 300);
}

TEST_CASE("delaunay insertion: islands are vertices, and coordinates of any magnitude do") {
  constexpr uint32_t kSeed = 4301;
  CAPTURE(kSeed);
  Random random(kSeed);
  for (const double scale : {1.0, 0x1p480, 0x1p-480}) {
    CAPTURE(scale);
    GriddedBlob blob = blobWithGrid(60, 12, random);
    blob.polygon = scaledBy(blob.polygon, scale);
    for (Point& p : blob.inner) p = {p.x * scale, p.y * scale};
    const Sight sight = lookAround(blob.polygon, blob.inner);
    std::vector<uint32_t> triangles;
    Work work;
    REQUIRE(delaunayByInsertion(sight.linked, work, triangles));
    CHECK(triangles.size() / 3 == blob.polygon.vertexCount() - 2 + 2 * blob.inner.size());
  }
}

TEST_CASE("delaunay insertion: a smooth curve of many vertices, where flips would be O(n^2)") {
  Random random(4302);
  const Polygon polygon = polygonOf({blobRing(3000, random)});
  const Sight sight = lookAround(polygon);
  Work work;
  std::vector<uint32_t> triangles;
  REQUIRE(delaunayByInsertion(sight.linked, work, triangles));
  CHECK(triangles.size() / 3 == 2998);
  CHECK(illegalEdges(sight.linked, triangles) == 0);
}

TEST_CASE("delaunay insertion: coinciding nodes and limits leave the triangles as they were") {
  const std::vector<uint32_t> before = {7, 8, 9};
  std::vector<uint32_t> triangles = before;
  Random random(4303);
  Sight sight = lookAround(polygonOf({starRing(30, 0.5, random)}));
  Work little(1000, nullptr, nullptr);
  CHECK(!delaunayByInsertion(sight.linked, little, triangles));
  CHECK(little.status() == Status::OutOfMemory);
  CHECK(triangles == before);
  sight.linked.at[3] = sight.linked.at[17];
  Work work;
  CHECK(!delaunayByInsertion(sight.linked, work, triangles));
  CHECK(work.going());
  CHECK(triangles == before);
}
