#include "mesh/edge_pairs.h"

#include <cmath>
#include <limits>

namespace sf {
namespace {

// Radians: how much two faces may bend and still belong together, what it costs that they are wound
// against each other, and how much worse the second best has to be.
constexpr double kLargestMisfit = 2.5, kUnlikeWindings = 2, kMargin = 0.15;
// How much a pair with its body inside the angle is better than one with the angle outside, at
// most, each way.
constexpr double kOutside = 0.2;

}  // namespace

EdgeFan::EdgeFan(Vec3 low, Vec3 high) : low_(low), axis_(high - low) {
  const double size = length(axis_);
  axis_ = size > 0 ? (1 / size) * axis_ : Vec3{0, 0, 0};
  const double x = std::fabs(axis_.x), y = std::fabs(axis_.y), z = std::fabs(axis_.z);
  const Vec3 least = x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  across_ = cross(axis_, least);
  if (const double l = length(across_); l > 0) across_ = (1 / l) * across_;
  up_ = cross(axis_, across_);
}

void EdgeFan::add(Vec3 apex, bool runsUp) {
  const Vec3 d = apex - low_;
  const double x = dot(d, across_), y = dot(d, up_);
  angles_[count_] = std::atan2(y, x);
  isFlat_[count_] = !(x * x + y * y > 1e-24 * dot(d, d));
  runsUp_[count_] = runsUp;
  partners_[count_] = kNone;
  ++count_;
}

double EdgeFan::misfit(uint32_t i, uint32_t j) const {
  if (isFlat_[i] || isFlat_[j]) return std::numeric_limits<double>::infinity();
  const bool isAlike = runsUp_[i] != runsUp_[j];
  // The normal of a face that runs up points to where angles grow: below it, towards the one that
  // runs down, is the body.
  const bool iAbove = runsUp_[i] || !isAlike;
  double inside = iAbove ? angles_[i] - angles_[j] : angles_[j] - angles_[i];
  if (inside < 0) inside += 2 * kPi;
  const double bend = std::fabs(kPi - inside);
  return isAlike ? bend + kOutside * (inside - kPi) / kPi : bend + kUnlikeWindings;
}

bool EdgeFan::isClear(uint32_t i, uint32_t j, double best) const {
  if (best > kLargestMisfit) return false;
  for (uint32_t k = 0; k < count_; ++k) {
    if (k == i || k == j || partners_[k] != kNone) continue;
    if (misfit(i, k) < best + kMargin || misfit(j, k) < best + kMargin) return false;
  }
  return true;
}

void EdgeFan::pair() {
  for (bool goesOn = true; goesOn;) {
    goesOn = false;
    for (uint32_t i = 0; i < count_; ++i) {
      for (uint32_t j = i + 1; j < count_ && partners_[i] == kNone; ++j) {
        if (partners_[j] != kNone || !isClear(i, j, misfit(i, j))) continue;
        partners_[i] = j, partners_[j] = i;
        goesOn = true;
      }
    }
  }
}

}  // namespace sf
