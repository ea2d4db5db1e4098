// Rims that touch themselves: slits are closed by triangles without area, and what is open between them is left.
#pragma once
#include "mesh/find.h"
#include "mesh/hole_part.h"

namespace sf {

/// Cuts a rim wherever two of its vertices are at exactly the same place. `triangles` join the two, so that
/// the edges of the mesh stay as they are; `parts` are what remains open, and none of a slit that has no area.
/// A rim whose vertices are all at different places gives nothing at all. O(n log n) time.
HoleParts stitchRim(const MeshView& mesh, const Rims& rims, uint32_t rim);

}  // namespace sf
