#include "polygon/repair.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "support/polygon_families.h"

using namespace sftest;
using sf::Outcome;
using sf::Repair;
using sf::RepairedPolygons;
using sf::RepairLimits;
using sf::Status;
using sf::Work;

namespace {

sf::PolygonView viewOf(const Polygon& polygon) { return {polygon.positions, polygon.starts, {}}; }

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
    const uint32_t faults = faultsOf(polygonOf(framed));
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

}  // namespace

TEST_CASE(
    "repair: garbage comes back valid, with the area of its points of odd or non-zero winding") {
  MESSAGE("seed 61");
  Random random(61);
  uint32_t polygons = 0;
  for (int i = 0; i < 1500; ++i) {
    const uint32_t lattice = random.chance(0.5) ? 2 + random.below(9) : 0;
    const Polygon polygon = garbage(1 + random.below(3), 3 + random.below(20), lattice, random);
    for (const Repair rule : {Repair::EvenOdd, Repair::NonZero})
      checkRepair(polygon, rule), ++polygons;
  }
  CHECK(polygons == 3000);
}
