#include "mesh/fair.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "mesh/refine.h"
#include "mesh/smooth_patch.h"
#include "mesh/sparse_cholesky.h"
#include "support/patches.h"

using namespace sftest;
using sf::Fairness;
using sf::FairOptions;
using sf::LocalSurface;
using sf::Status;
using sf::Vec3;
using sf::Work;

namespace {

const double kPi = std::acos(-1.0);

double toSphere(Vec3 p) { return std::fabs(length(p) - 1); }

LocalSurface smoothed(const LocalSurface& before, uint32_t order, Fairness* fairness = nullptr) {
  LocalSurface after = before;
  Work work;
  FairOptions options;
  options.order = order;
  Fairness result;
  CHECK(sf::smoothPatch(after, {}, options, work, result) == Status::Ok);
  CHECK(work.used() == 0);
  CHECK(std::equal(before.positions.begin(), before.positions.begin() + 3 * before.fixedVertices,
                   after.positions.begin()));
  for (const double x : after.positions) CHECK(std::isfinite(x));
  if (fairness) *fairness = result;
  return after;
}

}  // namespace

TEST_CASE("fair: holes in spheres, a half sphere and more, come back as spheres") {
  const Sheet sphere = sphereSheet(4);
  for (const double degrees : {15.0, 30.0, 60.0, 90.0, 101.0}) {
    Fairness fairness;
    const LocalSurface after = smoothed(cutHole(sphere, cap(degrees)).surface, 3, &fairness);
    CHECK(fairness.order == 3);
    CHECK(fairness.moved > 0);
    // The middle of the flat triangles of this sphere alone is 5e-4 below it.
    CHECK(patchError(after, toSphere) < 1e-3);
    CHECK(shapeOf(after).isManifold);
  }
}

TEST_CASE("fair: holes in a torus, a cylinder, a saddle and a plane") {
  const auto toTorus = [](Vec3 p) {
    return std::fabs(std::hypot(std::hypot(p.x, p.y) - 1, p.z) - 0.4);
  };
  const Sheet torus = torusSheet(96, 40, 1, 0.4);
  for (const double radius : {0.2, 0.4})
    CHECK(patchError(smoothed(cutHole(torus,
                                      [=](Vec3 p) {
                                        return length(p - Vec3{1.28, 0, 0.28}) < radius;
                                      })
                                  .surface,
                              3),
                     toTorus) < 2e-3);
  const auto toCylinder = [](Vec3 p) { return std::fabs(std::hypot(p.x, p.y) - 1); };
  const Sheet cylinder = cylinderSheet(60, 40, 4);
  CHECK(patchError(smoothed(cutHole(cylinder,
                                    [](Vec3 p) {
                                      return length(p - Vec3{1, 0, 0}) < 1;
                                    })
                                .surface,
                            3),
                   toCylinder) < 1e-3);
  CHECK(patchError(
            smoothed(cutHole(cylinder, [](Vec3 p) { return std::fabs(p.z) < 0.7; }).surface, 3),
            toCylinder) < 1e-3);
  const Sheet saddle = graphSheet(40, [](double x, double y) { return x * x - y * y; });
  CHECK(patchError(
            smoothed(cutHole(saddle, [](Vec3 p) { return std::hypot(p.x, p.y) < 0.5; }).surface, 3),
            [](Vec3 p) { return std::fabs(p.z - p.x * p.x + p.y * p.y); }) < 1e-3);
  const Sheet plane = graphSheet(40, [](double, double) { return 0.0; });
  for (const uint32_t order : {1u, 2u, 3u})
    CHECK(
        patchError(smoothed(cutHole(plane, [](Vec3 p) { return length(p) < 0.5; }).surface, order),
                   [](Vec3 p) { return std::fabs(p.z); }) < 1e-12);
}

TEST_CASE("fair: the higher the order, the closer to the sphere") {
  const Hole hole = cutHole(sphereSheet(4), cap(60));
  double last = 1;
  for (const uint32_t order : {1u, 2u, 3u}) {
    Fairness fairness;
    const double error = patchError(smoothed(hole.surface, order, &fairness), toSphere);
    CHECK(fairness.order == order);
    CHECK(error < 0.5 * last);
    last = error;
  }
}

