// How fine a mesh is to be, and how fine that is at a place.
//
// Source: Kumar, sec. 2: samples are as dense as the picture needs them.
#pragma once
#include <cmath>
#include <limits>

#include "base/vec.h"

namespace sf {

/// Where a picture is taken from.
struct Camera {
  double matrix[16];  // view and projection, column by column
  double width = 1, height = 1;

  double row(int i, Vec3 p) const {
    return matrix[i] * p.x + matrix[4 + i] * p.y + matrix[8 + i] * p.z + matrix[12 + i];
  }
  double rowLength(int i) const { return length({matrix[i], matrix[4 + i], matrix[8 + i]}); }
};

struct Sampling {
  static constexpr double kNoLimit = std::numeric_limits<double>::infinity();
  double tolerance = kNoLimit;  // most distance of mesh and surface
  double angle = 0.35;          // most turn of the normal along an edge, radians; pi or more: any
  double aspect = 3;            // most length of cells for their width
  double pixels = kNoLimit;     // most distance of mesh and surface on the picture
  const Camera* camera = nullptr;
  // Intervals that are halved now stay so until their error is less than this share of what is allowed.
  double hysteresis = 1;
};

/// The tolerance at places, for one sampling.
class Fineness {
 public:
  explicit Fineness(const Sampling& sampling) : sampling_(sampling) {
    if (!sampling.camera) return;
    const Camera& c = *sampling.camera;
    for (int i = 0; i < 4; ++i) lengths_[i] = c.rowLength(i);
    // A pixel at a place is w over these, in the model's unit.
    perPixel_ = std::fmax(lengths_[0] * c.width, lengths_[1] * c.height) / 2;
    // Of a perspective z is a w + b along the axis; nothing is shown nearer than where that is -w.
    const Vec3 z{c.matrix[2], c.matrix[6], c.matrix[10]}, w{c.matrix[3], c.matrix[7], c.matrix[11]};
    if (dot(w, w) > 0) {
      const double a = dot(z, w) / dot(w, w), b = c.matrix[14] - a * c.matrix[15];
      near_ = std::fmax(near_, -b / (1 + a));
    }
  }

  /// For the ball of that radius: infinite where the picture does not show it.
  double tolerance(Vec3 middle, double radius) const {
    if (!sampling_.camera) return sampling_.tolerance;
    const Camera& c = *sampling_.camera;
    const double w = c.row(3, middle);
    for (int i = 0; i < 3; ++i) {
      const double x = c.row(i, middle);
      // A plane of the frustum: w + x >= 0 or w - x >= 0.
      if (w + x < -radius * (lengths_[i] + lengths_[3]) ||
          w - x < -radius * (lengths_[i] + lengths_[3]))
        return Sampling::kNoLimit;
    }
    const double nearest = std::fmax(w - radius * lengths_[3], near_);
    return std::fmin(sampling_.tolerance, sampling_.pixels * nearest / perPixel_);
  }
  /// The least and the greatest of a ball's places; the latter is infinite where the picture does not show all of it.
  struct Range {
    double least, greatest;
  };
  Range range(Vec3 middle, double radius) const {
    if (!sampling_.camera) return {sampling_.tolerance, sampling_.tolerance};
    const Camera& c = *sampling_.camera;
    Range range{tolerance(middle, radius), Sampling::kNoLimit};
    const double w = c.row(3, middle);
    for (int i = 0; i < 3; ++i)
      if (w - std::fabs(c.row(i, middle)) < radius * (lengths_[i] + lengths_[3])) return range;
    range.greatest =
        std::fmin(sampling_.tolerance, sampling_.pixels * (w + radius * lengths_[3]) / perPixel_);
    return range;
  }
  double angle() const { return sampling_.angle; }
  double aspect() const { return sampling_.aspect; }
  double hysteresis() const { return sampling_.hysteresis; }

 private:
  const Sampling& sampling_;
  double lengths_[4] = {}, perPixel_ = 1, near_ = 1e-300;
};

}  // namespace sf
