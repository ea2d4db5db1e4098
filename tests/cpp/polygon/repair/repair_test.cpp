#include "polygon/repair/repair.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "support/polygon_check.h"
#include "support/polygon_families.h"

using namespace sftest;
using sf::Outcome;
using sf::Repair;
using sf::RepairedPolygons;
using sf::RepairLimits;
using sf::Status;
using sf::Work;

namespace {

struct Repaired {
  Outcome outcome;
  RepairedPolygons flat;
  std::vector<Polygon> polygons;
};

Repaired repaired(const Polygon& polygon, Repair rule, RepairLimits limits = {}) {
  Repaired result;
  Work work;
  result.outcome = sf::repairPolygon(viewOf(polygon), rule, work, result.flat, limits);
  CHECK(work.used() == 0);
  if (!result.outcome.ok()) return result;
  const RepairedPolygons& f = result.flat;
  const uint32_t n = polygon.vertexCount();
  for (size_t p = 0; p + 1 < f.polygonStarts.size(); ++p) {
    std::vector<Ring> rings;
    for (uint32_t r = f.polygonStarts[p]; r < f.polygonStarts[p + 1]; ++r) {
      Ring ring;
      for (uint32_t i = f.ringStarts[r]; i < f.ringStarts[r + 1]; ++i) {
        const uint32_t v = f.vertices[i];
        REQUIRE(v < n + f.added.size() / 2);
        ring.push_back(v < n ? polygon.point(v)
                             : Point{f.added[2 * (v - n)], f.added[2 * (v - n) + 1]});
      }
      rings.push_back(ring);
    }
    result.polygons.push_back(polygonOf(rings));
  }
  return result;
}

double doubleArea(const Ring& ring) {
  double sum = 0;
  for (size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i], b = ring[(i + 1) % ring.size()], o = ring[0];
    sum += (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
  }
  return sum;
}
double areaOf(const std::vector<Polygon>& polygons) {
  double sum = 0;
  for (const Polygon& polygon : polygons)
    for (const Ring& ring : ringsOf(polygon)) sum += doubleArea(ring) / 2;
  return sum;
}
/// Whether the polygons have exactly the area of a valid one.
bool sameArea(const Polygon& polygon, const std::vector<Polygon>& parts) {
  std::vector<Ring> turned = ringsOf(polygon), all;
  for (size_t r = 0; r < turned.size(); ++r)
    if ((compareAreas(polygonOf({turned[r]}), polygonOf({Ring{}})) > 0) != (r == 0))
      std::reverse(turned[r].begin(), turned[r].end());
  for (const Polygon& part : parts)
    for (const Ring& ring : ringsOf(part)) all.push_back(ring);
  return compareAreas(polygonOf(turned), polygonOf(all)) == 0;
}
double extentOf(const Polygon& polygon) {
  double extent = 0;
  for (const double x : polygon.positions) extent = std::max(extent, std::fabs(x));
  return extent;
}

/// What is wrong with a result, but for its area; empty if nothing is.
std::string faultOf(const Repaired& result) {
  std::vector<Ring> all;
  for (const Polygon& polygon : result.polygons) {
    if (const uint32_t faults = faultsOf(polygon)) return faultNames(faults);
    const std::vector<Ring> rings = ringsOf(polygon);
    for (size_t r = 0; r < rings.size(); ++r) {
      if ((compareAreas(polygonOf({rings[r]}), polygonOf({Ring{}})) > 0) != (r == 0))
        return "a ring runs the wrong way";
      std::set<std::pair<double, double>> places;
      for (const Point p : rings[r])
        if (!places.insert({p.x, p.y}).second) return "a ring passes a point twice";
    }
    all.insert(all.end(), rings.begin(), rings.end());
  }
  // Disjoint insides: turned about, all rings are holes of one large square and none is at fault,
  // but those inside others: so outer rings are compared pairwise, as holes are.
  double reach = 0;
  for (const Ring& ring : all)
    for (const Point p : ring) reach = std::max({reach, std::fabs(p.x), std::fabs(p.y)});
  const Ring frame = {{-4 * reach, -4 * reach},
                      {4 * reach, -4 * reach},
                      {4 * reach, 4 * reach},
                      {-4 * reach, 4 * reach}};
  std::vector<Ring> framed = {frame};
  framed.insert(framed.end(), all.begin(), all.end());
  if (!all.empty()) {
    const uint32_t faults = faultsOf(scaledBy(polygonOf(framed), 0.125));
    if (faults & ~kNestedHole) return "two polygons: " + faultNames(faults);
  }
  return "";
}

/// Checks a repair of any polygon against the area by slabs.
void checkRepair(const Polygon& polygon, Repair rule, RepairLimits limits = {},
                 double slack = 1e-12) {
  const Repaired result = repaired(polygon, rule, limits);
  CAPTURE(describe(polygon));
  CAPTURE(int(rule));
  REQUIRE(result.outcome.ok());
  CHECK(faultOf(result) == "");
  const double wanted =
      filledArea(polygon, rule == Repair::EvenOdd ? FillRule::EvenOdd : FillRule::NonZero);
  const double extent = extentOf(polygon);
  CHECK(std::fabs(areaOf(result.polygons) - wanted) <=
        slack * extent * extent * polygon.vertexCount());
}

// Kinds of rings that are hard to round; areas are to be right within `slack` of the extent squared.
struct Kind {
  const char* name;
  double slack;
  Polygon (*make)(Random&);
};
const Kind kKinds[] = {
    {"points anywhere", 1e-13,
     [](Random& random) { return garbage(1 + random.below(3), 3 + random.below(20), 0, random); }},
    {"points of a small lattice", 1e-13,
     [](Random& random) {
       return garbage(1 + random.below(4), 3 + random.below(25), 2 + random.below(9), random);
     }},
    {"points of a lattice of ulps", 1e-13,
     [](Random& random) {
       const Polygon polygon =
           garbage(1 + random.below(2), 3 + random.below(15), 2 + random.below(20), random);
       return placed(polygon, 0, 0x1p-52, {1, random.chance(0.5) ? 1.0 : 1.75});
     }},
    {"points on a few lines, turned", 1e-13,
     [](Random& random) {
       const Polygon polygon =
           garbage(1 + random.below(3), 3 + random.below(20), 2 + random.below(4), random);
       return placed(polygon, random.range(0, 7), random.range(0.1, 3),
                     {random.unit(), random.unit()});
     }},
    {"star polygons, all but concurrent", 1e-13,
     [](Random& random) {
       const uint32_t n = 5 + random.below(30), step = 2 + random.below(n / 2 - 1);
       Ring ring;
       for (uint32_t i = 0; i < n; ++i)
         ring.push_back(regularRing(n, 1, {0, 0}, 0.1)[i * step % n]);
       return placed(polygonOf({ring}), random.unit(), 1, {random.range(-9, 9), random.unit()});
     }},
    {"bundles of all but parallel edges", 1e-13,
     [](Random& random) {
       Ring ring;
       for (uint32_t i = 0; i < 4 + random.below(20); ++i) {
         const double far = i % 2;
         ring.push_back({far + 1e-15 * random.below(9), far * 0.7 + 1e-15 * random.below(9)});
       }
       return polygonOf({ring});
     }},
    {"clusters", 1e-13,
     [](Random& random) {
       const Polygon centres = garbage(1, 3 + random.below(3), 0, random);
       Ring ring;
       for (uint32_t i = 0; i < 4 + random.below(25); ++i) {
         const Point c = centres.point(random.below(centres.vertexCount()));
         const double size = std::ldexp(1, -int(random.below(60)));
         ring.push_back({c.x + size * random.unit(), c.y + size * random.unit()});
       }
       return polygonOf({ring});
     }},
    {"rings over one another", 1e-13,
     [](Random& random) {
       std::vector<Ring> rings;
       for (uint32_t i = 0; i < 2 + random.below(4); ++i)
         rings.push_back(
             starRing(5 + random.below(12), random.unit(), random, 1, {0.3 * random.below(3), 0}));
       if (random.chance(0.5)) rings.push_back(rings[0]);
       return rewritten(polygonOf(rings), random);
     }},
    {"polygons with two points swapped", 1e-13,
     [](Random& random) {
       std::vector<Ring> rings = ringsOf(smallPolygon(random));
       Ring& ring = rings[random.below(uint32_t(rings.size()))];
       const uint32_t i = random.below(uint32_t(ring.size()) - 1);
       std::swap(ring[i], ring[i + 1]);
       return polygonOf(rings);
     }},
};

}  // namespace

