// What a Delaunay tetrahedralization has to satisfy, in exact integer arithmetic.
#pragma once
#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

#include "base/array_view.h"
#include "support/exact.h"

namespace exact {

using I = Int<9>;  // for coordinates of about 110 bits
using P = Point<9>;

inline std::vector<P> points(sf::ArrayView<const sf::Vec3> p, int shift) {
  std::vector<P> r;
  for (const sf::Vec3& v : p) r.push_back(point<9>(v, shift));
  return r;
}

/// Six times the volume of the convex hull, by adding one point after the other
/// to a closed surface.
inline I hullVolume6(const std::vector<P>& p) {
  size_t b = 1, c, d;
  auto equal = [](const P& u, const P& v) { return dot(u - v, u - v).sign() == 0; };
  while (b < p.size() && equal(p[0], p[b])) ++b;
  auto area = [&](size_t k) {
    P n = cross(p[b] - p[0], p[k] - p[0]);
    return dot(n, n).sign();
  };
  for (c = b + 1; c < p.size() && area(c) == 0;) ++c;
  for (d = c + 1; d < p.size() && volume6(p[0], p[b], p[c], p[d]).sign() == 0;) ++d;
  if (d >= p.size()) return I(0);
  if (volume6(p[0], p[b], p[c], p[d]).sign() > 0) std::swap(b, c);
  // Triangles turn left as seen from outside; volumes are positive there.
  std::vector<std::array<size_t, 3>> hull = {{0, b, c}, {0, c, d}, {0, d, b}, {b, d, c}};
  for (size_t i = 0; i < p.size(); ++i) {
    std::vector<std::array<size_t, 3>> kept;
    std::map<std::pair<size_t, size_t>, int> rim;  // directed edges of the faces that i sees
    for (const auto& f : hull) {
      if (volume6(p[f[0]], p[f[1]], p[f[2]], p[i]).sign() <= 0) {
        kept.push_back(f);
        continue;
      }
      for (size_t k = 0; k < 3; ++k) {
        size_t u = f[k], v = f[(k + 1) % 3];
        if (!rim.erase({v, u})) rim[{u, v}] = 1;
      }
    }
    for (const auto& e : rim) kept.push_back({e.first.first, e.first.second, i});
    hull = std::move(kept);
  }
  I sum;
  for (const auto& f : hull) sum = sum + volume6(p[f[0]], p[f[1]], p[f[2]], p[0]);
  return -sum;
}

/// Twice the area of the convex hull of points projected along z, by Andrew's monotone chain.
inline I hullArea2(std::vector<P> p) {
  std::sort(p.begin(), p.end(), [](const P& a, const P& b) {
    int s = (a.x - b.x).sign();
    return s != 0 ? s < 0 : (a.y - b.y).sign() < 0;
  });
  std::vector<P> chain;
  for (int side = 0; side < 2; ++side) {
    size_t low = chain.size();
    for (const P& q : p) {
      while (chain.size() >= low + 2 &&
             cross(chain.back() - chain[chain.size() - 2], q - chain.back()).z.sign() <= 0)
        chain.pop_back();
      chain.push_back(q);
    }
    std::reverse(p.begin(), p.end());
  }
  I sum;
  for (size_t i = 0; i + 1 < chain.size(); ++i)
    sum = sum + cross(chain[i] - p[0], chain[i + 1] - p[0]).z;
  return sum;
}

/// What is wrong with tetrahedra as the Delaunay tetrahedralization of p, empty if nothing is.
///   p           the points, exact
///   distinct    the points that have to be vertices
///   tetrahedra  [4t]
///   everyPair   test each point against each sphere; else the local property only, which implies
///               it for tetrahedra that cover the hull
inline std::string wrongWithTetrahedra(const std::vector<P>& p,
                                       const std::vector<uint32_t>& distinct,
                                       const std::vector<uint32_t>& tetrahedra, bool everyPair,
                                       bool checkHull = true) {
  std::map<std::array<uint32_t, 3>, std::vector<std::array<uint32_t, 4>>> sides;
  std::vector<char> used(p.size(), 0);
  I sum;
  for (size_t t = 0; t < tetrahedra.size(); t += 4) {
    const uint32_t* v = &tetrahedra[t];
    I volume = volume6(p[v[0]], p[v[1]], p[v[2]], p[v[3]]);
    if (volume.sign() <= 0) return "a tetrahedron is flat or turned inside out";
    sum = sum + volume;
    for (int i = 0; i < 4; ++i) {
      used[v[i]] = 1;
      std::array<uint32_t, 3> f = {v[(i + 1) % 4], v[(i + 2) % 4], v[(i + 3) % 4]};
      std::sort(f.begin(), f.end());
      sides[f].push_back({v[0], v[1], v[2], v[3]});
    }
    if (everyPair)
      for (uint32_t e : distinct)
        if (inSphere(p[v[0]], p[v[1]], p[v[2]], p[v[3]], p[e]).sign() > 0)
          return "a point is inside of a circumsphere";
  }
  for (uint32_t v : distinct)
    if (!used[v]) return "a point is no vertex";
  for (const auto& side : sides) {
    const auto& f = side.first;
    if (side.second.size() > 2) return "three tetrahedra at one facet";
    auto opposite = [&](const std::array<uint32_t, 4>& t) {
      return t[0] ^ t[1] ^ t[2] ^ t[3] ^ f[0] ^ f[1] ^ f[2];
    };
    uint32_t a = opposite(side.second[0]);
    int s = volume6(p[f[0]], p[f[1]], p[f[2]], p[a]).sign();
    if (side.second.size() == 2) {
      uint32_t b = opposite(side.second[1]);
      if (volume6(p[f[0]], p[f[1]], p[f[2]], p[b]).sign() != -s) return "neighbours overlap";
      const auto& t = side.second[0];
      if (inSphere(p[t[0]], p[t[1]], p[t[2]], p[t[3]], p[b]).sign() > 0)
        return "a neighbour is inside of a circumsphere";
    } else if (everyPair) {
      for (uint32_t e : distinct)
        if (volume6(p[f[0]], p[f[1]], p[f[2]], p[e]).sign() == -s)
          return "a point is outside of the boundary";
    }
  }
  if (checkHull && !(sum == hullVolume6(p))) return "the tetrahedra do not fill the convex hull";
  return "";
}

/// What is wrong with triangles as the Delaunay triangulation of coplanar points, which must not
/// lie in a vertical plane; empty if nothing is.
inline std::string wrongWithTriangles(const std::vector<P>& p,
                                      const std::vector<uint32_t>& distinct,
                                      const std::vector<uint32_t>& triangles) {
  std::map<std::array<uint32_t, 2>, int> edges;
  std::vector<char> used(p.size(), 0);
  I sum;
  for (size_t t = 0; t < triangles.size(); t += 3) {
    uint32_t a = triangles[t], b = triangles[t + 1], c = triangles[t + 2];
    for (uint32_t v : {a, b, c}) used[v] = 1;
    for (auto e : {std::array<uint32_t, 2>{a, b}, {a, c}, {b, c}})
      if (++edges[{std::min(e[0], e[1]), std::max(e[0], e[1])}] > 2) return "three at one edge";
    P n = cross(p[b] - p[a], p[c] - p[a]);
    if (n.z.sign() == 0) return "a triangle is flat";
    sum = n.z.sign() > 0 ? sum + n.z : sum - n.z;
    P top = {p[a].x + n.x, p[a].y + n.y, p[a].z + n.z};
    for (uint32_t e : distinct)
      if (inSphere(p[a], p[b], p[c], top, p[e]).sign() > 0) return "a point is inside of a circle";
  }
  for (uint32_t v : distinct)
    if (!used[v]) return "a point is no vertex";
  if (!(sum == hullArea2(p))) return "the triangles do not fill the convex hull";
  return "";
}

}  // namespace exact
