#include "loops/span.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/predicates.h"
#include "delaunay/delaunay.h"
#include "loops/answer/posed_problem.h"
#include "loops/answer/span_answer.h"
#include "loops/one_loop/polygon_solver.h"
#include "loops/problem/candidate_set.h"
#include "loops/problem/loop_check.h"
#include "loops/solver.h"
#include "loops/spaces/edge_protection.h"
#include "loops/spaces/first_surface.h"
#include "loops/spaces/near_space.h"

namespace sf {
namespace {

/// `auto` takes all triples at once if they are predicted to take no more than this, in nanoseconds of
/// native code. Less for two loops: on noisy ones, the domains that the prediction leaves out take ten times
/// as long.
constexpr double kPatience = 3e8, kPatienceForTwo = 4e7;
/// The most vertices of one loop for which `auto` tries to better a surface by near triples: about a second.
constexpr uint32_t kAutoNear = 2000;
/// Mean dihedral angles. Up to kSmooth a surface is smooth: not much can be gained for the time that near
/// triples of large loops take. Up to kFlat it is flat: nothing can be gained.
constexpr double kSmooth = 0.05, kFlat = 1e-3;
/// The most vertices of one loop, and of several together, for which near triples are quick.
constexpr uint32_t kQuickNear = 1000, kQuickNearOfMany = 80;
/// Units of work, some nanoseconds each, that `auto` allows. Near triples whose time is not known beforehand
/// get kNearShare times what the facets took, from kLeastNear to kMostNearUnits. If there is a first surface,
/// the facets get kMostFacets for finding one among them, or kMostFacetsUnwatched without bestSoFar.
constexpr uint64_t kNearShare = 2, kLeastNear = 200'000'000, kMostNearUnits = 2'000'000'000;
constexpr uint64_t kMostFacets = 300'000'000, kMostFacetsUnwatched = 20'000'000'000;
/// Share of the work that a first surface is.
constexpr double kShareOfFirst = 0.05;
/// The most vertices of one loop for which all triples are the quickest space if no angles count.
constexpr uint32_t kPlainPolygon = 1000;
/// How many nearest neighbours the `near` space takes: at first, and when it is not widened further.
constexpr uint32_t kFirstReach = 8, kLastReach = 64;
/// Candidates beyond which the `near` space is not widened further.
constexpr double kMostNear = 4e6;
/// How often the `near` space of two loops is enlarged around its optimum, at most.
constexpr uint32_t kNearRounds = 3;
/// Beyond this many vertices, the candidates of earlier rounds stay. That takes half as much time again.
/// Where all triples would take a second, it finds a surface within 1.02 of their optimum in 19 of 20 cases,
/// not 18.
constexpr uint32_t kKeepNear = 40;

Outcome checkOptions(const LoopSet& loops, const SpanOptions& options) {
  const double weights[] = {options.areaWeight, options.perimeterWeight, options.dihedralWeight};
  bool any = std::isnan(options.areaWeight);
  for (const double w : weights) {
    if (w < 0 || std::isinf(w)) return {Status::BadWeights};
    any = any || w > 0;
  }
  if (std::isnan(options.perimeterWeight) || std::isnan(options.dihedralWeight))
    return {Status::BadWeights};
  for (size_t t = 0; t < options.triangleWeights.size(); ++t) {
    if (!(std::fabs(options.triangleWeights[t]) < kInfinity))
      return {Status::BadCandidates, kNone, uint32_t(t)};
    any = any || options.triangleWeights[t] != 0;
  }
  if (!any) return {Status::BadWeights};
  for (uint32_t v = 0; 3 * size_t(v) < options.boundaryNormals.size(); ++v) {
    const double* n = &options.boundaryNormals[3 * size_t(v)];
    if (std::isnan(n[0]) && std::isnan(n[1]) && std::isnan(n[2])) continue;
    const bool good = std::isfinite(n[0]) && std::isfinite(n[1]) && std::isfinite(n[2]) &&
                      (n[0] != 0 || n[1] != 0 || n[2] != 0);
    const uint32_t loop = loops.loopOf(v);
    if (!good) return {Status::BadNormals, loop, v - loops.first(loop)};
  }
  return {};
}

/// Runs one span, space after space, until one holds a surface.
class Spanning {
 public:
  Spanning(const LoopSet& loops, const SpanOptions& options, Work& work)
      : input_(loops),
        options_(options),
        work_(work),
        best_(options.objective),
        first_(unit_),
        wantsUnproven_(options.bestSoFar),
        seed_(unit_) {
    std::vector<Vec3> scaled;
    const int exponent = scaleToUnit(loops.positions(), scaled);
    unit_ = LoopSet(scaled, loops.starts());
    weights_ = scaleWeights(options.areaWeight, options.perimeterWeight, options.dihedralWeight,
                            options.triangleWeights, unit_, exponent);
  }

