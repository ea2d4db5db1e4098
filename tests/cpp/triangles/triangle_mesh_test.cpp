#include "triangles/triangle_mesh.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>

#include "base/predicates.h"
#include "support/generators.h"

using namespace sf;
using namespace sftest;

namespace {

/// A square of four corners and random points to insert.
struct Sheet {
  std::vector<Point2> at = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  TriangleMesh mesh;

  explicit Sheet(uint32_t points, uint32_t lattice, Random& random) {
    while (at.size() < points) {
      Point2 p{random.range(0.01, 0.99), random.range(0.01, 0.99)};
      if (lattice > 0)
        p = {(1.0 + random.below(lattice - 1)) / lattice,
             (1.0 + random.below(lattice - 1)) / lattice};
      bool known = false;
      for (const Point2 q : at) known |= q == p;
      if (!known)
        at.push_back(p);
      else if (lattice > 0 && at.size() >= 4 + (lattice - 1) * (lattice - 1))
        break;
    }
    mesh.at = mesh.metric = at;
    mesh.corners = {0, 1, 2, 0, 2, 3};
    Work work;
    REQUIRE(findTwins(mesh.corners, 4, work, mesh.twins));
    mesh.findEdges();
  }
  TriangleMesh::Place find(uint32_t v) const {
    for (uint32_t t = 0; t < mesh.triangleCount(); ++t) {
      TriangleMesh::Place place{3 * t, false};
      bool inside = true;
      for (uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
        const int side = mesh.orient(mesh.from(h), mesh.to(h), v);
        if (side == 0) place = {h, true};
        inside &= side >= 0;
      }
      if (inside) return place;
    }
    return {};
  }
};

std::string faultOf(const TriangleMesh& mesh, uint32_t vertices) {
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> half;
  for (uint32_t h = 0; h < mesh.corners.size(); ++h) {
    if (!mesh.inUse(h / 3)) continue;
    if (!half.insert({{mesh.from(h), mesh.to(h)}, h}).second) return "a directed edge used twice";
    if (h % 3 == 0 && mesh.orient(mesh.from(h), mesh.to(h), mesh.apex(h)) <= 0)
      return "a triangle turned over";
  }
  uint32_t border = 0;
  for (const auto& [ends, h] : half) {
    const auto other = half.find({ends.second, ends.first});
    const uint32_t twin = other == half.end() ? kNone : other->second;
    if (mesh.twins[h] != twin) return "a wrong twin";
    border += twin == kNone;
  }
  if (border != 4) return "a wrong border";
  for (uint32_t v = 0; v < vertices; ++v) {
    const uint32_t h = mesh.edgeFrom[v];
    if (h == kNone || mesh.from(h) != v) return "a wrong half-edge of a vertex";
    if (v < 4 && mesh.twins[h] != kNone) return "a half-edge inside of a vertex of the border";
  }
  return "";
}

}  // namespace

TEST_CASE(
    "triangle mesh: insertions and flips keep twins, orientation and half-edges of vertices") {
  constexpr uint32_t kSeed = 4400;
  CAPTURE(kSeed);
  Random random(kSeed);
  for (int instance = 0; instance < 40; ++instance) {
    CAPTURE(instance);
    Sheet sheet(20 + random.below(30), instance % 2 == 0 ? 0 : 6, random);
    TriangleMesh& mesh = sheet.mesh;
    std::vector<uint32_t> edges;
    for (uint32_t v = 4; v < sheet.at.size(); ++v) {
      mesh.insert(sheet.find(v), v, edges);
      for (const uint32_t h : edges) CHECK(mesh.apex(h) == v);
      if (instance % 4 < 2) edges.clear();  // else Delaunay all the time
      Work work;
      CHECK(legalize(mesh, edges, 1000, work) > 0);
      REQUIRE(faultOf(mesh, v + 1) == "");
    }
    for (uint32_t h = 0; h < mesh.corners.size(); ++h) {
      if (instance % 4 >= 2) CHECK(!mesh.isIllegal(h));
      edges.push_back(h);
    }
    Work work;
    CHECK(legalize(mesh, edges, 100000, work) > 0);
    REQUIRE(faultOf(mesh, uint32_t(sheet.at.size())) == "");
    for (uint32_t h = 0; h < mesh.corners.size(); ++h) CHECK(!mesh.isIllegal(h));
  }
}

TEST_CASE("triangle mesh: a budget of flips is kept") {
  Random random(4401);
  Sheet sheet(60, 0, random);
  std::vector<uint32_t> edges;
  for (uint32_t v = 4; v < 60; ++v) sheet.mesh.insert(sheet.find(v), v, edges);
  for (uint32_t h = 0; h < sheet.mesh.corners.size(); ++h) edges.push_back(h);
  Work work;
  CHECK(legalize(sheet.mesh, edges, 5, work) == 0);
  CHECK(edges.empty());
  CHECK(faultOf(sheet.mesh, 60) == "");
}

TEST_CASE("triangle mesh: twins are found in fans of very many triangles in linear time") {
  constexpr uint32_t kCount = 200000;
  std::vector<uint32_t> corners, twins;
  for (uint32_t i = 0; i < kCount; ++i) corners.insert(corners.end(), {kCount + 1, i, i + 1});
  Work work;
  REQUIRE(findTwins(corners, kCount + 2, work, twins));
  CHECK(work.used() == 0);
  uint32_t wrong = 0;
  for (uint32_t i = 0; i + 1 < kCount; ++i)
    wrong +=
        twins[3 * i + 2] != 3 * i + 3 || twins[3 * i + 3] != 3 * i + 2 || twins[3 * i + 1] != kNone;
  CHECK(wrong == 0);
}

TEST_CASE("closable twins: named otherwise and back, closed and opened, they are the same") {
  for (uint32_t seed = 1; seed <= 50; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    Sheet sheet(4 + random.below(60), 0, random);
    std::vector<uint32_t> edges;
    for (uint32_t v = 4; v < sheet.at.size(); ++v) sheet.mesh.insert(sheet.find(v), v, edges);
    const std::vector<uint32_t>& plain = sheet.mesh.twins;
    ClosableTwins twins;
    twins.fromPlain(plain);
    const uint32_t halves = uint32_t(plain.size());
    CHECK(twins.outside >= halves);
    for (uint32_t h = 0; h < halves; ++h) {
      // Opposite corner h, so from the next corner on.
      const uint32_t named = plain[nextInTriangle(h)];
      CHECK((twins.of[h] == twins.outside) == (named == kNone));
      if (named == kNone) continue;
      CHECK(twins.of[twins.of[h]] == h);
      CHECK(sheet.mesh.corners[nextInTriangle(twins.of[h])] ==
            sheet.mesh.corners[prevInTriangle(h)]);
    }
    const std::vector<uint32_t> open(twins.of.begin(), twins.of.begin() + halves);
    uint32_t closed = 0;
    for (uint32_t h = 0; h < halves; h += 1 + random.below(5)) {
      if (twins.of[h] >= halves) continue;
      const uint32_t g = twins.of[h];
      twins.close(h);
      ++closed;
      const uint32_t far = twins.of[h];
      CHECK(far >= twins.outside + 2);
      CHECK(far % 2 == 0);
      CHECK(twins.of[far] == h);
      CHECK(twins.of[far + 1] == g);
      CHECK(twins.of[g] == far + 1);
    }
    CHECK(twins.end == twins.outside + 2 + 2 * closed);
    std::vector<uint32_t> back(halves);
    twins.toPlain(back);
    CHECK(back == plain);
    CHECK(std::equal(open.begin(), open.end(), twins.of.begin()));
  }
}
