// The answer to a call: a surface in the caller's numbers and units, and the best of several.
#pragma once
#include <cstdint>
#include <vector>

#include "loops/answer/posed_problem.h"
#include "loops/answer/surface_terms.h"
#include "loops/problem/objective.h"

namespace sf {

struct Span {
  bool found = false;
  Space space = Space::All;              // the candidate space that the answer is from
  std::vector<Vec3> positions;           // [n'] input first, in input order, then inserted vertices
  std::vector<uint32_t> triangles;       // [3m], m = n' + 2k - 4, consistently wound
  std::vector<uint32_t> order;           // [m] triangles in the order of splitting
  std::vector<uint32_t> starts;          // [k+1] of loopVertices
  std::vector<uint32_t> loopVertices;    // [n'] the loops of the result as indices into positions
  std::vector<InsertedVertex> inserted;  // [n' - n]
  SpanTerms terms;
  double cost = 0;        // what the objective measures: weighted sum, or the largest angle
  double lowerBound = 0;  // proven; if optimal, the cost itself for sums, else within 1e-10 of it
  bool optimal = false;   // proven to be the least in `space`
  uint64_t candidates = 0, domains = 0, minimalSets = 0;
};

/// A surface in the solver's numbers and units.
struct SolvedSurface {
  const std::vector<uint32_t>& order;  // candidates, each but the first beside an earlier one
  bool optimal;                        // proven
  double lowerBound;                   // proven, of the objective with the scaled weights
};

/// The surface in the caller's numbers and units.
///   input  the caller's loops
///   own    [c] the candidates' own weights as scaled, or empty
Span answerOf(const LoopSet& input, const ScaledWeights& weights, Objective objective,
              const PosedProblem& problem, const CandidateSet& set, const SolvedSurface& surface,
              ArrayView<const double> own);

/// The best of the answers from several spaces: the cheapest. Of equally cheap ones it is the last,
/// which is from the widest space, but an unproven one does not replace a proven one.
class BestAnswer {
 public:
  explicit BestAnswer(Objective objective) : objective_(objective) {}
  void offer(const Span& answer);
  /// `found` is false while there is none.
  const Span& get() const { return best_; }

 private:
  Objective objective_;
  Span best_;
};

}  // namespace sf
