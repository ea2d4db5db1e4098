// The least-cost surface in a candidate set: chooses the passes, and the algorithm for each input.
// Source: Zou, Ju, Carr 2013, sec. 3.
//
// Which path solves what:
//
//   candidates are ...                            solved by
//   all triples of one loop                       solvePolygon (one_loop/polygon_solver), not from here
//   any others                                    solveSurface, declared here:
//     one loop                                    its table of segments (one_loop/segment_table)
//     several loops, least sum
//       two loops, many edges between them        all domains (domains/exact_solver), bounded by
//                                                 bounds/two_loop_bound
//       two loops; three or four, few candidates  first all domains, up to a number of splits: two loops
//                                                 bounded by bounds/two_loop_bound, others by
//                                                 bounds/relaxed_bound; after that as more loops
//       more loops, or many candidates            in rounds: fans bound the cost (bounds/fan_bound), cuts
//                                                 find surfaces (search/surface_search), and the domains
//                                                 that still matter are solved (bounds/focused_bound)
//     several loops, least largest angle          first for that angle, then for the sum within it:
//       few candidates, or two loops              all domains for the angle
//       else                                      cuts find surfaces, fans drop triangles that only worse
//                                                 surfaces have (bounds/fan_filter), domains solve the rest
//
// span.cpp chooses the space of candidates: Delaunay facets (spaces/edge_protection), near triples
// (spaces/near_space, spaces/first_surface), or all triples.
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
  /// Whether surfaces are of use before the optimum is known: then the solver looks for them first.
  bool anytime = false;
  /// Triangles over the same loops to begin from, or null. They need not form a surface any more.
  const LoopTriangles* start = nullptr;
  /// How many splits of domains to try before several loops are bounded by their fans. kUnlimited: fans
  /// are never used. 0: the usual number. This changes the time, not the result.
  uint64_t firstSplits = 0;
  /// Gets every surface that is better in the objective than the one before. May be null.
  SurfaceListener* listener = nullptr;
};

/// The surface of least weighted sum, or of least largest angle and then of least sum, where angles
/// within kAngleTie of the least possible one count as tied with it. False if the work ended: then
/// `surface` is the best one so far, if any was found, with `optimal` false and the bound proven so far.
bool solveSurface(const LoopSet& loops, const CandidateSet& set, const SolveOptions& options,
                  Work& work, Surface& surface);

/// About how many nanoseconds it takes in native code to solve over all triples; infinity if that is
/// beyond double's range.
double predictedTimeOfAllTriples(const LoopSet& loops);

}  // namespace sf
