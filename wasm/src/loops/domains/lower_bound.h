// What the exact solver needs of a bound on domains.
#pragma once
#include <cstdint>
#include <vector>

#include "loops/domains/domain.h"
#include "loops/domains/pass.h"
#include "loops/problem/candidate_set.h"
#include "loops/problem/weight.h"

namespace sf {

class LowerBound {
 public:
  virtual ~LowerBound() = default;
  /// A lower bound on the cost of the domain of this canonical shape, with the slot's triangle as
  /// access triangle. Its bi-triangle weight with that triangle is counted. Infinity if no surface
  /// fills it. The slot is on the access edge,
  /// and its apex not inside one of the domain's segments.
  virtual double value(Shape shape, uint32_t slot) = 0;
  /// The same for the root. Infinity: there is no surface.
  virtual double rootBound() const = 0;
  /// The most that the same domain may cost in a surface that is of interest, in the units of
  /// value(). kNone as slot: the root. -infinity if no such surface has the domain.
  virtual double limit(Shape, uint32_t) { return kInfinity; }
};

/// For each slot the least bi-triangle weight that its triangle can have with another at that edge.
std::vector<double> leastPairs(const CandidateSet& set, Measure measure);

/// What a relaxation charges for a part that ends the recursion after a split by triangle t;
/// `leastPair` serves where only two triangles are left (PartKind::EmptyPair). 0 for domains.
double leafCost(const Pass& pass, const Domains& domains, const std::vector<double>& leastPair,
                const SplitPart& part, uint32_t t);

/// The access edge of a domain.
uint32_t accessEdge(const CandidateSet& set, const Domains& domains, Shape shape);

}  // namespace sf
