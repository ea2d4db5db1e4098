// Delaunay tetrahedralization and its facets, all at once.
#pragma once
#include <cstdint>
#include <vector>

#include "base/status.h"
#include "delaunay/tetrahedralization.h"

namespace sf {

struct Delaunay {
  int dimension = -1;                 // of the points' affine hull; -1 without points
  std::vector<uint32_t> tetrahedra;   // [4t] positively oriented; empty below dimension 3
  std::vector<uint32_t> facets;       // [3f] as sortedFacets gives them
  std::vector<uint32_t> duplicateOf;  // [n] the least index of an equal point, i itself if first
};

/// The triangles of the Delaunay tetrahedralization of points in any position; those of the planar
/// Delaunay triangulation if all are coplanar, none if they are collinear. Of equal points the
/// first stands for all. Ties are broken by index (insphereByRank).
///   points  [n] finite, any magnitude; n up to 2^28
/// Status Ok, OutOfMemory or Stopped. The memory of the result is no longer charged on return.
/// 100 000 random points take about half a second and 30 MB besides the result.
Status delaunay(ArrayView<const Vec3> points, Work& work, Delaunay& result);

/// The triangles of a tetrahedralization: each once, its vertices increasing,
/// in lexicographic order.
///   facets  [3f] the result
///   number  [n] the number to write for each point in place of its index, or empty
/// False once the work has to end.
bool sortedFacets(const Tetrahedralization& cells, Work& work, std::vector<uint32_t>& facets,
                  ArrayView<const uint32_t> number = {});

}  // namespace sf
