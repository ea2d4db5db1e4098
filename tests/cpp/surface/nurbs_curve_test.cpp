// Curves against circles and polynomials.
#include "surface/nurbs_curve.h"

#include <cmath>

#include <doctest/doctest.h>

using namespace sf;

namespace {

/// A curve with its own arrays.
struct Curve {
  uint32_t degree, dimension;
  std::vector<double> knots, poles, weights;
  NurbsCurve made() const { return NurbsCurve({{degree, knots}, dimension, poles, weights}); }
};

Curve circle(uint32_t dimension) {
  const double h = std::sqrt(0.5);
  const double around[9][3] = {{1, 0, 1},   {1, 1, h},  {0, 1, 1},  {-1, 1, h}, {-1, 0, 1},
                               {-1, -1, h}, {0, -1, 1}, {1, -1, h}, {1, 0, 1}};
  Curve c{2, dimension, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}, {}, {}};
  for (const auto& p : around) {
    c.poles.insert(c.poles.end(), {p[0], p[1]});
    if (dimension == 3) c.poles.push_back(7);
    c.weights.push_back(p[2]);
  }
  return c;
}

}  // namespace

TEST_CASE("NurbsCurve: a circle is one, in the plane and in space, and turns evenly") {
  for (const uint32_t dimension : {2u, 3u}) {
    const NurbsCurve curve = circle(dimension).made();
    for (double t = 0; t <= 4; t += 0.0625) {
      const CurvePoint p = curve.at(t);
      CHECK(std::hypot(p.at.x, p.at.y) == doctest::Approx(1).epsilon(1e-14));
      CHECK(p.at.z == doctest::Approx(dimension == 3 ? 7 : 0));
      CHECK(std::fabs(dot(p.first, Vec3{p.at.x, p.at.y, 0})) < 1e-13);
      // The curvature of a unit circle.
      const double speed = length(p.first);
      CHECK(length(cross(p.first, p.second)) / (speed * speed * speed) == doctest::Approx(1));
    }
  }
}

TEST_CASE("NurbsCurve: a polynomial on any knots") {
  // The blossom of t³ at three knots gives the poles of the curve (t, t², t³).
  const std::vector<double> knots{-3, -1, 0, 0.5, 0.5, 2, 4, 5, 5, 9};
  Curve c{3, 3, knots, {}, {}};
  for (size_t i = 0; i + 4 < knots.size(); ++i) {
    const double a = knots[i + 1], b = knots[i + 2], d = knots[i + 3];
    c.poles.insert(c.poles.end(), {(a + b + d) / 3, (a * b + a * d + b * d) / 3, a * b * d});
  }
  const NurbsCurve curve = c.made();
  for (double t = 0.5; t <= 4; t += 0.125) {
    const CurvePoint p = curve.at(t);
    CHECK(length(p.at - Vec3{t, t * t, t * t * t}) < 1e-12);
    CHECK(length(p.first - Vec3{1, 2 * t, 3 * t * t}) < 1e-11);
    CHECK(length(p.second - Vec3{0, 2, 6 * t}) < 1e-10);
  }
}
