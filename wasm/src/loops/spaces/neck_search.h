// Two loops whose cost counts no angles: a disc in each, and the best *necks* between the two.
// Source: none in Zou, Ju, Carr 2013.
//
// A surface over two loops that lie apart costs least when it is next to two discs. It cannot be
// just these: it has to be connected, and no edge may have more than two triangles. The least that
// does it is a triangle taken out of either disc, and six triangles that join their edges, three
// with two vertices on one loop and three on the other, all around.
#pragma once
#include <cstdint>
#include <vector>

#include "base/work.h"
#include "loops/problem/loop_set.h"
#include "loops/spaces/plain_polygon.h"

namespace sf {

/// Appends the triangles of the least costly surfaces of that kind, some tens of them: three vertices
/// each, in any order, repeated. Of each loop only some hundreds of openings are tried, those that
/// promise most. False when the work ended. O(n^3) and some ten thousand rings; takes memory that the
/// caller has charged, see bytesForNecks.
///   loops    two, in any units
///   weights  of their triples
bool neckTriples(const LoopSet& loops, const TripleWeights& weights, Work& work,
                 std::vector<uint32_t>& triples);

/// Bytes that the weights of n vertices' triples and neckTriples take together, at most.
double bytesForNecks(double n);

}  // namespace sf
