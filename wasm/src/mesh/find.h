// The rims of a mesh: closed loops of edges with a face on one side alone.
//
// Source: Zou, Ju, Carr 2013, sec. 5, takes rims as given. Where several rims meet at a vertex they
// could be followed in several ways: here across the gaps between faces, whichever pairing turns least.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/charge.h"
#include "base/vec.h"
#include "mesh/adjacency.h"

namespace sf {

struct Rim {
  double length, diameter;  // the diameter of more than 1000 vertices is a little too small
  uint32_t component;       // of the face at its first edge; others can meet it at vertices
  bool crossesSeam;         // of a component that is not orientable: filled, it still is not
  bool
      isSeam;  // more than half of it runs along edges of rims at the same places, with other vertices
};

/// Where a rim goes on to another one, at a vertex that both pass: the edges of rims before it and after it.
struct RimTouch {
  uint32_t before, after;
};

/// Rims by their half-edges. Rim i has the edges starts[i] to before starts[i + 1]. Edge e runs
/// from vertices[e] to the vertex of the next edge of the rim, as the edge of a face that fills the
/// hole runs: the mesh's face is on the right, and its half-edge runs the other way.
struct Rims {
  std::vector<uint32_t> starts;    // [k+1]
  std::vector<Rim> rims;           // [k]
  std::vector<uint32_t> vertices;  // [e] of the input; those of a rim are different
  std::vector<uint32_t> halves;    // [e] half-edges of the adjacency, of face halves[e] / 3
  std::vector<Vec3> normals;       // [e] unit normal of that face, or zero if it cannot be told
  /// What was followed across the gaps between faces, and parted where it came to a vertex again. By `before`;
  /// each edge is before one touch at most, and after one.
  std::vector<RimTouch> touches;

  uint32_t count() const { return uint32_t(rims.size()); }
  uint32_t nextEdge(uint32_t rim, uint32_t e) const {
    return e + 1 == starts[rim + 1] ? starts[rim] : e + 1;
  }
  uint32_t rimOf(uint32_t e) const {
    return uint32_t(std::upper_bound(starts.begin(), starts.end(), e) - starts.begin()) - 1;
  }
};

/// Appends the normal of the face at a rim edge, as SpanOptions has it: NaN if it cannot be told.
inline void appendBoundaryNormal(Vec3 normal, std::vector<double>& normals) {
  const bool isKnown = dot(normal, normal) > 0;
  for (const double x : {normal.x, normal.y, normal.z})
    normals.push_back(isKnown ? x : std::nan(""));
}

/// Finds all rims. Slits between two faces that a cut left open at one edge are none.
/// Rims that pass a vertex twice are parted there, which `touches` says. Rims of components that are not orientable cross
/// the seams; their normals are all of one side, for along its rim every surface has two sides.
/// O(m + r log r) time for r rim edges. Memory of the result is charged to `charge`.
/// False once `work` has to end.
bool findRims(const MeshView& mesh, const Adjacency& adjacency, Work& work, Charge& charge,
              Rims& result);

}  // namespace sf
