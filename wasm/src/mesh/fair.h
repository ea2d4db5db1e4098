// Fairing: the patch takes the shape that goes on the surface around it most smoothly.
// Source: Zou, Ju, Carr 2013, sec. 5, and Liepa 2003, "Filling holes in meshes", sec. 5, for its place; Kobbelt,
// Campagna, Vorsatz, Seidel 1998, "Interactive multi-resolution modeling on arbitrary meshes", and Botsch, Kobbelt
// 2004, "An intuitive framework for real-time freeform modeling", for (L M^-1)^(k-1) L x = 0.
// Differs: cotangents over the intrinsic Delaunay triangulation, taken anew from the faired surface, which makes
// the large patches round; k = 3, so that curvature goes on too. The Laplacian of a vertex on the boundary of the
// surroundings is not known, and left out, by which the system stays symmetric and positive. A patch without
// surroundings may be clamped instead: at its boundary the way on is then given by normals, as for a clamped plate in
// Ciarlet, Raviart 1974, "A mixed finite element method for the biharmonic equation".
#pragma once
#include <cstdint>

#include "base/status.h"
#include "base/work.h"
#include "mesh/local_surface.h"

namespace sf {

struct FairOptions {
  uint32_t order = 3;           // k: 1 least area, 2 least bending, 3 least variation of curvature
  uint32_t rounds = 3;          // how often weights are taken from the surface that came out
  uint32_t bendingSteps = 0;    // k = 2: steps to the least squared mean curvature, at most
  uint32_t curvatureSteps = 4;  // k = 3: steps to the least variation of mean curvature, at most

  /// How many steps there are after the solutions of order k.
  uint32_t stepsOf(uint32_t k) const { return k == 2 ? bendingSteps : k == 3 ? curvatureSteps : 0; }
};

struct Fairness {
  uint32_t order =
      0;  // k of the result: less than asked for where that had no solution; 0 if nothing was done
  double moved = 0;  // the largest distance that a vertex moved
};

/// Moves the vertices from `fixedVertices` on. Surroundings of k rings determine the result, and so do clamps.
/// Positions stay finite, whatever the triangles. O(n^1.5) time for n vertices.
/// Errors: OutOfMemory, Stopped; the surface is then as it was.
Status fair(LocalSurface& surface, const FairOptions& options, Work& work, Fairness& result);

/// From this roughness on, k = 2 comes closer to what was there than k = 3.
constexpr double kRough = 1.2;

/// How rough the surroundings are: by how much the mean curvature differs from vertex to vertex, as an angle in
/// radians. Near 0 for smooth surfaces, however curved. 0 without surroundings. O(n) time. False when the work ended.
bool roughness(const LocalSurface& surface, Work& work, double& result);

/// Whether the patch and the triangles along its rim lie in one plane, but for rounding: it is then exact, and nothing should bend it. Up to three quarters of the rim may be a crease instead, where the
/// surface turns by more than `crease` radians (0: none).
bool isFlat(const LocalSurface& surface, double crease = 0.7);

}  // namespace sf
