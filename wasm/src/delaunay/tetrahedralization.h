// Incremental Delaunay tetrahedralization of points in space, degenerate ones included.
// Source: Bowyer 1981; Watson 1981 (cavities); Amenta, Choi, Rote 2003, "Incremental constructions
// con BRIO" (order of insertion); Devillers, Pion, Teillaud 2002, "Walking in a triangulation".
// Differs: coplanar points are joined to one apex off their plane. A sphere through the apex meets
// the plane in a circle, so that the apex's link is the planar Delaunay triangulation; no second
// algorithm is needed.
#pragma once
#include <cstdint>
#include <vector>

#include "base/array_view.h"
#include "base/vec.h"
#include "base/work.h"

namespace sf {

/// The Delaunay tetrahedralization of a growing set of points. insphereByRank breaks ties among
/// co-spherical points; a point's rank is its index unless given. So the result depends on points
/// and ranks alone, not on the order of insertion. Members return false once the work has to end
/// (see Work); after that the object may only be destroyed.
class Tetrahedralization {
 public:
  explicit Tetrahedralization(Work& work) : work_(work) {}
  ~Tetrahedralization();
  Tetrahedralization(const Tetrahedralization&) = delete;
  Tetrahedralization& operator=(const Tetrahedralization&) = delete;

  /// Adds points, which get the indices pointCount(), pointCount() + 1, ...
  ///   points  [m] in the range of the predicates (scaleToUnit)
  ///   ranks   [m] different from each other and all earlier ones, below 2^32 - 2; empty: the
  ///           indices
  /// Expected O(log n) time a point on points with a linear-size result, O(n) memory.
  bool add(ArrayView<const Vec3> points, ArrayView<const uint32_t> ranks = {});

  uint32_t pointCount() const { return points_.empty() ? 0 : uint32_t(points_.size()) - 1; }
  const Vec3& point(uint32_t i) const { return points_[i + 1]; }
  /// The least index of a point equal to point i, which may be i itself.
  uint32_t duplicateOf(uint32_t i) const { return firstEqual_[i]; }
  /// Dimension of the points' affine hull, 0 to 3; -1 without points.
  int dimension() const { return dimension_; }

  /// Whether a rank has broken a tie so far. If not, other ranks would give the same result.
  bool hadTies() const { return hadTies_; }

  /// Calls f(a, b, c, d) for each tetrahedron, positively oriented (dimension 3).
  template <class F>
  void forEachTetrahedron(F f) const {
    if (dimension_ != 3) return;
    for (const Cell& t : cells_)
      if (t.isFinite()) f(t.v[0] - 1, t.v[1] - 1, t.v[2] - 1, t.v[3] - 1);
  }
  /// Calls f(a, b, c), once for each triangle: the facets of the tetrahedra in dimension 3, the
  /// planar triangles in dimension 2, nothing below.
  template <class F>
  void forEachFacet(F f) const;
  /// Calls f(a, b) for each edge, usually several times; in dimension 1 once for each pair of
  /// neighbours on the line.
  template <class F>
  void forEachEdge(F f) const;

 private:
  // Vertex numbers inside: 0 is the apex of coplanar input, i + 1 is point i.
  static constexpr uint32_t kApex = 0;
  static constexpr uint32_t kGhost = 0xFFFFFFFFu;  // the vertex at infinity, in slot 0 of its cells
  static constexpr uint32_t kFree = 0xFFFFFFFEu;   // in slot 0 of unused cells
  static constexpr uint32_t kNowhere = 0xFFFFFFFFu;

  struct Cell {
    uint32_t v[4];  // positively oriented if finite
    uint32_t n[4];  // 4 * neighbour + face there, across the face opposite of v[i]
    uint32_t mark;  // 2 * step if in that step's cavity, 2 * step + 1 if tested and not in it
    bool isFinite() const { return v[0] < kFree; }
    uint32_t find(uint32_t vertex) const {
      uint32_t i = 0;
      while (v[i] != vertex) ++i;
      return i;
    }
  };
  // The face opposite of v[i], seen positively oriented from v[i].
  static constexpr uint8_t kFace[4][3] = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}};

  bool rebuild();
  bool insertionOrder(uint32_t first, std::vector<uint32_t>& order);
  bool startFrom(std::vector<uint32_t>& order);
  bool insertAll(ArrayView<const uint32_t> order);
  bool insert(uint32_t v);
  uint32_t locate(const Vec3& p) const;
  bool conflicts(const Cell& t, uint32_t v) const;
  bool findCavity(uint32_t start, uint32_t v);
  bool fillCavity(uint32_t v);
  uint32_t newCell();
  void linkAroundEdge(uint32_t t, uint32_t i, uint32_t created, int k);
  void link(uint32_t a, int i, uint32_t b, int j) {
    cells_[a].n[i] = 4 * b + uint32_t(j);
    cells_[b].n[j] = 4 * a + uint32_t(i);
  }
  template <class T>
  bool reserve(std::vector<T>& v, size_t size);

  Work& work_;
  uint64_t charged_ = 0;
  int dimension_ = -1;
  std::vector<Vec3> points_;          // [n + 1]
  std::vector<uint32_t> rank_;        // [n + 1]
  std::vector<uint32_t> firstEqual_;  // [n]
  std::vector<uint32_t> line_;        // dimension 0 and 1: the distinct points along the line
  std::vector<uint32_t> base_;        // vertices that span the affine hull
  std::vector<Cell> cells_;
  std::vector<uint32_t> free_, cavity_, rim_;  // rim: 4 * cell in the cavity + face
  uint32_t last_ = 0;                          // where the next walk begins
  uint32_t step_ = 0;
  mutable bool hadTies_ = false;
};

template <class F>
void Tetrahedralization::forEachFacet(F f) const {
  for (uint32_t t = 0; t < cells_.size(); ++t) {
    const Cell& cell = cells_[t];
    if (!cell.isFinite()) continue;
    for (int i = 0; i < 4; ++i) {
      if (dimension_ == 3) {
        uint32_t other = cell.n[i] / 4;
        if (other < t && cells_[other].isFinite()) continue;
      } else if (cell.v[i] != kApex) {
        continue;
      }
      f(cell.v[kFace[i][0]] - 1, cell.v[kFace[i][1]] - 1, cell.v[kFace[i][2]] - 1);
    }
  }
}

template <class F>
void Tetrahedralization::forEachEdge(F f) const {
  if (dimension_ == 1)
    for (size_t i = 1; i < line_.size(); ++i) f(line_[i - 1] - 1, line_[i] - 1);
  for (const Cell& t : cells_) {
    if (!t.isFinite()) continue;
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j)
        if (t.v[i] != kApex && t.v[j] != kApex) f(t.v[i] - 1, t.v[j] - 1);
  }
}

}  // namespace sf
