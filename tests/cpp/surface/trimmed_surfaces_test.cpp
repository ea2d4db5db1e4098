// Meshes of trimmed surfaces: closed where the model is, as near as the tolerance says by an evaluation of their own, the same
// through updates as from scratch; and edits.
#include "surface/trimmed_surfaces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include <doctest/doctest.h>

#include "support/surface_checks.h"

using namespace sf;

TEST_CASE(
    "TrimmedSurfaces: a cylinder with its seam and two discs is closed, and its area and volume "
    "converge") {
  Opened cylinder(solidCylinder(1, 2));
  REQUIRE(cylinder.faults.empty());
  double before = 0;
  for (const double tolerance : {0.04, 0.01, 0.0025, 0.000625}) {
    Tessellation told;
    REQUIRE(cylinder.surfaces->tessellate(samplingOf(tolerance), {}, cylinder.work, told));
    const Facts facts = check(*cylinder.surfaces, told);
    CHECK(facts.openEdges == 0);
    CHECK(facts.vertices + facts.triangles == facts.edges + 2);
    CHECK(told.deviation <= tolerance);
    CHECK(deviation(*cylinder.surfaces, 0, told.origin) <= tolerance * 1.01);
    const double error = 2 * kPi - facts.volume;
    CHECK(error > 0);
    CHECK(error < 2 * kPi * 2 * tolerance);
    CHECK(std::fabs(facts.area - 6 * kPi) < 6 * kPi * 2 * tolerance);
    // Errors fall as tolerances do.
    if (before > 0) CHECK(error < before / 2);
    before = error;
    CHECK(told.reports.empty());
  }
}

TEST_CASE("TrimmedSurfaces: a sphere without loops has one vertex at each pole") {
  Opened ball(sphere(3));
  REQUIRE(ball.faults.empty());
  for (const double aspect : {1.0, 3.0, Sampling::kNoLimit}) {
    Tessellation told;
    REQUIRE(ball.surfaces->tessellate(samplingOf(0.01, 0.3, aspect), {}, ball.work, told));
    const Facts facts = check(*ball.surfaces, told);
    CHECK(facts.openEdges == 0);
    CHECK(facts.vertices + facts.triangles == facts.edges + 2);
    CHECK(told.deviation <= 0.01);
    CHECK(facts.volume == doctest::Approx(36 * kPi).epsilon(0.01));
    const MeshLayout& mesh = ball.surfaces->layout();
    std::set<uint32_t> poles;
    for (const uint32_t v : mesh.triangles)
      if (std::fabs(std::fabs(mesh.positions[3 * v + 2]) - 3) < 1e-6) poles.insert(v);
    CHECK(poles.size() == 2);
    for (uint32_t v = 0; v < mesh.positions.size() / 3; ++v) {
      const Vec3 n{mesh.normals[3 * v], mesh.normals[3 * v + 1], mesh.normals[3 * v + 2]};
      CHECK(length((1 / 3.0) * at(mesh, v) - n) < 1e-5);
    }
  }
}

TEST_CASE("TrimmedSurfaces: wavy plates with holes are as near as they are to be, at any aspect") {
  for (uint32_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const uint32_t holes = seed % 9;
    Opened plate(wavyPlate(random, seed % 2 ? 0.05 : 0.3, holes));
    REQUIRE(plate.faults.empty());
    for (const double aspect : {1.5, 3.0, Sampling::kNoLimit})
      for (const double tolerance : {0.01, 0.001}) {
        Tessellation told;
        REQUIRE(
            plate.surfaces->tessellate(samplingOf(tolerance, 10, aspect), {}, plate.work, told));
        const Facts facts = check(*plate.surfaces, told);
        // Euler: one component with `holes` holes.
        CHECK(int(facts.vertices) - int(facts.edges) + int(facts.triangles) == 1 - int(holes));
        CHECK(told.deviation <= tolerance);
        CHECK(deviation(*plate.surfaces, 0, told.origin) <= tolerance * 1.3);
      }
  }
}

