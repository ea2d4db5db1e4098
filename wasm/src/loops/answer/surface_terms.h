// Winds the triangles of a surface alike, and measures the surface term by term.
#pragma once
#include <cstdint>
#include <vector>

#include "loops/problem/candidate_set.h"

namespace sf {

/// Sums over a surface. Angles in radians between consistently oriented normals.
struct SpanTerms {
  double area = 0;           // sum of triangle areas
  double perimeter = 0;      // sum of triangle perimeters
  double dihedral = 0;       // sum over interior edges, and boundary edges with a face given
  double worstDihedral = 0;  // the largest of those angles, 0 if there is none
  double own = 0;            // sum of the candidates' own weights
};

/// Turns the triangles of a surface so that neighbours agree, and that the first triangle with an
/// edge of the first loop passes this edge forward.
///   triangles  [m] numbers in the set, of a connected, orientable surface with all loop edges
///   wound      [3m] out
void windConsistently(const LoopSet& loops, const CandidateSet& set,
                      const std::vector<uint32_t>& triangles, std::vector<uint32_t>& wound);

/// The terms of a surface, in the units of the loops and of `own`.
///   normals  [3n] of faces across the loops' edges, or empty
///   own      [c] the candidates' own weights, or empty
SpanTerms measureTerms(const LoopSet& loops, const CandidateSet& set,
                       const std::vector<uint32_t>& triangles, ArrayView<const double> normals,
                       ArrayView<const double> own);

}  // namespace sf
