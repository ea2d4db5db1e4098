// Fuzzes sf_open_surfaces, sf_tessellate_surfaces, sf_update_surfaces and the moves through the C ABI: plates with holes, cylinders
// and spheres, with numbers and counts that were spoilt. Whatever comes back has to be a status, or meshes with the right
// numbers of everything and finite coordinates.
#include <cmath>
#include <random>
#include <vector>

#include "fuzz/bytes.h"
#include "soapfilm.h"
#include "support/surface_models.h"

using namespace sffuzz;

namespace {

/// Calls of the progress function, each after a million units of work, until an input ends.
constexpr uint32_t kMostCalls = 12;
uint32_t callsLeft;

template <class T>
const T* array(const SfResult* result, uint32_t name, size_t& length) {
  length = sf_result_length(result, name);
  return static_cast<const T*>(sf_result_data(result, name));
}

sf::ModelBuilder model(Bytes& in) {
  std::mt19937 random(in.byte());
  switch (in.below(3)) {
    case 0:
      return sf::solidCylinder(1 + in.below(4), 0.5 + in.below(8));
    case 1:
      return sf::sphere(1 + in.below(3));
    default:
      return sf::wavyPlate(random, 0.05 * in.below(8), in.below(9));
  }
}

void spoil(std::vector<uint32_t>& shape, std::vector<double>& numbers, Bytes& in) {
  for (uint32_t edits = in.below(6); edits > 0; --edits) {
    const uint32_t at = in.byte() | uint32_t(in.byte()) << 8;
    if (in.below(5) == 0)
      shape[at % shape.size()] = in.below(4) == 0 ? in.byte() * 0x01010101u : in.below(40);
    else if (in.below(4) == 0)
      numbers[at % numbers.size()] = in.raw();
    else
      numbers[at % numbers.size()] += 0.01 * (in.below(256) - 128.0);
  }
}

SfSamplingSettings settingsOf(Bytes& in) {
  SfSamplingSettings s{};
  s.tolerance = std::pow(2.0, -double(in.below(9)));
  s.angle = in.below(4) == 0 ? 100 : 0.1 + 0.1 * in.below(20);
  s.aspect = in.below(4) == 0 ? HUGE_VAL : 1 + in.below(9);
  s.maxTriangles = in.below(5) == 0 ? 40 * in.byte() : HUGE_VAL;
  s.maxSeconds = in.below(8) == 0 ? in.below(kMostCalls) : HUGE_VAL;
  if (in.below(3) > 0) return s;
  s.hasCamera = 1;
  for (double* m = &s.m0; m <= &s.m15; ++m) *m = in.below(9) == 0 ? 0.1 * in.byte() : 0;
  s.m0 += 1, s.m5 += 1, s.m10 -= 1, s.m11 -= 1, s.m14 += 0.1 * in.below(40),
      s.m15 += 0.1 * in.below(60);
  s.width = s.height = 100, s.pixels = 0.5 + in.below(4);
  return s;
}

void checkIndices(const SfResult* result, uint32_t name, size_t vertices) {
  size_t length;
  const uint32_t* indices = array<uint32_t>(result, name, length);
  for (size_t i = 0; i < length; ++i) require(indices[i] < vertices, "vertices that are there");
}

void checkFinite(const SfResult* result, uint32_t name) {
  size_t length;
  const float* numbers = array<float>(result, name, length);
  for (size_t i = 0; i < length; ++i) require(std::isfinite(numbers[i]), "finite numbers");
}

void mesh(uint32_t session, Bytes& in) {
  for (uint32_t steps = 1 + in.below(4); steps > 0; --steps) {
    const SfSamplingSettings settings = settingsOf(in);
    SfPlace where;
    SfResult* result = nullptr;
    if (in.below(3) == 0) {
      const auto number = [&] { return 0.02 * in.byte() - 1; };
      const uint32_t face = in.below(3), pole = in.below(60);
      if (in.below(2) == 0)
        sf_move_pole(session, face, pole, number(), number(), number(), in.below(3), 64e6, &where,
                     &result);
      else
        sf_move_trim(session, face, in.below(4), in.below(5), pole, number(), number(), 64e6,
                     &where, &result);
      sf_result_free(result);
      result = nullptr;
    }
    if (in.below(2) == 0) {
      const SfStatus status = sf_tessellate_surfaces(session, &settings, 64e6, &where, &result);
      require((status == 0) == (result != nullptr), "a result with Ok alone");
      if (result == nullptr) return;
      size_t length;
      array<float>(result, SfTessellation_positions, length);
      checkIndices(result, SfTessellation_triangles, length / 3);
      checkIndices(result, SfTessellation_strips, length / 3);
      checkIndices(result, SfTessellation_edges, length / 3);
      checkIndices(result, SfTessellation_same, length / 3);
      checkFinite(result, SfTessellation_positions);
      checkFinite(result, SfTessellation_normals);
    } else {
      const SfStatus status = sf_update_surfaces(session, &settings, 64e6, &where, &result);
      require((status == 0) == (result != nullptr), "a result with Ok alone");
      if (result == nullptr) return;
      size_t length;
      const uint32_t* sizes = array<uint32_t>(result, SfChange_sizes, length);
      checkIndices(result, SfChange_triangles, sizes[0]);
      checkIndices(result, SfChange_strips, sizes[0]);
      checkIndices(result, SfChange_same, sizes[0]);
      checkFinite(result, SfChange_positions);
    }
    sf_result_free(result);
  }
}

}  // namespace

extern "C" int32_t sf_host_progress(double fraction, double, double) {
  require(fraction >= 0 && fraction <= 1, "a fraction of the work");
  return callsLeft > 0 && callsLeft-- > 0;
}

extern "C" double sf_host_seconds() { return kMostCalls - callsLeft; }

extern "C" void sf_host_result(const SfResult*) {}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  Bytes in(data, size);
  callsLeft = kMostCalls;
  const sf::ModelBuilder builder = model(in);
  std::vector<uint32_t> shape = builder.shape();
  std::vector<double> numbers = builder.numbers();
  spoil(shape, numbers, in);
  SfPlace where;
  SfResult* opened = nullptr;
  const SfStatus status = sf_open_surfaces(shape.data(), uint32_t(shape.size()), numbers.data(),
                                           uint32_t(numbers.size()), 64e6, &where, &opened);
  require((status == 0) == (opened != nullptr), "a result with Ok alone");
  if (opened == nullptr) return 0;
  size_t length;
  const uint32_t session = *array<uint32_t>(opened, SfSurfaces_session, length);
  mesh(session, in);
  sf_close_surfaces(session);
  sf_result_free(opened);
  return 0;
}
