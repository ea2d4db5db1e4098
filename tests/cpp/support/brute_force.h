// The optimum by direct enumeration, for judging the solver.
//
// Surfaces grow triangle by triangle over their open half-edges, from one loop edge on: nothing of
// the domain recursion (segments, holes, weak edges) is used.
#pragma once
#include <cstdint>
#include <vector>

#include "loops/span.h"

namespace sftest {

struct BruteForceAnswer {
  bool found = false;
  double cost = 0;                  // the objective: weighted sum, or largest angle
  double sum = 0;                   // weighted sum
  std::vector<uint32_t> triangles;  // [3m] consistently wound
};

/// The surface of least cost in the class of loops/span.h.
///   options.space  All or Given; exactly collinear triples are not candidates in either
/// For WorstDihedral angles within 1e-9 count as equal and the weighted sum decides.
/// Time grows with the number of surfaces: up to 9 vertices in all, more with few candidates.
BruteForceAnswer bruteForceOptimum(const sf::LoopSet& loops, const sf::SpanOptions& options);

/// Number of surfaces of the class over all triples, for loops of the given sizes.
uint64_t countSurfaces(const std::vector<uint32_t>& sizes);

}  // namespace sftest
