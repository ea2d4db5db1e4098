// atan2 for loops over arrays: without branches, so that compilers vectorise it.
// Source: the rational approximation of Cephes (Moshier), atan.c, for |t| <= 0.66.
#pragma once
#include <cmath>

namespace sf {

/// The angle of (x, y) in [-pi, pi], to about 2e-16; 0 for the zero vector.
inline double fastAtan2(double y, double x) {
  constexpr double kQuarter = 0.785398163397448309616, kHalf = 2 * kQuarter, kWhole = 4 * kQuarter;
  const double ax = std::fabs(x), ay = std::fabs(y);
  const double large = ax > ay ? ax : ay, small = ax > ay ? ay : ax;
  const double q = small / (large > 0 ? large : 1.0);
  const bool shift = q > 0.66;
  // tan(a - pi/4) = (tan a - 1) / (tan a + 1); one division either way.
  const double t = (shift ? q - 1.0 : q) / (shift ? q + 1.0 : 1.0);
  const double z = t * t;
  const double p = (((-8.750608600031904122785e-1 * z - 1.615753718733365076637e1) * z -
                     7.500855792314704667340e1) *
                        z -
                    1.228866684490136173410e2) *
                       z -
                   6.485021904942025371773e1;
  const double d = ((((z + 2.485846490142306297962e1) * z + 1.650270098316988542046e2) * z +
                     4.328810604912902668951e2) *
                        z +
                    4.853903996359136964868e2) *
                       z +
                   1.945506571482613964425e2;
  double angle = t + t * z * (p / d);
  angle = shift ? kQuarter + angle : angle;
  angle = ay > ax ? kHalf - angle : angle;
  angle = x < 0 ? kWhole - angle : angle;
  return y < 0 ? -angle : angle;
}

}  // namespace sf
