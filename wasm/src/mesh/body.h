// Components that groups of rims hold together, and what they are once all holes are closed: bodies or sheets.
#pragma once
#include <cmath>
#include <vector>

#include "mesh/group.h"

namespace sf {

struct Body {
  uint32_t openGroups = 0;     // groups with isOpenRim
  uint32_t openGroup = kNone;  // one of them
  bool isOrientable = true;
  double area = 0, volume = 0;  // with every rim closed by triangles from its middle; scaled
  /// 36 pi volume^2 / area^3: 1 of a ball, 0 of a flat sheet.
  double roundness() const {
    constexpr double kTimes = 36 * 3.14159265358979323846;
    return area > 0 ? kTimes * (volume / area) * (volume / area) / area : 0;
  }
};

/// All bodies. Areas and volumes are those of bodies with one open group alone, 0 of others.
///   groups  starts, rims, isOpenRim
/// O(m + r), in one pass over the faces. False once `work` has to end.
bool findBodies(const MeshView& mesh, const Adjacency& adjacency, const Rims& rims,
                const Grouping& groups, Work& work, Charge& charge, std::vector<Body>& result);

}  // namespace sf
