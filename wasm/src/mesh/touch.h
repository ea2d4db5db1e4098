// Rims of one hole that touch: along the gaps between them they are one loop, which passes a vertex twice.
//
// Source: Zou, Ju, Carr 2013 has loops that are disjoint. Loops through touching rims are ours.
#pragma once
#include <cstdint>
#include <vector>

#include "mesh/find.h"

namespace sf {

struct RimLoops {
  std::vector<uint32_t> edges;   // of rims, loop after loop
  std::vector<uint32_t> starts;  // [k+1] in `edges`
};

/// Loops of rim edges around a hole, as faces that fill it run. Rims of the hole that touch are joined as they were
/// followed across the gaps between faces; the others are a loop each. O(n log n) time for n edges.
RimLoops loopsAround(const Rims& rims, ArrayView<const uint32_t> group);

/// Whether the triangles around a vertex, [3t] vertices of which one is `vertex`, close to one fan.
bool isFan(const std::vector<uint32_t>& triangles, uint32_t vertex);

/// Whether no two triangles have an edge the same way, and none has a vertex twice.
bool hasSimpleEdges(ArrayView<const uint32_t> triangles);

}  // namespace sf
