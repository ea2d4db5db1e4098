// Two loops whose cost counts no angles: a disc in each, and the best *necks* between the two.
// Source: none in Zou, Ju, Carr 2013.
//
// A surface over two loops that lie apart is cheapest if it is nearly two discs. It cannot be just
// these: it has to be connected, and no edge may have more than two triangles. The smallest change
// that connects them takes one triangle out of each disc, and joins the edges of the two openings
// by a ring of six triangles: three with two vertices on one loop, and three with two on the other.
#pragma once
#include <cstdint>
#include <vector>

#include "base/work.h"
#include "loops/problem/loop_set.h"
#include "loops/spaces/plain_polygon.h"

namespace sf {

/// Appends the triangles of the cheapest surfaces of that kind, some tens of them: three vertices
/// each, in any order, repeated. Of each loop only some hundreds of openings are tried, the most
/// promising ones. False when the work ended. O(n^3) time and some ten thousand rings. The caller
/// charges the memory, see bytesForNecks.
///   loops    two, in any units
///   weights  of their triples
bool neckTriples(const LoopSet& loops, const TripleWeights& weights, Work& work,
                 std::vector<uint32_t>& triples);

/// The most bytes that neckTriples and the weights of all triples of n vertices take together.
double bytesForNecks(double n);

}  // namespace sf
