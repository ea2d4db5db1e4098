#include "tin/coplanar.h"

#include "base/predicates.h"
#include "triangles/triangle_mesh.h"

namespace sf {

bool findCoplanarGroups(ArrayView<const double> positions, ArrayView<const uint32_t> triangles,
                        ArrayView<const uint32_t> twins, Work& work,
                        std::vector<uint32_t>& groups) {
  const auto at = [&](uint32_t h) {
    const uint32_t v = triangles[h];
    return Vec3{positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]};
  };
  const uint32_t count = uint32_t(triangles.size() / 3);
  groups.assign(count, kNone);
  std::vector<uint32_t> open;
  for (uint32_t first = 0; first < count; ++first) {
    if (groups[first] != kNone) continue;
    groups[first] = first;
    open.assign(1, first);
    while (!open.empty()) {
      const uint32_t t = open.back();
      open.pop_back();
      for (uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
        const uint32_t g = twins[h];
        if (g == kNone || groups[g / 3] != kNone) continue;
        // Planes that are one on both sides of an edge are one for all of a group: faces are not flat seen from above.
        if (orient3d(at(3 * t), at(3 * t + 1), at(3 * t + 2), at(prevInTriangle(g))) != 0) continue;
        groups[g / 3] = first;
        open.push_back(g / 3);
      }
    }
    if (!work.tick(100)) return false;
  }
  return true;
}

}  // namespace sf
