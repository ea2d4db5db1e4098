#include "polygon/fill/trapezoidation.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "base/predicates.h"
#include "support/polygon_oracle.h"
#include "support/visibility_oracle.h"

using namespace sf;
using namespace sftest;

namespace {

struct Input {
  Polygon polygon;
  std::vector<Point> islands;
};

/// Valid polygons without touches, as the oracle of sight needs them.
Input randomInput(Random& random) {
  for (;;) {
    Input input;
    if (random.chance(0.2)) {
      const GriddedBlob blob = blobWithGrid(8 + random.below(60), 2 + random.below(8), random);
      input = {blob.polygon, blob.inner};
    } else if (random.chance(0.2)) {
      input.polygon =
          holeGrid(1 + random.below(3), 1 + random.below(3), random.chance(0.5), random);
    } else {
      input.polygon = smallPolygon(random);
    }
    bool repeated = false;
    std::vector<Point> points;
    for (uint32_t v = 0; v < input.polygon.vertexCount(); ++v)
      points.push_back(input.polygon.point(v));
    const auto less = [](Point p, Point q) { return below({p.x, p.y}, {q.x, q.y}); };
    std::sort(points.begin(), points.end(), less);
    for (size_t i = 1; i < points.size(); ++i) repeated |= points[i] == points[i - 1];
    if (!repeated && !hasTouches(input.polygon)) return input;
  }
}

double twiceAreaOf(const LinkedPolygon& p) {
  double area = 0;
  for (uint32_t v = 0; v < p.at.size(); ++v) {
    const Point2 a = p.at[v], b = p.at[p.next[v]];
    area += a.x * b.y - b.x * a.y;
  }
  return area;
}

// Where an edge crosses a height.
double crossing(const LinkedPolygon& p, uint32_t low, uint32_t high, double y) {
  const Point2 a = p.at[low], b = p.at[high];
  return b.y > a.y ? a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)) : a.x;
}

std::vector<uint32_t> triangulate(const Sight& sight, bool delaunay, bool forStrips) {
  TrapezoidTriangulator triangulator;
  Work work;
  std::vector<uint32_t> triangles;
  REQUIRE(triangulator.triangulate(sight.linked, sight.seen, delaunay, forStrips, work, triangles));
  CHECK(work.used() == 0);
  return triangles;
}

/// With islands: the triangles' boundary and area are the polygon's, none is turned over or flat,
/// and each vertex is used.
std::string faultWithIslands(const LinkedPolygon& p, const std::vector<uint32_t>& triangles) {
  std::vector<std::pair<uint32_t, uint32_t>> edges;
  std::vector<bool> used(p.at.size(), false);
  for (size_t h = 0; h < triangles.size(); ++h) {
    const uint32_t a = triangles[h], b = triangles[h % 3 == 2 ? h - 2 : h + 1];
    used[a] = true;
    if (p.next[a] != b) edges.push_back({std::min(a, b), std::max(a, b)});
  }
  for (size_t t = 0; t < triangles.size(); t += 3) {
    const Point2 a = p.at[triangles[t]], b = p.at[triangles[t + 1]], c = p.at[triangles[t + 2]];
    if (orient2d(a.x, a.y, b.x, b.y, c.x, c.y) <= 0) return "turned over or flat";
  }
  std::sort(edges.begin(), edges.end());
  for (size_t i = 0; i < edges.size(); i += 2)
    if (i + 1 == edges.size() || edges[i] != edges[i + 1] ||
        (i + 2 < edges.size() && edges[i + 2] == edges[i]))
      return "an inner edge not used twice";
  if (std::find(used.begin(), used.end(), false) != used.end()) return "a vertex not used";
  return "";
}

