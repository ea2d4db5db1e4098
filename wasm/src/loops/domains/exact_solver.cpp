#include "loops/domains/exact_solver.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/sort.h"

namespace sf {
namespace {

/// The first limit is above the root's bound by this share. It is doubled kLimits times,
/// then dropped.
constexpr double kFirstRoom = 0.01;
constexpr int kLimits = 8;

}  // namespace

void traceSegment(const Pass& pass, ClosedSegment segment, uint32_t accessSlot, SplitOrder& order) {
  struct Open {
    ClosedSegment segment;
    uint32_t accessSlot;
  };
  // First in, first out: the surface grows from its first triangle outwards.
  std::vector<Open> queue{{segment, accessSlot}};
  for (size_t i = 0; i < queue.size(); ++i) {
    const uint32_t slot = pass.segments.bestSplit(queue[i].segment, queue[i].accessSlot);
    if (slot == kNone) continue;
    const uint32_t t = pass.set.slotTriangle[slot];
    order.push_back(t);
    ClosedSegment part[2];
    pass.segments.parts(queue[i].segment, slot, part);
    for (const ClosedSegment& p : part) queue.push_back({p, pass.set.slotAt(t, p.edge)});
  }
}

ExactSolver::ExactSolver(const Pass& pass, LowerBound& bound, uint32_t rootVertex, int lazyRounds)
    : pass_(pass),
      bound_(bound),
      rootVertex_(rootVertex),
      lazyRounds_(lazyRounds),
      holeWords_((pass.loops.loopCount() + 31) / 32),
      domains_(pass.loops),
      table_(pass.work),
      arena_(pass.work) {}

ExactSolver::~ExactSolver() {
  // Domains that were open when the work ended.
  for (const Frame& frame : frames_) pass_.work.release(frame.bytes);
}

bool ExactSolver::solve(double most, double& cost, SplitOrder& order) {
  const double least = bound_.rootBound();
  int doublings = std::isfinite(least) && least != 0 ? 0 : kLimits;
  for (int round = 0;; ++round) {
    if (round == lazyRounds_) allCritical_ = true;
    // Critical edges only make surfaces dearer, so a limit that was too low stays too low.
    for (;; ++doublings) {
      const double room = std::ldexp(kFirstRoom * std::fabs(least), doublings);
      const double limit = doublings < kLimits ? std::min(least + room, most) : most;
      if (!solveBelow(limit, cost)) return false;
      if (cost <= limit || limit == most) break;
    }
    order.clear();
    if (cost == kInfinity) return true;
    trace(order);
    if (!addCriticalEdges(order)) return true;
    SF_ASSERT(!allCritical_);
  }
}

bool ExactSolver::solveBelow(double most, double& cost) {
  table_.clear();
  arena_.clear();
  solutions_.clear();
  solved_.clear();
  SF_ASSERT(frames_.empty());
  cost = kInfinity;
  if (bound_.rootBound() == kInfinity) return true;
  std::vector<uint32_t> root = domains_.root(rootVertex_);
  root.push_back(0);
  if (table_.insert(root) == kNone || !open(0, most)) return false;
  while (!frames_.empty()) {
    Frame& frame = frames_.back();
    const bool more = frame.cursor < frame.candidates.size();
    const double next = more ? frame.candidates[frame.cursor].bound : kInfinity;
    if (!more || next > frame.limit || !pass_.measure.improves(next, frame.cut)) {
      if (!close(frame)) return false;
      frames_.pop_back();
      continue;
    }
    uint32_t missing = kNone;
    double asked = 0;
    if (!take(frame, frame.candidates[frame.cursor], missing, asked)) return false;
    if (missing == kNone)
      ++frame.cursor;
    else if (!open(missing, asked))
      return false;
  }
  for (const Solution& s : solutions_[0]) cost = std::min(cost, s.cost);
  return true;
}

double ExactSolver::emptyPairCost(const SplitPart& part, uint32_t t,
                                  ArrayView<const uint32_t> triangles) const {
  const uint32_t other = triangles[1 + part.firstInherited] - 1;
  if (other == t) return kInfinity;
  const uint32_t edge = pass_.set.edgeOpposite(t, part.apexOpposite);
  const uint32_t otherSlot = pass_.set.slotAt(other, edge);
  return pass_.measure.pair(pass_.set.slotTheta[pass_.set.slotOpposite(t, part.apexOpposite)],
                            pass_.set.slotTheta[otherSlot]);
}

double ExactSolver::segmentCost(const SplitPart& part, uint32_t t, uint32_t& side) const {
  const Segment s = domains_.segment(part.shape, 0);
  side =
      pass_.closedSegment(pass_.set.edgeOpposite(t, part.apexOpposite), s.reversed, s.start, s.end)
          .side;
  return pass_.segments.value(pass_.set.slotOpposite(t, part.apexOpposite), side);
}

double ExactSolver::bound(const Split& split, uint32_t slot, ArrayView<const uint32_t> triangles) {
  const uint32_t t = pass_.set.slotTriangle[slot];
  const Measure& measure = pass_.measure;
  double cost = pass_.triangleCost[t];
  if (triangles[0]) {
    const uint32_t access = triangles[0] - 1;
    const uint32_t edge = pass_.set.edgeOpposite(t, pass_.set.slotApex[slot]);
    const uint32_t accessSlot = pass_.set.slotAt(access, edge);
    cost = measure.join(cost,
                        measure.pair(pass_.set.slotTheta[slot], pass_.set.slotTheta[accessSlot]));
  }
  for (uint32_t i = 0; i < split.partCount && cost < kInfinity; ++i) {
    const SplitPart& part = split.part[i];
    uint32_t side;
    if (part.kind == PartKind::EmptyPair) {
      cost = measure.join(cost, emptyPairCost(part, t, triangles));
    } else if (part.kind == PartKind::Segment) {
      cost = measure.join(cost, segmentCost(part, t, side));
    } else if (part.kind == PartKind::Domain) {
      scratch_ = part.shape;
      domains_.makeCanonical(scratch_);
      cost =
          measure.join(cost, bound_.value(scratch_, pass_.set.slotOpposite(t, part.apexOpposite)));
    }
  }
  return cost;
}

bool ExactSolver::open(uint32_t domain, double asked) {
  const CandidateSet& set = pass_.set;
  const Shape shape = shapeOf(domain);
  const ArrayView<const uint32_t> triangles = trianglesOf(domain);
  const uint32_t edge = accessEdge(set, domains_, shape);
  const double limit = std::min(
      asked, bound_.limit(shape, triangles[0] ? set.slotAt(triangles[0] - 1, edge) : kNone));
  frames_.push_back({domain, 0, 0, kInfinity, asked, limit, {}, {}});
  std::vector<Candidate>& candidates = frames_.back().candidates;
  for (uint32_t slot = set.edgeSlots[edge]; slot < set.edgeSlots[edge + 1]; ++slot) {
    if (set.slotTriangle[slot] + 1 == triangles[0]) continue;
    uint32_t ordinal = 0;
    domains_.forEachSplit(shape, set.slotApex[slot], [&](const Split& split) {
      const double b = bound(split, slot, triangles);
      if (b < kInfinity && b <= limit) candidates.push_back({b, slot, ordinal});
      ++ordinal;
      return pass_.work.tick(300);
    });
  }
  if (!pass_.work.going()) return false;
  sf::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.bound < b.bound || (a.bound == b.bound && std::make_pair(a.slot, a.ordinal) <
                                                           std::make_pair(b.slot, b.ordinal));
  });
  ++domainCount_;
  frames_.back().bytes = candidates.capacity() * sizeof(Candidate);
  return pass_.work.charge(frames_.back().bytes);
}