TEST_CASE("repair: any rings come back valid, with the area of odd or non-zero winding") {
  MESSAGE("seed 61");
  for (const Kind& kind : kKinds) {
    Random random(61);
    INFO("kind ", std::string(kind.name));
    for (int i = 0; i < 50; ++i) {
      const Polygon polygon = kind.make(random);
      for (const Repair rule : {Repair::EvenOdd, Repair::NonZero})
        checkRepair(polygon, rule, {}, kind.slack);
    }
  }
}

TEST_CASE("repair: snap rounding alone leaves no crossing either, on grids of any size") {
  MESSAGE("seed 62");
  for (const Kind& kind : kKinds) {
    Random random(62);
    INFO("kind ", std::string(kind.name));
    for (int i = 0; i < 40; ++i) {
      const Polygon polygon = kind.make(random);
      const int32_t bits = random.chance(0.4) ? 48 : 1 + int32_t(random.below(20));
      const double slack = 1e-13 + 8 * std::ldexp(1, -bits);
      for (const Repair rule : {Repair::EvenOdd, Repair::NonZero})
        checkRepair(polygon, rule, {0, bits}, slack);
    }
  }
}

TEST_CASE("repair: valid polygons keep their vertices and area") {
  MESSAGE("seed 63");
  for (const Family& family : polygonFamilies()) {
    if (family.faults != kValid) continue;
    Random random(63);
    INFO("family ", std::string(family.name));
    for (int i = 0; i < 20; ++i) {
      const Polygon polygon = instanceOf(family, random);
      CAPTURE(describe(polygon));
      for (const Repair rule : {Repair::EvenOdd, Repair::NonZero}) {
        const Repaired result = repaired(polygon, rule);
        REQUIRE(result.outcome.ok());
        CHECK(faultOf(result) == "");
        // Beyond 2^-200 of the rest, coordinates are taken for 0.
        if (std::string(family.name).find("1e-140") != std::string::npos) continue;
        CHECK(result.flat.added.empty());
        CHECK(sameArea(polygon, result.polygons));
        std::set<std::pair<double, double>> before, after;
        for (uint32_t v = 0; v < polygon.vertexCount(); ++v)
          before.insert({polygon.point(v).x, polygon.point(v).y});
        for (const Polygon& p : result.polygons)
          for (uint32_t v = 0; v < p.vertexCount(); ++v) after.insert({p.point(v).x, p.point(v).y});
        CHECK(before == after);
        for (const Polygon& p : result.polygons) {  // once more
          const Repaired again = repaired(p, rule);
          CHECK(again.polygons.size() == 1);
          CHECK(again.flat.added.empty());
          CHECK(again.flat.vertices.size() == p.vertexCount());
        }
      }
    }
  }
}

