// A surface brought into a box of unit size: neither large nor small coordinates, nor a place far from the origin,
// change what comes out.
#pragma once
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/array_view.h"
#include "base/vec.h"

namespace sf {

class UnitBox {
 public:
  /// For positions [3n], n > 0.
  explicit UnitBox(ArrayView<const double> positions) {
    const size_t n = positions.size() / 3;
    for (size_t a = 0; a < 3 && n > 0; ++a) {
      double low = positions[a], high = low;
      for (size_t v = 1; v < n; ++v)
        low = std::fmin(low, positions[3 * v + a]), high = std::fmax(high, positions[3 * v + a]);
      middle_[a] = low + (high - low) / 2, extent_ = std::fmax(extent_, high - low);
    }
  }
  /// Whether there is no size to take for the unit.
  bool isPoint() const { return !(extent_ > 0) || !std::isfinite(extent_); }
  double extent() const { return extent_; }
  Vec3 in(const double* p) const {
    return {(p[0] - middle_[0]) / extent_, (p[1] - middle_[1]) / extent_,
            (p[2] - middle_[2]) / extent_};
  }
  void out(Vec3 q, double* p) const {
    p[0] = middle_[0] + extent_ * q.x, p[1] = middle_[1] + extent_ * q.y,
    p[2] = middle_[2] + extent_ * q.z;
  }

 private:
  double middle_[3] = {0, 0, 0}, extent_ = 0;
};

}  // namespace sf
