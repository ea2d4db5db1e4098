// What holds for every answer of spanLoops, on problems beyond the reach of enumeration; and first
// that the checks used for it reject what they must.
#include <doctest/doctest.h>

#include <cmath>

#include "support/cases.h"
#include "support/self_intersection.h"
#include "support/surface.h"

using namespace sftest;

namespace {

Boundary boundaryOf(std::initializer_list<uint32_t> sizes) {
  Boundary boundary{{0}, {}};
  for (uint32_t size : sizes) {
    for (uint32_t i = 0; i < size; ++i) boundary.vertices.push_back(boundary.starts.back() + i);
    boundary.starts.push_back(uint32_t(boundary.vertices.size()));
  }
  return boundary;
}

Curves pair(Curve a, Curve b) { return {std::move(a), std::move(b)}; }

/// Solves with every weighting that has a name and checks what comes back.
void expectSpans(const std::string& name, const Curves& curves, sf::Space space,
                 std::initializer_list<int> weightings) {
  for (int which : weightings) {
    Problem problem;
    problem.curves = curves;
    const std::string weights = setWeights(which, curves, problem.options);
    problem.options.space = space;
    INFO(name, ", ", weights);
    Answer answer = solve(problem);
    const sf::Span& span = answer.span;
    CHECK(answer.outcome.status == sf::Status::Ok);
    CHECK(span.found);
    CHECK(spanFault(loopSet(curves), problem.view(), span) == "");
    CHECK(span.optimal);
    CHECK(span.space == space);
    CHECK(span.candidates > 0);
    if (space != sf::Space::Delaunay || !span.found) continue;
    Crossing crossing = findCrossing(span.positions, span.triangles);
    INFO("triangles ", crossing.first, " and ", crossing.second);
    CHECK_FALSE(crossing.found);
  }
}

}  // namespace

TEST_CASE("surface check: accepts a disc and a tube") {
  CHECK(surfaceFault(boundaryOf({4}), {0, 1, 2, 0, 2, 3}) == "");
  CHECK(surfaceFault(boundaryOf({3, 3}), {0, 1, 3, 1, 4, 3, 1, 2, 4, 2, 5, 4, 2, 0, 5, 0, 3, 5}) ==
        "");
}

TEST_CASE("surface check: rejects what is not a surface of the class") {
  auto rejects = [](const Boundary& boundary, const std::vector<uint32_t>& triangles) {
    return !surfaceFault(boundary, triangles).empty();
  };
  Boundary square = boundaryOf({4}), twoTriangles = boundaryOf({3, 3});
  CHECK(rejects(square, {0, 1, 2}));           // too few triangles
  CHECK(rejects(square, {0, 1, 2, 0, 1, 2}));  // one triangle twice
  CHECK(rejects(square, {0, 1, 2, 0, 1, 3}));  // a loop edge in two triangles
  CHECK(rejects(square, {0, 1, 2, 0, 3, 2}));  // not wound alike
  CHECK(rejects(square, {0, 1, 2, 0, 2, 4}));  // an index over n'
  CHECK(rejects(square, {0, 0, 1, 0, 2, 3}));  // a corner twice
  CHECK(rejects(Boundary{{0, 4}, {0, 1, 2, 2}}, {0, 1, 2, 0, 2, 3}));  // not all vertices
  // A tube with one triangle turned over.
  CHECK(rejects(twoTriangles, {0, 1, 3, 1, 4, 3, 1, 2, 4, 2, 5, 4, 2, 0, 5, 0, 5, 3}));
}

TEST_CASE("surface check: two discs that touch at two vertices are pinched, not a tube") {
  // The first loop's disc has two vertices of the second loop inside. Valence and Euler number are
  // those of a tube; only the fans tell.
  const std::vector<uint32_t> discs = {0, 1, 6, 1, 2, 6, 2, 0, 6, 0, 2, 8, 2, 3, 8,
                                       3, 0, 8, 0, 3, 4, 5, 6, 7, 5, 7, 8, 5, 8, 9};
  CHECK(surfaceFault(boundaryOf({5, 5}), discs).find("in one fan") != std::string::npos);
}

