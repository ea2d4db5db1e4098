#include "mesh/group.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/union_find.h"
#include "support/meshes.h"

using namespace sf;
using namespace sftest;

namespace {

struct Grouped {
  Adjacency adjacency;
  Rims rims;
  Grouping groups;
};

Grouped groupsOf(const TestMesh& mesh) {
  Work work;
  Grouped g;
  {
    Charge charge(work);
    REQUIRE(buildAdjacency(mesh.view(), work, charge, g.adjacency));
    REQUIRE(findRims(mesh.view(), g.adjacency, work, charge, g.rims));
    REQUIRE(groupRims(mesh.view(), g.adjacency, g.rims, work, charge, g.groups));
  }
  CHECK(work.used() == 0);
  return g;
}

std::string faultOf(const Grouped& g) {
  const Grouping& a = g.groups;
  const uint32_t k = g.rims.count(), n = a.count();
  if (a.starts.size() != n + 1 || a.rims.size() != k || a.scores.size() != n) return "sizes";
  if (a.isOpenRim.size() != n || a.openness.size() != k) return "sizes";
  std::set<uint32_t> rims(a.rims.begin(), a.rims.end());
  if (rims.size() != k) return "a rim in two groups";
  uint32_t last = 0;
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t least =
        *std::min_element(a.rims.begin() + a.starts[i], a.rims.begin() + a.starts[i + 1]);
    if (i > 0 && least <= last) return "the order of groups";
    last = least;
    const bool isAlone = a.starts[i + 1] - a.starts[i] == 1;
    if (isAlone != (a.kinds[i] == GroupKind::Alone)) return "a kind";
    if (isAlone ? a.scores[i] != 1 : !(a.scores[i] > 0 && a.scores[i] <= 1)) return "a score";
  }
  for (const double o : a.openness)
    if (!(o >= 0 && o <= 1 + 1e-9)) return "an openness";
  for (const RimVote& v : a.votes)
    if (v.first >= v.second || !(v.vote > 0) || v.vote > 1) return "a vote";
  return "";
}

/// The groups in words, sorted: "island 2", "open 1".
std::string told(const TestMesh& mesh) {
  const Grouped g = groupsOf(mesh);
  CHECK(faultOf(g) == "");
  std::multiset<std::string> words;
  const Grouping& a = g.groups;
  for (uint32_t i = 0; i < a.count(); ++i) {
    const char* kind = a.kinds[i] == GroupKind::Alone    ? "alone"
                       : a.kinds[i] == GroupKind::Island ? "island"
                                                         : "band";
    words.insert(std::string(a.isOpenRim[i] ? "open" : kind) + " " +
                 std::to_string(a.starts[i + 1] - a.starts[i]));
  }
  std::string result;
  for (const std::string& word : words) result += (result.empty() ? "" : ", ") + word;
  return result;
}

/// Groups as sets of rims, which are sets of vertices.
using VertexGroups = std::set<std::set<std::set<uint32_t>>>;

std::set<uint32_t> verticesOf(const Rims& rims, uint32_t rim) {
  return {rims.vertices.begin() + rims.starts[rim], rims.vertices.begin() + rims.starts[rim + 1]};
}

VertexGroups groupsAsVertices(const Grouped& g) {
  VertexGroups result;
  for (uint32_t i = 0; i < g.groups.count(); ++i) {
    std::set<std::set<uint32_t>> group;
    for (uint32_t k = g.groups.starts[i]; k < g.groups.starts[i + 1]; ++k)
      group.insert(verticesOf(g.rims, g.groups.rims[k]));
    result.insert(group);
  }
  return result;
}

TestMesh withoutMarked(const TestMesh& whole, const std::vector<uint8_t>& isGone) {
  TestMesh cut = whole;
  cut.faces.clear();
  for (uint32_t f = 0; f < whole.faceCount(); ++f)
    if (!isGone[f]) cut.addFace(whole.faces[3 * f], whole.faces[3 * f + 1], whole.faces[3 * f + 2]);
  return cut;
}