  Outcome run(Span& result) {
    // The cost, a sum over the triangles, has to stay far below infinity.
    if (weights_.costExponent > 960) return {Status::BadWeights};
    const Outcome outcome = runSpace();
    // A surface that was found is returned, unless the caller ended the work and wants nothing unfinished.
    // It also stays if a wider space then does not fit into memory.
    const bool isEnded = work_.status() == Status::Stopped && !options_.bestSoFar;
    const bool isFound = best_.get().found && !isEnded;
    if (isFound) {
      result = best_.get();
      if (!work_.going()) {
        // Wider spaces were not searched to the end, and the bound has to hold for them too.
        const double bound = work_.lowerBound();
        result.optimal = false;
        result.lowerBound = std::min(result.lowerBound, bound);
      }
    } else {
      result.space = space_;
      result.candidates = candidates_;
    }
    result.domains = domains_;
    result.minimalSets = minimalSets_;
    return isFound ? Outcome() : isEnded ? Outcome{work_.status()} : outcome;
  }

 private:
  Outcome runSpace() {
    switch (options_.space) {
      case Space::All:
        return runAll();
      case Space::Delaunay:
        return runDelaunay();
      case Space::Near:
        return isPlainPolygon() && allTriplesFit() ? runAll() : runNear();
      case Space::Given:
        return runGiven();
      case Space::Auto:
        break;
    }
    return runAuto();
  }

  /// All triples if that is quick, else Delaunay facets. Then near triples, if the facets hold no surface, or
  /// one that can probably be bettered.
  Outcome runAuto() {
    const uint32_t k = unit_.loopCount();
    const double patience = k == 2 ? kPatienceForTwo : kPatience;
    const bool isQuick = predictedTimeOfAllTriples(unit_) <= patience || isPlainPolygon();
    if (isQuick && allTriplesFit()) return runAll();
    partShare_ = 0.5;
    const bool isTimeKnown = k == 1 || (k == 2 && hasNearOptimalTriples(unit_, work_));
    if (k > 1 && (options_.bestSoFar || !isTimeKnown) && !offerFirst()) return {work_.status()};
    // It may take for ever to prove that the facets hold no surface. The first one found lifts the allowance.
    const uint64_t before = work_.spent();
    if (best_.get().found)
      work_.beginAllowance(options_.bestSoFar ? kMostFacets : kMostFacetsUnwatched);
    Outcome outcome = runDelaunay();
    if (work_.endAllowance()) outcome = {Status::NotFound};
    const uint64_t spent = work_.spent() - before;
    if (outcome.status == Status::NotFound || (outcome.ok() && isNearWorthwhile()))
      outcome = runNearFor(std::clamp(kNearShare * spent, kLeastNear, kMostNearUnits));
    return outcome.status == Status::NotFound && !best_.get().found && allTriplesFit() ? runAll()
                                                                                       : outcome;
  }

  /// Near triples after facets. For more than two loops, or many vertices, the time for their optimum is
  /// unknown. A surface that is better than the facets' is then taken without a proof.
  Outcome runNearFor(uint64_t units) {
    if (options_.bestSoFar || hasNearOptimalTriples(unit_, work_) || !best_.get().found)
      return runNear();
    wantsUnproven_ = true;
    work_.beginAllowance(units);
    const Outcome outcome = runNear();
    wantsUnproven_ = false;
    // `best_` already holds what was found.
    return work_.endAllowance() ? Outcome() : outcome;
  }

