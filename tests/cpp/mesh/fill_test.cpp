// Holes filled: closed, wound alike, clean, near the surface that was cut away; the old part as it was.
#include "mesh/fill.h"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <string>

#include "support/meshes.h"

using namespace sf;
using namespace sftest;

namespace {

using RimLists = std::vector<std::vector<uint32_t>>;

/// All holes of a mesh filled, open rims too if `all`; or the rims that are `given`, one list a hole.
struct Filled {
  std::vector<FilledHole> holes;
  TestMesh mesh;
  uint32_t open = 0;
};

Filled fillAll(const TestMesh& input, const FillOptions& options = {}, bool all = false,
               RimLists given = {}) {
  Work work;
  Charge charge(work);
  const bool isGiven = !given.empty();
  const MeshView mesh = input.view();
  REQUIRE(checkMesh(mesh).ok());
  Adjacency adjacency;
  Rims rims;
  Grouping groups;
  REQUIRE(buildAdjacency(mesh, work, charge, adjacency));
  REQUIRE(findRims(mesh, adjacency, work, charge, rims));
  REQUIRE(groupRims(mesh, adjacency, rims, work, charge, groups));
  Surroundings around;
  REQUIRE(survey(mesh, adjacency, rims, work, charge, around));
  HoleFiller filler(mesh, adjacency, rims, around, work);
  Filled result;
  for (uint32_t g = 0; g < groups.count() && !isGiven; ++g) {
    if (groups.isOpenRim[g] && !all)
      ++result.open;
    else
      given.emplace_back(groups.rims.begin() + groups.starts[g],
                         groups.rims.begin() + groups.starts[g + 1]);
  }
  for (const std::vector<uint32_t>& hole : given) {
    FilledHole filled;
    REQUIRE(filler.fill(hole, options, filled) == Status::Ok);
    result.holes.push_back(filled);
  }
  result.mesh = input;
  result.mesh.positions.insert(result.mesh.positions.end(), filler.newPositions().begin(),
                               filler.newPositions().end());
  result.mesh.faces.insert(result.mesh.faces.end(), filler.newFaces().begin(),
                           filler.newFaces().end());
  return result;
}

/// Whether every edge has two faces that run it in opposite directions; how many have not.
uint32_t openOrTwisted(const TestMesh& mesh) {
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (size_t f = 0; f < mesh.faces.size(); f += 3)
    for (int k = 0; k < 3; ++k) ++edges[{mesh.faces[f + k], mesh.faces[f + (k + 1) % 3]}];
  uint32_t wrong = 0;
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    wrong += count != 1 || back == edges.end() || back->second != 1;
  }
  return wrong;
}

void expectWhole(const Filled& filled, size_t holes) {
  CHECK(filled.holes.size() == holes);
  for (const FilledHole& hole : filled.holes) {
    CHECK(hole.status == FillStatus::Filled);
    CHECK(hole.intersections.empty());
    CHECK(hole.endFace > hole.firstFace);
  }
  CHECK(openOrTwisted(filled.mesh) == 0);
  Work work;
  std::vector<FacePair> pairs;
  REQUIRE(findSelfIntersections(filled.mesh.view(), 0, filled.mesh.faceCount(), 100, work, pairs));
  CHECK(pairs.empty());
}

/// Vertices whose faces are not one closed fan.
uint32_t pinched(const TestMesh& mesh) {
  std::map<uint32_t, std::map<uint32_t, uint32_t>> around;
  for (size_t f = 0; f < mesh.faces.size(); f += 3)
    for (int k = 0; k < 3; ++k)
      around[mesh.faces[f + k]][mesh.faces[f + (k + 1) % 3]] = mesh.faces[f + (k + 2) % 3];
  uint32_t count = 0;
  for (auto& [vertex, next] : around) {
    uint32_t at = next.begin()->first;
    size_t steps = 0;
    do at = next[at], ++steps;
    while (at != next.begin()->first && steps <= next.size());
    count += steps != next.size();
  }
  return count;
}