TEST_CASE(
    "TrimmedSurfaces: updates make meshes as good as those from scratch, with the same samples of "
    "edges") {
  for (uint32_t seed = 1; seed <= 6; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const bool isPlate = seed % 2 == 0;
    const auto model = [&] {
      std::mt19937 same(seed);
      return isPlate ? wavyPlate(same, 0.2, 7) : solidCylinder(1, 2);
    };
    Opened kept(model()), fresh(model());
    std::uniform_real_distribution<double> logs(std::log(3e-4), std::log(3e-2));
    for (int step = 0; step < 40; ++step) {
      CAPTURE(step);
      const Sampling sampling =
          samplingOf(std::exp(logs(random)), random() % 2 ? 0.3 : 10, random() % 3 ? 3 : 8);
      Tessellation updated, scratch;
      REQUIRE(kept.surfaces->update(sampling, {}, kept.work, updated));
      REQUIRE(fresh.surfaces->tessellate(sampling, {}, fresh.work, scratch));
      const Facts a = check(*kept.surfaces, updated), b = check(*fresh.surfaces, scratch);
      CHECK(a.openEdges == b.openEdges);
      CHECK(int(a.vertices) - int(a.edges) + int(a.triangles) ==
            int(b.vertices) - int(b.edges) + int(b.triangles));
      CHECK(updated.deviation <= sampling.tolerance);
      const auto along = [](const TrimmedSurfaces& s, const Tessellation& told) {
        std::vector<Vec3> all;
        for (const uint32_t v : told.edges) all.push_back(at(s.layout(), v));
        return all;
      };
      CHECK(along(*kept.surfaces, updated) == along(*fresh.surfaces, scratch));
    }
  }
}

TEST_CASE("TrimmedSurfaces: an update tells all that it has written, and no more than changes") {
  std::mt19937 random(5);
  Opened plate(wavyPlate(random, 0.2, 9));
  Tessellation told;
  REQUIRE(plate.surfaces->update(samplingOf(0.01), {}, plate.work, told));
  REQUIRE(plate.surfaces->update(samplingOf(0.005), {}, plate.work, told));
  const MeshLayout& mesh = plate.surfaces->layout();
  MeshLayout before = mesh;
  for (const double tolerance : {0.0049, 0.0045, 0.004, 0.0045, 0.006}) {
    REQUIRE(plate.surfaces->update(samplingOf(tolerance), {}, plate.work, told));
    const auto write = [](auto& to, const auto& from, const std::vector<uint32_t>& ranges,
                          size_t width) {
      to.resize(from.size());
      for (size_t i = 0; i < ranges.size(); i += 2)
        std::copy(from.begin() + ptrdiff_t(width * ranges[i]),
                  from.begin() + ptrdiff_t(width * ranges[i + 1]),
                  to.begin() + ptrdiff_t(width * ranges[i]));
    };
    write(before.positions, mesh.positions, mesh.vertexRanges, 3);
    write(before.normals, mesh.normals, mesh.vertexRanges, 3);
    write(before.uvs, mesh.uvs, mesh.vertexRanges, 2);
    write(before.triangles, mesh.triangles, mesh.indexRanges, 1);
    write(before.strips, mesh.strips, mesh.stripRanges, 1);
    CHECK(before.positions == mesh.positions);
    CHECK(before.normals == mesh.normals);
    CHECK(before.uvs == mesh.uvs);
    CHECK(before.triangles == mesh.triangles);
    CHECK(before.strips == mesh.strips);
  }
  REQUIRE(plate.surfaces->update(samplingOf(0.006), {}, plate.work, told));
  CHECK(told.faces.empty());
  CHECK(mesh.vertexRanges.empty());
  CHECK(mesh.indexRanges.empty());
}

TEST_CASE("TrimmedSurfaces: few enough triangles, with the tolerance told") {
  Opened cylinder(solidCylinder(1, 2));
  Tessellation told;
  TessellationLimits limits;
  limits.maxTriangles = 300;
  REQUIRE(cylinder.surfaces->tessellate(samplingOf(1e-5), limits, cylinder.work, told));
  const Facts facts = check(*cylinder.surfaces, told);
  CHECK(facts.triangles <= 300);
  CHECK(facts.triangles > 60);
  CHECK(facts.openEdges == 0);
  REQUIRE(told.reports.size() == 1);
  CHECK(told.reports[0].report == SurfaceReport::ToleranceRaised);
  CHECK(told.reports[0].value > 1e-5);
  CHECK(told.deviation <= told.reports[0].value);
}

