// Spanning: closed loops in, the optimal manifold triangulation out. The one entry to src/loops.
// Source: Zou, Ju, Carr 2013, "An algorithm for triangulating multiple 3D polygons".
#pragma once
#include <cstdint>

#include "base/status.h"
#include "base/work.h"
#include "loops/answer/span_answer.h"
#include "loops/problem/loop_set.h"
#include "loops/problem/objective.h"

namespace sf {

struct SpanOptions {
  double areaWeight = 0;       // per square unit; NaN: 1e-3 / (bounding-box diagonal)^2
  double perimeterWeight = 0;  // per unit of triangle perimeter
  double dihedralWeight = 1;   // per radian
  Objective objective = Objective::Sum;
  Space space = Space::Auto;
  ArrayView<const double> boundaryNormals;  // [3n] or empty; NaN triple: no face across that edge
  ArrayView<const uint32_t> triangles;      // [3c] for Space::Given
  ArrayView<const double> triangleWeights;  // [c] added to each candidate's weight, or empty
  /// Several loops: [3m] triangles of an earlier answer to begin from, with vertex numbers as in
  /// Span::positions. Triangles that no longer fit do no harm.
  ArrayView<const uint32_t> start;
  /// Whether work that ends before the optimum is known returns the best surface found. The solver
  /// then looks for surfaces first, which takes some time.
  bool bestSoFar = false;
  /// With bestSoFar: called with every surface that is better than the one before. May be null.
  void (*onBest)(void* user, const Span& best) = nullptr;
  void* user = nullptr;
};

/// Spans the loops with the surface of least cost among all edge- and vertex-manifold, connected,
/// orientable surfaces of sphere-with-k-holes topology made of candidate triangles.
/// `result.found` is false, with status Ok, if the space holds no such surface.
/// With `bestSoFar`, Stopped and OutOfMemory come back only if no surface was found at all. Otherwise
/// the status is Ok, and the surface is the best one so far, with `optimal` false.
/// Checks its input: SF_STATUSES (soapfilm_tables.h) says what can come back; NotFound never does.
Outcome spanLoops(const LoopSet& loops, const SpanOptions& options, Work& work, Span& result);

}  // namespace sf
