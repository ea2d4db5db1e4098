// A patch and the surface around it: what refining and fairing work on.
#pragma once
#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace sf {

/// A vertex on the boundary of a patch without surroundings, where it is known which way the surface leaves.
struct Clamp {
  uint32_t vertex;
  Vec3 normal;  // of the surface there, of unit length
  Vec3 pull;    // half of its two boundary edges' lengths, each along the edge's outward co-normal
};

/// A patch with some rings of the mesh around it, numbered by itself.
struct LocalSurface {
  std::vector<double>
      positions;  // [3n]: rim and surroundings first, then vertices inside the patch
  std::vector<uint32_t> triangles;  // [3m]: fixedTriangles of the surroundings, then the patch
  uint32_t fixedVertices = 0;       // the first ones never move
  uint32_t fixedTriangles = 0;      // the first ones never change
  std::vector<Clamp> clamps;        // of fixed vertices, each at most once
};

}  // namespace sf