  /// Whether near triples are likely to hold a surface so much better that it is worth their time.
  bool isNearWorthwhile() const {
    const uint32_t k = unit_.loopCount(), n = unit_.vertexCount();
    if (k == 1 && n > kAutoNear) return false;
    const bool isQuick = n <= (k == 1 ? kQuickNear : kQuickNearOfMany);
    return meanBend() > (isQuick ? kFlat : kSmooth);
  }

  /// The cost of the best surface found, as an angle: the mean over its inner edges, or the largest one.
  double meanBend() const {
    const Span& found = best_.get();
    if (options_.objective == Objective::WorstDihedral) return found.cost;
    if (options_.dihedralWeight == 0) return kInfinity;
    const double innerEdges = 0.5 * double(found.triangles.size() - unit_.vertexCount());
    return found.cost / (options_.dihedralWeight * innerEdges);
  }

  /// Finds a surface over the caller's loops, for spaces that are made around one. False if the work ended.
  bool findFirst() {
    if (unit_.loopCount() == 1 || !first_.isEmpty() || !hasFirstSurface(unit_)) return true;
    std::vector<uint32_t> triangles;
    if (!firstSurface(unit_, guidingWeights(asGiven()), work_, triangles)) return false;
    first_ = LoopTriangles(unit_, triangles);
    return true;
  }

  /// Takes the first surface as an answer. False if the work ended.
  bool offerFirst() {
    partShare_ = kShareOfFirst;
    beginSpace(Space::Near);
    partShare_ = 0.5;
    if (!findFirst()) return false;
    if (first_.isEmpty()) return true;
    const PosedProblem problem = asGiven();
    std::vector<uint32_t> triples;
    CandidateSet set;
    const uint64_t before = work_.used();
    const bool built =
        facetTriples(unit_, first_.vertices(), work_, triples) &&
        buildCandidateSet(unit_, triangleWeights(problem, {}), std::move(triples), work_, set);
    work_.release(work_.used() - before);
    if (!built) return false;
    candidates_ = set.size();
    SplitOrder order(set.size());
    std::iota(order.begin(), order.end(), 0u);
    if (!isSurface(unit_, set, order)) return true;
    take(problem, set, {order, false, 0}, {});
    if (listens()) tell(last_);
    return true;
  }

  /// Begins a space. Its share of the work is half of what is left, while other spaces may follow.
  ///   lowerBound  of the scaled cost, proven from the start
  void beginSpace(Space space, double lowerBound = 0) {
    space_ = space;
    const double end = done_ + partShare_ * (1 - done_);
    const bool isSum = options_.objective == Objective::Sum;
    work_.beginPart(done_, end, isSum ? weights_.costExponent : 0,
                    isStandIn_ ? standInBound_ : lowerBound, isStandIn_);
    done_ = end;
  }

  bool looksAtAngles() const {
    return weights_.dihedral > 0 || options_.objective == Objective::WorstDihedral;
  }

  /// Whether all triples take less time than near ones, so that `near` takes them all: for one loop
  /// without angles in its cost.
  bool isPlainPolygon() const {
    return unit_.loopCount() == 1 && !looksAtAngles() && unit_.vertexCount() <= kPlainPolygon;
  }

  bool allTriplesFit() const {
    const double n = unit_.vertexCount(), count = n * (n - 1) * (n - 2) / 6;
    if (unit_.loopCount() == 1) return work_.fits(bytesForPolygon(n, looksAtAngles()));
    return count < double(kNone / 3) && work_.fits(bytesToSolve(count));
  }
  /// Candidates, and the segment table's two numbers for each of three slots.
  static double bytesToSolve(double candidates) {
    return CandidateSet::bytesFor(candidates) + 48 * candidates;
  }

  TriangleWeights triangleWeights(const PosedProblem& problem,
                                  const std::vector<double>& own) const {
    TriangleWeights weights;
    weights.area = weights_.area;
    weights.perimeter = weights_.perimeter;
    weights.dihedral = weights_.dihedral;
    weights.normals = problem.normals;
    weights.own = own;
    return weights;
  }

  /// Weights for surfaces to begin from. For the worst angle they weigh the sum of angles: a small sum goes
  /// with small angles.
  TriangleWeights guidingWeights(const PosedProblem& problem) const {
    TriangleWeights weights = triangleWeights(problem, {});
    if (options_.objective == Objective::WorstDihedral) weights.dihedral = 1;
    return weights;
  }

