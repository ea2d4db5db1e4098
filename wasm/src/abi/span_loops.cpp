// sf_span_loops: refuses input that has no meaning to the core, calls the core, packs the result.
#include "abi/host_work.h"
#include "abi/result.h"
#include "loops/span.h"

namespace {

static_assert(sizeof(sf::Vec3) == 3 * sizeof(double), "positions are read as Vec3");
SF_TIE(isTied, sf::Space, SF_SPACE_CHOICES)
SF_TIE(isTied, sf::Objective, SF_OBJECTIVE_CHOICES)

sf::Outcome checkStarts(const uint32_t* starts, uint32_t loopCount) {
  if (loopCount == 0) return {sf::Status::NoLoops};
  if (starts[0] != 0) return {sf::Status::BadStarts, 0};
  for (uint32_t c = 0; c < loopCount; ++c)
    if (starts[c + 1] < starts[c]) return {sf::Status::BadStarts, c};
  // Vertex numbers share words with flags (loops/domains/domain.h).
  if (starts[loopCount] >= 1u << 30) return {sf::Status::TooLarge};
  return {};
}

SfResult* pack(sf::Span&& span, size_t peakBytes) {
  SfSpanNumbers numbers{};
  numbers.found = span.found;
  numbers.space = double(span.space);
  numbers.cost = span.cost;
  numbers.lowerBound = span.lowerBound;
  numbers.optimal = span.optimal;
  numbers.area = span.terms.area;
  numbers.perimeter = span.terms.perimeter;
  numbers.dihedral = span.terms.dihedral;
  numbers.worstDihedral = span.terms.worstDihedral;
  numbers.own = span.terms.own;
  numbers.candidates = double(span.candidates);
  numbers.domains = double(span.domains);
  numbers.minimalSets = double(span.minimalSets);
  numbers.peakBytes = double(peakBytes);
  std::vector<SfInsertedPlace> places;
  std::vector<double> parameters;
  for (const sf::InsertedVertex& v : span.inserted) {
    places.push_back({v.loop, v.edge});
    parameters.push_back(v.parameter);
  }
  auto* result = new SfResult(SfSpanArrayCount);
  result->put<SfSpan_positions>(std::move(span.positions));
  result->put<SfSpan_triangles>(std::move(span.triangles));
  result->put<SfSpan_order>(std::move(span.order));
  result->put<SfSpan_starts>(std::move(span.starts));
  result->put<SfSpan_loopVertices>(std::move(span.loopVertices));
  result->put<SfSpan_numbers>(std::vector<SfSpanNumbers>{numbers});
  result->put<SfSpan_insertedPlaces>(std::move(places));
  result->put<SfSpan_insertedParameters>(std::move(parameters));
  return result;
}

void tellHost(void* user, const sf::Span& best) {
  SfResult* result = pack(sf::Span(best), static_cast<const sf::Work*>(user)->peak());
  sf_host_result(result);
  sf_result_free(result);
}

sf::Outcome checkSettings(const SfSpanSettings& settings) {
  const bool fits = sf::isChoice(settings.objective, SF_COUNT(SF_OBJECTIVE_CHOICES)) &&
                    sf::isChoice(settings.space, SF_COUNT(SF_SPACE_CHOICES)) &&
                    settings.maxBytes >= 0 && sf::isChoice(settings.bestSoFar, 2);
  return {fits ? sf::Status::Ok : sf::Status::BadOption};
}

}  // namespace

extern "C" SfStatus sf_span_loops(const double* positions, const uint32_t* starts,
                                  uint32_t loopCount, const double* boundaryNormals,
                                  const uint32_t* triangles, uint32_t triangleCount,
                                  const double* triangleWeights, const uint32_t* start,
                                  uint32_t startCount, const SfSpanSettings* settings,
                                  SfPlace* where, SfResult** result) {
  *result = nullptr;
  sf::Outcome outcome = checkStarts(starts, loopCount);
  if (outcome.ok()) outcome = checkSettings(*settings);
  // Counts of vertex numbers, three times as large, must stay below 2^32.
  if (outcome.ok() && (triangleCount >= 1u << 30 || startCount >= 1u << 30))
    outcome = {sf::Status::TooLarge};
  if (!outcome.ok()) return sf::endWith(outcome, where);

  const size_t n = starts[loopCount];
  sf::SpanOptions options;
  options.areaWeight = settings->areaWeight;
  options.perimeterWeight = settings->perimeterWeight;
  options.dihedralWeight = settings->dihedralWeight;
  options.objective = sf::Objective(int(settings->objective));
  options.space = sf::Space(int(settings->space));
  if (boundaryNormals) options.boundaryNormals = {boundaryNormals, 3 * n};
  if (triangles) options.triangles = {triangles, 3 * size_t(triangleCount)};
  if (triangleWeights) options.triangleWeights = {triangleWeights, triangleCount};
  if (start) options.start = {start, 3 * size_t(startCount)};
  options.bestSoFar = settings->bestSoFar == 1;
  sf::Work work = sf::hostWork(settings->maxBytes);
  options.onBest = tellHost;
  options.user = &work;
  const sf::LoopSet loops({reinterpret_cast<const sf::Vec3*>(positions), n},
                          {starts, size_t(loopCount) + 1});
  sf::Span span;
  outcome = sf::spanLoops(loops, options, work, span);
  if (outcome.ok()) {
    if (!span.found) outcome.status = sf::Status::NotFound;
    *result = pack(std::move(span), work.peak());
  }
  return sf::endWith(outcome, where);
}
