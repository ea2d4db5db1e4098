// Proof that triangles are a triangulation, from the triangles alone.
// Source: Ronfard, Rossignac 1994, sec. 6: "we triangulate both the polygon and its complement, for
// verification purposes". That this finds every invalid input is a conjecture there and a theorem
// here: PAPERS.md has the argument.
#pragma once
#include <vector>

#include "base/buffer.h"
#include "base/work.h"
#include "polygon/input/polygon.h"

namespace sf {

/// The input of certify.
struct Certificate {
  Buffer<Point2> at;            // [m] points: the input's, and last the four corners of a frame,
                                // counter-clockwise
  std::vector<uint32_t> same;   // [m] for each point one that stands for all at its
                                // place; empty where no two are at one place
  Buffer<uint32_t> rings;       // [2e] edges u -> v of the rings, the polygon to the left
  Buffer<uint32_t> inside;      // [3t] triangles of the polygon
  Buffer<uint32_t> complement;  // [3s] triangles of the frame without the polygon
  // Pairs of half-edges known to be opposites, numbered as in ClosableTwins. Among the first
  // insidePaired half-edges (at most 3t) or complementPaired ones (at most 3s), each names another
  // one of them, or any number beyond them if none is known. certify checks the pairs, and is false
  // if one is wrong.
  size_t insidePaired = 0, complementPaired = 0;
  Buffer<uint32_t> insideTwins, complementTwins;  // at least as many
};

/// Whether the triangles alone prove that the rings wind 0 or 1 times around every point off them,
/// and that the triangles cover the points of winding number 1 once and no others. This holds if
/// all numbers are finite; no triangle is turned over, by exact orient2d; the boundaries of the
/// inner triangles sum to the rings; and those of the complement's to the frame less the rings.
/// O(m + t + s) time and memory, charged to `work`. False too once `work` is to end.
/// Parts without area do not count: spikes, and edges that run to and fro,
/// are for the sweep to find.
bool certify(const Certificate& certificate, Work& work);

}  // namespace sf
