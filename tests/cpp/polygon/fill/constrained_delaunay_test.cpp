// Constrained Delaunay triangles: exact areas, the criterion at every edge, stable ties.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/predicates.h"
#include "base/turn.h"
#include "polygon/fill/constrained_delaunay.h"
#include "polygon/sweep/complement.h"
#include "polygon/triangulate.h"
#include "support/polygon_generators.h"
#include "support/polygon_oracle.h"

using namespace sftest;

namespace {

/// Delaunay triangles with isolated points, which are numbered after the polygon's vertices.
std::vector<uint32_t> triangulateAround(const Polygon& polygon, const std::vector<double>& points) {
  sf::PolygonOptions options;
  options.delaunay = options.verify = true;
  sf::PolygonTriangulation result;
  sf::Work work;
  REQUIRE(sf::triangulatePolygon({polygon.positions, polygon.starts, points}, options, work, result)
              .ok());
  CHECK(result.triangles.size() / 3 == polygon.vertexCount() - 2 + points.size());
  return result.triangles;
}

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

/// Checks triangles and twins of a Flood after ConstrainedDelaunay::runFlooded, node by node: where rings
/// touch, several nodes are at one place. Returns how many edges were looked at.
int checkFlooded(const sf::LinkedPolygon& loops, const sf::Visibility& seen) {
  sf::Work work;
  sf::Charge charge(work);
  sf::Flood flood;
  sf::ConstrainedDelaunay delaunay;
  REQUIRE(flood.run(loops, seen, work, charge, nullptr, true));
  const std::vector<uint32_t> before(flood.triangles().begin(), flood.triangles().end());
  REQUIRE(delaunay.runFlooded(loops, work, flood));
  const sf::ArrayView<uint32_t> corners = flood.triangles();
  const sf::ClosableTwins& twins = flood.twins();
  CHECK(corners.size() == before.size());
  if (corners.size() < 6) return 0;
  CHECK(twins.end == twins.outside + 2);
  int looked = 0, wrong = 0;
  for (uint32_t h = 0; h < corners.size(); ++h) {
    const uint32_t g = twins.of[h];
    const auto at = [&](uint32_t corner) { return loops.at[corners[corner]]; };
    const sf::Point2 a = at(sf::nextInTriangle(h)), b = at(sf::prevInTriangle(h)), c = at(h);
    wrong += !(sf::turn(a, b, c) > 0);
    if (g == twins.outside) continue;
    ++looked;
    if (g >= corners.size() || twins.of[g] != h ||
        corners[sf::nextInTriangle(g)] != corners[sf::prevInTriangle(h)]) {
      ++wrong;
      continue;
    }
    const sf::Point2 d = at(g);
    wrong += sf::incircle(a.x, a.y, b.x, b.y, c.x, c.y, d.x, d.y) > 0;
  }
  CHECK(wrong == 0);
  return looked;
}

/// The same for a polygon, for what is around it, and for that as a sweep of its own finds it.
int checkBothSides(const Polygon& polygon, const std::vector<double>& points, bool& turned) {
  sf::PlaneSweep sweep;
  sf::LinkedPolygon loops, around;
  sf::Visibility seen, seenAround;
  sf::Work work;
  const sf::PolygonView view{polygon.positions, polygon.starts, points};
  REQUIRE(sweep.run(view, true, true, work, loops, seen).ok());
  turned = loops.turned;
  int looked = checkFlooded(loops, seen);
  if (sweep.isPlain()) {
    sf::takeComplement(loops, seen, around, seenAround);
    looked += checkFlooded(around, seenAround);
  }
  REQUIRE(sweep.runComplement(view, work, around, seenAround).ok());
  return looked + checkFlooded(around, seenAround);
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

TEST_CASE("constrained delaunay: every edge is legal, and the polygon covered exactly") {
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

TEST_CASE("constrained delaunay: rings that touch are covered exactly too") {
  for (uint32_t seed = 1; seed <= 400; ++seed) {
    Random random(seed);
    const Polygon polygon = latticeRegion(3 + seed % 6, 4 + seed % 40, false, true, random);
    if (faultsOf(polygon) != kValid) continue;
    INFO("seed ", seed, " ", describe(polygon));
    CHECK(faultOfTriangulation(polygon, triangulate(polygon, true).triangles) == "");
  }
}

TEST_CASE(
    "constrained delaunay: legal node by node, where rings touch, turned, and around polygons") {
  int looked = 0, quarters = 0;
  for (uint32_t seed = 1; seed <= 500; ++seed) {
    Random random(seed);
    Polygon polygon;
    std::vector<double> points;
    switch (seed % 5) {
      case 0:
        polygon = rewritten(smallPolygon(random), random);
        break;
      case 1:
        polygon = latticeRegion(3 + seed % 9, 4 + seed % 90, seed % 2 == 0, true, random);
        break;
      case 2:
        polygon = polygonOf({combRing(5 + random.below(60), random)});
        break;
      case 3:
        polygon = starsInHoles(2, 2, 5 + random.below(20), random);
        break;
      default:
        polygon = polygonOf({regularRing(3 + random.below(40), 1, {0, 0}, 0.1)});
        for (uint32_t i = random.below(200); i > 0; --i) {
          const double radius = 0.49 * std::sqrt(random.unit()), angle = random.range(0, 6.28);
          points.insert(points.end(), {radius * std::cos(angle), radius * std::sin(angle)});
        }
    }
    if (points.empty() && faultsOf(polygon) != kValid) continue;
    INFO("seed ", seed, " ", describe(polygon));
    bool turned = false;
    looked += checkBothSides(polygon, points, turned);
    quarters += turned;
  }
  CHECK(looked > 50'000);
  CHECK(quarters > 50);
}

TEST_CASE("constrained delaunay: without ties the triangles do not depend on the method") {
  for (uint32_t seed = 1; seed <= 60; ++seed) {
    Random random(seed);
    const Polygon polygon = seed % 2 ? polygonOf({partitionRing(20 + 10 * seed, random)})
                                     : polygonOf({starRing(20 + 10 * seed, 0.8, random)});
    INFO("seed ", seed);
    CHECK(sorted(triangulate(polygon, true).triangles) ==
          sorted(triangulate(polygon, true, sf::PolygonMethod::Trapezoids).triangles));
  }
}

TEST_CASE("constrained delaunay: points on one circle stay as they were") {
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

TEST_CASE("constrained delaunay: a smooth curve, where flips would be O(n) a vertex") {
  Random random(4);
  const Polygon polygon = polygonOf({blobRing(3000, random)});
  const std::vector<uint32_t> triangles = triangulate(polygon, true).triangles;
  CHECK(faultOfTriangulation(polygon, triangles) == "");
  CHECK(illegalEdges(polygon, triangles) == 0);
}

TEST_CASE("constrained delaunay: coordinates of any magnitude keep their triangles") {
  Random random(6);
  const Polygon polygon = polygonOf({partitionRing(120, random)});
  const auto expected = sorted(triangulate(polygon, true).triangles);
  for (const int exponent : {-480, -200, -40, 40, 200, 480}) {
    INFO("2^", exponent);
    CHECK(sorted(triangulate(scaledBy(polygon, std::ldexp(1, exponent)), true).triangles) ==
          expected);
  }
}

TEST_CASE("constrained delaunay: holes and isolated points, where merges could meet themselves") {
  constexpr uint32_t kSeed = 4300;
  CAPTURE(kSeed);
  Random random(kSeed);
  for (int instance = 0; instance < 60; ++instance) {
    CAPTURE(instance);
    const Polygon polygon = instance % 2 == 0
                                ? holeGrid(1 + random.below(6), 1 + random.below(6), false, random)
                                : starsInHoles(2, 2, 5 + random.below(20), random);
    const std::vector<uint32_t> triangles = triangulate(polygon, true).triangles;
    CHECK(faultOfTriangulation(polygon, triangles) == "");
    CHECK(illegalEdges(polygon, triangles) == 0);
  }
  for (const double scale : {1.0, 0x1p480, 0x1p-480}) {
    CAPTURE(scale);
    GriddedBlob blob = blobWithGrid(60, 12, random);
    std::vector<double> points;
    Polygon all = scaledBy(blob.polygon, scale);
    const Polygon polygon = all;
    for (const Point p : blob.inner) points.insert(points.end(), {p.x * scale, p.y * scale});
    all.positions.insert(all.positions.end(), points.begin(), points.end());
    const std::vector<uint32_t> triangles = triangulateAround(polygon, points);
    if (scale == 1) CHECK(illegalEdges(all, triangles) == 0);
  }
}

TEST_CASE(
    "constrained delaunay: many isolated points, around which blocks are connected both ways") {
  constexpr uint32_t kSeed = 4320;
  CAPTURE(kSeed);
  Random random(kSeed);
  for (int instance = 0; instance < 40; ++instance) {
    CAPTURE(instance);
    const Polygon polygon = polygonOf({regularRing(3 + random.below(40), 1, {0, 0}, 0.1)});
    Polygon all = polygon;
    std::vector<double> points;
    const uint32_t count = 20 + random.below(400);
    for (uint32_t i = 0; i < count; ++i) {
      const double radius = 0.49 * std::sqrt(random.unit()), angle = random.range(0, 6.28);
      points.insert(points.end(), {radius * std::cos(angle), radius * std::sin(angle)});
    }
    all.positions.insert(all.positions.end(), points.begin(), points.end());
    CHECK(illegalEdges(all, triangulateAround(polygon, points)) == 0);
  }
}

TEST_CASE("constrained delaunay: every family is covered, every edge legal") {
  Random random(4304);
  for (const Polygon& polygon :
       {polygonOf({spiralRing(400, 5)}), polygonOf({kochRing(4)}),
        polygonOf({combRing(100, random)}), polygonOf({doubleCombRing(60, random)}),
        polygonOf({interleavedCombRing(60, random)}), polygonOf({blobRing(500, random)}),
        polygonOf({zigzagRing(300, random)}), polygonOf({fanRing(300, random)}),
        polygonOf({staircaseRing(100)}), polygonOf({regularRing(200, 1, {0, 0})})}) {
    const std::vector<uint32_t> triangles = triangulate(polygon, true).triangles;
    CHECK(faultOfTriangulation(polygon, triangles) == "");
    CHECK(illegalEdges(polygon, triangles) == 0);
  }
}

TEST_CASE(
    "constrained delaunay: magnitudes too far apart for exact circles are covered all the same") {
  const Polygon polygon = polygonOf({{{-0x1p-300, 0},
                                      {0x1p-301, 0x1p-300},
                                      {0x1p490, 0x1p480},
                                      {0x1p491, 0x1p492},
                                      {-0x1p489, 0x1p488}}});
  CHECK(faultOfTriangulation(polygon, triangulate(polygon, true).triangles) == "");
  // Many triangles, so that there are edges between blocks too.
  int far = 0;
  for (uint32_t seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    Polygon large = polygonOf({partitionRing(300, random)});
    double* least = &large.positions[0];
    for (double& x : large.positions)
      if (std::fabs(x) < std::fabs(*least)) least = &x;
    *least = 0x1p-300;
    if (faultsOf(large) != kValid) continue;
    INFO("seed ", seed);
    CHECK(faultOfTriangulation(large, triangulate(large, true).triangles) == "");
    ++far;
  }
  CHECK(far > 20);
}

TEST_CASE("constrained delaunay: memory beyond the limit is told, and work that ends") {
  Random random(4305);
  const Polygon polygon = polygonOf({blobRing(2000, random)});
  sf::PolygonOptions options;
  options.delaunay = true;
  sf::PolygonTriangulation result;
  for (const size_t limit : {size_t(200'000), size_t(300'000)}) {
    sf::Work little(limit, nullptr, nullptr);
    const sf::Outcome outcome =
        sf::triangulatePolygon({polygon.positions, polygon.starts, {}}, options, little, result);
    CHECK(outcome.status == sf::Status::OutOfMemory);
    CHECK(little.used() == 0);
  }
  sf::Work stopped(
      size_t(-1), [](void*, double, double, double) { return false; }, nullptr);
  const Polygon large = polygonOf({blobRing(20'000, random)});
  CHECK(sf::triangulatePolygon({large.positions, large.starts, {}}, options, stopped, result)
            .status == sf::Status::Stopped);
}
