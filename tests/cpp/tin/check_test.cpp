// What is a terrain, and what is not: cases by hand, and random ones against a look at all pairs of faces.
#include "tin/check.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "base/predicates.h"

using namespace sf;

namespace {

struct Tin {
  std::vector<double> positions;
  std::vector<uint32_t> triangles;

  uint32_t add(double x, double y, double z = 0) {
    positions.insert(positions.end(), {x, y, z});
    return uint32_t(positions.size() / 3) - 1;
  }
  void face(uint32_t a, uint32_t b, uint32_t c) { triangles.insert(triangles.end(), {a, b, c}); }
};

TinProblem problemOf(const Tin& tin, bool orient = false) {
  Work work;
  std::vector<uint32_t> triangles = tin.triangles, twins;
  TinProblem problem;
  const bool isGood = checkTin(tin.positions, triangles, orient, work, twins, problem);
  CHECK(isGood == (problem.fault == TinFault::None));
  if (isGood)
    for (uint32_t h = 0; h < twins.size(); ++h)
      if (twins[h] != kNone) CHECK(twins[twins[h]] == h);
  return problem;
}

/// A grid of squares of size 1, some of which are left out, with either diagonal.
Tin grid(std::mt19937& random, uint32_t width, uint32_t height, double there, bool isMoved) {
  std::bernoulli_distribution isThere(there);
  std::uniform_real_distribution<double> moves(-0.2, 0.2), heights(0, 9);
  Tin tin;
  for (uint32_t j = 0; j <= height; ++j)
    for (uint32_t i = 0; i <= width; ++i)
      tin.add(i + (isMoved ? moves(random) : 0), j + (isMoved ? moves(random) : 0),
              heights(random));
  for (uint32_t j = 0; j < height; ++j)
    for (uint32_t i = 0; i < width; ++i) {
      const uint32_t a = j * (width + 1) + i, b = a + 1, c = a + width + 1, d = c + 1;
      const bool rises = random() & 1;
      if (isThere(random)) rises ? tin.face(a, b, d) : tin.face(a, b, c);
      if (isThere(random)) rises ? tin.face(a, d, c) : tin.face(b, d, c);
    }
  return tin;
}

int turn(const Tin& tin, uint32_t a, uint32_t b, uint32_t c) {
  const double* p = tin.positions.data();
  return orient2d(p[3 * a], p[3 * a + 1], p[3 * b], p[3 * b + 1], p[3 * c], p[3 * c + 1]);
}

/// Whether the inner parts of any two faces meet, or faces run along an edge in one direction: by a look at all pairs.
bool isBad(const Tin& tin) {
  const size_t count = tin.triangles.size() / 3;
  const auto isApart = [&](const uint32_t* s, const uint32_t* t) {
    for (int k = 0; k < 3; ++k) {
      bool isBeyond = true;
      for (int i = 0; i < 3; ++i) isBeyond &= turn(tin, s[k], s[(k + 1) % 3], t[i]) <= 0;
      if (isBeyond) return true;
    }
    return false;
  };
  for (size_t i = 0; i < count; ++i) {
    const uint32_t* s = &tin.triangles[3 * i];
    if (turn(tin, s[0], s[1], s[2]) <= 0) return true;
    for (size_t j = 0; j < i; ++j) {
      const uint32_t* t = &tin.triangles[3 * j];
      if (!isApart(s, t) && !isApart(t, s)) return true;
    }
  }
  return false;
}

}  // namespace

TEST_CASE("checkTin: what is not there, not finite, or no triangle") {
  Tin tin;
  CHECK(problemOf(tin).fault == TinFault::Empty);
  const uint32_t a = tin.add(0, 0), b = tin.add(1, 0), c = tin.add(0, 1), d = tin.add(1, 1);
  tin.face(a, b, c);
  CHECK(problemOf(tin).fault == TinFault::None);  // d is not used
  Tin bad = tin;
  bad.face(b, d, 9);
  CHECK(problemOf(bad).fault == TinFault::IndexOutOfRange);
  CHECK(problemOf(bad).faces[0] == 1);
  for (const double value : {std::nan(""), HUGE_VAL, 1e160}) {
    bad = tin;
    bad.positions[3 * c + 2] = value;
    CHECK(problemOf(bad).fault == TinFault::NotFinite);
    CHECK(problemOf(bad).vertices[0] == c);
  }
  bad = tin;
  bad.face(b, d, d);
  CHECK(problemOf(bad).fault == TinFault::Degenerate);
  bad = tin;
  const uint32_t e = bad.add(2, 0), f = bad.add(3, 0), g = bad.add(3, 0, 5);
  bad.face(b, e, f);
  CHECK(problemOf(bad).fault == TinFault::Degenerate);
  CHECK(problemOf(bad).faces[0] == 1);
  bad.triangles.back() = g;
  CHECK(problemOf(bad).fault == TinFault::Vertical);
  bad = tin;
  const uint32_t twice = bad.add(0, 1, 7);
  bad.face(b, d, twice);
  const TinProblem problem = problemOf(bad);
  CHECK(problem.fault == TinFault::RepeatedVertex);
  CHECK(problem.vertices[0] == c);
  CHECK(problem.vertices[1] == twice);
}

