#include "loops/spaces/near_space.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/charge.h"
#include "base/sort.h"
#include "loops/problem/weight.h"
#include "loops/spaces/neck_search.h"
#include "loops/spaces/polygon_chart.h"

namespace sf {
namespace {

using Corners = std::vector<PolygonChart::Corner>;

/// Triangles taken for each vertex: of one loop; of two, for each bridge.
constexpr size_t kPerVertex = 6;
constexpr size_t kPerVertexAndBridge = 4;
/// How much dearer than the best surface the surfaces of those triangles may be,
/// as a share of its cost.
constexpr double kDearer = 0.05, kDearerWithBridge = 0.4;
/// How many of the bridges tried give their triangles: the cheapest of all, and the cheapest valid
/// ones. At least the first number, or one for as many vertices as the second.
constexpr size_t kTaken = 8, kVerticesPerTaken = 5;
/// The same for a bridge of two loops without angles.
constexpr size_t kPlainPerVertex = 2;
constexpr double kPlainDearer = 0.1;
constexpr uint32_t kPlainBridges = 6;
/// Vertices for each bridge that is tried: bridges of a surface; short ones,
/// each in two directions.
constexpr uint32_t kVerticesPerBridge = 4, kVerticesPerShortBridge = 3;
constexpr uint32_t kLeastBridges = 10, kMostBridges = 16;
/// The most vertices for which the chart of one loop is affordable, and for two loops the solution
/// over triangles from several charts.
constexpr uint32_t kMostVertices = 4000, kMostOfTwoLoops = 120;

/// Appends the vertices of a loop from `start` once round; if `closed`, `start` again.
void walk(const LoopSet& loops, const TriangleWeights& weights, uint32_t start, bool forward,
          bool closed, Corners& corners) {
  const uint32_t size = loops.size(loops.loopOf(start));
  uint32_t v = start;
  for (uint32_t step = 0; step < size; ++step) {
    const uint32_t next = forward ? loops.next(v) : loops.previous(v);
    PolygonChart::Corner corner{v, false, {}};
    if (!weights.normals.empty()) {
      const uint32_t edge = forward ? v : next;
      const double* n = &weights.normals[3 * size_t(edge)];
      const double largest = std::max({std::fabs(n[0]), std::fabs(n[1]), std::fabs(n[2])});
      if (!std::isnan(n[0])) {
        const Vec3 scaled{n[0] / largest, n[1] / largest, n[2] / largest};
        corner.hasFace = true;
        corner.normal = ((forward ? 1 : -1) / length(scaled)) * scaled;
      }
    }
    corners.push_back(corner);
    v = next;
  }
  if (closed) corners.push_back({start, false, {}});
}

struct Bridge {
  uint32_t a, b;
  bool forward;  // of the second loop
};

uint32_t nearestOf(const LoopSet& loops, uint32_t vertex, uint32_t loop) {
  uint32_t best = loops.first(loop);
  for (uint32_t v = best; v < loops.first(loop) + loops.size(loop); ++v)
    if (distance(loops.position(v), loops.position(vertex)) <
        distance(loops.position(best), loops.position(vertex)))
      best = v;
  return best;
}

/// From some vertices of the first loop to the nearest of the second, in both directions.
std::vector<Bridge> shortBridges(const LoopSet& loops, uint32_t count) {
  std::vector<Bridge> bridges;
  for (uint32_t q = 0; q < count; ++q) {
    const uint32_t a = loops.first(0) + uint32_t(uint64_t(q) * loops.size(0) / count);
    const uint32_t b = nearestOf(loops, a, 1);
    bridges.push_back({a, b, false});
    bridges.push_back({a, b, true});
  }
  return bridges;
}

Corners joined(const LoopSet& loops, const TriangleWeights& weights, const Bridge& bridge) {
  Corners corners;
  walk(loops, weights, bridge.a, true, true, corners);
  walk(loops, weights, bridge.b, bridge.forward, true, corners);
  return corners;
}

void append(const Corners& corners, const std::vector<PolygonChart::Triangle>& found,
            std::vector<uint32_t>& triples) {
  for (const PolygonChart::Triangle& t : found)
    for (const uint32_t c : t.corner) triples.push_back(corners[c].vertex);
}

/// Two loops as one polygon, for one bridge after the other.
class BridgeSearch {
 public:
  BridgeSearch(const LoopTriangles& surface, const TriangleWeights& weights, Work& work,
               std::vector<BridgeTrial>& trials)
      : surface_(surface),
        loops_(surface.loops()),
        weights_(weights),
        chart_(loops_, weights, work),
        trials_(trials) {}

