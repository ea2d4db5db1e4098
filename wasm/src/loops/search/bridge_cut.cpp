#include "loops/search/bridge_cut.h"

#include <algorithm>
#include <numeric>

#include "base/sort.h"

namespace sf {
namespace {

/// Bytes of a copy of a triangle before it is a candidate.
constexpr uint64_t kBytesPerCopy = 48;

bool isIn(const std::vector<uint32_t>& sorted, uint32_t value) {
  return std::binary_search(sorted.begin(), sorted.end(), value);
}

uint32_t otherEnd(const CandidateSet& set, uint32_t edge, uint32_t v) {
  return set.edgeVertices[2 * size_t(edge)] + set.edgeVertices[2 * size_t(edge) + 1] - v;
}

uint32_t mate(const std::vector<EdgeUse>& uses, EdgeUse use) {
  auto u = std::lower_bound(uses.begin(), uses.end(), EdgeUse{use.edge, 0});
  for (; u != uses.end() && u->edge == use.edge; ++u)
    if (u->triangle != use.triangle) return u->triangle;
  return kNone;
}

}  // namespace

std::vector<EdgeUse> edgeUses(const CandidateSet& set, const SplitOrder& order) {
  std::vector<EdgeUse> uses;
  for (const uint32_t t : order)
    for (int i = 0; i < 3; ++i) uses.push_back({set.triangleEdges[3 * size_t(t) + i], t});
  sf::sort(uses.begin(), uses.end());
  return uses;
}

bool isSurface(const LoopSet& loops, const CandidateSet& set, SplitOrder& triangles) {
  // With this number of triangles, and one fan at each vertex, the Euler number is that of a sphere
  // with k holes. All surfaces that cannot be oriented, or have handles, have a smaller one.
  const size_t count = size_t(loops.vertexCount()) + 2 * size_t(loops.loopCount()) - 4;
  if (triangles.size() != count) return false;
  const std::vector<EdgeUse> uses = edgeUses(set, triangles);
  for (size_t i = 0; i < uses.size();) {
    size_t end = i + 1;
    while (end < uses.size() && uses[end].edge == uses[i].edge) ++end;
    if (end - i != (set.isLoopEdge[uses[i].edge] ? 1u : 2u)) return false;
    i = end;
  }
  std::vector<uint32_t> valence(loops.vertexCount(), 0);
  for (const uint32_t t : triangles)
    for (int i = 0; i < 3; ++i) ++valence[set.triangles[3 * size_t(t) + i]];
  for (uint32_t v = 0; v < loops.vertexCount(); ++v) {
    uint32_t edge = set.loopEdges[v];
    if (edge == kNone) return false;
    const auto first = std::lower_bound(uses.begin(), uses.end(), EdgeUse{edge, 0});
    if (first == uses.end() || first->edge != edge) return false;
    uint32_t fan = 0;
    for (uint32_t t = first->triangle; t != kNone; t = mate(uses, {edge, t}), ++fan)
      edge = set.edgeOpposite(t, otherEnd(set, edge, v));
    if (fan != valence[v]) return false;
  }
  SplitOrder order{triangles[0]}, sorted(triangles);
  sf::sort(sorted.begin(), sorted.end());
  const auto placeOf = [&](uint32_t t) {
    return size_t(std::lower_bound(sorted.begin(), sorted.end(), t) - sorted.begin());
  };
  std::vector<uint8_t> seen(count, 0);
  seen[placeOf(triangles[0])] = 1;
  for (size_t i = 0; i < order.size(); ++i)
    for (int j = 0; j < 3; ++j) {
      const uint32_t beyond = mate(uses, {set.triangleEdges[3 * size_t(order[i]) + j], order[i]});
      if (beyond == kNone || seen[placeOf(beyond)]) continue;
      seen[placeOf(beyond)] = 1;
      order.push_back(beyond);
    }
  triangles = std::move(order);
  return triangles.size() == count;
}

BridgeCut cutSurface(const CandidateSet& set, const std::vector<EdgeUse>& uses,
                     std::vector<uint32_t> bridges) {
  BridgeCut cut;
  cut.bridges = std::move(bridges);
  cut.starts.push_back(0);
  const auto isSide = [&](uint32_t edge) {
    return set.isLoopEdge[edge] || isIn(cut.bridges, edge);
  };
  // Goes round the boundary of what is left, from side to side about their common end.
  std::vector<uint8_t> seen(uses.size(), 0);
  for (size_t first = 0; first < uses.size(); ++first) {
    if (seen[first] || !isSide(uses[first].edge)) continue;
    EdgeUse side = uses[first];
    uint32_t from = set.edgeVertices[2 * size_t(side.edge)];
    for (;;) {
      const size_t at = size_t(std::lower_bound(uses.begin(), uses.end(), side) - uses.begin());
      if (seen[at]) break;
      seen[at] = 1;
      const uint32_t beyond = mate(uses, side);
      cut.origin.push_back(from);
      cut.across.push_back(beyond == kNone ? kNone : set.slotAt(beyond, side.edge));
      uint32_t back = from;
      from = otherEnd(set, side.edge, from);
      for (;;) {
        side.edge = set.edgeOpposite(side.triangle, back);
        if (isSide(side.edge)) break;
        back = otherEnd(set, side.edge, from);
        side.triangle = mate(uses, side);
      }
    }
    cut.starts.push_back(uint32_t(cut.origin.size()));
  }
  return cut;
}

void CutProblem::addCopy(uint32_t t, const uint32_t place[3],
                         const std::vector<double>& leastPair) {
  const CandidateSet& set = task_.set;
  const Measure& measure = task_.measure;
  double cost = task_.triangleCost[t];
  for (int i = 0; i < 3; ++i) {
    const uint32_t edge = set.triangleEdges[3 * size_t(t) + i];
    const uint32_t a = place[(i + 1) % 3], b = place[(i + 2) % 3];
    const bool bridge = isIn(cut_.bridges, edge);
    // A loop edge or an edge that was cut is a side here, never a chord.
    if ((set.isLoopEdge[edge] || bridge) && !loops_.isLoopEdge(a, b)) return;
    if (!bridge) continue;
    const uint32_t across = cut_.across[loops_.next(a) == b ? a : b];
    const uint32_t slot = set.triangleSlots[3 * size_t(t) + i];
    const double pair = across == kNone ? leastPair[slot]
                                        : measure.pair(set.slotTheta[slot], set.slotTheta[across]);
    cost = measure.join(cost, measure.isWorst() ? pair : 0.5 * pair);
  }
  if (cost == kInfinity) return;
  uint32_t sorted[3] = {place[0], place[1], place[2]};
  sf::sort(sorted, sorted + 3);
  triples_.insert(triples_.end(), sorted, sorted + 3);
  parent_.push_back(t);
  cost_.push_back(cost);
}

bool CutProblem::build(ArrayView<const uint32_t> kept, const std::vector<double>& leastPair) {
  const uint32_t count = uint32_t(cut_.origin.size());
  std::vector<Vec3> positions;
  for (const uint32_t v : cut_.origin) positions.push_back(task_.loops.position(v));
  loops_ = LoopSet(positions, cut_.starts);
  // Finds the positions of each vertex.
  std::vector<uint32_t> first(size_t(task_.loops.vertexCount()) + 1, 0), places(count);
  for (const uint32_t v : cut_.origin) ++first[v + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<uint32_t> cursor(first.begin(), first.end() - 1);
  for (uint32_t p = 0; p < count; ++p) places[cursor[cut_.origin[p]]++] = p;

  for (const uint32_t t : kept) {
    const uint32_t* v = &task_.set.triangles[3 * size_t(t)];
    for (uint32_t a = first[v[0]]; a < first[v[0] + 1]; ++a)
      for (uint32_t b = first[v[1]]; b < first[v[1] + 1]; ++b)
        for (uint32_t c = first[v[2]]; c < first[v[2] + 1]; ++c) {
          const uint32_t place[3] = {places[a], places[b], places[c]};
          addCopy(t, place, leastPair);
        }
    if (!task_.work.tick(30)) return false;
  }
  const uint64_t bytes = kBytesPerCopy * cost_.size();
  charged_ = bytes + uint64_t(CandidateSet::bytesFor(double(cost_.size())));
  // buildCandidateSet charges for the set.
  const bool charged = task_.work.charge(bytes);
  return buildCandidateSet(loops_, TriangleWeights(), std::move(triples_), task_.work, set_) &&
         charged;
}

bool CutProblem::solve(uint64_t maxSplits, double& cost, SplitOrder& order) {
  Optimum found;
  SolverCounts counts;
  const Task task{loops_, set_, cost_, task_.measure, task_.work, false};
  if (!solveDirectly(task, maxSplits, kInfinity, found, counts)) return false;
  cost = found.cost;
  solution_ = std::move(found.order);
  order.clear();
  for (const uint32_t t : solution_) order.push_back(parent_[t]);
  return true;
}

std::vector<uint32_t> CutProblem::chordsOf(uint32_t edge) const {
  std::vector<uint32_t> chords;
  for (const uint32_t t : solution_)
    for (int i = 0; i < 3; ++i) {
      const uint32_t chord = set_.triangleEdges[3 * size_t(t) + i];
      const uint32_t u = cut_.origin[set_.edgeVertices[2 * size_t(chord)]];
      const uint32_t v = cut_.origin[set_.edgeVertices[2 * size_t(chord) + 1]];
      if (task_.set.edgeBetween(u, v) == edge) chords.push_back(chord);
    }
  return chords;
}

void CutProblem::forbid(uint32_t chord) {
  for (uint32_t s = set_.edgeSlots[chord]; s < set_.edgeSlots[chord + 1]; ++s)
    cost_[set_.slotTriangle[s]] = kInfinity;
}

}  // namespace sf
