// Problems for the solver: loops, options, and the arrays that the options point into.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "loops/span.h"
#include "support/generators.h"

namespace sftest {

struct Problem {
  Curves curves;
  sf::SpanOptions options;              // its views are filled in by view()
  std::vector<double> normals;          // [3n] or empty
  std::vector<uint32_t> triangles;      // [3c] for Space::Given
  std::vector<double> triangleWeights;  // [c] or empty
  std::vector<uint32_t> start;          // [3s] triangles to begin from, or empty

  sf::SpanOptions view() const;
  uint32_t vertexCount() const;
  /// Everything needed to rerun it.
  std::string text() const;
};

/// Rebuilds a problem whose vertex i was vertex `origin[i]`: normals and candidates follow.
/// `turned[i]` says that the edge after vertex i was the edge before vertex origin[i], reversed.
Problem renumbered(const Problem& before, const Curves& curves, const std::vector<uint32_t>& origin,
                   const std::vector<char>& turned);
/// The same problem with its loops in another order, each begun anywhere and perhaps reversed.
Problem shuffled(const Problem& before, Random& random);

struct Answer {
  sf::Outcome outcome;
  sf::Span span;
};

/// spanLoops without limits.
Answer solve(const Problem& problem);

/// Whether two edges of the loops that are not neighbours meet, exactly, or two vertices coincide.
bool loopsMeet(const Curves& curves);

enum class Shape { Random, Lattice, Planar, Spherical, Rings, CollinearRuns, Count };
const char* nameOf(Shape shape);

/// Loops of the given sizes, no two edges of which meet. Lattice, Planar, Spherical and
/// CollinearRuns have small dyadic coordinates, so that their degeneracies are exact.
Curves loopsOf(Shape shape, const std::vector<uint32_t>& sizes, Random& random);

/// Weights by name: area, perimeter, dihedral, mixed, default, worst, worst mixed.
constexpr int kWeightings = 7, kDefaultWeights = 4;
const char* setWeights(int which, const Curves& curves, sf::SpanOptions& options);

/// Normals of faces across about `share` of the loop edges.
std::vector<double> randomNormals(const Curves& curves, double share, Random& random);

/// The triples that are not collinear, each kept with probability `keep`,
/// in random order and winding.
std::vector<uint32_t> randomTriples(const Curves& curves, double keep, Random& random);

}  // namespace sftest
