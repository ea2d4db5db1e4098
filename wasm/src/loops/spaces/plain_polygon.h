// The optimum of every segment of one polygon, over all triples of its corners,
// if angles do not count.
// Source: eq. 1 of Zou, Ju, Carr 2013, sec. 3.1 (Barequet, Sharir 1995).
// Differs: segments begin at any corner and go all the way round. So the optimum on either side of
// each segment is known, and with it the cost of the best surface through a given triangle. A
// vertex may be at several corners. Segments that no surface can have are left out.
#pragma once
#include <cstdint>
#include <vector>

#include "loops/problem/candidate_set.h"
#include "loops/problem/loop_set.h"

namespace sf {

/// The weights of all triples of a few vertices, without angles.
class TripleWeights {
 public:
  /// weights: without own weights. n^3 doubles.
  TripleWeights(const LoopSet& loops, const TriangleWeights& weights);

  /// The weight of a triple in any order; infinity if it is (nearly) collinear.
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
  /// The least cost of filling the part of the polygon between the chord from corner `first` to
  /// corner `last` and the corners passed going forward; infinity if nothing fills it.
  double cost(uint32_t first, uint32_t last) const { return cost_[size_t(first) * size() + last]; }
  /// Appends the triangles of that filling. Precondition: the cost is finite.
  void trace(uint32_t first, uint32_t last, std::vector<uint32_t>& triples) const;
  /// Appends up to `most` triangles of surfaces that cost `limit` or less:
  /// those of the cheapest ones.
  void nearBest(double limit, size_t most, std::vector<uint32_t>& triples) const;

 private:
  const LoopSet& loops_;
  const TripleWeights& weights_;
  std::vector<uint32_t> vertices_;
  std::vector<double> cost_;    // [m^2] by first and last corner of a segment
  std::vector<uint32_t> apex_;  // [m^2] its best triangle's third corner
};

}  // namespace sf
