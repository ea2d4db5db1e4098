// Curves of space or of a surface's parameters, rational or not, in Bézier form, and the samples that they are drawn by.
//
// Source: Kumar, sec. 2: trimming curves are sampled once for all faces that share them, so that there are no cracks.
// Differs: by bisection, so that samples for a coarser tolerance are among those for a finer one.
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

 private:
  BezierSpans t_;
  std::vector<double> points_;  // span after span: [(p + 1) 4] homogeneous
};

struct CurveSampling {
  double tolerance = 0;    // most distance of the curve from the chords, positive
  double angle = 0.35;     // most turn of the tangent along a chord, radians
  double longest = 1e300;  // most length of a chord
};

/// Appends parameters from the beginning of the domain to its end, rising, such that the chords between them keep to
/// `sampling`; breaks are among them. Intervals are halved, at most 30 times: where a curve has a corner that no break tells
/// of, its angle stays. O(p) time a sample.
void sampleCurve(const NurbsCurve& curve, const CurveSampling& sampling,
                 std::vector<double>& parameters);

}  // namespace sf
