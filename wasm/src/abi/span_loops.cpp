// sf_span_loops: validates what has no meaning to the core, calls it, hands back.
#include "abi/host_work.h"
#include "abi/result.h"
#include "loops/span.h"

namespace {

static_assert(sizeof(sf::Vec3) == 3 * sizeof(double), "positions are read as Vec3");

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
  auto* result = new SfResult;
  std::vector<double> numbers{
      double(span.found),       double(span.space),      span.cost,
      span.lowerBound,          double(span.optimal),    span.terms.area,
      span.terms.perimeter,     span.terms.dihedral,     span.terms.worstDihedral,
      span.terms.own,           double(span.candidates), double(span.domains),
      double(span.minimalSets), double(peakBytes)};
  std::vector<uint32_t> insertedPlaces;
  std::vector<double> insertedParameters;
  for (const sf::InsertedVertex& v : span.inserted) {
    insertedPlaces.push_back(v.loop);
    insertedPlaces.push_back(v.edge);
    insertedParameters.push_back(v.parameter);
  }
  result->add(std::move(span.positions), 3);
  result->add(std::move(span.triangles));
  result->add(std::move(span.order));
  result->add(std::move(span.starts));
  result->add(std::move(span.loopVertices));
  result->add(std::move(numbers));
  result->add(std::move(insertedPlaces));
  result->add(std::move(insertedParameters));
  return result;
}

void tellHost(void* user, const sf::Span& best) {
  SfResult* result = pack(sf::Span(best), static_cast<const sf::Work*>(user)->peak());
  sf_host_result(result);
  sf_result_free(result);
}

}  // namespace

extern "C" SfStatus sf_span_loops(const double* positions, const uint32_t* starts,
                                  uint32_t loopCount, const double* boundaryNormals,
                                  const uint32_t* triangles, uint32_t triangleCount,
                                  const double* triangleWeights, const uint32_t* start,
                                  uint32_t startCount, const double* settings, uint32_t* where,
                                  SfResult** result) {
  *result = nullptr;
  sf::Outcome outcome = checkStarts(starts, loopCount);
  const double maxBytes = settings[5];
  if (outcome.ok() && (!sf::isChoice(settings[3], 1) || !sf::isChoice(settings[4], 4) ||
                       !(maxBytes >= 0) || !sf::isChoice(settings[6], 1)))
    outcome = {sf::Status::BadOption};
  if (outcome.ok()) {
    const size_t n = starts[loopCount];
    sf::SpanOptions options;
    options.areaWeight = settings[0];
    options.perimeterWeight = settings[1];
    options.dihedralWeight = settings[2];
    options.objective = sf::Objective(int(settings[3]));
    options.space = sf::Space(int(settings[4]));
    if (boundaryNormals) options.boundaryNormals = {boundaryNormals, 3 * n};
    if (triangles) options.triangles = {triangles, 3 * size_t(triangleCount)};
    if (triangleWeights) options.triangleWeights = {triangleWeights, triangleCount};
    if (start) options.start = {start, 3 * size_t(startCount)};
    options.bestSoFar = settings[6] == 1;
    sf::Work work = sf::hostWork(maxBytes);
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
  }
  sf::tellWhere(outcome, where);
  return SfStatus(outcome.status);
}
