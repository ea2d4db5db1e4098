// One polygon over all triples of its vertices, without a list of them.
// Source: Zou, Ju, Carr 2013, sec. 3.1 and 4.1: eq. 2 (Barequet, Dickerson, Eppstein 1996), and
// eq. 1 (Barequet, Sharir 1995) where no weight couples neighbours.
// Differs: bottom-up, O(n^3) time in either case (angular_transform.h). It keeps one number for
// each triangle, its own cost joined with the best of what lies behind it, and not one for each
// domain with its best split. The surface is traced by computing minima again.
#pragma once
#include <cstdint>
#include <vector>

#include "base/work.h"
#include "loops/problem/candidate_set.h"
#include "loops/problem/loop_set.h"
#include "loops/problem/objective.h"

namespace sf {

struct PolygonSurface {
  bool found = false;
  bool optimal = false;             // proven; not if single precision may hide a better one
  std::vector<uint32_t> triangles;  // [3 (n - 2)] in the order of splitting, increasing in each
  double lowerBound = 0;            // of the objective, proven up to the rounding of doubles
};

/// The surface of least cost over one loop; as solveSurface, over all but collinear triples.
/// n^3 / 6 doubles of memory, floats where doubles do not fit, or 2 n^2 doubles if neither a
/// dihedral weight nor the objective looks at angles. False when the work ended; status TooLarge if
/// not even the floats fit.
///   loops    one loop, scaled to unit size
///   weights  without own weights
bool solvePolygon(const LoopSet& loops, const TriangleWeights& weights, Objective objective,
                  Work& work, PolygonSurface& surface);

/// The least bytes that solvePolygon takes. `looksAtAngles`: there is a dihedral weight, or the
/// objective is the worst angle.
double bytesForPolygon(double n, bool looksAtAngles);

}  // namespace sf
