// Many polygons at once: numbered through, each judged for itself, in the plane and in space.
#include "polygon/batch.h"

#include <doctest/doctest.h>

#include <cmath>

#include "support/polygon_generators.h"

using namespace sftest;
using sf::Status;

namespace {

struct Polygons {
  uint32_t dimension = 2;
  std::vector<double> positions;
  std::vector<uint32_t> ringStarts{0}, polygonStarts{0};

  void add(const Polygon& polygon) {
    const uint32_t first = ringStarts.back();
    positions.insert(positions.end(), polygon.positions.begin(), polygon.positions.end());
    for (size_t r = 1; r < polygon.starts.size(); ++r)
      ringStarts.push_back(first + polygon.starts[r]);
    polygonStarts.push_back(uint32_t(ringStarts.size()) - 1);
  }
  sf::Outcome triangulate(const sf::PolygonOptions& options, sf::FlatTriangulation& result,
                          size_t maxBytes = size_t(-1)) const {
    sf::PolygonTriangulator triangulator;
    sf::Work work(maxBytes, nullptr, nullptr);
    return sf::triangulateAll({dimension, positions, ringStarts, polygonStarts, {}}, options,
                              triangulator, work, result);
  }
  /// Polygon p by itself.
  Polygon only(uint32_t p) const {
    Polygon one;
    const uint32_t first = ringStarts[polygonStarts[p]], end = ringStarts[polygonStarts[p + 1]];
    one.positions.assign(positions.begin() + dimension * first,
                         positions.begin() + dimension * end);
    one.starts.clear();
    for (uint32_t r = polygonStarts[p]; r <= polygonStarts[p + 1]; ++r)
      one.starts.push_back(ringStarts[r] - first);
    return one;
  }
};

Polygon bowTie() { return polygonOf({{{0, 0}, {2, 2}, {2, 0}, {0, 2}}}); }

}  // namespace

TEST_CASE("batch: what each polygon gives by itself, in the numbers of all") {
  constexpr uint32_t kSeed = 77;
  CAPTURE(kSeed);
  Random random(kSeed);
  for (int i = 0; i < 100; ++i) {
    CAPTURE(i);
    Polygons all;
    for (uint32_t p = 2 + random.below(5); p > 0; --p)
      all.add(random.chance(0.7) ? smallPolygon(random)
                                 : garbage(1 + random.below(2), 5, 4, random));
    sf::PolygonOptions options;
    options.delaunay = random.chance(0.5);
    // All in one go, and one after the other.
    for (const bool strips : {false, true}) {
      CAPTURE(strips);
      options.strips = strips;
      sf::FlatTriangulation found;
      REQUIRE(all.triangulate(options, found).ok());
      const size_t count = all.polygonStarts.size() - 1;
      REQUIRE(found.triangleStarts.size() == count + 1);
      REQUIRE(found.polygonStrips.size() == count + 1);
      size_t faults = 0;
      for (uint32_t p = 0; p < count; ++p) {
        CAPTURE(p);
        const Polygon one = all.only(p);
        sf::PolygonTriangulation alone;
        sf::Work work;
        const sf::Outcome outcome =
            sf::triangulatePolygon({one.positions, one.starts, {}}, options, work, alone);
        const uint32_t first = all.ringStarts[all.polygonStarts[p]];
        const std::vector<uint32_t> triangles(
            found.triangles.begin() + 3 * size_t(found.triangleStarts[p]),
            found.triangles.begin() + 3 * size_t(found.triangleStarts[p + 1]));
        if (!outcome.ok()) {
          CHECK(triangles.empty());
          REQUIRE(faults < found.faults.size());
          CHECK(found.faults[faults].polygon == p);
          CHECK(found.faults[faults].outcome.status == outcome.status);
          CHECK(found.faults[faults].outcome.loop == outcome.loop);
          CHECK(found.faults[faults].outcome.vertex == outcome.vertex);
          ++faults;
          continue;
        }
        for (uint32_t& v : alone.triangles) v += first;
        CHECK(triangles.size() == alone.triangles.size());
        if (strips) CHECK(triangles == alone.triangles);
        for (const uint32_t v : triangles) CHECK((v >= first && v < first + one.vertexCount()));
        const uint32_t stripCount = found.polygonStrips[p + 1] - found.polygonStrips[p];
        CHECK(stripCount == (strips ? alone.stripStarts.size() - 1 : 0));
        for (uint32_t s = 0; s < stripCount; ++s) {
          const uint32_t begin = found.stripStarts[found.polygonStrips[p] + s];
          CHECK(found.strips[begin] == first + alone.strips[alone.stripStarts[s]]);
        }
      }
      CHECK(found.faults.size() == faults);
      CHECK(found.faultPoints.size() == 2 * faults);
    }
  }
}

