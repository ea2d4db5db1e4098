// A million random polygons, and repairs of a hundred thousand.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "support/polygon_check.h"
#include "support/polygon_families.h"

using namespace sftest;

namespace {

/// SF_SEED starts elsewhere, SF_COUNT sets how many polygons.
uint32_t numberFrom(const char* name, uint32_t otherwise) {
  const char* text = std::getenv(name);
  return text ? uint32_t(std::strtoul(text, nullptr, 10)) : otherwise;
}

Polygon inAnyPosition(Polygon polygon, Random& random) {
  for (uint32_t turns = random.below(4); turns > 0; --turns) polygon = quarterTurned(polygon);
  if (random.chance(0.5)) polygon = mirrored(polygon);
  return rewritten(scaledBy(polygon, std::ldexp(1, int(random.below(81)) - 40)), random);
}

Polygon anyPolygon(Random& random) {
  const auto& families = polygonFamilies();
  switch (random.below(4)) {
    case 0:
      return instanceOf(families[random.below(uint32_t(families.size()))], random);
    case 1: {
      const uint32_t lattice = random.chance(0.8) ? 2 + random.below(8) : 0;
      return garbage(1 + random.below(4), 3 + random.below(6), lattice, random);
    }
    default:
      return inAnyPosition(smallPolygon(random), random);
  }
}

}  // namespace

TEST_CASE("triangulatePolygon: a million random polygons, valid and not, by both methods") {
  const uint32_t seed = numberFrom("SF_SEED", 1), count = numberFrom("SF_COUNT", 1000000);
  MESSAGE("seeds " << seed << " to " << seed + count - 1);
  uint32_t valid = 0, failed = 0;
  for (uint32_t i = 0; i < count && failed < 10; ++i) {
    Random random(seed + i);
    const Polygon polygon = anyPolygon(random);
    const std::string fault = faultOfTriangulators(polygon);
    valid += faultsOf(polygon) == kValid;
    if (fault.empty()) continue;
    ++failed;
    FAIL_CHECK("seed " << seed + i << ": " << fault << "\n" << describe(polygon));
  }
  MESSAGE(valid << " of them valid");
  CHECK((valid > count / 3 || failed > 0));
}

TEST_CASE("triangulatePolygon: repairs of a hundred thousand random polygons and rings") {
  const uint32_t seed = numberFrom("SF_SEED", 1), count = numberFrom("SF_COUNT", 1000000) / 10;
  MESSAGE("seeds " << seed << " to " << seed + count - 1);
  uint32_t failed = 0;
  for (uint32_t i = 0; i < count && failed < 10; ++i) {
    Random random(seed + i);
    const Polygon polygon = anyPolygon(random);
    if (faultsOf(polygon) == kNotFinite) continue;
    for (const auto rule : {sf::Repair::EvenOdd, sf::Repair::NonZero}) {
      const std::string fault = faultOfRepair(polygon, rule);
      if (fault.empty()) continue;
      ++failed;
      FAIL_CHECK("seed " << seed + i << ": " << fault << "\n" << describe(polygon));
    }
  }
}
