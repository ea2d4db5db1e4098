// sf_open_surfaces, sf_tessellate_surfaces, sf_close_surfaces: refuse input that has no meaning to the core, call it, pack the
// results.
#include "abi/host_work.h"
#include "abi/kept.h"
#include "abi/result.h"
#include "surface/trimmed_surfaces.h"

namespace {

SF_TIE(isTied, sf::SurfaceFault, SF_SURFACE_FAULT_CHOICES)
SF_TIE(isTied, sf::SurfaceReport, SF_SURFACE_REPORT_CHOICES)

/// A model that is kept.
struct OpenSurfaces {
  std::unique_ptr<sf::TrimmedSurfaces> surfaces;
  uint64_t bytes = 0;
};

sf::Kept<OpenSurfaces>& openSurfaces() {
  static sf::Kept<OpenSurfaces> all;
  return all;
}

bool isValid(const SfSamplingSettings& s) {
  if (!(s.tolerance > 0 && s.angle > 0 && s.aspect >= 1 && s.maxTriangles >= 0 &&
        s.maxSeconds >= 0 && sf::isChoice(s.hasCamera, 2)))
    return false;
  if (s.hasCamera == 0) return std::isfinite(s.tolerance);
  for (const double* m = &s.m0; m <= &s.m15; ++m)
    if (!std::isfinite(*m)) return false;
  return s.width > 0 && s.height > 0 && s.pixels > 0;
}

sf::Camera cameraOf(const SfSamplingSettings& s) {
  sf::Camera camera{};
  std::copy(&s.m0, &s.m0 + 16, camera.matrix);
  camera.width = s.width, camera.height = s.height;
  return camera;
}

SfResult* pack(sf::Tessellation&& mesh) {
  auto* result = new SfResult(SfTessellationArrayCount);
  result->put<SfTessellation_positions>(std::move(mesh.positions));
  result->put<SfTessellation_normals>(std::move(mesh.normals));
  result->put<SfTessellation_uvs>(std::move(mesh.uvs));
  result->put<SfTessellation_triangles>(std::move(mesh.triangles));
  result->put<SfTessellation_faceStarts>(std::move(mesh.faceStarts));
  result->put<SfTessellation_strips>(std::move(mesh.strips));
  result->put<SfTessellation_stripStarts>(std::move(mesh.stripStarts));
  result->put<SfTessellation_edges>(std::move(mesh.edges));
  result->put<SfTessellation_edgeStarts>(std::move(mesh.edgeStarts));
  result->put<SfTessellation_same>(std::move(mesh.same));
  std::vector<SfSurfaceReport> reports;
  const auto number = [](uint32_t n) { return n == sf::kNone ? -1 : double(n); };
  for (const sf::Report& r : mesh.reports)
    reports.push_back({double(r.report), number(r.face), number(r.fault), r.value});
  result->put<SfTessellation_reports>(std::move(reports));
  const sf::Vec3 o = mesh.origin;
  result->put<SfTessellation_numbers>(
      std::vector<SfTessellationNumbers>{{o.x, o.y, o.z, mesh.deviation, mesh.tolerance}});
  return result;
}

}  // namespace

extern "C" SfStatus sf_open_surfaces(const uint32_t* shape, uint32_t shapeLength,
                                     const double* numbers, uint32_t numberLength, double maxBytes,
                                     SfPlace* where, SfResult** result) {
  *result = nullptr;
  if (!(maxBytes >= 0)) return sf::endWith({sf::Status::BadOption}, where);
  sf::Work work = sf::hostWork(maxBytes);
  sf::Charge charge(work);
  sf::Model model;
  std::vector<sf::ModelFault> faults;
  auto opened = std::make_unique<OpenSurfaces>();
  if (sf::readModel({{shape, shapeLength}, {numbers, numberLength}}, work, charge, model, faults))
    opened->surfaces = sf::TrimmedSurfaces::open(std::move(model), work, charge, faults);
  if (!opened->surfaces)
    return sf::endWith({work.going() ? sf::Status::BadOption : work.status()}, where);
  opened->bytes = charge.bytes();
  const sf::Model& read = opened->surfaces->model();
  std::vector<SfFaceFault> named;
  for (const sf::ModelFault& f : faults)
    named.push_back({uint32_t(f.fault), f.face, f.loop, f.use, f.otherLoop, f.edge});
  *result = new SfResult(SfSurfacesArrayCount);
  const sf::Vec3 low = read.least, high = read.greatest;
  (*result)->put<SfSurfaces_box>(std::vector<double>{low.x, low.y, low.z, high.x, high.y, high.z});
  (*result)->put<SfSurfaces_faults>(std::move(named));
  (*result)->put<SfSurfaces_session>(std::vector<uint32_t>{openSurfaces().keep(std::move(opened))});
  return sf::endWith({}, where);
}

extern "C" SfStatus sf_tessellate_surfaces(uint32_t session, const SfSamplingSettings* settings,
                                           double maxBytes, SfPlace* where, SfResult** result) {
  *result = nullptr;
  OpenSurfaces* opened = openSurfaces().find(session);
  if (!opened || !(maxBytes >= 0) || !isValid(*settings))
    return sf::endWith({sf::Status::BadOption}, where);
  sf::Work work = sf::hostWork(maxBytes);
  sf::Charge held(work);
  if (!held.add(opened->bytes)) return sf::endWith({work.status()}, where);
  const sf::Camera camera = cameraOf(*settings);
  sf::Sampling sampling;
  sampling.tolerance = settings->tolerance, sampling.angle = settings->angle;
  sampling.aspect = settings->aspect, sampling.pixels = settings->pixels;
  if (settings->hasCamera == 1) sampling.camera = &camera;
  sf::Tessellation mesh;
  const sf::TessellationLimits limits{settings->maxTriangles, settings->maxSeconds,
                                      sf_host_seconds};
  if (!opened->surfaces->tessellate(sampling, limits, work, mesh))
    return sf::endWith({work.status()}, where);
  *result = pack(std::move(mesh));
  return sf::endWith({}, where);
}

extern "C" SfStatus sf_close_surfaces(uint32_t session) {
  openSurfaces().drop(session);
  return SfStatus(sf::Status::Ok);
}
