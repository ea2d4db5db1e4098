// A lower bound on the cost of a domain, from the fans inside it: for use where R (relaxed_bound.h)
// would take too long.
// Source: none in Zou, Ju, Carr 2013. The bound of fan_bound.h, for the part of a surface that
// fills a domain. That part has whole fans at the vertices inside the domain's segments and on its
// holes. At the ends of segments it has parts of fans: between a loop edge and a spanning edge, or
// between two spanning edges. The multipliers of a triangle still sum to zero, since all three of
// its corners lie in the domain. The number of triangles follows from the domain's shape, so their
// price is known.
#pragma once
#include <cstdint>
#include <vector>

#include "base/charge.h"
#include "loops/bounds/fan_links.h"
#include "loops/domains/domain.h"

namespace sf {

/// Costs of fans for which a bound was found.
struct FanCosts {
  std::vector<double> corner;  // [3c] a third of w(t), multiplier, and price
  double price = 0;            // the price charged at each corner of a triangle
  double lowerBound = 0;       // on all surfaces
  double rounding = 0;         // the most by which rounding lifts bounds found with these costs
};

class FanEstimate {
 public:
  /// `links` and `leastPair` (lower_bound.h) are of the same set and measure,
  /// and have to outlive it.
  FanEstimate(const LoopSet& loops, const FanLinks& links, const std::vector<double>& leastPair,
              Measure measure, FanCosts costs, Work& work);

  /// Finds the cheapest walks from both loop edges at each vertex. Must be called first.
  /// O(candidates times the edges at a vertex). False when the work ended.
  bool compute();

  /// excess [c]: a surface that uses triangle t costs at least lowerBound() + excess[t]. Infinity
  /// for triangles that no fan can use.
  void excess(std::vector<double>& excess) const;

  /// A lower bound on what a domain costs in any surface that has it, with the slot's triangle as
  /// access triangle, as LowerBound::value. Rounding may lift it by up to rounding(). It may exceed
  /// R, since R allows fillings that are no surface. O(segments),
  /// once the walks that it needs are known.
  /// Precondition: lowerBound() is finite.
  double value(Shape shape, uint32_t slot);

  /// The number of triangles that fill a domain.
  uint32_t triangleCount(Shape shape) const;

  double lowerBound() const { return costs_.lowerBound; }
  double rounding() const { return costs_.rounding; }

 private:
  /// Labels by spoke: of walks that arrive there, and of walks that have turned over its edge.
  struct Walks {
    std::vector<double> arrive, turned;
    std::vector<double> edge;  // by edge: the cheapest walk, closed by the least bi-triangle weight
  };
  using Vertex = FanLinks::Vertex;

  void walk(const Vertex& v, uint32_t fromEdge, double* arrive);
  void closeEdges(const Vertex& v, const double* arrive, double* edge) const;
  const Walks& walksAcross(uint32_t v, uint32_t fromEdge);
  double partOfFan(uint32_t v, uint32_t edge, bool fromStart, uint32_t accessIndex) const;
  double fanBetween(uint32_t v, uint32_t first, uint32_t next, uint32_t firstAccess,
                    uint32_t nextAccess);
  double wholeFans(Segment s) const;

  const LoopSet& loops_;
  const FanLinks& links_;
  const std::vector<double>& leastPair_;
  FanCosts costs_;
  Work& work_;
  Charge memory_;
  Domains domains_;
  AngularTransform transform_;
  Walks fromStart_, fromEnd_;      // at all vertices, one after the other
  std::vector<Walks> across_;      // by edge at a vertex where they begin; empty until needed
  std::vector<double> fan_;        // [n] the cheapest fan at each vertex
  std::vector<double> fansUntil_;  // [n + 1] sums of the fans before each vertex
  std::vector<double> leaving_;    // scratch
};

}  // namespace sf
