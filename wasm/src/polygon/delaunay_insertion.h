// Constrained Delaunay triangles of a polygon, by insertion of its vertices in random rounds.
//
// Flips of an existing triangulation need O(n) each vertex where long thin triangles lie side by
// side, as across the inside of a smooth curve; insertion needs a few whatever the polygon.
//
// Source: Guibas, Knuth, Sharir 1992; Amenta, Choi, Rote 2003, for the order.
#pragma once
#include <cstdint>
#include <vector>

#include "base/work.h"
#include "polygon/polygon.h"

namespace sf {

/// Sets `triangles` to nodes, [3m], counter-clockwise. False, and `triangles` as before, if nodes
/// coincide, as where rings touch, or when the work ended. O(n log n) expected time for all but
/// unnatural polygons; 250 bytes a node while it works.
bool delaunayByInsertion(const LinkedPolygon& linked, Work& work, std::vector<uint32_t>& triangles);

}  // namespace sf
