// Whether triangles are a terrain: a surface with one height over every place of the plane that it covers.
//
// Source: Stanchev, Paraskevov, sec. 2: a 2.5D TIN. Differs: the paper takes for granted that a mesh is one, and has a convex
// border. Here the border may be anything: concave, with holes, in several parts, pinched at vertices. What the mesh is is proven:
// - every face is counter-clockwise, every directed edge is there once, and around every vertex the faces turn once at most. So
//   the mesh covers the plane without folds, but perhaps several times.
// - How often a place is covered changes at border edges alone. If borders do not cross, and no face lies beside a border edge
//   twice, nowhere is covered twice.
// Vertices that touch the middle of a border edge from outside, and edges that lie on each other back to back, are allowed.
#pragma once
#include <cstdint>
#include <vector>

#include "base/array_view.h"
#include "base/work.h"

namespace sf {

enum class TinFault {
  None,
  Empty,            // there are no triangles
  IndexOutOfRange,  // of a face
  NotFinite,        // a coordinate of a vertex
  RepeatedVertex,   // two vertices of faces at one place of the plane
  Degenerate,       // a face with a corner twice, or all on one line
  Vertical,         // a face whose corners are on one line seen from above
  Clockwise,        // a face, which orientation would mend
  NonManifold,      // an edge that two faces run along in one direction, or more than two in all
  Overlap,          // two faces that lie over each other
};

/// What is wrong with a mesh, and where. What does not apply is kNone.
struct TinProblem {
  TinFault fault = TinFault::None;
  uint32_t faces[2] = {kNone, kNone};
  uint32_t vertices[2] = {kNone, kNone};  // of RepeatedVertex; the ends of the edge of NonManifold
};

/// Checks a mesh, and finds which faces are beside each other. Predicates are exact: there is no tolerance. Vertices that no face
/// has are not looked at, but for being finite. False with a problem, or if the work ended.
///   positions  [3n] x, y and height
///   triangles  [3m] counter-clockwise seen from above
///   orient     turns clockwise faces over, instead of naming the first of them
///   twins      [3m] out: for each half-edge, 3t + k from corner k to the next, the one on its other side, or kNone
/// O(m + n log n) time for borders of which few parts are near each other.
bool checkTin(ArrayView<const double> positions, std::vector<uint32_t>& triangles, bool orient,
              Work& work, std::vector<uint32_t>& twins, TinProblem& problem);

}  // namespace sf
