// What the exact solver asks of a bound on domains.
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
  /// A lower bound on the cost of the domain of that canonical shape, with the slot's triangle as
  /// access triangle, whose bi-triangle weight is counted; infinity if no surface fills it. The
  /// slot is on the access edge, and its apex not inside one of the domain's segments.
  virtual double value(Shape shape, uint32_t slot) = 0;
  /// The same for the root. Infinity: there is no surface.
  virtual double rootBound() const = 0;
  /// What the same domain may cost at most within a surface that is of interest, in the units of value();
  /// kNone as slot: the root. -infinity if none of them has it.
  virtual double limit(Shape, uint32_t) { return kInfinity; }
};

/// For each slot the least bi-triangle weight that its triangle can have with another at that edge.
std::vector<double> leastPairs(const CandidateSet& set, Measure measure);

/// What a relaxation charges for a part of a split by triangle t that ends the recursion, with `leastPair`
/// where two triangles are all that is left; 0 for domains.
double leafCost(const Pass& pass, const Domains& domains, const std::vector<double>& leastPair,
                const SplitPart& part, uint32_t t);

/// The access edge of a domain.
uint32_t accessEdge(const CandidateSet& set, const Domains& domains, Shape shape);

}  // namespace sf
