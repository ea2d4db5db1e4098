// Surfaces against de Boor's recursion in long double, which knows nothing of Bézier points.
#include "surface/nurbs_surface.h"

#include <cmath>
#include <random>

#include <doctest/doctest.h>

using namespace sf;

namespace {

struct Point {
  long double x[4] = {0, 0, 0, 0};
};

/// Basis function i of a degree, by its definition.
long double basis(const std::vector<double>& knots, uint32_t i, uint32_t degree, long double t,
                  bool isLast) {
  if (degree == 0)
    return (knots[i] <= t && t < knots[i + 1]) || (isLast && t == knots[i + 1] && knots[i] < t);
  const auto part = [&](uint32_t j, uint32_t k, long double s) {
    const long double width = (long double)knots[k] - knots[j];
    return width > 0 ? s / width : 0;
  };
  return part(i, i + degree, t - knots[i]) * basis(knots, i, degree - 1, t, isLast) +
         part(i + 1, i + degree + 1, knots[i + degree + 1] - t) *
             basis(knots, i + 1, degree - 1, t, isLast);
}

struct Surface {
  uint32_t p, q;
  std::vector<double> u, v, poles, weights;

  NurbsSurfaceView view() const { return {{p, u}, {q, v}, poles, weights}; }
  uint32_t rows() const { return uint32_t(u.size()) - p - 1; }
  uint32_t columns() const { return uint32_t(v.size()) - q - 1; }

  /// The point itself. At the end of the domain only where that is the last knot.
  Vec3 exact(double s, double t) const {
    Point sum;
    for (uint32_t i = 0; i < rows(); ++i)
      for (uint32_t j = 0; j < columns(); ++j) {
        const size_t k = size_t(i) * columns() + j;
        const long double b = basis(u, i, p, s, s == u.back()) * basis(v, j, q, t, t == v.back()) *
                              (weights.empty() ? 1 : weights[k]);
        for (int axis = 0; axis < 3; ++axis) sum.x[axis] += b * poles[3 * k + axis];
        sum.x[3] += b;
      }
    return {double(sum.x[0] / sum.x[3]), double(sum.x[1] / sum.x[3]), double(sum.x[2] / sum.x[3])};
  }
};

using Random = std::mt19937;

double between(Random& random, double a, double b) {
  return std::uniform_real_distribution<double>(a, b)(random);
}

/// Knots with some of them several times, clamped or not.
std::vector<double> knotsOf(Random& random, uint32_t degree, uint32_t poles) {
  std::vector<double> knots;
  double t = between(random, -2, 2);
  const bool isClamped = random() % 2 == 0;
  uint32_t run = 0;
  while (knots.size() < poles + degree + 1) {
    const bool isEnd = knots.size() <= degree || knots.size() >= poles;
    const bool isSame = isClamped && isEnd && knots.size() != poles && !knots.empty();
    const bool repeats = !isEnd && run > 0 && run < degree && random() % 4 == 0;
    if (!isSame && !repeats) t += between(random, 0.1, 2), run = 0;
    knots.push_back(t), ++run;
  }
  return knots;
}

Surface randomSurface(Random& random) {
  Surface s;
  s.p = 1 + random() % 5, s.q = 1 + random() % 5;
  const uint32_t rows = s.p + 1 + random() % 5, columns = s.q + 1 + random() % 5;
  s.u = knotsOf(random, s.p, rows), s.v = knotsOf(random, s.q, columns);
  for (uint32_t i = 0; i < rows * columns; ++i) {
    for (int axis = 0; axis < 3; ++axis) s.poles.push_back(between(random, -1, 1));
    if (random() % 2 == 0 || i > 0) s.weights.push_back(between(random, 0.2, 5));
  }
  if (s.weights.size() != rows * columns) s.weights.clear();
  return s;
}

/// A whole unit sphere: quarters of circles, rational. The sides v = -1 and v = 1 are its poles.
Surface sphere() {
  const double h = std::sqrt(0.5);
  const double circle[9][3] = {{1, 0, 1},   {1, 1, h},  {0, 1, 1},  {-1, 1, h}, {-1, 0, 1},
                               {-1, -1, h}, {0, -1, 1}, {1, -1, h}, {1, 0, 1}};
  const double half[5][3] = {{0, -1, 1}, {1, -1, h}, {1, 0, 1}, {1, 1, h}, {0, 1, 1}};
  Surface s{2, 2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}, {-1, -1, -1, 0, 0, 1, 1, 1}, {}, {}};
  for (const auto& c : circle)
    for (const auto& m : half) {
      s.poles.insert(s.poles.end(), {c[0] * m[0], c[1] * m[0], m[1]});
      s.weights.push_back(c[2] * m[2]);
    }
  return s;
}

double farthest(Vec3 a, Vec3 b) { return length(a - b); }

}  // namespace

TEST_CASE("areKnots: what knots are, and what not") {
  const std::vector<double> good{0, 0, 0, 1, 2, 2, 3, 3, 3};
  CHECK(areKnots({2, good}, 6));
  CHECK_FALSE(areKnots({2, good}, 5));
  CHECK_FALSE(areKnots({0, good}, 8));
  CHECK_FALSE(areKnots({kMostDegree + 1, good}, 2));
  const std::vector<double> falling{0, 0, 0, 2, 1, 3, 3, 3}, thrice{0, 0, 0, 1, 1, 1, 2, 2, 2},
      point{1, 1, 1, 1, 1, 1}, unclamped{0, 1, 2, 3, 4, 5, 6},
      broken{0, 0, 0, std::nan(""), 1, 1, 1};
  CHECK_FALSE(areKnots({2, falling}, 5));
  CHECK_FALSE(areKnots({2, thrice}, 6));
  CHECK_FALSE(areKnots({2, point}, 3));
  CHECK(areKnots({2, unclamped}, 4));
  CHECK_FALSE(areKnots({2, broken}, 4));
}

