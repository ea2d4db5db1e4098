// A problem in the solver's form, and the way back from its numbering to the caller's.
#pragma once
#include <cstdint>
#include <vector>

#include "loops/problem/loop_triangles.h"
#include "loops/problem/scaled_weights.h"
#include "loops/spaces/edge_protection.h"

namespace sf {

/// Loops at unit size, perhaps with inserted vertices, numbered loop by loop. The result has
/// another numbering: the caller's vertices first, in the caller's order, then the inserted ones.
struct PosedProblem {
  LoopSet loops;
  std::vector<uint32_t> resultIndex;     // [n'] number in the result
  std::vector<double> normals;           // [3n'] of faces across the loops' edges, or empty
  std::vector<InsertedVertex> inserted;  // [n' - n]
  std::vector<Vec3> insertedPositions;   // [n' - n] in the caller's units

  /// Those triangles of an earlier result whose vertices all exist here,
  /// in the numbers of these loops.
  ///   triangles  [3m] in the result's numbers
  LoopTriangles fromResult(ArrayView<const uint32_t> triangles) const;
  /// Turns a surface over these loops into one over the caller's: each inserted vertex becomes the
  /// nearer end of its edge, and triangles left without area are dropped.
  ///   triangles  [3m] in the result's numbers
  ///   input      the caller's loops, at any size
  LoopTriangles ontoInput(ArrayView<const uint32_t> triangles, const LoopSet& input) const;
};

/// The caller's loops as they are.
///   normals  [3n] or empty
PosedProblem posedAsGiven(const LoopSet& unit, ArrayView<const double> normals);

/// The caller's loops after edge protection. A face across an edge is across all parts of the edge.
PosedProblem posedProtected(const LoopSet& unit, ArrayView<const double> normals,
                            const ScaledWeights& weights, ProtectedLoops protectedLoops);

}  // namespace sf
