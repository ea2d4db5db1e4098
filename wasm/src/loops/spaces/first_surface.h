// A surface over any number of loops, at once and without a search: one loop is filled, and the others are
// put into it one after the other.
// Source: none in Zou, Ju, Carr 2013. Barequet, Sharir 1995 for bands between two loops by dynamic
// programming; the insertion of a loop is Bowyer's and Watson's step with a loop in place of a point.
//
// To put a loop in, a disc of triangles near it is taken out, which has no vertex inside, and a band is
// sewn between the disc's boundary and the loop. Every edge across the band is new, since the loop had no
// triangle before: so whatever loops there are, the result is a surface of the class, and needs no
// repair. How good it is depends on the order and on the discs, both of which are chosen greedily; it is what a
// search begins from where narrow candidate spaces have no surface in sight.
#pragma once
#include <cstdint>
#include <vector>

#include "base/work.h"
#include "loops/problem/candidate_set.h"

namespace sf {

/// Whether firstSurface is quick: some tenths of a second at most.
bool hasFirstSurface(const LoopSet& loops);

/// A surface over the loops. False when the work ended.
///   weights    of area, perimeter and angles; normals and own weights do not count
///   triangles  [3m] out: m = n + 2k - 4, wound alike, none collinear; empty if the greedy choices lead to
///              none without collinear triples, as where loops lie on one line
/// O(n^2) time.
bool firstSurface(const LoopSet& loops, const TriangleWeights& weights, Work& work,
                  std::vector<uint32_t>& triangles);

}  // namespace sf
