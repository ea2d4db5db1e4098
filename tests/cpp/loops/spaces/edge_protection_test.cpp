#include "loops/spaces/edge_protection.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <string>

#include "delaunay/delaunay.h"
#include "loops/problem/loop_check.h"

using sf::LoopSet;
using sf::ProtectedLoops;
using sf::Status;
using sf::Vec3;
using sf::Work;
using Loop = std::vector<Vec3>;

namespace {

constexpr double kPi = 3.141592653589793;

LoopSet loopSet(const std::vector<Loop>& loops) {
  Loop positions;
  std::vector<uint32_t> starts = {0};
  for (const Loop& loop : loops) {
    positions.insert(positions.end(), loop.begin(), loop.end());
    starts.push_back(uint32_t(positions.size()));
  }
  return LoopSet(positions, starts);
}

template <class F>
Loop curve(int n, F f) {
  Loop loop;
  for (int i = 0; i < n; ++i) loop.push_back(f(i, 2 * kPi * i / n));
  return loop;
}
Loop circle(int n, double radius, double z) {
  return curve(n, [&](int, double t) {
    return Vec3{radius * std::cos(t), radius * std::sin(t), z};
  });
}
Loop saddle(int n, double waves) {
  return curve(n, [&](int, double t) {
    return Vec3{std::cos(t), std::sin(t), 0.5 * std::cos(waves * t)};
  });
}
Loop star(int spikes, double inner, bool bent) {
  return curve(2 * spikes, [&](int i, double t) {
    double r = i % 2 ? 1 : inner, x = r * std::cos(t), y = r * std::sin(t);
    return Vec3{x, y, bent ? 0.3 * x * y + 0.2 * std::sin(3 * x) : 0};
  });
}
Loop randomLoop(int n, uint64_t seed) {
  std::mt19937_64 g(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  return curve(n, [&](int, double) { return Vec3{u(g), u(g), u(g)}; });
}
Loop noisy(Loop loop, double amount, uint64_t seed) {
  std::mt19937_64 g(seed);
  std::uniform_real_distribution<double> u(-amount, amount);
  for (Vec3& v : loop) v = v + Vec3{u(g), u(g), u(g)};
  return loop;
}
// A closed self-avoiding walk on the integer lattice, grown by bumps.
Loop latticeLoop(int bumps, uint64_t seed) {
  std::mt19937_64 g(seed);
  Loop p = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const Vec3 directions[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int i = 0; i < bumps; ++i) {
    size_t at = g() % p.size();
    Vec3 a = p[at], b = p[(at + 1) % p.size()], u = directions[g() % 6];
    bool taken = std::count(p.begin(), p.end(), a + u) || std::count(p.begin(), p.end(), b + u);
    if (!taken && dot(u, b - a) == 0) p.insert(p.begin() + std::ptrdiff_t(at) + 1, {a + u, b + u});
  }
  return p;
}

std::set<std::array<uint32_t, 2>> edgesOf(const std::vector<uint32_t>& facets) {
  std::set<std::array<uint32_t, 2>> edges;
  for (size_t i = 0; i < facets.size(); i += 3) {
    edges.insert({facets[i], facets[i + 1]});
    edges.insert({facets[i], facets[i + 2]});
    edges.insert({facets[i + 1], facets[i + 2]});
  }
  return edges;
}

// What is wrong with a result; empty if nothing is.
std::string wrongWith(const LoopSet& in, const ProtectedLoops& r) {
  const LoopSet& out = r.loops;
  uint32_t n = in.vertexCount(), m = out.vertexCount(), input = 0, inserted = 0;
  if (out.loopCount() != in.loopCount() || r.origin.size() != m) return "sizes";
  if (m != n + r.inserted.size()) return "number of inserted vertices";
  double before = 0;
  uint32_t edge = 0;
  for (uint32_t v = 0; v < m; ++v) {
    if (r.origin[v] < n) {
      if (r.origin[v] != input++) return "order of input vertices";
      edge = r.origin[v], before = 0;
      if (!(out.position(v) == in.position(edge))) return "an input vertex has moved";
      if (out.loopOf(v) != in.loopOf(edge)) return "loop of a vertex";
      continue;
    }
    if (r.origin[v] != n + inserted) return "order of inserted vertices";
    const sf::InsertedVertex& i = r.inserted[inserted++];
    if (i.loop != in.loopOf(edge) || in.first(i.loop) + i.edge != edge) return "inserted: edge";
    if (!(before < i.parameter && i.parameter < 1)) return "inserted: parameter";
    before = i.parameter;
    Vec3 a = in.position(edge), b = in.position(in.next(edge));
    Vec3 expected = a + i.parameter * (b - a);
    if (distance(expected, out.position(v)) > 4e-16 * (length(a) + length(b)))
      return "inserted: position";
  }
  if (input != n) return "an input vertex is lost";

  Work work;
  if (!checkLoops(out, false, work).ok()) return "two vertices are equal";
  auto edges = edgesOf(r.facets);
  for (uint32_t v = 0; v < m; ++v) {
    uint32_t w = out.next(v);
    if (!edges.count({std::min(v, w), std::max(v, w)})) return "an edge is missing";
  }
  return "";
}

// Protects loops that have no co-spherical points, where the facets are those of any Delaunay
// tetrahedralization; returns how many vertices were inserted.
size_t protect(const std::vector<Loop>& loops, bool hasTies = false) {
  Work work;
  LoopSet in = loopSet(loops);
  REQUIRE(checkLoops(in, true, work).ok());
  ProtectedLoops r;
  REQUIRE(protectEdges(in, work, r) == Status::Ok);
  CHECK(work.used() == 0);
  CHECK(wrongWith(in, r) == "");
  sf::Delaunay d;
  REQUIRE(sf::delaunay(r.loops.positions(), work, d) == Status::Ok);
  if (!hasTies) CHECK(d.facets == r.facets);
  // The same again, since nothing depends on chance.
  ProtectedLoops again;
  REQUIRE(protectEdges(in, work, again) == Status::Ok);
  CHECK(again.facets == r.facets);
  // What is protected needs no more, whatever the ties.
  ProtectedLoops more;
  REQUIRE(protectEdges(r.loops, work, more) == Status::Ok);
  CHECK(wrongWith(r.loops, more) == "");
  if (!hasTies) CHECK(more.inserted.empty());
  return r.inserted.size();
}

}  // namespace

TEST_CASE("edge protection: nothing is inserted where all edges are Delaunay") {
  CHECK(protect({saddle(50, 3)}, true) == 0);
  CHECK(protect({noisy(saddle(300, 2), 1e-3, 1)}) == 0);
  CHECK(protect({noisy(circle(40, 1, 0), 0.01, 2), noisy(circle(40, 1, 0.7), 0.01, 3)}) == 0);
  CHECK(protect({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0.5}}}) == 0);
}

