#include "mesh/adjacency.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>

#include "support/meshes.h"

using namespace sf;
using namespace sftest;

namespace {

Adjacency adjacencyOf(const TestMesh& mesh) {
  Work work;
  Adjacency result;
  {
    Charge charge(work);
    REQUIRE(checkMesh(mesh.view()).ok());
    REQUIRE(buildAdjacency(mesh.view(), work, charge, result));
  }
  CHECK(work.used() == 0);
  return result;
}

const Defect* defectOf(const Adjacency& a, DefectKind kind) {
  for (const Defect& d : a.defects)
    if (d.kind == kind) return &d;
  return nullptr;
}

using Edge = std::pair<uint32_t, uint32_t>;
using List = std::vector<uint32_t>;

/// What is wrong with an adjacency, by definition and by comparing all that can be compared.
std::string faultOf(const TestMesh& mesh, const Adjacency& a) {
  const uint32_t m = mesh.faceCount(), n = mesh.vertexCount();
  if (a.corners.size() != 3 * m || a.twins.size() != 3 * m || a.vertices != n) return "sizes";
  // Faces that count, and only those.
  std::set<std::set<uint32_t>> seen;
  std::map<Edge, uint32_t> facesAt;
  List duplicate, degenerate;
  for (uint32_t f = 0; f < m; ++f) {
    const uint32_t* v = &mesh.faces[3 * f];
    const std::set<uint32_t> corners(v, v + 3);
    bool isOut = true;
    if (corners.size() < 3)
      degenerate.push_back(f);
    else if (!seen.insert(corners).second)
      duplicate.push_back(f);
    else
      isOut = false;
    if (isOut != (a.corners[3 * f] == kNone) || isOut != (a.component[f] == kNone))
      return "left out";
    if (isOut) continue;
    for (uint32_t i = 0; i < 3; ++i) ++facesAt[std::minmax(v[i], v[(i + 1) % 3])];
    const uint32_t k = a.turned[f] ? 2 : 1;
    if (a.tail(3 * f) != v[0] || a.tail(3 * f + 1) != v[k] || a.tail(3 * f + 2) != v[3 - k])
      return "corners";
  }
  const Defect* d = defectOf(a, DefectKind::DuplicateFace);
  if ((d ? d->faces : List{}) != duplicate) return "duplicate faces";
  d = defectOf(a, DefectKind::DegenerateFace);
  if ((d ? d->faces : List{}) != degenerate) return "degenerate faces";
  // Twins.
  std::set<Edge> cutEdges, several;
  for (uint32_t h = 0; h < 3 * m; ++h) {
    if (a.corners[h] == kNone) {
      if (a.twins[h] != kNone) return "a twin of a face left out";
      continue;
    }
    const uint32_t g = a.twins[h], count = facesAt[std::minmax(a.tail(h), a.head(h))];
    const bool isSeam = a.acrossSeam(h) != kNone;
    if (count > 2) several.insert(std::minmax(a.tail(h), a.head(h)));
    if (isSeam) {
      const uint32_t s = a.acrossSeam(h);
      if (a.acrossSeam(s) != h || a.tail(s) != a.tail(h) || a.head(s) != a.head(h)) return "a seam";
      cutEdges.insert(std::minmax(a.tail(h), a.head(h)));
    }
    if (g == kNone) {
      if (count == 2 && !isSeam) return "an edge of two faces without twins";
      if (a.isCut(h) != (count > 2 && !isSeam)) return "a cut";
      continue;
    }
    if (a.isCut(h) || isSeam || count < 2) return "a twin too many";
    if (a.twins[g] != h || g / 3 == h / 3) return "a twin's twin";
    if (a.corners[g] != a.corners[nextInTriangle(h)] ||
        a.corners[h] != a.corners[nextInTriangle(g)])
      return "twins not wound alike";
    if (a.component[g / 3] != a.component[h / 3]) return "a component torn";
  }
  d = defectOf(a, DefectKind::NonManifoldEdge);
  List edges;
  for (const Edge& e : several) edges.insert(edges.end(), {e.first, e.second});
  if ((d ? d->edges : List{}) != edges) return "non-manifold edges";
  // Fans: around every working vertex, one turn meets all of its corners.
  std::map<uint32_t, uint32_t> corners, first;
  for (uint32_t h = 0; h < 3 * m; ++h)
    if (a.corners[h] != kNone) ++corners[a.corners[h]], first[a.corners[h]] = h;
  std::map<uint32_t, uint32_t> fans;  // of input vertices
  for (const auto& [w, count] : corners) {
    if (w >= n + a.splitOf.size()) return "a working vertex";
    ++fans[a.inputVertex(w)];
    uint32_t h = first[w], met = 1;
    while (a.twins[prevInTriangle(h)] != kNone && a.twins[prevInTriangle(h)] != first[w])
      h = a.twins[prevInTriangle(h)], ++met;
    if (a.twins[prevInTriangle(h)] == kNone)
      for (h = first[w]; a.twins[h] != kNone; ++met) h = nextInTriangle(a.twins[h]);
    if (met != count) return "a working vertex of several fans";
  }
  List unused, split;
  std::set<uint32_t> atCut;
  for (const auto& set : {several, cutEdges})
    for (const Edge& e : set) atCut.insert({e.first, e.second});
  for (uint32_t v = 0; v < n; ++v) {
    if (fans[v] == 0) unused.push_back(v);
    if (fans[v] > 1 && !atCut.count(v)) split.push_back(v);
  }
  d = defectOf(a, DefectKind::UnusedVertex);
  if ((d ? d->vertices : List{}) != unused) return "unused vertices";
  d = defectOf(a, DefectKind::NonManifoldVertex);
  if ((d ? d->vertices : List{}) != split) return "split vertices";
  List flipped;
  for (uint32_t f = 0; f < m; ++f)
    if (a.turned[f]) flipped.push_back(f);
  d = defectOf(a, DefectKind::Flipped);
  if ((d ? d->faces : List{}) != flipped) return "flipped faces";
  if (!std::is_sorted(a.defects.begin(), a.defects.end(),
                      [](const Defect& p, const Defect& q) { return p.kind < q.kind; }))
    return "the order of defects";
  return "";
}

uint32_t openHalves(const Adjacency& a) {
  uint32_t count = 0;
  for (uint32_t h = 0; h < a.twins.size(); ++h)
    count += a.corners[h] != kNone && a.twins[h] == kNone;
  return count;
}

}  // namespace

