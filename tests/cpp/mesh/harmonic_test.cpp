#include "mesh/harmonic.h"

#include <doctest/doctest.h>

#include <cmath>

#include "support/meshes.h"

using namespace sf;
using namespace sftest;

namespace {

/// A mesh with fixed vertices first.
struct Patch {
  TestMesh mesh;
  uint32_t fixedCount = 0;
};

/// The vertices at such places are fixed.
Patch patchOf(const TestMesh& mesh, const PlaceTest& isFixed) {
  Patch patch;
  std::vector<uint32_t> numbers(mesh.vertexCount());
  for (const bool fixed : {true, false}) {
    for (uint32_t v = 0; v < mesh.vertexCount(); ++v)
      if (isFixed(mesh.at(v)) == fixed) numbers[v] = patch.mesh.addVertex(mesh.at(v));
    if (fixed) patch.fixedCount = patch.mesh.vertexCount();
  }
  for (const uint32_t v : mesh.faces) patch.mesh.faces.push_back(numbers[v]);
  return patch;
}

std::vector<double> carried(const Patch& patch, uint32_t size, const std::vector<double>& values) {
  Work work;
  std::vector<double> result;
  REQUIRE(carryOn(patch.mesh.view(), patch.fixedCount, size, values, work, result));
  CHECK(work.used() == 0);
  CHECK(result.size() == size_t(size) * (patch.mesh.vertexCount() - patch.fixedCount));
  return result;
}

std::vector<double> randomValues(size_t count, Random& random) {
  std::vector<double> values(count);
  for (double& x : values) x = random.range(-1, 1);
  return values;
}

bool isOnSquare(Vec3 p) { return std::fmax(std::fabs(p.x), std::fabs(p.y)) > 0.999; }

/// The largest difference between a free vertex's value and the mean of its neighbours'.
double largestRest(const Patch& patch, uint32_t size, const std::vector<double>& values,
                   const std::vector<double>& result) {
  const uint32_t fixed = patch.fixedCount, n = patch.mesh.vertexCount();
  std::vector<double> all(values);
  all.insert(all.end(), result.begin(), result.end());
  double most = 0;
  for (uint32_t c = 0; c < size; ++c) {
    std::vector<double> sums(n), counts(n);
    for (size_t f = 0; f < patch.mesh.faces.size(); f += 3)
      for (int k = 0; k < 3; ++k)
        for (int j = 1; j < 3; ++j) {
          const uint32_t v = patch.mesh.faces[f + k], w = patch.mesh.faces[f + (k + j) % 3];
          sums[v] += all[size_t(w) * size + c], counts[v] += 1;
        }
    for (uint32_t v = fixed; v < n; ++v)
      most = std::fmax(most, std::fabs(sums[v] / counts[v] - all[size_t(v) * size + c]));
  }
  return most;
}

}  // namespace

TEST_CASE("carryOn: every value is the mean of its neighbours, for any number of values") {
  MESSAGE("seed 61");
  Random random(61);
  for (const uint32_t size : {1u, 2u, 3u, 4u, 7u}) {
    const Patch sheet = patchOf(noisy(saddleMesh(20, 0.4), 0.01, random), [](Vec3 p) {
      return std::fmax(std::fabs(p.x), std::fabs(p.y)) > 0.98;
    });
    const std::vector<double> values = randomValues(size_t(size) * sheet.fixedCount, random);
    CHECK(largestRest(sheet, size, values, carried(sheet, size, values)) < 1e-12);
  }
  // Closed all around, with one fixed vertex.
  const Patch torus = patchOf(torusMesh(12, 30), isNear({1.4, 0, 0}, 1e-3));
  REQUIRE(torus.fixedCount == 1);
  for (const double x : carried(torus, 1, {0.25})) CHECK(x == doctest::Approx(0.25));
}

TEST_CASE("carryOn: what is linear on a regular grid stays linear") {
  const Patch patch = patchOf(saddleMesh(24, 0), isOnSquare);
  const auto linear = [](Vec3 p) { return 2 * p.x - 0.7 * p.y + 0.1; };
  std::vector<double> values;
  for (uint32_t v = 0; v < patch.fixedCount; ++v) values.push_back(linear(patch.mesh.at(v)));
  const std::vector<double> result = carried(patch, 1, values);
  for (uint32_t i = 0; i < result.size(); ++i)
    CHECK(std::fabs(result[i] - linear(patch.mesh.at(patch.fixedCount + i))) < 1e-12);
}

TEST_CASE("carryOn: a part has the same values to the bit, whatever else there is") {
  MESSAGE("seed 67");
  Random random(67);
  const TestMesh sheet = saddleMesh(15, 0.2);
  const Patch one = patchOf(sheet, isOnSquare);
  const TestMesh far = mapped(saddleMesh(9, 0.1), [](Vec3 p) { return p + Vec3{0, 0, 50}; });
  const Patch both = patchOf(together(far, sheet), isOnSquare);
  const std::vector<double> others = randomValues(both.fixedCount - one.fixedCount, random),
                            own = randomValues(one.fixedCount, random);
  std::vector<double> values(others);
  values.insert(values.end(), own.begin(), own.end());
  const std::vector<double> result = carried(both, 1, values), alone = carried(one, 1, own);
  REQUIRE(result.size() > alone.size());
  CHECK(std::vector<double>(result.end() - std::ptrdiff_t(alone.size()), result.end()) == alone);
}

TEST_CASE("carryOn: parts that nothing holds get 0, and odd faces do no harm") {
  // A free triangle, a free vertex in no face, and one whose faces have a vertex twice.
  Patch patch;
  for (int i = 0; i < 8; ++i) patch.mesh.addVertex({double(i), double(i * i), 0});
  patch.fixedCount = 2;
  patch.mesh.addFace(2, 3, 4);
  patch.mesh.addFace(0, 6, 6);
  patch.mesh.addFace(0, 1, 7);
  patch.mesh.addFace(0, 1, 7);
  const std::vector<double> result = carried(patch, 1, {2, 4});
  for (int i = 0; i < 4; ++i) CHECK(result[i] == 0);
  CHECK(result[4] == doctest::Approx(2));
  CHECK(result[5] == doctest::Approx(3));
  CHECK(carried({}, 1, {}).empty());
}

TEST_CASE("carryOn: ends at the memory limit and when it is stopped, and frees what it had") {
  const Patch patch = patchOf(saddleMesh(60, 0.3), isOnSquare);
  const std::vector<double> values(4 * size_t(patch.fixedCount), 0.5);
  std::vector<double> result;
  Work whole;
  REQUIRE(carryOn(patch.mesh.view(), patch.fixedCount, 4, values, whole, result));
  for (size_t most = 0; most < whole.peak(); most += whole.peak() / 40) {
    Work work(most, nullptr, nullptr);
    CHECK_FALSE(carryOn(patch.mesh.view(), patch.fixedCount, 4, values, work, result));
    CHECK(work.status() == Status::OutOfMemory);
    CHECK(work.used() == 0);
  }
  Work stopped(
      size_t(-1), [](void*, double, double, double) { return false; }, nullptr);
  CHECK_FALSE(carryOn(patch.mesh.view(), patch.fixedCount, 4, values, stopped, result));
  CHECK(stopped.status() == Status::Stopped);
  CHECK(stopped.used() == 0);
}
