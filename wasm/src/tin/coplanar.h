// Which faces of a terrain lie in one plane with their neighbours.
//
// Source: Stanchev, Paraskevov, sec. 3: an edge between coplanar triangles may be swapped without a change of the terrain's shape.
// Differs: groups of coplanar faces are found once, from the faces as they were given, by exact arithmetic. Vertices that are added
// later have rounded heights, so that tests of their faces would say nothing.
#pragma once
#include <cstdint>
#include <vector>

#include "base/array_view.h"
#include "base/work.h"

namespace sf {

/// Groups of faces that are joined by edges across which the plane is the same, to the last bit. False when the work ended.
///   positions  [3n] x, y and height
///   triangles  [3m] as checkTin has found them
///   twins      [3m] likewise
///   groups     [m] out: a number for each face, the same within a group: that of its first face
/// O(m) time.
bool findCoplanarGroups(ArrayView<const double> positions, ArrayView<const uint32_t> triangles,
                        ArrayView<const uint32_t> twins, Work& work, std::vector<uint32_t>& groups);

}  // namespace sf
