// Triangles over the vertices of one set of loops, and of no other.
#pragma once
#include <cstdint>
#include <vector>

#include "loops/problem/loop_set.h"

namespace sf {

/// Triangles together with the loops whose vertices they name: a surface to begin from, which may
/// be outdated, edited, or somebody's guess. A number means different vertices in loops with
/// inserted vertices and in loops without. So readers of the triangles take the loops from here as
/// well. The only way in is the constructor, which admits no vertex that these loops do not have.
class LoopTriangles {
 public:
  /// No triangles. `loops` has to outlive it.
  explicit LoopTriangles(const LoopSet& loops) : loops_(&loops) {}
  /// Keeps those of `triangles` [3m] that have three different vertices of the loops.
  LoopTriangles(const LoopSet& loops, ArrayView<const uint32_t> triangles);

  const LoopSet& loops() const { return *loops_; }
  /// [3m] each below loops().vertexCount()
  ArrayView<const uint32_t> vertices() const { return vertices_; }
  bool isEmpty() const { return vertices_.empty(); }

 private:
  const LoopSet* loops_;
  std::vector<uint32_t> vertices_;
};

}  // namespace sf
