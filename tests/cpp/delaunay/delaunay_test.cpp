#include "delaunay/delaunay.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <set>
#include <string>

#include "base/predicates.h"
#include "delaunay/insertion_order.h"
#include "support/delaunay_oracle.h"

using sf::Delaunay;
using sf::Status;
using sf::Vec3;
using sf::Work;
using Points = std::vector<Vec3>;

namespace {

double uniform(std::mt19937_64& g) { return std::uniform_real_distribution<double>(-1, 1)(g); }

Points randomPoints(size_t n, uint64_t seed) {
  std::mt19937_64 g(seed);
  Points p(n);
  for (Vec3& v : p) v = {uniform(g), uniform(g), uniform(g)};
  return p;
}
// Every coordinate a multiple of 2^-bits.
Points rounded(Points p, int bits) {
  for (Vec3& v : p)
    for (double* x : {&v.x, &v.y, &v.z})
      *x = std::ldexp(std::nearbyint(std::ldexp(*x, bits)), -bits);
  return p;
}
Points grid(int a, int b, int c, double step) {
  Points p;
  for (int i = 0; i < a; ++i)
    for (int j = 0; j < b; ++j)
      for (int k = 0; k < c; ++k) p.push_back({step * i, step * j, step * k});
  return p;
}
Points shuffled(Points p, uint64_t seed) {
  std::mt19937_64 g(seed);
  std::shuffle(p.begin(), p.end(), g);
  return p;
}

std::vector<uint32_t> distinct(const Delaunay& d) {
  std::vector<uint32_t> r;
  for (uint32_t i = 0; i < d.duplicateOf.size(); ++i)
    if (d.duplicateOf[i] == i) r.push_back(i);
  return r;
}

// Facets of tetrahedra, found in another way than by the core.
std::vector<uint32_t> facetsOf(const std::vector<uint32_t>& tetrahedra) {
  std::set<std::array<uint32_t, 3>> set;
  for (size_t t = 0; t < tetrahedra.size(); t += 4)
    for (size_t i = 0; i < 4; ++i) {
      std::array<uint32_t, 3> f;
      for (size_t j = 0, k = 0; j < 4; ++j)
        if (j != i) f[k++] = tetrahedra[t + j];
      std::sort(f.begin(), f.end());
      set.insert(f);
    }
  std::vector<uint32_t> r;
  for (const auto& f : set) r.insert(r.end(), f.begin(), f.end());
  return r;
}

// What is wrong with delaunay() on these points, which are multiples of 2^-shift.
std::string wrongWith(const Points& p, int dimension, int shift, bool everyPair) {
  Work work;
  Delaunay d;
  if (sf::delaunay(p, work, d) != Status::Ok) return "status";
  if (work.used() != 0) return "memory still charged";
  if (d.dimension != dimension) return "dimension " + std::to_string(d.dimension);
  for (uint32_t i = 0; i < p.size(); ++i) {
    uint32_t j = d.duplicateOf[i];
    if (j > i || !(p[j] == p[i]) || d.duplicateOf[j] != j) return "duplicates";
    for (uint32_t k = 0; everyPair && k < j; ++k)
      if (p[k] == p[i]) return "duplicates missed";
  }
  auto exact = exact::points(p, shift);
  if (dimension == 2) return exact::wrongWithTriangles(exact, distinct(d), d.facets);
  if (d.facets != facetsOf(d.tetrahedra)) return "facets";
  if (dimension < 3) return d.facets.empty() ? "" : "facets of a line";
  return exact::wrongWithTetrahedra(exact, distinct(d), d.tetrahedra, everyPair);
}

}  // namespace

TEST_CASE("delaunay: random points fill their hull with empty spheres") {
  for (size_t n : {4u, 5u, 6u, 7u, 10u, 20u, 60u})
    for (uint64_t seed = 1; seed <= 4; ++seed) {
      CAPTURE(n);
      CAPTURE(seed);
      CHECK(wrongWith(randomPoints(n, seed), 3, 64, true) == "");
    }
  CHECK(wrongWith(randomPoints(700, 3), 3, 64, false) == "");
}

TEST_CASE("delaunay: points on a coarse lattice, with many ties and repeated points") {
  for (int bits = 0; bits <= 3; ++bits)
    for (uint64_t seed = 1; seed <= 6; ++seed) {
      CAPTURE(bits);
      CAPTURE(seed);
      CHECK(wrongWith(rounded(randomPoints(36, seed), bits), 3, bits, true) == "");
    }
}

TEST_CASE("delaunay: whole grids, in order and shuffled") {
  for (double step : {1.0, 0.1})
    for (auto s : {std::array<int, 3>{2, 2, 2}, {4, 4, 4}, {2, 5, 9}, {1 + 1, 2, 14}}) {
      Points p = grid(s[0], s[1], s[2], step);
      CHECK(wrongWith(p, 3, 60, true) == "");
      CHECK(wrongWith(shuffled(p, 5), 3, 60, true) == "");
    }
  CHECK(wrongWith(shuffled(grid(7, 7, 7, 1), 2), 3, 0, false) == "");
}

