#include "support/self_intersection.h"

#include <algorithm>
#include <cmath>

namespace sftest {
namespace {

using sf::Vec3;

/// An exact sum of doubles, kept as components that do not overlap, in increasing magnitude.
class Exact {
 public:
  static Exact difference(double a, double b) {
    Exact e;
    e.add(a);
    e.add(-b);
    return e;
  }
  void add(double b) {
    // Knuth's two-sum against every component; zeros are dropped.
    size_t kept = 0;
    for (double part : parts_) {
      double sum = b + part, bVirtual = sum - part;
      double error = (b - bVirtual) + (part - (sum - bVirtual));
      if (error != 0) parts_[kept++] = error;
      b = sum;
    }
    parts_.resize(kept);
    if (b != 0) parts_.push_back(b);
  }
  void add(const Exact& e, double factor = 1) {
    for (double part : e.parts_) add(factor * part);
  }
  friend Exact operator*(const Exact& a, const Exact& b) {
    Exact product;
    for (double x : a.parts_)
      for (double y : b.parts_) {
        double high = x * y;
        product.add(std::fma(x, y, -high));
        product.add(high);
      }
    return product;
  }
  int sign() const {
    if (parts_.empty()) return 0;
    return parts_.back() > 0 ? 1 : -1;
  }

