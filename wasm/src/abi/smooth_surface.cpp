// sf_smooth_surface: refuses input that has no meaning to the core, calls the core, packs the result.
#include "mesh/smooth_surface.h"

#include "abi/host_work.h"
#include "abi/result.h"
#include "mesh/adjacency.h"

namespace {

SF_TIE(isTied, sf::SurfaceKind, SF_SURFACE_KIND_CHOICES)

sf::Outcome check(const sf::MeshView& mesh, const SfSmoothSettings& s) {
  const bool isAllowed = sf::isChoice(s.kind, SF_COUNT(SF_SURFACE_KIND_CHOICES)) &&
                         s.density >= 0 && s.density < 1e6 && s.maxNewVertices >= 0 &&
                         s.maxBytes >= 0;
  if (!isAllowed) return {sf::Status::BadOption};
  const sf::MeshFault fault = sf::checkMesh(mesh);
  if (fault.vertex != sf::kNone) return {sf::Status::NotFinite, sf::kNone, fault.vertex};
  if (fault.face != sf::kNone) return {sf::Status::BadMesh, sf::kNone, fault.face};
  return {};
}

}  // namespace

extern "C" SfStatus sf_smooth_surface(const double* positions, uint32_t vertexCount,
                                      const uint32_t* triangles, uint32_t triangleCount,
                                      const SfSmoothSettings* settings, SfPlace* where,
                                      SfResult** result) {
  *result = nullptr;
  if (triangleCount >= 1u << 30 || vertexCount >= 1u << 30)
    return sf::endWith({sf::Status::TooLarge}, where);
  const sf::MeshView mesh{{positions, 3 * size_t(vertexCount)},
                          {triangles, 3 * size_t(triangleCount)}};
  sf::Outcome outcome = check(mesh, *settings);
  if (!outcome.ok()) return sf::endWith(outcome, where);
  sf::SmoothOptions options;
  options.kind = sf::SurfaceKind(int(settings->kind));
  options.density = settings->density;
  options.maxNewVertices =
      settings->maxNewVertices < 4294967295.0 ? uint32_t(settings->maxNewVertices) : sf::kNone;
  sf::Work work = sf::hostWork(settings->maxBytes);
  sf::SmoothSurface smooth;
  outcome = sf::smoothSurface(mesh, options, work, smooth);
  if (outcome.ok()) {
    *result = new SfResult(SfSmoothArrayCount);
    (*result)->put<SfSmooth_positions>(std::move(smooth.positions));
    (*result)->put<SfSmooth_triangles>(std::move(smooth.triangles));
    (*result)->put<SfSmooth_boundary>(std::move(smooth.boundary));
    (*result)->put<SfSmooth_collapsed>(std::move(smooth.collapsed));
    (*result)->put<SfSmooth_numbers>(
        std::vector<SfSmoothNumbers>{{smooth.area, double(smooth.isMinimal)}});
  }
  return sf::endWith(outcome, where);
}
