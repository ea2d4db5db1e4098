// Meshes and limits as they cross the C ABI, checked.
#pragma once
#include "base/status.h"
#include "mesh/adjacency.h"

namespace sf {

/// The mesh of some arrays.
/// Errors: TooLarge; those of `checkMesh`.
inline Outcome viewMesh(const double* positions, uint32_t vertexCount, const uint32_t* faces,
                        uint32_t faceCount, MeshView& mesh) {
  if (faceCount >= 1u << 30 || vertexCount >= 1u << 30) return {Status::TooLarge};
  mesh = {{positions, 3 * size_t(vertexCount)}, {faces, 3 * size_t(faceCount)}};
  return checkMesh(mesh);
}

/// A limit of vertices, not negative; kNone where it limits nothing.
inline uint32_t vertexLimit(double limit) { return limit < kNone ? uint32_t(limit) : kNone; }

}  // namespace sf
