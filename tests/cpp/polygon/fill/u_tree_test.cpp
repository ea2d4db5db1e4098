#include "polygon/fill/u_tree.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "base/predicates.h"
#include "polygon/input/polygon.h"
#include "support/polygon_oracle.h"

using namespace sf;
using namespace sftest;

namespace {

std::vector<uint32_t> numbers(uint32_t n) {
  std::vector<uint32_t> result;
  for (uint32_t i = 0; i < n; ++i) result.push_back(i);
  return result;
}

/// The triangles of a chain of points whose base runs from the first point to the last.
std::vector<uint32_t> triangulate(const Ring& chain, bool left) {
  std::vector<uint32_t> triangles(3 * chain.size());
  UTree tree;
  const std::vector<uint32_t> all = numbers(uint32_t(chain.size()));
  std::vector<Point2> at;
  for (const Point p : chain) at.push_back({p.x, p.y});
  uint32_t* end = tree.triangulate(at, all, left, triangles.data());
  triangles.resize(size_t(end - triangles.data()));
  return triangles;
}

int orient(Point a, Point b, Point c) { return orient2d(a.x, a.y, b.x, b.y, c.x, c.y); }

/// A chain monotone along y, all on one side of its base: random points, or points of a lattice.
Ring randomChain(uint32_t n, uint32_t lattice, bool left, Random& random) {
  const auto coordinate = [&] {
    return lattice == 0 ? random.range(-1, 1) : double(random.below(lattice)) / lattice;
  };
  Ring chain;
  while (chain.size() < 2) {
    Point a{coordinate(), coordinate()}, b{coordinate(), coordinate()};
    if (below({a.x, a.y}, {b.x, b.y})) chain = {a, b};
  }
  const Point a = chain[0], b = chain[1];
  for (uint32_t tries = 0; chain.size() < n && tries < 40 * n; ++tries) {
    const Point p{coordinate(), coordinate()};
    if (!below({a.x, a.y}, {p.x, p.y}) || !below({p.x, p.y}, {b.x, b.y})) continue;
    if (orient(a, b, p) != (left ? 1 : -1)) continue;
    if (std::find(chain.begin(), chain.end(), p) == chain.end()) chain.push_back(p);
  }
  std::sort(chain.begin(), chain.end(), [](Point p, Point q) {
    return below({p.x, p.y}, {q.x, q.y});
  });
  return chain;
}

/// The ring of a chain and its base, counter-clockwise: what its triangles have to cover.
Polygon closed(Ring chain, bool left) {
  if (!left) return polygonOf({chain});
  // With the chain to the left, going back down along the chain is counter-clockwise.
  std::reverse(chain.begin(), chain.end());
  return polygonOf({chain});
}
std::vector<uint32_t> renumbered(std::vector<uint32_t> triangles, uint32_t n, bool left) {
  if (left)
    for (uint32_t& v : triangles) v = n - 1 - v;
  return triangles;
}

}  // namespace

TEST_CASE("u-tree: every uni-monotone polygon is covered exactly") {
  constexpr uint32_t kSeed = 4100;
  CAPTURE(kSeed);
  Random random(kSeed);
  uint32_t largest = 0;
  for (int instance = 0; instance < 3000; ++instance) {
    CAPTURE(instance);
    const bool left = random.chance(0.5);
    const uint32_t lattice = random.chance(0.5) ? 3 + random.below(10) : 0;
    const Ring chain = randomChain(3 + random.below(40), lattice, left, random);
    const uint32_t n = uint32_t(chain.size());
    if (n < 3) continue;
    largest = std::max(largest, n);
    const std::vector<uint32_t> triangles = triangulate(chain, left);
    const std::string fault =
        faultOfTriangulation(closed(chain, left), renumbered(triangles, n, left));
    if (!fault.empty()) FAIL(fault << ": " << describe(closed(chain, left)));
  }
  CHECK(largest > 30);
}

TEST_CASE("u-tree: a root is the vertex nearest to its base, and the sides are the next bases") {
  constexpr uint32_t kSeed = 4101;
  CAPTURE(kSeed);
  Random random(kSeed);
  for (int instance = 0; instance < 200; ++instance) {
    const Ring chain = randomChain(4 + random.below(20), 0, true, random);
    if (chain.size() < 4) continue;
    const uint32_t last = uint32_t(chain.size()) - 1;
    const std::vector<uint32_t> triangles = triangulate(chain, true);
    for (size_t t = 0; t < triangles.size(); t += 3) {
      uint32_t v[3] = {triangles[t], triangles[t + 1], triangles[t + 2]};
      std::sort(v, v + 3);
      // No vertex of the chain between the ends is nearer to the base than the middle one.
      for (uint32_t i = v[0] + 1; i < v[2]; ++i)
        CHECK(turn2d(chain[0].x, chain[0].y, chain[last].x, chain[last].y, chain[v[1]].x,
                     chain[v[1]].y, chain[i].x, chain[i].y) >= 0);
    }
  }
}

TEST_CASE(
    "u-tree: a chain without local minima becomes one strip, from the nearer side each time") {
  // Two slopes up to a summit: the next vertex of the strip is the nearer of top's and bottom's
  // next.
  const Ring chain = {{0, 0}, {-1, 1}, {-3, 2}, {-5, 3}, {-4, 4}, {-2, 5}, {0, 6}};
  const std::vector<uint32_t> triangles = triangulate(chain, true);
  const std::vector<uint32_t> expected = {0, 6, 1, 1, 6, 5, 1, 5, 2, 2, 5, 4, 2, 4, 3};
  CHECK(triangles == expected);
}

TEST_CASE("u-tree: equally near vertices make no flat triangles") {
  Ring comb = {{0, 0}};
  for (int i = 1; i < 20; ++i) comb.push_back({i % 2 == 0 ? 1.0 : 2.0, double(i)});
  comb.push_back({0, 20});
  for (const bool left : {false, true}) {
    Ring chain = comb;
    if (left)
      for (Point& p : chain) p.x = -p.x;
    const std::vector<uint32_t> triangles = triangulate(chain, left);
    CHECK(faultOfTriangulation(closed(chain, left), renumbered(triangles, 21, left)) == "");
  }
}

TEST_CASE("u-tree: long chains of every shape take linear time and little stack") {
  constexpr uint32_t kCount = 200000;
  for (int shape = 0; shape < 4; ++shape) {
    CAPTURE(shape);
    Ring chain = {{0, 0}};
    for (uint32_t i = 1; i + 1 < kCount; ++i) {
      const double x[4] = {double(i), double(kCount - i), 1.0 + (i % 2), 1.0 + (i & -i)};
      chain.push_back({x[shape], double(i)});
    }
    chain.push_back({0, double(kCount)});
    const std::vector<uint32_t> triangles = triangulate(chain, false);
    REQUIRE(triangles.size() == 3 * (kCount - 2));
    uint32_t turned = 0;
    for (size_t t = 0; t < triangles.size(); t += 3)
      turned += orient(chain[triangles[t]], chain[triangles[t + 1]], chain[triangles[t + 2]]) <= 0;
    CHECK(turned == 0);
  }
}
