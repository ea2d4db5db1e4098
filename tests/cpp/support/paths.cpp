#include "support/paths.h"

#include <algorithm>
#include <limits>

#include "loops/bounds/fan_bound.h"
#include "loops/bounds/relaxed_bound.h"
#include "loops/bounds/two_loop_bound.h"
#include "loops/domains/exact_solver.h"
#include "loops/one_loop/polygon_solver.h"
#include "loops/solver.h"

namespace sftest {
namespace {

using sf::kInfinity;
using sf::kNone;

/// A problem as the solver's parts take it.
struct Posed {
  sf::LoopSet loops;
  sf::TriangleWeights weights;
  std::vector<double> own;  // [c] in the order of the set
  sf::CandidateSet set;
  sf::Work work;

  explicit Posed(const Problem& problem) : loops(loopSet(problem.curves)) {
    weights.area = problem.options.areaWeight;
    weights.perimeter = problem.options.perimeterWeight;
    weights.dihedral = problem.options.dihedralWeight;
    weights.normals = problem.normals;
  }

  void addCandidates(const Problem& problem) {
    std::vector<uint32_t> triples, order;
    if (problem.options.space == sf::Space::Given) {
      sf::givenTriples(loops, problem.triangles, work, triples, order);
      if (!problem.triangleWeights.empty())
        for (const uint32_t index : order) own.push_back(problem.triangleWeights[index]);
      weights.own = own;
    } else {
      sf::allTriples(loops, work, triples);
    }
    sf::buildCandidateSet(loops, weights, triples, work, set);
  }

