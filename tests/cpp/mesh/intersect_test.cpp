#include "mesh/intersect.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>

#include "support/patches.h"
#include "support/self_intersection.h"

using namespace sftest;
using sf::FacePair;
using sf::MeshView;
using sf::TriangleTree;
using sf::Vec3;
using sf::Work;

namespace {

/// All pairs by an oracle with arithmetic of its own.
std::vector<FacePair> allPairs(const Sheet& sheet) {
  std::vector<FacePair> pairs;
  std::vector<Vec3> points;
  for (uint32_t v = 0; v < sheet.positions.size() / 3; ++v) points.push_back(sheet.at(v));
  const auto isFlat = [&](uint32_t t) {
    const uint32_t* v = &sheet.triangles[3 * t];
    return collinear(points[v[0]], points[v[1]], points[v[2]]);
  };
  for (uint32_t i = 0; i < sheet.triangles.size() / 3; ++i)
    for (uint32_t j = i + 1; j < sheet.triangles.size() / 3 && !isFlat(i); ++j) {
      if (isFlat(j)) continue;
      std::vector<uint32_t> two(sheet.triangles.begin() + 3 * i,
                                sheet.triangles.begin() + 3 * i + 3);
      two.insert(two.end(), sheet.triangles.begin() + 3 * j, sheet.triangles.begin() + 3 * j + 3);
      // The oracle takes triangles on the same vertices for two sides of one.
      const std::set<uint32_t> vertices(two.begin(), two.end());
      if (vertices.size() == 3 || findCrossing(points, two).found) pairs.push_back({i, j});
    }
  return pairs;
}

std::vector<FacePair> foundPairs(const Sheet& sheet) {
  std::vector<FacePair> pairs;
  Work work;
  REQUIRE(sf::findSelfIntersections({sheet.positions, sheet.triangles}, 0,
                                    uint32_t(sheet.triangles.size() / 3), size_t(-1), work, pairs));
  CHECK(work.used() == 0);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Triangles on points of a lattice. Equal points get one number, as the oracle asks for it.
Sheet latticeSoup(std::mt19937& random, uint32_t triangles, uint32_t size, bool isPlane) {
  Sheet sheet;
  for (uint32_t z = 0; z < (isPlane ? 1 : size); ++z)
    for (uint32_t y = 0; y < size; ++y)
      for (uint32_t x = 0; x < size; ++x)
        sheet.positions.insert(sheet.positions.end(), {double(x), double(y), double(z) + x});
  const uint32_t n = uint32_t(sheet.positions.size() / 3);
  for (uint32_t i = 0; i < 3 * triangles; ++i) sheet.triangles.push_back(uint32_t(random() % n));
  return sheet;
}

bool meet(std::initializer_list<Vec3> six) {
  const Vec3* p = six.begin();
  bool result = false;
  // Whatever the order of the triangles and of their vertices, it is the same.
  for (int turn = 0; turn < 36; ++turn) {
    const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    const int *i = orders[turn % 6], *j = orders[turn / 6];
    const Vec3 a[3] = {p[i[0]], p[i[1]], p[i[2]]}, b[3] = {p[3 + j[0]], p[3 + j[1]], p[3 + j[2]]};
    const bool now = sf::trianglesIntersect(a, b);
    if (turn == 0) result = now;
    CHECK(now == result);
    CHECK(sf::trianglesIntersect(b, a) == result);
  }
  return result;
}

}  // namespace

TEST_CASE("intersect: two triangles apart, through each other, and touching") {
  const Vec3 a{0, 0, 0}, b{4, 0, 0}, c{0, 4, 0};
  CHECK_FALSE(meet({a, b, c, {0, 0, 1}, {4, 0, 1}, {0, 4, 1}}));
  CHECK_FALSE(meet({a, b, c, {5, 5, -1}, {5, 5, 1}, {6, 6, 0}}));
  CHECK(meet({a, b, c, {1, 1, -1}, {1, 1, 1}, {9, 9, 0}}));
  CHECK(meet({a, b, c, {1, 1, 0}, {1, 1, 1}, {1, 2, 1}}));    // a vertex inside
  CHECK(meet({a, b, c, {1, 0, 0}, {1, -1, 1}, {1, -1, 2}}));  // a vertex on a side
  CHECK(meet({a, b, c, {2, 2, -1}, {2, 2, 1}, {5, 5, 0}}));   // a side through a side
  CHECK_FALSE(meet({a, b, c, {1, 1, 0x1p-60}, {1, 1, 1}, {1, 2, 1}}));
}

TEST_CASE("intersect: triangles that share a vertex") {
  const Vec3 o{0, 0, 0}, b{4, 0, 0}, c{0, 4, 0};
  CHECK_FALSE(meet({o, b, c, o, {-1, 0, 1}, {0, -1, 1}}));
  CHECK_FALSE(meet({o, b, c, o, {1, 1, 1}, {2, 1, 1}}));      // above, from the same vertex
  CHECK(meet({o, b, c, o, {1, 1, -1}, {1, 1, 1}}));           // through it, from the vertex on
  CHECK(meet({o, b, c, o, {1, 1, 0}, {1, 1, 1}}));            // a side inside
  CHECK(meet({o, b, c, o, {2, 0, 0}, {1, 1, 1}}));            // a side along a side
  CHECK(meet({o, b, c, o, {9, 0, 0}, {1, -1, 1}}));           // a longer one
  CHECK_FALSE(meet({o, b, c, o, {-1, -1, 0}, {-1, -2, 0}}));  // coplanar, opposite
  CHECK(meet({o, b, c, o, {1, 2, 0}, {-3, 2, 0}}));           // coplanar, overlapping
  CHECK(meet({o, b, c, o, {9, -1, 0}, {-1, 9, 0}}));          // coplanar, around it
}

TEST_CASE("intersect: triangles that share a side, and all three vertices") {
  const Vec3 a{0, 0, 0}, b{4, 0, 0}, c{0, 4, 0};
  CHECK_FALSE(meet({a, b, c, b, a, {1, -1, 0}}));
  CHECK_FALSE(meet({a, b, c, b, a, {1, 1, 1}}));
  CHECK_FALSE(meet({a, b, c, b, a, {1, 1, 0x1p-60}}));
  CHECK(meet({a, b, c, b, a, {1, 1, 0}}));
  CHECK(meet({a, b, c, b, a, {9, 9, 0}}));
  CHECK(meet({a, b, c, c, b, a}));
}

TEST_CASE("intersect: triangles without area intersect nothing") {
  const Vec3 a{0, 0, 0}, b{4, 0, 0}, c{0, 4, 0};
  CHECK_FALSE(meet({a, b, c, {1, 1, -1}, {1, 1, 1}, {1, 1, 0}}));
  CHECK_FALSE(meet({a, b, c, a, a, b}));
}

TEST_CASE("intersect: the same pairs as by brute force, on lattices full of coincidences") {
  std::mt19937 random(7);
  size_t pairs = 0;
  for (int round = 0; round < 60; ++round) {
    const Sheet sheet = latticeSoup(random, 24, 2 + round % 4, round % 3 == 0);
    const std::vector<FacePair> expected = allPairs(sheet), found = foundPairs(sheet);
    CHECK(found == expected);
    pairs += expected.size();
  }
  CHECK(pairs > 1000);
}

TEST_CASE(
    "intersect: the same pairs as by brute force, for a rough surface in any size and place") {
  std::mt19937 random(3);
  for (const double size : {1.0, 1e-120, 1e120}) {
    for (const double far : {0.0, 1e6}) {
      Sheet sheet = graphSheet(
          12, [&](double, double) { return 0.4 * double(random()) / 4294967296.0; }, 0.9, 5);
      for (size_t i = 0; i < sheet.positions.size(); ++i)
        sheet.positions[i] = size * (sheet.positions[i] + far);
      const std::vector<FacePair> found = foundPairs(sheet);
      CHECK(found.size() > 10);
      // The oracle's own range is smaller.
      for (double& x : sheet.positions) x *= size > 1 ? 0x1p-400 : size < 1 ? 0x1p400 : 1;
      CHECK(found == allPairs(sheet));
    }
  }
}

TEST_CASE("intersect: smooth surfaces do not intersect themselves") {
  CHECK(foundPairs(sphereSheet(4)).empty());
  CHECK(foundPairs(torusSheet(40, 20, 1, 0.4)).empty());
  CHECK(foundPairs(graphSheet(30, [](double, double) { return 0.0; })).empty());
}

TEST_CASE("intersect: one surface against the tree of another, before and after it moved") {
  const Sheet sphere = sphereSheet(3);
  Sheet sheet = graphSheet(20, [](double, double) { return 0.0; });
  const MeshView mesh{sphere.positions, sphere.triangles};
  const uint32_t faces = uint32_t(sheet.triangles.size() / 3),
                 all = uint32_t(sphere.triangles.size() / 3);
  Work work;
  {
    sf::Charge charge(work);
    TriangleTree tree;
    REQUIRE(tree.build(mesh, 0, all, work, charge));
    for (const double height : {0.3, 1.2, 0.99}) {
      for (size_t v = 2; v < sheet.positions.size(); v += 3) sheet.positions[v] = height;
      std::vector<FacePair> pairs, expected;
      REQUIRE(sf::findIntersections({sheet.positions, sheet.triangles}, 0, faces, mesh, tree,
                                    size_t(-1), work, pairs));
      for (uint32_t f = 0; f < faces; ++f)
        for (uint32_t g = 0; g < all; ++g) {
          Vec3 a[3], b[3];
          for (uint32_t k = 0; k < 3; ++k)
            a[k] = sheet.at(sheet.triangles[3 * f + k]),
            b[k] = sphere.at(sphere.triangles[3 * g + k]);
          if (sf::trianglesIntersect(a, b)) expected.push_back({f, g});
        }
      std::sort(pairs.begin(), pairs.end());
      CHECK(pairs == expected);
      CHECK(pairs.empty() == (height > 1));
      // No more than asked for.
      std::vector<FacePair> few;
      REQUIRE(sf::findIntersections({sheet.positions, sheet.triangles}, 0, faces, mesh, tree, 3,
                                    work, few));
      CHECK(few.size() == std::min<size_t>(3, pairs.size()));
    }
    // Refitted, the tree is that of the other positions.
    std::vector<double> moved = sphere.positions;
    for (size_t v = 2; v < moved.size(); v += 3) moved[v] += 10;
    tree.refit({moved, sphere.triangles});
    std::vector<FacePair> pairs;
    REQUIRE(sf::findIntersections({sheet.positions, sheet.triangles}, 0, faces,
                                  {moved, sphere.triangles}, tree, size_t(-1), work, pairs));
    CHECK(pairs.empty());
  }
  CHECK(work.used() == 0);
}

TEST_CASE("intersect: work that may not go on ends, and frees what it holds") {
  const Sheet sheet = sphereSheet(4);
  for (const size_t bytes : {size_t(0), size_t(1000), size_t(300'000)}) {
    Work work(bytes, nullptr, nullptr);
    std::vector<FacePair> pairs;
    CHECK_FALSE(sf::findSelfIntersections({sheet.positions, sheet.triangles}, 0,
                                          uint32_t(sheet.triangles.size() / 3), size_t(-1), work,
                                          pairs));
    CHECK(work.status() == sf::Status::OutOfMemory);
    CHECK(work.used() == 0);
  }
}