TEST_CASE("repair: families with faults come back valid, but for coordinates that are no numbers") {
  MESSAGE("seed 64");
  for (const Family& family : polygonFamilies()) {
    if (family.faults == kValid) continue;
    Random random(64);
    INFO("family ", std::string(family.name));
    for (int i = 0; i < 20; ++i) {
      const Polygon polygon = instanceOf(family, random);
      for (const Repair rule : {Repair::EvenOdd, Repair::NonZero}) {
        if (family.faults == kNotFinite) {
          const Repaired result = repaired(polygon, rule);
          CHECK(result.outcome.status == Status::NotFinite);
          CHECK(result.outcome.loop < polygon.ringCount());
        } else {
          checkRepair(polygon, rule);
        }
      }
    }
  }
}

TEST_CASE("repair: added points lie on the two edges that are named") {
  MESSAGE("seed 65");
  Random random(65);
  uint32_t points = 0;
  for (int i = 0; i < 100; ++i) {
    const Polygon polygon = garbage(1 + random.below(2), 3 + random.below(15), 0, random);
    const RepairedPolygons flat = repaired(polygon, Repair::EvenOdd).flat;
    REQUIRE(flat.addedOn.size() == flat.added.size());
    for (size_t a = 0; a < flat.added.size() / 2; ++a, ++points) {
      const Point p = {flat.added[2 * a], flat.added[2 * a + 1]};
      CHECK(flat.addedOn[2 * a] != flat.addedOn[2 * a + 1]);
      for (const uint32_t v : {flat.addedOn[2 * a], flat.addedOn[2 * a + 1]}) {
        const auto end = std::upper_bound(polygon.starts.begin(), polygon.starts.end(), v);
        const Point s = polygon.point(v), t = polygon.point(v + 1 < *end ? v + 1 : *(end - 1));
        const double cross = (t.x - s.x) * (p.y - s.y) - (t.y - s.y) * (p.x - s.x);
        CHECK(std::fabs(cross) < 1e-15);
        CHECK(p.x >= std::min(s.x, t.x));
        CHECK(p.x <= std::max(s.x, t.x));
      }
    }
  }
  CHECK(points > 1000);
}

