// Changes of the input that must not change the cost, or change it in a known way.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/cases.h"
#include "support/surface.h"

using namespace sftest;

namespace {

/// Applies `order(curve, c)`, which gives the new order of the vertices of a loop, to all loops.
template <class Order>
Problem reordered(const Problem& before, bool turned, Order order) {
  Curves curves;
  std::vector<uint32_t> origin;
  uint32_t first = 0;
  for (uint32_t c = 0; c < before.curves.size(); ++c) {
    const Curve& curve = before.curves[c];
    Curve changed;
    for (uint32_t i : order(uint32_t(curve.size()), c)) {
      changed.push_back(curve[i]);
      origin.push_back(first + i);
    }
    curves.push_back(changed);
    first += uint32_t(curve.size());
  }
  return renumbered(before, curves, origin, std::vector<char>(origin.size(), turned));
}

Problem withLoopsReversed(const Problem& before) {
  return reordered(before, true, [](uint32_t n, uint32_t) {
    std::vector<uint32_t> order(n);
    for (uint32_t i = 0; i < n; ++i) order[i] = n - 1 - i;
    return order;
  });
}

Problem withStartsShifted(const Problem& before, Random& random) {
  return reordered(before, false, [&](uint32_t n, uint32_t) {
    std::vector<uint32_t> order(n);
    uint32_t shift = 1 + random.below(n - 1);
    for (uint32_t i = 0; i < n; ++i) order[i] = (i + shift) % n;
    return order;
  });
}

Problem withLoopsReordered(const Problem& before) {
  sf::LoopSet loops = loopSet(before.curves);
  Curves curves;
  std::vector<uint32_t> origin;
  for (uint32_t c = loops.loopCount(); c-- > 0;) {
    curves.push_back(before.curves[c]);
    for (uint32_t i = 0; i < loops.size(c); ++i) origin.push_back(loops.first(c) + i);
  }
  return renumbered(before, curves, origin, std::vector<char>(origin.size(), 0));
}

template <class Map>
Problem mapped(const Problem& before, Map map, bool mirror = false) {
  Problem after = before;
  for (Curve& curve : after.curves)
    for (Vec3& p : curve) p = map(p);
  // A mirror image turns normals, which are cross products, the other way.
  for (size_t i = 0; i < after.normals.size(); i += 3) {
    Vec3 n = map({after.normals[i], after.normals[i + 1], after.normals[i + 2]}) - map({0, 0, 0});
    n = mirror ? -n : n;
    after.normals[i] = n.x, after.normals[i + 1] = n.y, after.normals[i + 2] = n.z;
  }
  return after;
}

struct Expected {
  bool found;
  double cost, sum;
};

void expectSame(const std::string& what, const Problem& problem, const Expected& expected) {
  INFO(what, "\n", problem.text());
  Answer answer = solve(problem);
  CHECK(answer.outcome.status == sf::Status::Ok);
  CHECK(answer.span.found == expected.found);
  if (!answer.span.found || !expected.found) return;
  CHECK(spanFault(loopSet(problem.curves), problem.view(), answer.span) == "");
  // Positions are rounded anew by rotations: 1e-9 leaves room for that, and for nothing else.
  CHECK(answer.span.cost == doctest::Approx(expected.cost).epsilon(1e-9));
  CHECK(weightedSum(problem.view(), answer.span.terms) ==
        doctest::Approx(expected.sum).epsilon(1e-9));
}

/// All changes at once to a problem without vertices inserted. Returns whether it had a surface.
bool expectInvariant(const Problem& problem, Random& random) {
  Answer base = solve(problem);
  INFO(problem.text());
  CHECK(base.outcome.status == sf::Status::Ok);
  if (!base.outcome.ok()) return false;
  Expected same{base.span.found, base.span.cost, weightedSum(problem.view(), base.span.terms)};
  Rotation rotation = randomRotation(random);
  Vec3 shift = random.inCube(2);
  expectSame("rotated", mapped(problem, rotation), same);
  expectSame("moved", mapped(problem, [&](Vec3 p) { return p + shift; }), same);
  expectSame("mirrored",
             mapped(
                 problem,
                 [](Vec3 p) {
                   return Vec3{p.x, -p.y, p.z};
                 },
                 true),
             same);
  expectSame("reversed", withLoopsReversed(problem), same);
  expectSame("shifted", withStartsShifted(problem, random), same);
  expectSame("reordered", withLoopsReordered(problem), same);
  expectSame(
      "all of these",
      withLoopsReordered(withStartsShifted(withLoopsReversed(mapped(problem, rotation)), random)),
      same);

  // Scaled, with weights per area and length that undo it: the same cost.
  for (double s : {1000.0, 1.0 / 1024}) {
    Problem scaled = mapped(problem, [&](Vec3 p) { return s * p; });
    scaled.options.areaWeight /= s * s;
    scaled.options.perimeterWeight /= s;
    expectSame("scaled", scaled, same);
  }
  // One pure weight: the cost itself scales.
  if (problem.options.dihedralWeight == 0 && problem.triangleWeights.empty()) {
    double factor = problem.options.areaWeight > 0 ? 9 : 3;
    expectSame("scaled by 3", mapped(problem, [](Vec3 p) { return 3 * p; }),
               {same.found, factor * same.cost, factor * same.sum});
  }
  return base.span.found;
}

}  // namespace