TEST_CASE("TrimmedSurfaces: what a camera does not see is coarse, and what is near it fine") {
  Opened ball(sphere(1));
  // At (0, 0, 20), looking down, 90 degrees wide.
  Camera camera{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1.002, -1, 0, 0, 19.84, 20}, 1000, 1000};
  Sampling sampling = samplingOf(Sampling::kNoLimit);
  sampling.pixels = 1, sampling.camera = &camera;
  Tessellation told;
  const auto triangles = [&] {
    REQUIRE(ball.surfaces->update(sampling, {}, ball.work, told));
    return check(*ball.surfaces, told).triangles;
  };
  const size_t far = triangles();
  CHECK(told.deviation < 2 * 20 / 500.0);
  camera.matrix[14] = 1.8, camera.matrix[15] = 2;
  const size_t near = triangles();
  CHECK(near > 4 * far);
  CHECK(told.deviation < 2 * 2 / 500.0);
  // Looking away.
  for (double* m : {&camera.matrix[10], &camera.matrix[11]}) *m = -*m;
  camera.matrix[14] = -2.2, camera.matrix[15] = -2;
  CHECK(triangles() < far);
}

TEST_CASE(
    "TrimmedSurfaces: memory is limited for all faces together, and what it is too little for "
    "leaves nothing behind") {
  Opened opened(solidCylinder(1, 20));
  Tessellation told;
  const TessellationLimits none;
  Work little(20'000, nullptr, nullptr);
  CHECK_FALSE(opened.surfaces->tessellate(samplingOf(1e-4), none, little, told));
  CHECK(little.status() == Status::OutOfMemory);
  Work enough(50'000'000, nullptr, nullptr);
  REQUIRE(opened.surfaces->update(samplingOf(1e-4), none, enough, told));
  check(*opened.surfaces, told);
}

TEST_CASE("TrimmedSurfaces: whatever is allowed, no triangle is without area") {
  std::mt19937 random(5);
  for (const ModelBuilder& model : {sphere(1), solidCylinder(1, 20), wavyPlate(random, 0.3, 3)})
    for (const double tolerance : {1.0, 1e9, Sampling::kNoLimit}) {
      Opened opened(model);
      Tessellation told;
      const TessellationLimits none;
      REQUIRE(opened.surfaces->tessellate(samplingOf(tolerance), none, opened.work, told));
      for (const Report& report : told.reports)
        CHECK(report.report == SurfaceReport::CrossingSamples);
      check(*opened.surfaces, told);
    }
}

TEST_CASE("TrimmedSurfaces: poles move, and a move that is refused leaves all as it was") {
  std::mt19937 random(3);
  Opened plate(wavyPlate(random, 0.1, 4));
  TrimmedSurfaces& s = *plate.surfaces;
  Tessellation told;
  const Sampling sampling = samplingOf(0.002);
  REQUIRE(s.update(sampling, {}, plate.work, told));
  ModelFault fault{};
  // A pole in the middle.
  REQUIRE(s.movePole(0, 24, {0.5, 0.5, 2}, 0, plate.work, fault));
  REQUIRE(s.update(sampling, {}, plate.work, told));
  check(s, told);
  CHECK(told.deviation <= 0.002);
  CHECK(deviation(s, 0, told.origin) <= 0.002 * 1.3);
  REQUIRE(s.movePole(0, 24, {0.5, 0.5, 2}, 3, plate.work, fault));
  REQUIRE(s.update(sampling, {}, plate.work, told));
  check(s, told);
  // A corner of the outer loop takes the next curve along.
  REQUIRE(s.moveTrim(0, 0, 1, 1, {0.9, 0.95}, plate.work, fault));
  REQUIRE(s.update(sampling, {}, plate.work, told));
  const Facts facts = check(s, told);
  CHECK(int(facts.vertices) - int(facts.edges) + int(facts.triangles) == 1 - 4);
  const std::vector<float> positions = s.layout().positions;
  CHECK_FALSE(s.moveTrim(0, 0, 1, 1, {1.5, 1}, plate.work, fault));
  CHECK(fault.fault == SurfaceFault::TrimOutside);
  // Across all of the plate, through holes.
  CHECK_FALSE(s.moveTrim(0, 0, 1, 1, {0.01, 0.02}, plate.work, fault));
  CHECK(fault.face == 0);
  REQUIRE(s.update(sampling, {}, plate.work, told));
  check(s, told);
  CHECK(s.layout().positions == positions);
}

TEST_CASE("TrimmedSurfaces: moves that open a seam or a pole, or lead out of reach, are refused") {
  Opened ball(sphere(1));
  TrimmedSurfaces& s = *ball.surfaces;
  const Sampling sampling = samplingOf(0.002);
  Tessellation told;
  REQUIRE(s.update(sampling, {}, ball.work, told));
  const std::vector<float> positions = s.layout().positions;
  ModelFault fault{};
  // On the seam, and at the south pole.
  for (const uint32_t pole : {2u, 0u, 10u}) {
    CHECK_FALSE(s.movePole(0, pole, {1.5, 0.5, 0.2}, 0, ball.work, fault));
    CHECK(fault.fault == SurfaceFault::BadEdge);
    CHECK(fault.edge != kNone);
  }
  CHECK_FALSE(s.movePole(0, 22, {1e40, 0, 0}, 0, ball.work, fault));
  CHECK(fault.fault == SurfaceFault::NotFinite);
  CHECK_FALSE(s.movePole(0, 22, {0, 0, 0}, 1e-20, ball.work, fault));
  CHECK(fault.fault == SurfaceFault::BadWeights);
  REQUIRE(s.update(sampling, {}, ball.work, told));
  CHECK(s.layout().positions == positions);
  // What leaves the seam as it is can move.
  REQUIRE(s.movePole(0, 22, {-1.5, 0.2, 0.1}, 0, ball.work, fault));
  REQUIRE(s.update(sampling, {}, ball.work, told));
  check(s, told);
  CHECK(told.deviation <= 0.002);
}

TEST_CASE("TrimmedSurfaces: edges of several faces do not move") {
  Opened cylinder(solidCylinder(1, 2));
  ModelFault fault{};
  CHECK_FALSE(cylinder.surfaces->movePole(0, 0, {1, 1, 1}, 0, cylinder.work, fault));
  CHECK(fault.fault == SurfaceFault::BadEdge);
  CHECK_FALSE(cylinder.surfaces->moveTrim(1, 0, 0, 2, {0, 0.5}, cylinder.work, fault));
  CHECK(fault.fault == SurfaceFault::BadEdge);
  CHECK(fault.edge == 1);
}

TEST_CASE("TrimmedSurfaces: samples that cross where curves do not are halved, and counted") {
  // Two half circles, one a little within the other: at few samples their chords cross.
  ModelBuilder m;
  const TestSpline outer = circle({0, 0}, 1), inner = circle({0.045, 0.01}, 0.95, true);
  m.addFace(square(2, 0), {{{m.addEdge(0, 4), false, outer}}, {{m.addEdge(0, 4), false, inner}}});
  Opened ring(m);
  REQUIRE(ring.faults.empty());
  Tessellation told;
  REQUIRE(ring.surfaces->tessellate(samplingOf(0.5), {}, ring.work, told));
  const Facts facts = check(*ring.surfaces, told);
  CHECK(int(facts.vertices) - int(facts.edges) + int(facts.triangles) == 0);
  REQUIRE(told.reports.size() == 1);
  CHECK(told.reports[0].report == SurfaceReport::CrossingSamples);
  CHECK(told.reports[0].value > 0);
}

TEST_CASE("TrimmedSurfaces: loops that cross or lie wrongly are named") {
  const auto faultOf = [](const std::vector<TestSpline>& loops) {
    ModelBuilder m;
    std::vector<std::vector<ModelBuilder::Use>> all;
    for (const TestSpline& c : loops)
      all.push_back({{m.addEdge(c.knots[c.degree], c.knots[c.count()]), false, c}});
    m.addFace(square(2, 0), all);
    const Opened opened(m);
    REQUIRE(opened.faults.size() == 1);
    CHECK(opened.surfaces->model().faces[0].isLeftOut);
    return opened.faults[0];
  };
  const TestSpline outer = circle({0, 0}, 1.5);
  const ModelFault crossed = faultOf({outer, circle({0, 0}, 0.3), circle({0.5, 0}, 0.3)});
  CHECK(crossed.fault == SurfaceFault::TrimsCross);
  CHECK(crossed.loop == 1);
  CHECK(crossed.otherLoop == 2);
  const ModelFault outside = faultOf({circle({-1, 0}, 0.5), circle({1, 0}, 0.5)});
  CHECK(outside.fault == SurfaceFault::HoleOutside);
  CHECK(outside.loop == 1);
  const TestSpline eight{1, {0, 0, 1, 2, 3, 4, 4}, {-1, -1, 1, 1, 1, -1, -1, 1, -1, -1}, {}, 0, {}};
  const ModelFault self = faultOf({eight});
  CHECK(self.fault == SurfaceFault::TrimSelfIntersects);
  CHECK(self.loop == 0);
  CHECK(self.use == 0);
  const TestSpline back{1, {0, 0, 1, 2, 2}, {-1, -1, 1, 1, -1, -1}, {}, 0, {}};
  CHECK(faultOf({back}).fault == SurfaceFault::Degenerate);
  const ModelFault leaves = faultOf({circle({1, 0}, 1.5)});
  CHECK(leaves.fault == SurfaceFault::TrimOutside);
  CHECK(leaves.use == 0);
}
