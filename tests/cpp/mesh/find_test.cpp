#include "mesh/find.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "support/meshes.h"

using namespace sf;
using namespace sftest;

namespace {

struct Found {
  Adjacency adjacency;
  Rims rims;
};

Found find(const TestMesh& mesh) {
  Work work;
  Found found;
  {
    Charge charge(work);
    REQUIRE(buildAdjacency(mesh.view(), work, charge, found.adjacency));
    REQUIRE(findRims(mesh.view(), found.adjacency, work, charge, found.rims));
  }
  CHECK(work.used() == 0);
  return found;
}

using Loop = std::vector<uint32_t>;

Loop loopOf(const Rims& rims, uint32_t r) {
  return {rims.vertices.begin() + rims.starts[r], rims.vertices.begin() + rims.starts[r + 1]};
}

/// What is wrong with rims of an oriented mesh, by definition.
std::string faultOf(const TestMesh& mesh, const Found& found) {
  const Rims& r = found.rims;
  const Adjacency& a = found.adjacency;
  if (r.starts.size() != r.count() + 1 || r.starts.back() != r.vertices.size()) return "starts";
  if (r.halves.size() != r.vertices.size() || r.normals.size() != r.vertices.size()) return "sizes";
  std::set<uint32_t> used, touched;
  for (const RimTouch& t : r.touches) {
    const uint32_t rim = r.rimOf(t.before);
    if (r.vertices[r.nextEdge(rim, t.before)] != r.vertices[t.after]) return "a touch";
    if (rim == r.rimOf(t.after)) return "a touch of one rim";
    if (!touched.insert(t.after).second) return "an edge after two touches";
    if (&t != r.touches.data() && (&t)[-1].before >= t.before) return "the order of touches";
  }
  uint32_t slits = 0;
  for (uint32_t i = 0; i < r.count(); ++i) {
    const Loop loop = loopOf(r, i);
    if (loop.size() < 3) return "a short rim";
    if (std::set<uint32_t>(loop.begin(), loop.end()).size() != loop.size()) return "a vertex twice";
    double length = 0, diameter = 0;
    for (uint32_t e = r.starts[i]; e < r.starts[i + 1]; ++e) {
      const uint32_t h = r.halves[e], v = r.vertices[e], w = r.vertices[r.nextEdge(i, e)];
      if (!used.insert(h).second) return "a half-edge twice";
      if (a.twins[h] != kNone || a.corners[h] == kNone) return "a half-edge inside";
      const bool isAgainst = a.tail(h) == v && a.head(h) == w;
      if (isAgainst ? !r.rims[i].crossesSeam : a.tail(h) != w || a.head(h) != v) return "an edge";
      if (e == r.starts[i] && a.component[h / 3] != r.rims[i].component) return "a component";
      length += distance(mesh.at(v), mesh.at(w));
      const Vec3 n = cross(mesh.at(a.tail(h + 1 - h % 3)) - mesh.at(a.tail(h - h % 3)),
                           mesh.at(a.tail(h + 2 - h % 3)) - mesh.at(a.tail(h - h % 3)));
      if (sf::length(n) > 1e-6 && sf::length((1 / sf::length(n)) * n - r.normals[e]) > 1e-9 &&
          !isAgainst && !r.rims[i].crossesSeam)
        return "a normal";
      for (const uint32_t u : loop) diameter = std::max(diameter, distance(mesh.at(u), mesh.at(v)));
    }
    if (std::fabs(length - r.rims[i].length) > 1e-9 * length) return "a length";
    if (std::fabs(diameter - r.rims[i].diameter) > 1e-9 * diameter) return "a diameter";
  }
  for (uint32_t h = 0; h < a.twins.size(); ++h) {
    const bool isOpen = a.corners[h] != kNone && a.twins[h] == kNone && a.acrossSeam(h) == kNone;
    if (isOpen && !used.count(h)) ++slits;
  }
  // Only cuts can leave slits.
  if (slits > 0 && a.cut.empty()) return "an edge of no rim";
  return "";
}

std::vector<size_t> sizesOf(const Rims& rims) {
  std::vector<size_t> sizes;
  for (uint32_t r = 0; r < rims.count(); ++r) sizes.push_back(rims.starts[r + 1] - rims.starts[r]);
  std::sort(sizes.begin(), sizes.end());
  return sizes;
}

/// A fan of triangles around vertex 0, in the plane or not, from `first` degrees over `count` steps.
void addFan(TestMesh& mesh, double first, double step, uint32_t count, double z = 0,
            bool isTurned = false) {
  uint32_t last = kNone;
  for (uint32_t i = 0; i <= count; ++i) {
    const double u = (first + i * step) * kPi / 180;
    const uint32_t v = mesh.addVertex({std::cos(u), std::sin(u), z});
    if (i > 0) isTurned ? mesh.addFace(0, v, last) : mesh.addFace(0, last, v);
    last = v;
  }
}

}  // namespace

