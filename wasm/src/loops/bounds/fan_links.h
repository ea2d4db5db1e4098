// The link of each vertex: the candidate triangles around it, edge by edge. The triangles that a
// surface has at a vertex form a walk in its link, the *fan*, from one loop edge to the other.
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

  /// O(c) for c candidates. The set has to outlive it.
  FanLinks(const LoopSet& loops, const CandidateSet& set);

  /// Where an edge of the set stands among the edges of v, one of its ends.
  uint32_t edgeAt(uint32_t edge, uint32_t v) const {
    return edgeAt_[2 * size_t(edge) + (set.edgeVertices[2 * size_t(edge)] == v ? 0 : 1)];
  }
  /// For each spoke s of the vertex: out[s] = the least cost of arriving at a spoke of the same
  /// edge and turning over the edge into s. A turn back into the same triangle costs a fold;
  /// allowing it only loosens the bound. Infinity at loop edges, where fans end.
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
