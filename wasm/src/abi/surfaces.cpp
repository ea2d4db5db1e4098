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

std::vector<SfSurfaceReport> pack(const std::vector<sf::Report>& reports) {
  std::vector<SfSurfaceReport> packed;
  const auto number = [](uint32_t n) { return n == sf::kNone ? -1 : double(n); };
  for (const sf::Report& r : reports)
    packed.push_back({double(r.report), number(r.face), number(r.fault), r.value});
  return packed;
}

std::vector<SfTessellationNumbers> numbersOf(const sf::Tessellation& mesh) {
  const sf::Vec3 o = mesh.origin;
  return {{o.x, o.y, o.z, mesh.deviation, mesh.tolerance}};
}

std::vector<SfFaceFault> pack(const std::vector<sf::ModelFault>& faults) {
  std::vector<SfFaceFault> packed;
  for (const sf::ModelFault& f : faults)
    packed.push_back({uint32_t(f.fault), f.face, f.loop, f.use, f.otherLoop, f.edge});
  return packed;
}

SfResult* packWhole(const sf::MeshLayout& layout, sf::Tessellation&& mesh) {
  auto* result = new SfResult(SfTessellationArrayCount);
  result->put<SfTessellation_positions>(std::vector<float>(layout.positions));
  result->put<SfTessellation_normals>(std::vector<float>(layout.normals));
  result->put<SfTessellation_uvs>(std::vector<float>(layout.uvs));
  result->put<SfTessellation_triangles>(std::vector<uint32_t>(layout.triangles));
  result->put<SfTessellation_faceStarts>(std::vector<uint32_t>(layout.faceStarts));
  result->put<SfTessellation_strips>(std::vector<uint32_t>(layout.strips));
  result->put<SfTessellation_stripStarts>(std::vector<uint32_t>(layout.stripStarts));
  result->put<SfTessellation_edges>(std::move(mesh.edges));
  result->put<SfTessellation_edgeStarts>(std::move(mesh.edgeStarts));
  result->put<SfTessellation_same>(std::move(mesh.same));
  result->put<SfTessellation_reports>(pack(mesh.reports));
  result->put<SfTessellation_numbers>(numbersOf(mesh));
  return result;
}

/// The elements within ranges, `width` to each.
template <class T>
std::vector<T> within(const std::vector<T>& all, const std::vector<uint32_t>& ranges,
                      size_t width) {
  std::vector<T> part;
  for (size_t i = 0; i < ranges.size(); i += 2)
    part.insert(part.end(), all.begin() + ptrdiff_t(width * ranges[i]),
                all.begin() + ptrdiff_t(width * ranges[i + 1]));
  return part;
}

SfResult* packChange(const sf::MeshLayout& layout, sf::Tessellation&& mesh) {
  auto* result = new SfResult(SfChangeArrayCount);
  result->put<SfChange_vertexRanges>(std::vector<uint32_t>(layout.vertexRanges));
  result->put<SfChange_positions>(within(layout.positions, layout.vertexRanges, 3));
  result->put<SfChange_normals>(within(layout.normals, layout.vertexRanges, 3));
  result->put<SfChange_uvs>(within(layout.uvs, layout.vertexRanges, 2));
  result->put<SfChange_indexRanges>(std::vector<uint32_t>(layout.indexRanges));
  result->put<SfChange_triangles>(within(layout.triangles, layout.indexRanges, 1));
  result->put<SfChange_stripRanges>(std::vector<uint32_t>(layout.stripRanges));
  result->put<SfChange_strips>(within(layout.strips, layout.stripRanges, 1));
  result->put<SfChange_faces>(std::move(mesh.faces));
  result->put<SfChange_sizes>(std::vector<uint32_t>{uint32_t(layout.positions.size() / 3),
                                                    uint32_t(layout.triangles.size()),
                                                    uint32_t(layout.strips.size())});
  result->put<SfChange_faceStarts>(std::vector<uint32_t>(layout.faceStarts));
  result->put<SfChange_stripStarts>(std::vector<uint32_t>(layout.stripStarts));
  result->put<SfChange_edges>(std::move(mesh.edges));
  result->put<SfChange_edgeStarts>(std::move(mesh.edgeStarts));
  result->put<SfChange_same>(std::move(mesh.same));
  result->put<SfChange_reports>(pack(mesh.reports));
  result->put<SfChange_numbers>(numbersOf(mesh));
  return result;
}

