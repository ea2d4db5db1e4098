// The candidate triangles T of a span, with their weights and their incidence to edges.
// Source: Zou, Ju, Carr 2013, sec. 3.1 (T), 4.1 (all triples), 4.2 (a reduced set).
// Differs: exactly collinear triples have no normal and are never candidates. The `near` space
// answers the question of sec. 6 for a space between the Delaunay facets and all triples.
#pragma once
#include <cstdint>
#include <vector>

#include "base/work.h"
#include "loops/problem/loop_set.h"

namespace sf {

/// Factors of the single-triangle weights, and the faces given across loop edges.
struct TriangleWeights {
  double area = 0;
  double perimeter = 0;
  double dihedral = 0;              // of the angle to a face given across a loop edge
  ArrayView<const double> normals;  // [3n] of those faces, or empty; NaN triple: none
  ArrayView<const double> own;      // [c] added to each triangle's weight, or empty
};

/// c triangles over the vertices of a LoopSet, and the e edges they have, as flat arrays.
/// The incidences of an edge are consecutive: a *slot* names one triangle at one of its edges.
struct CandidateSet {
  std::vector<uint32_t> triangles;      // [3c] vertices, increasing within a triangle
  std::vector<double> weight;           // [c] w(t): all terms that do not depend on a neighbour
  std::vector<double> boundaryAngle;    // [c] largest angle to a given face, or empty if none
  std::vector<uint32_t> triangleEdges;  // [3c] edge opposite to each vertex
  std::vector<uint32_t> triangleSlots;  // [3c] slot at the edge opposite to each vertex
  std::vector<uint32_t> edgeVertices;   // [2e] increasing within an edge
  std::vector<uint32_t> firstEdge;      // [n+1] edges whose lower-numbered end is vertex v
  std::vector<uint32_t> edgeSlots;      // [e+1] slots of edge i: edgeSlots[i] .. edgeSlots[i+1]
  std::vector<uint32_t> slotTriangle;   // [3c]
  std::vector<uint32_t> slotApex;       // [3c] vertex of that triangle that is not on the edge
  std::vector<double> slotTheta;        // [3c] angle of the triangle around the edge, [-pi, pi]
  std::vector<uint32_t> loopEdges;      // [n] edge from vertex v to the next, kNone if not in T
  std::vector<uint8_t> isLoopEdge;      // [e]

  size_t size() const { return triangles.size() / 3; }
  size_t edgeCount() const { return edgeSlots.size() - 1; }
  uint32_t degree(uint32_t edge) const { return edgeSlots[edge + 1] - edgeSlots[edge]; }
  /// The edge from u to v, or kNone. O(log of the edges at the lower-numbered end).
  uint32_t edgeBetween(uint32_t u, uint32_t v) const;
  /// Which of the three vertices of triangle t is v; v must be one of them.
  uint32_t corner(uint32_t t, uint32_t v) const {
    const uint32_t* p = &triangles[3 * size_t(t)];
    return p[0] == v ? 0 : p[1] == v ? 1 : 2;
  }
  uint32_t edgeOpposite(uint32_t t, uint32_t v) const {
    return triangleEdges[3 * size_t(t) + corner(t, v)];
  }
  uint32_t slotOpposite(uint32_t t, uint32_t v) const {
    return triangleSlots[3 * size_t(t) + corner(t, v)];
  }
  /// The slot of triangle t at an edge, which must be one of its three.
  uint32_t slotAt(uint32_t t, uint32_t edge) const {
    const uint32_t* e = &triangleEdges[3 * size_t(t)];
    return triangleSlots[3 * size_t(t) + (e[0] == edge ? 0 : e[1] == edge ? 1 : 2)];
  }
  /// Bytes that a set of c triangles takes, building included.
  static double bytesFor(double c) { return 148 * c; }
};

/// The angle between the triangle a, b, apex and the face given across the loop edge of a and b,
/// both seen in the loop's direction; false if that is no loop edge or has no face.
bool faceAngle(const LoopSet& loops, ArrayView<const double> normals, uint32_t a, uint32_t b,
               uint32_t apex, double& angle);

/// Triples of a space: [3c], three increasing vertices each, no triple twice, none collinear. Here
/// all of them: n (n-1) (n-2) / 6 at most.
bool allTriples(const LoopSet& loops, Work& work, std::vector<uint32_t>& triples);
/// The most triples that nearTriples makes besides the facets, before repeated ones are dropped.
double predictedNearTriples(const LoopSet& loops, uint32_t reach);
/// The facets, every triple of a vertex and two of its `reach` nearest neighbours along Delaunay
/// edges, and each loop edge with the neighbours of its ends.
///   facets  [3f] of the Delaunay tetrahedralization of the loop vertices
bool nearTriples(const LoopSet& loops, ArrayView<const uint32_t> facets, uint32_t reach, Work& work,
                 std::vector<uint32_t>& triples);
/// The facets without the collinear ones. The vertices of a facet may be in any order.
bool facetTriples(const LoopSet& loops, ArrayView<const uint32_t> facets, Work& work,
                  std::vector<uint32_t>& triples);
/// A caller's list. BadCandidates, with its index as `vertex`, for the first triangle that is out
/// of range, collinear, or a repetition.
///   order  [c] the caller's index of each triple
Outcome givenTriples(const LoopSet& loops, ArrayView<const uint32_t> triangles, Work& work,
                     std::vector<uint32_t>& triples, std::vector<uint32_t>& order);

/// Weights, edges and incidence of the triples, which move into the set. False when `work` ended.
/// O(c log c) time. Charges CandidateSet::bytesFor(c), which the owner of the set releases.
bool buildCandidateSet(const LoopSet& loops, const TriangleWeights& weights,
                       std::vector<uint32_t> triples, Work& work, CandidateSet& set);

/// The triangles `kept` of a set, in that order, with their weights. Charges and time as for
/// buildCandidateSet.
bool buildSubset(const LoopSet& loops, const CandidateSet& set, ArrayView<const uint32_t> kept,
                 Work& work, CandidateSet& subset);

}  // namespace sf
