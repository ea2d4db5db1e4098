#include "support/polygon_check.h"

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
  for (const auto method : {sf::PolygonMethod::Flooding, sf::PolygonMethod::Trapezoids}) {
    const std::string name = method == sf::PolygonMethod::Flooding ? "flooding: " : "trapezoids: ";
    sf::PolygonOptions options;
    options.method = method;
    sf::PolygonTriangulation result;
    sf::Work work;
    const sf::Outcome outcome = sf::triangulatePolygon(viewOf(polygon), options, work, result);
    const std::string fault = faultOfOutcome(polygon, faults, outcome);
    if (!fault.empty()) return name + "status " + std::to_string(int(outcome.status)) + " " + fault;
    if (work.used() != 0) return name + "memory is still charged";
    if (!outcome.ok()) continue;
    const std::string wrong = faultOfTriangulation(polygon, result.triangles);
    if (!wrong.empty()) return name + wrong;
  }
  return "";
}

}  // namespace sftest
