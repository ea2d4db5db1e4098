// Curves of space or of a surface's parameters, rational or not, in Bézier form.
//
// Source: Kumar, sec. 2.
#pragma once
#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "surface/spline.h"

namespace sf {

struct NurbsCurveView {
  KnotVector t;
  uint32_t dimension = 3;           // 2 or 3
  ArrayView<const double> poles;    // [dimension t.count()], not multiplied by weights
  ArrayView<const double> weights;  // [t.count()] positive, or empty: not rational
};

/// A point of a curve, and its derivatives there; z is 0 in two dimensions.
struct CurvePoint {
  Vec3 at, first, second;
};

class NurbsCurve {
 public:
  /// For valid knots, finite poles and positive weights.
  explicit NurbsCurve(const NurbsCurveView& view);

  const BezierSpans& spans() const { return t_; }
  /// At a parameter of the domain, with derivatives from the right at breaks, but at the end of the domain. O(p) time.
  CurvePoint at(double t) const;
  /// The place alone.
  Vec3 placeAt(double t) const;

 private:
  BezierSpans t_;
  std::vector<double> points_;  // span after span: [(p + 1) 4] homogeneous
};

/// Appends the breaks strictly between two parameters at which the curve has a corner, in order.
void appendCorners(const NurbsCurve& curve, double from, double to, std::vector<double>& corners);

}  // namespace sf