TEST_CASE("fair: tiny, huge and far surfaces come out alike") {
  const Hole hole = cutHole(sphereSheet(3), cap(40));
  const LocalSurface plain = smoothed(hole.surface, 3);
  for (const double size : {0x1p-100, 0x1p100}) {
    LocalSurface scaled = hole.surface;
    for (double& x : scaled.positions) x *= size;
    const LocalSurface after = smoothed(scaled, 3);
    REQUIRE(after.positions.size() == plain.positions.size());
    double worst = 0;
    for (size_t i = 0; i < plain.positions.size(); ++i)
      worst = std::fmax(worst, std::fabs(after.positions[i] / size - plain.positions[i]));
    CHECK(worst < 1e-9);
  }
  LocalSurface far = hole.surface;
  for (double& x : far.positions) x += 1e5;
  CHECK(patchError(smoothed(far, 3), [](Vec3 p) {
          return toSphere(p - Vec3{1e5, 1e5, 1e5});
        }) < 5e-3);
}

TEST_CASE("fair: surroundings of few rings or none") {
  for (const uint32_t rings : {0u, 1u, 2u, 3u}) {
    const Hole hole = cutHole(sphereSheet(4), cap(30), rings);
    Fairness fairness;
    const LocalSurface after = smoothed(hole.surface, 3, &fairness);
    CHECK(fairness.order >= 1);
    CHECK(shapeOf(after).isManifold);
    if (rings >= 3) CHECK(patchError(after, toSphere) < 1e-3);
  }
}

TEST_CASE("fair: degenerate surroundings and patches give finite places") {
  std::mt19937 random(11);
  for (int round = 0; round < 40; ++round) {
    Hole hole = cutHole(sphereSheet(3), cap(50), round % 5);
    for (uint32_t v = 0; v < hole.surface.fixedVertices; ++v) {
      double* p = &hole.surface.positions[3 * v];
      const uint32_t what = random() % 6;
      if (what == 0) p[0] = p[1] = p[2] = 0.25;
      if (what == 1) p[1] = p[2] = 0;
      if (what == 2) p[2] = 0;
      if (round % 4 == 0) p[2] = 0;
      if (round % 8 == 0) p[1] = 0;
    }
    smoothed(hole.surface, 1 + round % 3);
  }
}

TEST_CASE("fair: roughness tells noise from curvature") {
  const auto roughnessOf = [](const Hole& hole) {
    Work work;
    double rough;
    CHECK(sf::roughness(hole.surface, work, rough));
    CHECK(work.used() == 0);
    return rough;
  };
  CHECK(roughnessOf(cutHole(sphereSheet(3), cap(30))) < 1e-3);
  CHECK(roughnessOf(cutHole(torusSheet(60, 30, 1, 0.4), [](Vec3 p) {
          return length(p - Vec3{1.28, 0, 0.28}) < 0.3;
        })) < 0.1);
  std::mt19937 random(2);
  const Sheet noisy =
      graphSheet(40, [&](double, double) { return 0.05 * double(random()) / 4294967296.0; });
  CHECK(roughnessOf(cutHole(noisy, [](Vec3 p) { return length(p) < 0.5; })) > sf::kRough);
  Work work;
  uint32_t order;
  CHECK(sf::findFairOrder(cutHole(noisy, [](Vec3 p) { return length(p) < 0.5; }).surface, work,
                          order));
  CHECK(order == 2);
}

TEST_CASE("fair: flat is a patch in the plane of what is around it, up to creases") {
  const auto inside = [](Vec3 p) { return std::hypot(p.x, p.y) < 0.5; };
  const Hole plane = cutHole(graphSheet(40, [](double x, double) { return 0.25 * x; }), inside);
  CHECK(sf::isFlat(plane.surface));
  CHECK_FALSE(sf::isFlat(
      cutHole(graphSheet(40, [](double x, double y) { return 0.02 * (x * x + y * y); }), inside)
          .surface));
  CHECK_FALSE(sf::isFlat(cutHole(sphereSheet(4), cap(30)).surface));
  // A plane that is bent along a side of the hole.
  const Sheet bent = graphSheet(
      41, [](double x, double) { return x > 0.5001 ? 2 * (x - 0.5) : 0.0; }, 0);
  const Hole beside =
      cutHole(bent, [](Vec3 p) { return p.x > -0.2 && p.x < 0.5 && std::fabs(p.y) < 0.4; });
  CHECK(sf::isFlat(beside.surface));
  CHECK_FALSE(sf::isFlat(beside.surface, 0));
}