/// The truth about a closed mesh that is cut: rims of one connected part that is gone belong together. None if rims
/// touch.
VertexGroups groupsByParts(const TestMesh& whole, const std::vector<uint8_t>& isGone) {
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> faceAt;
  for (uint32_t h = 0; h < whole.faces.size(); ++h)
    faceAt[{whole.faces[h], whole.faces[h % 3 == 2 ? h - 2 : h + 1]}] = h / 3;
  UnionFind parts(whole.faceCount());
  for (const auto& [edge, f] : faceAt) {
    const uint32_t g = faceAt.at({edge.second, edge.first});
    if (isGone[f] && isGone[g]) parts.unite(f, g);
  }
  const Grouped cut = groupsOf(withoutMarked(whole, isGone));
  std::map<uint32_t, std::set<std::set<uint32_t>>> byPart;
  std::set<uint32_t> seen;
  const Rims& rims = cut.rims;
  for (uint32_t r = 0; r < rims.count(); ++r) {
    for (const uint32_t v : verticesOf(rims, r))
      if (!seen.insert(v).second) return {};
    const uint32_t e = rims.starts[r];
    const uint32_t f = faceAt.at({rims.vertices[e], rims.vertices[rims.nextEdge(r, e)]});
    byPart[parts.rootOf(f)].insert(verticesOf(rims, r));
  }
  VertexGroups result;
  for (const auto& [part, group] : byPart) result.insert(group);
  return result;
}

/// A sphere whose part above or below a height is missing.
TestMesh sphereBelow(double z, uint32_t levels = 4) {
  return without(sphereMesh(levels), [=](Vec3 p) { return p.z > z; });
}

}  // namespace

TEST_CASE("groupRims: no rims, no groups") {
  CHECK(told({}) == "");
  CHECK(told(sphereMesh(2)) == "");
}

TEST_CASE("groupRims: holes alone, also side by side and of one face") {
  CHECK(told(without(sphereMesh(3), isNear({0, 0, 1}, 0.4))) == "alone 1");
  TestMesh mesh = without(sphereMesh(4), isNear({0, 0, 1}, 0.3));
  mesh = without(mesh, isNear({0.75, 0, 0.66}, 0.3));
  CHECK(told(mesh) == "alone 1, alone 1");
  mesh = sphereMesh(3);
  mesh.faces.erase(mesh.faces.begin(), mesh.faces.begin() + 3);
  CHECK(told(mesh) == "alone 1");
}

TEST_CASE("groupRims: islands go with the rim around them, which comes first") {
  TestMesh mesh = without(sphereMesh(4), isBetween({0, 0, 1}, 0.25, 0.6));
  CHECK(told(mesh) == "island 2");
  const Grouped g = groupsOf(mesh);
  REQUIRE(g.groups.count() == 1);
  CHECK(g.rims.rims[g.groups.rims[0]].length > g.rims.rims[g.groups.rims[1]].length);
  // Three islands in one hole.
  const Vec3 islands[3] = {{0.3, 0, 0.95}, {-0.2, 0.25, 0.95}, {-0.2, -0.25, 0.95}};
  mesh = without(sphereMesh(5), [&](Vec3 p) {
    for (const Vec3 c : islands)
      if (distance(p, c) < 0.12) return false;
    return p.z > 0.75;
  });
  CHECK(told(mesh) == "island 4");
}

TEST_CASE("groupRims: islands in the shade of others go with the hole that looks at them") {
  // A large hole, a row of large islands, and small ones between them.
  const TestMesh mesh = without(saddleMesh(80, 0.1), [](Vec3 p) {
    if (std::fabs(p.x) > 0.8 || std::fabs(p.y) > 0.8) return false;
    for (const double x : {-0.5, 0.0, 0.5}) {
      if (std::fabs(p.x - x) < 0.2 && std::fabs(std::fabs(p.y) - 0.35) < 0.25) return false;
      if (std::fabs(p.x - x) < 0.05 && std::fabs(p.y) < 0.05) return false;
    }
    return true;
  });
  CHECK(told(mesh) == "island 10, open 1");
}

