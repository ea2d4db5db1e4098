// Valid polygons from any rings: the points of odd, or of non-zero, winding number.
//
// Source: Bentley, Ottmann 1979 for the crossings; Hobby 1999, "Practical segment intersection with
// finite precision output", and Guibas, Marimont 1998, "Rounding arrangements dynamically", for
// snap rounding.
// Differs: crossings are rounded to the nearest doubles, and the edges through them are bent. The
// result is checked again, exactly, until nothing crosses any more, which takes two or three
// rounds; no input point moves. Bends of nearly parallel edges may go on making crossings. Then
// everything is rounded to a grid of 2^-48 of the extent, and edges are bent to every cell that
// they pass and that holds a point: that makes no crossings.
#pragma once
#include <cstdint>
#include <vector>

#include "base/status.h"
#include "base/work.h"
#include "polygon/input/options.h"
#include "polygon/input/polygon.h"

namespace sf {

/// Polygons whose insides are disjoint. Rings are simple, and meet in points alone, which are
/// vertices of both; the inside of each polygon is connected.
struct RepairedPolygons {
  std::vector<uint32_t> vertices;       // [m] of the rings: vertices of the input, or n + i for
                                        // added point i; equal input points by the first one
  std::vector<uint32_t> ringStarts;     // [r+1] in `vertices`
  std::vector<uint32_t> polygonStarts;  // [p+1] in rings: an outer ring, counter-clockwise, and its
                                        // holes, clockwise
  std::vector<double> added;            // [2a] x y
  std::vector<uint32_t> addedOn;  // [2a] two edges that each is on, by their first vertices, the
                                  // smaller first
};

/// When to give up rounding to doubles, and which grid to use then. For tests;
/// the defaults fit all input.
struct RepairLimits {
  uint32_t rounds = 6;
  int32_t gridBits = 48;  // cells are 2^-gridBits of a power of 2 above all coordinates; 1 to 48
};

/// The points whose winding number is odd (Repair::EvenOdd) or not 0 (Repair::NonZero), once the
/// first ring has been turned counter-clockwise and the others clockwise; rings without signed area
/// are not turned. Valid polygons come back unchanged, except for equal and touching points. No
/// rings are left if no point qualifies. Coordinates below 2^-200 of the largest of their axis
/// count as 0.
///   polygon  any finite coordinates up to 1e150; isolated points are ignored
/// Errors: BadStarts, NotFinite, TooLarge, OutOfMemory, Stopped. O((n + k) log (n + k)) time and
/// O(n + k) memory for k crossings, charged to `work`.
Outcome repairPolygon(const PolygonView& polygon, Repair rule, Work& work, RepairedPolygons& result,
                      RepairLimits limits = {});

}  // namespace sf
