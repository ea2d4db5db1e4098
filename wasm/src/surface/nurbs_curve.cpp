#include "surface/nurbs_curve.h"

#include <algorithm>
#include <cmath>

namespace sf {
namespace {

/// A turn of less than this, in radians, is none.
constexpr double kCorner = 1e-6;
/// Bézier points nearer to the end of their span than this share of the farthest one tell no direction.
constexpr double kTold = 1e-10;
/// Rounding of a coordinate, in its size.
constexpr double kRounding = 1e-15;
/// What the hull of a curve has outside of a box, in the box's size, is rounding.
constexpr double kOutside = 1e-10;
/// How often a curve is halved to see whether it, or its hull alone, is outside.
constexpr int kMostHalvings = 24;

Vec3 placeOf(const double* homogeneous) {
  const double s = 1 / homogeneous[3];
  return {s * homogeneous[0], s * homogeneous[1], s * homogeneous[2]};
}

double localIn(const BezierSpans& spans, uint32_t span, double t) {
  const double a = spans.breaks()[span];
  return std::clamp((t - a) / (spans.breaks()[span + 1] - a), 0.0, 1.0);
}

/// Bézier points of a span, or of a part of one.
struct Piece {
  uint32_t degree;
  double points[(kMostDegree + 1) * 4];

