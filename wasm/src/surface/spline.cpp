#include "surface/spline.h"

#include <algorithm>
#include <cmath>

namespace sf {
namespace {

/// The factors of the poles in the blossom of a span at some arguments.
///   knots   from the span's first pole on: [2 degree] knots that its de Boor scheme has, the span between the middle two
///   result  [degree + 1]
void blossom(uint32_t degree, const double* knots, const double* arguments, double* result) {
  // Row i of the scheme as factors of the poles, which begins as pole i itself.
  constexpr uint32_t kWidth = kMostDegree + 1;
  double rows[kWidth][kWidth] = {};
  for (uint32_t i = 0; i <= degree; ++i) rows[i][i] = 1;
  for (uint32_t r = 1; r <= degree; ++r)
    for (uint32_t i = degree; i >= r; --i) {
      const double low = knots[i - 1], high = knots[i + degree - r];
      const double x = (arguments[r - 1] - low) / (high - low);
      for (uint32_t k = i - r; k <= i; ++k)
        rows[i][k] = (k < i ? (1 - x) * rows[i - 1][k] : 0) + (k > i - r ? x * rows[i][k] : 0);
    }
  std::copy(rows[degree], rows[degree] + degree + 1, result);
}

}  // namespace

bool areKnots(const KnotVector& v, size_t poles) {
  const uint32_t p = v.degree;
  if (p < 1 || p > kMostDegree || poles <= p || v.knots.size() != poles + p + 1) return false;
  for (size_t i = 0; i < v.knots.size(); ++i)
    if (!std::isfinite(v.knots[i]) || (i > 0 && v.knots[i] < v.knots[i - 1])) return false;
  const auto isSpan = [](double width) { return width >= kShortestSpan && width <= kLongestSpan; };
  if (!isSpan(v.to() - v.from())) return false;
  for (size_t i = 1; i < v.knots.size(); ++i)
    if (v.knots[i - 1] < v.knots[i] && !isSpan(v.knots[i] - v.knots[i - 1])) return false;
  size_t run = 0;
  for (size_t i = 0; i < v.knots.size(); ++i) {
    run = i > 0 && v.knots[i] == v.knots[i - 1] ? run + 1 : 1;
    if (v.knots[i] > v.from() && v.knots[i] < v.to() && run > p) return false;
  }
  return true;
}

uint32_t spanCount(const KnotVector& v) {
  uint32_t spans = 0;
  for (uint32_t k = v.degree; k < v.count(); ++k) spans += v.knots[k] < v.knots[k + 1];
  return spans;
}

BezierSpans::BezierSpans(const KnotVector& v) : degree_(v.degree) {
  const uint32_t p = degree_, size = p + 1, spans = spanCount(v);
  breaks_.reserve(spans + 1), firsts_.reserve(spans);
  factors_.reserve(size_t(spans) * size * size);
  double arguments[kMostDegree];
  for (uint32_t k = p; k < v.count(); ++k) {
    const double a = v.knots[k], b = v.knots[k + 1];
    if (!(a < b)) continue;
    breaks_.push_back(a);
    firsts_.push_back(k - p);
    const size_t at = factors_.size();
    factors_.resize(at + size_t(size) * size);
    // Bézier point j: the blossom at a, ..., a, b, ..., b with b j times.
    for (uint32_t j = 0; j < size; ++j) {
      for (uint32_t r = 0; r < p; ++r) arguments[r] = r < p - j ? a : b;
      blossom(p, &v.knots[k - p + 1], arguments, &factors_[at + size_t(j) * size]);
    }
  }
  breaks_.push_back(v.to());
}

ArrayView<const double> BezierSpans::factors(uint32_t span) const {
  const size_t size = size_t(degree_ + 1) * (degree_ + 1);
  return {factors_.data() + span * size, size};
}

uint32_t BezierSpans::spanAt(double t) const {
  const auto after = std::upper_bound(breaks_.begin() + 1, breaks_.end() - 1, t);
  return uint32_t(after - breaks_.begin()) - 1;
}

void Bernstein::firstAt(uint32_t degree, double x) {
  const double y = 1 - x;
  if (degree == 3) {
    const double xx = x * x, yy = y * y, xy = x * y;
    value[0] = yy * y, value[1] = 3 * x * yy, value[2] = 3 * xx * y, value[3] = xx * x;
    first[0] = -3 * yy, first[1] = 3 * yy - 6 * xy, first[2] = 6 * xy - 3 * xx, first[3] = 3 * xx;
    return;
  }
  // Degree by degree; the last step but one leaves what derivatives are made of.
  double once[kMostDegree + 1];
  value[0] = 1;
  for (uint32_t r = 1; r <= degree; ++r) {
    if (r == degree) std::copy(value, value + r, once);
    value[r] = x * value[r - 1];
    for (uint32_t j = r - 1; j > 0; --j) value[j] = y * value[j] + x * value[j - 1];
    value[0] *= y;
  }
  const double n = degree;
  first[0] = -n * once[0], first[degree] = n * once[degree - 1];
  for (uint32_t j = 1; j < degree; ++j) first[j] = n * (once[j - 1] - once[j]);
}

void Bernstein::at(uint32_t degree, double x) {
  // Degree by degree; the last two steps leave what derivatives are made of.
  double once[kMostDegree + 1], twice[kMostDegree + 1];
  value[0] = 1;
  for (uint32_t r = 1; r <= degree; ++r) {
    if (r == degree) std::copy(value, value + r, once);
    if (r + 1 == degree) std::copy(value, value + r, twice);
    value[r] = x * value[r - 1];
    for (uint32_t j = r - 1; j > 0; --j) value[j] = (1 - x) * value[j] + x * value[j - 1];
    value[0] *= 1 - x;
  }
  const double n = degree;
  for (uint32_t j = 0; j <= degree; ++j) {
    first[j] = n * ((j > 0 ? once[j - 1] : 0) - (j < degree ? once[j] : 0));
    if (degree < 2) {
      second[j] = 0;
      continue;
    }
    const double before = j > 1 ? twice[j - 2] : 0, at = j > 0 && j < degree ? twice[j - 1] : 0,
                 after = j + 1 < degree ? twice[j] : 0;
    second[j] = n * (n - 1) * (before - 2 * at + after);
  }
}

}  // namespace sf
