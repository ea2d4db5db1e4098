#include "loops/answer/span_answer.h"

#include <algorithm>
#include <cmath>

#include "base/sort.h"
#include "loops/problem/weight.h"

namespace sf {

Span answerOf(const LoopSet& input, const ScaledWeights& weights, Objective objective,
              const PosedProblem& problem, const CandidateSet& set, const SolvedSurface& surface,
              ArrayView<const double> own) {
  Span span;
  std::vector<uint32_t> triangles = surface.order;
  sf::sort(triangles.begin(), triangles.end());
  span.found = true;
  span.optimal = surface.optimal;
  span.candidates = set.size();
  windConsistently(problem.loops, set, triangles, span.triangles);
  for (uint32_t& v : span.triangles) v = problem.resultIndex[v];
  for (const uint32_t t : surface.order)
    span.order.push_back(
        uint32_t(std::lower_bound(triangles.begin(), triangles.end(), t) - triangles.begin()));
  span.positions.assign(input.positions().begin(), input.positions().end());
  span.positions.insert(span.positions.end(), problem.insertedPositions.begin(),
                        problem.insertedPositions.end());
  span.inserted = problem.inserted;
  span.starts.assign(problem.loops.starts().begin(), problem.loops.starts().end());
  span.loopVertices = problem.resultIndex;

  SpanTerms& terms = span.terms;
  terms = measureTerms(problem.loops, set, triangles, problem.normals, own);
  const bool isSum = objective == Objective::Sum;
  span.cost = isSum ? weights.cost(weights.area * terms.area + weights.perimeter * terms.perimeter +
                                   weights.dihedral * terms.dihedral + terms.own)
                    : terms.worstDihedral;
  terms.own = weights.cost(terms.own);
  terms.area = std::ldexp(terms.area, 2 * weights.lengthExponent);
  terms.perimeter = weights.length(terms.perimeter);
  // Sums in another order differ in the last digits: that is no gap.
  const double bound = isSum ? weights.cost(surface.lowerBound) : surface.lowerBound;
  span.lowerBound = isSum && surface.optimal ? span.cost : std::min(span.cost, bound);
  return span;
}

void BestAnswer::offer(const Span& answer) {
  // Sums in another order differ in the last digits.
  const double tie =
      objective_ == Objective::WorstDihedral ? kAngleTie : 1e-12 * std::fabs(best_.cost);
  const bool isCheaper = answer.cost < best_.cost - tie;
  const bool isTied = answer.cost <= best_.cost + tie && (answer.optimal || !best_.optimal);
  if (!best_.found || isCheaper || isTied) best_ = answer;
}

}  // namespace sf
