#include "loops/problem/loop_check.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "support/exact.h"

using sf::LoopSet;
using sf::Outcome;
using sf::Status;
using sf::Vec3;
using sf::Work;

namespace {

using Loops = std::vector<std::vector<Vec3>>;

LoopSet loopSet(const Loops& loops) {
  std::vector<Vec3> positions;
  std::vector<uint32_t> starts = {0};
  for (const auto& loop : loops) {
    positions.insert(positions.end(), loop.begin(), loop.end());
    starts.push_back(uint32_t(positions.size()));
  }
  return LoopSet(positions, starts);
}
Outcome check(const Loops& loops, bool intersections = true) {
  Work work;
  Outcome outcome = checkLoops(loopSet(loops), intersections, work);
  CHECK(work.used() == 0);
  return outcome;
}
bool is(const Outcome& o, Status status, uint32_t loop, uint32_t vertex,
        uint32_t otherLoop = sf::kNone, uint32_t otherVertex = sf::kNone) {
  return o.status == status && o.loop == loop && o.vertex == vertex && o.otherLoop == otherLoop &&
         o.otherVertex == otherVertex;
}
std::vector<Vec3> circle(int n, double radius, double z) {
  std::vector<Vec3> loop;
  for (int i = 0; i < n; ++i) {
    double t = 2 * 3.141592653589793 * i / n;
    loop.push_back({radius * std::cos(t), radius * std::sin(t), z});
  }
  return loop;
}

// Whether two closed segments meet, in exact rational arithmetic: the parameters of their nearest
// points, or the order along their common line.
using I = exact::Int<6>;
using P = exact::Point<6>;
bool meetExactly(const P& a, const P& b, const P& c, const P& d) {
  P u = b - a, v = d - c, w = c - a, n = cross(u, v);
  I nn = dot(n, n);
  if (nn.sign() != 0) {  // a + s u = c + t v with s = (w x v).n / nn, t = (w x u).n / nn
    if (dot(w, n).sign() != 0) return false;
    I s = dot(cross(w, v), n), t = dot(cross(w, u), n);
    return s.sign() >= 0 && (nn - s).sign() >= 0 && t.sign() >= 0 && (nn - t).sign() >= 0;
  }
  P off = cross(u, w);
  if (dot(off, off).sign() != 0) return false;
  I length = dot(u, u), from = dot(w, u), to = dot(d - a, u);
  bool before = from.sign() < 0 && to.sign() < 0;
  bool after = (length - from).sign() < 0 && (length - to).sign() < 0;
  return !before && !after;
}

}  // namespace

TEST_CASE("loop check: good loops pass") {
  CHECK(check({circle(3, 1, 0)}).ok());
  CHECK(check({circle(30, 1, 0), circle(12, 0.5, 0), circle(5, 1, 1)}).ok());
  CHECK(check({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}}}).ok());  // straight on is allowed
  // Two linked loops.
  CHECK(check({{{-1, 0, 0}, {1, 0, 0}, {0, 2, 0}}, {{0, 1, -1}, {0, 1, 1}, {0, 9, 0}}}).ok());
}

TEST_CASE("loop check: not finite, with loop and vertex") {
  for (double bad : {std::nan(""), std::numeric_limits<double>::infinity(), -1.0 / 0.0}) {
    Loops loops = {circle(4, 1, 0), circle(5, 1, 1)};
    loops[1][3].y = bad;
    CHECK(is(check(loops), Status::NotFinite, 1, 3));
  }
}

TEST_CASE("loop check: fewer than three vertices") {
  CHECK(is(check({circle(4, 1, 0), {{0, 0, 5}, {1, 0, 5}}}), Status::TooFewVertices, 1, sf::kNone));
  CHECK(is(check({{{0, 0, 5}}, circle(4, 1, 0)}), Status::TooFewVertices, 0, sf::kNone));
}

TEST_CASE("loop check: repeated vertices, consecutive or not, in one loop or two") {
  Loops loops = {circle(6, 1, 0), circle(7, 1, 1)};
  loops[0][3] = loops[0][2];
  CHECK(is(check(loops), Status::RepeatedVertex, 0, 2, 0, 3));
  loops = {circle(6, 1, 0), circle(7, 1, 1)};
  loops[1][6] = loops[1][1];
  CHECK(is(check(loops, false), Status::RepeatedVertex, 1, 1, 1, 6));
  loops = {circle(6, 1, 0), circle(7, 1, 1)};
  loops[1][4] = loops[0][5];
  CHECK(is(check(loops), Status::RepeatedVertex, 0, 5, 1, 4));
  CHECK(is(check({{{0.0, 0, 0}, {1, 0, 0}, {-0.0, -0.0, 0}, {1, 1, 0}}}), Status::RepeatedVertex, 0,
           0, 0, 2));
  // One unit in the last place is enough of a difference.
  CHECK(check({{{1, 0, 0}, {0, 0, 0}, {std::nextafter(1, 2), 0, 1e-9}}}).ok());
}

