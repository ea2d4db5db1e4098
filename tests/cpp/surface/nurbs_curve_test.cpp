// Curves against circles and polynomials, and their samples against the tolerance, densely.
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

std::vector<double> samplesOf(const NurbsCurve& curve, double tolerance, double angle = 10) {
  CurveSampling sampling;
  sampling.tolerance = tolerance, sampling.angle = angle;
  std::vector<double> ts;
  sampleCurve(curve, sampling, ts);
  return ts;
}

/// The largest distance of the curve from a chord, looked at in many places.
double deviation(const NurbsCurve& curve, const std::vector<double>& ts) {
  double most = 0;
  for (size_t i = 0; i + 1 < ts.size(); ++i) {
    const Vec3 a = curve.at(ts[i]).at, b = curve.at(ts[i + 1]).at, d = b - a;
    for (int k = 1; k < 40; ++k) {
      const Vec3 p = curve.at(ts[i] + k / 40.0 * (ts[i + 1] - ts[i])).at;
      const double x = std::clamp(dot(p - a, d) / dot(d, d), 0.0, 1.0);
      most = std::max(most, distance(p, a + x * d));
    }
  }
  return most;
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

TEST_CASE(
    "sampleCurve: within the tolerance, with few samples, those of a coarser one among them") {
  const NurbsCurve curve = circle(2).made();
  std::vector<double> coarse;
  for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-4, 1e-6}) {
    const std::vector<double> ts = samplesOf(curve, tolerance);
    CHECK(std::is_sorted(ts.begin(), ts.end()));
    CHECK(ts.front() == 0);
    CHECK(ts.back() == 4);
    CHECK(deviation(curve, ts) <= tolerance * (1 + 1e-6));
    // Chords of a circle: as many as there must be, but for halving.
    const double least = kPi / std::acos(1 - tolerance);
    CHECK(ts.size() - 1 <= std::max(4.0, 2.2 * least));
    CHECK(std::includes(ts.begin(), ts.end(), coarse.begin(), coarse.end()));
    coarse = ts;
  }
}

TEST_CASE("sampleCurve: noisy curves keep to the tolerance, the angle and the length") {
  for (uint32_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-1, 1);
    const uint32_t degree = 1 + random() % 5, count = degree + 1 + random() % 12;
    Curve c{degree, 3, {}, {}, {}};
    for (uint32_t i = 0; i < count + degree + 1; ++i) c.knots.push_back(i);
    for (uint32_t i = 0; i < 3 * count; ++i) c.poles.push_back(any(random));
    const NurbsCurve curve = c.made();
    CurveSampling sampling;
    sampling.tolerance = 1e-3, sampling.angle = 0.3, sampling.longest = 0.1;
    std::vector<double> ts;
    sampleCurve(curve, sampling, ts);
    // Tests at a few places say nothing for certain, but seldom too little.
    CHECK(deviation(curve, ts) <= 1.5e-3);
    for (size_t i = 0; i + 1 < ts.size(); ++i)
      CHECK(distance(curve.at(ts[i]).at, curve.at(ts[i + 1]).at) <= 0.1 + 1e-12);
    for (const double b : curve.spans().breaks())
      CHECK(std::binary_search(ts.begin(), ts.end(), b));
  }
}

TEST_CASE("sampleCurve: a curve that stands still ends") {
  Curve c{2, 2, {0, 0, 0, 1, 1, 1}, std::vector<double>(6, 0.0), {}};
  CHECK(samplesOf(c.made(), 1e-3) == std::vector<double>{0, 1});
  // A cusp: the tangent turns about at a place that no break tells of.
  Curve cusp{3, 2, {0, 0, 0, 0, 1, 1, 1, 1}, {0, 0, 1, 1, 0, 1, 1, 0}, {}};
  CHECK(samplesOf(cusp.made(), 1e-3, 0.1).size() < 500);
}