TEST_CASE("findRims: none of closed meshes") {
  for (const TestMesh& mesh : {sphereMesh(2), torusMesh(9, 14), boxMesh(3), TestMesh{}})
    CHECK(find(mesh).rims.count() == 0);
}

TEST_CASE("findRims: a rim runs as faces that fill it would") {
  TestMesh mesh = boxMesh(1);
  const uint32_t a = mesh.faces[0], b = mesh.faces[1], c = mesh.faces[2];
  mesh.faces.erase(mesh.faces.begin(), mesh.faces.begin() + 3);
  const Found found = find(mesh);
  CHECK(faultOf(mesh, found) == "");
  REQUIRE(found.rims.count() == 1);
  Loop loop = loopOf(found.rims, 0);
  std::rotate(loop.begin(), std::find(loop.begin(), loop.end(), a), loop.end());
  CHECK(loop == Loop{a, b, c});
}

TEST_CASE("findRims: lengths and diameters of a tube's ends, at any scale") {
  for (const double scale : {1.0, 1e-160, 3e148}) {
    const Found found = find(mapped(tubeMesh(64, 3, 2), [&](Vec3 p) { return scale * p; }));
    REQUIRE(found.rims.count() == 2);
    for (const Rim& rim : found.rims.rims) {
      CHECK(rim.length / scale == doctest::Approx(128 * std::sin(kPi / 64)));
      CHECK(rim.diameter / scale == doctest::Approx(2));
      CHECK(!rim.isSeam);
    }
  }
}

TEST_CASE("findRims: the diameter of a long rim is nearly right") {
  const Found found = find(tubeMesh(5000, 1, 0.1));
  REQUIRE(found.rims.count() == 2);
  CHECK(found.rims.rims[0].diameter <= 2 + 1e-9);
  CHECK(found.rims.rims[0].diameter > 1.99);
}

TEST_CASE("findRims: meshes with faces missing at random have all their open edges in rims") {
  MESSAGE("seed 23");
  Random random(23);
  for (int i = 0; i < 60; ++i) {
    const TestMesh whole = i % 3 == 0 ? sphereMesh(3) : i % 3 == 1 ? torusMesh(12, 20) : boxMesh(5);
    const double share = random.range(0.01, 0.7);
    TestMesh mesh = without(whole, [&](Vec3) { return random.chance(share); });
    std::vector<uint32_t> from;
    mesh = shuffled(mesh, random, from);
    const Found found = find(mesh);
    CHECK(faultOf(mesh, found) == "");
    CHECK(found.rims.vertices.size() == openEdges(mesh).size());
  }
}

TEST_CASE("findRims: any faces at all give simple rims") {
  MESSAGE("seed 29");
  Random random(29);
  for (int i = 0; i < 3000; ++i) {
    TestMesh mesh;
    const uint32_t n = 1 + random.below(9), m = random.below(30);
    for (uint32_t v = 0; v < n; ++v) mesh.addVertex(random.inCube(1));
    for (uint32_t f = 0; f < m; ++f) {
      const uint32_t a = random.below(n), b = random.below(n);
      mesh.addFace(a, b, random.below(n));
    }
    CHECK_MESSAGE(faultOf(mesh, find(mesh)) == "", "mesh ", i);
  }
}

TEST_CASE("findRims: two holes that touch in a vertex are two") {
  const TestMesh sheet = saddleMesh(8, 0.2);
  // Squares on both sides of the vertex in the middle.
  const TestMesh mesh = without(sheet, [](Vec3 p) {
    return (p.x > 0 && p.y > 0 && p.x < 0.5 && p.y < 0.5) ||
           (p.x < 0 && p.y < 0 && p.x > -0.5 && p.y > -0.5);
  });
  const Found found = find(mesh);
  CHECK(faultOf(mesh, found) == "");
  CHECK(sizesOf(found.rims) == std::vector<size_t>{8, 8, 32});
}

TEST_CASE("findRims: around a vertex of several gaps, every gap has its own rim") {
  for (uint32_t gaps = 2; gaps <= 6; ++gaps) {
    // A disk around the vertex, in which every other triangle is missing, with a second ring.
    TestMesh mesh;
    mesh.addVertex({0, 0, 0});
    const uint32_t n = 2 * gaps + 2;
    for (uint32_t ring = 1; ring <= 2; ++ring)
      for (uint32_t i = 0; i < n; ++i)
        mesh.addVertex({ring * std::cos(2 * kPi * i / n), ring * std::sin(2 * kPi * i / n), 0});
    for (uint32_t i = 0; i < n; ++i) {
      const uint32_t a = 1 + i, b = 1 + (i + 1) % n;
      if (i % 2 == 0 || i / 2 >= gaps) mesh.addFace(0, a, b);
      mesh.addFace(a, a + n, b + n), mesh.addFace(a, b + n, b);
    }
    const Found found = find(mesh);
    CHECK(faultOf(mesh, found) == "");
    std::vector<size_t> sizes(gaps, 3);
    sizes.push_back(n);
    CHECK(sizesOf(found.rims) == sizes);
  }
}

