// sf_smooth_surface: refuses input that has no meaning to the core, calls the core, packs the result.
#include "mesh/smooth_surface.h"

#include "abi/host_work.h"
#include "abi/mesh_input.h"
#include "abi/result.h"

namespace {

SF_TIE(isTied, sf::SurfaceKind, SF_SURFACE_KIND_CHOICES)

bool isAllowed(const SfSmoothSettings& s, const double* normals) {
  return sf::isChoice(s.kind, SF_COUNT(SF_SURFACE_KIND_CHOICES)) && s.density >= 0 &&
         s.density < 1e6 && s.maxNewVertices >= 0 && s.maxBytes >= 0 &&
         (!normals || s.kind != double(sf::SurfaceKind::SoapFilm));
}

}  // namespace

extern "C" SfStatus sf_smooth_surface(const double* positions, uint32_t vertexCount,
                                      const uint32_t* triangles, uint32_t triangleCount,
                                      const uint32_t* fixed, uint32_t fixedCount,
                                      const double* boundaryNormals, uint32_t normalCount,
                                      const SfSmoothSettings* settings, SfPlace* where,
                                      SfResult** result) {
  *result = nullptr;
  if (!isAllowed(*settings, boundaryNormals)) return sf::endWith({sf::Status::BadOption}, where);
  sf::MeshView mesh;
  sf::Outcome outcome = sf::viewMesh(positions, vertexCount, triangles, triangleCount, mesh);
  if (outcome.ok() && normalCount >= 1u << 30) outcome = {sf::Status::TooLarge};
  if (!outcome.ok()) return sf::endWith(outcome, where);
  sf::SmoothOptions options;
  options.kind = sf::SurfaceKind(int(settings->kind));
  options.refining.density = settings->density;
  options.refining.maxNewVertices = sf::vertexLimit(settings->maxNewVertices);
  if (fixed) options.fixed = {fixed, fixedCount};
  options.isClamped = boundaryNormals != nullptr;
  if (boundaryNormals) options.boundaryNormals = {boundaryNormals, 3 * size_t(normalCount)};
  sf::Work work = sf::hostWork(settings->maxBytes);
  sf::SmoothSurface smooth;
  outcome = sf::smoothSurface(mesh, options, work, smooth);
  if (outcome.ok()) {
    *result = new SfResult(SfSmoothArrayCount);
    (*result)->put<SfSmooth_positions>(std::move(smooth.positions));
    (*result)->put<SfSmooth_triangles>(std::move(smooth.triangles));
    (*result)->put<SfSmooth_boundary>(std::move(smooth.boundary));
    (*result)->put<SfSmooth_fixed>(std::move(smooth.fixed));
    (*result)->put<SfSmooth_collapsed>(std::move(smooth.collapsed));
    (*result)->put<SfSmooth_numbers>(
        std::vector<SfSmoothNumbers>{{smooth.area, double(smooth.isMinimal)}});
  }
  return sf::endWith(outcome, where);
}
