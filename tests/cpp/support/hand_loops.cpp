#include "support/hand_loops.h"

#include <algorithm>
#include <cmath>

namespace sftest {
namespace {

constexpr double kPi = 3.14159265358979323846;

double normalDeviate(Random& random) {
  return std::sqrt(-2 * std::log(1 - random.unit())) * std::cos(2 * kPi * random.unit());
}

/// Two unit vectors across a unit vector, and across each other.
void planeAcross(Vec3 axis, Vec3& u, Vec3& v) {
  const Vec3 side = std::fabs(axis.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  u = side - dot(side, axis) * axis;
  u = (1 / length(u)) * u;
  v = cross(axis, u);
}

/// n parameters from 0 to 1 round a loop, each moved by up to `jitter` of a step.
std::vector<double> places(uint32_t n, double jitter, Random& random) {
  std::vector<double> result;
  for (uint32_t i = 0; i < n; ++i) result.push_back((i + jitter * random.range(-1, 1)) / n);
  return result;
}

/// Normal in each coordinate, with `noise` as its deviation: strong noise has loops insert vertices.
void addNoise(Curve& curve, double noise, Random& random) {
  for (Vec3& p : curve) {
    const double x = noise * normalDeviate(random), y = noise * normalDeviate(random);
    p = p + Vec3{x, y, noise * normalDeviate(random)};
  }
}

void turnAll(Curves& curves, Random& random) {
  const Rotation turn = randomRotation(random);
  for (Curve& curve : curves)
    for (Vec3& p : curve) p = turn(p);
}

double someNoise(Random& random) { return random.chance(0.2) ? 0 : random.range(0, 0.2); }

Curves several(uint32_t size, Random& random) {
  const uint32_t k = std::min(3 + random.below(4), std::max(size / 3, 1u));
  const double noise = someNoise(random);
  Curves curves;
  for (uint32_t c = 0; c < k; ++c) {
    const double t = 2 * kPi * (c + 0.3 * random.unit()) / k;
    const Vec3 axis{std::cos(t), std::sin(t), 0};
    const uint32_t n = std::max(3u, uint32_t(size * random.range(0.5, 1.5)) / k);
    curves.push_back(handStroke(n, noise, (1.6 + 0.3 * k) * axis, axis, random));
  }
  return curves;
}

/// Out along an arc and back beside it: the outline of a horseshoe.
Curve horseshoe(uint32_t n, double noise, Random& random) {
  const double gap = random.range(0.02, 0.4), turn = random.range(1, 1.9) * kPi;
  const double width = random.range(0.05, 0.5);
  Curve curve;
  for (const double t : places(n, 0.3, random)) {
    const bool isBack = t >= 0.5;
    const double along = isBack ? 2 - 2 * t : 2 * t;
    const double r = 1 + (isBack ? width : 0) + gap * std::sin(7 * along);
    curve.push_back({r * std::cos(turn * along), r * std::sin(turn * along), 0.3 * along * along});
  }
  addNoise(curve, noise * std::min(width, 2 * kPi / n), random);
  return curve;
}

/// A sum of some waves in each coordinate.
Curve denseCurve(uint32_t n, Vec3 centre, Random& random) {
  Vec3 a[4], b[4];
  for (int k = 0; k < 4; ++k)
    for (double* x : {&a[k].x, &a[k].y, &a[k].z, &b[k].x, &b[k].y, &b[k].z})
      *x = normalDeviate(random) / ((k + 1) * (k + 1));
  Curve curve;
  for (uint32_t i = 0; i < n; ++i) {
    Vec3 p = centre;
    for (int k = 0; k < 4; ++k) {
      const double t = 2 * kPi * (k + 1) * i / n;
      p = p + std::cos(t) * a[k] + std::sin(t) * b[k];
    }
    curve.push_back(p);
  }
  return curve;
}

Curves linked(uint32_t size, Random& random) {
  const uint32_t k = std::min(2 + random.below(2), std::max(size / 3, 1u));
  const double noise = 0.3 * someNoise(random);
  Curves curves;
  for (uint32_t c = 0; c < k; ++c) {
    const Vec3 axis = c % 2 ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
    curves.push_back(circle(std::max(3u, size / k), 1, {1.1 * c, 0.01 * c, 0.02}, axis));
    addNoise(curves.back(), noise, random);
  }
  return curves;
}

Curve torusKnot(uint32_t n, Random& random) {
  const uint32_t kinds[][2] = {{2, 3}, {3, 2}, {2, 5}, {3, 4}};
  const uint32_t* pq = kinds[random.below(4)];
  Curve curve;
  for (const double s : places(n, 0.3, random)) {
    const double t = 2 * kPi * s, r = 1 + 0.4 * std::cos(pq[1] * t);
    curve.push_back({r * std::cos(pq[0] * t), r * std::sin(pq[0] * t), 0.4 * std::sin(pq[1] * t)});
  }
  addNoise(curve, 0.2 * someNoise(random), random);
  return curve;
}

Curves manySmall(Random& random) {
  const uint32_t k = 20 + random.below(21), side = uint32_t(std::ceil(std::cbrt(k)));
  const bool isFlat = random.chance(0.4);
  const double noise = isFlat ? 0 : random.range(0, 0.2);
  Curves curves;
  for (uint32_t c = 0; c < k; ++c) {
    const Vec3 cell =
        isFlat ? Vec3{double(c % 7), double(c / 7), 0}
               : Vec3{double(c % side), double(c / side % side), double(c / side / side)};
    const Vec3 axis = isFlat ? Vec3{0, 0, 1} : random.direction();
    curves.push_back(circle(3 + random.below(6), 0.35, cell, axis));
    addNoise(curves.back(), 0.35 * noise, random);
  }
  return curves;
}

/// Rims of discs of one mesh, the largest first, each smaller ones by a random factor.
Curves rims(uint32_t size, Random& random) {
  const uint32_t levels = size > 60 ? 4 : size > 20 ? 3 : 2;
  std::vector<uint32_t> faces;
  double left = size;
  const uint32_t k = 1 + random.below(4);
  for (uint32_t c = 0; c < k && left > 3; ++c) {
    // A random disc of f faces has a rim of about .7 f vertices.
    const double rim = c + 1 == k ? left : left * random.range(0.3, 0.9);
    faces.push_back(uint32_t(std::clamp(rim * 1.4, 1.0, 2000.0)));
    left -= rim;
  }
  const Curves curves = meshRims(levels, faces, random);
  // Where discs leave no room for one so large, a triangle's rim is left.
  return curves.empty() ? meshRims(levels, {1}, random) : curves;
}

}  // namespace

const char* nameOf(Hand kind) {
  static const char* const kNames[] = {"stroke",           "pair",        "several",
                                       "self-approaching", "dense curve", "rims",
                                       "linked",           "knot",        "many small"};
  return kNames[int(kind)];
}

Curve handStroke(uint32_t n, double noise, Vec3 centre, Vec3 axis, Random& random) {
  double amplitude[4], phase[4];
  for (int k = 0; k < 4; ++k) {
    amplitude[k] = 0.25 / (k + 1) * normalDeviate(random);
    phase[k] = random.range(0, 2 * kPi);
  }
  Vec3 u, v;
  planeAcross(axis, u, v);
  Curve curve;
  for (const double s : places(n, 0.3, random)) {
    const double t = 2 * kPi * s;
    double r = 1;
    for (int k = 0; k < 4; ++k) r += amplitude[k] * std::cos((k + 2) * t + phase[k]);
    curve.push_back(centre + r * (std::cos(t) * u + std::sin(t) * v));
  }
  addNoise(curve, noise, random);
  return curve;
}

Curves handLoops(Hand kind, uint32_t size, Random& random) {
  Curves curves;
  const uint32_t n = std::max(size, 3u);
  const Vec3 z{0, 0, 1};
  switch (kind) {
    case Hand::Stroke:
      curves = {handStroke(n, someNoise(random), {0, 0, 0}, z, random)};
      break;
    case Hand::Pair: {
      const double noise = someNoise(random);
      const uint32_t first = std::max(3u, uint32_t(n * random.range(0.2, 0.8)));
      const uint32_t second = std::max(3u, n - std::min(first, n));
      curves = {handStroke(first, noise, {0, 0, 0}, z, random),
                handStroke(second, noise, {0, 0, 1.2}, z, random)};
      break;
    }
    case Hand::Several:
      curves = several(n, random);
      break;
    case Hand::SelfApproaching:
      curves = {horseshoe(n, random.unit(), random)};
      break;
    case Hand::DenseCurve:
      curves = {denseCurve(n, {0, 0, 0}, random)};
      if (random.chance(0.3)) curves.push_back(denseCurve(n / 3 + 3, {0, 0, 4}, random));
      break;
    case Hand::Rims:
      curves = rims(n, random);
      break;
    case Hand::Linked:
      curves = linked(n, random);
      break;
    case Hand::Knot:
      curves = {torusKnot(n, random)};
      break;
    case Hand::ManySmall:
    case Hand::Count:
      curves = manySmall(random);
      break;
  }
  turnAll(curves, random);
  return curves;
}

uint32_t logUniform(uint32_t low, uint32_t high, Random& random) {
  const double x = std::exp(random.range(std::log(double(low)), std::log(double(high) + 1)));
  return std::min(uint32_t(x), high);
}

}  // namespace sftest
