// Holes in parts, that are filled apart.
#pragma once
#include <cstdint>
#include <vector>

#include "base/status.h"
#include "base/vec.h"

namespace sf {

/// A corner of the loop around a part of a hole, and the edge from it to the next one.
struct PartCorner {
  uint32_t edge = kNone;    // the rim edge that begins there; kNone where another part goes on
  uint32_t vertex = kNone;  // of the input; kNone: `added`
  uint32_t added = kNone;   // in the list of points that are added
  bool isCrease =
      false;  // the rim edge runs along a crease: the face there says nothing of the part
};

struct HoleParts {
  std::vector<std::vector<PartCorner>> parts;  // a loop each, as faces that fill it run
  std::vector<Vec3> points;                    // added, on the edges between parts
  std::vector<uint32_t> triangles;  // [3t] vertices of the input: faces between the parts
  bool areBetweenCreases = false;   // which bound what is around each part as well
};

}  // namespace sf
