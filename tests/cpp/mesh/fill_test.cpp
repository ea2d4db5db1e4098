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

/// All holes of a mesh filled, open rims too if `all`.
struct Filled {
  std::vector<FilledHole> holes;
  TestMesh mesh;
  uint32_t open = 0;
};

Filled fillAll(const TestMesh& input, const FillOptions& options = {}, bool all = false) {
  Work work;
  Charge charge(work);
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
  for (uint32_t g = 0; g < groups.count(); ++g) {
    if (groups.isOpenRim[g] && !all) {
      ++result.open;
      continue;
    }
    FilledHole hole;
    REQUIRE(filler.fill({groups.rims.data() + groups.starts[g],
                         size_t(groups.starts[g + 1] - groups.starts[g])},
                        options, hole) == Status::Ok);
    result.holes.push_back(hole);
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