/// What Seidel's program makes of uni-monotone polygons: convex corners cut off along the chain.
/// Source: Fournier, Montuno 1984.
std::vector<uint32_t> cutAlongChains(const Sight& sight) {
  UniMonotonePolygons polygons;
  Work work;
  REQUIRE(findUniMonotonePolygons(sight.linked, sight.seen, true, work, polygons));
  std::vector<uint32_t> triangles;
  for (uint32_t e = 0; e + 1 < polygons.starts.size(); ++e) {
    std::vector<uint32_t> stack;
    for (uint32_t i = polygons.starts[e]; i < polygons.starts[e + 1]; ++i) {
      const uint32_t v = polygons.chain[i];
      while (stack.size() > 1) {
        uint32_t a = stack[stack.size() - 2], b = stack.back();
        if (e & 1) std::swap(a, b);  // the chain to the left of its base: v, b, a is its order
        const Point2 p = sight.linked.at[a], q = sight.linked.at[b], r = sight.linked.at[v];
        if (orient2d(p.x, p.y, q.x, q.y, r.x, r.y) <= 0) break;
        triangles.insert(triangles.end(), {a, b, v});
        stack.pop_back();
      }
      stack.push_back(v);
    }
  }
  return triangles;
}

struct Quality {
  double angle;     // the mean over triangles of the smallest angle, in degrees
  uint32_t degree;  // the largest number of triangles at a vertex
};
Quality qualityOf(const LinkedPolygon& p, const std::vector<uint32_t>& triangles) {
  std::vector<uint32_t> degrees(p.at.size(), 0);
  double sum = 0;
  for (size_t t = 0; t < triangles.size(); t += 3) {
    double least = 180;
    for (size_t k = 0; k < 3; ++k) {
      ++degrees[triangles[t + k]];
      const Point2 a = p.at[triangles[t + k]], b = p.at[triangles[t + (k + 1) % 3]];
      const Point2 c = p.at[triangles[t + (k + 2) % 3]];
      const double x = b.x - a.x, y = b.y - a.y, u = c.x - a.x, w = c.y - a.y;
      least = std::min(least, std::atan2(x * w - y * u, x * u + y * w) * 57.29577951308232);
    }
    sum += least;
  }
  return {sum / (double(triangles.size()) / 3), *std::max_element(degrees.begin(), degrees.end())};
}

}  // namespace

TEST_CASE("trapezoidation: trapezoids cover the polygon") {
  constexpr uint32_t kSeed = 4000;
  CAPTURE(kSeed);
  Random random(kSeed);
  for (int instance = 0; instance < 300; ++instance) {
    CAPTURE(instance);
    const Input input = randomInput(random);
    const Sight sight = lookAround(input.polygon, input.islands);
    const LinkedPolygon& p = sight.linked;
    std::vector<Trapezoid> trapezoids;
    Work work;
    REQUIRE(findTrapezoids(p, sight.seen, work, trapezoids));
    uint32_t expected = 0;
    for (const VertexKind kind : p.kind)
      expected += kind == VertexKind::Top ? 2 : kind == VertexKind::Bottom ? 0 : 1;
    CHECK(trapezoids.size() == expected);
    double area = 0;
    for (const Trapezoid& t : trapezoids) {
      CHECK(below(p.at[t.bottom], p.at[t.top]));
      const double y0 = p.at[t.bottom].y, y1 = p.at[t.top].y;
      const uint32_t l = t.left, r = t.right;
      area += (y1 - y0) * (crossing(p, r, p.next[r], y0) - crossing(p, l, p.prev[l], y0) +
                           crossing(p, r, p.next[r], y1) - crossing(p, l, p.prev[l], y1));
    }
    CHECK(area == doctest::Approx(twiceAreaOf(p)).epsilon(1e-6));
  }
}

