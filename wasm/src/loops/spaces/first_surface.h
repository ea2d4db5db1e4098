// A surface over any number of loops, at once and without a search: one loop is filled, and the
// others are put into it one after the other.
// Source: none in Zou, Ju, Carr 2013. Barequet, Sharir 1995 for bands between two loops by dynamic
// programming; the insertion of a loop is Bowyer's and Watson's step with a loop in
// place of a point.
//
// To put a loop in, a disc of triangles near it, with no vertex inside, is taken out. Then a band
// is sewn between the disc's boundary and the loop. Every edge across the band is new, since the
// loop had no triangle before. So the result is a surface of the class, whatever the loops are, and
// needs no repair. Its quality depends on the order of the loops and on the discs, both of which
// are chosen greedily. A search begins from it where narrow candidate spaces seem
// to have no surface.
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
///   triangles  [3m] out: m = n + 2k - 4, wound alike, none collinear; empty if the greedy choices
///              need a collinear triple, as where loops lie on one line
/// O(n^2) time.
bool firstSurface(const LoopSet& loops, const TriangleWeights& weights, Work& work,
                  std::vector<uint32_t>& triangles);

}  // namespace sf
