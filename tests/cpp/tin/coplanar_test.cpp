// Groups of coplanar faces: those of terrains whose planes are known, and any against the definition.
#include "tin/coplanar.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <set>

#include "base/predicates.h"
#include "tin/check.h"
#include "triangles/triangle_mesh.h"

using namespace sf;

namespace {

/// A grid with heights from a formula.
template <class F>
void makeGrid(uint32_t width, uint32_t height, F&& heightAt, std::mt19937& random,
              std::vector<double>& positions, std::vector<uint32_t>& triangles) {
  positions.clear(), triangles.clear();
  for (uint32_t j = 0; j <= height; ++j)
    for (uint32_t i = 0; i <= width; ++i)
      positions.insert(positions.end(), {double(i), double(j), heightAt(i, j)});
  for (uint32_t j = 0; j < height; ++j)
    for (uint32_t i = 0; i < width; ++i) {
      const uint32_t a = j * (width + 1) + i, b = a + 1, c = a + width + 1, d = c + 1;
      if (random() & 1)
        triangles.insert(triangles.end(), {a, b, d, a, d, c});
      else
        triangles.insert(triangles.end(), {a, b, c, b, d, c});
    }
}

std::vector<uint32_t> groupsOf(const std::vector<double>& positions,
                               std::vector<uint32_t>& triangles) {
  Work work;
  std::vector<uint32_t> twins, groups;
  TinProblem problem;
  REQUIRE(checkTin(positions, triangles, false, work, twins, problem));
  REQUIRE(findCoplanarGroups(positions, triangles, twins, work, groups));
  const auto at = [&](uint32_t h) {
    const double* p = &positions[3 * triangles[h]];
    return Vec3{p[0], p[1], p[2]};
  };
  for (uint32_t h = 0; h < twins.size(); ++h) {
    const uint32_t t = h / 3, g = twins[h];
    CHECK(groups[groups[t]] == groups[t]);
    CHECK(groups[t] <= t);
    // All of a group lies in the plane of its first face.
    const uint32_t f = 3 * groups[t];
    CHECK(orient3d(at(f), at(f + 1), at(f + 2), at(h)) == 0);
    if (g == kNone) continue;
    const bool isFlat =
        orient3d(at(3 * t), at(3 * t + 1), at(3 * t + 2), at(prevInTriangle(g))) == 0;
    CHECK((groups[t] == groups[g / 3]) == isFlat);
  }
  return groups;
}

}  // namespace

TEST_CASE("findCoplanarGroups: a plane, a ridge, a roof of many planes") {
  std::mt19937 random(3);
  std::vector<double> positions;
  std::vector<uint32_t> triangles;
  const auto count = [&] {
    const std::vector<uint32_t> groups = groupsOf(positions, triangles);
    return std::set<uint32_t>(groups.begin(), groups.end()).size();
  };
  makeGrid(
      9, 7, [](double x, double y) { return 0.25 * x - 0.5 * y + 3; }, random, positions,
      triangles);
  CHECK(count() == 1);
  makeGrid(
      8, 5, [](double x, double) { return std::fabs(x - 4); }, random, positions, triangles);
  CHECK(count() == 2);
  // Teeth of four columns: each side of a tooth is a plane of its own, though it is parallel to others.
  makeGrid(
      12, 5, [](double x, double) { return std::fabs(std::fmod(x, 4) - 2); }, random, positions,
      triangles);
  CHECK(count() == 6);
}

TEST_CASE(
    "findCoplanarGroups: one bit is enough to part them, and any heights are grouped as defined") {
  std::mt19937 random(4);
  std::vector<double> positions;
  std::vector<uint32_t> triangles;
  makeGrid(
      6, 6, [](double x, double y) { return x + y; }, random, positions, triangles);
  const size_t middle = 3 * (3 * 7 + 3) + 2;
  positions[middle] = std::nextafter(positions[middle], 100);
  const std::vector<uint32_t> groups = groupsOf(positions, triangles);
  CHECK(std::set<uint32_t>(groups.begin(), groups.end()).size() > 1);
  for (int round = 0; round < 60; ++round) {
    makeGrid(
        1 + random() % 8, 1 + random() % 8,
        [&](double x, double y) {
          return round % 3 == 0 ? double(random() % 2) : std::floor(0.3 * x) + 0.1 * y;
        },
        random, positions, triangles);
    groupsOf(positions, triangles);
  }
}
