// Values at the vertices of patches, carried on from their rims: harmonic, with the same weight for every edge.
// Source: Tutte 1963, "How to draw a graph", for each vertex as the mean of its neighbours.
#pragma once
#include <cstdint>
#include <vector>

#include "base/array_view.h"
#include "base/work.h"
#include "mesh/mesh.h"

namespace sf {

/// Finds values at the free vertices of a mesh, such that each is the mean of those at its neighbours. A neighbour
/// counts once for each face that both are in. Each part of the free vertices, connected by faces, is a system of its
/// own: its values depend on nothing else, to the last bit. Time as for SparseCholesky::factor.
///   mesh         vertices that are fixed first, then the free ones; any faces
///   fixedCount   at most all vertices
///   size         how many values each vertex has, at least one
///   fixedValues  [size * fixedCount]
///   freeValues   out: [size * number of free vertices], 0 in parts without a fixed neighbour, or with so few that
///                rounding hides them. Charged until the end of the call alone
/// False when the work ended.
bool carryOn(const MeshView& mesh, uint32_t fixedCount, uint32_t size,
             ArrayView<const double> fixedValues, Work& work, std::vector<double>& freeValues);

}  // namespace sf
