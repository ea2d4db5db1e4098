#include "triangles/locate.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "base/turn.h"
#include "support/generators.h"

using namespace sf;
using namespace sftest;

namespace {

/// A square's lattice of n x n cells, each of two triangles, divided one way or the other.
struct Lattice {
  std::vector<Point2> at;
  TriangleMesh mesh;

  Lattice(uint32_t n, Random& random) {
    for (uint32_t y = 0; y <= n; ++y)
      for (uint32_t x = 0; x <= n; ++x) at.push_back({double(x), double(y)});
    const auto vertex = [&](uint32_t x, uint32_t y) { return y * (n + 1) + x; };
    for (uint32_t y = 0; y < n; ++y)
      for (uint32_t x = 0; x < n; ++x) {
        const uint32_t a = vertex(x, y), b = vertex(x + 1, y), c = vertex(x + 1, y + 1),
                       d = vertex(x, y + 1);
        if (random.chance(0.5))
          mesh.corners.insert(mesh.corners.end(), {a, b, c, a, c, d});
        else
          mesh.corners.insert(mesh.corners.end(), {a, b, d, b, c, d});
      }
    mesh.at = mesh.metric = at;
    Work work;
    REQUIRE(findTwins(mesh.corners, uint32_t(at.size()), work, mesh.twins));
  }

  /// Whether the triangle of h holds p, by its three turns.
  bool holds(uint32_t h, Point2 p) const {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t e = h / 3 * 3 + k;
      if (turn(at[mesh.from(e)], at[mesh.to(e)], p) < 0) return false;
    }
    return true;
  }
};

}  // namespace

TEST_CASE("locate: a triangle that holds the point, on an edge exactly where that is so") {
  Random random(910);
  MESSAGE("seed 910");
  const Lattice lattice(12, random);
  Locator locator;
  for (int i = 0; i < 2000; ++i) {
    // Quarters: often on edges, or on vertices.
    const Point2 p{random.below(49) / 4.0, random.below(49) / 4.0};
    const uint32_t from = random.below(uint32_t(lattice.mesh.corners.size()));
    const TriangleMesh::Place place = locator.locate(lattice.mesh, from, p);
    REQUIRE(place.edge != kNone);
    CHECK(lattice.holds(place.edge, p));
    const uint32_t a = lattice.mesh.from(place.edge), b = lattice.mesh.to(place.edge);
    bool isOnSome = false;
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t e = place.edge / 3 * 3 + k;
      isOnSome |= turn(lattice.at[lattice.mesh.from(e)], lattice.at[lattice.mesh.to(e)], p) == 0;
    }
    CHECK(place.onEdge == isOnSome);
    if (place.onEdge) CHECK(turn(lattice.at[a], lattice.at[b], p) == 0);
  }
}

TEST_CASE("locate: nothing outside of the triangles, and a walk of few steps may give up") {
  Random random(911);
  const Lattice lattice(12, random);
  Locator locator;
  CHECK(locator.locate(lattice.mesh, 0, {-1, 3}).edge == kNone);
  CHECK(locator.walk(lattice.mesh, 0, {12.5, 12}, 1000).edge == kNone);
  CHECK(locator.walk(lattice.mesh, 0, {11.6, 11.7}, 3).edge == kNone);
  CHECK(locator.walk(lattice.mesh, 0, {11.6, 11.7}, 1000).edge != kNone);
}

TEST_CASE("locate: where a boundary is in the way every triangle is looked at") {
  // Two triangles that have nothing in common.
  const std::vector<Point2> at{{0, 0}, {1, 0}, {0, 1}, {5, 0}, {6, 0}, {5, 1}};
  TriangleMesh mesh;
  mesh.at = mesh.metric = at;
  mesh.corners = {0, 1, 2, 3, 4, 5};
  mesh.twins.assign(6, kNone);
  Locator locator;
  CHECK(locator.walk(mesh, 0, {5.2, 0.2}, 100).edge == kNone);
  CHECK(locator.locate(mesh, 0, {5.2, 0.2}).edge / 3 == 1);
}