 private:
  std::vector<double> parts_;
};

struct Point2 {
  double x, y;
};

Point2 dropAxis(Vec3 p, int axis) {
  if (axis == 0) return {p.y, p.z};
  return axis == 1 ? Point2{p.z, p.x} : Point2{p.x, p.y};
}

int orient2(Point2 a, Point2 b, Point2 c) {
  double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
  double value = left - right;
  if (std::fabs(value) > 1e-14 * (std::fabs(left) + std::fabs(right))) return value > 0 ? 1 : -1;
  Exact sum = Exact::difference(a.x, c.x) * Exact::difference(b.y, c.y);
  sum.add(Exact::difference(a.y, c.y) * Exact::difference(b.x, c.x), -1);
  return sum.sign();
}

int orient3(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  Vec3 u = a - d, v = b - d, w = c - d;
  double value = dot(u, cross(v, w));
  auto magnitude = [](Vec3 p, Vec3 q, Vec3 r) {
    return std::fabs(p.x) * (std::fabs(q.y * r.z) + std::fabs(q.z * r.y));
  };
  double scale = magnitude(u, v, w) + magnitude(v, w, u) + magnitude(w, u, v);
  if (std::fabs(value) > 1e-13 * scale) return value > 0 ? 1 : -1;
  Vec3 p[3] = {a, b, c};
  Exact sum;
  for (int i = 0; i < 3; ++i) {
    Exact x = Exact::difference(p[i].x, d.x);
    const Vec3 &q = p[(i + 1) % 3], &r = p[(i + 2) % 3];
    Exact minor = Exact::difference(q.y, d.y) * Exact::difference(r.z, d.z);
    minor.add(Exact::difference(q.z, d.z) * Exact::difference(r.y, d.y), -1);
    sum.add(x * minor);
  }
  return sum.sign();
}

struct Corners {
  uint32_t v[3];
  bool has(uint32_t w) const { return v[0] == w || v[1] == w || v[2] == w; }
};

bool onSegment(Point2 a, Point2 b, Point2 p) {  // p is collinear with a and b
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

bool segmentsMeet(Point2 a, Point2 b, Point2 c, Point2 d) {
  int abc = orient2(a, b, c), abd = orient2(a, b, d), cda = orient2(c, d, a),
      cdb = orient2(c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && onSegment(a, b, c)) || (abd == 0 && onSegment(a, b, d)) ||
         (cda == 0 && onSegment(c, d, a)) || (cdb == 0 && onSegment(c, d, b));
}

class Pair {
 public:
  Pair(const std::vector<Vec3>& positions, Corners target) : positions_(positions), t_(target) {
    while (axis_ < 2 && orient2(flat(t_.v[0]), flat(t_.v[1]), flat(t_.v[2])) == 0) ++axis_;
    if (orient2(flat(t_.v[0]), flat(t_.v[1]), flat(t_.v[2])) < 0) std::swap(t_.v[1], t_.v[2]);
  }

  /// Whether the closed segment p-q meets the closed triangle elsewhere than in shared corners.
  bool edgeMeets(uint32_t p, uint32_t q) const {
    bool sharesP = t_.has(p), sharesQ = t_.has(q);
    if (sharesP && sharesQ) return false;
    if (sharesQ) std::swap(p, q), std::swap(sharesP, sharesQ);
    int sideP = side(p), sideQ = side(q);
    if (sideP == 0 && sideQ == 0) return sharesP ? entersAt(p, q) : meetsInPlane(p, q);
    if (sharesP || sideP * sideQ > 0) return false;
    if (sideP == 0) return contains(flat(p));
    if (sideQ == 0) return contains(flat(q));
    int s[3];
    for (int i = 0; i < 3; ++i)
      s[i] =
          orient3(positions_[p], positions_[q], positions_[t_.v[i]], positions_[t_.v[(i + 1) % 3]]);
    return (s[0] >= 0 && s[1] >= 0 && s[2] >= 0) || (s[0] <= 0 && s[1] <= 0 && s[2] <= 0);
  }

 private:
  Point2 flat(uint32_t v) const { return dropAxis(positions_[v], axis_); }
  int side(uint32_t v) const {
    if (t_.has(v)) return 0;
    return orient3(positions_[t_.v[0]], positions_[t_.v[1]], positions_[t_.v[2]], positions_[v]);
  }
  bool contains(Point2 p) const {
    for (int i = 0; i < 3; ++i)
      if (orient2(flat(t_.v[i]), flat(t_.v[(i + 1) % 3]), p) < 0) return false;
    return true;
  }
  /// Both ends in the triangle's plane, p one of its corners: does p-q run into it?
  bool entersAt(uint32_t p, uint32_t q) const {
    int i = int(std::find(t_.v, t_.v + 3, p) - t_.v);
    Point2 corner = flat(p), next = flat(t_.v[(i + 1) % 3]), last = flat(t_.v[(i + 2) % 3]);
    return orient2(corner, next, flat(q)) >= 0 && orient2(corner, last, flat(q)) <= 0;
  }
  bool meetsInPlane(uint32_t p, uint32_t q) const {
    if (contains(flat(p)) || contains(flat(q))) return true;
    for (int i = 0; i < 3; ++i)
      if (segmentsMeet(flat(p), flat(q), flat(t_.v[i]), flat(t_.v[(i + 1) % 3]))) return true;
    return false;
  }

  const std::vector<Vec3>& positions_;
  Corners t_;
  int axis_ = 0;
};

bool boxesApart(const std::vector<Vec3>& p, const Corners& a, const Corners& b) {
  for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
    auto range = [&](const Corners& t) {
      return std::minmax({p[t.v[0]].*axis, p[t.v[1]].*axis, p[t.v[2]].*axis});
    };
    auto [lowA, highA] = range(a);
    auto [lowB, highB] = range(b);
    if (highA < lowB || highB < lowA) return true;
  }
  return false;
}

}  // namespace

bool collinear(Vec3 a, Vec3 b, Vec3 c) {
  for (int axis = 0; axis < 3; ++axis)
    if (orient2(dropAxis(a, axis), dropAxis(b, axis), dropAxis(c, axis)) != 0) return false;
  return true;
}

bool segmentsMeet(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  if (orient3(a, b, c, d) != 0) return false;
  // In one plane: they meet if they do seen along an axis that does not lie in that plane; on one
  // line, if their shadows meet along every axis.
  for (int axis = 0; axis < 3; ++axis) {
    Point2 p = dropAxis(a, axis), q = dropAxis(b, axis), r = dropAxis(c, axis),
           s = dropAxis(d, axis);
    if (!segmentsMeet(p, q, r, s)) return false;
  }
  return true;
}

Crossing findCrossing(const std::vector<Vec3>& positions, const std::vector<uint32_t>& triangles) {
  uint32_t m = uint32_t(triangles.size() / 3);
  auto corners = [&](uint32_t t) {
    return Corners{{triangles[3 * t], triangles[3 * t + 1], triangles[3 * t + 2]}};
  };
  for (uint32_t i = 0; i < m; ++i)
    for (uint32_t j = 0; j < i; ++j) {
      Corners a = corners(i), b = corners(j);
      if (boxesApart(positions, a, b)) continue;
      Pair intoA(positions, a), intoB(positions, b);
      for (int e = 0; e < 3; ++e)
        if (intoA.edgeMeets(b.v[e], b.v[(e + 1) % 3]) || intoB.edgeMeets(a.v[e], a.v[(e + 1) % 3]))
          return {true, j, i};
    }
  return {};
}

}  // namespace sftest