TEST_CASE("fair: a patch is kept apart from a wall beside it") {
  // A dome would bulge through a lid that lies close above its flat patch.
  const Sheet sphere = sphereSheet(4);
  Hole hole = cutHole(sphere, cap(50));
  const double rim = std::cos(50 * kPi / 180);
  Sheet mesh = graphSheet(
      12, [=](double, double) { return rim + 0.15; }, 0);
  Work work;
  {
    sf::Charge charge(work);
    sf::TriangleTree tree;
    const sf::MeshView view{mesh.positions, mesh.triangles};
    REQUIRE(tree.build(view, 0, uint32_t(mesh.triangles.size() / 3), work, charge));
    sf::Smoothed result;
    CHECK(sf::smoothPatchApart(hole.surface, {}, {}, view, tree, true, work, result) == Status::Ok);
    CHECK(result.pairs == 0);
    CHECK(result.share < 1);
    CHECK(result.share > 0);
    for (size_t i = 3 * hole.surface.fixedVertices; i < hole.surface.positions.size(); ++i)
      CHECK(double(float(hole.surface.positions[i])) == hole.surface.positions[i]);
  }
  CHECK(work.used() == 0);
}

TEST_CASE("fair: work that may not go on leaves the surface as it was") {
  LocalSurface before = cutHole(sphereSheet(4), cap(60)).surface;
  Work unlimited;
  REQUIRE(sf::refine(before, {}, unlimited) == Status::Ok);
  for (const size_t bytes : {size_t(0), size_t(200'000), size_t(700'000)}) {
    LocalSurface after = before;
    Work work(bytes, nullptr, nullptr);
    Fairness fairness;
    CHECK(sf::fair(after, {}, work, fairness) == Status::OutOfMemory);
    CHECK(after.positions == before.positions);
    CHECK(work.used() == 0);
  }
}

TEST_CASE("sparse Cholesky: solves as elimination does, and tells what is not definite") {
  std::mt19937 random(4);
  for (const uint32_t n : {1u, 2u, 39u, 41u, 150u, 400u}) {
    // Points of a square, joined where they are near, and at random here and there.
    std::vector<Vec3> places;
    for (uint32_t i = 0; i < n; ++i)
      places.push_back({double(random() % 1000), double(random() % 1000), double(random() % 3)});
    std::vector<double> full(size_t(n) * n, 0.0);
    for (uint32_t i = 0; i < n; ++i)
      for (uint32_t j = 0; j < i; ++j)
        if (distance(places[i], places[j]) < 90 || random() % 500 == 0) {
          const double w = double(random()) / 4294967296.0;
          full[size_t(i) * n + j] = full[size_t(j) * n + i] = -w, full[size_t(i) * n + i] += w,
                               full[size_t(j) * n + j] += w;
        }
    for (uint32_t i = 0; i < n; ++i) full[size_t(i) * n + i] += 0.01;
    sf::SparseRows rows;
    rows.starts = {0};
    for (uint32_t i = 0; i < n; ++i) {
      for (uint32_t j = 0; j < n; ++j)
        if (full[size_t(i) * n + j] != 0)
          rows.columns.push_back(j), rows.values.push_back(full[size_t(i) * n + j]);
      rows.starts.push_back(uint32_t(rows.columns.size()));
    }
    Work work;
    {
      sf::SparseCholesky cholesky(work);
      REQUIRE(cholesky.factor(rows, places));
      std::vector<Vec3> x, b(n, Vec3{0, 0, 0});
      for (uint32_t i = 0; i < n; ++i)
        x.push_back({double(i % 7), double(i % 5) - 2, double(random() % 9)});
      for (uint32_t i = 0; i < n; ++i)
        for (uint32_t j = 0; j < n; ++j) b[i] = b[i] + full[size_t(i) * n + j] * x[j];
      cholesky.solve(b);
      double worst = 0;
      for (uint32_t i = 0; i < n; ++i) worst = std::fmax(worst, distance(b[i], x[i]));
      CHECK(worst < 1e-9);
      for (uint32_t e = rows.starts[n / 2]; e < rows.starts[n / 2 + 1]; ++e)
        if (rows.columns[e] == n / 2) rows.values[e] = -1;
      CHECK_FALSE(cholesky.factor(rows, places));
      CHECK_FALSE(cholesky.isDefinite());
      CHECK(work.going());
    }
    CHECK(work.used() == 0);
  }
}
