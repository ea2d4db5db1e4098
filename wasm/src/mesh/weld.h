// Vertices at the same place made one: for meshes whose faces do not share any, as STL files have them.
#pragma once
#include <cstdint>
#include <vector>

#include "base/charge.h"
#include "mesh/mesh.h"

namespace sf {

struct WeldedMesh {
  std::vector<double> positions;  // [3w] of the first vertex of each place, in the input's order
  std::vector<uint32_t> faces;    // [3m] every face of the input; some may now have a vertex twice
  std::vector<uint32_t> vertexMap;  // [n] the new number of each vertex

  MeshView view() const { return {positions, faces}; }
};

/// Welds each vertex to the first one within `radius` that was not welded itself; 0 takes equal
/// positions alone.
///   mesh    finite (checkMesh)
///   radius  finite, from 0 on
/// O(n) time. Memory of the result is charged to `charge`. False once `work` has to end.
bool weldVertices(const MeshView& mesh, double radius, Work& work, Charge& charge,
                  WeldedMesh& result);

}  // namespace sf
