#include "mesh/intersect.h"

#include <cmath>

#include "base/predicates.h"

namespace sf {
namespace {

/// The sign of a turn in the projection along an axis.
int turnAlong(int axis, const Vec3& a, const Vec3& b, const Vec3& c) {
  if (axis == 0) return orient2d(a.y, a.z, b.y, b.z, c.y, c.z);
  if (axis == 1) return orient2d(a.z, a.x, b.z, b.x, c.z, c.x);
  return orient2d(a.x, a.y, b.x, b.y, c.x, c.y);
}

/// An axis along which a triangle keeps its shape, and the sign of its turn in that projection. The triangle must
/// not be collinear.
int axisOf(const Vec3 (&t)[3], int& turn) {
  for (int axis = 0; axis < 2; ++axis)
    if ((turn = turnAlong(axis, t[0], t[1], t[2])) != 0) return axis;
  turn = turnAlong(2, t[0], t[1], t[2]);
  return 2;
}

/// Whether c is between a and b, all on one line.
bool isBetween(const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto within = [](double p, double q, double r) {
    return (p <= r && r <= q) || (q <= r && r <= p);
  };
  return within(a.x, b.x, c.x) && within(a.y, b.y, c.y) && within(a.z, b.z, c.z);
}

/// Whether two segments of one plane meet, seen along an axis that the plane does not hold.
bool segmentsMeet(int axis, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const int ca = turnAlong(axis, c, d, a), cb = turnAlong(axis, c, d, b);
  const int ac = turnAlong(axis, a, b, c), ad = turnAlong(axis, a, b, d);
  if (ca * cb < 0 && ac * ad < 0) return true;
  return (ca == 0 && isBetween(c, d, a)) || (cb == 0 && isBetween(c, d, b)) ||
         (ac == 0 && isBetween(a, b, c)) || (ad == 0 && isBetween(a, b, d));
}

bool segmentMeetsInPlane(const Vec3& p, const Vec3& q, const Vec3 (&t)[3]) {
  int turn;
  const int axis = axisOf(t, turn);
  bool isInside = true;
  for (int k = 0; k < 3; ++k)
    isInside = isInside && turnAlong(axis, t[k], t[(k + 1) % 3], p) != -turn;
  if (isInside) return true;
  for (int k = 0; k < 3; ++k)
    if (segmentsMeet(axis, p, q, t[k], t[(k + 1) % 3])) return true;
  return false;
}

/// Whether a segment meets a triangle.
///   atP, atQ  on which sides of its plane the ends are
bool segmentMeets(const Vec3& p, int atP, const Vec3& q, int atQ, const Vec3 (&t)[3]) {
  if (atP * atQ > 0) return false;
  if (atP == 0 && atQ == 0) return segmentMeetsInPlane(p, q, t);
  // The line goes through the plane at one point, and passes all sides on the same hand where that is inside.
  int hand = 0;
  for (int k = 0; k < 3; ++k) {
    const int side = orient3d(p, q, t[k], t[(k + 1) % 3]);
    if (side * hand < 0) return false;
    if (side != 0) hand = side;
  }
  return true;
}

/// A power of two, which changes no digit.
struct Scale {
  double factor = 1;
  explicit Scale(double reach) {
    int exponent = 0;
    std::frexp(reach, &exponent);
    factor = std::ldexp(1, exponent > -1000 ? -exponent : 1000);
  }
  Vec3 operator()(Vec3 p) const { return {of(p.x), of(p.y), of(p.z)}; }
  double of(double x) const {
    const double s = factor * x;
    return std::fabs(s) < 0x1p-200 ? 0.0 : s;
  }
};

void readFace(MeshView mesh, uint32_t face, const Scale& scale, Vec3 (&corners)[3]) {
  for (size_t k = 0; k < 3; ++k)
    corners[k] = scale(pointAt(mesh.positions, mesh.faces[3 * size_t(face) + k]));
}

bool isDegenerate(const Vec3 (&t)[3]) { return collinear(t[0], t[1], t[2]); }

/// Of two triangles that are not collinear.
bool intersect(const Vec3 (&a)[3], const Vec3 (&b)[3]) {
  int partner[3] = {-1, -1, -1}, shared = 0, ownOfB[3] = {-1, -1, -1};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (a[i] == b[j]) partner[i] = j, ownOfB[j] = i, ++shared;
  if (shared == 3) return true;
  int sideOfB[3], sideOfA[3];
  bool isPositive = true, isNegative = true, isCoplanar = true;
  for (int j = 0; j < 3; ++j) {
    if (ownOfB[j] >= 0) {
      sideOfB[j] = 0;
      continue;
    }
    sideOfB[j] = orient3d(a[0], a[1], a[2], b[j]);
    isPositive = isPositive && sideOfB[j] > 0, isNegative = isNegative && sideOfB[j] < 0,
    isCoplanar = isCoplanar && sideOfB[j] == 0;
  }
  if (isPositive || isNegative) return false;
  if (shared == 2) {
    // Coplanar, with a side in common: they overlap if they are on the same side of it.
    if (!isCoplanar) return false;
    int i = 0, j = 0;
    while (partner[i] >= 0) ++i;
    while (ownOfB[j] >= 0) ++j;
    int turn;
    const int axis = axisOf(a, turn);
    return turnAlong(axis, a[(i + 1) % 3], a[(i + 2) % 3], b[j]) == turn;
  }
  isPositive = isNegative = true;
  for (int i = 0; i < 3; ++i) {
    if (partner[i] >= 0) {
      sideOfA[i] = 0;
      continue;
    }
    sideOfA[i] = isCoplanar ? 0 : orient3d(b[0], b[1], b[2], a[i]);
    isPositive = isPositive && sideOfA[i] > 0, isNegative = isNegative && sideOfA[i] < 0;
  }
  if (isPositive || isNegative) return false;
  // With a vertex in common: the ray from it to another common point leaves one of the triangles, through the side
  // opposite it, where it is still in the other. Without: some side of one meets the other.
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    if ((shared == 0 || ownOfB[(k + 2) % 3] >= 0) &&
        segmentMeets(b[k], sideOfB[k], b[next], sideOfB[next], a))
      return true;
    if ((shared == 0 || partner[(k + 2) % 3] >= 0) &&
        segmentMeets(a[k], sideOfA[k], a[next], sideOfA[next], b))
      return true;
  }
  return false;
}

/// The pairs of a face with those in a tree, all of them or only those after it.
bool search(MeshView mesh, uint32_t from, uint32_t to, MeshView other, const TriangleTree& tree,
            bool onlyLater, size_t most, Work& work, std::vector<FacePair>& pairs) {
  if (tree.empty() || from >= to) return work.going();
  double reach = tree.box().reach();
  for (uint32_t f = from; f < to; ++f) reach = std::fmax(reach, Box::ofTriangle(mesh, f).reach());
  const Scale scale(reach);
  Charge charge(work);
  for (uint32_t f = from; f < to && most > 0; ++f) {
    Vec3 a[3];
    readFace(mesh, f, scale, a);
    if (isDegenerate(a)) continue;
    const Box box = Box::ofTriangle(mesh, f);
    uint32_t tests = 0;
    bool isCharged = true;
    tree.visit(box, [&](uint32_t g) {
      if ((onlyLater && g <= f) || !box.meets(Box::ofTriangle(other, g))) return true;
      ++tests;
      Vec3 b[3];
      readFace(other, g, scale, b);
      if (isDegenerate(b) || !intersect(a, b)) return work.tick(200);
      isCharged = push(pairs, FacePair{f, g}, charge);
      return isCharged && --most > 0;
    });
    if (!isCharged || !work.tick(100 + 100 * tests)) return false;
  }
  return work.going();
}

}  // namespace

bool trianglesIntersect(const Vec3 (&a)[3], const Vec3 (&b)[3]) {
  return !isDegenerate(a) && !isDegenerate(b) && intersect(a, b);
}

bool findIntersections(MeshView mesh, uint32_t from, uint32_t to, MeshView other,
                       const TriangleTree& tree, size_t most, Work& work,
                       std::vector<FacePair>& pairs) {
  return search(mesh, from, to, other, tree, false, most, work, pairs);
}

bool findSelfIntersections(MeshView mesh, uint32_t from, uint32_t to, size_t most, Work& work,
                           std::vector<FacePair>& pairs) {
  Charge charge(work);
  TriangleTree tree;
  return tree.build(mesh, from, to, work, charge) &&
         search(mesh, from, to, mesh, tree, true, most, work, pairs);
}

}  // namespace sf
