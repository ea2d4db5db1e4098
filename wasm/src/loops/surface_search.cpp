#include "loops/surface_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "loops/lower_bound.h"

namespace sf {
namespace {

/// Shortest edges at each vertex that are looked at where the candidates are many.
constexpr size_t kNearEdges = 16;
/// Tries to be rid of edges that a solution closes twice.
constexpr int kRepairs = 8;
/// Of the arrays kept here and of those that a cut takes.
constexpr uint64_t kBytesPerCandidate = 150;
/// Splits for a cut that leaves several loops: some milliseconds.
constexpr uint64_t kSplitsOfCut = 200000;

uint32_t otherEnd(const CandidateSet& set, uint32_t edge, uint32_t v) {
  return set.edgeVertices[2 * size_t(edge)] + set.edgeVertices[2 * size_t(edge) + 1] - v;
}

uint32_t apexAt(const CandidateSet& set, uint32_t t, uint32_t edge) {
  const uint32_t* v = &set.triangles[3 * size_t(t)];
  return v[0] + v[1] + v[2] - set.edgeVertices[2 * size_t(edge)] -
         set.edgeVertices[2 * size_t(edge) + 1];
}

uint32_t slotAt(const CandidateSet& set, uint32_t t, uint32_t edge) {
  return set.slotOpposite(t, apexAt(set, t, edge));
}

}  // namespace

/// Loops that bridges have joined so far.
class SurfaceSearch::Forest {
 public:
  explicit Forest(uint32_t loops) : parent_(loops), trees_(loops) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  bool join(uint32_t a, uint32_t b) {
    a = find(a), b = find(b);
    if (a == b) return false;
    parent_[a] = b;
    --trees_;
    return true;
  }
  uint32_t trees() const { return trees_; }

