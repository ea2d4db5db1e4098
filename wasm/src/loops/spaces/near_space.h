// The `near` space: triangles of surfaces that a cheap approximation finds near the optimum.
// Source: the question of Zou, Ju, Carr 2013, sec. 6, for a space between the Delaunay facets and
// all triples.
// Differs: near vertices turned out to be a poor guide. On noisy loops the optimum over triples of
// nearest neighbours costs 1.2 times the one over all triples, since noise is flattened best by
// long triangles in the right directions. So the triples are taken from a truncated solution over
// all of them (polygon_chart.h). One loop is a polygon already. Two loops become one polygon by a
// bridge: along one loop, across, along the other in either direction, and back. Many bridges are
// tried in turn. If angles do not count, necks between two discs are tried too (neck_search.h). The
// Delaunay facets are candidates as well, so that near never costs more than the facets of the
// loops' own vertices do.
#pragma once
#include <cstdint>
#include <vector>

#include "base/work.h"
#include "loops/problem/candidate_set.h"
#include "loops/problem/loop_triangles.h"

namespace sf {

/// Whether nearOptimalTriples applies: to one loop of up to some thousand vertices, or to two loops
/// of about a hundred together at most, if they fit into memory.
bool hasNearOptimalTriples(const LoopSet& loops, const Work& work);

/// The polygon that two loops become when cut along a bridge, and its solution.
struct BridgeTrial {
  uint32_t a, b;  // the bridge's ends on the first loop and the second
  bool forward;   // the second loop is passed forward
  bool isValid;   // the polygon's surface is also one over the loops
  double cost;    // infinity: the polygon has no surface
  std::vector<uint32_t> triples;
};

/// Appends triples of surfaces near the best one found: at most six for each vertex of one loop,
/// and four for each vertex and bridge of two. They are in any order, perhaps collinear or
/// repeated, as facetTriples takes them. False when the work ended.
///   weights  without own weights
///   surface  over the loops to span, which come with it. Two loops: wound alike; the bridges tried
///            are some of its edges, or short ones if it is empty. One loop, or no angles: its
///            triangles are not read.
///   trials   of earlier calls for the same loops and weights, which are not made again; new ones
///            are added
/// O(n^2) segments of a polygon, each about a third of a microsecond; up to 32 such polygons for
/// two loops.
bool nearOptimalTriples(const LoopTriangles& surface, const TriangleWeights& weights, Work& work,
                        std::vector<BridgeTrial>& trials, std::vector<uint32_t>& triples);

}  // namespace sf