TEST_CASE("self-intersection check: finds crossing, touching and overlapping triangles, exactly") {
  const std::vector<Vec3> p = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1},     {1, 1, 1},
                               {5, 5, 0}, {1, 1, 0}, {4, 4, 0}, {1, 1, 1e-300}, {2, 2, 3}};
  CHECK(findCrossing(p, {0, 1, 2, 3, 4, 5}).found);        // pierced
  CHECK(findCrossing(p, {0, 1, 2, 6, 4, 5}).found);        // touched by a corner
  CHECK_FALSE(findCrossing(p, {0, 1, 2, 8, 4, 9}).found);  // missed by a hair
  CHECK(findCrossing(p, {0, 1, 2, 0, 1, 6}).found);        // overlapping, with a common edge
  CHECK(findCrossing(p, {0, 1, 2, 0, 6, 4}).found);        // an edge runs in from a common corner
  CHECK_FALSE(findCrossing(p, {0, 1, 2, 1, 2, 7}).found);  // coplanar neighbours
  CHECK_FALSE(findCrossing(p, {0, 1, 2, 0, 1, 4}).found);  // folded neighbours
  CHECK_FALSE(findCrossing(p, {0, 1, 2, 4, 5, 9}).found);  // apart
  CHECK(segmentsMeet({0, 0, 0}, {2, 2, 2}, {1, 1, 1}, {3, 0, 0}));
  CHECK(segmentsMeet({0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {3, 0, 0}));
  CHECK_FALSE(segmentsMeet({0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}));
  CHECK_FALSE(segmentsMeet({0, 0, 0}, {2, 2, 0}, {2, 0, 1e-300}, {0, 2, 1e-300}));
}

TEST_CASE("span: one loop of sixty vertices is filled by an optimal disc") {
  expectSpans("monkey saddle, all", {monkeySaddle(60)}, sf::Space::All, {0, 1, 2, 3, 4, 5, 6});
  expectSpans("monkey saddle, Delaunay", {monkeySaddle(60)}, sf::Space::Delaunay,
              {0, 1, 2, 3, 4, 5, 6});
  Random random(71);
  Curve noisy = noisyCircle(60, 0.05, random);
  expectSpans("noisy circle, all", {noisy}, sf::Space::All, {0, 2, 3, 5});
  expectSpans("noisy circle, Delaunay", {noisy}, sf::Space::Delaunay, {0, 2, 3, 5});
  expectSpans("random points, all", randomLoops({24}, 0, random), sf::Space::All, {0, 1, 2, 5});
}

TEST_CASE("span: pairs of loops are joined by an optimal tube") {
  Random random(72);
  Curves facing = regularSaddles(2, 12, random);
  expectSpans("two saddles, all", facing, sf::Space::All, {0, 2, 3, 4});
  expectSpans("two saddles, Delaunay", regularSaddles(2, 40, random), sf::Space::Delaunay,
              {0, 1, 2, 3, 4, 5, 6});
  Curves stacked = pair(circle(12), circle(12, 1, {0, 0, 1}));
  expectSpans("two rings, all", stacked, sf::Space::All, {0, 2});
  expectSpans("two rings, Delaunay", stacked, sf::Space::Delaunay, {0, 2, 5});
  Curves nested = pair(circle(24, 4), circle(12, 1));
  expectSpans("a flat ring, Delaunay", nested, sf::Space::Delaunay, {0, 1, 4});
}

TEST_CASE("span: three and more loops are joined by an optimal surface") {
  Random random(73);
  expectSpans("3 x 20 saddles", regularSaddles(3, 20, random), sf::Space::Delaunay, {0, 2, 3, 5});
  expectSpans("4 x 8 saddles", regularSaddles(4, 8, random), sf::Space::Delaunay, {0, 2, 3});
  expectSpans("5 x 6 saddles", regularSaddles(5, 6, random), sf::Space::Delaunay, {2});
  expectSpans("rings with an island",
              {circle(24, 4), circle(8, 1, {-2, 0, 0.5}), circle(8, 1, {2, 0, -0.25})},
              sf::Space::Delaunay, {0, 2, 4});
}