/// Regions of a closed mesh that is cut: faces by what they are.
class Cutting {
 public:
  Cutting(const TestMesh& mesh, const PlaceTest& isHole) : mesh_(mesh) {
    for (uint32_t f = 0; f < mesh.faceCount(); ++f) isGone_.push_back(isHole(mesh.middle(f)));
  }
  std::vector<uint32_t> facesAt(uint32_t vertex) const {
    std::vector<uint32_t> faces;
    for (uint32_t f = 0; f < mesh_.faceCount(); ++f)
      if (has(f, vertex)) faces.push_back(f);
    return faces;
  }
  /// Whether a vertex is of faces that stay.
  bool isTaken(uint32_t vertex) const {
    for (const uint32_t f : facesAt(vertex))
      if (!isGone_[f]) return true;
    return false;
  }
  /// Makes an island of some faces of the hole that touches what is there at `vertex` alone: the first such face, and
  /// `rings` of faces around it. False if there is none.
  bool addIsland(uint32_t vertex, uint32_t rings) {
    for (const uint32_t f : facesAt(vertex)) {
      if (!isGone_[f] || touched(f) != isTaken(vertex)) continue;
      std::vector<uint32_t> island{f};
      const std::vector<uint8_t> before = isGone_;
      for (uint32_t ring = 0; ring < rings; ++ring) {
        const std::vector<uint32_t> last = island;
        for (const uint32_t g : last)
          for (int k = 0; k < 3; ++k) {
            const uint32_t corner = mesh_.faces[3 * g + k];
            if (corner == vertex) continue;
            for (const uint32_t other : facesAt(corner))
              if (isGone_[other] && touched(other) == 0) island.push_back(other);
          }
      }
      for (const uint32_t g : island) isGone_[g] = 0;
      return true;
    }
    return false;
  }
  /// Makes an island of all of the hole but a strip along its rim, which it touches at some vertices.
  void addIslandInside(const std::vector<uint32_t>& vertices) {
    std::vector<uint32_t> island;
    for (uint32_t f = 0; f < mesh_.faceCount(); ++f)
      if (isGone_[f] && touched(f) == 0) island.push_back(f);
    for (const uint32_t v : vertices)
      for (const uint32_t f : facesAt(v))
        if (isGone_[f] && touched(f) == 1) {
          island.push_back(f);
          break;
        }
    for (const uint32_t f : island) isGone_[f] = 0;
  }
  TestMesh cut() const {
    TestMesh result = mesh_;
    result.faces.clear();
    for (uint32_t f = 0; f < mesh_.faceCount(); ++f)
      if (!isGone_[f])
        result.addFace(mesh_.faces[3 * f], mesh_.faces[3 * f + 1], mesh_.faces[3 * f + 2]);
    return result;
  }

 private:
  bool has(uint32_t f, uint32_t v) const {
    return mesh_.faces[3 * f] == v || mesh_.faces[3 * f + 1] == v || mesh_.faces[3 * f + 2] == v;
  }
  uint32_t touched(uint32_t f) const {
    uint32_t count = 0;
    for (int k = 0; k < 3; ++k) count += isTaken(mesh_.faces[3 * f + k]);
    return count;
  }
  TestMesh mesh_;
  std::vector<uint8_t> isGone_;
};

/// The vertex nearest to a place.
uint32_t nearest(const TestMesh& mesh, Vec3 to) {
  uint32_t best = 0;
  for (uint32_t v = 1; v < mesh.vertexCount(); ++v)
    if (distance(mesh.at(v), to) < distance(mesh.at(best), to)) best = v;
  return best;
}

/// The largest distance of new vertices from the unit sphere.
double offSphere(const Filled& filled, uint32_t old) {
  double most = 0;
  for (uint32_t v = old; v < filled.mesh.vertexCount(); ++v)
    most = std::max(most, std::fabs(length(filled.mesh.at(v)) - 1));
  return most;
}

}  // namespace

TEST_CASE("fill: holes of a sphere are closed, and cannot be told from it") {
  const TestMesh sphere = sphereMesh(4);
  for (const double radius : {0.2, 0.5, 0.9}) {
    CAPTURE(radius);
    const TestMesh cut = without(sphere, isNear({0, 0, 1}, radius));
    const Filled filled = fillAll(cut);
    expectWhole(filled, 1);
    CHECK(offSphere(filled, cut.vertexCount()) < 3e-3);
    CHECK(filled.holes[0].fairnessUsed == 3);
    CHECK(filled.holes[0].rimAngleAfter < filled.holes[0].rimAngleBefore);
  }
}

TEST_CASE("fill: an island belongs to its hole, a band to its two rims") {
  const TestMesh ring = without(sphereMesh(4), isBetween({0, 0, 1}, 0.25, 0.7));
  const Filled filled = fillAll(ring);
  expectWhole(filled, 1);
  CHECK(offSphere(filled, ring.vertexCount()) < 5e-3);
  const TestMesh band =
      without(torusMesh(24, 60), [](Vec3 p) { return p.x > 0.7 && std::fabs(p.y) < 0.3; });
  expectWhole(fillAll(band), 1);
}

