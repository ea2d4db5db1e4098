// One pass over one candidate set, solved by domains alone: for few loops, or few candidates.
// Source: Zou, Ju, Carr 2013, sec. 3: eq. 2 for one loop, figure 6 for several.
#pragma once
#include <cstdint>
#include <vector>

#include "loops/bounds/fan_estimate.h"
#include "loops/domains/exact_solver.h"
#include "loops/domains/pass.h"

namespace sf {

/// The optimum of a task, if it was reached; a surface, perhaps, if not.
struct Optimum {
  bool reached = false;
  double cost = kInfinity;         // infinity: there is no surface, or none that is cheap enough
  double lowerBound = -kInfinity;  // proven, also if the optimum was not reached
  SplitOrder order;
};

struct SolverCounts {
  uint64_t domains = 0, minimalSets = 0;
};

constexpr uint64_t kUnlimited = ~uint64_t(0);

/// Solves a task by the domains of all its candidates, unless that takes more than `maxSplits`
/// splits (several loops only), which leaves `optimum.reached` false. False when the work ended.
///   incumbent  cost of a surface that is known, only to be told of
bool solveDirectly(const Task& task, uint64_t maxSplits, double incumbent, Optimum& optimum,
                   SolverCounts& counts);

/// Solves a task of sums over several loops by those of its domains that a surface of at most `most`
/// (finite) can have, looking for cheaper ones first, unless that takes more than `maxSplits` splits.
/// Reached, without a surface: none costs `most` or less. False when the work ended.
///   estimate  of the same set and measure, at costs none of which exceeds the task's
///   leastPair  see lower_bound.h
bool solveWithin(const Task& task, FanEstimate& estimate, const std::vector<double>& leastPair,
                 double most, uint64_t maxSplits, Optimum& optimum, SolverCounts& counts);

/// Candidates for each triangle of a surface.
double candidatesPerTriangle(const LoopSet& loops, const CandidateSet& set);

/// Whether the candidates are many for the surface, so that whatever looks at each of them is slow.
bool isLarge(const LoopSet& loops, const CandidateSet& set);

/// Whether two loops have edges from one to the other nearly everywhere, so that vertex fans tell little.
bool isDense(const LoopSet& loops, const CandidateSet& set);

}  // namespace sf
