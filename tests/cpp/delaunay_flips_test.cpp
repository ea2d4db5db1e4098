// Constrained Delaunay triangles by flips: exact areas, the criterion at every edge, stable ties.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/predicates.h"
#include "polygon/delaunay_flips.h"
#include "polygon/triangulate.h"
#include "support/polygon_generators.h"
#include "support/polygon_oracle.h"

using namespace sftest;

namespace {

sf::PolygonTriangulation triangulate(const Polygon& polygon, bool delaunay,
                                     sf::PolygonMethod method = sf::PolygonMethod::Flooding) {
  sf::PolygonOptions options;
  options.delaunay = delaunay;
  options.method = method;
  sf::PolygonTriangulation result;
  sf::Work work;
  REQUIRE(
      sf::triangulatePolygon({polygon.positions, polygon.starts, {}}, options, work, result).ok());
  CHECK(work.used() == 0);
  return result;
}

/// Edges between two triangles whose far corners lie in each other's circle.
int illegalEdges(const Polygon& polygon, const std::vector<uint32_t>& triangles) {
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> apexOf;
  for (size_t i = 0; i < triangles.size(); ++i) {
    const size_t t = i - i % 3;
    apexOf[{triangles[i], triangles[t + (i + 1) % 3]}] = triangles[t + (i + 2) % 3];
  }
  int illegal = 0;
  for (const auto& [edge, apex] : apexOf) {
    const auto twin = apexOf.find({edge.second, edge.first});
    if (twin == apexOf.end()) continue;
    const Point a = polygon.point(edge.first), b = polygon.point(edge.second);
    const Point c = polygon.point(apex), d = polygon.point(twin->second);
    illegal += sf::incircle(a.x, a.y, b.x, b.y, c.x, c.y, d.x, d.y) > 0;
  }
  return illegal;
}

std::vector<std::vector<uint32_t>> sorted(const std::vector<uint32_t>& triangles) {
  std::vector<std::vector<uint32_t>> result;
  for (size_t i = 0; i < triangles.size(); i += 3) {
    std::vector<uint32_t> t(triangles.begin() + ptrdiff_t(i), triangles.begin() + ptrdiff_t(i + 3));
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    result.push_back(t);
  }
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace

TEST_CASE("delaunay flips: every edge is legal, and the polygon covered exactly") {
  int before = 0;
  for (uint32_t seed = 1; seed <= 800; ++seed) {
    Random random(seed);
    const Polygon polygon = smallPolygon(random);
    if (hasTouches(polygon)) continue;
    const std::vector<uint32_t> triangles = triangulate(polygon, true).triangles;
    INFO("seed ", seed, " ", describe(polygon));
    CHECK(faultOfTriangulation(polygon, triangles) == "");
    CHECK(illegalEdges(polygon, triangles) == 0);
    before += illegalEdges(polygon, triangulate(polygon, false).triangles);
  }
  CHECK(before > 1000);
}

TEST_CASE("delaunay flips: rings that touch are covered exactly too") {
  for (uint32_t seed = 1; seed <= 400; ++seed) {
    Random random(seed);
    const Polygon polygon = latticeRegion(3 + seed % 6, 4 + seed % 40, false, true, random);
    if (faultsOf(polygon) != kValid) continue;
    INFO("seed ", seed, " ", describe(polygon));
    CHECK(faultOfTriangulation(polygon, triangulate(polygon, true).triangles) == "");
  }
}

TEST_CASE("delaunay flips: without ties the triangles do not depend on the method") {
  for (uint32_t seed = 1; seed <= 60; ++seed) {
    Random random(seed);
    const Polygon polygon = seed % 2 ? polygonOf({partitionRing(20 + 10 * seed, random)})
                                     : polygonOf({starRing(20 + 10 * seed, 0.8, random)});
    INFO("seed ", seed);
    CHECK(sorted(triangulate(polygon, true).triangles) ==
          sorted(triangulate(polygon, true, sf::PolygonMethod::Trapezoids).triangles));
  }
}

TEST_CASE("delaunay flips: points on one circle stay as they were") {
  const Polygon polygon = polygonOf({{{5, 0},
                                      {4, 3},
                                      {3, 4},
                                      {0, 5},
                                      {-3, 4},
                                      {-4, 3},
                                      {-5, 0},
                                      {-4, -3},
                                      {-3, -4},
                                      {0, -5},
                                      {3, -4},
                                      {4, -3}}});
  CHECK(triangulate(polygon, true).triangles == triangulate(polygon, false).triangles);
  Random random(2);
  const Polygon grid = holeGrid(4, 4, true, random);
  const std::vector<uint32_t> once = triangulate(grid, true).triangles;
  CHECK(triangulate(grid, true).triangles == once);
  CHECK(illegalEdges(grid, once) == 0);
}

TEST_CASE("delaunay flips: a smooth curve, where flips alone would be O(n) a vertex") {
  Random random(4);
  const Polygon polygon = polygonOf({blobRing(3000, random)});
  const std::vector<uint32_t> triangles = triangulate(polygon, true).triangles;
  CHECK(faultOfTriangulation(polygon, triangles) == "");
  CHECK(illegalEdges(polygon, triangles) == 0);
}

TEST_CASE("delaunay flips: coordinates of any magnitude keep their triangles") {
  Random random(6);
  const Polygon polygon = polygonOf({partitionRing(120, random)});
  const auto expected = sorted(triangulate(polygon, true).triangles);
  for (const int exponent : {-480, -200, -40, 40, 200, 480}) {
    INFO("2^", exponent);
    CHECK(sorted(triangulate(scaledBy(polygon, std::ldexp(1, exponent)), true).triangles) ==
          expected);
  }
}
