#include "loops/bounds/fan_estimate.h"

#include <algorithm>
#include <utility>

namespace sf {

FanEstimate::FanEstimate(const LoopSet& loops, const FanLinks& links,
                         const std::vector<double>& leastPair, Measure measure, FanCosts costs,
                         Work& work)
    : loops_(loops),
      links_(links),
      leastPair_(leastPair),
      costs_(std::move(costs)),
      work_(work),
      memory_(work),
      domains_(loops),
      // Half of an angle belongs to either end of its edge.
      transform_(Measure::sum(0.5 * measure.dihedralWeight(), measure.cap())) {}

/// The cheapest walks from an edge to each spoke. `arrive` is only written; leaving_ holds the cost
/// of setting out into each spoke of the edge.
void FanEstimate::walk(const Vertex& v, uint32_t fromEdge, double* arrive) {
  const uint32_t n = v.spokeCount;
  const FanLinks::Spoke* spokes = &links_.spokes[v.firstSpoke];
  const FanLinks::Edge& from = links_.edges[v.firstEdge + fromEdge];
  std::fill_n(arrive, n, kInfinity);
  for (uint32_t s = 0; s < n; ++s)
    if (s < from.firstSpoke || s >= from.firstSpoke + from.spokeCount) leaving_[s] = kInfinity;
  for (uint32_t l = 1; l <= v.longest; ++l) {
    bool better = false;
    for (uint32_t s = 0; s < n; ++s) {
      const double cost = leaving_[s] + costs_.corner[spokes[s].corner];
      double& at = arrive[spokes[s].partner];
      if (cost < at) at = cost, better = true;
    }
    if (!better || !work_.tick(20 + 6 * n)) return;
    if (l < v.longest) links_.leave(v, arrive, transform_, leaving_.data());
  }
}

void FanEstimate::closeEdges(const Vertex& v, const double* arrive, double* edge) const {
  for (uint32_t i = 0; i < v.edgeCount; ++i) {
    const FanLinks::Edge& e = links_.edges[v.firstEdge + i];
    const double* leastPair = &leastPair_[links_.set.edgeSlots[e.number]];
    double best = kInfinity;
    for (uint32_t s = 0; s < e.spokeCount; ++s)
      best = std::min(best, arrive[e.firstSpoke + s] + 0.5 * leastPair[s]);
    edge[i] = best;
  }
}

bool FanEstimate::compute() {
  const size_t spokes = links_.spokes.size(), edges = links_.edges.size();
  const uint32_t n = loops_.vertexCount();
  if (!memory_.add(8 * (4 * spokes + 2 * edges + 2 * n) + sizeof(Walks) * edges +
                   8 * costs_.corner.size()))
    return false;
  uint32_t mostSpokes = 0;
  for (const Vertex& v : links_.vertices) mostSpokes = std::max(mostSpokes, v.spokeCount);
  leaving_.resize(mostSpokes);
  across_.resize(edges);
  fan_.assign(n, kInfinity);
  fansUntil_.assign(n + 1, 0);
  for (Walks* walks : {&fromStart_, &fromEnd_}) {
    walks->arrive.assign(spokes, kInfinity);
    walks->turned.assign(spokes, kInfinity);
    walks->edge.assign(edges, kInfinity);
  }
  for (uint32_t vertex = 0; vertex < n; ++vertex) {
    const Vertex& v = links_.vertices[vertex];
    if (v.startEdge != kNone && v.endEdge != kNone) {
      for (Walks* walks : {&fromStart_, &fromEnd_}) {
        double* arrive = &walks->arrive[v.firstSpoke];
        std::fill(leaving_.begin(), leaving_.end(), 0.0);
        walk(v, walks == &fromStart_ ? v.startEdge : v.endEdge, arrive);
        links_.leave(v, arrive, transform_, &walks->turned[v.firstSpoke]);
        closeEdges(v, arrive, &walks->edge[v.firstEdge]);
      }
      const FanLinks::Edge& end = links_.edges[v.firstEdge + v.endEdge];
      const double* arrive = &fromStart_.arrive[v.firstSpoke + end.firstSpoke];
      fan_[vertex] = *std::min_element(arrive, arrive + end.spokeCount);
    }
    fansUntil_[vertex + 1] = fansUntil_[vertex] + fan_[vertex];
    if (!work_.going()) return false;
  }
  return true;
}

void FanEstimate::excess(std::vector<double>& excess) const {
  const size_t c = links_.set.size();
  excess.assign(c, 0);
  std::vector<double> through(c, kInfinity);
  for (uint32_t vertex = 0; vertex < loops_.vertexCount(); ++vertex) {
    const Vertex& v = links_.vertices[vertex];
    const FanLinks::Spoke* spokes = &links_.spokes[v.firstSpoke];
    const auto ends = [&](uint32_t s) {
      const FanLinks::Edge& end = links_.edges[v.firstEdge + v.endEdge];
      return v.endEdge != kNone && s >= end.firstSpoke && s < end.firstSpoke + end.spokeCount;
    };
    // A fan with this triangle arrives at one of its two spokes, and goes on from there or ends.
    for (uint32_t s = 0; s < v.spokeCount; ++s) {
      double& least = through[spokes[s].corner / 3];
      least = std::min(least, fromStart_.arrive[v.firstSpoke + s] +
                                  (ends(s) ? 0 : fromEnd_.turned[v.firstSpoke + s]));
    }
    for (uint32_t s = 0; s < v.spokeCount; ++s) {
      if (s > spokes[s].partner) continue;
      const uint32_t t = spokes[s].corner / 3;
      const double best = fan_[vertex];
      excess[t] += best == kInfinity ? kInfinity : std::max(0.0, through[t] - best);
      through[t] = kInfinity;
    }
  }
}

const FanEstimate::Walks& FanEstimate::walksAcross(uint32_t vertex, uint32_t fromEdge) {
  const Vertex& v = links_.vertices[vertex];
  Walks& walks = across_[v.firstEdge + fromEdge];
  if (!walks.arrive.empty()) return walks;
  // Beyond the memory limit the work ends at the next tick; these few bytes more do no harm.
  memory_.add(8 * (2 * size_t(v.spokeCount) + v.edgeCount));
  walks.arrive.resize(v.spokeCount);
  walks.turned.resize(v.spokeCount);
  walks.edge.resize(v.edgeCount);
  const FanLinks::Edge& from = links_.edges[v.firstEdge + fromEdge];
  const double* leastPair = &leastPair_[links_.set.edgeSlots[from.number]];
  for (uint32_t s = 0; s < from.spokeCount; ++s) leaving_[from.firstSpoke + s] = 0.5 * leastPair[s];
  walk(v, fromEdge, walks.arrive.data());
  links_.leave(v, walks.arrive.data(), transform_, walks.turned.data());
  closeEdges(v, walks.arrive.data(), walks.edge.data());
  return walks;
}

/// The part of a fan from a loop edge at v to a spanning edge. accessIndex: the access triangle's
/// place at the edge, kNone for another spanning edge.
double FanEstimate::partOfFan(uint32_t vertex, uint32_t edge, bool fromStart,
                              uint32_t accessIndex) const {
  const Vertex& v = links_.vertices[vertex];
  const Walks& walks = fromStart ? fromStart_ : fromEnd_;
  const uint32_t at = links_.edgeAt(edge, vertex);
  if (accessIndex == kNone) return walks.edge[v.firstEdge + at];
  return walks.turned[v.firstSpoke + links_.edges[v.firstEdge + at].firstSpoke + accessIndex];
}

/// The part of a fan between two spanning edges at v.
double FanEstimate::fanBetween(uint32_t vertex, uint32_t first, uint32_t next, uint32_t firstAccess,
                               uint32_t nextAccess) {
  if (firstAccess != kNone) std::swap(first, next), std::swap(firstAccess, nextAccess);
  const Walks& walks = walksAcross(vertex, links_.edgeAt(first, vertex));
  const uint32_t at = links_.edgeAt(next, vertex);
  if (nextAccess == kNone) return walks.edge[at];
  return walks.turned[links_.edges[links_.vertices[vertex].firstEdge + at].firstSpoke + nextAccess];
}

/// The fans at the vertices inside a segment.
double FanEstimate::wholeFans(Segment s) const {
  const uint32_t from = s.reversed ? s.end : s.start, to = s.reversed ? s.start : s.end;
  const uint32_t loop = loops_.loopOf(from);
  const double* until = fansUntil_.data();
  const double all = until[loops_.first(loop) + loops_.size(loop)] - until[loops_.first(loop)];
  if (s.whole) return all - fan_[from];
  return from < to ? until[to] - until[from + 1] : all - (until[from + 1] - until[to]);
}

uint32_t FanEstimate::triangleCount(Shape shape) const {
  uint32_t count = 0;
  for (uint32_t i = 0; i < domains_.segmentCount(shape); ++i) {
    const Segment s = domains_.segment(shape, i);
    const uint32_t size = loops_.size(loops_.loopOf(s.start));
    const uint32_t step = s.reversed ? s.start + size - s.end : s.end + size - s.start;
    count += 1 + (s.whole ? size : step % size);
  }
  for (uint32_t c = 0; c < loops_.loopCount(); ++c)
    if (domains_.hasHole(shape, c)) count += loops_.size(c) + 2;
  return count - 2;
}

double FanEstimate::value(Shape shape, uint32_t slot) {
  const CandidateSet& set = links_.set;
  const uint32_t m = domains_.segmentCount(shape);
  const uint32_t access = set.edgeOpposite(set.slotTriangle[slot], set.slotApex[slot]);
  const uint32_t accessIndex = slot - set.edgeSlots[access];
  double cost = -3 * costs_.price * triangleCount(shape);
  for (uint32_t c = 0; c < loops_.loopCount(); ++c)
    if (domains_.hasHole(shape, c))
      cost += fansUntil_[loops_.first(c) + loops_.size(c)] - fansUntil_[loops_.first(c)];
  uint32_t before = access;
  for (uint32_t i = 0; i < m; ++i) {
    const Segment s = domains_.segment(shape, i);
    const bool last = i + 1 == m;
    const uint32_t after =
        last ? access : set.edgeBetween(s.end, domains_.segment(shape, i + 1).start);
    const uint32_t indexBefore = i == 0 ? accessIndex : kNone;
    const uint32_t indexAfter = last ? accessIndex : kNone;
    if (s.isVertex()) {
      cost += fanBetween(s.start, before, after, indexBefore, indexAfter);
    } else {
      // The loop edge inside the domain is that towards the other end of the segment.
      cost += partOfFan(s.start, before, s.reversed, indexBefore) +
              partOfFan(s.end, after, !s.reversed, indexAfter) + wholeFans(s);
    }
    before = after;
  }
  return cost;
}

}  // namespace sf
