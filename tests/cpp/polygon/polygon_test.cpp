// Both triangulators against the table of families and the exact oracles.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "polygon/fill/flood.h"
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
      FAIL_CHECK(std::string(family.name)
                 << ": " << faultNames(faultsOf(polygon)) << " " << describe(polygon));
      break;
    }
  }
}

TEST_CASE("triangulatePolygon: with a trace, water rises along y, also where x has fewer minima") {
  constexpr uint32_t kTeeth = 12;
  Random random(5);
  const Polygon comb = polygonOf({combRing(kTeeth, random)});
  sf::PolygonOptions options;
  options.trace = true;
  sf::PolygonTriangulation traced;
  sf::Work work;
  REQUIRE(sf::triangulatePolygon({comb.positions, comb.starts, {}}, options, work, traced).ok());
  const auto bridges = std::count_if(
      traced.trace.begin(), traced.trace.end(),
      [](const sf::FloodStep& step) { return step.action == uint32_t(sf::FloodAction::Bridge); });
  // One from each valley between two teeth: it has two vertices, of which the lower one is a sag.
  CHECK(bridges == kTeeth - 1);
}

TEST_CASE("triangulatePolygon: every family has the outcome in the table, by both methods") {
  MESSAGE("seed 42");
  for (const Family& family : polygonFamilies()) {
    Random random(42);
    for (uint32_t i = 0; i < kInstancesPerFamily; ++i) {
      const Polygon polygon = instanceOf(family, random);
      const std::string fault = faultOfTriangulators(polygon);
      if (fault.empty()) continue;
      FAIL_CHECK(std::string(family.name) << " (" << std::string(family.reason) << "), instance "
                                          << i << ": " << fault << "\n"
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

TEST_CASE(
    "triangulatePolygon: with repair, garbage and faulty families are covered as the rule says") {
  MESSAGE("seed 45");
  Random random(45);
  const auto check = [](const Polygon& polygon) {
    for (const auto rule : {sf::Repair::EvenOdd, sf::Repair::NonZero}) {
      const std::string fault = faultOfRepair(polygon, rule);
      INFO(describe(polygon));
      CHECK(fault == "");
    }
  };
  for (int i = 0; i < 200; ++i) {
    const uint32_t lattice = random.chance(0.5) ? 2 + random.below(9) : 0;
    check(garbage(1 + random.below(3), 3 + random.below(15), lattice, random));
  }
  for (const Family& family : polygonFamilies())
    for (int i = 0; i < 4 && family.faults != kNotFinite; ++i) check(instanceOf(family, random));
}

TEST_CASE("PolygonTriangulator: a batch has the triangles and faults of its polygons one by one") {
  MESSAGE("seed 46");
  Random random(46);
  std::vector<double> positions;
  std::vector<uint32_t> ringStarts = {0}, polygonStarts = {0};
  std::vector<Polygon> polygons;
  for (const Family& family : polygonFamilies())
    for (int i = 0; i < 2; ++i) {
      const Polygon polygon = instanceOf(family, random);
      const uint32_t first = ringStarts.back();
      positions.insert(positions.end(), polygon.positions.begin(), polygon.positions.end());
      for (uint32_t r = 1; r <= polygon.ringCount(); ++r)
        ringStarts.push_back(first + polygon.starts[r]);
      polygonStarts.push_back(uint32_t(ringStarts.size()) - 1);
      polygons.push_back(polygon);
    }
  for (const auto method : {sf::PolygonMethod::Flooding, sf::PolygonMethod::Trapezoids}) {
    sf::PolygonOptions options;
    options.method = method;
    sf::Work work;
    sf::PolygonBatchResult batch;
    sf::PolygonTriangulator triangulator;
    REQUIRE(
        triangulator.triangulateBatch({positions, ringStarts, polygonStarts}, options, work, batch)
            .ok());
    CHECK(work.used() == 0);
    REQUIRE(batch.triangleStarts.size() == polygons.size() + 1);
    size_t fault = 0;
    for (uint32_t p = 0; p < polygons.size(); ++p) {
      sf::PolygonTriangulation single;
      const sf::Outcome outcome =
          sf::triangulatePolygon(viewOf(polygons[p]), options, work, single);
      for (uint32_t& v : single.triangles) v += ringStarts[polygonStarts[p]];
      const std::vector<uint32_t> part(batch.triangles.begin() + 3 * batch.triangleStarts[p],
                                       batch.triangles.begin() + 3 * batch.triangleStarts[p + 1]);
      CHECK(part == single.triangles);
      if (outcome.ok()) continue;
      REQUIRE(fault < batch.faults.size());
      CHECK(batch.faults[fault].polygon == p);
      CHECK(batch.faults[fault].outcome.status == outcome.status);
      CHECK(batch.faults[fault].outcome.loop == outcome.loop);
      CHECK(batch.faults[fault].outcome.vertex == outcome.vertex);
      ++fault;
    }
    CHECK(fault == batch.faults.size());
  }
}
