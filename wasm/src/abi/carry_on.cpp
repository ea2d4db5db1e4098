// sf_carry_on: refuses input that has no meaning to the core, calls the core, packs the result.
#include "abi/host_work.h"
#include "abi/mesh_input.h"
#include "abi/result.h"
#include "mesh/harmonic.h"

extern "C" SfStatus sf_carry_on(const double* positions, uint32_t vertexCount,
                                const uint32_t* faces, uint32_t faceCount, uint32_t fixedCount,
                                const double* values, uint32_t size, double maxBytes,
                                SfPlace* where, SfResult** result) {
  *result = nullptr;
  if (!(maxBytes >= 0) || fixedCount > vertexCount || size == 0 || size >= 1u << 30)
    return sf::endWith({sf::Status::BadOption}, where);
  sf::MeshView mesh;
  sf::Outcome outcome = sf::viewMesh(positions, vertexCount, faces, faceCount, mesh);
  const sf::ArrayView<const double> fixedValues{values, size_t(fixedCount) * size};
  for (size_t i = 0; outcome.ok() && i < fixedValues.size(); ++i)
    if (!std::isfinite(values[i])) outcome = {sf::Status::NotFinite, sf::kNone, uint32_t(i / size)};
  sf::Work work = sf::hostWork(maxBytes);
  std::vector<double> carried;
  if (outcome.ok() && !sf::carryOn(mesh, fixedCount, size, fixedValues, work, carried))
    outcome = {work.status()};
  if (outcome.ok()) {
    *result = new SfResult(SfCarryArrayCount);
    (*result)->put<SfCarry_values>(std::move(carried));
  }
  return sf::endWith(outcome, where);
}
