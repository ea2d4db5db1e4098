// Trimming curves: their places, and where they have corners.
#include "surface/trim_curve.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <doctest/doctest.h>

#include "base/vec.h"

using namespace sf;

namespace {

/// A curve of the plane from its own arrays.
TrimCurve made(uint32_t degree, const std::vector<double>& knots, const std::vector<Point2>& poles,
               const std::vector<double>& weights = {}) {
  std::vector<double> at;
  for (const Point2 p : poles) at.push_back(p.x), at.push_back(p.y);
  return TrimCurve(NurbsCurveView{{degree, knots}, 2, at, weights});
}

/// The way through some points, straight from each to the next.
TrimCurve polyline(const std::vector<double>& breaks, const std::vector<Point2>& points) {
  std::vector<double> knots = breaks;
  knots.insert(knots.begin(), breaks.front()), knots.push_back(breaks.back());
  return made(1, knots, points);
}

std::vector<double> cornersOf(const TrimCurve& curve, double from, double to) {
  std::vector<double> corners;
  curve.appendBreaks(from, to, corners);
  return corners;
}

}  // namespace

TEST_CASE("TrimCurve: one that is not found yet, and one that moves") {
  TrimCurve none, way({1, 2}, {3, -4}, 5, 7);
  CHECK(!none.isFound());
  none = std::move(way);
  REQUIRE(none.isFound());
  CHECK(none.at(5) == Point2{1, 2});
  CHECK(none.at(6) == Point2{2, -1});
  CHECK(none.at(7) == Point2{3, -4});
  CHECK(cornersOf(none, 5, 7).empty());
}

TEST_CASE("TrimCurve: parameters beyond its ends count as these") {
  // Of high degree and with a short span, which would lead far astray.
  std::vector<double> knots(6, 0.0);
  knots.insert(knots.end(), 5, 1e-4);
  knots.insert(knots.end(), 6, 1.0);
  std::vector<Point2> poles;
  for (int i = 0; i < 11; ++i) poles.push_back({i / 10.0, i % 2 ? 1.0 : 0.0});
  const TrimCurve curve = made(5, knots, poles);
  CHECK(curve.at(-1) == curve.at(0));
  CHECK(curve.at(1e9) == curve.at(1));
}

