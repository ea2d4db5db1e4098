// The links of the vertices: which candidate triangles stand around a vertex, edge by edge. The
// triangles that a surface has at a vertex are a walk there, its *fan*, from the one loop edge to the
// other.
#pragma once
#include <cstdint>
#include <vector>

#include "loops/one_loop/angular_transform.h"
#include "loops/problem/candidate_set.h"

namespace sf {

struct FanLinks {
  /// A triangle at one of the two edges that it has at a vertex. A walk *arrives* at it from the
  /// triangle's other edge, or *leaves* into the triangle.
  struct Spoke {
    uint32_t corner;   // 3 t + which of t's vertices this is
    uint32_t partner;  // the spoke of the same triangle at its other edge here
  };
  struct Edge {
    uint32_t number;                  // in the candidate set
    uint32_t firstSpoke, spokeCount;  // within the vertex; spokes stand in the order of slots
    bool onLoop;
  };
  struct Vertex {
    size_t firstSpoke;
    uint32_t spokeCount;
    uint32_t firstEdge, edgeCount;
    uint32_t startEdge, endEdge;  // within the vertex; kNone: no candidate at that loop edge
    uint32_t longest;             // most triangles that a fan can have here
  };

  /// O(c) for c candidates; the set is kept.
  FanLinks(const LoopSet& loops, const CandidateSet& set);

  /// Where an edge of the set stands among those of v, one of its ends.
  uint32_t edgeAt(uint32_t edge, uint32_t v) const {
    return edgeAt_[2 * size_t(edge) + (set.edgeVertices[2 * size_t(edge)] == v ? 0 : 1)];
  }
  /// out[s] = the least over the edge's spokes of arriving there and turning over into s, for all
  /// spokes of the vertex. Turning back into the same triangle costs a fold, which only loosens what is
  /// a bound. Infinity at loop edges, where fans end.
  void leave(const Vertex& v, const double* arrive, AngularTransform& transform, double* out) const;

  const CandidateSet& set;
  std::vector<Spoke> spokes;  // of all vertices, one after the other
  std::vector<double> theta;  // of the spokes
  std::vector<Edge> edges;
  std::vector<Vertex> vertices;

 private:
  std::vector<uint32_t> edgeAt_;  // [2e]
};

}  // namespace sf
