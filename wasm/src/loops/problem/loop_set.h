// The input curves: k closed polygons over n vertices, numbered one loop after the other.
#pragma once
#include <cstdint>
#include <vector>

#include "base/array_view.h"
#include "base/vec.h"

namespace sf {

/// k closed loops. Loop c owns the vertices [starts[c], starts[c+1]); vertex i of it is followed
/// by i+1, the last by the first. Directions carry no meaning except for boundary normals.
class LoopSet {
 public:
  LoopSet() = default;
  /// positions [n], starts [k+1] increasing from 0 to n; copied.
  LoopSet(ArrayView<const Vec3> positions, ArrayView<const uint32_t> starts)
      : positions_(positions.begin(), positions.end()), starts_(starts.begin(), starts.end()) {
    loopOf_.resize(positions_.size());
    for (uint32_t c = 0; c < loopCount(); ++c)
      for (uint32_t v = starts_[c]; v < starts_[c + 1]; ++v) loopOf_[v] = c;
  }

  uint32_t vertexCount() const { return uint32_t(positions_.size()); }
  uint32_t loopCount() const { return uint32_t(starts_.size()) - 1; }
  uint32_t first(uint32_t loop) const { return starts_[loop]; }
  uint32_t size(uint32_t loop) const { return starts_[loop + 1] - starts_[loop]; }
  uint32_t loopOf(uint32_t v) const { return loopOf_[v]; }
  uint32_t next(uint32_t v) const {
    uint32_t c = loopOf_[v];
    return v + 1 == starts_[c + 1] ? starts_[c] : v + 1;
  }
  uint32_t previous(uint32_t v) const {
    uint32_t c = loopOf_[v];
    return v == starts_[c] ? starts_[c + 1] - 1 : v - 1;
  }
  Vec3 position(uint32_t v) const { return positions_[v]; }
  ArrayView<const Vec3> positions() const { return positions_; }
  ArrayView<const uint32_t> starts() const { return starts_; }
  /// Whether u and v are joined by an edge of a loop.
  bool isLoopEdge(uint32_t u, uint32_t v) const { return next(u) == v || next(v) == u; }

 private:
  std::vector<Vec3> positions_;
  std::vector<uint32_t> starts_;
  std::vector<uint32_t> loopOf_;
};

}  // namespace sf