TEST_CASE("batch: points that repair adds come after the vertices of all polygons") {
  Polygons all;
  for (int i = 0; i < 3; ++i) all.add(bowTie());
  sf::PolygonOptions options;
  options.repair = sf::Repair::EvenOdd;
  sf::FlatTriangulation found;
  REQUIRE(all.triangulate(options, found).ok());
  CHECK(found.faults.empty());
  CHECK(found.triangleStarts == std::vector<uint32_t>{0, 2, 4, 6});
  CHECK(found.added == std::vector<double>{1, 1, 1, 1, 1, 1});
  for (uint32_t p = 0; p < 3; ++p) {
    CAPTURE(p);
    for (uint32_t t = 2 * p; t < 2 * p + 2; ++t)
      for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t v = found.triangles[3 * t + k];
        CHECK((v / 4 == p || v == 12 + p));
      }
    for (const uint32_t edge : {found.addedOn[2 * p], found.addedOn[2 * p + 1]})
      CHECK(edge / 4 == p);
  }
}

TEST_CASE("batch: polygons in space have planes of their own, and coordinates left out count") {
  const Polygon square = polygonOf({{{0, 0}, {4, 0}, {4, 4}, {0, 4}}});
  Polygons all;
  all.dimension = 3;
  for (const Polygon& polygon : {square, bowTie(), square, square}) all.add(polygon);
  all.positions.clear();
  const auto put = [&](const Polygon& polygon, const double(&axes)[3][3]) {
    for (size_t i = 0; i < polygon.positions.size(); i += 2)
      for (const auto& row : axes)
        all.positions.push_back(row[0] * polygon.positions[i] + row[1] * polygon.positions[i + 1] +
                                row[2]);
  };
  put(square, {{1, 0, 0}, {0, 1, 0}, {0, 0, 9}});
  put(bowTie(), {{0, 0, 7}, {1, 0, 0}, {0, 1, 0}});
  put(square, {{1, 1, 0}, {0, 1, 0}, {1, 0, 0}});
  put(square, {{1, 0, 0}, {0, 1, 0}, {0, 0, 0}});
  all.positions.back() = std::nan("");
  for (const bool delaunay : {false, true}) {
    CAPTURE(delaunay);
    sf::PolygonOptions options;
    options.delaunay = delaunay;
    sf::FlatTriangulation found;
    REQUIRE(all.triangulate(options, found).ok());
    CHECK(found.triangleStarts == std::vector<uint32_t>{0, 2, 2, 4, 4});
    REQUIRE(found.faults.size() == 2);
    CHECK(found.faults[0].polygon == 1);
    CHECK(found.faults[0].outcome.status == Status::SelfIntersecting);
    CHECK(found.faults[1].polygon == 3);
    CHECK(found.faults[1].outcome.status == Status::NotFinite);
    CHECK(found.faults[1].outcome.vertex == 3);
    CHECK(std::vector<double>(found.faultPoints.begin(), found.faultPoints.begin() + 3) ==
          std::vector<double>{7, 1, 1});
  }
}

TEST_CASE("batch: a polygon without rings is empty, and a memory limit ends the whole") {
  Polygons all;
  all.add(polygonOf({{{0, 0}, {4, 0}, {4, 4}, {0, 4}}}));
  all.polygonStarts.push_back(all.polygonStarts.back());
  all.add(polygonOf({{{0, 0}, {4, 0}, {0, 4}}}));
  sf::PolygonOptions options;
  for (const bool strips : {false, true}) {
    options.strips = strips;
    sf::FlatTriangulation found;
    REQUIRE(all.triangulate(options, found).ok());
    CHECK(found.triangleStarts == std::vector<uint32_t>{0, 2, 2, 3});
    CHECK(all.triangulate(options, found = {}, 10).status == Status::OutOfMemory);
  }
}
