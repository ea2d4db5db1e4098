// Snap rounding: the crossings of edges on a grid.
// Source: Hobby 1999; Guibas, Marimont 1998: if every edge is bent to the centres of all hot cells
// that it passes, in order, those being the cells that hold an end of an edge or a crossing, then
// the pieces meet in their ends alone.
// Differs: hot cells are found again from a tree of boxes; a crossing whose cell is in doubt makes
// every cell hot that it may be in, which the theorem allows.
#pragma once
#include "polygon/repair/crossing_sweep.h"

namespace sf {

struct HotCell {
  Point2 centre;
  uint32_t cause;  // a point in it, or how many points there are + a crossing in it
};

/// A piece of an edge, in the direction from its lower end to its upper one.
struct SnappedPiece {
  uint32_t edge, from, to;  // numbers of hot cells
};

/// Rounds edges to cells of a power of two, half-open squares about its multiples.
///   at, edges, found  input and result of findCrossings, coordinates at most 1
///   cellSize          a power of two from 2^-48 on
///   cells             [c] by place; a point at the very centre is the cause of its cell
/// O((e + c) log c) time for edges that are short against all, O(e sqrt c) if all are long, and for
/// each cell passed. False once `work` has to end.
bool snapRound(ArrayView<const Point2> at, ArrayView<const WeightedEdge> edges,
               const Crossings& found, double cellSize, Work& work, Charge& charge,
               std::vector<HotCell>& cells, std::vector<SnappedPiece>& pieces);

}  // namespace sf
