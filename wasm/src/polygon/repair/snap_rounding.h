// Snap rounding: the crossings of edges on a grid.
// Source: Hobby 1999; Guibas, Marimont 1998: a cell is hot if it holds an end of an edge or a
// crossing. If every edge is bent, in order, to the centres of all hot cells that it passes, then
// the pieces meet in their ends alone.
// Differs: hot cells are found again from a tree of boxes. If the cell of a crossing is in doubt,
// every cell that may hold it is made hot, which the theorem allows.
#pragma once
#include "polygon/repair/crossing_sweep.h"

namespace sf {

struct HotCell {
  Point2 centre;
  uint32_t cause;  // a point in it, or the number of points + a crossing in it
};

/// A piece of an edge, in the direction from its lower end to its upper one.
struct SnappedPiece {
  uint32_t edge, from, to;  // numbers of hot cells
};

/// Rounds edges to cells of a power of two, half-open squares about its multiples.
///   at, edges, found  input and result of findCrossings, coordinates at most 1
///   cellSize          a power of two from 2^-48 on
///   cells             [c] by place; a point exactly at the centre is the cause of its cell
/// O((e + c) log c) time if edges are short compared with the extent, O(e sqrt c) if all are long,
/// plus the number of cells passed. False once `work` has to end.
bool snapRound(ArrayView<const Point2> at, ArrayView<const WeightedEdge> edges,
               const Crossings& found, double cellSize, Work& work, Charge& charge,
               std::vector<HotCell>& cells, std::vector<SnappedPiece>& pieces);

}  // namespace sf