TEST_CASE("buildAdjacency: closed meshes have all twins, one component and no defect") {
  for (const TestMesh& mesh :
       {sphereMesh(0), sphereMesh(3), torusMesh(7, 11), boxMesh(1), boxMesh(4)}) {
    const Adjacency a = adjacencyOf(mesh);
    CHECK(faultOf(mesh, a) == "");
    CHECK(openHalves(a) == 0);
    CHECK(a.components == 1);
    CHECK(a.defects.empty());
    CHECK(a.splitOf.empty());
  }
}

TEST_CASE("buildAdjacency: no mesh, and vertices without faces") {
  CHECK(adjacencyOf({}).defects.empty());
  const Adjacency a = adjacencyOf({{0, 0, 0, 1, 1, 1}, {}});
  REQUIRE(a.defects.size() == 1);
  CHECK(a.defects[0].vertices == List{0, 1});
}

TEST_CASE("buildAdjacency: faces in any order, at any scale, far away") {
  MESSAGE("seed 5");
  Random random(5);
  const TestMesh holes = without(torusMesh(12, 20), isNear({1, 0, 0.4}, 0.3));
  for (const double scale : {1.0, 1e-300, 1e-150, 1e149}) {
    std::vector<uint32_t> from;
    TestMesh mesh = shuffled(mapped(holes,
                                    [&](Vec3 p) {
                                      return scale * (p + Vec3{7, -3, 5});
                                    }),
                             random, from);
    // A third of the faces turned over: those are told, whatever the scale.
    List turned;
    for (uint32_t f = 0; f < mesh.faceCount(); ++f) {
      if (!random.chance(0.3)) continue;
      std::swap(mesh.faces[3 * f], mesh.faces[3 * f + 2]);
      turned.push_back(f);
    }
    const Adjacency a = adjacencyOf(mesh);
    CHECK(faultOf(mesh, a) == "");
    CHECK(openHalves(a) == openEdges(mesh).size());
    REQUIRE(defectOf(a, DefectKind::Flipped));
    CHECK(defectOf(a, DefectKind::Flipped)->faces == turned);
    CHECK(!defectOf(a, DefectKind::NotOrientable));
  }
}

