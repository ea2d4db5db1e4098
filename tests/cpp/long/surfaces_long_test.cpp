// Trimmed surfaces: 10 000 updates in random order, each as good as from scratch; and cameras that fly around, without a crack.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "support/surface_checks.h"

using namespace sf;

TEST_CASE("TrimmedSurfaces: 10 000 random updates, each with the same samples as from scratch") {
  for (uint32_t seed = 100; seed < 110; ++seed) {
    CAPTURE(seed);
    const auto model = [&] {
      std::mt19937 same(seed);
      return seed % 3 == 0   ? solidCylinder(1, 3)
             : seed % 3 == 1 ? wavyPlate(same, 0.2, seed % 12)
                             : sphere(1);
    };
    std::mt19937 random(seed);
    Opened kept(model()), fresh(model());
    std::uniform_real_distribution<double> logs(std::log(5e-4), std::log(0.1));
    for (int step = 0; step < 1000; ++step) {
      CAPTURE(step);
      const Sampling sampling =
          samplingOf(std::exp(logs(random)), random() % 2 ? 0.3 : 10, random() % 3 ? 3 : 8);
      Tessellation updated, scratch;
      REQUIRE(kept.surfaces->update(sampling, {}, kept.work, updated));
      const Facts a = check(*kept.surfaces, updated);
      CHECK(updated.deviation <= sampling.tolerance);
      if (step % 10 != 0) continue;
      REQUIRE(fresh.surfaces->tessellate(sampling, {}, fresh.work, scratch));
      const Facts b = check(*fresh.surfaces, scratch);
      CHECK(a.openEdges == b.openEdges);
      CHECK(int(a.vertices) - int(a.edges) + int(a.triangles) ==
            int(b.vertices) - int(b.edges) + int(b.triangles));
      CHECK(updated.edges.size() == scratch.edges.size());
    }
  }
}

TEST_CASE("TrimmedSurfaces: a camera that flies around and near sees no crack") {
  for (const double height : {1.0, 20.0}) {
    Opened opened(solidCylinder(1, height));
    for (int frame = 0; frame < 240; ++frame) {
      CAPTURE(frame);
      const double angle = 0.05 * frame, away = 1.2 + 8 * std::fabs(std::cos(0.031 * frame));
      const Vec3 eye{away * std::cos(angle), away * std::sin(angle),
                     height * (0.5 + 0.6 * std::sin(0.07 * frame))};
      // Towards the axis, z up; a field of view of 60 degrees.
      const Vec3 back = (1 / length({eye.x, eye.y, 0})) * Vec3{eye.x, eye.y, 0},
                 right{-back.y, back.x, 0}, up{0, 0, 1};
      const double f = 1.7, nearest = 0.05, farthest = 100;
      const double depth = -(farthest + nearest) / (farthest - nearest),
                   shift = -2 * farthest * nearest / (farthest - nearest);
      Camera camera;
      const Vec3 rows[3] = {right, up, back};
      for (int axis = 0; axis < 3; ++axis) {
        const auto part = [&](const Vec3& v) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; };
        camera.matrix[4 * axis] = f * part(rows[0]);
        camera.matrix[4 * axis + 1] = f * part(rows[1]);
        camera.matrix[4 * axis + 2] = depth * part(rows[2]);
        camera.matrix[4 * axis + 3] = -part(rows[2]);
      }
      camera.matrix[12] = -f * dot(rows[0], eye), camera.matrix[13] = -f * dot(rows[1], eye);
      camera.matrix[14] = -depth * dot(rows[2], eye) + shift, camera.matrix[15] = dot(rows[2], eye);
      camera.width = camera.height = 800;
      Sampling sampling;
      sampling.camera = &camera, sampling.pixels = 1, sampling.angle = 10;
      sampling.hysteresis = 0.8;
      Tessellation told;
      REQUIRE(opened.surfaces->update(sampling, {}, opened.work, told));
      const Facts facts = check(*opened.surfaces, told);
      CHECK(facts.openEdges == 0);
      CHECK(facts.vertices + facts.triangles == facts.edges + 2);
    }
  }
}
