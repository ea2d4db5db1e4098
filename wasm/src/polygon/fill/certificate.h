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

/// What certify looks at.
struct Certificate {
  Buffer<Point2> at;           // [m] points: the input's, and last the four corners of a frame,
                               // counter-clockwise
  std::vector<uint32_t> same;  // [m] for each point one at the same place, itself if none is; empty
                               // where no two are at one place
  Buffer<uint32_t> rings;      // [2e] edges u -> v of the rings, the polygon to the left
  Buffer<uint32_t> inside;     // [3t] triangles of the polygon
  Buffer<uint32_t> complement;  // [3s] triangles of the frame without the polygon
  // What is known of half-edges that are opposites of each other, named as in ClosableTwins: of the first
  // half-edges so many, up to 3t or 3s, each has another one of them, or any larger number where nothing is
  // known. What is said has to be right.
  size_t insidePaired = 0, complementPaired = 0;
  Buffer<uint32_t> insideTwins, complementTwins;  // at least so many
};

/// Whether the triangles prove by themselves that the rings wind 0 or 1 times around every point off
/// them, and that they cover the points of 1 once and no others: all numbers are finite, no triangle is
/// turned over, by exact orient2d, and the sums of the triangles' boundaries are that of the rings inside,
/// and the frame less the rings outside. O(m + t + s) time and memory, charged to `work`; false too once
/// `work` is to end.
/// What has no area does not count: spikes, and edges that run to and fro, are the sweep's to find.
bool certify(const Certificate& certificate, Work& work);

}  // namespace sf
