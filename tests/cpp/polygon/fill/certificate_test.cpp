// Certificates: given for what flooding makes of valid polygons, refused for everything else that
// could pass for a triangulation.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/turn.h"
#include "polygon/fill/certificate.h"
#include "polygon/fill/flood.h"
#include "polygon/sweep/link_rings.h"
#include "support/polygon_generators.h"
#include "support/polygon_oracle.h"

using namespace sftest;

namespace {

using Indices = sf::Buffer<uint32_t>;

bool isCertain(const sf::Certificate& certificate) {
  sf::Work work;
  const bool result = sf::certify(certificate, work);
  CHECK(work.used() == 0);
  return result;
}

/// Points, frame, and rings turned as they should be; no triangles.
sf::Certificate blankFor(const Polygon& polygon) {
  sf::Certificate c;
  const uint32_t n = polygon.vertexCount();
  for (uint32_t v = 0; v < n; ++v) c.at.push_back({polygon.point(v).x, polygon.point(v).y});
  c.at.resize(n + 4);
  sf::frameAround({polygon.positions, polygon.starts, {}}, c.at.data() + n);
  c.same.resize(n + 4);
  std::iota(c.same.begin(), c.same.end(), 0);
  for (uint32_t v = 0; v < n; ++v)
    for (uint32_t w = v; w-- > 0;)
      if (c.at[w] == c.at[v]) c.same[v] = w;
  for (uint32_t r = 0; r < polygon.ringCount(); ++r) {
    const uint32_t first = polygon.starts[r], last = polygon.starts[r + 1] - 1;
    double area = 0;
    for (uint32_t v = first; v <= last; ++v) {
      const Point a = polygon.point(v), b = polygon.point(v == last ? first : v + 1);
      area += a.x * b.y - a.y * b.x;
    }
    for (uint32_t v = first; v <= last; ++v) {
      const uint32_t w = v == last ? first : v + 1;
      const bool forward = (area > 0) == (r == 0);
      c.rings.push_back(forward ? v : w), c.rings.push_back(forward ? w : v);
    }
  }
  return c;
}

/// The certificate of flooding, both ways; false in `done` if the sweep refuses the polygon. With twins
/// for polygons of an even number of vertices.
sf::Certificate floodedBothWays(const Polygon& polygon, bool& done) {
  sf::Certificate c = blankFor(polygon);
  sf::PlaneSweep sweep;
  sf::Flood flood;
  sf::LinkedPolygon loops;
  sf::Visibility seen;
  sf::Work work;
  const sf::PolygonView view{polygon.positions, polygon.starts, {}};
  sf::Charge charge(work);
  const bool hinted = polygon.vertexCount() % 2 == 0;
  const auto take = [&](sf::Outcome outcome, Indices& triangles, Indices& twins, size_t& paired) {
    if (!outcome.ok() || !flood.run(loops, seen, work, charge, nullptr, hinted)) return false;
    for (const uint32_t v : flood.triangles()) triangles.push_back(loops.vertex[v]);
    if (hinted) {
      flood.twins().open();
      twins = flood.twins().of;
      paired = triangles.size();
    }
    triangles.insert(triangles.end(), loops.flat.begin(), loops.flat.end());
    return true;
  };
  done = take(sweep.run(view, true, true, work, loops, seen), c.inside, c.insideTwins,
              c.insidePaired) &&
         take(sweep.runComplement(view, work, loops, seen), c.complement, c.complementTwins,
              c.complementPaired);
  return c;
}

/// Triangles with the right boundary and nothing else: a fan over every ring, and over the frame.
void fan(sf::Certificate& c, uint32_t apex) {
  const uint32_t n = uint32_t(c.at.size()) - 4;
  for (size_t i = 0; i < c.rings.size(); i += 2) {
    c.inside.insert(c.inside.end(), {apex, c.rings[i], c.rings[i + 1]});
    c.complement.insert(c.complement.end(), {apex, c.rings[i + 1], c.rings[i]});
  }
  for (uint32_t k = 0; k < 4; ++k)
    c.complement.insert(c.complement.end(), {apex, n + k, n + (k + 1) % 4});
}

}  // namespace

TEST_CASE("certificate: given for flooding's triangles of valid polygons") {
  int certain = 0;
  for (uint32_t seed = 1; seed <= 800; ++seed) {
    Random random(seed);
    Polygon polygon = seed % 2
                          ? smallPolygon(random)
                          : latticeRegion(3 + seed % 6, 4 + seed % 40, seed % 3 == 0, true, random);
    if (faultsOf(polygon) != kValid) continue;
    bool done = false;
    const sf::Certificate c = floodedBothWays(polygon, done);
    INFO("seed ", seed, " ", describe(polygon));
    REQUIRE(done);
    CHECK(isCertain(c));
    ++certain;
  }
  CHECK(certain > 600);
}