uint32_t ExactSolver::insertPart(const Split& split, uint32_t i, uint32_t t,
                                 ArrayView<const uint32_t> triangles) {
  const SplitPart& part = split.part[i];
  scratch2_.clear();
  for (uint32_t j = 0; j < part.inheritedCount; ++j)
    scratch2_.push_back(triangles[1 + part.firstInherited + j]);
  if (split.partCount == 1) scratch2_.push_back(t + 1);
  scratch_ = part.shape;
  if (domains_.makeCanonical(scratch_)) std::reverse(scratch2_.begin(), scratch2_.end());
  scratch_.push_back(t + 1);
  scratch_.insert(scratch_.end(), scratch2_.begin(), scratch2_.end());
  const uint32_t id = table_.insert(scratch_);
  if (solved_.size() < table_.size()) {
    solved_.resize(table_.size(), -kInfinity);
    solutions_.resize(table_.size());
  }
  return id;
}

void ExactSolver::criticalSpanningEdges(Shape shape, std::vector<uint32_t>& edges) const {
  edges.clear();
  const uint32_t m = domains_.segmentCount(shape);
  for (uint32_t i = 0; i < m; ++i) {
    const uint32_t e =
        pass_.set.edgeBetween(domains_.spanStart(shape, i), domains_.spanEnd(shape, i));
    if (isCritical(e)) edges.push_back(e);
  }
  sf::sort(edges.begin(), edges.end());
}