TEST_CASE(
    "trapezoidation: polygons between diagonals are uni-monotone, each on an edge as its base") {
  constexpr uint32_t kSeed = 4001;
  CAPTURE(kSeed);
  Random random(kSeed);
  uint32_t longest = 0;
  for (int instance = 0; instance < 300; ++instance) {
    CAPTURE(instance);
    const Input input = randomInput(random);
    const Sight sight = lookAround(input.polygon, input.islands);
    const LinkedPolygon& p = sight.linked;
    UniMonotonePolygons polygons;
    std::vector<Trapezoid> trapezoids;
    Work work;
    REQUIRE(findUniMonotonePolygons(p, sight.seen, true, work, polygons));
    REQUIRE(findTrapezoids(p, sight.seen, work, trapezoids));
    // All sides of the polygons but bases: the diagonals, from both of their sides, and short
    // edges.
    std::vector<std::pair<uint32_t, uint32_t>> sides, diagonals;
    uint32_t triangles = 0;
    for (uint32_t e = 0; e + 1 < polygons.starts.size(); ++e) {
      const uint32_t first = polygons.starts[e], end = polygons.starts[e + 1];
      if (first == end) continue;
      triangles += end - first - 2;
      longest = std::max(longest, end - first);
      const uint32_t low = polygons.chain[first], high = polygons.chain[end - 1];
      CHECK((e & 1 ? p.next[low] : p.prev[low]) == high);
      CHECK(low == e / 2);
      for (uint32_t i = first; i + 1 < end; ++i) {
        const uint32_t a = polygons.chain[i], b = polygons.chain[i + 1];
        CHECK(below(p.at[a], p.at[b]));
        if (p.next[a] != b && p.prev[a] != b) sides.push_back({a, b});
        if (i == first) continue;
        const int side =
            orient2d(p.at[low].x, p.at[low].y, p.at[high].x, p.at[high].y, p.at[a].x, p.at[a].y);
        CHECK(side == (e & 1 ? 1 : -1));
      }
    }
    for (const Trapezoid& t : trapezoids)
      if (p.next[t.bottom] != t.top && p.prev[t.bottom] != t.top)
        for (int twice = 0; twice < 2; ++twice) diagonals.push_back({t.bottom, t.top});
    std::sort(sides.begin(), sides.end());
    std::sort(diagonals.begin(), diagonals.end());
    CHECK(sides == diagonals);
    CHECK(triangles == input.polygon.vertexCount() + 2 * input.polygon.ringCount() - 4 +
                           2 * uint32_t(input.islands.size()));
  }
  CHECK(longest > 10);
}

TEST_CASE("trapezoidation: triangles cover polygons exactly, with and without flips") {
  constexpr uint32_t kSeed = 4002;
  CAPTURE(kSeed);
  Random random(kSeed);
  for (int instance = 0; instance < 1500; ++instance) {
    CAPTURE(instance);
    Input input = randomInput(random);
    input.islands.clear();
    const Sight sight = lookAround(input.polygon);
    const bool delaunay = instance % 3 > 0;
    const std::string fault =
        faultOfTriangulation(input.polygon, triangulate(sight, delaunay, instance % 2 == 1));
    if (!fault.empty()) FAIL(fault << ": " << describe(input.polygon));
  }
}

TEST_CASE("trapezoidation: islands become vertices of the triangles") {
  constexpr uint32_t kSeed = 4003;
  CAPTURE(kSeed);
  Random random(kSeed);
  for (int instance = 0; instance < 300; ++instance) {
    CAPTURE(instance);
    const bool grid = random.chance(0.5);
    GriddedBlob blob = blobWithGrid(5 + random.below(60), 2 + random.below(10), random);
    if (!grid)
      for (Point& p : blob.inner)
        p = {p.x + random.range(-5e-7, 5e-7), p.y + random.range(-5e-7, 5e-7)};
    const Sight sight = lookAround(blob.polygon, blob.inner);
    const std::vector<uint32_t> triangles = triangulate(sight, instance % 3 > 0, instance % 2 == 1);
    CHECK(triangles.size() / 3 == blob.polygon.vertexCount() - 2 + 2 * blob.inner.size());
    CHECK(faultWithIslands(sight.linked, triangles) == "");
  }
}