TEST_CASE("checkTin: clockwise faces are named, or turned over") {
  std::mt19937 random(4);
  Tin tin = grid(random, 5, 4, 1, true);
  std::swap(tin.triangles[3 * 7], tin.triangles[3 * 7 + 1]);
  CHECK(problemOf(tin).fault == TinFault::Clockwise);
  CHECK(problemOf(tin).faces[0] == 7);
  CHECK(problemOf(tin, true).fault == TinFault::None);
  for (size_t i = 0; i < tin.triangles.size(); i += 3)
    std::swap(tin.triangles[i], tin.triangles[i + 1]);
  CHECK(problemOf(tin, true).fault == TinFault::None);
}

TEST_CASE("checkTin: edges of three faces, and faces twice") {
  Tin tin;
  const uint32_t a = tin.add(0, 0), b = tin.add(2, 0), c = tin.add(1, 1), d = tin.add(1, -1),
                 e = tin.add(1, 2);
  tin.face(a, b, c), tin.face(b, a, d), tin.face(a, b, e);
  const TinProblem problem = problemOf(tin);
  CHECK(problem.fault == TinFault::NonManifold);
  CHECK(problem.faces[0] == 0);
  CHECK(problem.faces[1] == 2);
  CHECK(std::min(problem.vertices[0], problem.vertices[1]) == a);
  CHECK(std::max(problem.vertices[0], problem.vertices[1]) == b);
  Tin twice;
  twice.add(0, 0), twice.add(1, 0), twice.add(0, 1);
  twice.face(0, 1, 2), twice.face(1, 2, 0);
  CHECK(problemOf(twice).fault == TinFault::NonManifold);
  // Two faces on one side of an edge are a fold.
  Tin fold;
  fold.add(0, 0), fold.add(2, 0), fold.add(0, 2), fold.add(2, 2);
  fold.face(0, 1, 2), fold.face(0, 1, 3);
  CHECK(problemOf(fold).fault == TinFault::Overlap);
  // So is a third one at an edge, if faces close around its end already.
  Tin more;
  more.add(0, 0), more.add(4, 0), more.add(0, 4), more.add(-4, -4), more.add(3, -1);
  more.face(0, 1, 2), more.face(0, 2, 3), more.face(0, 3, 1), more.face(0, 4, 2);
  CHECK(problemOf(more).fault == TinFault::Overlap);
  CHECK(problemOf(more).faces[0] == 0);
  CHECK(problemOf(more).faces[1] == 3);
}

TEST_CASE("checkTin: any border is allowed: pinched, touching from outside, back to back") {
  std::mt19937 random(5);
  for (int round = 0; round < 200; ++round)
    CHECK(problemOf(grid(random, 7, 7, 0.6, round % 2 == 0)).fault == TinFault::None);
  // A vertex in the middle of an edge from outside, and edges that lie on each other.
  Tin tin;
  tin.face(tin.add(0, 0), tin.add(4, 0), tin.add(2, 3));
  tin.face(tin.add(2, 0, 1), tin.add(1, -2), tin.add(3, -2));
  CHECK(problemOf(tin).fault == TinFault::None);
  tin.face(tin.add(3.5, 0), tin.add(2.5, 0), tin.add(3, -1));
  CHECK(problemOf(tin).fault == TinFault::None);
  // The same edge with the face on the first one's side.
  tin.face(tin.add(0.5, 0), tin.add(1.5, 0), tin.add(1, 0.5));
  CHECK(problemOf(tin).fault == TinFault::Overlap);
}

