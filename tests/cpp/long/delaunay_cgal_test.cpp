// The tetrahedralization against CGAL's, an independent implementation with exact predicates.
#ifdef SF_HAVE_CGAL
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>

#include "delaunay/delaunay.h"

using sf::Delaunay;
using sf::Status;
using sf::Vec3;
using sf::Work;
using Points = std::vector<Vec3>;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<uint32_t, Kernel>;
using Cells = CGAL::Triangulation_data_structure_3<VertexBase>;
using Oracle = CGAL::Delaunay_triangulation_3<Kernel, Cells>;
using Facet = std::array<uint32_t, 3>;

Kernel::Point_3 point(const Vec3& p) { return {p.x, p.y, p.z}; }

std::vector<Facet> facetsByCgal(const Points& points) {
  std::vector<std::pair<Kernel::Point_3, uint32_t>> numbered;
  for (uint32_t i = 0; i < points.size(); ++i) numbered.push_back({point(points[i]), i});
  Oracle oracle(numbered.begin(), numbered.end());
  std::vector<Facet> facets;
  for (auto f = oracle.finite_facets_begin(); f != oracle.finite_facets_end(); ++f) {
    Facet t;
    for (int i = 0, k = 0; i < 4; ++i)
      if (i != f->second) t[size_t(k++)] = f->first->vertex(i)->info();
    std::sort(t.begin(), t.end());
    facets.push_back(t);
  }
  std::sort(facets.begin(), facets.end());
  return facets;
}

Delaunay ours(const Points& points) {
  Work work;
  Delaunay d;
  CHECK(sf::delaunay(points, work, d) == Status::Ok);
  return d;
}

// Whether both find the same facets; for points whose tetrahedralization is unique.
bool agree(const Points& points) {
  std::vector<Facet> expected = facetsByCgal(points);
  Delaunay d = ours(points);
  if (d.facets.size() != 3 * expected.size()) return false;
  for (size_t i = 0; i < d.facets.size(); ++i)
    if (d.facets[i] != expected[i / 3][i % 3]) return false;
  return true;
}

// What is wrong with our tetrahedra, by CGAL's exact predicates; for points with ties.
//   volume6  six times the volume of the hull; tetrahedra are taken to have exact volumes in doubles
std::string wrongWith(const Points& p, double volume6) {
  Delaunay d = ours(p);
  struct Side {
    Facet facet;
    uint32_t tetrahedron, opposite;
    bool operator<(const Side& o) const { return facet < o.facet; }
  };
  std::vector<Side> sides;
  std::vector<char> used(p.size(), 0);
  double sum = 0;
  for (uint32_t t = 0; t < d.tetrahedra.size() / 4; ++t) {
    const uint32_t* v = &d.tetrahedra[4 * size_t(t)];
    if (CGAL::orientation(point(p[v[0]]), point(p[v[1]]), point(p[v[2]]), point(p[v[3]])) !=
        CGAL::POSITIVE)
      return "a tetrahedron is flat or turned inside out";
    sum += dot(cross(p[v[1]] - p[v[0]], p[v[2]] - p[v[0]]), p[v[3]] - p[v[0]]);
    for (size_t i = 0; i < 4; ++i) {
      used[v[i]] = 1;
      Facet f = {v[(i + 1) % 4], v[(i + 2) % 4], v[(i + 3) % 4]};
      std::sort(f.begin(), f.end());
      sides.push_back({f, t, v[i]});
    }
  }
  std::sort(sides.begin(), sides.end());
  for (size_t i = 0; i + 1 < sides.size(); ++i) {
    if (sides[i].facet != sides[i + 1].facet) continue;
    if (i + 2 < sides.size() && sides[i].facet == sides[i + 2].facet) return "three at one facet";
    const uint32_t* v = &d.tetrahedra[4 * size_t(sides[i].tetrahedron)];
    if (CGAL::side_of_oriented_sphere(point(p[v[0]]), point(p[v[1]]), point(p[v[2]]),
                                      point(p[v[3]]),
                                      point(p[sides[i + 1].opposite])) == CGAL::ON_POSITIVE_SIDE)
      return "a neighbour is inside of a circumsphere";
  }
  for (uint32_t i = 0; i < p.size(); ++i)
    if (!used[i] && d.duplicateOf[i] == i) return "a point is no vertex";
  return sum == volume6 ? "" : "the tetrahedra do not fill the hull";
}

