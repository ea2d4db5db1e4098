// An independent check of what the solver returns: is it a surface of the class, and does it cost
// what it says? Nothing here is shared with the solver but the types of loops/span.h.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "loops/span.h"

namespace sftest {

/// The boundary of a surface: loop c visits the vertices [starts[c], starts[c+1]) of `vertices`.
struct Boundary {
  std::vector<uint32_t> starts;    // [k+1]
  std::vector<uint32_t> vertices;  // [n'] a permutation of 0 to n'-1
};

/// What is wrong with a triangle list as a surface spanning `boundary`, or "" if nothing is:
/// distinct triangles, every loop edge in one triangle and every other edge in two, one fan of
/// triangles around every vertex from loop edge to loop edge, connected, consistently wound,
/// n' + 2k - 4 triangles and Euler number 2 - k (so a sphere with k holes).
///   triangles  [3m] indices below n'
std::string surfaceFault(const Boundary& boundary, const std::vector<uint32_t>& triangles);

/// The terms of a surface without faults, recomputed from scratch.
///   positions      [n']
///   normals        [3n'] by position in `boundary.vertices`: the face across the edge from that
///                  vertex to the next of its loop, NaN for none; or empty
sf::SpanTerms measureSurface(const std::vector<sf::Vec3>& positions, const Boundary& boundary,
                             const std::vector<uint32_t>& triangles,
                             const std::vector<double>& normals);

/// What is wrong with an answer of spanLoops, or "": the surface (as above), input vertices kept,
/// inserted vertices on their edges, terms and cost equal to those recomputed (1e-9 relative),
/// lowerBound <= cost, `order` a permutation in which each triangle touches an earlier one, every
/// triangle in the given list. Answers without a surface have no fault.
std::string spanFault(const sf::LoopSet& loops, const sf::SpanOptions& options,
                      const sf::Span& span);

/// Makes a span for spanFault from candidates over all loop vertices, in the order of splitting,
/// however they are wound. Winds them alike and measures terms, cost and bound. Triangles that
/// cannot be wound alike stay as they are.
sf::Span spanOf(const sf::LoopSet& loops, const sf::SpanOptions& options,
                const std::vector<uint32_t>& triangles);

/// The weighted sum of a span's terms, own weights included.
double weightedSum(const sf::SpanOptions& options, const sf::SpanTerms& terms);

}  // namespace sftest
