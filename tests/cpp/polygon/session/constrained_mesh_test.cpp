#include "polygon/session/constrained_mesh.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "support/generators.h"

using namespace sf;
using namespace sftest;

namespace {

/// Whether all triangles are of positive area, twins agree, and the box is covered.
std::string faultOf(const ConstrainedMesh& c) {
  const TriangleMesh& mesh = c.mesh;
  uint32_t border = 0, used = 0, vertices = 0;
  for (uint32_t t = 0; t < mesh.triangleCount(); ++t) {
    if (!mesh.inUse(t)) continue;
    ++used;
    if (mesh.orient(mesh.corners[3 * t], mesh.corners[3 * t + 1], mesh.corners[3 * t + 2]) <= 0)
      return "a triangle turned over";
    for (uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
      const uint32_t g = mesh.twins[h];
      border += g == kNone;
      if (g != kNone &&
          (mesh.twins[g] != h || mesh.from(g) != mesh.to(h) || mesh.to(g) != mesh.from(h)))
        return "a wrong twin";
    }
  }
  for (uint32_t v = 0; v < c.at.size(); ++v) {
    vertices += c.contains(v);
    if (c.contains(v) && mesh.from(mesh.edgeFrom[v]) != v) return "a wrong half-edge of a vertex";
  }
  if (border != 4) return "a wrong border";
  return used == 2 * vertices - 6 ? "" : "a wrong number of triangles";
}

bool hasEdge(const ConstrainedMesh& c, uint32_t a, uint32_t b) {
  for (uint32_t h = 0; h < c.mesh.corners.size(); ++h)
    if (c.mesh.inUse(h / 3) && c.mesh.from(h) == a && c.mesh.to(h) == b) return true;
  return false;
}

Point2 somewhere(uint32_t lattice, Random& random) {
  if (lattice == 0) return {random.range(-1, 1), random.range(-1, 1)};
  return {double(random.below(lattice)) / lattice, double(random.below(lattice)) / lattice};
}

}  // namespace

TEST_CASE("constrained mesh: points and edges come and go, and triangles stay triangles") {
  constexpr uint32_t kSeed = 4500;
  CAPTURE(kSeed);
  uint32_t inserted = 0, met = 0, blockedByEdge = 0, blockedByVertex = 0;
  for (uint32_t sequence = 0; sequence < 30; ++sequence) {
    CAPTURE(sequence);
    Random random(kSeed + sequence);
    const uint32_t lattice = sequence % 2 == 0 ? 0 : 7, count = 40,
                   first = ConstrainedMesh::kCorners;
    ConstrainedMesh c;
    c.reset(4, 0, count);
    for (int step = 0; step < 400; ++step) {
      CAPTURE(step);
      const uint32_t v = first + random.below(count), w = first + random.below(count);
      ConstrainedMesh::Obstacle obstacle;
      if (!c.contains(v)) {
        c.setPosition(v, somewhere(lattice, random));
        const bool done = c.insertPoint(v, c.contains(w) ? w : 0, obstacle);
        CHECK(done == c.contains(v));
        if (done)
          ++inserted;
        else if (obstacle.vertex != kNone)
          CHECK(c.at[obstacle.vertex] == c.at[v]);
        else
          CHECK(c.next[obstacle.edge] != kNone);
      } else if (c.next[v] == kNone && c.prev[v] == kNone && random.chance(0.3)) {
        c.removePoint(v);
        CHECK(!c.contains(v));
      } else if (c.contains(w) && v != w && c.next[v] == kNone && c.prev[w] == kNone &&
                 c.next[w] != v) {
        if (c.insertEdge(v, w, obstacle)) {
          ++met;
          CHECK(hasEdge(c, v, w));
          if (random.chance(0.5)) c.next[v] = w, c.prev[w] = v;
        } else if (obstacle.vertex != kNone) {
          ++blockedByVertex;
          CHECK(c.mesh.orient(v, w, obstacle.vertex) == 0);
        } else {
          ++blockedByEdge;
          const uint32_t a = obstacle.edge, b = c.next[a];
          CHECK(c.mesh.orient(v, w, a) * c.mesh.orient(v, w, b) < 0);
          CHECK(c.mesh.orient(a, b, v) * c.mesh.orient(a, b, w) < 0);
        }
      } else if (c.next[v] != kNone) {
        CHECK(hasEdge(c, v, c.next[v]));
        const uint32_t b = c.next[v];
        c.next[v] = c.prev[b] = kNone;
      } else {
        const Point2 p = {c.at[v].x + random.range(-0.1, 0.1), c.at[v].y + random.range(-0.1, 0.1)};
        const bool moved = c.shiftPoint(v, p);
        CHECK(moved == (c.at[v] == p));
      }
      if (random.chance(0.3)) c.legalizeChanged(100);
      if (random.chance(0.1)) c.forgetChanges();
      const std::string fault = faultOf(c);
      REQUIRE(fault == "");
    }
  }
  CHECK(inserted > 1000);
  CHECK(met > 500);
  CHECK(blockedByEdge > 50);
  CHECK(blockedByVertex > 50);
}
