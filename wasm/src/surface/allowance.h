// How far the mesh of a face may be off its surface, from place to place of the domain.
//
// Source: Kumar, sec. 2: samples are as dense as the picture needs them, the same for all of a patch.
// Differs: faces may be large, and a camera near to one end of them. So the domain is divided, and each part has a tolerance of its
// own.
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/point2.h"
#include "surface/sampling.h"

namespace sf {

/// A rectangle of a domain.
struct Box2 {
  double u0, u1, v0, v1;
};

class Allowance {
 public:
  Allowance() = default;
  /// The same everywhere.
  explicit Allowance(double tolerance) : least_(tolerance) {}
  /// In equal parts of a box.
  ///   parts  [count²] u by u
  Allowance(Box2 box, uint32_t count, std::vector<double> parts)
      : box_(box), count_(count), parts_(std::move(parts)) {
    alongU_.assign(count, Sampling::kNoLimit), alongV_ = alongU_;
    for (uint32_t i = 0; i < count; ++i)
      for (uint32_t j = 0; j < count; ++j) {
        const double part = parts_[i * count + j];
        alongU_[i] = std::min(alongU_[i], part), alongV_[j] = std::min(alongV_[j], part);
      }
    least_ = *std::min_element(alongU_.begin(), alongU_.end());
  }

  double least() const { return least_; }
  double at(Point2 uv) const {
    if (count_ < 2) return least_;
    return parts_[partOf(uv.x, box_.u0, box_.u1) * count_ + partOf(uv.y, box_.v0, box_.v1)];
  }
  /// The least between two values of u, or of v.
  double betweenU(double a, double b) const { return between(alongU_, a, b, box_.u0, box_.u1); }
  double betweenV(double a, double b) const { return between(alongV_, a, b, box_.v0, box_.v1); }

  /// The same, times a factor.
  Allowance times(double factor) const {
    Allowance other = *this;
    other.least_ *= factor;
    for (auto* list : {&other.parts_, &other.alongU_, &other.alongV_})
      for (double& x : *list) x *= factor;
    return other;
  }
  /// Whether all of it is from `factor` times to once that of another, part by part.
  bool isWithin(const Allowance& other, double factor) const {
    if (count_ != other.count_) return false;
    if (count_ < 2) return isWithin(least_, other.least_, factor);
    for (size_t i = 0; i < parts_.size(); ++i)
      if (!isWithin(parts_[i], other.parts_[i], factor)) return false;
    return true;
  }

 private:
  static bool isWithin(double mine, double other, double factor) {
    return mine <= other && (mine >= factor * other || mine == other);
  }
  uint32_t partOf(double x, double from, double to) const {
    const double part = (x - from) / (to - from) * count_;
    return part <= 0 ? 0 : part >= count_ ? count_ - 1 : uint32_t(part);
  }
  double between(const std::vector<double>& along, double a, double b, double from,
                 double to) const {
    if (count_ < 2) return least_;
    double least = Sampling::kNoLimit;
    for (uint32_t i = partOf(a, from, to), end = partOf(b, from, to); i <= end; ++i)
      least = std::min(least, along[i]);
    return least;
  }

  double least_ = Sampling::kNoLimit;
  Box2 box_{};
  uint32_t count_ = 1;
  std::vector<double> parts_, alongU_, alongV_;
};

}  // namespace sf