TEST_CASE("certificate: a twin that is not one is refused, whatever the triangles") {
  int changes = 0;
  for (uint32_t seed = 1; seed <= 300; ++seed) {
    Random random(seed);
    const Polygon polygon = smallPolygon(random);
    bool done = false;
    sf::Certificate c = floodedBothWays(polygon, done);
    if (c.insidePaired == 0) continue;
    REQUIRE(done);
    const uint32_t h = random.below(uint32_t(c.insidePaired));
    const uint32_t g = random.below(uint32_t(c.insidePaired) + 10);
    const uint32_t before = c.insideTwins[h];
    if (before == g || (before >= c.insidePaired && g >= c.insidePaired)) continue;
    INFO("seed ", seed, " half-edge ", h, " to ", g);
    c.insideTwins[h] = g;
    CHECK(!isCertain(c));
    if (g < c.insidePaired) c.insideTwins[g] = h;
    CHECK(!isCertain(c));
    // Without hints the edges themselves are looked at.
    c.insidePaired = 0;
    CHECK(isCertain(c));
    ++changes;
  }
  CHECK(changes > 50);
}

TEST_CASE("certificate: refused after any change of a triangle") {
  for (uint32_t seed = 1; seed <= 400; ++seed) {
    Random random(seed);
    const Polygon polygon = smallPolygon(random);
    bool done = false;
    const sf::Certificate c = floodedBothWays(polygon, done);
    REQUIRE(done);
    for (const bool inside : {true, false}) {
      const Indices& before = inside ? c.inside : c.complement;
      const size_t t = random.below(uint32_t(before.size() / 3));
      const uint32_t other = random.below(uint32_t(c.at.size()));
      const auto refuses = [&](Indices triangles) {
        sf::Certificate changed = c;
        size_t& paired = inside ? changed.insidePaired : changed.complementPaired;
        paired = std::min(paired, triangles.size());
        (inside ? changed.inside : changed.complement) = std::move(triangles);
        return !isCertain(changed);
      };
      INFO("seed ", seed, " inside ", inside, " triangle ", t, " other ", other);
      Indices triangles = before;
      triangles.erase(triangles.begin() + ptrdiff_t(3 * t),
                      triangles.begin() + ptrdiff_t(3 * t + 3));
      CHECK(refuses(triangles));
      triangles = before;
      triangles.insert(triangles.end(), {before[3 * t], before[3 * t + 1], before[3 * t + 2]});
      CHECK(refuses(triangles));
      triangles = before;
      std::swap(triangles[3 * t], triangles[3 * t + 1]);
      CHECK(refuses(triangles));
      triangles = before;
      if (triangles[3 * t] != other) {
        triangles[3 * t] = other;
        CHECK(refuses(triangles));
      }
    }
  }
}

TEST_CASE("certificate: refused unless rings wind 0 or 1 times, whatever triangles they bound") {
  int refusals = 0;
  for (uint32_t seed = 1; seed <= 3000; ++seed) {
    Random random(seed);
    const Polygon polygon = garbage(1 + random.below(2), 3 + random.below(6), 5, random);
    if (faultsOf(polygon) == kValid) continue;
    const sf::Certificate blank = blankFor(polygon);
    double area = 0;
    for (size_t i = 0; i < blank.rings.size(); i += 2) {
      const sf::Point2 p = blank.at[blank.rings[i]], q = blank.at[blank.rings[i + 1]];
      area += (p.x * q.y - p.y * q.x) / 2;
    }
    const bool windsOnce = std::fabs(area - filledArea(polygon, FillRule::NonZero)) < 1e-9 &&
                           std::fabs(area - filledArea(polygon, FillRule::EvenOdd)) < 1e-9;
    if (windsOnce) continue;  // faults without area: spikes, or edges that run to and fro
    ++refusals;
    INFO("seed ", seed, " ", describe(polygon));
    for (uint32_t apex = 0; apex < polygon.vertexCount() + 4; ++apex) {
      sf::Certificate c = blank;
      fan(c, apex);
      CHECK(!isCertain(c));
    }
  }
  CHECK(refusals > 1500);
}

TEST_CASE("certificate: a ring that winds twice has positive triangles, but no complement") {
  // Around the origin twice: a fan from the origin is positive throughout.
  const Polygon polygon =
      polygonOf({{{4, 0}, {0, 4}, {-4, 0}, {0, -4}, {2, -1}, {1, 2}, {-2, 1}, {-1, -2}}});
  REQUIRE(faultsOf(polygon) != kValid);
  sf::Certificate c = blankFor(polygon);
  const uint32_t n = polygon.vertexCount();
  c.at.insert(c.at.begin() + n, {0, 0});
  c.same.resize(n + 5);
  std::iota(c.same.begin(), c.same.end(), 0);
  fan(c, n);
  for (size_t i = 0; i < c.inside.size(); i += 3)
    CHECK(sf::turn(c.at[c.inside[i]], c.at[c.inside[i + 1]], c.at[c.inside[i + 2]]) > 0);
  CHECK(!isCertain(c));
}

TEST_CASE("certificate: numbers that are not finite, and points taken for one another") {
  bool done = false;
  Random random(5);
  const sf::Certificate c = floodedBothWays(smallPolygon(random), done);
  REQUIRE(done);
  REQUIRE(isCertain(c));
  sf::Certificate changed = c;
  changed.at[1].x = std::numeric_limits<double>::quiet_NaN();
  CHECK(!isCertain(changed));
  changed = c;
  changed.at[1].y = std::numeric_limits<double>::infinity();
  CHECK(!isCertain(changed));
  changed = c;
  changed.same[1] = 0;
  CHECK(!isCertain(changed));
}
