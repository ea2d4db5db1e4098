// The cheapest inner triangle at an edge, for every outer triangle at once.
// Source: the minimum over t in eq. 2 of Zou, Ju, Carr 2013, for dihedral weights.
// Differs: around an edge every triangle is a half-plane at an angle, and the dihedral angle is the
// distance on the circle between one of them and the opposite of the other. The minimum of
// base + weight * distance is then a distance transform: linear in the number of triangles,
// where the paper tries all pairs. This takes one polygon from O(n^4) to O(n^3).
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "loops/problem/weight.h"

namespace sf {

/// Holds scratch memory, so that one object serves many edges.
class AngularTransform {
 public:
  explicit AngularTransform(Measure measure) : measure_(measure) {}

  /// result[j] = the least join(base[i], pair(innerTheta[i], outerTheta[j])) over all i.
  ///   innerTheta, base   [inner] angles in [-pi, pi]; costs, infinity allowed
  ///   outerTheta, result [outer] angles in [-pi, pi]
  /// Sums: O(inner + outer). With a cap, or for maxima: O((inner + outer) log inner). Tries all
  /// pairs where that is less work.
  void apply(const double* innerTheta, const double* base, size_t inner, const double* outerTheta,
             size_t outer, double* result);

  /// The same for angles that increase on either side: no sorting, O(inner + outer) for sums.
  void applySorted(const double* innerTheta, const double* base, size_t inner,
                   const double* outerTheta, size_t outer, double* result);

  /// Products of inner and outer counts up to which all pairs are the fastest, as measured: for
  /// sums, and for maxima or with a cap. Tests change them, so that small input takes the other
  /// ways too.
#ifdef SF_TESTING
  static inline size_t fewPairs = 1500, fewPairsCapped = 20000;
#else
  static constexpr size_t fewPairs = 1500, fewPairsCapped = 20000;
#endif

 private:
  void allPairs(const double* innerTheta, const double* base, size_t inner,
                const double* outerTheta, size_t outer, double* result) const;
  void buckets(const double* innerTheta, const double* base, size_t inner, const double* outerTheta,
               size_t outer, double* result);
  void ranges(const double* innerTheta, const double* base, size_t inner, const double* outerTheta,
              size_t outer, double* result);
  void buildRangeMinima(std::vector<double>& levels) const;
  double rangeMinimum(const std::vector<double>& levels, size_t first, size_t last) const;

  Measure measure_;
  std::vector<uint32_t> bucketStart_, order_;
  std::vector<double> theta_, base_, before_, after_;
};

}  // namespace sf