TEST_CASE("buildAdjacency: the faces of more area keep their winding, in each component") {
  // Few large faces against many small ones.
  TestMesh mesh = sphereMesh(2);
  mesh = mapped(mesh, [](Vec3 p) { return p.z > 0 ? 10 * p : p; });
  List lower;
  for (uint32_t f = 0; f < mesh.faceCount(); ++f) {
    if (mesh.middle(f).z > 0.2) continue;
    std::swap(mesh.faces[3 * f], mesh.faces[3 * f + 1]);
    lower.push_back(f);
  }
  const Adjacency a = adjacencyOf(mesh);
  CHECK(faultOf(mesh, a) == "");
  CHECK(defectOf(a, DefectKind::Flipped)->faces == lower);
  // A body inside out keeps its winding, whatever the other one has.
  const TestMesh two = together(sphereMesh(2), turnedOver(sphereMesh(1)));
  CHECK(adjacencyOf(two).defects.empty());
  CHECK(adjacencyOf(two).components == 2);
}

TEST_CASE("buildAdjacency: faces given twice or with a vertex twice count once or not at all") {
  TestMesh mesh = sphereMesh(2);
  const uint32_t m = mesh.faceCount();
  mesh.addFace(mesh.faces[1], mesh.faces[2], mesh.faces[0]);
  mesh.addFace(mesh.faces[4], mesh.faces[3], mesh.faces[5]);
  mesh.addFace(0, 0, 1);
  mesh.addFace(3, 2, 3);
  const Adjacency a = adjacencyOf(mesh);
  CHECK(faultOf(mesh, a) == "");
  CHECK(openHalves(a) == 0);
  CHECK(defectOf(a, DefectKind::DuplicateFace)->faces == List{m, m + 1});
  CHECK(defectOf(a, DefectKind::DegenerateFace)->faces == List{m + 2, m + 3});
}

TEST_CASE("buildAdjacency: a fin on a surface is left open, the surface goes on below it") {
  TestMesh mesh = saddleMesh(4, 0);
  // The diagonal of a square in the middle.
  const uint32_t a = 6, b = 12, m = mesh.faceCount();
  const uint32_t tip = mesh.addVertex({-0.2, -0.2, 0.7});
  for (const bool isTurned : {false, true}) {
    TestMesh fin = mesh;
    fin.addFace(isTurned ? b : a, isTurned ? a : b, tip);
    const Adjacency adjacency = adjacencyOf(fin);
    CHECK(faultOf(fin, adjacency) == "");
    CHECK(openHalves(adjacency) == 16 + 3);
    CHECK(adjacency.components == 2);
    REQUIRE(adjacency.defects.size() == 1);
    CHECK(adjacency.defects[0].edges == List{a, b});
    CHECK(adjacency.defects[0].faces == List{m});
  }
}

TEST_CASE("buildAdjacency: two boxes that share an edge stay two") {
  const TestMesh one = boxMesh(1);
  TestMesh mesh = together(one, mapped(one, [](Vec3 p) { return p + Vec3{2, 2, 0}; }));
  // Weld the common edge: x = y = 1.
  for (uint32_t& v : mesh.faces)
    for (uint32_t w = 0; w < v; ++w)
      if (mesh.at(w) == mesh.at(v)) v = w;
  mesh = compact(mesh);
  const Adjacency a = adjacencyOf(mesh);
  CHECK(faultOf(mesh, a) == "");
  CHECK(openHalves(a) == 0);
  CHECK(a.components == 2);
  CHECK(a.splitOf.size() == 2);
  REQUIRE(a.defects.size() == 1);
  CHECK(a.defects[0].kind == DefectKind::NonManifoldEdge);
}

TEST_CASE("buildAdjacency: an edge of very many faces is cut") {
  TestMesh mesh;
  mesh.addVertex({0, 0, 0}), mesh.addVertex({0, 0, 1});
  for (uint32_t i = 0; i < 1000; ++i)
    mesh.addFace(0, 1, mesh.addVertex({std::cos(i / 160.0), std::sin(i / 160.0), 0.5}));
  const Adjacency a = adjacencyOf(mesh);
  CHECK(faultOf(mesh, a) == "");
  CHECK(openHalves(a) == 3000);
  CHECK(a.cut.size() == 1000);
}

