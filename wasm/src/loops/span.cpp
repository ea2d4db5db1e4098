#include "loops/span.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/accurate_cross.h"
#include "base/predicates.h"
#include "base/sort.h"
#include "delaunay/delaunay.h"
#include "loops/one_loop/polygon_solver.h"
#include "loops/problem/candidate_set.h"
#include "loops/problem/loop_check.h"
#include "loops/solver.h"
#include "loops/spaces/edge_protection.h"
#include "loops/spaces/near_space.h"

namespace sf {
namespace {

/// Time within which `auto` takes all triples at once, in predicted nanoseconds of native code; for two
/// loops less, since on noisy ones the domains that the prediction leaves out take ten times as long.
constexpr double kPatience = 3e8, kPatienceForTwo = 4e7;
/// Vertices of one loop up to which `auto` takes the `near` space: about a second.
constexpr uint32_t kAutoNear = 2000;
/// Mean dihedral angle up to which a surface is smooth: not much is to be won beyond it.
constexpr double kSmooth = 0.05;
/// Vertices of one loop up to which all triples are the quickest where no angles count.
constexpr uint32_t kPlainPolygon = 1000;
/// Nearest neighbours of the `near` space, before it is widened.
constexpr uint32_t kFirstReach = 8, kLastReach = 64;
/// Candidates beyond which the `near` space is not widened further.
constexpr double kMostNear = 4e6;
/// Times that the `near` space of two loops is enlarged around its optimum, at most.
constexpr uint32_t kNearRounds = 3;
/// Vertices beyond which candidates of earlier rounds stay: it takes half the time again, and where all
/// triples would take a second finds a surface within 1.02 of their optimum in 19 of 20 cases, not 18.
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

/// What the solver works on: the loops, scaled to unit size and perhaps with inserted vertices,
/// numbered loop by loop; and how that numbering leads back to the result's.
struct Problem {
  LoopSet loops;
  std::vector<uint32_t> resultIndex;     // [n'] index in Span::positions
  std::vector<double> normals;           // [3n'] or empty
  std::vector<InsertedVertex> inserted;  // [n' - n]
  std::vector<Vec3> insertedPositions;   // [n' - n] in the caller's units
};

Problem unchangedProblem(const LoopSet& unit, const SpanOptions& options) {
  Problem p;
  p.loops = unit;
  p.resultIndex.resize(unit.vertexCount());
  for (uint32_t v = 0; v < unit.vertexCount(); ++v) p.resultIndex[v] = v;
  p.normals.assign(options.boundaryNormals.begin(), options.boundaryNormals.end());
  return p;
}

/// Runs one span, space after space, until one holds a surface.
class Spanning {
 public:
  Spanning(const LoopSet& loops, const SpanOptions& options, Work& work, Span& result)
      : loops_(loops), options_(options), work_(work), result_(result) {
    std::vector<Vec3> scaled;
    exponent_ = scaleToUnit(loops.positions(), scaled);
    unit_ = LoopSet(scaled, loops.starts());
    scaleWeights();
  }

