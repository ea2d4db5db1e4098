// A trimming curve in the domain of a surface, by the parameter of its edge.
//
// Source: Kumar, sec. 2.
// Differs: where a file has none, it is found by inversion: the nearest point of the surface to each point of the edge, found
// from the one next to it, so that it runs on over seams and is then brought back into the domain.
#pragma once
#include <memory>
#include <vector>

#include "base/point2.h"
#include "surface/nurbs_curve.h"
#include "surface/nurbs_surface.h"

namespace sf {

class TrimCurve {
 public:
  TrimCurve() = default;
  explicit TrimCurve(const NurbsCurveView& view) : curve_(std::make_unique<NurbsCurve>(view)) {}
  /// The straight way from one point to another.
  TrimCurve(Point2 from, Point2 to, double t0, double t1);

  bool isFound() const { return curve_ != nullptr; }
  /// At a parameter of the edge.
  Point2 at(double t) const {
    const Vec3 p = curve_->placeAt(t);
    return {p.x, p.y};
  }
  /// Appends the parameters of corners strictly inside a range.
  void appendBreaks(double from, double to, std::vector<double>& parameters) const {
    appendCorners(*curve_, from, to, parameters);
  }
  const NurbsCurve& curve() const { return *curve_; }

 private:
  std::unique_ptr<NurbsCurve> curve_;
};

}  // namespace sf
