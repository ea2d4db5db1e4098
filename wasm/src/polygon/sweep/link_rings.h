// Turns rings into loops of nodes. Checks and scales the numbers, turns rings the right way round,
// sets repeated vertices aside, and finds every node's kind from its two edges alone.
// Source: Ronfard, Rossignac 1994, sec. 3.
#pragma once
#include "base/status.h"
#include "polygon/input/polygon.h"

namespace sf {

/// Links the rings, one node for each vertex; touches are left as they are. Kinds: every local
/// minimum is called Bottom, every local maximum Ceiling.
///   reversed    [r] 1 where the loop runs through its ring backwards
///   mayTurn     turns a polygon by a quarter if it has far fewer local minima and maxima along x
///               than along y. That spares a sweep most of its searches: teeth of a comb become
///               banks
///   complement  links a frame around the polygon, less the polygon: the rings run the other way
///               round, and the frame's corners are nodes n to n + 3, one loop; isolated points are
///               left out
/// Errors: BadStarts, NotFinite, DegeneratePolygon (a ring of fewer than 3 distinct points). O(n)
/// time; the vectors keep their memory.
Outcome linkRings(const PolygonView& polygon, bool mayTurn, bool complement, LinkedPolygon& linked,
                  std::vector<uint8_t>& reversed);

/// The corners of a frame around the polygon, counter-clockwise from the lowest.
void frameAround(const PolygonView& polygon, Point2 corners[4]);

}  // namespace sf
