#include "polygon/strips/strip_flips.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <set>

#include "polygon/fill/trapezoidation.h"
#include "polygon/strips/strips.h"
#include "support/visibility_oracle.h"

using namespace sf;
using namespace sftest;

namespace {

using Edge = std::array<uint32_t, 2>;

struct Mesh {
  Buffer<Point2> at;
  TriangleMesh triangles;
};

/// Triangles with angles as good as flips make them, before any are flipped for strips.
Mesh triangulate(const Polygon& polygon) {
  const Sight sight = lookAround(polygon, {});
  TrapezoidTriangulator triangulator;
  Work work;
  Mesh mesh;
  mesh.at = sight.linked.at;
  std::vector<uint32_t>& corners = mesh.triangles.corners;
  REQUIRE(triangulator.triangulate(sight.linked, sight.seen, true, false, work, corners));
  REQUIRE(findTwins(corners, uint32_t(mesh.at.size()), work, mesh.triangles.twins));
  mesh.triangles.at = mesh.triangles.metric = mesh.at;
  return mesh;
}

std::multiset<Edge> boundary(const TriangleMesh& mesh) {
  std::multiset<Edge> edges;
  for (uint32_t h = 0; h < mesh.corners.size(); ++h)
    if (mesh.twins[h] == kNone) edges.insert({mesh.from(h), mesh.to(h)});
  return edges;
}

struct StripCounts {
  size_t indices, strips;
};
StripCounts stripsOf(const TriangleMesh& mesh) {
  Work work;
  std::vector<uint32_t> vertices, starts;
  REQUIRE(makeStrips(mesh.corners, mesh.twins, work, vertices, starts));
  return {vertices.size(), starts.size() - 1};
}

Polygon randomPolygon(int kind, Random& random) {
  switch (kind % 5) {
    case 0:
      return polygonOf({partitionRing(3 + random.below(200), random)});
    case 1:
      return polygonOf({combRing(1 + random.below(60), random)});
    case 2:
      return polygonOf({interleavedCombRing(1 + random.below(20), random)});
    case 3:
      return polygonOf({starRing(3 + random.below(100), 1, random)});
    default:
      return starsInHoles(1 + random.below(3), 1 + random.below(3), 5, random);
  }
}

}  // namespace

TEST_CASE("strip flips: the triangles still cover the polygon") {
  constexpr uint32_t kSeed = 4300;
  CAPTURE(kSeed);
  Random random(kSeed);
  for (int instance = 0; instance < 200; ++instance) {
    CAPTURE(instance);
    Mesh mesh = triangulate(randomPolygon(instance, random));
    const std::multiset<Edge> before = boundary(mesh.triangles);
    StripFlips flips;
    Work work;
    REQUIRE(flips.run(mesh.triangles, work));
    CHECK(work.used() == 0);
    const TriangleMesh& after = mesh.triangles;
    // Positive triangles with that boundary cover what they covered, once.
    CHECK(boundary(after) == before);
    for (uint32_t h = 0; h < after.corners.size(); ++h) {
      CHECK(after.orient(after.from(h), after.to(h), after.apex(h)) == 1);
      if (after.twins[h] == kNone) continue;
      CHECK(after.twins[after.twins[h]] == h);
      CHECK(after.from(after.twins[h]) == after.to(h));
      CHECK(after.to(after.twins[h]) == after.from(h));
    }
  }
}

TEST_CASE("strip flips: costs carried along are those found anew, and none rises") {
  constexpr uint32_t kSeed = 4301;
  CAPTURE(kSeed);
  Random random(kSeed);
  size_t saved = 0;
  for (int instance = 0; instance < 300; ++instance) {
    CAPTURE(instance);
    const int kind = instance % 5 == 4 ? 0 : instance;  // without holes: the forest is all there is
    Mesh mesh = triangulate(randomPolygon(kind, random));
    const size_t before = stripsOf(mesh.triangles).indices;
    StripFlips flips;
    Work work;
    REQUIRE(flips.run(mesh.triangles, work));
    StripForest forest;
    REQUIRE(forest.grow(mesh.triangles.twins, work));
    CHECK(flips.cost() == forest.total());
    const StripCounts after = stripsOf(mesh.triangles);
    CHECK(after.indices <= before);
    saved += before - after.indices;
    // That is an index for each beyond one a triangle, and one for each strip.
    const size_t count = mesh.triangles.corners.size() / 3;
    CHECK(forest.total() == int64_t(StripForest::kIndex * (after.indices - count) + after.strips));
  }
  CHECK(saved > 300);
}

TEST_CASE("strip flips: end when the work does, and give memory back") {
  constexpr uint32_t kSeed = 4302;
  CAPTURE(kSeed);
  Random random(kSeed);
  Mesh mesh = triangulate(polygonOf({partitionRing(300, random)}));
  Work small(100, nullptr, nullptr);
  StripFlips flips;
  CHECK(!flips.run(mesh.triangles, small));
  CHECK(small.status() == Status::OutOfMemory);
  CHECK(small.used() == 0);
}
