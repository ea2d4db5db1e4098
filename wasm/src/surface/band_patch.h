// Triangles of a band after its border has changed: those that still fit stay, and the hole that the others leave is filled.
//
// Source: Kumar, sec. 5: triangles that a new line or sample meets are deleted, and the hole is triangulated like the whole.
// Differs: what stays is found first, by place; the hole's border is then the new border less that of what stays, whatever
// has changed and however often. The sweep that triangulates it proves at the same time that nothing overlaps: where it does,
// the hole winds otherwise than once, and the patch is refused.
#pragma once
#include <cstdint>
#include <vector>

#include "base/array_view.h"
#include "base/point2.h"
#include "base/work.h"
#include "polygon/triangulate.h"
#include "surface/density.h"

namespace sf {

class BandPatch {
 public:
  /// The band as it is to be. Vertices are named by numbers below at.size().
  struct Band {
    ArrayView<const Point2> at;
    ArrayView<const uint32_t> border;   // [2e] edges, the band to the left of each
    ArrayView<const uint32_t> islands;  // vertices inside
    ArrayView<const uint8_t> isGone;    // [at] vertices that no triangle may have any more
    ArrayView<const Box2> changed;      // no triangle that overlaps with one of these stays
  };

  /// Replaces triangles. False if that cannot be done so; they are then as before.
  ///   corners  [3t] counter-clockwise
  ///   twins    [3t] of these
  ///   kept     out: how many stay; they come first, in their order
  ///   stays    out: [old t] whether it stays
  bool run(const Band& band, PolygonTriangulator& triangulator, Work& work,
           ArrayView<const uint32_t> twins, std::vector<uint32_t>& corners, size_t& kept,
           std::vector<uint8_t>& stays);

 private:
  struct Edge {
    uint32_t from, to;
  };
  bool findHole(const Band& band, const std::vector<uint32_t>& corners,
                ArrayView<const uint32_t> twins, const std::vector<uint8_t>& stays, Work& work);
  bool linkRings(const Band& band);

  std::vector<Edge> edges_, hole_;
  std::vector<uint8_t> isUsed_, isTaken_;
  std::vector<uint32_t> firsts_, rings_, starts_;
  std::vector<double> xy_, islands_;
  std::vector<uint32_t> islandVertices_;
  std::vector<uint32_t> found_;
};

}  // namespace sf
