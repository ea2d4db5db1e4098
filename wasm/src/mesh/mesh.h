// A triangle mesh as it comes from outside: what may be wrong with it is said by `mesh/adjacency.h`.
#pragma once
#include <cstdint>
#include "base/array_view.h"
namespace sf {
struct MeshView {
  ArrayView<const double> positions;  // [3n], finite
  ArrayView<const uint32_t> faces;    // [3m], each below n
};
}  // namespace sf
