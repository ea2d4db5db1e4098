// Finds where a point lies among triangles, by a walk towards it.
// Source: Devillers, Pion, Teillaud 2002, "Walking in a triangulation": the stochastic visibility
// walk.
#pragma once
#include <cstdint>

#include "triangles/triangle_mesh.h"

namespace sf {

/// Walks from triangle to triangle. If triangles are not Delaunay a walk may go round in circles,
/// but not for ever if it chooses its edges at random. The choices are the same on every machine.
class Locator {
 public:
  /// The triangle in which p lies, perhaps on its border. Not found if a boundary is in the way, or
  /// after `steps` steps. Expected O(sqrt m) steps among Delaunay triangles.
  ///   h  a half-edge of the triangle to begin with
  TriangleMesh::Place walk(const TriangleMesh& mesh, uint32_t h, Point2 p, uint32_t steps);
  /// The same, but looks at every triangle if the walk does not find one. Not found if no triangle
  /// holds p. O(m) at worst.
  TriangleMesh::Place locate(const TriangleMesh& mesh, uint32_t h, Point2 p);

 private:
  uint32_t random();

  uint32_t random_ = 2463534242u;
};

}  // namespace sf