  PosedProblem asGiven() const { return posedAsGiven(unit_, options_.boundaryNormals); }

  Outcome runAll() {
    if (unit_.loopCount() == 1) return runPolygon();
    partShare_ = 1;
    beginSpace(Space::All);
    if (!allTriplesFit()) return {Status::TooLarge};
    std::vector<uint32_t> triples;
    if (!allTriples(unit_, work_, triples)) return {work_.status()};
    return solve(asGiven(), std::move(triples), {});
  }

  /// One loop over all triples. There is no surface before the optimum. So if that takes long, near
  /// triples give the surface that bestSoFar falls back to.
  Outcome runPolygon() {
    if (options_.bestSoFar && predictedTimeOfAllTriples(unit_) > kPatience) {
      isStandIn_ = true;
      standInBound_ = boundOfLoopEdges();
      runNear();
      isStandIn_ = false;
    }
    partShare_ = 1;
    beginSpace(Space::All);
    return allTriplesFit() ? solveAllTriples() : Outcome{Status::TooLarge};
  }

  /// A lower bound, by weights_, on the cost of every surface over one loop: each loop edge has a triangle, and a
  /// triangle has at most two loop edges. O(n^2).
  double boundOfLoopEdges() const {
    if (options_.objective == Objective::WorstDihedral) return 0;
    const uint32_t n = unit_.vertexCount();
    double sum = 0;
    for (uint32_t v = 0; v < n; ++v) {
      double least = kInfinity;
      for (uint32_t i = 2; i < n; ++i) {
        const Vec3 a = unit_.position(v), b = unit_.position((v + 1) % n),
                   c = unit_.position((v + i) % n);
        const double perimeter = distance(a, b) + distance(b, c) + distance(c, a);
        least = std::min(least, weights_.area * 0.5 * length(cross(b - a, c - a)) +
                                    weights_.perimeter * perimeter);
      }
      sum += 0.5 * least;
    }
    return sum;
  }

  Outcome solveAllTriples() {
    const PosedProblem problem = asGiven();
    const TriangleWeights weights = triangleWeights(problem, {});
    PolygonSurface polygon;
    const double n = unit_.vertexCount();
    candidates_ = uint64_t(n * (n - 1) * (n - 2) / 6);
    domains_ = minimalSets_ = uint64_t(n * (n - 1) / 2);
    if (!solvePolygon(unit_, weights, options_.objective, work_, polygon)) return {work_.status()};
    if (!polygon.found) return {Status::NotFound};
    CandidateSet set;
    const uint64_t before = work_.used();
    const bool built = buildCandidateSet(unit_, weights, std::move(polygon.triangles), work_, set);
    work_.release(work_.used() - before);
    if (!built) return {work_.status()};
    std::vector<uint32_t> order(set.size());
    std::iota(order.begin(), order.end(), 0u);
    take(problem, set, {order, polygon.optimal, polygon.lowerBound}, {});
    return {};
  }

  Outcome runGiven() {
    double least = 0;
    if (options_.objective == Objective::Sum)
      for (const double w : options_.triangleWeights) least += std::min(0.0, weights_.own(w));
    beginSpace(Space::Given, least);
    if (!work_.fits(bytesToSolve(double(options_.triangles.size() / 3)))) return {Status::TooLarge};
    std::vector<uint32_t> triples, order;
    const Outcome outcome = givenTriples(unit_, options_.triangles, work_, triples, order);
    if (!outcome.ok()) return outcome;
    std::vector<double> own;
    if (!options_.triangleWeights.empty())
      for (const uint32_t index : order)
        own.push_back(weights_.own(options_.triangleWeights[index]));
    return solve(asGiven(), std::move(triples), own);
  }

  Outcome runDelaunay() {
    beginSpace(Space::Delaunay);
    ProtectedLoops safe;
    const Status status = protectEdges(unit_, work_, safe);
    if (status != Status::Ok) return {status};
    std::vector<uint32_t> triples;
    if (!facetTriples(safe.loops, safe.facets, work_, triples)) return {work_.status()};
    return solve(posedProtected(unit_, options_.boundaryNormals, weights_, std::move(safe)),
                 std::move(triples), {});
  }