 private:
  uint32_t find(uint32_t c) {
    while (parent_[c] != c) c = parent_[c] = parent_[parent_[c]];
    return c;
  }
  std::vector<uint32_t> parent_;
  uint32_t trees_;
};

void SurfaceSearch::Cut::clear() {
  origin.clear();
  across.clear();
  starts.assign(1, 0);
  bridges.clear();
}

SurfaceSearch::SurfaceSearch(const Task& task, Incumbent& best)
    : task_(task), best_(best), memory_(task.work) {
  const CandidateSet& set = task.set;
  if (!memory_.add(kBytesPerCandidate * set.size())) return;
  leastPair_ = leastPairs(set, task.measure);
  isBridge_.assign(set.edgeCount(), 0);
  for (uint32_t e = 0; e < set.edgeCount(); ++e) {
    const uint32_t u = set.edgeVertices[2 * size_t(e)], v = set.edgeVertices[2 * size_t(e) + 1];
    if (task.loops.loopOf(u) == task.loops.loopOf(v)) continue;
    bridges_.push_back({distance(task.loops.position(u), task.loops.position(v)), e});
  }
  keepNear();
}

double SurfaceSearch::random() {
  seed_ += 0x9E3779B97F4A7C15u;
  uint64_t x = seed_;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return double((x ^ (x >> 31)) >> 11) * 0x1p-53;
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
      std::partial_sort(edges.begin(), edges.begin() + std::ptrdiff_t(count), edges.end(),
                        [](const Bridge& a, const Bridge& b) {
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
  std::vector<Use> uses;
  cost = task_.measure.isWorst() ? -kInfinity : 0;
  for (const uint32_t t : order) {
    cost = task_.measure.join(cost, task_.triangleCost[t]);
    for (int i = 0; i < 3; ++i) uses.push_back({set.triangleEdges[3 * size_t(t) + i], t});
  }
  std::sort(uses.begin(), uses.end());
  badEdges.clear();
  for (size_t i = 0; i < uses.size();) {
    const uint32_t edge = uses[i].edge;
    size_t j = i;
    while (j < uses.size() && uses[j].edge == edge) ++j;
    if (j - i != (set.isLoopEdge[edge] ? 1u : 2u))
      badEdges.push_back(edge);
    else if (j - i == 2)
      cost = task_.measure.join(
          cost, task_.measure.pair(set.slotTheta[slotAt(set, uses[i].triangle, edge)],
                                   set.slotTheta[slotAt(set, uses[i + 1].triangle, edge)]));
    i = j;
  }
  return badEdges.empty() && cost < kInfinity;
}

void SurfaceSearch::lookAtBest() {
  if (costOfUses_ == best_.cost()) return;
  costOfUses_ = best_.cost();
  idle_ = 0;
  uses_.clear();
  for (const uint32_t t : best_.order())
    for (int i = 0; i < 3; ++i) uses_.push_back({task_.set.triangleEdges[3 * size_t(t) + i], t});
  std::sort(uses_.begin(), uses_.end());
}

uint32_t SurfaceSearch::mate(uint32_t edge, uint32_t triangle) const {
  auto u = std::lower_bound(uses_.begin(), uses_.end(), Use{edge, 0});
  for (; u != uses_.end() && u->edge == edge; ++u)
    if (u->triangle != triangle) return u->triangle;
  return kNone;
}

void SurfaceSearch::cutAtRandom(Cut& cut, const std::vector<uint32_t>& preferred) {
  const LoopSet& loops = task_.loops;
  const CandidateSet& set = task_.set;
  cut.clear();
  // The shorter the bridge the better, with some luck.
  std::vector<Bridge> byKey(bridges_);
  for (Bridge& b : byKey) b.key *= 0.25 + random();
  for (Bridge& b : byKey)
    if (std::binary_search(preferred.begin(), preferred.end(), b.edge)) b.key = -random();
  std::sort(byKey.begin(), byKey.end(), [](const Bridge& a, const Bridge& b) {
    return a.key < b.key || (a.key == b.key && a.edge < b.edge);
  });
  Forest forest(loops.loopCount());
  std::vector<std::vector<uint32_t>> bridgesAt(loops.loopCount());
  for (const Bridge& b : byKey) {
    const uint32_t c = loops.loopOf(set.edgeVertices[2 * size_t(b.edge)]);
    const uint32_t d = loops.loopOf(set.edgeVertices[2 * size_t(b.edge) + 1]);
    if (!forest.join(c, d)) continue;
    cut.bridges.push_back(b.edge);
    bridgesAt[c].push_back(b.edge);
    bridgesAt[d].push_back(b.edge);
  }
  if (forest.trees() > 1) {
    cut.clear();
    return;
  }
  // Loop after loop goes into the polygon, where its bridge begins.
  std::vector<uint32_t>& polygon = cut.origin;
  for (uint32_t v = loops.first(0); v < loops.first(0) + loops.size(0); ++v) polygon.push_back(v);
  std::vector<uint32_t> queue{0};
  std::vector<uint8_t> isIn(loops.loopCount(), 0);
  isIn[0] = 1;
  for (size_t i = 0; i < queue.size(); ++i) {
    for (const uint32_t edge : bridgesAt[queue[i]]) {
      uint32_t u = set.edgeVertices[2 * size_t(edge)], v = set.edgeVertices[2 * size_t(edge) + 1];
      if (loops.loopOf(u) != queue[i]) std::swap(u, v);
      if (isIn[loops.loopOf(v)]) continue;
      isIn[loops.loopOf(v)] = 1;
      queue.push_back(loops.loopOf(v));
      std::vector<size_t> places;
      for (size_t p = 0; p < polygon.size(); ++p)
        if (polygon[p] == u) places.push_back(p);
      const size_t place = places[size_t(random() * double(places.size()))];
      // Round the new loop in the direction that keeps neighbours of the bridge's ends near.
      const Vec3 before = loops.position(polygon[(place + polygon.size() - 1) % polygon.size()]);
      const Vec3 after = loops.position(polygon[(place + 1) % polygon.size()]);
      const Vec3 next = loops.position(loops.next(v)), previous = loops.position(loops.previous(v));
      bool forward = distance(before, next) + distance(after, previous) <
                     distance(before, previous) + distance(after, next);
      if (random() < 0.15) forward = !forward;
      std::vector<uint32_t> way;
      uint32_t w = v;
      do {
        way.push_back(w);
        w = forward ? loops.next(w) : loops.previous(w);
      } while (w != v);
      way.push_back(v);
      way.push_back(u);
      polygon.insert(polygon.begin() + std::ptrdiff_t(place) + 1, way.begin(), way.end());
    }
  }
  cut.across.assign(polygon.size(), kNone);
  cut.starts.push_back(uint32_t(polygon.size()));
}

void SurfaceSearch::cutBest(uint32_t loopsLeft, Cut& cut) {
  const LoopSet& loops = task_.loops;
  const CandidateSet& set = task_.set;
  cut.clear();
  std::vector<Bridge> byKey;
  for (size_t i = 0; i + 1 < uses_.size(); ++i)
    if (uses_[i].edge == uses_[i + 1].edge) byKey.push_back({random(), uses_[i].edge});
  std::sort(byKey.begin(), byKey.end(),
            [](const Bridge& a, const Bridge& b) { return a.key < b.key; });
  Forest forest(loops.loopCount());
  for (const Bridge& b : byKey) {
    if (forest.trees() == loopsLeft) break;
    if (forest.join(loops.loopOf(set.edgeVertices[2 * size_t(b.edge)]),
                    loops.loopOf(set.edgeVertices[2 * size_t(b.edge) + 1])))
      cut.bridges.push_back(b.edge);
  }
  std::sort(cut.bridges.begin(), cut.bridges.end());
  const auto isSide = [&](uint32_t edge) {
    return set.isLoopEdge[edge] || std::binary_search(cut.bridges.begin(), cut.bridges.end(), edge);
  };
  // Round the boundary of what is left, from side to side about their common end.
  std::vector<uint8_t> seen(uses_.size(), 0);
  for (size_t first = 0; first < uses_.size(); ++first) {
    if (seen[first] || !isSide(uses_[first].edge)) continue;
    Use side = uses_[first];
    uint32_t from = set.edgeVertices[2 * size_t(side.edge)];
    for (;;) {
      const size_t at = size_t(std::lower_bound(uses_.begin(), uses_.end(), side) - uses_.begin());
      if (seen[at]) break;
      seen[at] = 1;
      const uint32_t beyond = mate(side.edge, side.triangle);
      cut.origin.push_back(from);
      cut.across.push_back(beyond == kNone ? kNone : slotAt(set, beyond, side.edge));
      const uint32_t pivot = otherEnd(set, side.edge, from);
      from = pivot;
      uint32_t back = otherEnd(set, side.edge, pivot);
      for (;;) {
        side.edge = set.edgeOpposite(side.triangle, back);
        if (isSide(side.edge)) break;
        back = otherEnd(set, side.edge, pivot);
        side.triangle = mate(side.edge, side.triangle);
      }
    }
    cut.starts.push_back(uint32_t(cut.origin.size()));
  }
}

double SurfaceSearch::costInCut(const Cut& cut, const LoopSet& loops, uint32_t t,
                                const uint32_t place[3]) const {
  const CandidateSet& set = task_.set;
  double cost = task_.triangleCost[t];
  for (int i = 0; i < 3; ++i) {
    const uint32_t edge = set.triangleEdges[3 * size_t(t) + i];
    if (!isBridge_[edge]) continue;
    const uint32_t a = place[(i + 1) % 3], b = place[(i + 2) % 3];
    const uint32_t across = cut.across[loops.next(a) == b ? a : b];
    const uint32_t slot = set.triangleSlots[3 * size_t(t) + i];
    const double pair = across == kNone
                            ? leastPair_[slot]
                            : task_.measure.pair(set.slotTheta[slot], set.slotTheta[across]);
    cost = task_.measure.join(cost, task_.measure.isWorst() ? pair : 0.5 * pair);
  }
  return cost;
}

bool SurfaceSearch::solveCut(const Cut& cut, uint64_t maxSplits) {
  const CandidateSet& set = task_.set;
  const uint32_t count = uint32_t(cut.origin.size());
  std::vector<Vec3> positions;
  for (const uint32_t v : cut.origin) positions.push_back(task_.loops.position(v));
  const LoopSet loops(positions, cut.starts);
  for (const uint32_t e : cut.bridges) isBridge_[e] = 1;

  // Where each vertex is.
  std::vector<uint32_t> first(size_t(task_.loops.vertexCount()) + 1, 0), places(count);
  for (const uint32_t v : cut.origin) ++first[v + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<uint32_t> cursor(first.begin(), first.end() - 1);
  for (uint32_t p = 0; p < count; ++p) places[cursor[cut.origin[p]]++] = p;

  struct Copy {
    uint32_t place[3];
    uint32_t triangle;
    double cost;
  };
  std::vector<Copy> copies;
  const auto addCopy = [&](uint32_t t, const uint32_t place[3]) {
    for (int i = 0; i < 3; ++i) {
      // What closes a loop or was cut is a side here, and no chord.
      const uint32_t edge = set.triangleEdges[3 * size_t(t) + i];
      if ((set.isLoopEdge[edge] || isBridge_[edge]) &&
          !loops.isLoopEdge(place[(i + 1) % 3], place[(i + 2) % 3]))
        return;
    }
    const double cost = costInCut(cut, loops, t, place);
    if (cost == kInfinity) return;
    Copy copy{{place[0], place[1], place[2]}, t, cost};
    std::sort(copy.place, copy.place + 3);
    copies.push_back(copy);
  };
  for (const uint32_t t : kept_) {
    const uint32_t* v = &set.triangles[3 * size_t(t)];
    for (uint32_t a = first[v[0]]; a < first[v[0] + 1]; ++a)
      for (uint32_t b = first[v[1]]; b < first[v[1] + 1]; ++b)
        for (uint32_t c = first[v[2]]; c < first[v[2] + 1]; ++c) {
          const uint32_t place[3] = {places[a], places[b], places[c]};
          addCopy(t, place);
        }
  }
  for (const uint32_t e : cut.bridges) isBridge_[e] = 0;

  std::vector<uint32_t> triples, parent;
  std::vector<double> cost;
  for (const Copy& copy : copies) {
    triples.insert(triples.end(), copy.place, copy.place + 3);
    parent.push_back(copy.triangle);
    cost.push_back(copy.cost);
  }
  const uint64_t before = task_.work.used();
  CandidateSet inCut;
  if (!buildCandidateSet(loops, TriangleWeights(), std::move(triples), task_.work, inCut))
    return false;
  bool good = true;
  const double known = best_.cost();
  for (int repair = 0; repair < kRepairs; ++repair) {
    Optimum found;
    SolverCounts counts;
    const Task task{loops, inCut, cost, task_.measure, task_.work, false};
    good = solveDirectly(task, maxSplits, kInfinity, found, counts);
    if (!good || found.cost == kInfinity) break;
    // Nothing to be repaired is worth it, unless what is left out makes up for it.
    if (found.cost > known + 0.1 * std::fabs(known)) break;
    SplitOrder order;
    for (const uint32_t t : found.order) order.push_back(parent[t]);
    double surfaceCost;
    std::vector<uint32_t> badEdges;
    if (measureSurface(order, surfaceCost, badEdges)) {
      best_.offer(std::move(order), surfaceCost);
      break;
    }
    // An edge of the surface that is two chords of the cut, or more: all but one have to go.
    for (const uint32_t edge : badEdges) {
      std::vector<uint32_t> chords;
      for (size_t i = 0; i < found.order.size(); ++i) {
        const uint32_t t = found.order[i];
        for (int j = 0; j < 3; ++j) {
          const uint32_t chord = inCut.triangleEdges[3 * size_t(t) + j];
          const uint32_t u = cut.origin[inCut.edgeVertices[2 * size_t(chord)]];
          const uint32_t v = cut.origin[inCut.edgeVertices[2 * size_t(chord) + 1]];
          if (set.edgeBetween(u, v) == edge) chords.push_back(chord);
        }
      }
      const uint32_t chord = chords[size_t(random() * double(chords.size()))];
      for (uint32_t s = inCut.edgeSlots[chord]; s < inCut.edgeSlots[chord + 1]; ++s)
        cost[inCut.slotTriangle[s]] = kInfinity;
    }
  }
  task_.work.release(task_.work.used() - before);
  return good;
}

bool SurfaceSearch::startFrom(ArrayView<const uint32_t> triangles) {
  if (!task_.work.going()) return false;
  const CandidateSet& set = task_.set;
  std::vector<uint32_t> edges;
  for (size_t i = 0; i < triangles.size(); i += 3)
    for (int j = 0; j < 3; ++j) {
      const uint32_t e = set.edgeBetween(triangles[i + j], triangles[i + (j + 1) % 3]);
      if (e != kNone) edges.push_back(e);
    }
  std::sort(edges.begin(), edges.end());
  Cut cut;
  cutAtRandom(cut, edges);
  return cut.origin.empty() || solveCut(cut, kUnlimited);
}

bool SurfaceSearch::search(uint32_t tries) {
  Cut cut;
  const uint32_t k = task_.loops.loopCount();
  if (!task_.work.going()) return false;
  for (uint32_t i = 0; i < tries; ++i) {
    lookAtBest();
    if (idle_++ >= kMostIdle) break;
    if (best_.cost() == kInfinity || idle_ % 8 == 7) {
      cutAtRandom(cut, {});
      if (cut.origin.empty()) return true;
    } else {
      // One polygon mostly; two or three loops once that has got stuck.
      uint32_t left = 1;
      if (idle_ > 20 && k > 2 && idle_ % 3 == 0) left = 2;
      if (idle_ > 60 && k > 3 && idle_ % 12 == 0) left = 3;
      cutBest(left, cut);
    }
    if (!solveCut(cut, kSplitsOfCut)) return false;
    if (!task_.work.tick(1000)) return false;
  }
  return task_.work.going();
}

}  // namespace sf