bool ExactSolver::makeParts(const Frame& frame, const Candidate& candidate) {
  const Shape shape = shapeOf(frame.domain);
  const ArrayView<const uint32_t> triangles = trianglesOf(frame.domain);
  const uint32_t t = pass_.set.slotTriangle[candidate.slot];
  uint32_t ordinal = 0;
  bool good = true;
  domains_.forEachSplit(shape, pass_.set.slotApex[candidate.slot], [&](const Split& split) {
    if (ordinal++ != candidate.ordinal) return pass_.work.tick(50);
    partCount_ = split.partCount;
    for (uint32_t i = 0; i < split.partCount; ++i) {
      const SplitPart& part = split.part[i];
      OpenPart& out = parts_[i];
      const uint32_t edge = pass_.set.edgeOpposite(t, part.apexOpposite);
      out.ref = {part.kind, kNone, 0, nullptr};
      out.cost = 0;
      out.spanning.clear();
      if (part.kind == PartKind::Domain) {
        out.ref.a = insertPart(split, i, t, triangles);
        if (out.ref.a == kNone) return good = false;
        out.bound = bound_.value(shapeOf(out.ref.a), pass_.set.slotOpposite(t, part.apexOpposite));
        criticalSpanningEdges(part.shape, out.spanning);
        continue;
      }
      // An empty part, or a single segment, uses no weak edge but the one that closes it.
      if (isCritical(edge)) out.spanning.push_back(edge);
      if (part.kind == PartKind::EmptyPair) out.cost = emptyPairCost(part, t, triangles);
      if (part.kind == PartKind::Segment) {
        out.ref.a = pass_.set.slotOpposite(t, part.apexOpposite);
        out.cost = segmentCost(part, t, out.ref.b);
      }
    }
    return false;
  });
  return good && pass_.work.going();
}

bool ExactSolver::take(Frame& frame, const Candidate& candidate, uint32_t& missing, double& asked) {
  if (!makeParts(frame, candidate)) return false;
  for (uint32_t i = 0; i < partCount_; ++i) {
    const OpenPart& part = parts_[i];
    if (part.ref.kind != PartKind::Domain) continue;
    // The limit less the rest of the split; sums in another order differ in the last digits.
    asked = frame.limit;
    if (asked < kInfinity && !pass_.measure.isWorst())
      asked += 1e-9 * std::fabs(asked) - (candidate.bound - part.bound);
    if (solved_[part.ref.a] >= asked) continue;
    missing = part.ref.a;
    return true;
  }
  combine(frame, candidate);
  return pass_.work.going();
}

void ExactSolver::combine(Frame& frame, const Candidate& candidate) {
  const Measure& measure = pass_.measure;
  const Shape shape = shapeOf(frame.domain);
  const ArrayView<const uint32_t> triangles = trianglesOf(frame.domain);
  const uint32_t t = pass_.set.slotTriangle[candidate.slot];
  const uint32_t access = pass_.set.edgeOpposite(t, pass_.set.slotApex[candidate.slot]);
  double base = pass_.triangleCost[t];
  if (triangles[0]) {
    const uint32_t other = triangles[0] - 1;
    const uint32_t otherSlot = pass_.set.slotAt(other, access);
    base = measure.join(
        base, measure.pair(pass_.set.slotTheta[candidate.slot], pass_.set.slotTheta[otherSlot]));
  }
  std::vector<uint32_t> spanning;
  criticalSpanningEdges(shape, spanning);

  // A part that is not a domain counts as a domain with one solution, without weak edges.
  constexpr PartRef kEmpty{PartKind::EmptyEdge, kNone, 0, nullptr};
  const Solution none{0, nullptr, 0, kNone, {kEmpty, kEmpty}};
  ArrayView<const Solution> choices[2];
  Solution leaf[2] = {none, none};
  for (uint32_t i = 0; i < 2; ++i) {
    choices[i] = {&leaf[i], 1};
    if (i >= partCount_) continue;
    if (parts_[i].ref.kind == PartKind::Domain)
      choices[i] = solutions_[parts_[i].ref.a];
    else
      leaf[i].cost = parts_[i].cost;
  }
  if (partCount_ < 2) parts_[1] = {kEmpty, 0, 0, {}};

  std::vector<uint32_t> used[2], all;
  for (uint32_t i = 0; i < choices[0].size(); ++i) {
    unite(choices[0][i].weakEdges(), parts_[0].spanning, used[0]);
    if (contains(used[0], access)) continue;
    for (uint32_t j = 0; j < choices[1].size(); ++j) {
      unite(choices[1][j].weakEdges(), parts_[1].spanning, used[1]);
      if (!pass_.work.tick(200)) return;
      if (contains(used[1], access) || !disjoint(used[0], used[1])) continue;
      Draft draft;
      draft.solution.cost =
          measure.join(measure.join(base, choices[0][i].cost), choices[1][j].cost);
      if (draft.solution.cost == kInfinity) continue;
      draft.solution.triangle = t;
      const uint32_t chosen[2] = {i, j};
      for (int side = 0; side < 2; ++side) {
        draft.solution.part[side] = parts_[side].ref;
        if (parts_[side].ref.kind == PartKind::Domain)
          draft.solution.part[side].solution = &choices[side][chosen[side]];
      }
      unite(used[0], used[1], all);
      for (const uint32_t e : all)
        if (!contains(spanning, e) &&
            domains_.isEnd(shape, pass_.set.edgeVertices[2 * size_t(e)]) &&
            domains_.isEnd(shape, pass_.set.edgeVertices[2 * size_t(e) + 1]))
          draft.edges.push_back(e);
      addDraft(frame, std::move(draft));
    }
  }
}