  std::vector<uint32_t> corners(const sf::SplitOrder& order) const {
    std::vector<uint32_t> result;
    for (const uint32_t t : order)
      result.insert(result.end(), &set.triangles[3 * t], &set.triangles[3 * t] + 3);
    return result;
  }
};

bool looksAtAngles(const Problem& problem) {
  return problem.options.dihedralWeight > 0 ||
         problem.options.objective == sf::Objective::WorstDihedral;
}
bool isPolygon(const Problem& problem) {
  return problem.curves.size() == 1 && problem.options.space == sf::Space::All;
}
bool isPolygonWithAngles(const Problem& problem) {
  return isPolygon(problem) && looksAtAngles(problem);
}
bool isPolygonWithoutAngles(const Problem& problem) {
  return isPolygon(problem) && !looksAtAngles(problem);
}
bool hasOneLoop(const Problem& problem) { return problem.curves.size() == 1; }
bool hasTwoLoops(const Problem& problem) { return problem.curves.size() == 2; }
bool hasSeveralLoops(const Problem& problem) { return problem.curves.size() > 1; }
bool isForFans(const Problem& problem) {
  if (!hasSeveralLoops(problem)) return false;
  // What the solver does not take to fans, whatever it is told: many
  // candidates, and hubs.
  Posed posed(problem);
  posed.addCandidates(problem);
  return posed.set.size() > 0 && !(hasTwoLoops(problem) && sf::isLarge(posed.loops, posed.set)) &&
         sf::FanBound::bytesFor(posed.loops, posed.set) <=
             40 * sf::CandidateSet::bytesFor(double(posed.set.size()));
}
bool isInput(const Problem& problem) { return !loopsMeet(problem.curves); }

// --- one polygon over all triples

PathAnswer solveAsPolygon(const Problem& problem, size_t maxBytes) {
  const Posed posed(problem);
  sf::Work work(maxBytes, nullptr, nullptr);
  sf::PolygonSurface surface;
  PathAnswer answer;
  if (!sf::solvePolygon(posed.loops, posed.weights, problem.options.objective, work, surface))
    answer.fault = "the work ended";
  if (work.used() != 0) answer.fault += "memory was kept";
  answer.found = surface.found;
  answer.cost = answer.lowerBound = surface.lowerBound;
  answer.optimal = surface.optimal;
  answer.triangles = surface.triangles;
  return answer;
}
PathAnswer inDoubles(const Problem& problem, Random&) {
  return solveAsPolygon(problem, std::numeric_limits<size_t>::max());
}
PathAnswer inFloats(const Problem& problem, Random&) {
  // Three vertices take as much in floats, up to the rounding of sizes.
  return solveAsPolygon(problem, size_t(sf::bytesForPolygon(problem.vertexCount(), true)) + 3);
}

// --- a pass at a time over a set of candidates

struct Optimum {
  double cost = kInfinity;
  sf::SplitOrder order;
};
/// Solves one pass from the root edge after vertex `root`.
using PassSolver = bool (*)(const sf::Pass& pass, uint32_t root, Optimum& optimum);

bool runPass(Posed& posed, const std::vector<double>& cost, sf::Measure measure, uint32_t root,
             PassSolver solver, Optimum& optimum) {
  sf::SegmentTable segments;
  if (!segments.compute(posed.loops, posed.set, cost, measure, posed.work)) return false;
  return solver({{posed.loops, posed.set, cost, measure, posed.work}, segments}, root, optimum);
}

/// Sum: one pass. Worst angle: that first, then the sum under it.
PathAnswer solveByPasses(const Problem& problem, Random& random, PassSolver solver) {
  Posed posed(problem);
  posed.addCandidates(problem);
  PathAnswer answer;
  answer.optimal = true;
  const uint32_t root = random.below(posed.loops.vertexCount());
  if (posed.set.size() == 0 || posed.set.loopEdges[root] == kNone) return answer;
  const uint64_t before = posed.work.used();
  const double dihedral = posed.weights.dihedral;
  Optimum optimum;
  bool done = true;
  if (problem.options.objective == sf::Objective::Sum) {
    done = runPass(posed, posed.set.weight, sf::Measure::sum(dihedral), root, solver, optimum);
    answer.cost = optimum.cost;
  } else {
    std::vector<double> angle = posed.set.boundaryAngle;
    angle.resize(posed.set.size(), 0);
    done = runPass(posed, angle, sf::Measure::worst(), root, solver, optimum);
    answer.cost = optimum.cost;
    if (done && optimum.cost < kInfinity) {
      const double cap = optimum.cost + sf::kAngleTie;
      std::vector<double> weight = posed.set.weight;
      for (size_t t = 0; t < weight.size(); ++t)
        if (angle[t] > cap) weight[t] = kInfinity;
      optimum = {};
      done = runPass(posed, weight, sf::Measure::sum(dihedral, cap), root, solver, optimum);
      if (optimum.cost == kInfinity) answer.fault = "no surface under the least worst angle";
    }
  }
  if (!done) answer.fault += "the work ended";
  if (posed.work.used() != before) answer.fault += "memory was kept";
  answer.found = optimum.cost < kInfinity;
  answer.lowerBound = answer.cost;
  answer.triangles = posed.corners(optimum.order);
  return answer;
}

bool bySegments(const sf::Pass& pass, uint32_t root, Optimum& optimum) {
  const uint32_t edge = pass.set.loopEdges[root];
  const sf::ClosedSegment all{edge, pass.segments.sideFrom(edge, pass.loops.next(root))};
  const uint32_t slot = pass.segments.bestSplit(all, kNone);
  if (slot == kNone) return true;
  optimum.cost = pass.segments.splitValue(all, slot);
  sf::traceSegment(pass, all, kNone, optimum.order);
  return true;
}

bool byBound(const sf::Pass& pass, sf::LowerBound& bound, uint32_t root, int lazyRounds,
             Optimum& optimum) {
  sf::ExactSolver solver(pass, bound, root, lazyRounds);
  return solver.solve(kInfinity, optimum.cost, optimum.order);
}
bool byRelaxedBoundOnly(const sf::Pass& pass, uint32_t root, int lazyRounds, Optimum& optimum) {
  sf::RelaxedBound bound(pass);
  return bound.compute(sf::Domains(pass.loops).root(root), ~uint64_t(0)) &&
         byBound(pass, bound, root, lazyRounds, optimum);
}
bool byRelaxedBound(const sf::Pass& pass, uint32_t root, Optimum& optimum) {
  return byRelaxedBoundOnly(pass, root, sf::kLazyRounds, optimum);
}
bool byOneLazyRound(const sf::Pass& pass, uint32_t root, Optimum& optimum) {
  return byRelaxedBoundOnly(pass, root, 1, optimum);
}
bool withAllEdgesCritical(const sf::Pass& pass, uint32_t root, Optimum& optimum) {
  return byRelaxedBoundOnly(pass, root, 0, optimum);
}
/// Over the domains of surfaces that cost up to a tenth more than the optimum.
bool byFocusedBound(const sf::Pass& pass, uint32_t root, Optimum& optimum) {
  if (!byRelaxedBound(pass, root, optimum)) return false;
  if (pass.measure.isWorst() || optimum.cost == kInfinity) return true;
  sf::FanBound fans(pass.loops, pass.set, pass.triangleCost, pass.measure, pass.work);
  if (!fans.ascend(30, kInfinity)) return false;
  const std::vector<double> least = sf::leastPairs(pass.set, pass.measure);
  sf::FanEstimate estimate(pass.loops, fans.links(), least, pass.measure, fans.costs(), pass.work);
  const sf::Task task{pass.loops, pass.set, pass.triangleCost, pass.measure, pass.work, false};
  const double most = optimum.cost + 0.1 * std::fabs(optimum.cost) + 0.01;
  sf::Optimum found;
  sf::SolverCounts counts;
  if (!estimate.compute() ||
      !sf::solveWithin(task, estimate, least, most, sf::kUnlimited, found, counts))
    return false;
  optimum.cost = found.reached ? found.cost : kInfinity;
  optimum.order = found.order;
  return true;
}
bool byTwoLoopBound(const sf::Pass& pass, uint32_t root, Optimum& optimum) {
  sf::TwoLoopBound bound(pass, root);
  return bound.compute(~uint64_t(0)) && byBound(pass, bound, root, sf::kLazyRounds, optimum);
}
bool byOneContext(const sf::Pass& pass, uint32_t root, Optimum& optimum) {
  const double usual = sf::TwoLoopBound::contextBytes;
  sf::TwoLoopBound::contextBytes = 0;
  const bool done = byTwoLoopBound(pass, root, optimum);
  sf::TwoLoopBound::contextBytes = usual;
  return done;
}
/// Nothing is known in advance: the algorithm of fig. 6 as it stands.
class NoBound final : public sf::LowerBound {
 public:
  double value(sf::Shape, uint32_t) override { return -kInfinity; }
  double rootBound() const override { return -kInfinity; }
};
bool byDomainsAlone(const sf::Pass& pass, uint32_t root, Optimum& optimum) {
  NoBound bound;
  return byBound(pass, bound, root, 0, optimum);
}

template <PassSolver solver>
PathAnswer passes(const Problem& problem, Random& random) {
  return solveByPasses(problem, random, solver);
}

// --- through the solver's own choice

PathAnswer solveAsChosen(const Problem& problem, uint64_t firstSplits, bool anytime,
                         const std::vector<uint32_t>& start) {
  Posed posed(problem);
  posed.addCandidates(problem);
  const uint64_t before = posed.work.used();
  sf::SolveOptions options;
  options.dihedralWeight = posed.weights.dihedral;
  options.objective = problem.options.objective;
  options.anytime = anytime;
  options.firstSplits = firstSplits;
  const sf::LoopTriangles begin(posed.loops, start);
  options.start = &begin;
  sf::Surface surface;
  PathAnswer answer;
  if (!sf::solveSurface(posed.loops, posed.set, options, posed.work, surface))
    answer.fault = "the work ended";
  if (posed.work.used() != before) answer.fault += "memory was kept";
  answer.found = surface.found;
  answer.cost = answer.lowerBound = surface.lowerBound;
  answer.optimal = surface.optimal;
  answer.triangles = posed.corners(surface.order);
  return answer;
}

PathAnswer byFans(const Problem& problem, Random&) { return solveAsChosen(problem, 1, false, {}); }
/// From an earlier answer that is none: what is begun from must not matter.
PathAnswer bySearchFirst(const Problem& problem, Random& random) {
  return solveAsChosen(problem, sf::kUnlimited, true, randomTriples(problem.curves, 0.2, random));
}

PathAnswer bySpan(const Problem& problem, Random&) {
  const Answer span = solve(problem);
  PathAnswer answer;
  if (!span.outcome.ok()) answer.fault = "refused";
  answer.found = span.span.found;
  answer.cost = span.span.cost;
  answer.lowerBound = span.span.lowerBound;
  answer.optimal = span.span.optimal;
  for (const uint32_t t : span.span.order)
    answer.triangles.insert(answer.triangles.end(), &span.span.triangles[3 * t],
                            &span.span.triangles[3 * t] + 3);
  return answer;
}

}  // namespace

PathAnswer Path::answer(const Problem& problem, Random& random) const {
  const size_t pairs = sf::AngularTransform::fewPairs,
               capped = sf::AngularTransform::fewPairsCapped;
  sf::AngularTransform::fewPairs = sf::AngularTransform::fewPairsCapped =
      transform ? 0 : std::numeric_limits<size_t>::max();
  PathAnswer result = solve(problem, random);
  sf::AngularTransform::fewPairs = pairs, sf::AngularTransform::fewPairsCapped = capped;
  return result;
}

const std::vector<Path>& solverPaths() {
  constexpr uint32_t kAny = kNone;
  static const std::vector<Path> paths = {
      {"polygon, doubles, all pairs", false, 1e-9, kAny, 1, isPolygonWithAngles, inDoubles},
      {"polygon, doubles, transform", true, 1e-9, kAny, 1, isPolygonWithAngles, inDoubles},
      {"polygon, floats, all pairs", false, 4e-6, kAny, 1, isPolygonWithAngles, inFloats},
      {"polygon, floats, transform", true, 4e-6, kAny, 1, isPolygonWithAngles, inFloats},
      {"polygon without angles", false, 1e-9, kAny, 1, isPolygonWithoutAngles, inDoubles},
      {"segment table, all pairs", false, 1e-9, kAny, 1, hasOneLoop, passes<bySegments>},
      {"segment table, transform", true, 1e-9, kAny, 1, hasOneLoop, passes<bySegments>},
      {"relaxed bound, all pairs", false, 1e-9, kAny, 1, hasSeveralLoops, passes<byRelaxedBound>},
      {"relaxed bound, transform", true, 1e-9, kAny, 1, hasSeveralLoops, passes<byRelaxedBound>},
      {"focused bound, all pairs", false, 1e-9, kAny, 1, hasSeveralLoops, passes<byFocusedBound>},
      {"focused bound, transform", true, 1e-9, kAny, 2, hasSeveralLoops, passes<byFocusedBound>},
      {"two-loop bound, all pairs", false, 1e-9, kAny, 1, hasTwoLoops, passes<byTwoLoopBound>},
      {"two-loop bound, transform", true, 1e-9, kAny, 1, hasTwoLoops, passes<byTwoLoopBound>},
      {"two-loop bound, one context", false, 1e-9, kAny, 1, hasTwoLoops, passes<byOneContext>},
      {"fans, all pairs", false, 1e-9, kAny, 3, isForFans, byFans},
      {"fans, transform", true, 1e-9, kAny, 6, isForFans, byFans},
      {"search, then domains", false, 1e-9, kAny, 6, hasSeveralLoops, bySearchFirst},
      {"all edges after one round", false, 1e-9, 9, 2, hasSeveralLoops, passes<byOneLazyRound>},
      {"all edges from the start", false, 1e-9, 9, 2, hasSeveralLoops,
       passes<withAllEdgesCritical>},
      {"domains alone", false, 1e-9, 8, 2, hasTwoLoops, passes<byDomainsAlone>},
      {"span", false, 1e-9, kAny, 1, isInput, bySpan},
  };
  return paths;
}

}  // namespace sftest