TEST_CASE("fill: many holes, sizes and places, one after the other") {
  for (const double size : {1e-6, 1.0, 1e6}) {
    CAPTURE(size);
    TestMesh mesh = sphereMesh(4);
    for (const Vec3 p : {Vec3{0, 0, 1}, {1, 0, 0}, {0, -1, 0}, {-0.6, 0.8, 0}})
      mesh = without(mesh, isNear(p, 0.3));
    mesh = mapped(mesh, [size](Vec3 p) { return size * p + Vec3{3 * size, 0, 0}; });
    expectWhole(fillAll(mesh), 4);
  }
}

TEST_CASE("fill: a plane stays one, without vertices of its own") {
  const TestMesh sheet = without(saddleMesh(20, 0), isNear({0.1, 0.2, 0}, 0.4));
  const Filled filled = fillAll(sheet);
  REQUIRE(filled.holes.size() == 1);
  CHECK(filled.open == 1);
  CHECK(filled.mesh.vertexCount() == sheet.vertexCount());
  CHECK(filled.holes[0].fairnessUsed == 0);
}

TEST_CASE("fill: creases of a box go on, through an edge and through a corner") {
  for (const Vec3 centre : {Vec3{1, 1, 0}, {1, 1, 1}}) {
    CAPTURE(centre.z);
    const TestMesh box = without(boxMesh(12), isNear(centre, 0.45));
    const Filled filled = fillAll(box);
    expectWhole(filled, 1);
    double most = 0;
    for (uint32_t v = box.vertexCount(); v < filled.mesh.vertexCount(); ++v) {
      const Vec3 p = filled.mesh.at(v);
      most =
          std::max(most, std::fabs(std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}) - 1));
    }
    CHECK(most < 1e-9);
    FillOptions plain;
    plain.crease = 0;
    expectWhole(fillAll(box, plain), 1);
  }
}

TEST_CASE(
    "fill: where the rim runs along creases, and through the corner where they meet, the box is as "
    "it was") {
  const auto nearCorner = isNear({1, 1, 1}, 0.45);
  const auto nearEdge = isNear({1, 1, 0}, 0.45);
  const std::vector<PlaceTest> holes = {
      [&](Vec3 p) { return nearCorner(p) && p.z < 1 - 1e-9; },  // two sides
      [&](Vec3 p) { return nearCorner(p) && p.x > 1 - 1e-9; },  // one side
      [&](Vec3 p) { return nearEdge(p) && p.x > 1 - 1e-9; },    // to an edge
  };
  for (size_t i = 0; i < holes.size(); ++i) {
    CAPTURE(i);
    const TestMesh box = without(boxMesh(12), holes[i]);
    const Filled filled = fillAll(box);
    expectWhole(filled, 1);
    CHECK(compact(filled.mesh).vertexCount() ==
          compact(box).vertexCount() + filled.mesh.vertexCount() - box.vertexCount());
    for (size_t f = box.faces.size(); f < filled.mesh.faces.size(); f += 3) {
      const Vec3 p = filled.mesh.middle(uint32_t(f / 3));
      CHECK(std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}) == doctest::Approx(1));
    }
  }
}

TEST_CASE("fill: no refining, no fairing, and only so many vertices") {
  const TestMesh cut = without(sphereMesh(4), isNear({0, 0, 1}, 0.6));
  FillOptions options;
  options.refining.density = 0, options.fairing = Fairing::None;
  const Filled plain = fillAll(cut, options);
  expectWhole(plain, 1);
  CHECK(plain.mesh.vertexCount() == cut.vertexCount());
  CHECK(plain.holes[0].optimal);
  options.refining.density = 1.5, options.refining.maxNewVertices = 20;
  CHECK(fillAll(cut, options).mesh.vertexCount() <= cut.vertexCount() + 20);
  options.fairing = Fairing::Bending;
  CHECK(fillAll(cut, options).holes[0].fairnessUsed == 2);
}

