// Flooding: triangulations against exact judges, the automaton's promises, every family.
#include <doctest/doctest.h>

#include "polygon/flood.h"
#include "polygon/triangulate.h"
#include "support/polygon_families.h"
#include "support/polygon_generators.h"
#include "support/polygon_oracle.h"

using namespace sftest;

namespace {

sf::PolygonView viewOf(const Polygon& polygon) { return {polygon.positions, polygon.starts, {}}; }

sf::Outcome flood(const Polygon& polygon, sf::PolygonTriangulation& result) {
  sf::Work work;
  const sf::Outcome outcome = sf::triangulatePolygon(viewOf(polygon), {}, work, result);
  CHECK(work.used() == 0);
  return outcome;
}

std::string faultOfFlooding(const Polygon& polygon) {
  sf::PolygonTriangulation result;
  const sf::Outcome outcome = flood(polygon, result);
  if (!outcome.ok()) return "status " + std::to_string(int(outcome.status));
  return faultOfTriangulation(polygon, result.triangles);
}

}  // namespace

TEST_CASE("flooding: valid small polygons are covered exactly") {
  for (uint32_t seed = 1; seed <= 2000; ++seed) {
    Random random(seed);
    const Polygon polygon = smallPolygon(random);
    const std::string fault = faultOfFlooding(polygon);
    INFO("seed ", seed, " ", describe(polygon));
    CHECK(fault == "");
  }
}

TEST_CASE("flooding: regions of lattice triangles, touching themselves, are covered exactly") {
  for (uint32_t seed = 1; seed <= 2000; ++seed) {
    Random random(seed);
    const Polygon polygon =
        latticeRegion(4 + seed % 7, 4 + seed % 60, seed % 3 == 0, seed % 2 == 0, random);
    if (faultsOf(polygon) != kValid) continue;
    const std::string fault = faultOfFlooding(polygon);
    INFO("seed ", seed, " ", describe(polygon));
    CHECK(fault == "");
  }
}