TEST_CASE("edge protection: nothing is inserted in regular and planar shapes") {
  CHECK(protect({circle(30, 1, 0)}, true) == 0);
  CHECK(protect({circle(60, 1, 0), circle(30, 0.5, 0), circle(7, 0.2, 0)}, true) == 0);
  CHECK(protect({circle(24, 1, 0), circle(24, 1, 1), circle(24, 1, 2)}, true) == 0);
  CHECK(protect({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}, true) == 0);
  CHECK(protect({star(5, 0.4, false)}, true) == 0);
  for (uint64_t seed = 1; seed <= 4; ++seed) {
    Loop loop = latticeLoop(150, seed);
    CAPTURE(seed);
    CHECK(protect({loop}, true) == 0);
    for (Vec3& v : loop) v = 0.1 * v;
    CHECK(protect({loop}, true) == 0);
  }
}

TEST_CASE("edge protection: diagonals of cubes are found by breaking ties, without insertion") {
  // Face diagonals are Delaunay in some of the tetrahedralizations of the lattice only.
  CHECK(protect({{{0, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}}}, true) == 0);
  CHECK(protect({{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0}}},
                true) == 0);
  CHECK(protect({{{1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}, {0, 0, 0}}}, true) == 0);
  size_t inserted = 0;
  for (uint64_t seed = 1; seed <= 8; ++seed) {
    Loop loop = latticeLoop(120, seed), cut;
    for (size_t i = 0; i < loop.size(); ++i)
      if (i % 3 != 2) cut.push_back(loop[i]);
    Work work;
    if (!checkLoops(loopSet({cut}), true, work).ok()) continue;
    inserted += protect({cut}, true);
  }
  CHECK(inserted == 0);
}

TEST_CASE("edge protection: one vertex where another edge's vertex is in the way") {
  // The vertex (0, 0.1, 0) hides the edge from (-1, 0, 0) to (1, 0, 0) among the points below it.
  Loop loop = {{-1, 0, 0}, {1, 0, 0}, {1.5, 1, 0.1}, {0, 0.1, 0.02}, {-1.5, 1, -0.1}};
  Loop below = {{0, -0.1, -0.03}, {0.4, -1, 0}, {-0.4, -1, 0.1}};
  Loop above = {{0.02, 0, 0.12}, {0.3, 0.1, 1.1}, {-0.3, -0.1, 1.2}};
  Loop under = {{0.02, 0, -0.11}, {0.3, -0.1, -1.1}, {-0.3, -0.1, -1.2}};
  size_t inserted = protect({loop, below, above, under});
  CHECK(inserted >= 1);
  CHECK(inserted <= 6);
}

TEST_CASE("edge protection: random loops, whose edges pass close to each other") {
  size_t inserted = 0;
  for (uint64_t seed = 1; seed <= 12; ++seed) {
    CAPTURE(seed);
    inserted += protect({randomLoop(20, seed)});
  }
  MESSAGE("inserted into 12 random loops of 20 vertices: ", inserted);
  CHECK(inserted > 100);
  CHECK(inserted < 355);
  protect({randomLoop(60, 77)});
  protect({randomLoop(15, 5), randomLoop(15, 6), randomLoop(15, 7)});
}

