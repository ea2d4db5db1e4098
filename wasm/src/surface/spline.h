// Splines of one parameter as they come, and the way to Bézier form.
//
// Source: Kumar, sec. 2, has Bézier surfaces; NURBS become such, span by span. Ramshaw 1989, "Blossoms are polar forms": the
// Bézier points of a span are values of its blossom, whether the knots are clamped or not.
#pragma once
#include <cstdint>
#include <vector>

#include "base/array_view.h"

namespace sf {

/// A spline's degree and flat knots, multiplicities expanded. Its domain is knots[degree] to knots[count()].
struct KnotVector {
  uint32_t degree = 0;
  ArrayView<const double> knots;  // [count() + degree + 1]

  uint32_t count() const { return uint32_t(knots.size()) - degree - 1; }  // of poles
  double from() const { return knots[degree]; }
  double to() const { return knots[count()]; }
};

/// Degrees above this are refused.
constexpr uint32_t kMostDegree = 25;
/// And so are spans shorter or longer than this: squares of derivatives have to stay finite.
constexpr double kShortestSpan = 1e-50, kLongestSpan = 1e50;

/// Whether these are knots: of degree 1 to kMostDegree, finite, never falling, those inside the domain at most `degree` times,
/// and as many as `poles` poles need. The domain is not empty.
bool areKnots(const KnotVector& v, size_t poles);

/// How many spans of positive length there are.
uint32_t spanCount(const KnotVector& v);

/// A spline's spans of positive length, and how their Bézier points are made of its poles.
class BezierSpans {
 public:
  /// For knots that are such. O(spans degree³) time, and degree² numbers a span.
  explicit BezierSpans(const KnotVector& v);

  uint32_t degree() const { return degree_; }
  uint32_t count() const { return uint32_t(firsts_.size()); }
  /// [count() + 1] where spans begin, and the last one ends.
  ArrayView<const double> breaks() const { return breaks_; }
  /// The first of the degree + 1 poles that a span depends on.
  uint32_t firstPole(uint32_t span) const { return firsts_[span]; }
  /// [(degree + 1)²] row j: the factors of these poles in Bézier point j of the span. Rows sum up to 1.
  ArrayView<const double> factors(uint32_t span) const;
  /// The span of a parameter; parameters outside of the domain belong to the nearest. Breaks belong to the span
  /// after them, the last one to the span before.
  uint32_t spanAt(double t) const;

 private:
  uint32_t degree_;
  std::vector<double> breaks_, factors_;
  std::vector<uint32_t> firsts_;
};

/// Bernstein polynomials of a degree at x from 0 to 1, and their first two derivatives by x. Each [degree + 1].
struct Bernstein {
  double value[kMostDegree + 1], first[kMostDegree + 1], second[kMostDegree + 1];
  void at(uint32_t degree, double x);
  /// Without second derivatives: most places need none.
  void firstAt(uint32_t degree, double x);
};

}  // namespace sf