TEST_CASE("findRims: two sheets that touch in a vertex keep their own rims") {
  for (const bool isTurned : {false, true}) {
    TestMesh mesh;
    mesh.addVertex({0, 0, 0});
    addFan(mesh, 0, 40, 7, 0.3);
    addFan(mesh, 10, 40, 7, -0.3, isTurned);
    const Found found = find(mesh);
    CHECK(faultOf(mesh, found) == "");
    CHECK(sizesOf(found.rims) == std::vector<size_t>{9, 9});
  }
}

TEST_CASE("findRims: a hole whose island touches its rim is parted into two rims") {
  const TestMesh mesh = without(saddleMesh(8, 0), [](Vec3 p) {
    const bool isIsland = p.x > 0 && p.y > 0 && p.x < 0.25 && p.y < 0.25;
    const bool isHole = p.x > -0.5 && p.y > -0.5 && p.x < 0.5 && p.y < 0.5;
    // The corner at the origin belongs to the sheet around, too.
    return isHole && !isIsland && !(p.x < 0 && p.y < 0);
  });
  const Found found = find(mesh);
  CHECK(faultOf(mesh, found) == "");
  CHECK(sizesOf(found.rims) == std::vector<size_t>{4, 16, 32});
}

TEST_CASE("findRims: more gaps at a vertex than are compared") {
  TestMesh mesh;
  mesh.addVertex({0, 0, 0});
  for (uint32_t i = 0; i < 20; ++i) addFan(mesh, 18 * i, 9, 1);
  const Found found = find(mesh);
  CHECK(faultOf(mesh, found) == "");
  CHECK(sizesOf(found.rims) == std::vector<size_t>(20, 3));
}

TEST_CASE("findRims: the rim of a Moebius strip is one, and told") {
  for (const uint32_t m : {20u, 33u}) {
    const Found found = find(moebiusMesh(m));
    CHECK(faultOf(moebiusMesh(m), found) == "");
    REQUIRE(found.rims.count() == 1);
    CHECK(found.rims.vertices.size() == 2 * m);
    CHECK(found.rims.rims[0].crossesSeam);
  }
}

TEST_CASE("findRims: faces without area take the normal of a neighbour") {
  // A row of squares in the plane, then needles along the rim of the hole.
  TestMesh mesh = without(saddleMesh(6, 0), isNear({0, 0, 0}, 0.4));
  const auto open = openEdges(mesh);
  for (const auto& [a, b] : open) {
    const Vec3 middle = 0.5 * (mesh.at(a) + mesh.at(b));
    if (length(middle) > 0.9) continue;
    mesh.addFace(b, a, mesh.addVertex(middle));
  }
  const Found found = find(mesh);
  CHECK(faultOf(mesh, found) == "");
  for (const Vec3 n : found.rims.normals) CHECK(n == Vec3{0, 0, 1});
}

TEST_CASE("findRims: a face without area and without neighbours has no normal") {
  const Found found = find({{0, 0, 0, 1, 1, 1, 2, 2, 2}, {0, 1, 2}});
  REQUIRE(found.rims.count() == 1);
  for (const Vec3 n : found.rims.normals) CHECK(n == Vec3{0, 0, 0});
}

TEST_CASE("findRims: the sides of a cut are no rim, the rest of a fin's is") {
  TestMesh mesh = saddleMesh(4, 0);
  mesh.addFace(6, 12, mesh.addVertex({-0.2, -0.2, 0.7}));
  const Found found = find(mesh);
  CHECK(faultOf(mesh, found) == "");
  REQUIRE(found.rims.count() == 2);
  for (const Rim& rim : found.rims.rims) CHECK(!rim.isSeam);
}

TEST_CASE("findRims: rims that should have been welded are seams, and others not") {
  const TestMesh tube = tubeMesh(12, 6, 3);
  for (const Rim& rim : find(soup(tube)).rims.rims) CHECK(rim.isSeam);
  // Two halves with vertices of their own meet; their other ends are open.
  const auto isUpper = [](Vec3 p) { return p.z > 0; };
  const auto isLower = [](Vec3 p) { return p.z <= 0; };
  const TestMesh cut = together(compact(without(tube, isUpper)), compact(without(tube, isLower)));
  const Found found = find(cut);
  REQUIRE(found.rims.count() == 4);
  for (uint32_t r = 0; r < 4; ++r)
    CHECK(found.rims.rims[r].isSeam == (std::fabs(cut.at(loopOf(found.rims, r)[0]).z) < 1));
}

TEST_CASE("findRims: ends at its limits, and gives all memory back") {
  const TestMesh mesh = soup(sphereMesh(2));
  Adjacency a;
  Work all;
  Charge charge(all);
  REQUIRE(buildAdjacency(mesh.view(), all, charge, a));
  for (size_t limit = 100; limit < 200000; limit += 7001) {
    Work work(limit, nullptr, nullptr);
    {
      Charge own(work);
      Rims rims;
      if (!findRims(mesh.view(), a, work, own, rims)) CHECK(work.status() == Status::OutOfMemory);
    }
    CHECK(work.used() == 0);
  }
}
