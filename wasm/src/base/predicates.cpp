#include "base/predicates.h"

#include <cfloat>
#include <cmath>

#if defined(__FAST_MATH__)
#error "predicates.cpp must not be compiled with -ffast-math"
#endif
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(__GNUC__)
#pragma GCC optimize("fp-contract=off")
#endif
static_assert(FLT_EVAL_METHOD == 0, "predicates need plain double arithmetic");

#include "base/expansion.h"

namespace sf {
namespace {

// Half a unit in the last place of 1: the relative error of one operation.
constexpr double kUnit = DBL_EPSILON / 2;
// More than all underflows of one evaluation together, less than anything that matters.
constexpr double kTiny = 1e-290;

// Error bounds of the sums of products below, for differences of magnitude at most m per axis, as
// (number of elementary products) x (rounding errors in each) x unit, rounded up.
constexpr double kOrient2dBound = 2 * 5 * kUnit;
constexpr double kOrient3dBound = 6 * 9 * kUnit;
constexpr double kIncircleBound = 12 * 12 * kUnit;
constexpr double kInsphereBound = 72 * 18 * kUnit;
// A double-double operation errs by less than 2^-100 relatively; the same counts hold.
constexpr double kPairUnit = 0x1p-100;
constexpr double kPairOverDouble = kPairUnit / kUnit;

// The exact stage works on coordinates times this, so that nothing underflows: the least bit of a
// product of five coordinates is 2^(5 (150 - 252)).
constexpr double kExactScale = 0x1p150;

int signOf(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }
double max2(double a, double b) { return a > b ? a : b; }

// Double-double arithmetic. Out of line: inlined, the second stages would be many times as long.
__attribute__((noinline)) Pair operator+(Pair a, Pair b) {
  Pair s = twoSum(a.hi, b.hi), t = twoSum(a.lo, b.lo);
  s = fastTwoSum(s.hi, s.lo + t.hi);
  return fastTwoSum(s.hi, s.lo + t.lo);
}
Pair operator-(Pair a, Pair b) { return a + Pair{-b.hi, -b.lo}; }
__attribute__((noinline)) Pair operator*(Pair a, Pair b) {
  Pair p = twoProduct(a.hi, b.hi);
  return fastTwoSum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

// Differences in the three number types of the stages.
struct InDouble {
  using Number = double;
  static double difference(double a, double b) { return a - b; }
};
struct InPair {
  using Number = Pair;
  static Pair difference(double a, double b) { return twoDiff(a, b); }
};
struct InExpansion {
  using Number = Expansion;
  static Expansion difference(double a, double b) {
    return Expansion(twoDiff(kExactScale * a, kExactScale * b));
  }
};

// Always inline: GCC 12 at -O1 otherwise drops the stores to arguments passed by reference.
template <class N>
__attribute__((always_inline)) inline N minor2(const N& ax, const N& ay, const N& bx, const N& by) {
  return ax * by - bx * ay;
}

template <class S>
typename S::Number orient2dIn(double ax, double ay, double bx, double by, double cx, double cy) {
  return minor2(S::difference(ax, cx), S::difference(ay, cy), S::difference(bx, cx),
                S::difference(by, cy));
}

template <class S>
typename S::Number turn2dIn(double ax, double ay, double bx, double by, double cx, double cy,
                            double dx, double dy) {
  return minor2(S::difference(bx, ax), S::difference(by, ay), S::difference(dx, cx),
                S::difference(dy, cy));
}

template <class S>
typename S::Number orient3dIn(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  using N = typename S::Number;
  N ax = S::difference(a.x, d.x), ay = S::difference(a.y, d.y), az = S::difference(a.z, d.z);
  N bx = S::difference(b.x, d.x), by = S::difference(b.y, d.y), bz = S::difference(b.z, d.z);
  N cx = S::difference(c.x, d.x), cy = S::difference(c.y, d.y), cz = S::difference(c.z, d.z);
  return az * minor2(cx, cy, bx, by) + bz * minor2(ax, ay, cx, cy) + cz * minor2(bx, by, ax, ay);
}

template <class S>
typename S::Number incircleIn(double ax, double ay, double bx, double by, double cx, double cy,
                              double dx, double dy) {
  using N = typename S::Number;
  N px = S::difference(ax, dx), py = S::difference(ay, dy);
  N qx = S::difference(bx, dx), qy = S::difference(by, dy);
  N rx = S::difference(cx, dx), ry = S::difference(cy, dy);
  return (px * px + py * py) * minor2(qx, qy, rx, ry) +
         (qx * qx + qy * qy) * minor2(rx, ry, px, py) +
         (rx * rx + ry * ry) * minor2(px, py, qx, qy);
}

template <class S>
typename S::Number insphereIn(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
                              const Vec3& e) {
  using N = typename S::Number;
  N ax = S::difference(a.x, e.x), ay = S::difference(a.y, e.y), az = S::difference(a.z, e.z);
  N bx = S::difference(b.x, e.x), by = S::difference(b.y, e.y), bz = S::difference(b.z, e.z);
  N cx = S::difference(c.x, e.x), cy = S::difference(c.y, e.y), cz = S::difference(c.z, e.z);
  N dx = S::difference(d.x, e.x), dy = S::difference(d.y, e.y), dz = S::difference(d.z, e.z);
  N ab = minor2(ax, ay, bx, by), bc = minor2(bx, by, cx, cy), cd = minor2(cx, cy, dx, dy);
  N da = minor2(dx, dy, ax, ay), ac = minor2(ax, ay, cx, cy), bd = minor2(bx, by, dx, dy);
  N abc = az * bc - bz * ac + cz * ab;
  N bcd = bz * cd - cz * bd + dz * bc;
  N cda = cz * da + dz * ac + az * cd;
  N dab = dz * ab + az * bd + bz * da;
  return (ax * ax + ay * ay + az * az) * bcd - (bx * bx + by * by + bz * bz) * cda +
         ((cx * cx + cy * cy + cz * cz) * dab - (dx * dx + dy * dy + dz * dz) * abc);
}

// Whether a - b is computed without error and is a multiple of 2^-52 |magic| / 1.5.
bool isMultiple(double a, double b, double magic) {
  Pair d = twoDiff(a, b);
  return d.lo == 0 && (d.hi + magic) - magic == d.hi;
}
// 1.5 2^52 u for the power of two u in (2^-bits m, 2^(1-bits) m]: what isMultiple takes.
double magicFor(double m, int bits) {
  int exponent;
  std::frexp(m, &exponent);
  return std::ldexp(1.5, 52 + exponent - bits);
}
bool areMultiples(const Vec3& a, const Vec3& b, double magic) {
  return isMultiple(a.x, b.x, magic) && isMultiple(a.y, b.y, magic) && isMultiple(a.z, b.z, magic);
}

void widen(Vec3& extent, const Vec3& a, const Vec3& b) {
  extent.x = max2(extent.x, std::fabs(a.x - b.x));
  extent.y = max2(extent.y, std::fabs(a.y - b.y));
  extent.z = max2(extent.z, std::fabs(a.z - b.z));
}
double greatest(const Vec3& v) { return max2(max2(v.x, v.y), v.z); }

/// The sign of ax by - bx ay, for differences computed without error, like those of lattice points
/// or of points with a coordinate in common; kUnknown if two roundings leave it open.
constexpr int kUnknown = 2;
int signOfMinor2(Pair ax, Pair ay, Pair bx, Pair by) {
  if (ax.lo != 0 || ay.lo != 0 || bx.lo != 0 || by.lo != 0) return kUnknown;
  const Pair l = twoProduct(ax.hi, by.hi), r = twoProduct(bx.hi, ay.hi);
  const auto isSafe = [](double product, double a, double b) {
    return std::fabs(product) > 0x1p-900 || a == 0 || b == 0;  // no underflow
  };
  if (!isSafe(l.hi, ax.hi, by.hi) || !isSafe(r.hi, bx.hi, ay.hi)) return kUnknown;
  if (l.hi == r.hi) return l.lo > r.lo ? 1 : l.lo < r.lo ? -1 : 0;
  // The first difference is the greater one by magnitude, unless both are one unit.
  const double d = (l.hi - r.hi) + (l.lo - r.lo);
  return d != 0 ? signOf(d) : kUnknown;
}

// The later stages are kept out of line: inlined, they would slow down the code around the calls.
__attribute__((noinline)) int orient3dCarefully(const Vec3& a, const Vec3& b, const Vec3& c,
                                                const Vec3& d, const Vec3& extent, double det) {
  // 16 bits: a sum of 6 products of three differences stays below 2^53 units, hence has no error.
  double m = greatest(extent), magic = magicFor(m, 16);
  if (areMultiples(a, d, magic) && areMultiples(b, d, magic) && areMultiples(c, d, magic) &&
      m > 0x1p-200)
    return signOf(det);
  double bound = kOrient3dBound * kPairOverDouble * extent.x * extent.y * extent.z + kTiny;
  double det2 = orient3dIn<InPair>(a, b, c, d).hi;
  if (std::fabs(det2) > bound) return signOf(det2);
  return orient3dIn<InExpansion>(a, b, c, d).sign();
}

__attribute__((noinline)) int insphereCarefully(const Vec3& a, const Vec3& b, const Vec3& c,
                                                const Vec3& d, const Vec3& e, const Vec3& extent,
                                                double det) {
  // 9 bits: a sum of 72 products of five differences stays below 2^53 units, hence has no error.
  double m = greatest(extent), magic = magicFor(m, 9);
  if (areMultiples(a, e, magic) && areMultiples(b, e, magic) && areMultiples(c, e, magic) &&
      areMultiples(d, e, magic) && m > 0x1p-190)
    return signOf(det);
  double bound = kInsphereBound * kPairOverDouble * extent.x * extent.y * extent.z * m * m + kTiny;
  double det2 = insphereIn<InPair>(a, b, c, d, e).hi;
  if (std::fabs(det2) > bound) return signOf(det2);
  return insphereIn<InExpansion>(a, b, c, d, e).sign();
}

}  // namespace

int scaleToUnit(ArrayView<const Vec3> points, std::vector<Vec3>& scaled) {
  double m = 0;
  for (const Vec3& p : points)
    m = max2(m, max2(max2(std::fabs(p.x), std::fabs(p.y)), std::fabs(p.z)));
  int exponent = 0;
  if (m > 0) std::frexp(m, &exponent);
  auto scale = [&](double x) {
    double s = std::ldexp(x, -exponent);
    return std::fabs(s) < 0x1p-200 ? 0.0 : s;
  };
  scaled.resize(points.size());
  for (size_t i = 0; i < points.size(); ++i)
    scaled[i] = {scale(points[i].x), scale(points[i].y), scale(points[i].z)};
  return exponent;
}

int orient2d(double ax, double ay, double bx, double by, double cx, double cy) {
  double det = orient2dIn<InDouble>(ax, ay, bx, by, cx, cy);
  double mx = max2(std::fabs(ax - cx), std::fabs(bx - cx));
  double my = max2(std::fabs(ay - cy), std::fabs(by - cy));
  double bound = kOrient2dBound * mx * my + kTiny;
  if (std::fabs(det) > bound) return signOf(det);
  const int sign = signOfMinor2(twoDiff(ax, cx), twoDiff(ay, cy), twoDiff(bx, cx), twoDiff(by, cy));
  if (sign != kUnknown) return sign;
  return orient2dIn<InExpansion>(ax, ay, bx, by, cx, cy).sign();
}

int turn2d(double ax, double ay, double bx, double by, double cx, double cy, double dx, double dy) {
  double det = turn2dIn<InDouble>(ax, ay, bx, by, cx, cy, dx, dy);
  double mx = max2(std::fabs(bx - ax), std::fabs(dx - cx));
  double my = max2(std::fabs(by - ay), std::fabs(dy - cy));
  double bound = kOrient2dBound * mx * my + kTiny;
  if (std::fabs(det) > bound) return signOf(det);
  const int sign = signOfMinor2(twoDiff(bx, ax), twoDiff(by, ay), twoDiff(dx, cx), twoDiff(dy, cy));
  if (sign != kUnknown) return sign;
  return turn2dIn<InExpansion>(ax, ay, bx, by, cx, cy, dx, dy).sign();
}

int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  double det = orient3dIn<InDouble>(a, b, c, d);
  Vec3 extent{0, 0, 0};
  widen(extent, a, d), widen(extent, b, d), widen(extent, c, d);
  double bound = kOrient3dBound * extent.x * extent.y * extent.z + kTiny;
  if (std::fabs(det) > bound) return signOf(det);
  return orient3dCarefully(a, b, c, d, extent, det);
}

bool collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
  return orient2d(a.x, a.y, b.x, b.y, c.x, c.y) == 0 &&
         orient2d(a.y, a.z, b.y, b.z, c.y, c.z) == 0 && orient2d(a.z, a.x, b.z, b.x, c.z, c.x) == 0;
}