  const double* last() const { return points + degree * 4; }
};

/// Cuts a piece in two.
void split(const Piece& whole, double x, Piece& first, Piece& second) {
  const uint32_t degree = whole.degree;
  first.degree = degree, second = whole;
  for (uint32_t r = 0; r <= degree; ++r) {
    std::copy(second.points, second.points + 4, first.points + r * 4);
    for (uint32_t i = 0; i < (degree - r) * 4; ++i)
      second.points[i] += x * (second.points[i + 4] - second.points[i]);
  }
}

/// Whether a homogeneous point is in a box.
bool isIn(const double* p, const Vec3& low, const Vec3& high) {
  const double w = p[3];
  return p[0] >= w * low.x && p[1] >= w * low.y && p[2] >= w * low.z && p[0] <= w * high.x &&
         p[1] <= w * high.y && p[2] <= w * high.z;
}

bool liesWithin(const Piece& piece, const Vec3& low, const Vec3& high, int halvings) {
  if (!isIn(piece.points, low, high) || !isIn(piece.last(), low, high)) return false;
  const Vec3 loose = kOutside * (high - low);
  bool isAllIn = true;
  for (uint32_t i = 1; i < piece.degree && isAllIn; ++i)
    isAllIn = isIn(piece.points + i * 4, low - loose, high + loose);
  if (isAllIn || halvings == kMostHalvings) return true;
  Piece first, second;
  split(piece, 0.5, first, second);
  return liesWithin(first, low, high, halvings + 1) && liesWithin(second, low, high, halvings + 1);
}

/// The direction in which a curve leaves the beginning of a span, or arrives at its end; zero if it stays in one place. And how
/// much of its angle may be rounding.
struct Direction {
  Vec3 way;
  double rounding;
};
Direction directionOf(const NurbsCurve& curve, uint32_t span, bool isAtEnd) {
  const uint32_t degree = curve.spans().degree();
  const double* points = curve.bezierPoints(span);
  const auto at = [&](uint32_t i) { return placeOf(points + 4 * (isAtEnd ? degree - i : i)); };
  const Vec3 end = at(0);
  double farthest = 0;
  for (uint32_t i = 1; i <= degree; ++i) farthest = std::max(farthest, distance(at(i), end));
  for (uint32_t i = 1; i <= degree; ++i) {
    const Vec3 way = isAtEnd ? end - at(i) : at(i) - end;
    const double size = length(way);
    if (size > kTold * farthest) return {way, kRounding * length(end) / size};
  }
  return {{0, 0, 0}, 0};
}

}  // namespace

uint64_t bytesOf(const NurbsCurveView& view) {
  const uint64_t size = view.t.degree + 1;
  return sizeof(NurbsCurve) + 8 * spanCount(view.t) * (size * size + 4 * size + 2);
}

NurbsCurve::NurbsCurve(const NurbsCurveView& view) : t_(view.t) {
  const uint32_t size = t_.degree() + 1;
  points_.assign(size_t(t_.count()) * size * 4, 0);
  double* out = points_.data();
  for (uint32_t s = 0; s < t_.count(); ++s) {
    const ArrayView<const double> factors = t_.factors(s);
    for (uint32_t j = 0; j < size; ++j, out += 4)
      for (uint32_t k = 0; k < size; ++k) {
        const size_t pole = t_.firstPole(s) + k;
        const double w =
            factors[size_t(j) * size + k] * (view.weights.empty() ? 1 : view.weights[pole]);
        for (uint32_t axis = 0; axis < view.dimension; ++axis)
          out[axis] += w * view.poles[view.dimension * pole + axis];
        out[3] += w;
      }
  }
}

CurvePoint NurbsCurve::at(double t) const {
  const uint32_t span = t_.spanAt(t), size = t_.degree() + 1;
  const double width = t_.breaks()[span + 1] - t_.breaks()[span];
  Bernstein b;
  b.at(size - 1, localIn(t_, span, t));
  double sums[3][4] = {};
  const double* point = bezierPoints(span);
  for (uint32_t j = 0; j < size; ++j, point += 4)
    for (int k = 0; k < 4; ++k) {
      sums[0][k] += b.value[j] * point[k];
      sums[1][k] += b.first[j] * point[k] / width;
      sums[2][k] += b.second[j] * point[k] / (width * width);
    }
  const auto part = [&](int i) { return Vec3{sums[i][0], sums[i][1], sums[i][2]}; };
  const double s = 1 / sums[0][3];
  CurvePoint p;
  p.at = s * part(0);
  p.first = s * (part(1) - sums[1][3] * p.at);
  p.second = s * (part(2) - 2 * sums[1][3] * p.first - sums[2][3] * p.at);
  return p;
}

Vec3 NurbsCurve::placeAt(double t) const {
  const uint32_t span = t_.spanAt(t), degree = t_.degree();
  const double* point = bezierPoints(span);
  Bernstein b;
  b.firstAt(degree, localIn(t_, span, t));
  double sums[4] = {};
  for (uint32_t j = 0; j <= degree; ++j, point += 4)
    for (int k = 0; k < 4; ++k) sums[k] += b.value[j] * point[k];
  return placeOf(sums);
}

Vec3 NurbsCurve::derivativeAtEnd(uint32_t span) const {
  const uint32_t degree = t_.degree();
  const double* last = bezierPoints(span) + 4 * degree;
  const double width = t_.breaks()[span + 1] - t_.breaks()[span];
  return (degree / width * (last[-1] / last[3])) * (placeOf(last) - placeOf(last - 4));
}

bool liesWithin(const NurbsCurve& curve, double from, double to, Vec3 low, Vec3 high) {
  const BezierSpans& spans = curve.spans();
  const uint32_t last = spans.spanAt(to);
  for (uint32_t s = spans.spanAt(from); s <= last; ++s) {
    Piece piece, rest;
    piece.degree = spans.degree();
    std::copy(curve.bezierPoints(s), curve.bezierPoints(s) + (piece.degree + 1) * 4, piece.points);
    const double a = localIn(spans, s, from), b = localIn(spans, s, to);
    if (!(a < b)) continue;
    if (b < 1) split(Piece(piece), b, piece, rest);
    if (a > 0) split(Piece(piece), a / b, rest, piece);
    if (!liesWithin(piece, low, high, 0)) return false;
  }
  return true;
}

void appendCorners(const NurbsCurve& curve, double from, double to, std::vector<double>& corners) {
  const BezierSpans& spans = curve.spans();
  Direction before{{0, 0, 0}, 0};
  for (uint32_t s = 0; s < spans.count(); ++s) {
    const Direction after = directionOf(curve, s, false);
    const double t = spans.breaks()[s];
    if (from < t && t < to &&
        angleBetween(before.way, after.way) > kCorner + before.rounding + after.rounding)
      corners.push_back(t);
    // While the curve stays in one place, the way on from there is compared with the way to it.
    if (!(after.way == Vec3{0, 0, 0})) before = directionOf(curve, s, true);
  }
}

}  // namespace sf
