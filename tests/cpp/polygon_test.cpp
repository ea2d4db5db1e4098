// Both triangulators against the table of families and the exact oracles.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "support/polygon_check.h"
#include "support/polygon_families.h"

using namespace sftest;

TEST_CASE("families: the exact judge finds in each what the table says") {
  MESSAGE("seed 41");
  for (const Family& family : polygonFamilies()) {
    Random random(41);
    for (uint32_t i = 0; i < kInstancesPerFamily; ++i) {
      const Polygon polygon = instanceOf(family, random);
      if (faultsOf(polygon) == family.faults) continue;
      FAIL_CHECK(family.name << ": " << faultNames(faultsOf(polygon)) << " " << describe(polygon));
      break;
    }
  }
}

TEST_CASE("triangulatePolygon: every family has the outcome in the table, by both methods") {
  MESSAGE("seed 42");
  for (const Family& family : polygonFamilies()) {
    Random random(42);
    for (uint32_t i = 0; i < kInstancesPerFamily; ++i) {
      const Polygon polygon = instanceOf(family, random);
      const std::string fault = faultOfTriangulators(polygon);
      if (fault.empty()) continue;
      FAIL_CHECK(family.name << " (" << family.reason << "), instance " << i << ": " << fault
                             << "\n"
                             << describe(polygon));
      break;
    }
  }
}

TEST_CASE(
    "triangulatePolygon: random polygons in all positions are covered exactly by both methods") {
  MESSAGE("seed 43");
  Random random(43);
  for (int i = 0; i < 1500; ++i) {
    Polygon polygon = smallPolygon(random);
    for (uint32_t turns = random.below(4); turns > 0; --turns) polygon = quarterTurned(polygon);
    if (random.chance(0.5)) polygon = mirrored(polygon);
    polygon = rewritten(scaledBy(polygon, std::ldexp(1, int(random.below(81)) - 40)), random);
    const std::string fault = faultOfTriangulators(polygon);
    INFO("polygon ", i, ": ", describe(polygon));
    CHECK(fault == "");
  }
}

TEST_CASE("triangulatePolygon: garbage is accepted just if it is valid, and named for what it is") {
  MESSAGE("seed 44");
  Random random(44);
  uint32_t valid = 0, faulty = 0;
  for (int i = 0; i < 4000; ++i) {
    const uint32_t lattice = random.chance(0.7) ? 2 + random.below(6) : 0;
    const Polygon polygon = garbage(1 + random.below(3), 3 + random.below(5), lattice, random);
    ++(faultsOf(polygon) == kValid ? valid : faulty);
    const std::string fault = faultOfTriangulators(polygon);
    INFO("polygon ", i, ": ", describe(polygon));
    CHECK(fault == "");
  }
  CHECK(valid > 300);
  CHECK(faulty > 300);
}
