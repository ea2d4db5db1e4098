// One pass over one candidate set, solved by domains alone: for few loops, or few candidates.
// Source: Zou, Ju, Carr 2013, sec. 3: eq. 2 for one loop, figure 6 for several.
#pragma once
#include <cstdint>
#include <vector>

#include "loops/bounds/fan_estimate.h"
#include "loops/domains/exact_solver.h"
#include "loops/domains/pass.h"

namespace sf {

/// The optimum of a task; or, if it was not reached, perhaps some surface.
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

/// Solves a task by the domains of all its candidates. Gives up after `maxSplits` splits (several
/// loops only), and leaves `optimum.reached` false. False when the work ended.
///   incumbent  cost of a known surface, used only to report progress
bool solveDirectly(const Task& task, uint64_t maxSplits, double incumbent, Optimum& optimum,
                   SolverCounts& counts);

/// Solves a task of sums over several loops. Visits only domains that a surface of cost `most`
/// (finite) or less can have, and looks for cheaper surfaces first. Gives up after `maxSplits`
/// splits. If `reached` is true without a surface, none costs `most` or less.
/// False when the work ended.
///   estimate   of the same set and measure, with triangle costs that nowhere exceed the task's
///   leastPair  see lower_bound.h
bool solveWithin(const Task& task, FanEstimate& estimate, const std::vector<double>& leastPair,
                 double most, uint64_t maxSplits, Optimum& optimum, SolverCounts& counts);

/// Candidates for each triangle of a surface.
double candidatesPerTriangle(const LoopSet& loops, const CandidateSet& set);

/// Whether there are so many candidates for each triangle of a surface that looking at all of them
/// is slow.
bool isLarge(const LoopSet& loops, const CandidateSet& set);

/// Whether there are two loops, and edges join at least a quarter of all pairs of their vertices.
/// Bounds by vertex fans are poor then.
bool isDense(const LoopSet& loops, const CandidateSet& set);

}  // namespace sf
