// Creases that end at a rim are carried on through the hole, and the parts between them filled apart.
//
// Source: Liepa 2003 knows no creases; pairs of ends joined by Hermite curves, and three ends by a corner, are ours.
#pragma once
#include <cstdint>
#include <vector>

#include "mesh/find.h"
#include "mesh/hole_part.h"

namespace sf {

/// Edges between faces whose normals differ by more than an angle, of one mesh.
class Creases {
 public:
  /// @param fanStarts, fans  the faces at each input vertex that count; must outlive it
  Creases(const MeshView& mesh, const Adjacency& adjacency, const std::vector<uint32_t>& fanStarts,
          const std::vector<uint32_t>& fans, double angle);

  /// Whether the edge of a half-edge is one; of the rim none is.
  bool isSharp(uint32_t half) const;
  /// The other ends of sharp edges at a vertex, each once.
  void others(uint32_t vertex, std::vector<uint32_t>& found) const;

 private:
  Vec3 normal(uint32_t face) const;

  MeshView mesh_;
  const Adjacency& adjacency_;
  const std::vector<uint32_t>& fanStarts_;
  const std::vector<uint32_t>& fans_;
  double cosine_;
};

/// The parts of a hole with one rim at which two, three or four creases end; none where that is not so.
HoleParts partHole(const MeshView& mesh, const Rims& rims, uint32_t rim, const Creases& creases);

}  // namespace sf
