#include "loops/one_loop/angular_transform.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "support/generators.h"

using namespace sf;
using namespace sftest;

namespace {

void checkAgainstPairs(Measure measure, size_t inner, size_t outer, bool sorted, Random& random) {
  std::vector<double> innerTheta, base, outerTheta, result(outer);
  // Coarse angles, in part: equal ones, opposite ones, and both ends of the range.
  const auto theta = [&] {
    return random.chance(0.3) ? kPi * (int(random.below(9)) - 4) / 4.0 : random.range(-kPi, kPi);
  };
  for (size_t i = 0; i < inner; ++i) {
    innerTheta.push_back(theta());
    base.push_back(random.chance(0.1) ? kInfinity : random.range(0, 4));
  }
  for (size_t j = 0; j < outer; ++j) outerTheta.push_back(theta());
  if (sorted) {
    std::sort(innerTheta.begin(), innerTheta.end());
    std::sort(outerTheta.begin(), outerTheta.end());
  }
  AngularTransform transform(measure);
  const auto apply = sorted ? &AngularTransform::applySorted : &AngularTransform::apply;
  // Twice: what the first call leaves behind must not matter.
  for (int repeat = 0; repeat < 2; ++repeat)
    (transform.*apply)(innerTheta.data(), base.data(), inner, outerTheta.data(), outer,
                       result.data());
  for (size_t j = 0; j < outer; ++j) {
    double expected = kInfinity;
    for (size_t i = 0; i < inner; ++i)
      expected =
          std::min(expected, measure.join(base[i], measure.pair(innerTheta[i], outerTheta[j])));
    if (expected == kInfinity)
      CHECK(result[j] == kInfinity);
    else
      CHECK(result[j] == doctest::Approx(expected).epsilon(1e-13));
  }
}

}  // namespace

TEST_CASE("angular transform: equals the minimum over all pairs, in every measure and size") {
  Random random(81);
  MESSAGE("seed 81");
  // A cap that is not one of the coarse angles, so that rounding does not decide.
  const Measure measures[] = {Measure::sum(1), Measure::sum(0.3), Measure::sum(0),
                              Measure::sum(1, 1.234), Measure::worst()};
  for (const Measure& measure : measures)
    for (const size_t inner : {0, 1, 2, 7, 30, 150, 400})
      for (const size_t outer : {1, 5, 60, 300})
        for (int repeat = 0; repeat < 4; ++repeat)
          checkAgainstPairs(measure, inner, outer, repeat % 2 == 1, random);
}