/// Tessellates or updates.
SfStatus mesh(uint32_t session, const SfSamplingSettings& settings, bool updates, double maxBytes,
              SfPlace* where, SfResult** result) {
  *result = nullptr;
  OpenSurfaces* opened = openSurfaces().find(session);
  if (!opened || !(maxBytes >= 0) || !isValid(settings))
    return sf::endWith({sf::Status::BadOption}, where);
  sf::Work work = sf::hostWork(maxBytes);
  sf::Charge held(work);
  if (!held.add(opened->bytes)) return sf::endWith({work.status()}, where);
  const sf::Camera camera = cameraOf(settings);
  sf::Sampling sampling;
  sampling.tolerance = settings.tolerance, sampling.angle = settings.angle;
  sampling.aspect = settings.aspect;
  if (settings.hasCamera == 1) {
    sampling.camera = &camera, sampling.pixels = settings.pixels;
    if (updates) sampling.hysteresis = 0.8;
  }
  sf::Tessellation found;
  const sf::TessellationLimits limits{settings.maxTriangles, settings.maxSeconds, sf_host_seconds};
  sf::TrimmedSurfaces& surfaces = *opened->surfaces;
  if (!(updates ? surfaces.update(sampling, limits, work, found)
                : surfaces.tessellate(sampling, limits, work, found)))
    return sf::endWith({work.status()}, where);
  *result = updates ? packChange(surfaces.layout(), std::move(found))
                    : packWhole(surfaces.layout(), std::move(found));
  return sf::endWith({}, where);
}

/// The end of a move.
SfStatus moved(bool isDone, const sf::ModelFault& fault, sf::Work& work, SfPlace* where,
               SfResult** result) {
  if (!work.going()) return sf::endWith({work.status()}, where);
  *result = new SfResult(SfMoveArrayCount);
  if (!isDone) (*result)->put<SfMove_faults>(pack(std::vector<sf::ModelFault>{fault}));
  return sf::endWith({}, where);
}

bool isAccepted(double x) { return std::fabs(x) <= sf::kLargestCoordinate; }

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
  *result = new SfResult(SfSurfacesArrayCount);
  const sf::Vec3 low = read.least, high = read.greatest;
  (*result)->put<SfSurfaces_box>(std::vector<double>{low.x, low.y, low.z, high.x, high.y, high.z});
  (*result)->put<SfSurfaces_faults>(pack(faults));
  (*result)->put<SfSurfaces_session>(std::vector<uint32_t>{openSurfaces().keep(std::move(opened))});
  return sf::endWith({}, where);
}

extern "C" SfStatus sf_tessellate_surfaces(uint32_t session, const SfSamplingSettings* settings,
                                           double maxBytes, SfPlace* where, SfResult** result) {
  return mesh(session, *settings, false, maxBytes, where, result);
}

extern "C" SfStatus sf_update_surfaces(uint32_t session, const SfSamplingSettings* settings,
                                       double maxBytes, SfPlace* where, SfResult** result) {
  return mesh(session, *settings, true, maxBytes, where, result);
}

extern "C" SfStatus sf_move_pole(uint32_t session, uint32_t face, uint32_t pole, double x, double y,
                                 double z, double weight, double maxBytes, SfPlace* where,
                                 SfResult** result) {
  *result = nullptr;
  OpenSurfaces* opened = openSurfaces().find(session);
  const auto isThere = [&] {
    const sf::Model& model = opened->surfaces->model();
    return face < model.faces.size() && !model.faces[face].isLeftOut &&
           pole < model.faces[face].arrays.poles.size() / 3;
  };
  if (!opened || !(maxBytes >= 0) || !isThere() || !isAccepted(x) || !isAccepted(y) ||
      !isAccepted(z) || !(weight >= 0) || !isAccepted(weight))
    return sf::endWith({sf::Status::BadOption}, where);
  sf::Work work = sf::hostWork(maxBytes);
  sf::ModelFault fault{};
  const bool isDone = opened->surfaces->movePole(face, pole, {x, y, z}, weight, work, fault);
  return moved(isDone, fault, work, where, result);
}

extern "C" SfStatus sf_move_trim(uint32_t session, uint32_t face, uint32_t loop, uint32_t use,
                                 uint32_t pole, double u, double v, double maxBytes, SfPlace* where,
                                 SfResult** result) {
  *result = nullptr;
  OpenSurfaces* opened = openSurfaces().find(session);
  const auto isThere = [&] {
    const sf::Model& model = opened->surfaces->model();
    if (face >= model.faces.size() || model.faces[face].isLeftOut) return false;
    const sf::ModelFace& f = model.faces[face];
    if (loop >= f.endLoop - f.firstLoop) return false;
    const sf::ModelLoop& l = model.loops[f.firstLoop + loop];
    return use < l.endUse - l.firstUse &&
           pole < model.uses[l.firstUse + use].arrays.poles.size() / 2;
  };
  if (!opened || !(maxBytes >= 0) || !isThere() || !isAccepted(u) || !isAccepted(v))
    return sf::endWith({sf::Status::BadOption}, where);
  sf::Work work = sf::hostWork(maxBytes);
  sf::ModelFault fault{};
  const bool isDone = opened->surfaces->moveTrim(face, loop, use, pole, {u, v}, work, fault);
  return moved(isDone, fault, work, where, result);
}

extern "C" SfStatus sf_close_surfaces(uint32_t session) {
  openSurfaces().drop(session);
  return SfStatus(sf::Status::Ok);
}