TEST_CASE("Bernstein: sums and derivatives") {
  for (uint32_t degree = 1; degree <= kMostDegree; ++degree)
    for (const double x : {0.0, 0.3, 0.5, 1.0}) {
      Bernstein b, after, before;
      const double h = 1e-5;
      b.at(degree, x), after.at(degree, x + h), before.at(degree, x - h);
      double sum = 0, first = 0, second = 0;
      for (uint32_t j = 0; j <= degree; ++j) {
        sum += b.value[j], first += b.first[j], second += b.second[j];
        const double scale = double(degree) * degree * degree;
        CHECK(b.first[j] ==
              doctest::Approx((after.value[j] - before.value[j]) / (2 * h)).epsilon(1e-6 * scale));
        CHECK(std::fabs(b.second[j] - (after.first[j] - before.first[j]) / (2 * h)) <
              1e-6 * scale * degree);
      }
      CHECK(sum == doctest::Approx(1).epsilon(1e-14));
      CHECK(std::fabs(first) < 1e-11 * degree);
      CHECK(std::fabs(second) < 1e-10 * degree * degree);
    }
}

TEST_CASE("NurbsSurface: points as by de Boor, derivatives as by differences, grids as points") {
  for (uint32_t seed = 1; seed <= 150; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Surface s = randomSurface(random);
    const NurbsSurfaceView view = s.view();
    REQUIRE(areKnots(view.u, s.rows()));
    REQUIRE(areKnots(view.v, s.columns()));
    const NurbsSurface surface(view);
    std::vector<double> us, vs;
    for (int i = 0; i < 6; ++i) {
      us.push_back(between(random, view.u.from(), view.u.to()));
      vs.push_back(between(random, view.v.from(), view.v.to()));
    }
    us.push_back(view.u.from()), vs.push_back(view.v.from());
    std::vector<double> positions(3 * us.size() * vs.size()), normals(positions.size());
    surface.grid(us, vs, positions.data(), normals.data());
    for (size_t i = 0; i < us.size(); ++i)
      for (size_t k = 0; k < vs.size(); ++k) {
        const SurfacePoint p = surface.at(us[i], vs[k]);
        CHECK(farthest(p.at, s.exact(us[i], vs[k])) < 1e-12);
        const size_t at = 3 * (i * vs.size() + k);
        CHECK(farthest(p.at, {positions[at], positions[at + 1], positions[at + 2]}) < 1e-13);
        const Vec3 n = surface.normalAt(us[i], vs[k]);
        CHECK(length(n) == doctest::Approx(1));
        CHECK(farthest(n, {normals[at], normals[at + 1], normals[at + 2]}) < 1e-9);
      }
    // Where no break is near.
    const auto isInside = [](const BezierSpans& spans, double t, double h) {
      return spans.spanAt(t - h) == spans.spanAt(t + h) && t - h > spans.breaks()[0] &&
             t + h < spans.breaks()[spans.count()];
    };
    const double h = 1e-4;
    for (size_t i = 0; i < 6; ++i) {
      const double u = us[i], v = vs[i];
      if (!isInside(surface.u(), u, h) || !isInside(surface.v(), v, h)) continue;
      const SurfacePoint p = surface.at(u, v), after = surface.at(u + h, v),
                         before = surface.at(u - h, v), above = surface.at(u, v + h),
                         below = surface.at(u, v - h);
      const double size = 1 + length(p.uu) + length(p.uv) + length(p.vv);
      const auto isDifference = [&](Vec3 derivative, Vec3 b, Vec3 a) {
        return farthest(derivative, (0.5 / h) * (b - a)) < 1e-3 * size * size;
      };
      CHECK(isDifference(p.u, after.at, before.at));
      CHECK(isDifference(p.v, above.at, below.at));
      CHECK(isDifference(p.uu, after.u, before.u));
      CHECK(isDifference(p.uv, above.u, below.u));
      CHECK(isDifference(p.uv, after.v, before.v));
      CHECK(isDifference(p.vv, above.v, below.v));
    }
  }
}

TEST_CASE("NurbsSurface: a sphere is one, and has a normal at its poles") {
  const Surface s = sphere();
  const NurbsSurface surface(s.view());
  for (double u = 0; u <= 4; u += 0.125)
    for (double v = -1; v <= 1; v += 0.125) {
      const SurfacePoint p = surface.at(u, v);
      CHECK(length(p.at) == doctest::Approx(1).epsilon(1e-14));
      const Vec3 n = surface.normalAt(u, v);
      // Outwards; at the poles nearly so.
      CHECK(farthest(n, p.at) < (std::fabs(v) == 1 ? 1e-4 : 1e-10));
    }
}

TEST_CASE(
    "NurbsSurface: the end of the domain is of the last span, places outside of the nearest") {
  const Surface s = sphere();
  const NurbsSurface surface(s.view());
  CHECK(surface.u().count() == 4);
  CHECK(surface.v().count() == 2);
  CHECK(surface.u().spanAt(4) == 3);
  CHECK(surface.u().spanAt(5) == 3);
  CHECK(surface.u().spanAt(-1) == 0);
  CHECK(surface.u().spanAt(1) == 1);
  CHECK(farthest(surface.at(4, 0).at, {1, 0, 0}) < 1e-14);
}

TEST_CASE("NurbsSurface: a surface that is a point has no normal") {
  const Surface s{1, 1, {0, 0, 1, 1}, {0, 0, 1, 1}, std::vector<double>(12, 3.0), {}};
  const NurbsSurface surface(s.view());
  const Vec3 n = surface.normalAt(0.5, 0.5);
  CHECK(dot(n, n) == 0);
}
