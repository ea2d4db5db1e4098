// Where the edges of rims look, and what share of each rim looks at which other.
//
// Source: the cost is that of a fair surface's boundary conditions: Liepa 2003, "Filling holes in meshes",
// sec. 3, weighs area and dihedral angles; here length and all turning between two rim edges.
// Differs: costs multiply, so that scale does not matter.
#pragma once
#include <vector>

#include "mesh/group.h"

namespace sf {

/// Fills `openness` and `votes` of the result; no votes are joined yet.
bool castVotes(const MeshView& mesh, const Rims& rims, Work& work, Charge& charge,
               Grouping& result);

}  // namespace sf
