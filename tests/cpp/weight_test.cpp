#include "loops/weight.h"

#include <doctest/doctest.h>

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