TEST_CASE("edge protection: acute corners, of stars and combs") {
  // One vertex per corner brings back both edges, if it is as far from the corner as the next one.
  CHECK(protect({star(20, 0.05, true)}, true) <= 40);
  CHECK(protect({star(30, 0.05, true)}, true) <= 60);
  protect({noisy(star(20, 0.05, true), 1e-3, 4)});
  protect({star(20, 0.05, true), circle(30, 0.5, 0.05)}, true);
  Loop comb;
  for (int i = 0; i < 40; ++i) comb.push_back({0.01 * i, i % 2 ? 1.0 : 0.0, 0.05 * std::sin(i)});
  comb.push_back({0.5, -1, 0}), comb.push_back({0, -1, 0});
  protect({comb});
  // Vertices close to a spike with an angle of a thousandth.
  for (double width : {1e-1, 1e-3}) {
    Loop spike = {{0, 0, 0}, {1, width / 2, 0}, {1.5, 0.1, 0.3}, {1, -width / 2, 0.0001}};
    protect({spike, noisy(circle(9, 0.02, 0), 0.003, 8)});
  }
}

TEST_CASE("edge protection: a vertex very close to an edge") {
  for (double gap : {1e-2, 1e-4, 1e-7}) {
    Loop loop = {{-1, 0, 0}, {1, 0, 0}, {1, 1, 0.2}, {0.1, gap, 0}, {-1, 1, 0.1}};
    Loop other = {{0.1, -2 * gap, gap}, {0.3, -1, 0.1}, {-0.2, -1, 0}};
    CAPTURE(gap);
    CHECK(protect({loop, other}) < 200);
  }
  // At one unit in the last place there may be no answer, but there is an end.
  Vec3 a = {0, 0, 0}, b = {1, 1.0 / 3, 1.0 / 7}, m = 0.37 * b;
  m.y = std::nextafter(m.y, 1.0);
  LoopSet loops = loopSet({{a, b, {1, 1, 0}, m, {0, 1, 0}},
                           {{m.x, m.y - 1e-16, m.z + 1e-16}, {0.5, -1, 0}, {0.4, -1, 0.2}}});
  Work work;
  ProtectedLoops r;
  Status status = protectEdges(loops, work, r);
  CHECK((status == Status::Ok || status == Status::NotFound));
  if (status == Status::Ok) CHECK(wrongWith(loops, r) == "");
  CHECK(work.used() == 0);
}

TEST_CASE("edge protection: positions keep their unit, whatever the magnitude") {
  Loop loop = randomLoop(20, 3);
  size_t expected = protect({loop});
  for (double scale : {0x1p-300, 0x1p300, 0x1p-7}) {
    for (Vec3& v : loop = randomLoop(20, 3)) v = scale * v;
    Work work;
    ProtectedLoops r;
    CHECK(protectEdges(loopSet({loop}), work, r) == Status::Ok);
    CHECK(r.inserted.size() == expected);
    Vec3 low = r.loops.position(0), high = low;
    for (const Vec3& p : r.loops.positions())
      low.x = std::min(low.x, p.x), high.x = std::max(high.x, p.x);
    CHECK(low.x >= -scale);
    CHECK(high.x > 0.5 * scale);
  }
}

TEST_CASE("edge protection: loops in a plane and on a line") {
  // A zig-zag in the plane whose long edges are not in its Delaunay triangulation.
  Loop flat = {{0, 0, 0}, {10, 0, 0}, {10, 3, 0}, {6, 0.5, 0}, {5, 4, 0}, {4, 0.5, 0}, {0, 3, 0}};
  Loop below = {{5, -0.5, 0}, {7, -4, 0}, {3, -4.25, 0}};
  CHECK(protect({flat, below}, true) >= 1);
  for (Vec3& v : flat) v.z = v.x - 2 * v.y;
  for (Vec3& v : below) v.z = v.x - 2 * v.y;
  CHECK(protect({flat, below}, true) >= 1);
  // Coplanar up to rounding: flat tetrahedra hold many more edges.
  for (Vec3& v : flat) v.z = (v.x + v.y) / 3;
  for (Vec3& v : below) v.z = (v.x + v.y) / 3;
  protect({flat, below}, true);

  Work work;
  ProtectedLoops r;
  CHECK(protectEdges(loopSet({{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}}), work, r) == Status::Ok);
  CHECK(r.inserted.empty());
  CHECK(r.facets.empty());
}

TEST_CASE("edge protection: memory limit and stop end the work with a status") {
  LoopSet loops = loopSet({randomLoop(150, 2)});
  ProtectedLoops r;
  Work whole;
  REQUIRE(protectEdges(loops, whole, r) == Status::Ok);
  for (size_t share = 1; share < 8; ++share) {
    Work work(whole.peak() * share / 8, nullptr, nullptr);
    CHECK(protectEdges(loops, work, r) == Status::OutOfMemory);
    CHECK(work.used() == 0);
  }
  auto stop = [](void* user, double, double, double) { return ++*static_cast<int*>(user) < 4; };
  int calls = 0;
  Work work(size_t(-1), stop, &calls);
  CHECK(protectEdges(loops, work, r) == Status::Stopped);
  CHECK(calls == 4);
  CHECK(work.used() == 0);
}