TEST_CASE("delaunay: co-spherical points") {
  // All signed orders of (1, 4, 8), (4, 4, 7), (0, 0, 9) lie on the sphere of radius 9.
  Points p;
  std::set<std::array<double, 3>> all;
  for (std::array<double, 3> c : {std::array<double, 3>{1, 4, 8}, {4, 4, 7}, {0, 0, 9}}) {
    std::sort(c.begin(), c.end());
    do
      for (int s = 0; s < 8; ++s) {
        std::array<double, 3> q = c;
        for (size_t i = 0; i < 3; ++i)
          if (s >> i & 1 && q[i] != 0) q[i] = -q[i];
        all.insert(q);
      }
    while (std::next_permutation(c.begin(), c.end()));
  }
  for (const auto& c : all) p.push_back({c[0], c[1], c[2]});
  CHECK(p.size() == 78);
  CHECK(wrongWith(p, 3, 0, true) == "");
  CHECK(wrongWith(shuffled(p, 1), 3, 0, true) == "");
  p.push_back({0, 0, 0});
  CHECK(wrongWith(shuffled(p, 2), 3, 0, true) == "");

  for (Vec3& v : p = randomPoints(60, 9)) v = (1 / length(v)) * v;
  CHECK(wrongWith(p, 3, 64, true) == "");
}

