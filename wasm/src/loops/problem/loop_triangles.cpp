#include "loops/problem/loop_triangles.h"

namespace sf {

LoopTriangles::LoopTriangles(const LoopSet& loops, ArrayView<const uint32_t> triangles)
    : loops_(&loops) {
  const uint32_t n = loops.vertexCount();
  for (size_t i = 0; i + 2 < triangles.size(); i += 3) {
    const uint32_t a = triangles[i], b = triangles[i + 1], c = triangles[i + 2];
    if (a < n && b < n && c < n && a != b && b != c && c != a)
      vertices_.insert(vertices_.end(), {a, b, c});
  }
}

}  // namespace sf
