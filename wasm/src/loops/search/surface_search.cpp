#include "loops/search/surface_search.h"

#include <algorithm>
#include <cmath>

#include "base/hash.h"
#include "base/sort.h"
#include "base/union_find.h"
#include "loops/domains/lower_bound.h"

namespace sf {
namespace {

/// If candidates are many, only this many shortest edges at each vertex are looked at.
constexpr size_t kNearEdges = 16;
/// Attempts to get rid of edges that a solution closes twice.
constexpr int kRepairs = 8;
/// Bytes of the arrays kept here and of those that a cut takes.
constexpr uint64_t kBytesPerCandidate = 150;
/// Splits for a cut that leaves several loops: some milliseconds.
constexpr uint64_t kSplitsOfCut = 200000;

/// How often the loop of a random bridge is passed the other way round.
constexpr double kChanceOfTurning = 0.15;

}  // namespace

/// Loops that bridges have joined so far.
class SurfaceSearch::Forest {
 public:
  explicit Forest(uint32_t loops) : joined_(loops), trees_(loops) {}
  bool join(uint32_t a, uint32_t b) {
    if (!joined_.unite(a, b)) return false;
    --trees_;
    return true;
  }
  uint32_t trees() const { return trees_; }

 private:
  UnionFind joined_;
  uint32_t trees_;
};

SurfaceSearch::SurfaceSearch(const Task& task, Incumbent& best)
    : task_(task), best_(best), memory_(task.work) {
  const CandidateSet& set = task.set;
  if (!memory_.add(kBytesPerCandidate * set.size())) return;
  leastPair_ = leastPairs(set, task.measure);
  for (uint32_t e = 0; e < set.edgeCount(); ++e) {
    const uint32_t u = set.edgeVertices[2 * size_t(e)], v = set.edgeVertices[2 * size_t(e) + 1];
    if (task.loops.loopOf(u) == task.loops.loopOf(v)) continue;
    bridges_.push_back({distance(task.loops.position(u), task.loops.position(v)), e});
  }
  keepNear();
}

double SurfaceSearch::random() {
  seed_ += 0x9E3779B97F4A7C15u;
  return double(mixed(seed_) >> 11) * 0x1p-53;
}

void SurfaceSearch::keepNear() {
  const CandidateSet& set = task_.set;
  std::vector<uint8_t> isNear(set.edgeCount(), 1);
  if (isLarge(task_.loops, set)) {
    std::fill(isNear.begin(), isNear.end(), 0);
    std::vector<std::vector<Bridge>> edgesAt(task_.loops.vertexCount());
    for (uint32_t e = 0; e < set.edgeCount(); ++e) {
      const uint32_t u = set.edgeVertices[2 * size_t(e)], v = set.edgeVertices[2 * size_t(e) + 1];
      const double length = distance(task_.loops.position(u), task_.loops.position(v));
      edgesAt[u].push_back({length, e});
      edgesAt[v].push_back({length, e});
      if (set.isLoopEdge[e]) isNear[e] = 1;
    }
    for (std::vector<Bridge>& edges : edgesAt) {
      const size_t count = std::min(edges.size(), kNearEdges);
      sf::sort(edges.begin(), edges.end(), [](const Bridge& a, const Bridge& b) {
        return a.key < b.key || (a.key == b.key && a.edge < b.edge);
      });
      for (size_t i = 0; i < count; ++i) isNear[edges[i].edge] = 1;
    }
  }
  for (uint32_t t = 0; t < set.size(); ++t) {
    const uint32_t* e = &set.triangleEdges[3 * size_t(t)];
    if (task_.triangleCost[t] < kInfinity && isNear[e[0]] && isNear[e[1]] && isNear[e[2]])
      kept_.push_back(t);
  }
}

bool SurfaceSearch::measureSurface(const SplitOrder& order, double& cost,
                                   std::vector<uint32_t>& badEdges) const {
  const CandidateSet& set = task_.set;
  const std::vector<EdgeUse> uses = edgeUses(set, order);
  cost = task_.measure.isWorst() ? -kInfinity : 0;
  for (const uint32_t t : order) cost = task_.measure.join(cost, task_.triangleCost[t]);
  badEdges.clear();
  for (size_t i = 0; i < uses.size();) {
    const uint32_t edge = uses[i].edge;
    size_t j = i;
    while (j < uses.size() && uses[j].edge == edge) ++j;
    if (j - i != (set.isLoopEdge[edge] ? 1u : 2u))
      badEdges.push_back(edge);
    else if (j - i == 2)
      cost = task_.measure.join(
          cost, task_.measure.pair(set.slotTheta[set.slotAt(uses[i].triangle, edge)],
                                   set.slotTheta[set.slotAt(uses[i + 1].triangle, edge)]));
    i = j;
  }
  return badEdges.empty() && cost < kInfinity;
}

void SurfaceSearch::lookAtBest() {
  if (costOfUses_ == best_.cost()) return;
  costOfUses_ = best_.cost();
  idle_ = 0;
  uses_ = edgeUses(task_.set, best_.order());
}

std::vector<uint32_t> SurfaceSearch::chooseBridges(std::vector<Bridge>& byKey,
                                                   uint32_t trees) const {
  sf::sort(byKey.begin(), byKey.end(), [](const Bridge& a, const Bridge& b) {
    return a.key < b.key || (a.key == b.key && a.edge < b.edge);
  });
  std::vector<uint32_t> chosen;
  Forest forest(task_.loops.loopCount());
  for (const Bridge& b : byKey) {
    if (forest.trees() == trees) break;
    const uint32_t* ends = &task_.set.edgeVertices[2 * size_t(b.edge)];
    if (forest.join(task_.loops.loopOf(ends[0]), task_.loops.loopOf(ends[1])))
      chosen.push_back(b.edge);
  }
  if (forest.trees() > trees) chosen.clear();
  sf::sort(chosen.begin(), chosen.end());
  return chosen;
}

/// Puts the loop of v into a polygon, along a bridge from one of the places of the vertex `at`.
void SurfaceSearch::joinLoop(std::vector<uint32_t>& polygon, uint32_t at, uint32_t v) {
  const LoopSet& loops = task_.loops;
  std::vector<size_t> places;
  for (size_t p = 0; p < polygon.size(); ++p)
    if (polygon[p] == at) places.push_back(p);
  const size_t place = places[size_t(random() * double(places.size()))];
  // Goes round the loop in the direction that keeps the neighbours of the bridge's ends near.
  const Vec3 before = loops.position(polygon[(place + polygon.size() - 1) % polygon.size()]);
  const Vec3 after = loops.position(polygon[(place + 1) % polygon.size()]);
  const Vec3 next = loops.position(loops.next(v)), previous = loops.position(loops.previous(v));
  bool forward = distance(before, next) + distance(after, previous) <
                 distance(before, previous) + distance(after, next);
  if (random() < kChanceOfTurning) forward = !forward;
  std::vector<uint32_t> way;
  uint32_t w = v;
  do {
    way.push_back(w);
    w = forward ? loops.next(w) : loops.previous(w);
  } while (w != v);
  way.push_back(v);
  way.push_back(at);
  polygon.insert(polygon.begin() + std::ptrdiff_t(place) + 1, way.begin(), way.end());
}

BridgeCut SurfaceSearch::cutAtRandom(const std::vector<uint32_t>& preferred) {
  const LoopSet& loops = task_.loops;
  BridgeCut cut;
  std::vector<Bridge> byKey(bridges_);
  for (Bridge& b : byKey) {
    // Short edges tend to come first.
    b.key *= 0.25 + random();
    if (std::binary_search(preferred.begin(), preferred.end(), b.edge)) b.key = -random();
  }
  cut.bridges = chooseBridges(byKey, 1);
  if (cut.bridges.empty()) return cut;
  for (uint32_t v = loops.first(0); v < loops.first(0) + loops.size(0); ++v)
    cut.origin.push_back(v);
  // Loop after loop goes into the polygon, until all bridges are built.
  std::vector<uint8_t> isIn(loops.loopCount(), 0);
  isIn[0] = 1;
  for (bool more = true; more;) {
    more = false;
    for (const uint32_t edge : cut.bridges) {
      uint32_t u = task_.set.edgeVertices[2 * size_t(edge)];
      uint32_t v = task_.set.edgeVertices[2 * size_t(edge) + 1];
      if (isIn[loops.loopOf(v)]) std::swap(u, v);
      if (!isIn[loops.loopOf(u)] || isIn[loops.loopOf(v)]) continue;
      joinLoop(cut.origin, u, v);
      isIn[loops.loopOf(v)] = 1;
      more = true;
    }
  }
  cut.across.assign(cut.origin.size(), kNone);
  cut.starts = {0, uint32_t(cut.origin.size())};
  return cut;
}

BridgeCut SurfaceSearch::cutBest(uint32_t loops) {
  std::vector<Bridge> byKey;
  for (size_t i = 0; i + 1 < uses_.size(); ++i)
    if (uses_[i].edge == uses_[i + 1].edge) byKey.push_back({random(), uses_[i].edge});
  return cutSurface(task_.set, uses_, chooseBridges(byKey, loops));
}

bool SurfaceSearch::solveCut(const BridgeCut& cut, uint64_t maxSplits) {
  CutProblem problem(task_, cut);
  if (!problem.build(kept_, leastPair_)) return false;
  const double known = best_.cost();
  for (int repair = 0; repair < kRepairs; ++repair) {
    double cost;
    SplitOrder order;
    if (!problem.solve(maxSplits, cost, order)) return false;
    // A cut this dear is not worth a repair. The margin is for what its cost leaves out.
    if (cost == kInfinity || cost > known + 0.1 * std::fabs(known)) break;
    std::vector<uint32_t> badEdges;
    if (measureSurface(order, cost, badEdges)) {
      best_.offer(std::move(order), cost);
      break;
    }
    // If an edge of the surface is two chords of the cut, or more, one of them has to go.
    for (const uint32_t edge : badEdges) {
      const std::vector<uint32_t> chords = problem.chordsOf(edge);
      problem.forbid(chords[size_t(random() * double(chords.size()))]);
    }
  }
  return true;
}

bool SurfaceSearch::offerAsIs(const LoopTriangles& triangles) {
  const CandidateSet& set = task_.set;
  const ArrayView<const uint32_t> v = triangles.vertices();
  SplitOrder order;
  for (size_t i = 0; i < v.size(); i += 3) {
    const uint32_t edge = set.edgeBetween(v[i], v[i + 1]);
    if (edge == kNone) return false;
    uint32_t slot = set.edgeSlots[edge];
    while (slot < set.edgeSlots[edge + 1] && set.slotApex[slot] != v[i + 2]) ++slot;
    if (slot == set.edgeSlots[edge + 1]) return false;
    order.push_back(set.slotTriangle[slot]);
  }
  double cost;
  std::vector<uint32_t> badEdges;
  if (!isSurface(task_.loops, set, order) || !measureSurface(order, cost, badEdges)) return false;
  best_.offer(std::move(order), cost);
  return true;
}

bool SurfaceSearch::startFrom(const LoopTriangles& triangles) {
  SF_ASSERT(&triangles.loops() == &task_.loops);
  if (!task_.work.going()) return false;
  if (offerAsIs(triangles)) return true;
  const CandidateSet& set = task_.set;
  std::vector<uint32_t> edges;
  const ArrayView<const uint32_t> v = triangles.vertices();
  for (size_t i = 0; i < v.size(); i += 3)
    for (int j = 0; j < 3; ++j) {
      const uint32_t e = set.edgeBetween(v[i + j], v[i + (j + 1) % 3]);
      if (e != kNone) edges.push_back(e);
    }
  sf::sort(edges.begin(), edges.end());
  const BridgeCut cut = cutAtRandom(edges);
  return cut.isEmpty() || solveCut(cut, kUnlimited);
}

bool SurfaceSearch::search(uint32_t tries) {
  if (!task_.work.going()) return false;
  const uint32_t k = task_.loops.loopCount();
  for (uint32_t i = 0; i < tries; ++i) {
    lookAtBest();
    if (idle_++ >= kMostIdle) break;
    const bool fresh = best_.cost() == kInfinity || idle_ % 8 == 0;
    // Mostly one polygon is solved; two or three loops once that gets stuck.
    const uint32_t left = idle_ > 60 && k > 3 && idle_ % 12 == 1  ? 3
                          : idle_ > 20 && k > 2 && idle_ % 3 == 1 ? 2
                                                                  : 1;
    const BridgeCut cut = fresh ? cutAtRandom({}) : cutBest(left);
    if (cut.isEmpty()) break;
    if (!solveCut(cut, kSplitsOfCut) || !task_.work.tick(1000)) return false;
  }
  return task_.work.going();
}

}  // namespace sf
