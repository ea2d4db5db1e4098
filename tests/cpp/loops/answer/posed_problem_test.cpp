#include "loops/answer/posed_problem.h"

#include <doctest/doctest.h>

#include <set>

#include "base/predicates.h"
#include "loops/span.h"
#include "support/hand_runs.h"
#include "support/surface.h"

using namespace sf;
using namespace sftest;

namespace {

/// Two strokes so noisy that edge protection inserts vertices.
Curves noisyPair(Random& random) {
  const Vec3 z{0, 0, 1};
  return {handStroke(20, 0.2, {0, 0, 0}, z, random), handStroke(24, 0.2, {0, 0, 1.2}, z, random)};
}

/// Loops after edge protection, as span.cpp poses it.
struct Protected {
  LoopSet unit;
  ScaledWeights weights;
  PosedProblem problem;

  explicit Protected(const Curves& curves) {
    const LoopSet given = loopSet(curves);
    std::vector<Vec3> scaled;
    const int exponent = scaleToUnit(given.positions(), scaled);
    unit = LoopSet(scaled, given.starts());
    weights = scaleWeights(0, 0, 1, {}, unit, exponent);
    Work work;
    ProtectedLoops safe;
    REQUIRE(protectEdges(unit, work, safe) == Status::Ok);
    problem = posedProtected(unit, {}, weights, std::move(safe));
  }
};

}  // namespace

TEST_CASE(
    "loop triangles: no vertex passes that the loops do not have, and none twice in a triangle") {
  const LoopSet loops = loopSet({circle(4), circle(3, 1, {0, 0, 1})});
  const std::vector<uint32_t> given{0, 1, 2, 4, 5, 7, 3, 3, 6, 6, 0, 3, kNone, 0, 1, 2, 5, 6, 1, 2};
  const LoopTriangles triangles(loops, given);
  CHECK(&triangles.loops() == &loops);
  const std::vector<uint32_t> kept(triangles.vertices().begin(), triangles.vertices().end());
  CHECK(kept == std::vector<uint32_t>{0, 1, 2, 6, 0, 3, 2, 5, 6});
  CHECK(LoopTriangles(loops).isEmpty());
  CHECK(LoopTriangles(loops, {}).isEmpty());
}

TEST_CASE("posed problem: the result's numbers lead to those of the loops and back") {
  Random random(810);
  MESSAGE("seed 810");
  int inserted = 0;
  for (int i = 0; i < 30; ++i) {
    const Protected p(noisyPair(random));
    const uint32_t count = p.problem.loops.vertexCount();
    inserted += int(p.problem.inserted.size());
    std::vector<uint32_t> triangles;
    for (int t = 0; t < 20; ++t) {
      const uint32_t v = random.below(count - 2);
      triangles.insert(triangles.end(), {v, v + 1, v + 2});
    }
    const LoopTriangles posed = p.problem.fromResult(triangles);
    REQUIRE(posed.vertices().size() == triangles.size());
    CHECK(&posed.loops() == &p.problem.loops);
    for (size_t j = 0; j < triangles.size(); ++j)
      CHECK(p.problem.resultIndex[posed.vertices()[j]] == triangles[j]);
    // What a result of other loops had is left out.
    triangles[0] = count;
    CHECK(p.problem.fromResult(triangles).vertices().size() == triangles.size() - 3);
  }
  CHECK(inserted > 20);
}

TEST_CASE("posed problem: a surface with inserted vertices becomes one over the caller's loops") {
  Random random(811);
  MESSAGE("seed 811");
  int count = 0, good = 0;
  for (int i = 0; i < 60; ++i) {
    Problem problem;
    problem.curves = noisyPair(random);
    problem.options.space = Space::Delaunay;
    const Answer answer = solve(problem);
    if (!answer.span.found || answer.span.inserted.empty()) continue;
    const Protected p(problem.curves);
    const LoopTriangles moved = p.problem.ontoInput(answer.span.triangles, p.unit);
    CHECK(&moved.loops() == &p.unit);
    for (const uint32_t v : moved.vertices()) CHECK(v < p.unit.vertexCount());
    Boundary boundary;
    boundary.starts.assign(p.unit.starts().begin(), p.unit.starts().end());
    for (uint32_t v = 0; v < p.unit.vertexCount(); ++v) boundary.vertices.push_back(v);
    ++count;
    // Vertices that move may meet others' edges; mostly they do not.
    const std::vector<uint32_t> list(moved.vertices().begin(), moved.vertices().end());
    good += surfaceFault(boundary, list).empty();
  }
  CHECK(count > 20);
  CHECK(good > count / 2);
}

TEST_CASE("best answer: the cheapest, among equals the later one, a proof before none") {
  const auto answer = [](double cost, bool optimal, Space space) {
    Span span;
    span.found = true;
    span.cost = cost, span.optimal = optimal, span.space = space;
    return span;
  };
  BestAnswer best(Objective::Sum);
  CHECK_FALSE(best.get().found);
  best.offer(answer(3, true, Space::Delaunay));
  best.offer(answer(4, true, Space::Near));
  CHECK(best.get().space == Space::Delaunay);
  best.offer(answer(3, false, Space::Near));
  CHECK(best.get().optimal);
  best.offer(answer(3, true, Space::Near));
  CHECK(best.get().space == Space::Near);
  best.offer(answer(2, false, Space::All));
  CHECK(best.get().cost == 2);
  // Angles that differ by less than a tie are the same one.
  BestAnswer worst(Objective::WorstDihedral);
  worst.offer(answer(1, true, Space::Delaunay));
  worst.offer(answer(1 + 1e-12, true, Space::Near));
  CHECK(worst.get().space == Space::Near);
}