  /// Candidates are the facets and the triples of near-optimal surfaces. For two loops with angles,
  /// rounds follow with the optimum so far and the triples around it, until it gets no better.
  Outcome runNearOptimal(std::vector<uint32_t> list) {
    const PosedProblem problem = asGiven();
    const TriangleWeights weights = guidingWeights(problem);
    const bool isDone = unit_.loopCount() == 1 || weights.dihedral == 0;
    std::vector<BridgeTrial> trials;
    double before = kInfinity;
    // The facets' surface only adds candidates. The search does not begin there: it may be far from the best.
    for (const LoopTriangles* known : {&seed_, &first_})
      list.insert(list.end(), known->vertices().begin(), known->vertices().end());
    seed_ = LoopTriangles(unit_);
    for (uint32_t round = 0;; ++round) {
      std::vector<uint32_t> triples;
      if (!nearOptimalTriples(seed_, weights, work_, trials, list) ||
          !facetTriples(unit_, list, work_, triples))
        return {work_.status()};
      const Outcome outcome = solve(problem, std::move(triples), {});
      if (!outcome.ok()) return outcome;
      const bool isBetter = round == 0 || last_.cost < before - 1e-9 * std::fabs(before);
      if (isDone || !isBetter || round == kNearRounds || !work_.going()) return {};
      before = last_.cost;
      if (unit_.vertexCount() <= kKeepNear) list.clear();
      list.insert(list.end(), seed_.vertices().begin(), seed_.vertices().end());
      beginSpace(Space::Near);
    }
  }

  Outcome runNear() {
    partShare_ = 0.5;
    beginSpace(Space::Near);
    Delaunay cells;
    const Status status = delaunay(unit_.positions(), work_, cells);
    if (status != Status::Ok) return {status};
    if (hasNearOptimalTriples(unit_, work_)) {
      const Outcome outcome = runNearOptimal(cells.facets);
      if (outcome.status != Status::NotFound) return outcome;
      beginSpace(Space::Near);
    }
    if (!findFirst()) return {work_.status()};
    std::vector<uint32_t> list = cells.facets;
    list.insert(list.end(), first_.vertices().begin(), first_.vertices().end());
    for (uint32_t reach = kFirstReach;; reach *= 2) {
      if (reach > kFirstReach) beginSpace(Space::Near);
      const double predicted = predictedNearTriples(unit_, reach) + double(list.size() / 3);
      if (reach > kFirstReach && predicted > kMostNear) break;
      if (!work_.fits(bytesToSolve(predicted))) return {Status::TooLarge};
      std::vector<uint32_t> triples;
      if (!nearTriples(unit_, list, reach, work_, triples)) return {work_.status()};
      const Outcome outcome = solve(asGiven(), std::move(triples), {});
      if (outcome.status != Status::NotFound) return outcome;
      if (reach >= kLastReach || reach >= unit_.vertexCount()) break;
    }
    return {Status::NotFound};
  }

  Outcome solve(const PosedProblem& problem, std::vector<uint32_t> triples,
                const std::vector<double>& own) {
    candidates_ = triples.size() / 3;
    if (!work_.fits(bytesToSolve(double(candidates_)))) return {Status::TooLarge};
    const TriangleWeights weights = triangleWeights(problem, own);
    CandidateSet set;
    Surface surface;
    Listener listener(*this, problem, set, own);
    // The caller's surface, or one that this space was made around.
    LoopTriangles start = problem.fromResult(options_.start);
    if (start.isEmpty() && space_ == Space::Near && !first_.isEmpty())
      start = problem.fromResult(first_.vertices());
    SolveOptions solving;
    solving.dihedralWeight = weights_.dihedral;
    solving.objective = options_.objective;
    solving.anytime = wantsUnproven_;
    solving.start = &start;
    solving.listener = &listener;
    const uint64_t before = work_.used();
    const bool done = buildCandidateSet(problem.loops, weights, std::move(triples), work_, set) &&
                      solveSurface(problem.loops, set, solving, work_, surface);
    work_.release(work_.used() - before);
    domains_ += surface.domains;
    minimalSets_ += surface.minimalSets;
    if (!done && !(wantsUnproven_ && surface.found)) return {work_.status()};
    if (!surface.found) return {Status::NotFound};
    take(problem, set, {surface.order, surface.optimal, surface.lowerBound}, own);
    return {};
  }

