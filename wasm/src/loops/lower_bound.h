// What the exact solver asks of a bound on domains.
#pragma once
#include <cstdint>
#include <vector>

#include "loops/candidate_set.h"
#include "loops/domain.h"
#include "loops/weight.h"

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
};

/// For each slot the least bi-triangle weight that its triangle can have with another at that edge.
std::vector<double> leastPairs(const CandidateSet& set, Measure measure);

}  // namespace sf
