// The `near` space: triangles of surfaces that are near the optimum, as far as a cheap look tells.
// Source: the question of Zou, Ju, Carr 2013, sec. 6, for a space between the Delaunay facets and all
// triples.
// Differs: nearness of vertices turned out to be a poor guide. On noisy loops the optimum over triples
// of nearest neighbours costs 1.2 times the one over all triples, since noise is flattened best by
// long triangles in the right directions. So the triples are taken from a truncated solution
// over all of them (polygon_chart.h): one loop is a polygon already, two are joined to one by a
// bridge, walked along one loop, across, along the other in either direction and back, for many
// bridges in turn; without angles in the cost, necks between two discs are tried too
// (neck_search.h). The Delaunay facets are candidates as well, so that near never costs more than
// the facets of the loops' own vertices do.
#pragma once
#include <cstdint>
#include <vector>

#include "base/work.h"
#include "loops/problem/candidate_set.h"
#include "loops/problem/loop_triangles.h"

namespace sf {

/// Whether nearOptimalTriples applies: one loop of thousands of vertices, or two of a hundred together,
/// that fit into memory.
bool hasNearOptimalTriples(const LoopSet& loops, const Work& work);

/// What the polygon gave that two loops cut along a bridge are.
struct BridgeTrial {
  uint32_t a, b;  // the bridge's ends on the first loop and the second
  bool forward;   // the second loop is passed forward
  bool isValid;   // the polygon's surface is one of the loops
  double cost;    // infinity: it has none
  std::vector<uint32_t> triples;
};

/// Appends triples of surfaces near the best one found: at most six for each vertex of one loop,
/// and four for each vertex and bridge of two. In any order, perhaps collinear or repeated, as facetTriples
/// takes them. False when the work ended.
///   weights  without own weights
///   surface  of the loops, which are those to span; of two loops, wound alike: the bridges tried are some of
///            its edges. Empty: none is known, the bridges are short. Not read for one loop or without angles.
///   trials   of earlier calls for the same loops and weights, which are not made again; new ones are added
/// O(n^2) segments of a polygon, each about a third of a microsecond; up to 32 such polygons for two
/// loops.
bool nearOptimalTriples(const LoopTriangles& surface, const TriangleWeights& weights, Work& work,
                        std::vector<BridgeTrial>& trials, std::vector<uint32_t>& triples);

}  // namespace sf
