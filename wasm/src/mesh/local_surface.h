// A patch and the surface around it: what refining and fairing work on.
#pragma once
#include <cstdint>
#include <vector>

namespace sf {

/// A patch with some rings of the mesh around it, numbered by itself.
struct LocalSurface {
  std::vector<double>
      positions;  // [3n]: rim and surroundings first, then vertices inside the patch
  std::vector<uint32_t> triangles;  // [3m]: fixedTriangles of the surroundings, then the patch
  uint32_t fixedVertices = 0;       // the first ones never move
  uint32_t fixedTriangles = 0;      // the first ones never change
};

}  // namespace sf
