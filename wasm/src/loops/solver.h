// The least-cost surface in a candidate set: which passes, and which algorithm for which input.
// Source: Zou, Ju, Carr 2013, sec. 3.
//
// Which path solves what:
//
//   candidates are ...                            solved by
//   all triples of one loop                       solvePolygon (one_loop/polygon_solver), not from here
//   any others                                    solveSurface, which is this file:
//     one loop                                    its table of segments (one_loop/segment_table)
//     several loops, least sum
//       two loops, many edges between them        all domains (domains/exact_solver), bounded by
//                                                 bounds/two_loop_bound
//       two loops; three or four, few candidates  the same up to a number of splits: two loops by
//                                                 bounds/two_loop_bound, others by bounds/relaxed_bound;
//                                                 then as more loops
//       more loops, or many candidates            in rounds: fans bound the cost (bounds/fan_bound), cuts
//                                                 find surfaces (search/surface_search), and the domains
//                                                 that both leave are solved (bounds/focused_bound)
//     several loops, least largest angle          first that angle, then the sum below it:
//       few candidates, or two loops              all domains for the angle
//       else                                      cuts find surfaces, fans drop triangles that only worse
//                                                 ones have (bounds/fan_filter), domains solve the rest
//
// Spaces of candidates are span.cpp's choice: Delaunay facets (spaces/edge_protection), near triples
// (spaces/near_space, spaces/first_surface), all triples.
#pragma once
#include <cstdint>

#include "loops/domains/exact_solver.h"
#include "loops/problem/candidate_set.h"
#include "loops/problem/objective.h"
#include "loops/search/surface_search.h"

namespace sf {

struct Surface {
  bool found = false;
  SplitOrder order;       // its triangles, each but the first beside an earlier one
  bool optimal = true;    // proven
  double lowerBound = 0;  // of the objective, proven
  uint64_t domains = 0, minimalSets = 0;
};

struct SolveOptions {
  double dihedralWeight = 1;
  Objective objective = Objective::Sum;
  /// Whether surfaces on the way are of use: then they are looked for before the optimum is.
  bool anytime = false;
  /// A surface over the same loops to begin from, which need not be one any more; or null.
  const LoopTriangles* start = nullptr;
  /// Splits of domains to try first before bounding several loops by their fans, kUnlimited for never,
  /// 0 for what is usual. What it is changes the time, not the result.
  uint64_t firstSplits = 0;
  /// Is told of every surface that is better in the objective than the one before, or null.
  SurfaceListener* listener = nullptr;
};

/// The surface of least weighted sum, or of least largest angle and then of least sum, where angles
/// within kAngleTie of the least possible one count as tied with it. False when the work ended: then
/// `surface` is the best one so far, if any was found, not optimal, and with the bound proven.
bool solveSurface(const LoopSet& loops, const CandidateSet& set, const SolveOptions& options,
                  Work& work, Surface& surface);

/// About how many nanoseconds solving over all triples takes in native code; infinity beyond
/// double's range.
double predictedTimeOfAllTriples(const LoopSet& loops);

}  // namespace sf
