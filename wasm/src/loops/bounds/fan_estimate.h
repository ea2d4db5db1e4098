// What a domain costs at least, from the fans inside it: in place of R where R would be too much.
// Source: none in Zou, Ju, Carr 2013. The bound of fan_bound.h, for the part of a surface that fills a
// domain: whole fans at the vertices inside its segments and on its holes, parts of fans at the
// ends of its segments, between a loop edge and a spanning edge or between two of these. The multipliers
// of a triangle still sum to zero, since all three of its corners lie in the domain, and the number of
// triangles follows from the domain's shape, so that their price is known.
#pragma once
#include <cstdint>
#include <vector>

#include "base/charge.h"
#include "loops/bounds/fan_links.h"
#include "loops/domains/domain.h"

namespace sf {

/// Costs of fans at which a bound was found.
struct FanCosts {
  std::vector<double> corner;  // [3c] a third of w(t), multiplier, and price
  double price = 0;            // what each corner of a triangle has been charged
  double lowerBound = 0;       // on all surfaces
  double rounding = 0;         // at most how far rounding lifts what is found at these costs
};

class FanEstimate {
 public:
  /// `links` and `leastPair` (lower_bound.h) are of the same set and measure, and are kept.
  FanEstimate(const LoopSet& loops, const FanLinks& links, const std::vector<double>& leastPair,
              Measure measure, FanCosts costs, Work& work);

  /// The cheapest walks from both loop edges at each vertex; before anything else. O(candidates times
  /// the edges at a vertex). False when the work ended.
  bool compute();

  /// excess [c]: a surface that uses triangle t costs at least lowerBound() + excess[t]. Infinity for
  /// triangles that no fan can use.
  void excess(std::vector<double>& excess) const;

  /// A lower bound, but for rounding(), on what a domain costs in any surface that has it, the slot's
  /// triangle being its access triangle: as LowerBound::value. It may exceed R, which allows what is no
  /// surface. O(segments), once the walks that it needs are known.
  /// Precondition: lowerBound() is finite.
  double value(Shape shape, uint32_t slot);

  /// Triangles of whatever fills a domain.
  uint32_t triangleCount(Shape shape) const;

  double lowerBound() const { return costs_.lowerBound; }
  double rounding() const { return costs_.rounding; }

 private:
  /// Labels by spoke: of walks that arrive there, and of those that have turned over the edge.
  struct Walks {
    std::vector<double> arrive, turned;
    std::vector<double> edge;  // by edge: least, with the least bi-triangle weight that closes it
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
  std::vector<Walks> across_;      // by edge at a vertex, where they begin; empty until needed
  std::vector<double> fan_;        // [n] the cheapest
  std::vector<double> fansUntil_;  // [n + 1] sums of those before each vertex
  std::vector<double> leaving_;    // scratch
};

}  // namespace sf
