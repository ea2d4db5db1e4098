// incircle with its filter inline.
// Source: Shewchuk 1997, incircle, stage A.
#pragma once
#include <cmath>

#include "base/predicates.h"
#include "polygon/polygon.h"

namespace sf {

/// Whether d lies inside the circle through a, b, c, which turn left. Exact in the range of
/// base/predicates.h.
inline bool inCircle(Point2 a, Point2 b, Point2 c, Point2 d) {
  const double ax = a.x - d.x, ay = a.y - d.y, bx = b.x - d.x, by = b.y - d.y;
  const double cx = c.x - d.x, cy = c.y - d.y;
  const double bxcy = bx * cy, cxby = cx * by, cxay = cx * ay, axcy = ax * cy;
  const double axby = ax * by, bxay = bx * ay;
  const double aa = ax * ax + ay * ay, bb = bx * bx + by * by, cc = cx * cx + cy * cy;
  const double det = aa * (bxcy - cxby) + bb * (cxay - axcy) + cc * (axby - bxay);
  const double size = aa * (std::fabs(bxcy) + std::fabs(cxby)) +
                      bb * (std::fabs(cxay) + std::fabs(axcy)) +
                      cc * (std::fabs(axby) + std::fabs(bxay));
  // Shewchuk's (10 + 96 u) u with u = 2^-53, rounded up; the last term is above all underflows.
  if (std::fabs(det) > 0x1.5p-50 * size + 1e-290) return det > 0;
  return incircle(a.x, a.y, b.x, b.y, c.x, c.y, d.x, d.y) > 0;
}

}  // namespace sf
