// Curves against circles and polynomials.
#include "surface/nurbs_curve.h"

#include <algorithm>
#include <cmath>
#include <random>

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

TEST_CASE("NurbsCurve: the derivative from the left is the limit of those before a break") {
  const uint32_t seed = 93;
  MESSAGE("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-1, 1), weights(0.2, 5);
  for (int round = 0; round < 50; ++round) {
    Curve c{3, 3, {0, 0, 0, 0, 0.25, 0.25, 0.25, 2, 2, 3, 3, 3, 3}, {}, {}};
    for (int i = 0; i < 9; ++i) {
      for (int axis = 0; axis < 3; ++axis) c.poles.push_back(any(random));
      if (round % 2) c.weights.push_back(weights(random));
    }
    const NurbsCurve curve = c.made();
    const double breaks[] = {0.25, 2, 3};
    for (uint32_t span = 0; span < 3; ++span) {
      const double h = 1e-7;
      const Vec3 near = curve.at(breaks[span] - h).first;
      const Vec3 second = curve.at(breaks[span] - h).second;
      CHECK(length(curve.derivativeAtEnd(span) - (near + h * second)) < 1e-8 * (1 + length(near)));
    }
    CHECK(length(curve.derivativeAtEnd(2) - curve.at(3).first) <
          1e-12 * (1 + length(curve.at(3).first)));
  }
}

TEST_CASE("liesWithin: boxes around curves, and ones a little too small, against many points") {
  const uint32_t seed = 94;
  MESSAGE("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-1, 1), weights(0.2, 5), part(0, 4);
  for (int round = 0; round < 80; ++round) {
    Curve c{3, 2, {0, 0, 0, 0, 1, 2, 2, 2, 4, 4, 4, 4}, {}, {}};
    for (int i = 0; i < 8; ++i) {
      c.poles.insert(c.poles.end(), {any(random), any(random)});
      if (round % 2) c.weights.push_back(weights(random));
    }
    const NurbsCurve curve = c.made();
    double from = part(random), to = part(random);
    if (to < from) std::swap(from, to);
    if (round % 4 == 0) from = 0, to = 4;
    Vec3 low = curve.placeAt(from), high = low;
    for (int i = 1; i <= 10000; ++i) {
      // The corner at 2 among them.
      const double t = i < 10000 ? from + (to - from) * i / 9999 : std::clamp(2.0, from, to);
      const Vec3 p = curve.placeAt(t);
      low = lowest(low, p), high = highest(high, p);
    }
    // Between two points the curve bulges by less.
    const Vec3 flat{0, 0, 1}, slack{2e-5, 2e-5, 0};
    CHECK(liesWithin(curve, from, to, low - slack - flat, high + slack + flat));
    for (const Vec3 less : {Vec3{1e-4, 0, 0}, Vec3{0, 1e-4, 0}}) {
      CHECK(!liesWithin(curve, from, to, low + less - flat, high + flat));
      CHECK(!liesWithin(curve, from, to, low - flat, high - less + flat));
    }
  }
}