int incircle(double ax, double ay, double bx, double by, double cx, double cy, double dx,
             double dy) {
  double det = incircleIn<InDouble>(ax, ay, bx, by, cx, cy, dx, dy);
  double mx = max2(max2(std::fabs(ax - dx), std::fabs(bx - dx)), std::fabs(cx - dx));
  double my = max2(max2(std::fabs(ay - dy), std::fabs(by - dy)), std::fabs(cy - dy));
  double m = max2(mx, my), bound = kIncircleBound * mx * my * m * m;
  if (std::fabs(det) > bound + kTiny) return signOf(det);
  // 12 bits: a sum of 12 products of four differences stays below 2^53 units, hence has no error.
  double magic = magicFor(m, 12);
  if (isMultiple(ax, dx, magic) && isMultiple(ay, dy, magic) && isMultiple(bx, dx, magic) &&
      isMultiple(by, dy, magic) && isMultiple(cx, dx, magic) && isMultiple(cy, dy, magic) &&
      m > 0x1p-200)
    return signOf(det);
  double det2 = incircleIn<InPair>(ax, ay, bx, by, cx, cy, dx, dy).hi;
  if (std::fabs(det2) > kPairOverDouble * bound + kTiny) return signOf(det2);
  return incircleIn<InExpansion>(ax, ay, bx, by, cx, cy, dx, dy).sign();
}

