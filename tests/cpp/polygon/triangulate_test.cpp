// PolygonTriangulator: memory that goes from polygon to polygon, options together, batches, limits.
#include <doctest/doctest.h>

#include "polygon/triangulate.h"
#include "support/polygon_families.h"
#include "support/polygon_generators.h"
#include "support/polygon_oracle.h"

using namespace sftest;

namespace {

sf::PolygonOptions randomOptions(Random& random) {
  sf::PolygonOptions options;
  options.method = random.chance(0.5) ? sf::PolygonMethod::Flooding : sf::PolygonMethod::Trapezoids;
  options.delaunay = random.chance(0.3), options.strips = random.chance(0.3);
  options.verify = random.chance(0.7), options.trace = random.chance(0.2);
  return options;
}

bool equal(const sf::Outcome& a, const sf::Outcome& b) {
  return a.status == b.status && a.loop == b.loop && a.vertex == b.vertex &&
         a.otherLoop == b.otherLoop && a.otherVertex == b.otherVertex;
}

}  // namespace

TEST_CASE("PolygonTriangulator: what it held before changes nothing") {
  sf::PolygonTriangulator kept;
  for (uint32_t seed = 1; seed <= 1200; ++seed) {
    Random random(seed);
    // Valid and not, with and without isolated points, of all sizes in turn.
    Polygon polygon;
    std::vector<double> points;
    if (seed % 3 == 0) {
      polygon = garbage(1 + random.below(2), 3 + random.below(6), 4, random);
    } else if (seed % 3 == 1) {
      const GriddedBlob blob = blobWithGrid(8 + random.below(60), 2 + random.below(8), random);
      polygon = blob.polygon;
      for (const Point p : blob.inner) points.insert(points.end(), {p.x, p.y});
    } else {
      polygon = smallPolygon(random);
    }
    const sf::PolygonView view{polygon.positions, polygon.starts, points};
    const sf::PolygonOptions options = randomOptions(random);
    sf::Work work, freshWork;
    sf::PolygonTriangulation result, expected;
    const sf::Outcome outcome = kept.triangulate(view, options, work, result);
    const sf::Outcome fresh = sf::triangulatePolygon(view, options, freshWork, expected);
    INFO("seed ", seed, " ", describe(polygon));
    CHECK(equal(outcome, fresh));
    CHECK(result.triangles == expected.triangles);
    CHECK(result.strips == expected.strips);
    CHECK(result.trace.size() == expected.trace.size());
    CHECK(work.used() == 0);
  }
}

TEST_CASE("PolygonTriangulator: every valid family is certified, by both methods") {
  sf::PolygonTriangulator triangulator;
  for (const Family& family : polygonFamilies()) {
    if (family.faults != kValid) continue;
    for (uint32_t seed = 1; seed <= 20; ++seed) {
      Random random(seed);
      const Polygon polygon = instanceOf(family, random);
      for (const auto method : {sf::PolygonMethod::Flooding, sf::PolygonMethod::Trapezoids}) {
        sf::PolygonOptions options;
        options.method = method, options.verify = true;
        sf::Work work;
        sf::PolygonTriangulation result;
        INFO(family.name, " seed ", seed, " ", describe(polygon));
        CHECK(
            triangulator.triangulate({polygon.positions, polygon.starts, {}}, options, work, result)
                .ok());
      }
    }
  }
}

TEST_CASE("PolygonTriangulator: a batch goes on after faults, and says which") {
  Random random(9);
  std::vector<double> positions;
  std::vector<uint32_t> rings{0}, polygons{0};
  std::vector<Polygon> all;
  for (int i = 0; i < 60; ++i)
    all.push_back(i % 4 == 3 ? garbage(1, 7, 5, random) : smallPolygon(random));
  for (const Polygon& polygon : all) {
    const uint32_t first = rings.back();
    positions.insert(positions.end(), polygon.positions.begin(), polygon.positions.end());
    for (size_t r = 1; r < polygon.starts.size(); ++r) rings.push_back(first + polygon.starts[r]);
    polygons.push_back(uint32_t(rings.size()) - 1);
  }
  sf::PolygonTriangulator triangulator;
  sf::PolygonBatchResult batch;
  sf::Work work;
  sf::PolygonOptions options;
  options.verify = true;
  REQUIRE(triangulator.triangulateBatch({positions, rings, polygons}, options, work, batch).ok());
  CHECK(work.used() == 0);
  REQUIRE(batch.triangleStarts.size() == all.size() + 1);
  size_t fault = 0;
  uint32_t first = 0;
  for (uint32_t i = 0; i < all.size(); ++i) {
    const uint32_t begin = batch.triangleStarts[i], end = batch.triangleStarts[i + 1];
    std::vector<uint32_t> triangles(batch.triangles.begin() + ptrdiff_t(3) * begin,
                                    batch.triangles.begin() + ptrdiff_t(3) * end);
    for (uint32_t& v : triangles) v -= first;
    INFO("polygon ", i);
    if (faultsOf(all[i]) == kValid) {
      CHECK(faultOfTriangulation(all[i], triangles) == "");
    } else {
      CHECK(triangles.empty());
      REQUIRE(fault < batch.faults.size());
      CHECK(batch.faults[fault++].polygon == i);
    }
    first += all[i].vertexCount();
  }
  CHECK(fault == batch.faults.size());
  CHECK(fault > 5);
  const std::vector<uint32_t> tooMany{0, uint32_t(rings.size())}, falling{0, 2, 1};
  CHECK(int(triangulator.triangulateBatch({positions, rings, tooMany}, options, work, batch)
                .status) == int(sf::Status::BadStarts));
  CHECK(int(triangulator.triangulateBatch({positions, rings, falling}, options, work, batch)
                .status) == int(sf::Status::BadStarts));
}

TEST_CASE("PolygonTriangulator: any memory limit ends in a status, and all is given back") {
  Random random(4);
  const Polygon polygon = holeGrid(12, 12, false, random);
  for (size_t limit = 1000; limit < 4000000; limit += limit / 3)
    for (int k = 0; k < 4; ++k) {
      sf::PolygonOptions options = randomOptions(random);
      sf::Work work(limit, nullptr, nullptr);
      sf::PolygonTriangulation result;
      const sf::Outcome outcome =
          sf::triangulatePolygon({polygon.positions, polygon.starts, {}}, options, work, result);
      INFO("limit ", limit);
      CHECK((outcome.ok() || outcome.status == sf::Status::OutOfMemory));
      CHECK(work.used() == 0);
    }
}