TEST_CASE("repair: two crossing squares, by either rule") {
  const Polygon polygon =
      polygonOf({{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{2, 2}, {6, 2}, {6, 6}, {2, 6}}});
  // The second ring is a hole: 1 and -1 outside each other, 0 where both are.
  const Repaired evenOdd = repaired(polygon, Repair::EvenOdd),
                 nonZero = repaired(polygon, Repair::NonZero);
  CHECK(areaOf(evenOdd.polygons) == 24);
  CHECK(areaOf(nonZero.polygons) == 24);
  CHECK(evenOdd.polygons.size() == 2);
  CHECK(evenOdd.flat.added == std::vector<double>{4, 2, 2, 4});
  CHECK(evenOdd.flat.addedOn == std::vector<uint32_t>{1, 4, 2, 7});
}

TEST_CASE("repair: a ring run twice adds nothing to an odd winding number, nor any point") {
  const Ring square = {{0, 0}, {4, 0}, {4, 4}, {0, 4}}, across = {{2, 1}, {6, 1}, {6, 2}, {2, 2}};
  const Polygon polygon = polygonOf({square, across, across});
  const Repaired evenOdd = repaired(polygon, Repair::EvenOdd);
  REQUIRE(evenOdd.polygons.size() == 1);
  CHECK(areaOf(evenOdd.polygons) == 16);
  CHECK(evenOdd.flat.added.empty());
  CHECK(evenOdd.flat.vertices == std::vector<uint32_t>{0, 1, 2, 3});
  // -1 where both are, -2 outside the square.
  CHECK(areaOf(repaired(polygon, Repair::NonZero).polygons) == 18);
}

TEST_CASE("repair: limits of memory and stops end it, and nothing stays charged") {
  MESSAGE("seed 66");
  Random random(66);
  const Polygon polygon = garbage(2, 60, 0, random);
  RepairedPolygons flat;
  uint64_t peak;
  {
    Work work;
    CHECK(sf::repairPolygon(viewOf(polygon), Repair::EvenOdd, work, flat).ok());
    peak = work.peak();
  }
  for (uint64_t limit = 0; limit < peak; limit += peak / 50) {
    Work work(limit, nullptr, nullptr);
    const Status status = sf::repairPolygon(viewOf(polygon), Repair::EvenOdd, work, flat).status;
    CHECK((status == Status::OutOfMemory || status == Status::TooLarge));
    CHECK(work.used() == 0);
  }
  for (int calls = 0; calls < 5; ++calls) {
    int left = calls;
    Work work(
        size_t(-1),
        [](void* user, double, double, double) { return --*static_cast<int*>(user) >= 0; }, &left);
    const Status status = sf::repairPolygon(viewOf(polygon), Repair::EvenOdd, work, flat).status;
    CHECK(status == Status::Stopped);
    CHECK(work.used() == 0);
  }
}

TEST_CASE("repair: bad starts are refused") {
  const std::vector<double> positions = {0, 0, 1, 0, 0, 1};
  RepairedPolygons flat;
  for (const std::vector<uint32_t>& starts :
       {std::vector<uint32_t>{}, {1, 3}, {0, 2}, {0, 4}, {0, 3, 2, 3}}) {
    Work work;
    CHECK(sf::repairPolygon({positions, starts, {}}, Repair::EvenOdd, work, flat).status ==
          Status::BadStarts);
  }
}