int insphere(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e) {
  double det = insphereIn<InDouble>(a, b, c, d, e);
  Vec3 extent{0, 0, 0};
  widen(extent, a, e), widen(extent, b, e), widen(extent, c, e), widen(extent, d, e);
  double m = greatest(extent);
  double bound = kInsphereBound * extent.x * extent.y * extent.z * m * m + kTiny;
  if (std::fabs(det) > bound) return signOf(det);
  return insphereCarefully(a, b, c, d, e, extent, det);
}

int insphereByRank(const Vec3* const p[5], const uint32_t rank[5]) {
  int s = insphere(*p[0], *p[1], *p[2], *p[3], *p[4]);
  uint32_t below = 0xFFFFFFFFu;
  while (s == 0) {
    int top = -1;
    for (int i = 0; i < 5; ++i)
      if (rank[i] < below && (top < 0 || rank[i] > rank[top])) top = i;
    SF_ASSERT(top >= 0);
    // Raising the tested point takes it out. Raising a corner raises the hyperplane on that
    // corner's side of the other three; the tested point is then below it or above it.
    if (top == 4 || top < 0) return -1;
    const Vec3* q[4] = {p[0], p[1], p[2], p[3]};
    q[top] = p[4];
    s = orient3d(*q[0], *q[1], *q[2], *q[3]);
    below = rank[top];
  }
  return s;
}

int incircleByRank(const double x[4], const double y[4], const uint32_t rank[4]) {
  int s = incircle(x[0], y[0], x[1], y[1], x[2], y[2], x[3], y[3]);
  uint32_t below = 0xFFFFFFFFu;
  while (s == 0) {
    int top = -1;
    for (int i = 0; i < 4; ++i)
      if (rank[i] < below && (top < 0 || rank[i] > rank[top])) top = i;
    SF_ASSERT(top >= 0);
    if (top == 3 || top < 0) return -1;
    int q[3] = {0, 1, 2};
    q[top] = 3;
    s = orient2d(x[q[0]], y[q[0]], x[q[1]], y[q[1]], x[q[2]], y[q[2]]);
    below = rank[top];
  }
  return s;
}

}  // namespace sf
