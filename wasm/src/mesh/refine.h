// Refinement: a patch gets vertices of its own, as dense as those of the surface around it.
// Source: Liepa 2003, "Filling holes in meshes", sec. 4; Pfeifle, Seidel 1996, "Triangular B-splines for blending
// and filling of polygonal holes", from where the criterion comes.
// Differs: edges are flipped by angles and not by circumspheres; never to an edge that there is already, nor so that
// a triangle turns over. How many vertices come is predicted, and the density lowered where that is too many.
// Vertices settle between their neighbours at the end. A patch that has vertices of its own is refined further.
#pragma once
#include <cstdint>

#include "base/status.h"
#include "base/work.h"
#include "mesh/local_surface.h"

namespace sf {

struct RefineOptions {
  double density = 1.4142135623730951;  // Liepa's alpha; 0: no new vertices
  uint32_t maxNewVertices = 0xFFFFFFFFu;
  uint32_t settlings = 4;  // how often the vertices settle
};

/// Adds vertices and triangles to the patch of a surface, and flips its inner edges. Edges of the rim and the
/// surroundings stay. At most `maxNewVertices` vertices are added, and two triangles with each of them.
/// O(n log n) time for n vertices in the result. Errors: OutOfMemory, Stopped; the surface is then as it was.
Status refine(LocalSurface& surface, const RefineOptions& options, Work& work);

/// Flips inner edges of the patch until they are Delaunay, and lets its vertices settle: after fairing.
Status relax(LocalSurface& surface, uint32_t settlings, Work& work);

}  // namespace sf