TEST_CASE("span: loops on a closed mesh, when Delaunay space holds a surface, get an optimal one") {
  int found = 0, asked = 0;
  for (uint32_t seed = 400; seed < 430; ++seed) {
    Random random(seed);
    uint32_t loops = 1 + seed % 3;
    Problem problem;
    problem.curves = meshLoops(2 + seed % 2, loops, 8 + random.below(20), random);
    const std::string weights =
        setWeights(int(seed % kWeightings), problem.curves, problem.options);
    problem.options.space = sf::Space::Delaunay;
    INFO("seed ", seed, ", ", weights, "\n", problem.text());
    Answer answer = solve(problem);
    CHECK(answer.outcome.status == sf::Status::Ok);
    CHECK(spanFault(loopSet(problem.curves), problem.view(), answer.span) == "");
    CHECK_FALSE(findCrossing(answer.span.positions, answer.span.triangles).found);
    if (answer.span.found) CHECK(answer.span.optimal);
    found += answer.span.found;
    ++asked;
  }
  MESSAGE(found << " of " << asked << " found");
  CHECK(found > asked / 2);
}

TEST_CASE("span: curves with edges that are not Delaunay get vertices on them, and a surface") {
  for (const char* name : {"bunny1_002", "bunny1_008"}) {
    Curves curves = readCurves(std::string(SF_FIXTURES) + "/curves/" + name + ".curve");
    REQUIRE_FALSE(curves.empty());
    expectSpans(name, curves, sf::Space::Delaunay, {0, 2, 3, 6});
    Random random(75);
    Problem problem;
    problem.curves = curves;
    problem.normals = randomNormals(curves, 0.7, random);
    problem.options.space = sf::Space::Delaunay;
    Answer answer = solve(problem);
    INFO(name);
    CHECK(answer.span.found);
    CHECK(answer.span.inserted.size() > 0);
    CHECK(spanFault(loopSet(curves), problem.view(), answer.span) == "");
  }
}

TEST_CASE("span: wider spaces never cost more, and auto names the space it took") {
  for (uint32_t seed = 500; seed < 512; ++seed) {
    Random random(seed);
    Problem problem;
    problem.curves =
        seed % 2 ? regularSaddles(2, 7, random) : randomLoops({5 + random.below(8)}, 0, random);
    setWeights(int(seed % 5), problem.curves, problem.options);
    INFO("seed ", seed, "\n", problem.text());
    double cost[3];
    const sf::Space spaces[3] = {sf::Space::Delaunay, sf::Space::Near, sf::Space::All};
    for (int i = 0; i < 3; ++i) {
      problem.options.space = spaces[i];
      Answer answer = solve(problem);
      CHECK(answer.outcome.status == sf::Status::Ok);
      CHECK(spanFault(loopSet(problem.curves), problem.view(), answer.span) == "");
      bool comparable = answer.span.found && answer.span.inserted.empty();
      cost[i] = comparable ? answer.span.cost : 1e300;
    }
    CHECK(cost[1] <= cost[0] * (1 + 1e-9));
    CHECK(cost[2] <= cost[1] * (1 + 1e-9));
    problem.options.space = sf::Space::Auto;
    Answer answer = solve(problem);
    CHECK(answer.span.found);
    CHECK(answer.span.space != sf::Space::Auto);
    CHECK(answer.span.space != sf::Space::Given);
    CHECK(spanFault(loopSet(problem.curves), problem.view(), answer.span) == "");
  }
}

TEST_CASE("span: boundary normals pull the surface towards the faces given") {
  // A square ring of faces lies around the loop; with normals given the flat filling costs its
  // folds, so that the sum is what the checker recomputes and no less than without normals.
  Random random(74);
  for (uint32_t n : {12u, 30u}) {
    Problem problem;
    problem.curves = {noisyCircle(n, 0.1, random)};
    setWeights(2, problem.curves, problem.options);
    problem.options.space = sf::Space::Delaunay;
    Answer bare = solve(problem);
    problem.normals = randomNormals(problem.curves, 0.8, random);
    Answer answer = solve(problem);
    CHECK(spanFault(loopSet(problem.curves), problem.view(), answer.span) == "");
    REQUIRE(bare.span.found);
    REQUIRE(answer.span.found);
    CHECK(answer.span.cost > bare.span.cost);
  }
}
