#include "loops/one_loop/angular_transform.h"

#include <algorithm>

#include "base/sort.h"

namespace sf {
namespace {

/// The opposite direction, in [-pi, pi].
double opposite(double theta) { return theta > 0 ? theta - kPi : theta + kPi; }

}  // namespace

void AngularTransform::apply(const double* innerTheta, const double* base, size_t inner,
                             const double* outerTheta, size_t outer, double* result) {
  const bool plainSum = !measure_.isWorst() && measure_.cap() >= kPi;
  if (plainSum && measure_.dihedralWeight() == 0) {
    std::fill(result, result + outer, inner ? *std::min_element(base, base + inner) : kInfinity);
  } else if (inner * outer <= (plainSum ? fewPairs : fewPairsCapped)) {
    allPairs(innerTheta, base, inner, outerTheta, outer, result);
  } else if (plainSum) {
    buckets(innerTheta, base, inner, outerTheta, outer, result);
  } else {
    ranges(innerTheta, base, inner, outerTheta, outer, result);
  }
}

void AngularTransform::applySorted(const double* innerTheta, const double* base, size_t inner,
                                   const double* outerTheta, size_t outer, double* result) {
  const double weight = measure_.dihedralWeight();
  if (measure_.isWorst() || measure_.cap() < kPi || weight == 0 || inner == 0) {
    apply(innerTheta, base, inner, outerTheta, outer, result);
    return;
  }
  // Opposite directions increase as well, if those of angles up to 0 are put after the others.
  size_t split = 0;
  while (split < outer && outerTheta[split] <= 0) ++split;
  const auto turned = [&](size_t j) { return j + split < outer ? j + split : j + split - outer; };
  double up = kInfinity, down = kInfinity;
  for (size_t i = 0; i < inner; ++i) {
    up = std::min(up, base[i] - weight * innerTheta[i]);
    down = std::min(down, base[i] + weight * innerTheta[i]);
  }
  // Goes from one direction to the next; at first `up` and `down` hold what comes round the circle.
  up += 2 * kPi * weight;
  down += 2 * kPi * weight;
  for (size_t j = 0, i = 0; j < outer; ++j) {
    const double at = opposite(outerTheta[turned(j)]);
    for (; i < inner && innerTheta[i] <= at; ++i)
      up = std::min(up, base[i] - weight * innerTheta[i]);
    result[turned(j)] = up + weight * at;
  }
  for (size_t j = outer, i = inner; j-- > 0;) {
    const double at = opposite(outerTheta[turned(j)]);
    for (; i > 0 && innerTheta[i - 1] >= at; --i)
      down = std::min(down, base[i - 1] + weight * innerTheta[i - 1]);
    double& best = result[turned(j)];
    best = std::min(best, down - weight * at);
  }
}

void AngularTransform::allPairs(const double* innerTheta, const double* base, size_t inner,
                                const double* outerTheta, size_t outer, double* result) const {
  if (measure_.isWorst() || measure_.cap() < kPi) {
    for (size_t j = 0; j < outer; ++j) {
      double best = kInfinity;
      for (size_t i = 0; i < inner; ++i) {
        const double w = measure_.join(base[i], measure_.pair(innerTheta[i], outerTheta[j]));
        best = w < best ? w : best;
      }
      result[j] = best;
    }
    return;
  }
  // Written out so that it vectorises over the outer triangles.
  const double weight = measure_.dihedralWeight();
  std::fill(result, result + outer, kInfinity);
  for (size_t i = 0; i < inner; ++i) {
    const double theta = innerTheta[i], b = base[i];
    for (size_t j = 0; j < outer; ++j) {
      const double w = b + weight * std::fabs(kPi - std::fabs(theta - outerTheta[j]));
      result[j] = w < result[j] ? w : result[j];
    }
  }
}

void AngularTransform::buckets(const double* innerTheta, const double* base, size_t inner,
                               const double* outerTheta, size_t outer, double* result) {
  const double weight = measure_.dihedralWeight();
  size_t count = 16;
  while (count < inner) count *= 2;
  const double scale = double(count) / (2 * kPi);
  const auto bucketOf = [&](double theta) {
    const double at = (theta + kPi) * scale;
    return at <= 0 ? size_t(0) : std::min(size_t(at), count - 1);
  };
  // Counting sort of the inner triangles by bucket.
  bucketStart_.assign(count + 1, 0);
  order_.resize(inner);
  for (size_t i = 0; i < inner; ++i) {
    order_[i] = uint32_t(bucketOf(innerTheta[i]));
    ++bucketStart_[order_[i] + 1];
  }
  for (size_t b = 0; b < count; ++b) bucketStart_[b + 1] += bucketStart_[b];
  theta_.resize(inner);
  base_.resize(inner);
  for (size_t i = inner; i-- > 0;) {
    // The start of a bucket serves as its end while it is filled from behind.
    const uint32_t at = --bucketStart_[order_[i] + 1];
    theta_[at] = innerTheta[i];
    base_[at] = base[i];
  }
  // bucketStart_[b + 1] is now where bucket b begins.
  bucketStart_.push_back(uint32_t(inner));
  const uint32_t* first = bucketStart_.data() + 1;

  // The least base - weight * theta over the buckets before, and base + weight * theta over those
  // after. What goes round the circle the other way comes from the ends.
  before_.resize(count + 1);
  after_.resize(count + 1);
  double least = kInfinity;
  for (size_t b = 0; b < count; ++b) {
    before_[b] = least;
    for (uint32_t i = first[b]; i < first[b + 1]; ++i)
      least = std::min(least, base_[i] - weight * theta_[i]);
  }
  const double allBefore = least + 2 * kPi * weight;
  least = kInfinity;
  for (size_t b = count; b-- > 0;) {
    after_[b] = least;
    for (uint32_t i = first[b]; i < first[b + 1]; ++i)
      least = std::min(least, base_[i] + weight * theta_[i]);
  }
  const double allAfter = least + 2 * kPi * weight;
  for (size_t j = 0; j < outer; ++j) {
    const double at = opposite(outerTheta[j]);
    const size_t b = bucketOf(at);
    double best = std::min(std::min(before_[b], allBefore) + weight * at,
                           std::min(after_[b], allAfter) - weight * at);
    for (uint32_t i = first[b]; i < first[b + 1]; ++i)
      best = std::min(best, base_[i] + weight * std::fabs(theta_[i] - at));
    result[j] = best;
  }
}

void AngularTransform::buildRangeMinima(std::vector<double>& levels) const {
  const size_t n = theta_.size();
  for (size_t width = 1; 2 * width <= n; width *= 2) {
    const size_t from = levels.size() - n;
    for (size_t i = 0; i < n; ++i)
      levels.push_back(std::min(levels[from + i], levels[from + std::min(i + width, n - 1)]));
  }
}

double AngularTransform::rangeMinimum(const std::vector<double>& levels, size_t first,
                                      size_t last) const {
  if (first >= last) return kInfinity;
  size_t level = 0;
  while ((size_t(2) << level) <= last - first) ++level;
  const double* at = &levels[level * theta_.size()];
  return std::min(at[first], at[last - (size_t(1) << level)]);
}

void AngularTransform::ranges(const double* innerTheta, const double* base, size_t inner,
                              const double* outerTheta, size_t outer, double* result) {
  // Three turns of the circle, sorted, so that no range wraps.
  order_.resize(inner);
  for (size_t i = 0; i < inner; ++i) order_[i] = uint32_t(i);
  sf::sort(order_.begin(), order_.end(),
           [&](uint32_t a, uint32_t b) { return innerTheta[a] < innerTheta[b]; });
  theta_.clear();
  before_.clear();
  after_.clear();
  const double weight = measure_.isWorst() ? 0 : measure_.dihedralWeight();
  for (int turn = -1; turn <= 1; ++turn) {
    for (const uint32_t i : order_) {
      const double theta = innerTheta[i] + turn * 2 * kPi;
      theta_.push_back(theta);
      before_.push_back(base[i] - weight * theta);
      after_.push_back(base[i] + weight * theta);
    }
  }
  buildRangeMinima(before_);
  buildRangeMinima(after_);
  const auto indexOf = [&](double theta) {
    return size_t(std::lower_bound(theta_.begin(), theta_.end(), theta) - theta_.begin());
  };
  for (size_t j = 0; j < outer; ++j) {
    const double at = opposite(outerTheta[j]);
    const size_t middle = indexOf(at);
    if (!measure_.isWorst()) {
      const double cap = measure_.cap();
      result[j] = std::min(
          rangeMinimum(before_, indexOf(at - cap), middle) + weight * at,
          rangeMinimum(after_, middle, indexOf(std::nextafter(at + cap, kInfinity))) - weight * at);
      continue;
    }
    // Going away from `at`, the distance grows and the least base so far falls: the least of their
    // maxima is where they cross.
    double best = kInfinity;
    size_t low = 0, reach = std::min(inner, middle);
    while (low < reach) {
      const size_t step = (low + reach) / 2;  // elements middle - 1 - step .. middle - 1
      const double distance = at - theta_[middle - 1 - step];
      const double least = rangeMinimum(before_, middle - 1 - step, middle);
      best = std::min(best, std::max(distance, least));
      if (distance < least)
        low = step + 1;
      else
        reach = step;
    }
    low = 0, reach = std::min(inner, theta_.size() - middle);
    while (low < reach) {
      const size_t step = (low + reach) / 2;
      const double distance = theta_[middle + step] - at;
      const double least = rangeMinimum(before_, middle, middle + step + 1);
      best = std::min(best, std::max(distance, least));
      if (distance < least)
        low = step + 1;
      else
        reach = step;
    }
    result[j] = best;
  }
}

}  // namespace sf