  Outcome run() {
    // The cost, a sum over the triangles, has to stay far below infinity.
    if (costExponent_ > 960) return {Status::BadWeights};
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

 private:
  /// All triples while that is quick, else Delaunay facets; then near triples where the facets hold no
  /// surface, or only a rough one and near ones are not too many.
  Outcome runAuto() {
    const uint32_t k = loops_.loopCount();
    const double patience = k == 2 ? kPatienceForTwo : kPatience;
    const bool isQuick = predictedTimeOfAllTriples(loops_) <= patience || isPlainPolygon();
    if (isQuick && allTriplesFit()) return runAll();
    partShare_ = 0.5;
    const bool isNearQuick =
        hasNearOptimalTriples(unit_, work_) && (k > 1 || loops_.vertexCount() <= kAutoNear);
    Outcome outcome = runDelaunay();
    if (outcome.status == Status::NotFound || (outcome.ok() && isNearQuick && !isSmooth()))
      outcome = runNearOrKeep(outcome);
    return outcome.status == Status::NotFound && allTriplesFit() ? runAll() : outcome;
  }

  /// Near triples, after a first look at the facets. What these gave is kept unless near ones cost
  /// less or the caller ended the work.
  Outcome runNearOrKeep(const Outcome& first) {
    Span facets;
    if (first.ok()) facets = result_;
    const Outcome outcome = runNear();
    const bool isCheaper = outcome.ok() && !(facets.cost < result_.cost);
    const bool isEnded = outcome.status == Status::Stopped && !options_.bestSoFar;
    if (!facets.found || isCheaper || isEnded) return outcome;
    result_ = std::move(facets);
    return {};
  }

  /// Whether the surface found bends so little that others cannot cost much less.
  bool isSmooth() const {
    if (options_.dihedralWeight == 0) return false;
    if (options_.objective == Objective::WorstDihedral) return result_.cost <= kSmooth;
    const double innerEdges = 0.5 * double(result_.triangles.size() - loops_.vertexCount());
    return result_.cost <= kSmooth * options_.dihedralWeight * innerEdges;
  }

  /// Weights for unit_, times the power of two that brings the largest of them near 1: sums of very
  /// large or very small ones neither overflow nor vanish.
  void scaleWeights() {
    const double area =
        std::isnan(options_.areaWeight) ? 1e-3 / squaredDiagonal() : options_.areaWeight;
    const int areaExponent = std::isnan(options_.areaWeight) ? 0 : 2 * exponent_;
    double own = 0;
    for (const double w : options_.triangleWeights) own = std::max(own, std::fabs(w));
    costExponent_ = std::numeric_limits<int>::min();
    const auto consider = [&](double w, int exponent) {
      if (w > 0) costExponent_ = std::max(costExponent_, std::ilogb(w) + exponent);
    };
    consider(area, areaExponent);
    consider(options_.perimeterWeight, exponent_);
    consider(options_.dihedralWeight, 0);
    consider(own, 0);
    areaWeight_ = std::ldexp(area, areaExponent - costExponent_);
    perimeterWeight_ = std::ldexp(options_.perimeterWeight, exponent_ - costExponent_);
    dihedralWeight_ = std::ldexp(options_.dihedralWeight, -costExponent_);
  }

  /// The share of the work that the next space takes: half of what is left, while there are others.
  void beginSpace(Space space) {
    result_.space = space;
    const double end = done_ + partShare_ * (1 - done_);
    const bool isSum = options_.objective == Objective::Sum;
    work_.beginPart(done_, end, isSum ? costExponent_ : 0);
    done_ = end;
  }

  double squaredDiagonal() const {
    Vec3 low = unit_.position(0), high = low;
    for (const Vec3& p : unit_.positions()) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    return dot(high - low, high - low);
  }

  bool looksAtAngles() const {
    return dihedralWeight_ > 0 || options_.objective == Objective::WorstDihedral;
  }

  /// One loop without angles in its cost takes all triples in less time than near ones, so that these
  /// are all.
  bool isPlainPolygon() const {
    return loops_.loopCount() == 1 && !looksAtAngles() && loops_.vertexCount() <= kPlainPolygon;
  }

  bool allTriplesFit() const {
    const double n = loops_.vertexCount(), count = n * (n - 1) * (n - 2) / 6;
    if (loops_.loopCount() == 1) return work_.fits(bytesForPolygon(n, looksAtAngles()));
    return count < double(kNone / 3) && work_.fits(bytesToSolve(count));
  }
  /// Candidates, and the segment table's two numbers for each of three slots.
  static double bytesToSolve(double candidates) {
    return CandidateSet::bytesFor(candidates) + 48 * candidates;
  }

  TriangleWeights triangleWeights(const Problem& problem, const std::vector<double>& own) const {
    TriangleWeights weights;
    weights.area = areaWeight_;
    weights.perimeter = perimeterWeight_;
    weights.dihedral = dihedralWeight_;
    weights.normals = problem.normals;
    weights.own = own;
    return weights;
  }

  Outcome runAll() {
    if (loops_.loopCount() == 1) return runPolygon();
    partShare_ = 1;
    beginSpace(Space::All);
    if (!allTriplesFit()) return {Status::TooLarge};
    std::vector<uint32_t> triples;
    if (!allTriples(unit_, work_, triples)) return {work_.status()};
    return solve(unchangedProblem(unit_, options_), std::move(triples), {});
  }

  /// One loop over all triples. That has no surface before the optimum: where it takes long, the near
  /// triples' is what bestSoFar falls back to.
  Outcome runPolygon() {
    Span near;
    if (options_.bestSoFar && predictedTimeOfAllTriples(loops_) > kPatience && runNear().ok()) {
      result_.space = Space::All;
      result_.optimal = false;
      result_.lowerBound = std::min(boundOfLoopEdges(), result_.cost);
      near = result_;
      if (options_.onBest) options_.onBest(options_.user, result_);
    }
    partShare_ = 1;
    beginSpace(Space::All);
    const Outcome outcome = allTriplesFit() ? solveAllTriples() : Outcome{Status::TooLarge};
    if (outcome.ok() || !near.found) return outcome;
    result_ = std::move(near);
    return {};
  }

  /// No surface over one loop costs less: each loop edge has a triangle, each triangle two of them at
  /// most. O(n^2).
  double boundOfLoopEdges() {
    if (options_.objective == Objective::WorstDihedral) return 0;
    const uint32_t n = unit_.vertexCount();
    double sum = 0;
    for (uint32_t v = 0; v < n; ++v) {
      double least = kInfinity;
      for (uint32_t i = 2; i < n; ++i) {
        const Vec3 a = unit_.position(v), b = unit_.position((v + 1) % n),
                   c = unit_.position((v + i) % n);
        least = std::min(least,
                         areaWeight_ * 0.5 * length(cross(b - a, c - a)) +
                             perimeterWeight_ * (distance(a, b) + distance(b, c) + distance(c, a)));
      }
      sum += 0.5 * least;
    }
    return std::ldexp(sum, costExponent_);
  }

  Outcome solveAllTriples() {
    const Problem problem = unchangedProblem(unit_, options_);
    const TriangleWeights weights = triangleWeights(problem, {});
    PolygonSurface polygon;
    const double n = loops_.vertexCount();
    result_.candidates = uint64_t(n * (n - 1) * (n - 2) / 6);
    result_.domains = uint64_t(n * (n - 1) / 2);
    result_.minimalSets = result_.domains;
    if (!solvePolygon(unit_, weights, options_.objective, work_, polygon)) return {work_.status()};
    if (!polygon.found) return {Status::NotFound};
    CandidateSet set;
    const uint64_t before = work_.used();
    const bool built = buildCandidateSet(unit_, weights, std::move(polygon.triangles), work_, set);
    work_.release(work_.used() - before);
    if (!built) return {work_.status()};
    Surface surface;
    for (uint32_t t = 0; t < set.size(); ++t) surface.order.push_back(t);
    surface.lowerBound = polygon.lowerBound;
    surface.optimal = polygon.optimal;
    handBack(problem, set, surface, {});
    return {};
  }

  Outcome runGiven() {
    beginSpace(Space::Given);
    if (!work_.fits(bytesToSolve(double(options_.triangles.size() / 3)))) return {Status::TooLarge};
    std::vector<uint32_t> triples, order;
    const Outcome outcome = givenTriples(unit_, options_.triangles, work_, triples, order);
    if (!outcome.ok()) return outcome;
    std::vector<double> own;
    if (!options_.triangleWeights.empty())
      for (const uint32_t index : order)
        own.push_back(std::ldexp(options_.triangleWeights[index], -costExponent_));
    return solve(unchangedProblem(unit_, options_), std::move(triples), own);
  }

  Outcome runDelaunay() {
    beginSpace(Space::Delaunay);
    ProtectedLoops safe;
    const Status status = protectEdges(unit_, work_, safe);
    if (status != Status::Ok) return {status};
    Problem problem;
    problem.resultIndex = safe.origin;
    problem.inserted = safe.inserted;
    const uint32_t n = unit_.vertexCount();
    problem.insertedPositions.resize(safe.inserted.size());
    for (uint32_t v = 0; v < safe.loops.vertexCount(); ++v) {
      const uint32_t origin = safe.origin[v];
      if (origin >= n) {
        const Vec3 p = safe.loops.position(v);
        problem.insertedPositions[origin - n] = {
            std::ldexp(p.x, exponent_), std::ldexp(p.y, exponent_), std::ldexp(p.z, exponent_)};
      }
      if (options_.boundaryNormals.empty()) continue;
      // The parts of an edge have the face across the whole edge.
      uint32_t edge = origin;
      if (origin >= n) {
        const InsertedVertex& inserted = safe.inserted[origin - n];
        edge = unit_.first(inserted.loop) + inserted.edge;
      }
      const double* normal = &options_.boundaryNormals[3 * size_t(edge)];
      problem.normals.insert(problem.normals.end(), normal, normal + 3);
    }
    std::vector<uint32_t> triples;
    if (!facetTriples(safe.loops, safe.facets, work_, triples)) return {work_.status()};
    problem.loops = std::move(safe.loops);
    return solve(problem, std::move(triples), {});
  }

  /// Candidates are the facets and the triples of near-optimal surfaces; for two loops with angles
  /// then the optimum among them and those around it, until it gets no better.
  Outcome runNearOptimal(std::vector<uint32_t> list) {
    const Problem problem = unchangedProblem(unit_, options_);
    TriangleWeights weights = triangleWeights(problem, {});
    // A small sum of angles goes with small ones.
    if (options_.objective == Objective::WorstDihedral) weights.dihedral = 1;
    const bool isDone = loops_.loopCount() == 1 || weights.dihedral == 0;
    std::vector<BridgeTrial> trials;
    for (uint32_t round = 0;; ++round) {
      std::vector<uint32_t> triples;
      Span last;
      if (options_.bestSoFar) last = result_;
      const bool chosen =
          nearOptimalTriples(unit_, weights, result_.triangles, work_, trials, list) &&
          facetTriples(unit_, list, work_, triples);
      const double before = result_.cost;
      const Outcome outcome =
          chosen ? solve(problem, std::move(triples), {}) : Outcome{work_.status()};
      if (!work_.going() && last.found && !(outcome.ok() && result_.cost < last.cost)) {
        // What was optimal among fewer candidates stays.
        result_ = std::move(last);
        return {};
      }
      if (!outcome.ok()) return outcome;
      const bool isBetter = round == 0 || result_.cost < before - 1e-9 * std::fabs(before);
      if (isDone || !isBetter || round == kNearRounds) return {};
      if (unit_.vertexCount() <= kKeepNear) list.clear();
      list.insert(list.end(), result_.triangles.begin(), result_.triangles.end());
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
    for (uint32_t reach = kFirstReach;; reach *= 2) {
      if (reach > kFirstReach) beginSpace(Space::Near);
      const double predicted = predictedNearTriples(unit_, reach) + double(cells.facets.size() / 3);
      if (reach > kFirstReach && predicted > kMostNear) break;
      if (!work_.fits(bytesToSolve(predicted))) return {Status::TooLarge};
      std::vector<uint32_t> triples;
      if (!nearTriples(unit_, cells.facets, reach, work_, triples)) return {work_.status()};
      const Outcome outcome = solve(unchangedProblem(unit_, options_), std::move(triples), {});
      if (outcome.status != Status::NotFound) return outcome;
      if (reach >= kLastReach || reach >= loops_.vertexCount()) break;
    }
    return {Status::NotFound};
  }

  Outcome solve(const Problem& problem, std::vector<uint32_t> triples,
                const std::vector<double>& own) {
    result_.candidates = triples.size() / 3;
    const double bytes = bytesToSolve(double(result_.candidates));
    if (!work_.fits(bytes)) return {Status::TooLarge};
    const TriangleWeights weights = triangleWeights(problem, own);
    CandidateSet set;
    Surface surface;
    Told told(*this, problem, set, own);
    const std::vector<uint32_t> start = startIn(problem);
    SolveOptions solving;
    solving.dihedralWeight = dihedralWeight_;
    solving.objective = options_.objective;
    solving.anytime = options_.bestSoFar;
    solving.start = start;
    solving.listener = options_.bestSoFar && options_.onBest ? &told : nullptr;
    const uint64_t before = work_.used();
    const bool done = buildCandidateSet(problem.loops, weights, std::move(triples), work_, set) &&
                      solveSurface(problem.loops, set, solving, work_, surface);
    work_.release(work_.used() - before);
    result_.domains += surface.domains;
    result_.minimalSets += surface.minimalSets;
    if (!done && !(options_.bestSoFar && surface.found)) return {work_.status()};
    if (!surface.found) return {Status::NotFound};
    handBack(problem, set, surface, own);
    return {};
  }

  /// Hands every better surface on to the caller.
  class Told final : public SurfaceListener {
   public:
    Told(Spanning& spanning, const Problem& problem, const CandidateSet& set,
         const std::vector<double>& own)
        : spanning_(spanning), problem_(problem), set_(set), own_(own) {}
    void better(const SplitOrder& order) override {
      Surface surface;
      surface.order = order;
      surface.optimal = false;
      spanning_.handBack(problem_, set_, surface, own_);
      Span& best = spanning_.result_;
      // Wider candidates begin anew, often with worse.
      if (best.cost < spanning_.toldCost_) spanning_.options_.onBest(spanning_.options_.user, best);
      spanning_.toldCost_ = std::min(spanning_.toldCost_, best.cost);
      best.found = false;
    }

   private:
    Spanning& spanning_;
    const Problem& problem_;
    const CandidateSet& set_;
    const std::vector<double>& own_;
  };

  /// The caller's surface to begin from in the numbers of the problem, without the triangles that
  /// have vertices which are no more.
  std::vector<uint32_t> startIn(const Problem& problem) const {
    std::vector<uint32_t> number(problem.resultIndex.size(), kNone), start;
    for (uint32_t v = 0; v < problem.resultIndex.size(); ++v) number[problem.resultIndex[v]] = v;
    for (size_t i = 0; i + 2 < options_.start.size(); i += 3) {
      const uint32_t* v = &options_.start[i];
      if (std::max({v[0], v[1], v[2]}) >= number.size()) continue;
      start.insert(start.end(), {number[v[0]], number[v[1]], number[v[2]]});
    }
    return start;
  }

  void handBack(const Problem& problem, const CandidateSet& set, const Surface& surface,
                const std::vector<double>& own);
  void measure(const Problem& problem, const CandidateSet& set,
               const std::vector<uint32_t>& triangles, const std::vector<double>& own);

  const LoopSet& loops_;
  const SpanOptions& options_;
  Work& work_;
  Span& result_;
  LoopSet unit_;  // loops_ divided by 2^exponent_
  int exponent_ = 0;
  double areaWeight_ = 0, perimeterWeight_ = 0;  // per unit of unit_, times 2^-costExponent_
  double dihedralWeight_ = 0;                    // times 2^-costExponent_
  int costExponent_ = 0;
  double toldCost_ = kInfinity;      // of the last surface that the caller has been told of
  double done_ = 0, partShare_ = 1;  // of the work: what past spaces took, what the next may
};

/// Turns the triangles so that neighbours agree and the first triangle with an edge of the first
/// loop passes it forward.
///   triangles  [m] numbers in the set;  wound  [3m] the result
void windConsistently(const LoopSet& loops, const CandidateSet& set,
                      const std::vector<uint32_t>& triangles, std::vector<uint32_t>& wound) {
  struct Use {
    uint32_t edge, triangle;
  };
  std::vector<Use> uses;
  for (uint32_t i = 0; i < triangles.size(); ++i)
    for (int j = 0; j < 3; ++j)
      uses.push_back({set.triangleEdges[3 * size_t(triangles[i]) + j], i});
  sf::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
    return a.edge < b.edge || (a.edge == b.edge && a.triangle < b.triangle);
  });
  // The sign with which an increasing triple passes its edge from the lower to the higher end.
  auto passesForward = [&](uint32_t t, uint32_t edge) {
    return set.triangleEdges[3 * size_t(t) + 1] != edge;
  };
  auto usesOf = [&](uint32_t edge) {
    return std::lower_bound(uses.begin(), uses.end(), edge,
                            [](const Use& u, uint32_t e) { return u.edge < e; });
  };
  const uint32_t first = usesOf(set.loopEdges[0])->triangle;
  const bool lowToHigh = set.edgeVertices[2 * size_t(set.loopEdges[0])] == 0 && loops.next(0) != 0;
  enum : uint8_t { Unseen, Kept, Flipped };
  std::vector<uint8_t> state(triangles.size(), Unseen);
  state[first] = passesForward(triangles[first], set.loopEdges[0]) == lowToHigh ? Kept : Flipped;
  std::vector<uint32_t> queue{first};
  for (size_t i = 0; i < queue.size(); ++i) {
    const uint32_t at = queue[i];
    for (int j = 0; j < 3; ++j) {
      const uint32_t edge = set.triangleEdges[3 * size_t(triangles[at]) + j];
      for (auto u = usesOf(edge); u != uses.end() && u->edge == edge; ++u) {
        if (state[u->triangle] != Unseen) continue;
        const bool same =
            passesForward(triangles[at], edge) == passesForward(triangles[u->triangle], edge);
        state[u->triangle] = same == (state[at] == Kept) ? Flipped : Kept;
        queue.push_back(u->triangle);
      }
    }
  }
  SF_ASSERT(queue.size() == triangles.size());
  wound.clear();
  for (uint32_t i = 0; i < triangles.size(); ++i) {
    const uint32_t* v = &set.triangles[3 * size_t(triangles[i])];
    const bool flip = state[i] == Flipped;
    wound.insert(wound.end(), {v[0], v[flip ? 2 : 1], v[flip ? 1 : 2]});
  }
}

void Spanning::measure(const Problem& problem, const CandidateSet& set,
                       const std::vector<uint32_t>& triangles, const std::vector<double>& own) {
  const LoopSet& loops = problem.loops;
  SpanTerms& terms = result_.terms;
  terms = {};
  std::vector<uint32_t> slots;
  for (const uint32_t t : triangles) {
    const uint32_t* v = &set.triangles[3 * size_t(t)];
    const Vec3 p[3] = {loops.position(v[0]), loops.position(v[1]), loops.position(v[2])};
    terms.area += 0.5 * length(accurateCross(p[0], p[1], p[2]));
    terms.perimeter += distance(p[0], p[1]) + distance(p[1], p[2]) + distance(p[2], p[0]);
    if (!own.empty()) terms.own += own[t];
    slots.insert(slots.end(), &set.triangleSlots[3 * size_t(t)],
                 &set.triangleSlots[3 * size_t(t)] + 3);
    for (int i = 0; i < 3; ++i) {
      double angle;
      if (!faceAngle(loops, problem.normals, v[i], v[(i + 1) % 3], v[(i + 2) % 3], angle)) continue;
      terms.dihedral += angle;
      terms.worstDihedral = std::max(terms.worstDihedral, angle);
    }
  }
  // Slots of one edge are consecutive, so that the two triangles at an inner edge come together.
  sf::sort(slots.begin(), slots.end());
  auto edgeOf = [&](uint32_t slot) {
    return set.edgeOpposite(set.slotTriangle[slot], set.slotApex[slot]);
  };
  for (size_t i = 0; i + 1 < slots.size(); ++i) {
    if (edgeOf(slots[i]) != edgeOf(slots[i + 1])) continue;
    const double angle = dihedralAngle(set.slotTheta[slots[i]], set.slotTheta[slots[i + 1]]);
    terms.dihedral += angle;
    terms.worstDihedral = std::max(terms.worstDihedral, angle);
  }
  result_.cost = options_.objective == Objective::WorstDihedral
                     ? terms.worstDihedral
                     : std::ldexp(areaWeight_ * terms.area + perimeterWeight_ * terms.perimeter +
                                      dihedralWeight_ * terms.dihedral + terms.own,
                                  costExponent_);
  terms.own = std::ldexp(terms.own, costExponent_);
  terms.area = std::ldexp(terms.area, 2 * exponent_);
  terms.perimeter = std::ldexp(terms.perimeter, exponent_);
}

void Spanning::handBack(const Problem& problem, const CandidateSet& set, const Surface& surface,
                        const std::vector<double>& own) {
  std::vector<uint32_t> triangles = surface.order;
  sf::sort(triangles.begin(), triangles.end());
  result_.found = true;
  result_.optimal = surface.optimal;
  windConsistently(problem.loops, set, triangles, result_.triangles);
  for (uint32_t& v : result_.triangles) v = problem.resultIndex[v];
  result_.order.clear();
  for (const uint32_t t : surface.order)
    result_.order.push_back(
        uint32_t(std::lower_bound(triangles.begin(), triangles.end(), t) - triangles.begin()));
  result_.positions.assign(loops_.positions().begin(), loops_.positions().end());
  result_.positions.insert(result_.positions.end(), problem.insertedPositions.begin(),
                           problem.insertedPositions.end());
  result_.inserted = problem.inserted;
  result_.starts.assign(problem.loops.starts().begin(), problem.loops.starts().end());
  result_.loopVertices = problem.resultIndex;
  measure(problem, set, triangles, own);
  // Sums in another order differ in the last digits: that alone makes no gap.
  const bool exactSum = surface.optimal && options_.objective == Objective::Sum;
  const int unit = options_.objective == Objective::Sum ? costExponent_ : 0;
  result_.lowerBound =
      exactSum ? result_.cost : std::min(result_.cost, std::ldexp(surface.lowerBound, unit));
}

}  // namespace

Outcome spanLoops(const LoopSet& loops, const SpanOptions& options, Work& work, Span& result) {
  result = {};
  Outcome outcome = checkLoops(loops, true, work);
  if (outcome.ok()) outcome = checkOptions(loops, options);
  if (outcome.ok()) outcome = Spanning(loops, options, work, result).run();
  if (outcome.status == Status::NotFound) return {};
  return outcome;
}

}  // namespace sf
