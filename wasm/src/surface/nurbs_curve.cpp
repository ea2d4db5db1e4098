#include "surface/nurbs_curve.h"

#include <cmath>

namespace sf {
namespace {

/// A turn of less than this, in radians, is none.
constexpr double kCorner = 1e-6;

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

Vec3 NurbsCurve::placeAt(double t) const {
  const uint32_t span = t_.spanAt(t), degree = t_.degree();
  const double a = t_.breaks()[span], x = (t - a) / (t_.breaks()[span + 1] - a);
  const double* point = points_.data() + size_t(span) * (degree + 1) * 4;
  Bernstein b;
  b.firstAt(degree, x);
  double sums[4] = {};
  for (uint32_t j = 0; j <= degree; ++j, point += 4)
    for (int k = 0; k < 4; ++k) sums[k] += b.value[j] * point[k];
  const double s = 1 / sums[3];
  return {s * sums[0], s * sums[1], s * sums[2]};
}

void appendCorners(const NurbsCurve& curve, double from, double to, std::vector<double>& corners) {
  const ArrayView<const double> breaks = curve.spans().breaks();
  for (size_t s = 1; s + 1 < breaks.size(); ++s) {
    const double t = breaks[s];
    if (!(from < t && t < to)) continue;
    // The tangent at the end of a span is that of the span itself, a little before.
    const Vec3 before = curve.at(t - 1e-9 * (t - breaks[s - 1])).first;
    if (angleBetween(before, curve.at(t).first) > kCorner) corners.push_back(t);
  }
}

}  // namespace sf
