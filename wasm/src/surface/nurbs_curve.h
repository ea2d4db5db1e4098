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

/// The bytes that a curve takes.
uint64_t bytesOf(const NurbsCurveView& view);

/// A point of a curve, and its derivatives there; z is 0 in two dimensions.
struct CurvePoint {
  Vec3 at, first, second;
};

class NurbsCurve {
 public:
  /// For valid knots, finite poles and positive weights.
  explicit NurbsCurve(const NurbsCurveView& view);

  const BezierSpans& spans() const { return t_; }
  /// At a parameter, of which those outside of the domain count as its nearest end. With derivatives from the right at breaks,
  /// but at the end of the domain. O(p) time.
  CurvePoint at(double t) const;
  /// The place alone.
  Vec3 placeAt(double t) const;
  /// The derivative from the left at the end of a span.
  Vec3 derivativeAtEnd(uint32_t span) const;

  /// [(p + 1) 4] the Bézier points of a span: x w, y w, z w, w.
  const double* bezierPoints(uint32_t span) const {
    return points_.data() + size_t(span) * (t_.degree() + 1) * 4;
  }

 private:
  BezierSpans t_;
  std::vector<double> points_;  // span after span: [(p + 1) 4] homogeneous
};

/// Whether all of the curve between two parameters lies in a box, but for rounding. O(p²) time a span, if most is far from the
/// sides.
bool liesWithin(const NurbsCurve& curve, double from, double to, Vec3 low, Vec3 high);

/// Appends the breaks strictly between two parameters at which the curve has a corner, in order.
void appendCorners(const NurbsCurve& curve, double from, double to, std::vector<double>& corners);

}  // namespace sf
