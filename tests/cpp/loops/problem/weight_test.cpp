#include "loops/problem/weight.h"

#include <doctest/doctest.h>

#include "base/accurate_cross.h"
#include "support/generators.h"

using namespace sf;

TEST_CASE("weight: dihedral angle is 0 where flat and pi where folded, on both sides of the cut") {
  CHECK(dihedralAngle(0, kPi) == 0);
  CHECK(dihedralAngle(-kPi / 2, kPi / 2) == doctest::Approx(0));
  CHECK(dihedralAngle(3, 3) == doctest::Approx(kPi));
  CHECK(dihedralAngle(kPi - 0.1, -kPi + 0.1) == doctest::Approx(kPi - 0.2));
  CHECK(dihedralAngle(0.2, -kPi + 0.1) == doctest::Approx(0.1));
}

TEST_CASE("weight: a sum forbids angles above its cap, a maximum joins by the larger") {
  const Measure sum = Measure::sum(2, 1);
  CHECK(sum.pair(0, kPi - 0.5) == doctest::Approx(1));
  CHECK(sum.pair(0, kPi - 1.5) == kInfinity);
  CHECK(sum.join(2, 3) == 5);
  CHECK(Measure::worst().join(2, 3) == 3);
  CHECK(Measure::worst().pair(0, kPi - 1.5) == doctest::Approx(1.5));
}

TEST_CASE("weight: rounding is no improvement, more than rounding is") {
  const Measure sum = Measure::sum(1);
  CHECK(sum.improves(1, kInfinity));
  CHECK_FALSE(sum.improves(1, 1));
  CHECK_FALSE(sum.improves(1 - 1e-15, 1));
  CHECK(sum.improves(1 - 1e-12, 1));
  CHECK(sum.improves(-1, 0));
  CHECK_FALSE(Measure::worst().improves(1, 1));
}

TEST_CASE("accurate cross product: full precision for triangles of almost collinear points") {
  sftest::Random random(65);
  MESSAGE("seed 65");
  int thin = 0;
  for (int i = 0; i < 2000; ++i) {
    // Integers, so that the exact product is at hand; b and c all but in one direction.
    const auto integer = [&](double size) { return std::floor(random.range(-size, size)); };
    const Vec3 a{integer(1e9), integer(1e9), integer(1e9)},
        u{integer(1e9), integer(1e9), integer(1e9)};
    const double s = std::floor(random.range(2, 5));
    const Vec3 b = a + u, c = a + s * u + Vec3{integer(3), integer(3), integer(3)};
    const auto minor = [](double p, double q, double r, double t) {
      return double(__int128(p) * __int128(t) - __int128(q) * __int128(r));
    };
    const Vec3 w = c - a;
    const Vec3 exact{minor(u.y, u.z, w.y, w.z), minor(u.z, u.x, w.z, w.x),
                     minor(u.x, u.y, w.x, w.y)};
    // Scaled by a power of two into the range of the predicates.
    const double k = 0x1p-40;
    const Vec3 got = accurateCross(k * a, k * b, k * c);
    thin += isThin(dot(exact, exact), dot(u, u), dot(w, w));
    CHECK(distance((1 / (k * k)) * got, exact) <= 1e-11 * length(exact));
  }
  CHECK(thin > 1900);
}
