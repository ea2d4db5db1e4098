// A triangle mesh as it comes from outside: what may be wrong with it is said by `mesh/adjacency.h`.
#pragma once
#include <cstdint>

#include "base/array_view.h"
#include "base/vec.h"
namespace sf {
struct MeshView {
  ArrayView<const double> positions;  // [3n], finite
  ArrayView<const uint32_t> faces;    // [3m], each below n
};
/// Point v of [3n] coordinates.
inline Vec3 pointAt(ArrayView<const double> positions, uint32_t v) {
  const double* p = positions.data() + 3 * size_t(v);
  return {p[0], p[1], p[2]};
}

}  // namespace sf