TEST_CASE("loop check: crossing, touching and overlapping edges, with both places") {
  // Crossing inside of one loop.
  CHECK(is(check({{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}}), Status::LoopsIntersect, 0, 0, 0,
           2));
  CHECK(check({{{0, 0, 0}, {1, 1, 0}, {1, 0, 1e-300}, {0, 1, 1e-20}}}).ok());
  CHECK(check({{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}}, false).ok());
  // A vertex on another loop's edge, in a skew plane; the parameter 1/4 is exact.
  Loops loops = {{{0, 0, 0}, {4, 8, 12}, {9, 0, 0}}, {{1, 2, 3}, {0, 9, 9}, {-1, 9, 9}}};
  CHECK(check(loops).status == Status::LoopsIntersect);
  loops[1][0].z = std::nextafter(3.0, 4.0);
  CHECK(check(loops).ok());
  // Two edges on one line, overlapping or apart.
  loops = {{{0, 0, 0}, {3, 3, 3}, {0, 5, 0}}, {{2, 2, 2}, {4, 4, 4}, {9, 0, 0}}};
  CHECK(is(check(loops), Status::LoopsIntersect, 0, 0, 1, 0));
  loops[1][0] = {3.5, 3.5, 3.5};
  CHECK(check(loops).ok());
  // Neighbours that fold back, in all three positions of a flat triangle.
  for (uint32_t shift = 0; shift < 3; ++shift) {
    std::vector<Vec3> flat = {{0, 0, 0}, {1, 2, 3}, {3, 6, 9}};
    std::rotate(flat.begin(), flat.begin() + shift, flat.end());
    CHECK(check({flat}).status == Status::LoopsIntersect);
  }
  CHECK(is(check({{{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {1, 1, 0}}}), Status::LoopsIntersect, 0, 0, 0,
           1));
}

TEST_CASE("loop check: agrees with exact rational arithmetic on lattice loops") {
  std::mt19937_64 g(31);
  int meet = 0, wrong = 0;
  for (int round = 0; round < 3000; ++round) {
    // Two to four edges far apart from each other but for one pair.
    bool flat = round % 3 == 0;
    Vec3 p[4];
    for (Vec3& v : p) v = {double(g() % 5), double(g() % 5), flat ? 1.0 : double(g() % 3)};
    bool distinct = true;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < i; ++j) distinct &= !(p[i] == p[j]);
    if (!distinct) continue;
    Loops loops = {{p[0], p[1], {-50, 30, 70.5}}, {p[2], p[3], {60, 41, -80.5}}};
    P q[4];
    for (int i = 0; i < 4; ++i) q[i] = exact::point<6>(p[i], 0);
    P r = exact::point<6>({-50, 30, 70.5}, 1), s = exact::point<6>({60, 41, -80.5}, 1);
    for (P& v : q) v = {v.x + v.x, v.y + v.y, v.z + v.z};
    const P a[3] = {q[0], q[1], r}, b[3] = {q[2], q[3], s};
    bool expected = false;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        expected |= meetExactly(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]);
    meet += expected;
    wrong += (check(loops).status == Status::LoopsIntersect) != expected;
    wrong += (check({loops[1], loops[0]}).status == Status::LoopsIntersect) != expected;
  }
  CHECK(meet > 100);
  CHECK(wrong == 0);
}

TEST_CASE("loop check: one crossing among many edges is found wherever it is") {
  std::mt19937_64 g(5);
  for (int round = 0; round < 20; ++round) {
    Loops loops;
    for (int k = 0; k < 5; ++k) loops.push_back(circle(400, 1 + 0.1 * k, 0.05 * k));
    CHECK(check(loops).ok());
    // Vertex v of loop a moves onto an edge of loop a + 1.
    uint32_t a = uint32_t(g() % 4), v = uint32_t(g() % 400), w = uint32_t(g() % 399);
    Vec3 p = loops[a + 1][w], q = loops[a + 1][w + 1];
    loops[a][v] = 0.5 * (p + q);
    loops[a + 1][w] = loops[a][v] + (loops[a][v] - q);  // now exactly the midpoint, up to rounding
    Outcome o = check(loops);
    Vec3 m = 0.5 * (loops[a + 1][w] + q);
    if (m == loops[a][v] && m - q == loops[a + 1][w] - m) {
      CHECK(o.status == Status::LoopsIntersect);
      CHECK(o.loop == a);
      CHECK((o.vertex == v || (o.vertex + 1) % 400 == v));
    }
  }
}

TEST_CASE("loop check: near linear on a long curve, and ends on request") {
  Loops loops = {circle(20000, 1, 0), circle(20000, 1.0001, 0)};
  int calls = 0;
  auto count = [](void* user, double, double, double) {
    ++*static_cast<int*>(user);
    return true;
  };
  Work work(size_t(-1), count, &calls);
  CHECK(checkLoops(loopSet(loops), true, work).ok());
  CHECK(calls < 200);  // each stands for about a millisecond; all pairs would take seconds

  Work small(100000, nullptr, nullptr);
  CHECK(checkLoops(loopSet(loops), true, small).status == Status::OutOfMemory);
  auto stop = [](void*, double, double, double) { return false; };
  Work stopped(size_t(-1), stop, nullptr);
  CHECK(checkLoops(loopSet(loops), true, stopped).status == Status::Stopped);
}
