#include "surface/nurbs_curve.h"

#include <cmath>

namespace sf {
namespace {

constexpr uint32_t kMostHalvings = 30;

/// An interval that may have to be halved, with what is known at its ends.
struct Interval {
  double a, b;
  CurvePoint from, to;
  uint32_t halvings;
};

double distanceFromChord(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 d = b - a;
  const double square = dot(d, d);
  double x = square > 0 ? dot(p - a, d) / square : 0;
  x = x < 0 ? 0 : x > 1 ? 1 : x;
  return distance(p, a + x * d);
}

}  // namespace

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
  const double a = t_.breaks()[span], width = t_.breaks()[span + 1] - a;
  Bernstein b;
  b.at(size - 1, (t - a) / width);
  double sums[3][4] = {};
  const double* point = points_.data() + size_t(span) * size * 4;
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

void sampleCurve(const NurbsCurve& curve, const CurveSampling& sampling,
                 std::vector<double>& parameters) {
  const auto isStraight = [&](const Interval& i) {
    if (distance(i.from.at, i.to.at) > sampling.longest) return false;
    Vec3 before = i.from.first;
    double turn = 0;
    for (const double x : {0.25, 0.5, 0.75}) {
      const CurvePoint p = curve.at(i.a + x * (i.b - i.a));
      if (distanceFromChord(p.at, i.from.at, i.to.at) > sampling.tolerance) return false;
      turn += angleBetween(before, p.first);
      before = p.first;
    }
    return turn + angleBetween(before, i.to.first) <= sampling.angle;
  };
  const ArrayView<const double> breaks = curve.spans().breaks();
  std::vector<Interval> open;
  for (uint32_t s = 0; s < curve.spans().count(); ++s) {
    // The tangent at the end of a span is that of the span itself, a little before.
    const double a = breaks[s], b = breaks[s + 1];
    const auto at = [&](double t) {
      CurvePoint p = curve.at(t);
      if (t == b) p.first = curve.at(b - 1e-9 * (b - a)).first;
      return p;
    };
    open.push_back({a, b, at(a), at(b), 0});
    while (!open.empty()) {
      const Interval i = open.back();
      open.pop_back();
      const double middle = 0.5 * (i.a + i.b);
      const bool isSmall = i.halvings == kMostHalvings || middle <= i.a || middle >= i.b;
      if (isSmall || isStraight(i)) {
        parameters.push_back(i.a);
        continue;
      }
      const CurvePoint p = curve.at(middle);
      // The first half is the next to be looked at.
      open.push_back({middle, i.b, p, i.to, i.halvings + 1});
      open.push_back({i.a, middle, i.from, p, i.halvings + 1});
    }
  }
  parameters.push_back(breaks[breaks.size() - 1]);
}

}  // namespace sf
