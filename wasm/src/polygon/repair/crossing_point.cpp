#include "polygon/repair/crossing_point.h"

#include <cmath>

#include "base/expansion.h"

namespace sf {
namespace {

// As in base/predicates: exact numbers are of coordinates times this, so that nothing underflows.
constexpr double kExactScale = 0x1p150;
// The relative error of CrossingPoint::at, rounded up.
constexpr double kPlaceError = 0x1p-50;
// More than all underflows together, less than anything that matters.
constexpr double kTiny = 1e-290;

Expansion number(double x) { return Expansion(Pair{kExactScale * x, 0}); }
Expansion difference(double a, double b) {
  return Expansion(twoDiff(kExactScale * a, kExactScale * b));
}

/// The crossing as a quotient: (x / w, y / w), w > 0; w of degree 2 in the coordinates, x and y of
/// degree 3.
struct Quotient {
  Expansion x, y, w;

  Quotient(const Line& s, const Line& t) {
    const Expansion sx = difference(s.high.x, s.low.x), sy = difference(s.high.y, s.low.y);
    const Expansion tx = difference(t.high.x, t.low.x), ty = difference(t.high.y, t.low.y);
    w = sx * ty - sy * tx;
    // s.low + share / w (s.high - s.low)
    Expansion share = difference(t.low.x, s.low.x) * ty - difference(t.low.y, s.low.y) * tx;
    if (w.sign() < 0) w = -w, share = -share;
    x = number(s.low.x) * w + share * sx;
    y = number(s.low.y) * w + share * sy;
  }
  explicit Quotient(const CrossingPoint& p) : Quotient(p.s, p.t) {}
};

bool isSame(Point2 a, Point2 b, Point2 c, Point2 d) { return a == c && b == d; }
bool isSame(const Line& s, const Line& t) { return isSame(s.low, s.high, t.low, t.high); }

double clamp(double x, double low, double high) { return x < low ? low : x > high ? high : x; }

/// The sign of a - b if the errors of both leave no doubt, else 0.
int compareRounded(double a, double b) {
  const double doubt = 2 * kPlaceError * (std::fabs(a) + std::fabs(b)) + kTiny;
  return a - b > doubt ? 1 : b - a > doubt ? -1 : 0;
}

}  // namespace

CrossingPoint crossingPoint(const Line& s, const Line& t) {
  const Quotient q(s, t);
  // Two roundings to a double and one of the division, and the scale of x and y beyond that of w.
  const double w = q.w.value();
  const double x = q.x.value() / w / kExactScale, y = q.y.value() / w / kExactScale;
  // The point lies in the boxes of both; keep it there, so that pieces of edges stay monotone.
  const double lowY = std::fmax(s.low.y, t.low.y), highY = std::fmin(s.high.y, t.high.y);
  const double lowX = std::fmax(std::fmin(s.low.x, s.high.x), std::fmin(t.low.x, t.high.x));
  const double highX = std::fmin(std::fmax(s.low.x, s.high.x), std::fmax(t.low.x, t.high.x));
  return {s, t, {clamp(x, lowX, highX), clamp(y, lowY, highY)}};
}

int compare(const CrossingPoint& p, Point2 q) {
  if (const int sign = compareRounded(p.at.y, q.y)) return sign;
  const Quotient exact(p);
  if (const int sign = (exact.y - number(q.y) * exact.w).sign()) return sign;
  if (const int sign = compareRounded(p.at.x, q.x)) return sign;
  return (exact.x - number(q.x) * exact.w).sign();
}

int compare(const CrossingPoint& p, const CrossingPoint& q) {
  if (const int sign = compareRounded(p.at.y, q.at.y)) return sign;
  if (isSame(p.s, q.s) && isSame(p.t, q.t)) return 0;
  const Quotient a(p), b(q);
  if (const int sign = (a.y * b.w - b.y * a.w).sign()) return sign;
  if (const int sign = compareRounded(p.at.x, q.at.x)) return sign;
  return (a.x * b.w - b.x * a.w).sign();
}

int sideOf(const Line& segment, const CrossingPoint& p) {
  if (isSame(segment, p.s) || isSame(segment, p.t)) return 0;
  const Point2 a = segment.low, b = segment.high;
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double cross = dx * (p.at.y - a.y) - dy * (p.at.x - a.x);
  const double doubt = 4 * kPlaceError *
                           (std::fabs(dx) * (std::fabs(p.at.y) + std::fabs(a.y)) +
                            std::fabs(dy) * (std::fabs(p.at.x) + std::fabs(a.x))) +
                       kTiny;
  if (std::fabs(cross) > doubt) return cross > 0 ? 1 : -1;
  const Quotient q(p);
  return (difference(b.x, a.x) * (q.y - number(a.y) * q.w) -
          difference(b.y, a.y) * (q.x - number(a.x) * q.w))
      .sign();
}

int areaSign(ArrayView<const Point2> ring) {
  if (ring.empty()) return 0;
  const Point2 o = ring[0];
  double sum = 0, size = 0;
  for (size_t i = 0; i < ring.size(); ++i) {
    const Point2 a = ring[i], b = ring[i + 1 < ring.size() ? i + 1 : 0];
    const double p = (a.x - o.x) * (b.y - o.y), q = (a.y - o.y) * (b.x - o.x);
    sum += p - q;
    size += std::fabs(p) + std::fabs(q);
  }
  // Each term errs by 4 units of its own, each sum by one of at most `size`.
  if (std::fabs(sum) > 0x1p-52 * double(ring.size() + 5) * size + double(ring.size()) * kTiny)
    return sum > 0 ? 1 : -1;
  Expansion exact;
  for (size_t i = 0; i < ring.size(); ++i) {
    const Point2 a = ring[i], b = ring[i + 1 < ring.size() ? i + 1 : 0];
    exact = exact + (number(a.x) * number(b.y) - number(a.y) * number(b.x));
  }
  return exact.sign();
}

}  // namespace sf