TEST_CASE("span: the cost over all triples does not depend on pose, size, directions or order") {
  const std::vector<uint32_t> sizes[] = {{12}, {25}, {4, 5}, {7, 6}, {3, 4, 3}};
  int found = 0;
  for (uint32_t seed = 700; seed < 735; ++seed) {
    Random random(seed);
    Problem problem;
    problem.curves = randomLoops(sizes[seed % 5], random.range(0.3, 1.2), random);
    setWeights(int(seed % kWeightings), problem.curves, problem.options);
    problem.options.space = sf::Space::All;
    if (seed % 3 == 0) problem.normals = randomNormals(problem.curves, 0.7, random);
    if (seed % 4 == 0) {
      problem.options.space = sf::Space::Given;
      problem.triangles = randomTriples(problem.curves, 0.8, random);
      for (size_t i = 0; i < problem.triangles.size() / 3; ++i)
        problem.triangleWeights.push_back(random.unit());
    }
    INFO("seed ", seed);
    found += expectInvariant(problem, random);
  }
  CHECK(found > 25);
}

TEST_CASE(
    "span: the cost over Delaunay facets does not depend on pose, size, directions or order") {
  int found = 0, compared = 0;
  for (uint32_t seed = 800; seed < 816; ++seed) {
    Random random(seed);
    Problem problem;
    switch (seed % 4) {
      case 0:
        problem.curves = {noisyCircle(80, 0.02, random)};
        break;
      case 1:
        problem.curves = regularSaddles(2, 20, random);
        break;
      case 2:
        problem.curves = regularSaddles(3, 10, random);
        break;
      default:
        problem.curves = regularSaddles(4, 6, random);
        break;
    }
    // Saddles have rectangles among their vertices; Delaunay facets are unique without any.
    for (Curve& curve : problem.curves)
      for (Vec3& p : curve) p = p + random.inCube(0.01);
    setWeights(int((seed / 4 + seed) % kWeightings), problem.curves, problem.options);
    problem.options.space = sf::Space::Delaunay;
    if (seed % 3 == 0) problem.normals = randomNormals(problem.curves, 0.7, random);
    INFO("seed ", seed);
    // Where edge protection puts vertices may depend on order; without any the facets may not.
    if (!solve(problem).span.inserted.empty()) continue;
    ++compared;
    found += expectInvariant(problem, random);
  }
  MESSAGE(found << " of " << compared << " found");
  CHECK(found > 8);
}