TEST_CASE("delaunay: coplanar points yield the planar triangulation") {
  Points flat = randomPoints(70, 4);
  for (Vec3& v : flat) v.z = 0.25;
  CHECK(wrongWith(flat, 2, 64, true) == "");

  Points skew = rounded(randomPoints(70, 5), 20);
  for (Vec3& v : skew) v.z = v.x - 2 * v.y;
  CHECK(wrongWith(skew, 2, 20, true) == "");

  CHECK(wrongWith(grid(8, 7, 1, 1), 2, 0, true) == "");
  CHECK(wrongWith(shuffled(grid(8, 7, 1, 0.1), 3), 2, 60, true) == "");
  CHECK(wrongWith({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 2, 0, true) == "");
  CHECK(wrongWith({{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 2, 0, true) == "");

  // A plane through the first apex tried.
  Points steep = rounded(randomPoints(40, 6), 10);
  for (Vec3& v : steep) v = {v.x, v.y, v.x};
  steep[0] = {1 - 0x1p-10, 1 - 0x1p-10, 1 - 0x1p-10};
  CHECK(wrongWith(steep, 2, 10, true) == "");
}

TEST_CASE("delaunay: less than a plane") {
  CHECK(wrongWith({}, -1, 0, true) == "");
  CHECK(wrongWith({{1, 2, 3}}, 0, 0, true) == "");
  CHECK(wrongWith({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}, 0, 0, true) == "");
  CHECK(wrongWith({{1, 2, 3}, {2, 4, 6}, {-1, -2, -3}, {0, 0, 0}, {2, 4, 6}}, 1, 0, true) == "");
  CHECK(wrongWith({{0, 0, 0}, {-0.0, 0, 0}}, 0, 0, true) == "");

  Work work;
  sf::Tetrahedralization line(work);
  CHECK(line.add(Points{{0.5, 0.5, 0}, {0, 0, 0}, {0.25, 0.25, 0}, {0, 0, 0}}));
  std::vector<std::array<uint32_t, 2>> edges;
  line.forEachEdge([&](uint32_t a, uint32_t b) { edges.push_back({a, b}); });
  CHECK(edges == std::vector<std::array<uint32_t, 2>>{{1, 2}, {2, 0}});
}

TEST_CASE("delaunay: almost degenerate points") {
  std::mt19937_64 g(12);
  auto nudge = [&](double x) {
    for (int k = int(g() % 3); k > 0; --k) x = std::nextafter(x, g() % 2 ? 2.0 : -2.0);
    return x;
  };
  for (int round = 0; round < 3; ++round) {
    Points plane = randomPoints(60, g()), sphere = randomPoints(50, g()), line = sphere, ring;
    for (Vec3& v : plane) v.z = nudge((v.x + v.y) / 3);
    for (Vec3& v : sphere) {
      v = (0.5 / length(v)) * v;
      v = {nudge(v.x), nudge(v.y), nudge(v.z)};
    }
    for (Vec3& v : line) v = {v.x, nudge(v.x / 3), nudge(v.x / 7)};
    for (int i = 0; i < 48; ++i)
      for (double r : {0.5, 1.0}) {
        double t = i * 3.141592653589793 / 24;
        ring.push_back({r * std::cos(t), r * std::sin(t), nudge(0.125)});
      }
    CHECK(wrongWith(rounded(plane, 70), 3, 70, true) == "");
    CHECK(wrongWith(rounded(sphere, 70), 3, 70, true) == "");
    CHECK(wrongWith(rounded(line, 70), 3, 70, true) == "");
    CHECK(wrongWith(rounded(ring, 70), 3, 70, true) == "");
  }
}

TEST_CASE("delaunay: many points on two skew lines, with a quadratic number of tetrahedra") {
  Points p;
  for (int i = 0; i < 30; ++i) p.push_back({double(i), 0, 0}), p.push_back({3, double(i), 50});
  Work work;
  Delaunay d;
  CHECK(sf::delaunay(p, work, d) == Status::Ok);
  CHECK(d.tetrahedra.size() == 4 * 29 * 29);
  CHECK(wrongWith(p, 3, 0, true) == "");
}

TEST_CASE("delaunay: any magnitude of coordinates") {
  Points p = randomPoints(40, 8);
  Work work;
  Delaunay expected;
  CHECK(sf::delaunay(p, work, expected) == Status::Ok);
  for (int exponent : {1000, 500, -500, -900}) {
    Points q = p;
    for (Vec3& v : q)
      v = {std::ldexp(v.x, exponent), std::ldexp(v.y, exponent), std::ldexp(v.z, exponent)};
    Delaunay d;
    CHECK(sf::delaunay(q, work, d) == Status::Ok);
    CHECK(d.tetrahedra == expected.tetrahedra);
  }
}

TEST_CASE("delaunay: the outcome does not depend on how the points are added") {
  // Ties included, since these are broken by rank.
  for (uint64_t seed = 1; seed <= 8; ++seed) {
    Points p, all = rounded(randomPoints(90, seed), seed <= 4 ? 2 : 50);
    for (const Vec3& v : all)
      if (std::find(p.begin(), p.end(), v) == p.end()) p.push_back(v);
    Work work;
    Delaunay once;
    CHECK(sf::delaunay(p, work, once) == Status::Ok);

    // One by one, backwards, with ranks that undo the renumbering.
    sf::Tetrahedralization cells(work);
    uint32_t n = uint32_t(p.size());
    for (uint32_t i = n; i-- > 0;) CHECK(cells.add(Points{p[i]}, std::vector<uint32_t>{i}));
    std::vector<uint32_t> facets;
    std::set<std::array<uint32_t, 3>> set;
    cells.forEachFacet([&](uint32_t a, uint32_t b, uint32_t c) {
      std::array<uint32_t, 3> f = {n - 1 - a, n - 1 - b, n - 1 - c};
      std::sort(f.begin(), f.end());
      set.insert(f);
    });
    for (const auto& f : set) facets.insert(facets.end(), f.begin(), f.end());
    CHECK(facets == once.facets);
  }
}

TEST_CASE("delaunay: points added later may leave the plane or repeat others") {
  Work work;
  sf::Tetrahedralization cells(work);
  CHECK(cells.add(grid(3, 3, 1, 0.25)));
  CHECK(cells.dimension() == 2);
  CHECK(cells.add(Points{{0.125, 0.125, 0}, {0.25, 0.25, 0}}));
  CHECK(cells.dimension() == 2);
  CHECK(cells.duplicateOf(9) == 9);
  CHECK(cells.duplicateOf(10) == 4);
  CHECK(cells.add(Points{{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}}));
  CHECK(cells.dimension() == 3);
  CHECK(cells.duplicateOf(12) == 11);
  CHECK(cells.pointCount() == 13);
  CHECK(cells.add(Points{{0, 0, 0.5}}));
  std::vector<uint32_t> tetrahedra;
  cells.forEachTetrahedron([&](uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    tetrahedra.insert(tetrahedra.end(), {a, b, c, d});
  });
  Points p;
  for (uint32_t i = 0; i < cells.pointCount(); ++i) p.push_back(cells.point(i));
  CHECK(exact::wrongWithTetrahedra(exact::points(p, 10), {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 13},
                                   tetrahedra, true) == "");
}

TEST_CASE("delaunay: memory limit and stop end the work with a status") {
  Points p = randomPoints(20000, 1);
  for (size_t limit : {1000u, 600000u, 3000000u, 5000000u}) {
    Work work(limit, nullptr, nullptr);
    Delaunay d;
    CHECK(sf::delaunay(p, work, d) == Status::OutOfMemory);
    CHECK(work.used() == 0);
  }
  int calls = 0;
  auto stopAtThird = [](void* user, double, double, double) {
    return ++*static_cast<int*>(user) < 3;
  };
  Work work(size_t(-1), stopAtThird, &calls);
  Delaunay d;
  CHECK(sf::delaunay(p, work, d) == Status::Stopped);
  CHECK(calls == 3);
  CHECK(work.used() == 0);
}

TEST_CASE("insertion order: every point once, first rounds small") {
  Points p = randomPoints(5000, 2);
  std::vector<uint32_t> order(p.size());
  for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  Work work;
  CHECK(sf::sortForInsertion(p, work, order));
  double steps = 0;
  for (size_t i = order.size() / 2 + 300; i < order.size(); ++i)
    steps += distance(p[order[i - 1]], p[order[i]]);
  CHECK(steps / double(order.size() / 2 - 300) < 0.3);  // 1.3 if not sorted
  std::sort(order.begin(), order.end());
  for (uint32_t i = 0; i < order.size(); ++i) REQUIRE(order[i] == i);
}