TEST_CASE("fill: never more than so many vertices, on creases and on edges that are split") {
  FillOptions options;
  // Creases part the hole in three.
  const TestMesh box = without(boxMesh(12), isNear({1, 1, 1}, 0.45));
  // Two holes that share two vertices, so that no patch may have the edge between these.
  TestMesh shared;
  for (const Vec3 p : {Vec3{-.19, -.878, -2.109},
                       {-.632, -.738, -1.696},
                       {-.358, -1.018, -1.481},
                       {.26, -1.055, -1.542},
                       {-.875, -.475, -1.18},
                       {-.713, -.906, -1.151},
                       {-.204, -.861, -1.132},
                       {-.555, -.695, -.915}})
    shared.addVertex(p);
  for (const auto& f :
       {std::array<uint32_t, 3>{0, 2, 1}, {1, 5, 4}, {1, 2, 6}, {2, 3, 6}, {5, 6, 7}})
    shared.addFace(f[0], f[1], f[2]);
  uint32_t filledOnes = 0;
  for (const TestMesh* mesh : std::array<const TestMesh*, 2>{&box, &shared})
    for (const double density : {0.0, 1.4, 3.0})
      for (uint32_t most = 0; most < 12; ++most) {
        CAPTURE(density);
        CAPTURE(most);
        options.refining.density = density, options.refining.maxNewVertices = most;
        const Filled filled = fillAll(*mesh, options, true);
        CHECK(filled.mesh.vertexCount() <= mesh->vertexCount() + most * filled.holes.size());
        for (const FilledHole& hole : filled.holes) {
          const bool isFilled = hole.status != FillStatus::Failed;
          filledOnes += isFilled;
          CHECK((isFilled || hole.reason == FillReason::DuplicateFace));
          // A few vertices more do for any of them.
          CHECK((isFilled || most < 4));
        }
        if (filled.holes[0].status != FillStatus::Failed && filled.holes.size() == 1)
          CHECK(openOrTwisted(filled.mesh) == 0);
      }
  CHECK(filledOnes > 50);
}

TEST_CASE("fill: what cannot be filled says why, and the next hole is filled") {
  // A triangle alone: the face on its rim would be the same as it is.
  TestMesh triangle;
  for (const Vec3 p : {Vec3{50, 0, 0}, {51, 0, 0}, {50, 1, 0}}) triangle.addVertex(p);
  triangle.addFace(0, 1, 2);
  const TestMesh both = together(triangle, without(sphereMesh(3), isNear({0, 0, 1}, 0.5)));
  const Filled filled = fillAll(both, {}, true);
  REQUIRE(filled.holes.size() == 2);
  const bool isFirst = filled.holes[0].status == FillStatus::Failed;
  const FilledHole& failed = filled.holes[isFirst ? 0 : 1];
  CHECK(failed.status == FillStatus::Failed);
  CHECK(failed.reason == FillReason::DuplicateFace);
  CHECK(failed.firstFace == failed.endFace);
  CHECK(filled.holes[isFirst ? 1 : 0].status == FillStatus::Filled);
}

TEST_CASE("fill: noise and random gaps end without a crash, and what is filled is wound alike") {
  Random random(20261130);
  for (int round = 0; round < 30; ++round) {
    CAPTURE(round);
    TestMesh mesh = noisy(sphereMesh(3), round % 3 * 0.02, random);
    std::vector<uint32_t> kept;
    for (uint32_t f = 0; f < mesh.faceCount(); ++f)
      if (random.unit() > 0.01 * (round + 1))
        kept.insert(kept.end(), mesh.faces.begin() + 3 * f, mesh.faces.begin() + 3 * f + 3);
    mesh.faces = kept;
    const Filled filled = fillAll(mesh, {}, true);
    for (size_t i = 0; i < mesh.positions.size(); ++i)
      CHECK(filled.mesh.positions[i] == mesh.positions[i]);
    for (size_t i = 0; i < mesh.faces.size(); ++i) CHECK(filled.mesh.faces[i] == mesh.faces[i]);
    for (const double x : filled.mesh.positions) CHECK(std::isfinite(x));
    // No edge runs twice the same way, whatever was filled.
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    for (size_t f = 0; f < filled.mesh.faces.size(); f += 3)
      for (int k = 0; k < 3; ++k)
        CHECK(++edges[{filled.mesh.faces[f + k], filled.mesh.faces[f + (k + 1) % 3]}] == 1);
  }
}

TEST_CASE("fill: work that ends gives back a status and leaves what was filled before") {
  const TestMesh mesh = without(sphereMesh(4), isNear({0, 0, 1}, 0.8));
  const MeshView view = mesh.view();
  for (const size_t bytes : {size_t(100'000), size_t(600'000), size_t(1'500'000)}) {
    CAPTURE(bytes);
    Work work(bytes, nullptr, nullptr);
    Charge charge(work);
    Adjacency adjacency;
    Rims rims;
    if (!buildAdjacency(view, work, charge, adjacency) ||
        !findRims(view, adjacency, work, charge, rims))
      continue;
    Surroundings around;
    if (!survey(view, adjacency, rims, work, charge, around)) continue;
    HoleFiller filler(view, adjacency, rims, around, work);
    FilledHole hole;
    const std::vector<uint32_t> all{0};
    const Status status = filler.fill(all, {}, hole);
    CHECK((status == Status::Ok || status == Status::OutOfMemory));
    if (status != Status::Ok) CHECK(filler.newFaces().empty());
  }
}

