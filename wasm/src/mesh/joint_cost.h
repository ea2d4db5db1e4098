// Whether two rims cost less to span together than apart.
//
// Source: Zou, Ju, Carr 2013, sec. 6: grouping "by the cost of the triangulation", future work there.
// Differs: asked only for pairs that votes leave open, so that it takes milliseconds.
#pragma once
#include <cstdint>
#include <vector>

#include "base/work.h"
#include "loops/problem/loop_set.h"
#include "mesh/find.h"

namespace sf {

/// How many edges of loops the triangles of a surface over them run as the loops do. All or none, if they are wound alike.
uint32_t edgesAlong(const LoopSet& loops, ArrayView<const uint32_t> triangles);

enum class Verdict : uint8_t { Together, Apart, Unknown };

class JointCost {
 public:
  /// Pairs of more vertices are not spanned.
  static constexpr uint32_t kMostVertices = 400;
  /// Units of work for one span, and for all: tenths of a second, and about a second.
  static constexpr uint64_t kMostUnits = 100'000'000, kMostUnitsOfAll = 1'000'000'000;

  /// Keeps views of all.
  JointCost(const MeshView& mesh, const Rims& rims, Work& work);

  /// Compares surfaces of least angles among Delaunay triangles, those with the faces along the rims included.
  /// Unknown where one of the three has none that rims wound alike bound, or takes more than there is of vertices, units or memory: that
  /// depends on the rims and on what was asked before, never on time. False once the work has to end.
  bool compare(uint32_t first, uint32_t second, Verdict& verdict);

 private:
  bool costOf(ArrayView<const uint32_t> rims, double& cost);

  MeshView mesh_;
  const Rims& rims_;
  Work& work_;
  std::vector<double>
      alone_;  // [k] cost of each rim; infinite if it has none; NaN: not yet asked for
  uint64_t spent_ = 0;
};

}  // namespace sf