TEST_CASE("checkTin: overlaps far from vertices, nested parts, stairs that wind twice") {
  Tin cross;
  cross.face(cross.add(0, 0), cross.add(4, 0), cross.add(0, 1));
  cross.face(cross.add(1, -1), cross.add(2, -1), cross.add(1.5, 3));
  CHECK(problemOf(cross).fault == TinFault::Overlap);
  CHECK(problemOf(cross).faces[0] == 0);
  CHECK(problemOf(cross).faces[1] == 1);
  Tin nested;
  nested.face(nested.add(0, 0), nested.add(10, 0), nested.add(0, 10));
  nested.face(nested.add(1, 1), nested.add(2, 1), nested.add(1, 2));
  CHECK(problemOf(nested).fault == TinFault::Overlap);
  // Touching the middle of an edge from inside.
  Tin inside;
  inside.face(inside.add(0, 0), inside.add(10, 0), inside.add(0, 10));
  inside.face(inside.add(5, 0), inside.add(6, 1), inside.add(5, 1));
  CHECK(problemOf(inside).fault == TinFault::Overlap);
  for (const bool windsTwice : {false, true}) {
    Tin stairs;
    const int steps = windsTwice ? 12 : 6;
    const double radius[2] = {1, 2};
    for (int k = 0; k <= steps; ++k)
      for (const double r : radius) {
        // Wider after the first turn, so that no vertices repeat.
        const double angle = 2 * 3.14159265358979 * k / 8.3;
        stairs.add((r + 0.01 * k) * std::cos(angle), (r + 0.01 * k) * std::sin(angle), k);
      }
    for (uint32_t k = 0; k < uint32_t(steps); ++k)
      stairs.face(2 * k, 2 * k + 1, 2 * k + 3), stairs.face(2 * k, 2 * k + 3, 2 * k + 2);
    CHECK(problemOf(stairs).fault == (windsTwice ? TinFault::Overlap : TinFault::None));
    CHECK(isBad(stairs) == windsTwice);
  }
  // A fan around a vertex whose last face lies over the first.
  Tin fan;
  const uint32_t v = fan.add(0, 0);
  for (int k = 0; k <= 7; ++k)
    fan.add((1 + 0.1 * k) * std::cos(0.95 * k), (1 + 0.1 * k) * std::sin(0.95 * k));
  for (uint32_t k = 1; k <= 7; ++k) fan.face(v, k, k + 1);
  CHECK(problemOf(fan).fault == TinFault::Overlap);
}

TEST_CASE("checkTin: the same as a look at all pairs") {
  const unsigned seed = 77;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::map<TinFault, int> met;
  for (int round = 0; round < 4000; ++round) {
    CAPTURE(round);
    Tin tin = grid(random, 1 + random() % 5, 1 + random() % 5, 0.3 + 0.1 * double(random() % 8),
                   random() % 2);
    if (tin.triangles.empty()) continue;
    // Some vertices moved far, some parts put over others, on a lattice or not.
    for (uint32_t edits = random() % 3; edits > 0; --edits) {
      const uint32_t v = random() % uint32_t(tin.positions.size() / 3);
      tin.positions[3 * v] += 0.25 * (double(random() % 17) - 8);
      tin.positions[3 * v + 1] += 0.25 * (double(random() % 17) - 8);
    }
    if (random() % 3 == 0) {
      const double x = 0.25 * double(random() % 24), y = 0.25 * double(random() % 24);
      const uint32_t a = tin.add(x, y), b = tin.add(x + 0.25 * (1 + random() % 8), y),
                     c = tin.add(x, y + 0.25 * (1 + random() % 8));
      tin.face(a, b, c);
    }
    const TinProblem problem = problemOf(tin);
    ++met[problem.fault];
    // Two vertices at one place, or an edge with too many faces, can be without overlap.
    if (problem.fault == TinFault::RepeatedVertex || problem.fault == TinFault::NonManifold)
      continue;
    CHECK((problem.fault != TinFault::None) == isBad(tin));
    if (problem.fault == TinFault::Overlap) {
      Tin two = tin;
      two.triangles.clear();
      for (const uint32_t t : problem.faces)
        two.triangles.insert(two.triangles.end(), &tin.triangles[3 * t], &tin.triangles[3 * t] + 3);
      CHECK(isBad(two));
    }
  }
  CHECK(met[TinFault::None] > 300);
  CHECK(met[TinFault::Overlap] > 100);
}