TEST_CASE("TrimCurve: cubic pieces against de Casteljau, and their corners") {
  const uint32_t seed = 91;
  MESSAGE("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-1, 1), steps(0.01, 1);
  for (int round = 0; round < 50; ++round) {
    const size_t pieces = 1 + random() % 8;
    std::vector<double> breaks{any(random)}, turned;
    std::vector<Point2> points{{any(random), any(random)}};
    for (size_t s = 0; s < pieces; ++s) {
      breaks.push_back(breaks.back() + steps(random));
      // Every other joint is smooth, if the pieces' speeds differ or not.
      const size_t n = points.size();
      const bool isSmooth = s > 0 && random() % 2 == 0;
      const double x = steps(random);
      points.push_back(isSmooth ? Point2{(1 + x) * points[n - 1].x - x * points[n - 2].x,
                                         (1 + x) * points[n - 1].y - x * points[n - 2].y}
                                : Point2{any(random), any(random)});
      points.push_back({any(random), any(random)});
      points.push_back({any(random), any(random)});
      if (s > 0 && !isSmooth) turned.push_back(breaks[s]);
    }
    const TrimCurve curve(breaks, points);
    for (size_t s = 0; s < pieces; ++s)
      for (int i = 0; i < 8; ++i) {
        const double x = i / 8.0;
        Point2 p[4];
        std::copy_n(&points[3 * s], 4, p);
        for (int r = 3; r > 0; --r)
          for (int k = 0; k < r; ++k)
            p[k] = {p[k].x + x * (p[k + 1].x - p[k].x), p[k].y + x * (p[k + 1].y - p[k].y)};
        const Point2 at = curve.at(breaks[s] + x * (breaks[s + 1] - breaks[s]));
        CHECK(std::hypot(at.x - p[0].x, at.y - p[0].y) < 1e-13);
      }
    CHECK(cornersOf(curve, breaks.front(), breaks.back()) == turned);
  }
}

TEST_CASE("TrimCurve: a polyline has a corner where it turns, and none elsewhere") {
  const uint32_t seed = 92;
  MESSAGE("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> turns(-2, 2), steps(0.1, 1);
  // Near the origin, and in a short domain far away from it.
  for (const double origin : {0.0, 1e5})
    for (const double scale : {1.0, 1e-4}) {
      std::vector<double> breaks{origin};
      std::vector<Point2> points{{origin, -origin}};
      std::vector<double> turned;
      double direction = 0.3;
      for (int i = 0; i < 100; ++i) {
        if (i > 0 && random() % 3 > 0) {
          direction += turns(random);
          turned.push_back(breaks.back());
        }
        const double step = scale * steps(random);
        breaks.push_back(breaks.back() + step);
        points.push_back({points.back().x + step * std::cos(direction),
                          points.back().y + step * std::sin(direction)});
      }
      const TrimCurve curve = polyline(breaks, points);
      CHECK(cornersOf(curve, breaks.front(), breaks.back()) == turned);
      // Strictly inside of a part.
      const double from = turned[3], to = turned[turned.size() - 4];
      CHECK(cornersOf(curve, from, to) ==
            std::vector<double>(turned.begin() + 4, turned.end() - 4));
    }
}

TEST_CASE("TrimCurve: knots of full multiplicity are no corners if the curve does not turn there") {
  // A cubic, cut at a third.
  const Point2 whole[4] = {{0, 0}, {1, 2}, {2, -1}, {4, 1}};
  std::vector<Point2> poles, right(whole, whole + 4);
  for (int r = 0; r < 4; ++r) {
    poles.push_back(right[0]);
    for (int i = 0; i < 3 - r; ++i)
      right[i] = {right[i].x + (right[i + 1].x - right[i].x) / 3,
                  right[i].y + (right[i + 1].y - right[i].y) / 3};
  }
  poles.insert(poles.end(), right.begin() + 1, right.end());
  const std::vector<double> knots{0, 0, 0, 0, 1, 1, 1, 3, 3, 3, 3};
  CHECK(cornersOf(made(3, knots, poles), 0, 3).empty());
  // Weights leave the directions at joints as they are.
  CHECK(cornersOf(made(3, knots, poles, {1, 3, 0.1, 7, 2, 5, 1}), 0, 3).empty());
  poles[4].y += 1e-3;
  CHECK(cornersOf(made(3, knots, poles), 0, 3) == std::vector<double>{1});
}

TEST_CASE("TrimCurve: corners where the speed is zero, or the curve rests") {
  // Two straight pieces of degree 3 that stop at their joint.
  const std::vector<double> knots{0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2};
  const auto joined = [&](Point2 beyond) {
    return made(3, knots, {{0, 0}, {0.5, 0}, {1, 0}, {1, 0}, {1, 0}, {beyond.x, beyond.y}, beyond});
  };
  CHECK(cornersOf(joined({1, 1}), 0, 2) == std::vector<double>{1});
  CHECK(cornersOf(joined({0, 0}), 0, 2) == std::vector<double>{1});
  CHECK(cornersOf(joined({2, 0}), 0, 2).empty());
  // A span that is one point: the way on from it is compared with the way to it.
  const std::vector<double> breaks{0, 1, 2, 3};
  CHECK(cornersOf(polyline(breaks, {{0, 0}, {1, 0}, {1, 0}, {1, 1}}), 0, 3) ==
        std::vector<double>{2});
  CHECK(cornersOf(polyline(breaks, {{0, 0}, {1, 0}, {1, 0}, {2, 0}}), 0, 3).empty());
}