Points randomPoints(size_t n, uint64_t seed) {
  std::mt19937_64 g(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  Points p(n);
  for (Vec3& v : p) v = {u(g), u(g), u(g)};
  return p;
}

}  // namespace

TEST_CASE("delaunay against CGAL: the same facets for random points") {
  for (size_t n : {10u, 1000u, 30000u, 200000u}) {
    CAPTURE(n);
    CHECK(agree(randomPoints(n, n)));
  }
  for (uint64_t seed = 1; seed <= 300; ++seed) {
    CAPTURE(seed);
    CHECK(agree(randomPoints(5 + seed % 40, seed)));
  }
}

TEST_CASE("delaunay against CGAL: the same facets for uneven distributions") {
  Points clusters = randomPoints(50000, 2), centres = randomPoints(50, 3),
         thin = randomPoints(50000, 4);
  for (size_t i = 0; i < clusters.size(); ++i)
    clusters[i] = centres[i % 50] + std::ldexp(1, -int(i % 23)) * clusters[i];
  CHECK(agree(clusters));
  for (Vec3& v : thin) v = {v.x, 1e-3 * v.y, 1e-6 * v.z};
  CHECK(agree(thin));
  // Noise in the last bits, far from the origin.
  for (Vec3& v : thin) v = {1000 + v.x, 1000 + v.y, 1000 + 1e-12 * v.z};
  CHECK(agree(thin));
}

TEST_CASE("delaunay against CGAL: the same facets for curves and surfaces") {
  std::mt19937_64 g(9);
  std::uniform_real_distribution<double> noise(-1e-7, 1e-7);
  Points saddle, sphere = randomPoints(40000, 5), moment;
  for (int i = 0; i < 100000; ++i) {
    double t = 2 * 3.141592653589793 * i / 100000;
    saddle.push_back(
        {std::cos(t) + noise(g), std::sin(t) + noise(g), 0.5 * std::cos(3 * t) + noise(g)});
  }
  CHECK(agree(saddle));
  // On a sphere up to rounding: rounding makes it unique.
  for (Vec3& v : sphere) v = (1 / length(v)) * v;
  CHECK(agree(sphere));
  // Neighbourly: every pair of points is an edge.
  for (int i = 0; i < 700; ++i) {
    double t = i / 700.0;
    moment.push_back({t, t * t, t * t * t});
  }
  CHECK(agree(moment));
}

TEST_CASE("delaunay against CGAL: a valid tetrahedralization of lattices") {
  Points grid, spheres;
  for (int i = 0; i < 58; ++i)
    for (int j = 0; j < 58; ++j)
      for (int k = 0; k < 59; ++k) grid.push_back({double(i), double(j), double(k)});
  std::shuffle(grid.begin(), grid.end(), std::mt19937_64(1));
  CHECK(wrongWith(grid, 6.0 * 57 * 57 * 58) == "");
  for (Vec3& v : grid) v = {2 * v.x, v.y + 4 * v.x, v.z - 8 * v.y};
  CHECK(wrongWith(grid, 2 * 6.0 * 57 * 57 * 58) == "");
  // Sheared with even more ties; every point twice.
  grid.resize(50000);
  Points some(grid.begin(), grid.begin() + 20000);
  Delaunay once = ours(some);
  some.insert(some.end(), grid.begin(), grid.begin() + 20000);
  Delaunay twice = ours(some);
  CHECK(once.facets == twice.facets);
}
#endif
