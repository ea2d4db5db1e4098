#include "loops/bounds/fan_links.h"

#include <algorithm>

namespace sf {

FanLinks::FanLinks(const LoopSet& loops, const CandidateSet& candidates) : set(candidates) {
  const uint32_t n = loops.vertexCount();
  // Edges at each vertex, at both of their ends.
  std::vector<uint32_t> first(n + 1, 0);
  for (const uint32_t v : set.edgeVertices) ++first[v + 1];
  for (uint32_t v = 0; v < n; ++v) first[v + 1] += first[v];
  std::vector<uint32_t> incident(set.edgeVertices.size()), cursor(first.begin(), first.end() - 1);
  edgeAt_.resize(set.edgeVertices.size());
  for (size_t end = 0; end < set.edgeVertices.size(); ++end) {
    const uint32_t v = set.edgeVertices[end];
    edgeAt_[end] = cursor[v] - first[v];
    incident[cursor[v]++] = uint32_t(end / 2);
  }

  std::vector<uint32_t> spokeOfSlot(set.slotTriangle.size());
  spokes.reserve(2 * set.slotTriangle.size());
  theta.reserve(2 * set.slotTriangle.size());
  for (uint32_t v = 0; v < n; ++v) {
    Vertex vertex{};
    vertex.firstSpoke = spokes.size();
    vertex.firstEdge = uint32_t(edges.size());
    vertex.edgeCount = first[v + 1] - first[v];
    vertex.startEdge = vertex.endEdge = kNone;
    for (uint32_t i = first[v]; i < first[v + 1]; ++i) {
      const uint32_t e = incident[i];
      if (e == set.loopEdges[loops.previous(v)]) vertex.startEdge = i - first[v];
      if (e == set.loopEdges[v]) vertex.endEdge = i - first[v];
      edges.push_back({e, vertex.spokeCount, set.degree(e), set.isLoopEdge[e] != 0});
      for (uint32_t s = set.edgeSlots[e]; s < set.edgeSlots[e + 1]; ++s) {
        spokeOfSlot[s] = vertex.spokeCount++;
        const uint32_t t = set.slotTriangle[s];
        spokes.push_back({3 * t + set.corner(t, v), 0});
        theta.push_back(set.slotTheta[s]);
      }
    }
    for (uint32_t i = first[v]; i < first[v + 1]; ++i) {
      const uint32_t e = incident[i];
      const uint32_t u = set.edgeVertices[2 * size_t(e)] == v ? set.edgeVertices[2 * size_t(e) + 1]
                                                              : set.edgeVertices[2 * size_t(e)];
      for (uint32_t s = set.edgeSlots[e]; s < set.edgeSlots[e + 1]; ++s)
        spokes[vertex.firstSpoke + spokeOfSlot[s]].partner =
            spokeOfSlot[set.slotOpposite(set.slotTriangle[s], u)];
    }
    // A fan passes each edge at most once.
    vertex.longest = vertex.edgeCount ? vertex.edgeCount - 1 : 0;
    vertices.push_back(vertex);
  }
}

void FanLinks::leave(const Vertex& v, const double* arrive, AngularTransform& transform,
                     double* out) const {
  for (uint32_t i = 0; i < v.edgeCount; ++i) {
    const Edge& edge = edges[v.firstEdge + i];
    const uint32_t first = edge.firstSpoke, count = edge.spokeCount;
    if (edge.onLoop || std::all_of(arrive + first, arrive + first + count,
                                   [](double w) { return w == kInfinity; })) {
      std::fill(out + first, out + first + count, kInfinity);
      continue;
    }
    const double* at = &theta[v.firstSpoke + first];
    transform.apply(at, arrive + first, count, at, count, out + first);
  }
}

}  // namespace sf