TEST_CASE("groupRims: an island that touches the rim around it goes with it") {
  const TestMesh mesh = without(saddleMesh(16, 0.1), [](Vec3 p) {
    const bool isIsland = p.x > 0 && p.y > 0 && p.x < 0.25 && p.y < 0.25;
    const bool isHole = std::fabs(p.x) < 0.5 && std::fabs(p.y) < 0.5;
    return isHole && !isIsland && !(p.x < 0 && p.y < 0);
  });
  CHECK(told(mesh) == "island 2, open 1");
}

TEST_CASE("groupRims: two holes that touch in a vertex stay two") {
  const TestMesh mesh = without(saddleMesh(16, 0.2), [](Vec3 p) {
    return p.x * p.y > 0 && std::fabs(p.x) < 0.5 && std::fabs(p.y) < 0.5;
  });
  CHECK(told(mesh) == "alone 1, alone 1, open 1");
}

TEST_CASE("groupRims: an island in a hole of an island makes two groups") {
  TestMesh mesh = without(sphereMesh(5), isBetween({0, 0, 1}, 0.15, 0.3));
  mesh = without(mesh, isBetween({0, 0, 1}, 0.5, 0.8));
  CHECK(told(mesh) == "island 2, island 2");
}

TEST_CASE("groupRims: the ends of a missing band belong together") {
  const auto isBand = [](Vec3 p) { return std::fabs(p.z) < 0.3; };
  CHECK(told(without(sphereMesh(4), isBand)) == "band 2");
  CHECK(told(without(torusMesh(20, 60), [](Vec3 p) { return p.x > 0 && std::fabs(p.y) < 0.3; })) ==
        "band 2");
  // Open ends of the tube on top of that.
  CHECK(told(without(tubeMesh(40, 40, 6), isBand)) == "band 2, open 1, open 1");
}

TEST_CASE("groupRims: holes of different walls stay apart, however near") {
  const auto hole = isNear({0, 0, 1}, 0.4);
  const TestMesh sphere = without(sphereMesh(4), hole);
  for (const double inner : {0.97, 0.9}) {
    const TestMesh shell =
        together(sphere, turnedOver(mapped(sphere, [=](Vec3 p) { return inner * p; })));
    CHECK(told(shell) == "alone 1, alone 1");
  }
  for (const double gap : {0.05, 0.3}) {
    const TestMesh other = mapped(sphere, [=](Vec3 p) { return Vec3{p.x, -p.y, 2 + gap - p.z}; });
    CHECK(told(together(sphere, turnedOver(turnedOver(other)))) == "alone 1, alone 1");
  }
}

TEST_CASE("groupRims: sheets and tubes are open at their ends, their holes are holes") {
  const TestMesh sheet = saddleMesh(20, 0.3);
  CHECK(told(sheet) == "open 1");
  CHECK(told(without(sheet, isNear({0.2, 0.1, 0}, 0.3))) == "alone 1, open 1");
  CHECK(told(without(sheet, isBetween({0, 0, 0}, 0.2, 0.5))) == "island 2, open 1");
  CHECK(told(tubeMesh(32, 10, 3)) == "open 1, open 1");
  CHECK(told(tubeMesh(32, 1, 0.2)) == "open 1, open 1");
  CHECK(told(without(tubeMesh(32, 20, 4), isNear({1, 0, 0}, 0.5))) == "alone 1, open 1, open 1");
}

TEST_CASE(
    "groupRims: what closes to a body is a hole, however large, and what closes to a sheet is "
    "open") {
  for (const double z : {0.0, -0.2, -0.4}) {
    CHECK(told(sphereBelow(z)) == "alone 1");
    CHECK(told(sphereBelow(z, 5)) == "alone 1");
    CHECK(told(turnedOver(sphereBelow(z))) == "alone 1");
  }
  CHECK(told(sphereBelow(-0.8)) == "open 1");
  // A cup: a tube with a bottom.
  TestMesh cup = tubeMesh(24, 6, 2);
  const uint32_t middle = cup.addVertex({0, 0, -1});
  for (uint32_t i = 0; i < 24; ++i) cup.addFace(middle, (i + 1) % 24, i);
  CHECK(told(cup) == "alone 1");
  // One triangle.
  CHECK(told({{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}}) == "open 1");
}