  /// Tries bridges of the surface, or if there is none, short ones. Appends what they give.
  bool run(std::vector<uint32_t>& triples);

 private:
  bool attempt(const Bridge& bridge);
  bool isValid(const Corners& corners, const std::vector<PolygonChart::Triangle>& surface);
  double angleAtBridge(const Corners& corners,
                       const std::vector<PolygonChart::Triangle>& surface) const;

  const LoopTriangles& surface_;
  const LoopSet& loops_;
  const TriangleWeights& weights_;
  PolygonChart chart_;
  std::vector<BridgeTrial>& trials_;
  std::vector<std::pair<uint32_t, uint32_t>> edges_;  // scratch
};

/// Whether each loop edge is in one of the triangles, and every other edge of theirs in two.
bool BridgeSearch::isValid(const Corners& corners,
                           const std::vector<PolygonChart::Triangle>& surface) {
  edges_.clear();
  for (const PolygonChart::Triangle& t : surface)
    for (int i = 0; i < 3; ++i) {
      const uint32_t a = corners[t.corner[i]].vertex, b = corners[t.corner[(i + 1) % 3]].vertex;
      edges_.push_back({std::min(a, b), std::max(a, b)});
    }
  sf::sort(edges_.begin(), edges_.end());
  for (size_t i = 0; i < edges_.size();) {
    size_t end = i + 1;
    while (end < edges_.size() && edges_[end] == edges_[i]) ++end;
    if (end - i != (loops_.isLoopEdge(edges_[i].first, edges_[i].second) ? 1u : 2u)) return false;
    i = end;
  }
  return true;
}

/// The angle at the bridge, where the polygon was cut.
double BridgeSearch::angleAtBridge(const Corners& corners,
                                   const std::vector<PolygonChart::Triangle>& surface) const {
  const uint32_t cut = loops_.size(0);  // the bridge is from there to the next corner
  const auto normalOf = [&](const PolygonChart::Triangle& t) {
    const Vec3 p = loops_.position(corners[t.corner[0]].vertex);
    return cross(loops_.position(corners[t.corner[1]].vertex) - p,
                 loops_.position(corners[t.corner[2]].vertex) - p);
  };
  for (const PolygonChart::Triangle& t : surface)
    for (int i = 0; i < 2; ++i)
      if (t.corner[i] == cut && t.corner[i + 1] == cut + 1)
        return weights_.dihedral * angleBetween(normalOf(t), normalOf(surface[0]));
  return 0;
}

bool BridgeSearch::attempt(const Bridge& bridge) {
  const Corners corners = joined(loops_, weights_, bridge);
  if (!chart_.compute(corners)) return false;
  BridgeTrial trial{bridge.a, bridge.b, bridge.forward, false, chart_.best(), {}};
  if (trial.cost < kInfinity) {
    std::vector<PolygonChart::Triangle> found;
    chart_.trace(found);
    trial.isValid = isValid(corners, found);
    trial.cost += angleAtBridge(corners, found);
    chart_.nearBest(kDearerWithBridge * chart_.best(), kPerVertexAndBridge * corners.size(), found);
    append(corners, found, trial.triples);
  }
  trials_.push_back(std::move(trial));
  return true;
}

/// Bridges among the edges of a surface.
std::vector<Bridge> bridgesOf(const LoopTriangles& triangles) {
  const LoopSet& loops = triangles.loops();
  const ArrayView<const uint32_t> surface = triangles.vertices();
  // Whether the triangles pass the loops' edges from each vertex to the next.
  bool isForward[2] = {};
  std::vector<std::pair<uint32_t, uint32_t>> edges;
  for (size_t i = 0; i < surface.size(); ++i) {
    const uint32_t u = surface[i], v = surface[i % 3 == 2 ? i - 2 : i + 1];
    if (loops.next(u) == v && loops.next(v) != u) isForward[loops.loopOf(u)] = true;
    if (loops.loopOf(u) < loops.loopOf(v)) edges.push_back({u, v});
  }
  // Sorted, they follow each other around.
  sf::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  const size_t count = std::min<size_t>(
      edges.size(),
      std::clamp(loops.vertexCount() / kVerticesPerBridge, kLeastBridges, kMostBridges));
  std::vector<Bridge> bridges;
  for (size_t q = 0; q < count; ++q) {
    const auto& [a, b] = edges[q * edges.size() / count];
    bridges.push_back({a, b, isForward[0] == isForward[1]});
  }
  return bridges;
}

bool BridgeSearch::run(std::vector<uint32_t>& triples) {
  std::vector<uint32_t> byCost;
  const uint32_t count =
      std::clamp(loops_.vertexCount() / kVerticesPerShortBridge, kLeastBridges, kMostBridges);
  for (const Bridge& bridge :
       surface_.isEmpty() ? shortBridges(loops_, count) : bridgesOf(surface_)) {
    const auto known = std::find_if(trials_.begin(), trials_.end(), [&](const BridgeTrial& trial) {
      return trial.a == bridge.a && trial.b == bridge.b && trial.forward == bridge.forward;
    });
    byCost.push_back(uint32_t(known - trials_.begin()));
    if (known == trials_.end() && !attempt(bridge)) return false;
  }
  sf::sort(byCost.begin(), byCost.end(), [&](uint32_t a, uint32_t b) {
    return trials_[a].cost < trials_[b].cost || (trials_[a].cost == trials_[b].cost && a < b);
  });
  // The cheapest of all, and the cheapest that are surfaces.
  const size_t taken = std::max<size_t>(kTaken, loops_.vertexCount() / kVerticesPerTaken);
  size_t all = 0, valid = 0;
  for (const uint32_t q : byCost) {
    const BridgeTrial& trial = trials_[q];
    if (all++ < taken || (trial.isValid && valid < taken))
      triples.insert(triples.end(), trial.triples.begin(), trial.triples.end());
    valid += trial.isValid;
  }
  return true;
}

/// Two loops without angles: two discs and a neck between them, or where the loops lie near each
/// other, a band that a bridge cuts to a polygon.
bool plainTriples(const LoopSet& loops, const TriangleWeights& weights, Work& work,
                  std::vector<uint32_t>& triples) {
  const uint32_t n = loops.vertexCount();
  Charge memory(work);
  if (!memory.add(uint64_t(bytesForNecks(n)))) return false;
  const TripleWeights table(loops, weights);
  if (!work.tick(n * n * n) || !neckTriples(loops, table, work, triples)) return false;
  std::vector<std::pair<double, std::vector<uint32_t>>> trials;
  PlainPolygon polygon(loops, table);
  for (const Bridge& bridge : shortBridges(loops, kPlainBridges)) {
    std::vector<uint32_t> vertices;
    for (const PolygonChart::Corner& corner : joined(loops, weights, bridge))
      vertices.push_back(corner.vertex);
    if (!work.tick(n * n * n)) return false;
    polygon.compute(std::move(vertices));
    if (polygon.best() == kInfinity) continue;
    trials.push_back({polygon.best(), {}});
    polygon.nearBest((1 + kPlainDearer) * polygon.best(), kPlainPerVertex * polygon.size(),
                     trials.back().second);
  }
  sf::sort(trials.begin(), trials.end());
  for (size_t q = 0; q < std::min(kTaken, trials.size()); ++q)
    triples.insert(triples.end(), trials[q].second.begin(), trials[q].second.end());
  return true;
}

}  // namespace

bool hasNearOptimalTriples(const LoopSet& loops, const Work& work) {
  const uint32_t n = loops.vertexCount() + 2;
  if (loops.loopCount() > 2 || n > (loops.loopCount() == 1 ? kMostVertices : kMostOfTwoLoops))
    return false;
  return work.fits(loops.loopCount() == 1 ? PolygonChart::bytesFor(n)
                                          : std::max(PolygonChart::bytesFor(n), bytesForNecks(n)));
}

bool nearOptimalTriples(const LoopTriangles& surface, const TriangleWeights& weights, Work& work,
                        std::vector<BridgeTrial>& trials, std::vector<uint32_t>& triples) {
  const LoopSet& loops = surface.loops();
  if (loops.loopCount() == 2 && weights.dihedral == 0)
    return plainTriples(loops, weights, work, triples);
  if (loops.loopCount() == 2) return BridgeSearch(surface, weights, work, trials).run(triples);
  Corners corners;
  walk(loops, weights, 0, true, false, corners);
  PolygonChart chart(loops, weights, work);
  if (!chart.compute(corners)) return false;
  std::vector<PolygonChart::Triangle> found;
  chart.nearBest(kDearer * chart.best(), kPerVertex * corners.size(), found);
  append(corners, found, triples);
  return true;
}

}  // namespace sf