void ExactSolver::addDraft(Frame& frame, Draft&& draft) {
  for (const Draft& d : frame.drafts)
    if (d.solution.cost <= draft.solution.cost && isSubset(d.edges, draft.edges)) return;
  frame.drafts.erase(std::remove_if(frame.drafts.begin(), frame.drafts.end(),
                                    [&](const Draft& d) {
                                      return draft.solution.cost <= d.solution.cost &&
                                             isSubset(draft.edges, d.edges);
                                    }),
                     frame.drafts.end());
  if (draft.edges.empty()) frame.cut = draft.solution.cost;
  frame.drafts.push_back(std::move(draft));
}

bool ExactSolver::close(Frame& frame) {
  auto* solutions = arena_.allocate<Solution>(frame.drafts.size());
  if (!solutions) return false;
  for (size_t i = 0; i < frame.drafts.size(); ++i) {
    const Draft& d = frame.drafts[i];
    auto* edges = arena_.allocate<uint32_t>(d.edges.size());
    if (!edges && !d.edges.empty()) return false;
    std::copy(d.edges.begin(), d.edges.end(), edges);
    solutions[i] = d.solution;
    solutions[i].edges = edges;
    solutions[i].edgeCount = uint32_t(d.edges.size());
  }
  minimalSetCount_ += frame.drafts.size();
  pass_.work.release(frame.bytes);
  if (solved_.size() < table_.size()) {
    solved_.resize(table_.size(), -kInfinity);
    solutions_.resize(table_.size());
  }
  solutions_[frame.domain] = {solutions, frame.drafts.size()};
  // A solution without critical edges that is within the limit is the best of all, at any limit.
  solved_[frame.domain] = frame.cut <= frame.limit ? kInfinity : frame.asked;
  return true;
}

void ExactSolver::trace(SplitOrder& order) const {
  const Solution* best = solutions_[0].begin();
  for (const Solution& s : solutions_[0])
    if (s.cost < best->cost) best = &s;
  // First in, first out, over domains and segments alike.
  std::vector<PartRef> queue{{PartKind::Domain, 0, 0, best}};
  for (size_t i = 0; i < queue.size(); ++i) {
    const PartRef ref = queue[i];
    if (ref.kind == PartKind::Domain) {
      const Solution& s = *ref.solution;
      order.push_back(s.triangle);
      queue.insert(queue.end(), s.part, s.part + 2);
      continue;
    }
    if (ref.kind != PartKind::Segment) continue;
    const uint32_t edge =
        pass_.set.edgeOpposite(pass_.set.slotTriangle[ref.a], pass_.set.slotApex[ref.a]);
    const ClosedSegment segment{edge, ref.b};
    const uint32_t slot = pass_.segments.bestSplit(segment, ref.a);
    if (slot == kNone) continue;
    const uint32_t t = pass_.set.slotTriangle[slot];
    order.push_back(t);
    ClosedSegment part[2];
    pass_.segments.parts(segment, slot, part);
    for (const ClosedSegment& p : part)
      queue.push_back({PartKind::Segment, pass_.set.slotAt(t, p.edge), p.side, nullptr});
  }
}

bool ExactSolver::addCriticalEdges(const SplitOrder& order) {
  std::vector<uint32_t> edges;
  for (const uint32_t t : order)
    edges.insert(edges.end(), &pass_.set.triangleEdges[3 * size_t(t)],
                 &pass_.set.triangleEdges[3 * size_t(t)] + 3);
  sf::sort(edges.begin(), edges.end());
  bool any = false;
  for (size_t i = 0; i < edges.size();) {
    size_t j = i;
    while (j < edges.size() && edges[j] == edges[i]) ++j;
    const size_t wanted = pass_.set.isLoopEdge[edges[i]] ? 1 : 2;
    if (j - i != wanted) {
      SF_ASSERT(!isCritical(edges[i]));
      critical_.push_back(edges[i]);
      any = true;
    }
    i = j;
  }
  sf::sort(critical_.begin(), critical_.end());
  return any;
}

}  // namespace sf