TEST_CASE("groupRims: the rim of a Moebius strip is open") {
  CHECK(told(moebiusMesh(40)) == "open 1");
}

TEST_CASE("groupRims: a slit without area is a hole") {
  TestMesh mesh = sphereMesh(3);
  const uint32_t a = mesh.faces[0], b = mesh.faces[1], c = mesh.faces[2];
  mesh.faces.erase(mesh.faces.begin(), mesh.faces.begin() + 3);
  const uint32_t v = mesh.addVertex(0.5 * (mesh.at(a) + mesh.at(b)));
  mesh.addFace(a, v, c), mesh.addFace(v, b, c);
  CHECK(told(mesh) == "alone 1");
}

TEST_CASE("groupRims: a fin has an open rim, and so has a wall inside a body") {
  TestMesh fin = sphereMesh(3);
  fin.addFace(fin.faces[0], fin.faces[1], fin.addVertex(1.5 * fin.at(fin.faces[0])));
  CHECK(told(fin) == "open 1");
  TestMesh box = boxMesh(4);
  std::vector<uint32_t> middle;  // of the square z = 0 on the sides
  const uint32_t n = box.vertexCount();
  for (uint32_t v = 0; v < n; ++v)
    if (box.at(v).z == 0) middle.push_back(v);
  std::sort(middle.begin(), middle.end(), [&](uint32_t p, uint32_t q) {
    return std::atan2(box.at(p).y, box.at(p).x) < std::atan2(box.at(q).y, box.at(q).x);
  });
  const uint32_t centre = box.addVertex({0, 0, 0});
  for (size_t i = 0; i < middle.size(); ++i)
    box.addFace(centre, middle[i], middle[(i + 1) % middle.size()]);
  CHECK(told(box) == "open 1");
}

TEST_CASE("groupRims: a mesh that should have been welded has open rims only") {
  const Grouped g = groupsOf(soup(sphereMesh(2)));
  CHECK(g.groups.count() == 320);
  for (const uint8_t isOpen : g.groups.isOpenRim) CHECK(isOpen);
}

TEST_CASE("groupRims: the same at any scale and place, turned over, and in any order") {
  MESSAGE("seed 37");
  Random random(37);
  TestMesh mesh = without(sphereMesh(4), isBetween({0, 0, 1}, 0.25, 0.6));
  mesh = without(mesh, isNear({1, 0, 0}, 0.3));
  mesh = together(mesh, mapped(saddleMesh(8, 0.2), [](Vec3 p) { return p + Vec3{4, 0, 0}; }));
  const std::string words = "alone 1, island 2, open 1";
  CHECK(told(mesh) == words);
  CHECK(told(turnedOver(mesh)) == words);
  for (int i = 0; i < 8; ++i) {
    std::vector<uint32_t> from;
    const Rotation rotation = randomRotation(random);
    const double scale = i == 0 ? 1e-150 : i == 1 ? 1e140 : random.range(0.01, 100);
    const TestMesh other = shuffled(mapped(mesh,
                                           [&](Vec3 p) {
                                             return scale * (rotation(p) + Vec3{1e4, 0, 9});
                                           }),
                                    random, from);
    CHECK(told(other) == words);
  }
}

TEST_CASE("groupRims: noise of a quarter of an edge does not matter") {
  MESSAGE("seed 41");
  Random random(41);
  for (int i = 0; i < 10; ++i) {
    TestMesh mesh = noisy(sphereMesh(4), 0.02, random);
    mesh = without(mesh, isBetween({0, 0, 1}, 0.25, 0.6));
    mesh = without(mesh, isNear({0, 1, 0}, 0.3));
    CHECK(told(mesh) == "alone 1, island 2");
    CHECK(told(noisy(sphereBelow(-0.1), 0.02, random)) == "alone 1");
    CHECK(told(noisy(saddleMesh(20, 0.3), 0.02, random)) == "open 1");
  }
}

