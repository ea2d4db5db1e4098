// sf_triangulate_polygons: refuses input that has no meaning to the core, calls the core, packs the result.
#include <cstdlib>
#include <memory>

#include "abi/host_work.h"
#include "abi/result.h"
#include "polygon/batch.h"

namespace {

SF_TIE(isTied, sf::PolygonMethod, SF_METHOD_CHOICES)
SF_TIE(isTied, sf::Repair, SF_REPAIR_CHOICES)
SF_TIE(isTied, sf::FloodAction, SF_FLOOD_ACTION_CHOICES)

// Lists of the core's structs become result arrays as they are, so their layouts must agree.
static_assert(sizeof(sf::FloodStep) == sizeof(SfFloodStep) &&
              offsetof(sf::FloodStep, action) == offsetof(SfFloodStep, action) &&
              offsetof(sf::FloodStep, left) == offsetof(SfFloodStep, left) &&
              offsetof(sf::FloodStep, right) == offsetof(SfFloodStep, right) &&
              offsetof(sf::FloodStep, triangles) == offsetof(SfFloodStep, triangles));
constexpr size_t inFault(size_t inOutcome) {
  return offsetof(sf::PolygonFault, outcome) + inOutcome;
}
static_assert(sizeof(sf::PolygonFault) == sizeof(SfPolygonFault) &&
              offsetof(sf::PolygonFault, polygon) == offsetof(SfPolygonFault, polygon) &&
              inFault(offsetof(sf::Outcome, status)) == offsetof(SfPolygonFault, status) &&
              inFault(offsetof(sf::Outcome, loop)) == offsetof(SfPolygonFault, loop) &&
              inFault(offsetof(sf::Outcome, vertex)) == offsetof(SfPolygonFault, vertex) &&
              inFault(offsetof(sf::Outcome, otherLoop)) == offsetof(SfPolygonFault, otherLoop) &&
              inFault(offsetof(sf::Outcome, otherVertex)) == offsetof(SfPolygonFault, otherVertex));

/// The triangulator is kept for the next call if it has held no more than this many vertices.
constexpr uint32_t kMostKept = 1u << 16;

/// The least number of bytes for each vertex that the triangulation of a large polygon takes.
constexpr size_t kLeastPerVertex = 160;

SfResult* pack(sf::FlatTriangulation&& found) {
  auto* result = new SfResult(SfPolygonArrayCount);
  result->put<SfPolygon_triangles>(std::move(found.triangles));
  result->put<SfPolygon_triangleStarts>(std::move(found.triangleStarts));
  result->put<SfPolygon_strips>(std::move(found.strips));
  result->put<SfPolygon_stripStarts>(std::move(found.stripStarts));
  result->put<SfPolygon_polygonStrips>(std::move(found.polygonStrips));
  result->put<SfPolygon_added>(std::move(found.added));
  result->put<SfPolygon_addedOn>(std::move(found.addedOn));
  result->put<SfPolygon_trace>(std::move(found.trace));
  result->put<SfPolygon_faults>(std::move(found.faults));
  result->put<SfPolygon_faultPoints>(std::move(found.faultPoints));
  return result;
}

sf::Status checkSettings(const SfPolygonSettings& settings) {
  const bool fits = sf::isChoice(settings.dimension - 2, 2) &&
                    sf::isChoice(settings.method, SF_COUNT(SF_METHOD_CHOICES)) &&
                    sf::isChoice(settings.repair, SF_COUNT(SF_REPAIR_CHOICES)) &&
                    sf::isChoice(settings.delaunay, 2) && sf::isChoice(settings.strips, 2) &&
                    sf::isChoice(settings.verify, 2) && sf::isChoice(settings.trace, 2) &&
                    settings.maxBytes >= 0;
  return fits ? sf::Status::Ok : sf::Status::BadOption;
}

sf::PolygonOptions optionsOf(const SfPolygonSettings& settings) {
  sf::PolygonOptions options;
  options.method = sf::PolygonMethod(int(settings.method));
  options.repair = sf::Repair(int(settings.repair));
  options.delaunay = settings.delaunay == 1;
  options.strips = settings.strips == 1;
  options.verify = settings.verify == 1;
  options.trace = settings.trace == 1;
  return options;
}

sf::Outcome check(const uint32_t* ringStarts, uint32_t ringCount, const uint32_t* polygonStarts,
                  uint32_t polygonCount, uint32_t pointCount, const sf::PolygonOptions& options) {
  if (!sf::isRising(ringStarts, ringCount) || !sf::isRising(polygonStarts, polygonCount) ||
      polygonStarts[polygonCount] != ringCount)
    return {sf::Status::BadStarts};
  const bool several = polygonCount != 1;
  if (pointCount > 0 && (several || options.repair != sf::Repair::None))
    return {sf::Status::BadOption};
  if (options.trace && (several || options.method != sf::PolygonMethod::Flooding))
    return {sf::Status::BadOption};
  // Indices of corners must stay below 2^32.
  if (uint64_t(ringStarts[ringCount]) + pointCount >= 1u << 29) return {sf::Status::TooLarge};
  return {};
}

/// Grows the memory by `bytes` at once, if so many are allowed, and not list by list. Hosts collect their
/// garbage each time it grows, which takes longer than a large polygon.
void growOnce(double bytes, double maxBytes) {
  if (bytes > maxBytes || bytes >= 0x1p31) return;
  void* volatile block = std::malloc(size_t(bytes));  // volatile, or compilers drop both calls
  std::free(block);
}

std::unique_ptr<sf::PolygonTriangulator>& keptTriangulator() {
  static std::unique_ptr<sf::PolygonTriangulator> kept;
  return kept;
}

}  // namespace

extern "C" SfStatus sf_triangulate_polygons(const double* positions, const uint32_t* ringStarts,
                                            uint32_t ringCount, const uint32_t* polygonStarts,
                                            uint32_t polygonCount, const double* points,
                                            uint32_t pointCount, const SfPolygonSettings* settings,
                                            SfPlace* where, SfResult** result) {
  *result = nullptr;
  sf::Outcome outcome{checkSettings(*settings)};
  if (!outcome.ok()) return sf::endWith(outcome, where);
  const sf::PolygonOptions options = optionsOf(*settings);
  outcome = check(ringStarts, ringCount, polygonStarts, polygonCount, pointCount, options);
  if (!outcome.ok()) return sf::endWith(outcome, where);

  const uint32_t dimension = uint32_t(settings->dimension);
  const size_t n = ringStarts[ringCount];
  sf::Work work = sf::hostWork(settings->maxBytes);
  const bool isLarge = n + pointCount > kMostKept;
  if (isLarge && polygonCount == 1)
    growOnce(double(kLeastPerVertex) * double(n + pointCount), settings->maxBytes);
  auto& triangulator = keptTriangulator();
  if (!triangulator) triangulator = std::make_unique<sf::PolygonTriangulator>();
  sf::FlatTriangulation found;
  outcome = sf::triangulateAll({dimension,
                                {positions, dimension * n},
                                {ringStarts, size_t(ringCount) + 1},
                                {polygonStarts, size_t(polygonCount) + 1},
                                {points, dimension * size_t(pointCount)}},
                               options, *triangulator, work, found);
  if (outcome.ok()) *result = pack(std::move(found));
  if (isLarge) triangulator.reset();
  return sf::endWith(outcome, where);
}