  /// Gets every better surface, and passes it on to the caller.
  class Listener final : public SurfaceListener {
   public:
    Listener(Spanning& spanning, const PosedProblem& problem, const CandidateSet& set,
             const std::vector<double>& own)
        : spanning_(spanning), problem_(problem), set_(set), own_(own) {}
    void better(const SplitOrder& order, double lowerBound) override {
      if (spanning_.space_ == Space::Delaunay && spanning_.work_.going())
        spanning_.work_.endAllowance();
      if (!spanning_.listens()) return;
      spanning_.tell(spanning_.answer(problem_, set_, {order, false, lowerBound}, own_));
    }

   private:
    Spanning& spanning_;
    const PosedProblem& problem_;
    const CandidateSet& set_;
    const std::vector<double>& own_;
  };

  Span answer(const PosedProblem& problem, const CandidateSet& set, const SolvedSurface& surface,
              const std::vector<double>& own) const {
    Span span = answerOf(input_, weights_, options_.objective, problem, set, surface, own);
    span.space = space_;
    span.candidates = candidates_;
    span.domains = domains_;
    span.minimalSets = minimalSets_;
    if (isStandIn_) {
      span.space = Space::All;
      span.optimal = false;
      span.lowerBound = std::min(weights_.cost(standInBound_), span.cost);
    }
    return span;
  }

  /// Whether the caller wants surfaces on the way.
  bool listens() const { return options_.bestSoFar && options_.onBest; }

  /// Passes a surface to the caller, if it is better than those before. A wider space begins anew, often with
  /// worse ones.
  void tell(const Span& span) {
    if (span.cost < toldCost_) options_.onBest(options_.user, span);
    toldCost_ = std::min(toldCost_, span.cost);
  }

  /// Takes the answer of a space.
  void take(const PosedProblem& problem, const CandidateSet& set, const SolvedSurface& surface,
            const std::vector<double>& own) {
    last_ = answer(problem, set, surface, own);
    seed_ = problem.ontoInput(last_.triangles, unit_);
    best_.offer(last_);
    work_.setEarlier(best_.get().cost, best_.get().lowerBound);
  }

  const LoopSet& input_;
  const SpanOptions& options_;
  Work& work_;
  LoopSet unit_;  // input_ at unit size
  ScaledWeights weights_;
  Space space_ = Space::All;  // the one being searched
  uint64_t candidates_ = 0;   // in that space
  uint64_t domains_ = 0, minimalSets_ = 0;
  Span last_;                    // of the last space that held a surface
  BestAnswer best_;              // of all spaces
  LoopTriangles first_;          // a surface over unit_ that was there before any search, or none
  bool wantsUnproven_;           // whether surfaces without a proof are of use
  LoopTriangles seed_;           // last_ over unit_
  bool isStandIn_ = false;       // whether near triples stand in for all of them,
  double standInBound_ = 0;      // and what then is a lower bound over all, by weights_
  double toldCost_ = kInfinity;  // cost of the best surface that the caller has got
  double done_ = 0, partShare_ = 1;  // shares of the work: of past spaces, of the next one
};

}  // namespace

Outcome spanLoops(const LoopSet& loops, const SpanOptions& options, Work& work, Span& result) {
  result = {};
  double least = 0;
  if (options.space == Space::Given && options.objective == Objective::Sum)
    for (const double w : options.triangleWeights) least += std::min(0.0, w);
  // What else the work has spanned before is another problem.
  work.setEarlier(std::numeric_limits<double>::infinity(), 0);
  work.beginPart(0, 1, 0, least);
  Outcome outcome = checkLoops(loops, true, work);
  if (outcome.ok()) outcome = checkOptions(loops, options);
  if (outcome.ok()) outcome = Spanning(loops, options, work).run(result);
  if (outcome.status == Status::NotFound) return {};
  return outcome;
}

}  // namespace sf