TEST_CASE("groupRims: random cuts, where the parts cut away say what belongs together") {
  MESSAGE("seed 53");
  Random random(53);
  const TestMesh sphere = sphereMesh(3);
  uint32_t groups = 0, right = 0;
  while (groups < 300) {
    // A sphere, two that nearly touch, one in the other, or one as flat as a coin.
    const uint32_t kind = random.below(4);
    const double a = random.range(0.02, 0.3);
    const auto other = [=](Vec3 p) {
      return kind == 1 ? Vec3{p.x + 2 + a, p.y, p.z} : (1 - a) * p;
    };
    TestMesh whole = sphere;
    if (kind == 1) whole = together(sphere, mapped(sphere, other));
    if (kind == 2) whole = together(sphere, turnedOver(mapped(sphere, other)));
    if (kind == 3) whole = mapped(sphere, [=](Vec3 p) { return Vec3{p.x, p.y, 2 * a * p.z}; });
    std::vector<uint8_t> isGone(whole.faceCount());
    for (uint32_t cuts = 1 + random.below(4); cuts > 0; --cuts) {
      const Vec3 at = kind == 1 && random.chance(0.7)
                          ? Vec3{1, random.range(-0.3, 0.3), random.range(-0.3, 0.3)}
                          : whole.middle(random.below(whole.faceCount()));
      const double radius = random.range(0.2, 0.7);
      const double inner = random.chance(0.5) ? random.range(0.2, 0.7) * radius : 0;
      for (uint32_t f = 0; f < whole.faceCount(); ++f) {
        const double from = distance(whole.middle(f), at);
        if (from < radius) isGone[f] = from >= inner;
      }
    }
    const auto truth = groupsByParts(whole, isGone);
    if (truth.empty()) continue;
    const auto found = groupsAsVertices(groupsOf(withoutMarked(whole, isGone)));
    groups += uint32_t(truth.size());
    for (const auto& group : truth) right += uint32_t(found.count(group));
  }
  // By votes alone six are wrong.
  CHECK(right + 2 >= groups);
}

TEST_CASE("groupRims: any faces at all") {
  MESSAGE("seed 43");
  Random random(43);
  for (int i = 0; i < 2000; ++i) {
    TestMesh mesh;
    const uint32_t n = 1 + random.below(12), m = random.below(30);
    const bool isLattice = random.chance(0.4);
    for (uint32_t v = 0; v < n; ++v) {
      const Vec3 p = random.inCube(1.6);
      mesh.addVertex(isLattice ? Vec3{std::round(p.x), std::round(p.y), std::round(p.z)} : p);
    }
    for (uint32_t f = 0; f < m; ++f) {
      const uint32_t a = random.below(n), b = random.below(n);
      mesh.addFace(a, b, random.below(n));
    }
    CHECK_MESSAGE(faultOf(groupsOf(mesh)) == "", "mesh ", i);
  }
}

TEST_CASE("groupRims: ends at its limits, and gives all memory back") {
  const TestMesh mesh =
      without(sphereMesh(4), [](Vec3 p) { return std::sin(20 * p.x) + std::sin(20 * p.y) > 1.5; });
  Work all;
  Charge charge(all);
  Adjacency a;
  Rims rims;
  REQUIRE(buildAdjacency(mesh.view(), all, charge, a));
  REQUIRE(findRims(mesh.view(), a, all, charge, rims));
  for (size_t limit = 100; limit < 300000; limit += 7001) {
    Work work(limit, nullptr, nullptr);
    {
      Charge own(work);
      Grouping groups;
      if (!groupRims(mesh.view(), a, rims, work, own, groups))
        CHECK(work.status() == Status::OutOfMemory);
    }
    CHECK(work.used() == 0);
  }
}