TEST_CASE("buildAdjacency: a vertex where two cones meet is split") {
  TestMesh mesh;
  mesh.addVertex({0, 0, 0});
  for (const double z : {1.0, -1.0}) {
    const uint32_t first = mesh.vertexCount();
    for (uint32_t i = 0; i < 8; ++i) mesh.addVertex({std::cos(i * 0.785), std::sin(i * 0.785), z});
    for (uint32_t i = 0; i < 8; ++i) mesh.addFace(0, first + i, first + (i + 1) % 8);
  }
  const Adjacency a = adjacencyOf(mesh);
  CHECK(faultOf(mesh, a) == "");
  REQUIRE(a.defects.size() == 1);
  CHECK(a.defects[0].kind == DefectKind::NonManifoldVertex);
  CHECK(a.defects[0].vertices == List{0});
  CHECK(a.components == 2);
}

TEST_CASE("buildAdjacency: surfaces of one side are cut, and told") {
  for (const TestMesh& mesh : {moebiusMesh(20), moebiusMesh(21), kleinMesh(9, 8)}) {
    const Adjacency a = adjacencyOf(mesh);
    CHECK(faultOf(mesh, a) == "");
    CHECK(a.components == 1);
    const Defect* d = defectOf(a, DefectKind::NotOrientable);
    REQUIRE(d);
    CHECK(d->edges.size() > 0);
    CHECK(d->edges.size() == a.seams.size() / 2);
    CHECK(d->faces.size() > 0);
  }
}

TEST_CASE("buildAdjacency: any faces at all, against the definition") {
  MESSAGE("seed 11");
  Random random(11);
  for (int i = 0; i < 3000; ++i) {
    TestMesh mesh;
    const uint32_t n = 1 + random.below(9), m = random.below(30);
    const bool isLattice = random.chance(0.4);
    for (uint32_t v = 0; v < n; ++v) {
      const Vec3 p = random.inCube(1);
      mesh.addVertex(isLattice ? Vec3{std::round(p.x), std::round(p.y), 0} : p);
    }
    for (uint32_t f = 0; f < m; ++f) {
      const uint32_t a = random.below(n), b = random.below(n);
      mesh.addFace(a, b, random.below(n));
    }
    const Adjacency a = adjacencyOf(mesh);
    CHECK_MESSAGE(faultOf(mesh, a) == "", "mesh ", i);
  }
}

TEST_CASE("checkMesh: the first vertex that is not finite, then the first face out of range") {
  TestMesh mesh = sphereMesh(1);
  CHECK(checkMesh(mesh.view()).ok());
  mesh.faces[17] = mesh.vertexCount();
  CHECK(checkMesh(mesh.view()).status == Status::BadMesh);
  CHECK(checkMesh(mesh.view()).vertex == 5);
  for (const double bad : {std::nan(""), HUGE_VAL, -1e151}) {
    mesh.positions[3 * 11 + 1] = bad;
    CHECK(checkMesh(mesh.view()).vertex == 11);
    CHECK(checkMesh(mesh.view()).status == Status::NotFinite);
  }
}

TEST_CASE("buildAdjacency: ends at its limits, and gives all memory back") {
  const TestMesh mesh = sphereMesh(4);
  for (size_t limit = 1000; limit < 400000; limit += 9001) {
    Work work(limit, nullptr, nullptr);
    Adjacency a;
    {
      Charge charge(work);
      if (buildAdjacency(mesh.view(), work, charge, a)) {
        CHECK(work.status() == Status::Ok);
      } else {
        CHECK(work.status() == Status::OutOfMemory);
      }
    }
    CHECK(work.used() == 0);
  }
  Work stopped(
      size_t(-1), [](void*, double, double, double) { return false; }, nullptr);
  stopped.report();
  Charge charge(stopped);
  Adjacency a;
  CHECK_FALSE(buildAdjacency(mesh.view(), stopped, charge, a));
  CHECK(stopped.status() == Status::Stopped);
}