TEST_CASE("trapezoidation: islands may be as close together as there are numbers") {
  const double tiny = std::numeric_limits<double>::denorm_min();
  const Polygon square = polygonOf({{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}});
  const Sight sight = lookAround(square, {{0, 0}, {tiny, 0}, {0, tiny}});
  const std::vector<uint32_t> triangles = triangulate(sight, true, false);
  CHECK(triangles.size() / 3 == 2 + 2 * 3);
  CHECK(faultWithIslands(sight.linked, triangles) == "");
}

TEST_CASE("trapezoidation: if wanted the triangles are constrained Delaunay") {
  constexpr uint32_t kSeed = 4004;
  CAPTURE(kSeed);
  Random random(kSeed);
  for (int instance = 0; instance < 200; ++instance) {
    CAPTURE(instance);
    const Input input = randomInput(random);
    const Sight sight = lookAround(input.polygon, input.islands);
    TriangleMesh mesh;
    mesh.at = mesh.metric = sight.linked.at;
    mesh.corners = triangulate(sight, true, false);
    Work work;
    REQUIRE(findTwins(mesh.corners, uint32_t(mesh.at.size()), work, mesh.twins));
    for (uint32_t h = 0; h < mesh.corners.size(); ++h) CHECK(!mesh.isIllegal(h));
  }
}

TEST_CASE("trapezoidation: angles are more than half way from Seidel's to Delaunay triangles") {
  constexpr uint32_t kSeed = 4005;
  CAPTURE(kSeed);
  Random random(kSeed);
  const auto check = [&](const char* name, const Polygon& polygon) {
    CAPTURE(name);
    const Sight sight = lookAround(polygon);
    const Quality seidel = qualityOf(sight.linked, cutAlongChains(sight));
    const Quality tree = qualityOf(sight.linked, triangulate(sight, false, false));
    const Quality forStrips = qualityOf(sight.linked, triangulate(sight, true, true));
    const Quality delaunay = qualityOf(sight.linked, triangulate(sight, true, false));
    MESSAGE(std::string(name), ": Seidel ", seidel.angle, ", u-tree ", tree.angle, ", for strips ",
            forStrips.angle, ", Delaunay ", delaunay.angle, " degrees; most at a vertex ",
            seidel.degree, ", ", tree.degree, ", ", forStrips.degree, ", ", delaunay.degree);
    CHECK(tree.angle >= seidel.angle);
    CHECK(forStrips.angle - seidel.angle >= 0.5 * (delaunay.angle - seidel.angle));
    CHECK(forStrips.degree <= delaunay.degree + 2);
    return forStrips.angle;
  };
  double simple = 0;
  for (int i = 0; i < 5; ++i) simple += check("simple", polygonOf({partitionRing(1000, random)}));
  CHECK(simple / 5 >= 14.4);
  check("star", polygonOf({starRing(1000, 0.5, random)}));
  check("blob", polygonOf({blobRing(1000, random)}));
  check("Koch", polygonOf({kochRing(4)}));
  check("turned holes", holeGrid(8, 8, false, random));
  check("aligned holes", holeGrid(8, 8, true, random));
  check("stars in holes", starsInHoles(4, 4, 10, random));
}

TEST_CASE("trapezoidation: blobs with a grid have the angles of the paper's table") {
  constexpr uint32_t kSeed = 4006;
  CAPTURE(kSeed);
  Random random(kSeed);
  double angles = 0;
  for (int i = 0; i < 10; ++i) {
    const GriddedBlob blob = blobWithGrid(100, 20, random);
    const Sight sight = lookAround(blob.polygon, blob.inner);
    const Quality result = qualityOf(sight.linked, triangulate(sight, true, true));
    const Quality delaunay = qualityOf(sight.linked, triangulate(sight, true, false));
    CHECK(result.degree <= delaunay.degree + 2);
    angles += result.angle;
  }
  CHECK(angles / 10 >= 33.7);
}
