#include "support/polygon_check.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sftest {
namespace {

std::string faultOfOutcome(const Polygon& polygon, uint32_t faults, const sf::Outcome& outcome) {
  if (faults == kValid) return outcome.ok() ? "" : "said of a valid polygon";
  if (outcome.ok()) return "accepted a polygon that is " + faultNames(faults);
  if ((faultOfStatus(outcome.status) & faults) == 0)
    return "said of a polygon that is " + faultNames(faults);
  const uint32_t rings = polygon.ringCount();
  const auto sizeOf = [&](uint32_t r) { return polygon.starts[r + 1] - polygon.starts[r]; };
  if (outcome.loop >= rings) return "names no ring";
  const bool isPair = outcome.otherLoop != sf::kNone && outcome.otherVertex != sf::kNone;
  if (outcome.status == sf::Status::SelfIntersecting &&
      (!isPair || outcome.otherLoop != outcome.loop))
    return "does not name two edges of one ring";
  if (!isPair) return "";
  if (outcome.otherLoop >= rings || outcome.vertex >= sizeOf(outcome.loop) ||
      outcome.otherVertex >= sizeOf(outcome.otherLoop))
    return "names no vertex";
  if (!edgesMeet(polygon, polygon.starts[outcome.loop] + outcome.vertex,
                 polygon.starts[outcome.otherLoop] + outcome.otherVertex))
    return "names edges that do not meet";
  return "";
}

/// Whether the strips, in OpenGL's order, hold just the triangles.
std::string faultOfStrips(const sf::PolygonTriangulation& result) {
  using Triangle = std::array<uint32_t, 3>;
  const auto add = [](std::vector<Triangle>& list, uint32_t a, uint32_t b, uint32_t c) {
    Triangle t = {a, b, c};  // the smallest corner first
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    list.push_back(t);
  };
  std::vector<Triangle> triangles, inStrips;
  for (size_t i = 0; i + 2 < result.triangles.size(); i += 3)
    add(triangles, result.triangles[i], result.triangles[i + 1], result.triangles[i + 2]);
  for (size_t s = 0; s + 1 < result.stripStarts.size(); ++s) {
    const uint32_t first = result.stripStarts[s], last = result.stripStarts[s + 1];
    if (last < first + 3 || last > result.strips.size()) return "a strip without triangles";
    for (uint32_t i = first; i + 2 < last; ++i) {
      const uint32_t* v = &result.strips[i];
      if (v[0] == v[1] || v[1] == v[2] || v[0] == v[2]) continue;  // a swap
      const bool odd = (i - first) % 2 == 1;
      add(inStrips, v[odd ? 1 : 0], v[odd ? 0 : 1], v[2]);
    }
  }
  std::sort(triangles.begin(), triangles.end());
  std::sort(inStrips.begin(), inStrips.end());
  return triangles == inStrips ? "" : "strips hold other triangles";
}

}  // namespace

sf::PolygonView viewOf(const Polygon& polygon) { return {polygon.positions, polygon.starts, {}}; }

uint32_t faultOfStatus(sf::Status status) {
  switch (status) {
    case sf::Status::NotFinite:
      return kNotFinite;
    case sf::Status::DegeneratePolygon:
      return kDegenerate;
    case sf::Status::SelfIntersecting:
      return kSelfIntersecting;
    case sf::Status::HoleOutside:
      return kHoleOutside;
    case sf::Status::HolesOverlap:
      return kHolesOverlap;
    case sf::Status::NestedHole:
      return kNestedHole;
    default:
      return 0;
  }
}

std::string faultOfTriangulators(const Polygon& polygon) {
  const uint32_t faults = faultsOf(polygon);
  using sf::PolygonMethod;
  for (const bool thorough : {false, true})
    for (const auto method : {PolygonMethod::Flooding, PolygonMethod::Trapezoids}) {
      sf::PolygonOptions options;
      options.method = method;
      const bool isFlooding = method == PolygonMethod::Flooding;
      if (thorough) (isFlooding ? options.delaunay : options.strips) = options.verify = true;
      const std::string name = isFlooding ? thorough ? "flooding, delaunay, verify: " : "flooding: "
                               : thorough ? "trapezoids, strips, verify: "
                                          : "trapezoids: ";
      sf::PolygonTriangulation result;
      sf::Work work;
      const sf::Outcome outcome = sf::triangulatePolygon(viewOf(polygon), options, work, result);
      const std::string fault = faultOfOutcome(polygon, faults, outcome);
      if (!fault.empty())
        return name + "status " + std::to_string(int(outcome.status)) + " " + fault;
      if (work.used() != 0) return name + "memory is still charged";
      if (!outcome.ok()) continue;
      std::string wrong = faultOfTriangulation(polygon, result.triangles);
      if (wrong.empty() && options.strips) wrong = faultOfStrips(result);
      if (!wrong.empty()) return name + wrong;
    }
  return "";
}

std::string faultOfRepair(const Polygon& polygon, sf::Repair rule) {
  sf::PolygonOptions options;
  options.repair = rule;
  for (const auto method : {sf::PolygonMethod::Flooding, sf::PolygonMethod::Trapezoids}) {
    sf::PolygonTriangulation result;
    sf::Work work;
    options.method = method;
    const sf::Outcome outcome = sf::triangulatePolygon(viewOf(polygon), options, work, result);
    if (work.used() != 0) return "memory is still charged";
    if (!outcome.ok()) return "status " + std::to_string(int(outcome.status));
    std::vector<Ring> triangles;
    const uint32_t n = polygon.vertexCount();
    for (size_t i = 0; i < result.triangles.size(); ++i) {
      const uint32_t v = result.triangles[i];
      if (i % 3 == 0) triangles.emplace_back();
      if (v >= n + result.added.size() / 2) return "an index out of range";
      triangles.back().push_back(
          v < n ? polygon.point(v)
                : Point{result.added[2 * (v - n)], result.added[2 * (v - n) + 1]});
    }
    double extent = 0, area = 0;
    for (const double x : polygon.positions) extent = std::max(extent, std::fabs(x));
    for (const Ring& t : triangles) {
      if (compareAreas(polygonOf({t}), polygonOf({})) < 0) return "a triangle is turned over";
      area += ((t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[1].y - t[0].y) * (t[2].x - t[0].x)) / 2;
    }
    const double wanted =
        filledArea(polygon, rule == sf::Repair::EvenOdd ? FillRule::EvenOdd : FillRule::NonZero);
    if (!(std::fabs(area - wanted) <= 1e-12 * extent * extent * (n + 1)))
      return "area " + std::to_string(area) + " in place of " + std::to_string(wanted);
  }
  return "";
}

}  // namespace sftest
