// One polygon over all triples of its corners where no angles count: every segment's optimum at once.
// Source: eq. 1 of Zou, Ju, Carr 2013, sec. 3.1 (Barequet, Sharir 1995).
// Differs: segments are taken all the way round, from any corner on, so that what lies on either side of
// each is known, and with it what the best surface through a given triangle costs. A vertex may be
// at several corners; segments that a surface cannot have are left out.
#pragma once
#include <cstdint>
#include <vector>

#include "loops/problem/candidate_set.h"
#include "loops/problem/loop_set.h"

namespace sf {

/// The weights of all triples of few vertices, without angles.
class TripleWeights {
 public:
  /// weights: without own weights. n^3 doubles.
  TripleWeights(const LoopSet& loops, const TriangleWeights& weights);

  /// In any order; infinity for triples that are no triangle, or hardly one.
  double operator()(uint32_t u, uint32_t v, uint32_t w) const {
    return weight_[(size_t(u) * n_ + v) * n_ + w];
  }

 private:
  uint32_t n_;
  std::vector<double> weight_;
};

class PlainPolygon {
 public:
  PlainPolygon(const LoopSet& loops, const TripleWeights& weights)
      : loops_(loops), weights_(weights) {}

  /// Solves the closed polygon over these vertices, at least 3. O(m^3) for m corners.
  void compute(std::vector<uint32_t> vertices);

  uint32_t size() const { return uint32_t(vertices_.size()); }
  /// The cost of the best surface; infinity if there is none.
  double best() const { return cost(0, size() - 1); }
  /// The least cost of what fills the polygon between the segment from corner `first` to corner `last`
  /// and the corners in between, going forward; infinity if nothing does.
  double cost(uint32_t first, uint32_t last) const { return cost_[size_t(first) * size() + last]; }
  /// Appends the triangles of that. Precondition: the cost is finite.
  void trace(uint32_t first, uint32_t last, std::vector<uint32_t>& triples) const;
  /// Appends up to `most` of the triangles of surfaces that cost up to `limit`: those of the cheapest.
  void nearBest(double limit, size_t most, std::vector<uint32_t>& triples) const;

 private:
  const LoopSet& loops_;
  const TripleWeights& weights_;
  std::vector<uint32_t> vertices_;
  std::vector<double> cost_;    // [m^2] by first and last corner of a segment
  std::vector<uint32_t> apex_;  // [m^2] its best triangle's third corner
};

}  // namespace sf
