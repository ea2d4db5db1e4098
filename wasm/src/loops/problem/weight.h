// Weights of triangles and of pairs of triangles, and how they add up to the cost of a surface.
// Source: Zou, Ju, Carr 2013, sec. 3.1, eqs. 1 and 2.
// Differs: besides the paper's sum, the largest dihedral angle can be minimised. That takes two
// passes, because the least sum among the surfaces of least worst angle has no optimal
// substructure: first the worst angle alone (maxima in place of sums), then the sum over the
// surfaces none of whose angles exceed it.
#pragma once
#include <cmath>
#include <limits>

#include "base/vec.h"

namespace sf {

/// Worst angles that differ by less count as tied.
constexpr double kAngleTie = 1e-10;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The dihedral angle (0 flat, pi folded) of two triangles at the angles thetaA and thetaB around
/// their common edge, each in [-pi, pi]. Equals the angle between
/// their consistently oriented normals.
inline double dihedralAngle(double thetaA, double thetaB) {
  return std::fabs(kPi - std::fabs(thetaA - thetaB));
}

/// Unit vectors that span the plane across an edge: angles around it go from `x` towards `y`.
struct Frame {
  Vec3 x, y;
};

/// Some frame across a direction, which need not be a unit vector.
inline Frame frameAcross(Vec3 along) {
  const double l = length(along);
  const Vec3 d = l > 0 ? (1 / l) * along : Vec3{1, 0, 0};
  const double ax = std::fabs(d.x), ay = std::fabs(d.y), az = std::fabs(d.z);
  const Vec3 least = ax <= ay && ax <= az ? Vec3{1, 0, 0}
                     : ay <= az           ? Vec3{0, 1, 0}
                                          : Vec3{0, 0, 1};
  Vec3 x = cross(d, least);
  x = (1 / length(x)) * x;
  return {x, cross(d, x)};
}

/// The angle of a triangle around its edge in a frame across it, from the normal
/// (end of the edge - start) x (apex - start).
inline double angleOfNormal(const Frame& frame, Vec3 normal) {
  return std::atan2(-dot(normal, frame.x), dot(normal, frame.y));
}

/// What one pass of the solver minimises: a sum, or a maximum of angles.
class Measure {
 public:
  /// Sum of weights, dihedral angles times `dihedralWeight`; angles above `cap` are forbidden.
  static Measure sum(double dihedralWeight, double cap = kInfinity) {
    return {false, dihedralWeight, cap};
  }
  /// The largest dihedral angle.
  static Measure worst() { return {true, 1, kInfinity}; }

  bool isWorst() const { return worst_; }
  double cap() const { return cap_; }
  double dihedralWeight() const { return dihedralWeight_; }
  double join(double a, double b) const { return worst_ ? (a < b ? b : a) : a + b; }
  /// Bi-triangle weight w(t, t') of eq. 2.
  double pair(double thetaA, double thetaB) const {
    const double angle = dihedralAngle(thetaA, thetaB);
    return angle <= cap_ ? dihedralWeight_ * angle : kInfinity;
  }
  /// Whether `value` improves on `best` by more than the rounding of sums in different orders.
  /// Without this slack tied surfaces, as on flat input, would all be explored one by one.
  bool improves(double value, double best) const {
    return worst_ ? value < best : value < best - 1e-13 * std::fabs(best) || best == kInfinity;
  }

 private:
  Measure(bool worst, double dihedralWeight, double cap)
      : worst_(worst), dihedralWeight_(dihedralWeight), cap_(cap) {}
  bool worst_;
  double dihedralWeight_;
  double cap_;
};

}  // namespace sf
