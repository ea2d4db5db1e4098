#include "loops/one_loop/polygon_solver.h"

#include <doctest/doctest.h>

#include <cmath>

#include "base/atan2.h"
#include "loops/solver.h"
#include "support/generators.h"

using namespace sf;
using namespace sftest;

namespace {

struct Case {
  LoopSet loops;
  TriangleWeights weights;
  std::vector<double> normals;
  Objective objective;
};

/// The value of the objective and the weighted sum, by the other solver over a list of all triples.
void checkAgainstCandidateList(const Case& c, size_t maxBytes, double tolerance) {
  Work work;
  std::vector<uint32_t> triples;
  REQUIRE(allTriples(c.loops, work, triples));
  CandidateSet all;
  REQUIRE(buildCandidateSet(c.loops, c.weights, triples, work, all));
  Surface expected;
  SolveOptions options;
  options.dihedralWeight = c.weights.dihedral;
  options.objective = c.objective;
  REQUIRE(solveSurface(c.loops, all, options, work, expected));

  Work limited(maxBytes, nullptr, nullptr);
  PolygonSurface surface;
  REQUIRE(solvePolygon(c.loops, c.weights, c.objective, limited, surface));
  CHECK(limited.used() == 0);
  CHECK(surface.found == expected.found);
  if (!surface.found) return;
  CHECK(surface.lowerBound <= expected.lowerBound * (1 + 1e-12) + 1e-12);
  CHECK(surface.lowerBound == doctest::Approx(expected.lowerBound).epsilon(tolerance));

  // Costs of both surfaces, summed alike.
  const auto sum = [&](const std::vector<uint32_t>& triangles) {
    CandidateSet set;
    REQUIRE(buildCandidateSet(c.loops, c.weights, triangles, work, set));
    double total = 0;
    for (uint32_t t = 0; t < set.size(); ++t) total += set.weight[t];
    for (uint32_t e = 0; e < set.edgeCount(); ++e) {
      if (set.degree(e) != 2) continue;
      const uint32_t s = set.edgeSlots[e];
      total += c.weights.dihedral * dihedralAngle(set.slotTheta[s], set.slotTheta[s + 1]);
    }
    return total;
  };
  std::vector<uint32_t> listed;
  for (const uint32_t t : expected.order)
    listed.insert(listed.end(), &all.triangles[3 * t], &all.triangles[3 * t] + 3);
  CHECK(surface.triangles.size() == listed.size());
  CHECK(sum(surface.triangles) == doctest::Approx(sum(listed)).epsilon(tolerance));
}

Case randomCase(int i, Random& random) {
  Case c;
  const uint32_t n = 3 + random.below(38);
  Curve curve;
  switch (i % 4) {
    case 0:
      curve = noisyCircle(n, 0.3, random);
      break;
    case 1:
      curve = randomLoops({n}, 0, random)[0];
      break;
    case 2:
      curve = circle(n);
      break;  // coplanar: ties
    default:  // collinear runs along a square
      for (uint32_t v = 0; v < n; ++v) {
        const double t = 4.0 * v / n, f = t - std::floor(t);
        const double x[4] = {f, 1, 1 - f, 0}, y[4] = {0, f, 1, 1 - f};
        curve.push_back({x[int(t)], y[int(t)], 0});
      }
  }
  c.loops = loopSet({curve});
  c.weights.area = i % 3 ? 0.5 : 0;
  c.weights.perimeter = i % 5 == 0 ? 0.2 : 0;
  c.weights.dihedral = i % 7 == 6 && i % 3 ? 0 : 1;
  c.objective = i % 6 == 5 ? Objective::WorstDihedral : Objective::Sum;
  if (i % 3 == 1) {
    for (uint32_t v = 0; v < n; ++v) {
      const Vec3 d = random.chance(0.7) ? random.direction() : Vec3{NAN, NAN, NAN};
      c.normals.insert(c.normals.end(), {d.x, d.y, d.z});
    }
  }
  return c;
}

}  // namespace

TEST_CASE("polygon solver: equals the solver over a list of all triples") {
  Random random(91);
  MESSAGE("seed 91");
  for (int i = 0; i < 240; ++i) {
    Case c = randomCase(i, random);
    c.weights.normals = c.normals;
    CAPTURE(i);
    checkAgainstCandidateList(c, size_t(-1), 1e-11);
  }
}

TEST_CASE("polygon solver: single precision where doubles do not fit, with a bound from below") {
  Random random(92);
  MESSAGE("seed 92");
  for (int i = 0; i < 60; ++i) {
    Case c = randomCase(i, random);
    c.weights.normals = c.normals;
    c.weights.dihedral = 1;
    const double n = c.loops.vertexCount();
    const size_t floats = size_t(bytesForPolygon(n, true));
    CAPTURE(i);
    checkAgainstCandidateList(c, floats + 8, 1e-5);
    PolygonSurface surface;
    Work little(floats - 1, nullptr, nullptr);
    CHECK_FALSE(solvePolygon(c.loops, c.weights, c.objective, little, surface));
    CHECK(little.status() == Status::TooLarge);
  }
}

TEST_CASE("polygon solver: all vertices on one line have no triangulation") {
  Curve line;
  for (int v = 0; v < 6; ++v) line.push_back({double(v), 0, 0});
  const LoopSet loops = loopSet({line});
  TriangleWeights weights;
  weights.area = 1;
  for (const double dihedral : {0.0, 1.0}) {
    weights.dihedral = dihedral;
    Work work;
    PolygonSurface surface;
    REQUIRE(solvePolygon(loops, weights, Objective::Sum, work, surface));
    CHECK_FALSE(surface.found);
  }
}

TEST_CASE("fastAtan2: within a few units of the last place of atan2") {
  Random random(93);
  MESSAGE("seed 93");
  for (int i = 0; i < 20000; ++i) {
    const double x = random.range(-1, 1) * std::exp2(random.range(-30, 30));
    const double y = random.range(-1, 1) * std::exp2(random.range(-30, 30));
    CHECK(std::fabs(fastAtan2(y, x) - std::atan2(y, x)) < 1e-15);
  }
  for (const double x : {-1.0, 0.0, 1.0})
    for (const double y : {-1.0, 0.0, 1.0})
      CHECK(fastAtan2(y, x) == doctest::Approx(std::atan2(y, x)).epsilon(1e-15));
}