TEST_CASE("fill: an island that touches the rim in a vertex closes to one surface with it") {
  const TestMesh sphere = sphereMesh(4);
  for (const uint32_t rings : {0u, 1u, 2u}) {
    uint32_t touching = 0;
    for (uint32_t v = 0; v < sphere.vertexCount(); ++v) {
      Cutting cutting(sphere, isNear({0, 0, 1}, 0.55));
      if (!cutting.isTaken(v) || !cutting.addIsland(v, rings)) continue;
      if (++touching % 5 != 1) continue;  // some of them
      CAPTURE(rings);
      CAPTURE(v);
      const TestMesh cut = cutting.cut();
      const Filled filled = fillAll(cut);
      expectWhole(filled, 1);
      CHECK(pinched(filled.mesh) == 0);
      CHECK(offSphere(filled, cut.vertexCount()) < 5e-3);
    }
    CHECK(touching > 5);
  }
}

TEST_CASE(
    "fill: an island that touches the rim in two vertices leaves two holes, in three, three") {
  const TestMesh sphere = sphereMesh(4);
  std::vector<uint32_t> touching;
  for (const double angle : {0.3, 2.2, 4.4}) {
    // The vertex of the rim in that direction from which a face of the hole goes inwards.
    const Cutting cutting(sphere, isNear({0, 0, 1}, 0.55));
    uint32_t best = kNone;
    double most = -1;
    for (uint32_t v = 0; v < sphere.vertexCount(); ++v) {
      Cutting tried = cutting;
      const Vec3 p = sphere.at(v);
      const double along = p.x * std::cos(angle) + p.y * std::sin(angle);
      if (along > most && cutting.isTaken(v) && tried.addIsland(v, 0)) most = along, best = v;
    }
    touching.push_back(best);
    Cutting pinchedOff = cutting;
    pinchedOff.addIslandInside(touching);
    const TestMesh cut = pinchedOff.cut();
    const Filled filled = fillAll(cut);
    expectWhole(filled, touching.size());
    CHECK(pinched(filled.mesh) == 0);
  }
}

TEST_CASE("fill: islands that touch each other, and the rim, close to one surface") {
  const TestMesh sphere = sphereMesh(4);
  Cutting cutting(sphere, isNear({0, 0, 1}, 0.7));
  const uint32_t v = nearest(sphere, {0.05, 0.02, 1});
  REQUIRE(cutting.addIsland(v, 1));
  REQUIRE(cutting.addIsland(v, 0));
  const TestMesh two = cutting.cut();
  const Filled filled = fillAll(two);
  expectWhole(filled, 1);
  CHECK(pinched(filled.mesh) == 0);
  CHECK(offSphere(filled, two.vertexCount()) < 8e-3);
}

TEST_CASE(
    "fill: two holes that touch, taken for one, get one surface, or one each where it would "
    "pinch") {
  for (const double bend : {0.0, 0.2}) {
    CAPTURE(bend);
    const TestMesh cut = without(saddleMesh(16, bend), [](Vec3 p) {
      return p.x * p.y > 0 && std::fabs(p.x) < 0.5 && std::fabs(p.y) < 0.5;
    });
    const Filled each = fillAll(cut);
    REQUIRE(each.holes.size() == 2);
    Work work;
    Charge charge(work);
    Adjacency adjacency;
    Rims rims;
    REQUIRE(buildAdjacency(cut.view(), work, charge, adjacency));
    REQUIRE(findRims(cut.view(), adjacency, work, charge, rims));
    std::vector<uint32_t> pair;
    for (uint32_t r = 0; r < rims.count(); ++r)
      if (rims.rims[r].length < 5) pair.push_back(r);
    REQUIRE(pair.size() == 2);
    const Filled both = fillAll(cut, {}, true, {pair});
    REQUIRE(both.holes.size() == 1);
    CHECK(both.holes[0].status == FillStatus::Filled);
    CHECK((both.mesh.faces == each.mesh.faces) == (bend == 0));
    CHECK(openOrTwisted(both.mesh) == 64);
    CHECK(pinched(both.mesh) == pinched(each.mesh));
  }
}
