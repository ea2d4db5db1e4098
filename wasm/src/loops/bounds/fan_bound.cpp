#include "loops/bounds/fan_bound.h"

#include <algorithm>

namespace sf {
namespace {

constexpr uint32_t kPatienceOfAscent = 12;  // steps without progress before they become shorter
constexpr double kShortestStride = 1e-7;    // of the bound, at which the ascent ends

}  // namespace

FanBound::FanBound(const LoopSet& loops, const CandidateSet& set,
                   const std::vector<double>& triangleCost, Measure measure, Work& work)
    : links_(loops, set),
      measure_(measure),
      work_(work),
      memory_(work),
      transform_(Measure::sum(0.5 * measure.dihedralWeight(), measure.cap())) {
  const uint32_t n = loops.vertexCount();
  const size_t c = set.size();
  if (!memory_.add(uint64_t(bytesFor(loops, set)))) return;
  triangleTotal_ = double(n) + 2.0 * loops.loopCount() - 4;
  third_.resize(c);
  for (size_t t = 0; t < c; ++t) third_[t] = triangleCost[t] / 3;
  multiplier_.assign(3 * c, 0);
  bestMultiplier_ = gradient_ = direction_ = multiplier_;
  used_.assign(3 * c, 0);

  size_t walks = 0, cheapest = 0;
  for (const Vertex& v : links_.vertices) {
    labels_.push_back({walks, cheapest});
    walks += size_t(v.longest) * v.spokeCount;
    cheapest += v.longest;
  }
  walks_.resize(walks);
  cheapest_.resize(cheapest);
  length_.assign(n, 0);
}

double FanBound::bytesFor(const LoopSet& loops, const CandidateSet& set) {
  std::vector<double> edges(loops.vertexCount(), 0), spokes(loops.vertexCount(), 0);
  for (size_t i = 0; i < set.edgeVertices.size(); ++i) {
    edges[set.edgeVertices[i]] += 1;
    spokes[set.edgeVertices[i]] += set.degree(uint32_t(i / 2));
  }
  double bytes = 240 * double(set.size());
  for (uint32_t v = 0; v < loops.vertexCount(); ++v) bytes += 8 * edges[v] * (spokes[v] + 1);
  return bytes;
}

/// The most by which rounding has lifted a bound. Large terms cancel in a cheap walk only if some
/// of them are negative: so these, and the bound itself, limit the size of partial sums.
double FanBound::rounding(double bound) const {
  const double terms = 3 * triangleTotal_;
  double most = std::max(std::fabs(price_), 0.5 * kPi * measure_.dihedralWeight());
  for (size_t corner = 0; corner < multiplier_.size(); ++corner)
    most = std::max(most, -(third_[corner / 3] + multiplier_[corner]));
  return std::numeric_limits<double>::epsilon() * (2 * terms + double(labels_.size())) *
         (std::fabs(bound) + terms * most);
}

/// The spoke from which the walk turned over into `left`.
uint32_t FanBound::arrivedFrom(const Vertex& v, const double* arrive, uint32_t left) const {
  uint32_t i = 0;
  while (links_.edges[v.firstEdge + i].firstSpoke + links_.edges[v.firstEdge + i].spokeCount <=
         left)
    ++i;
  const FanLinks::Edge& edge = links_.edges[v.firstEdge + i];
  const double* theta = &links_.theta[v.firstSpoke];
  uint32_t from = edge.firstSpoke;
  double best = kInfinity;
  for (uint32_t s = edge.firstSpoke; s < edge.firstSpoke + edge.spokeCount; ++s) {
    const double w = arrive[s] + 0.5 * measure_.pair(theta[s], theta[left]);
    if (w < best) best = w, from = s;
  }
  return from;
}

/// Labels of the cheapest walks of each length at a vertex: those to each spoke in walks_, those to
/// the loop edge where fans end in cheapest_. Prices of triangles are left out.
void FanBound::labelWalks(uint32_t vertex) {
  const Vertex& v = links_.vertices[vertex];
  double* cheapest = &cheapest_[labels_[vertex].firstCheapest];
  std::fill(cheapest, cheapest + v.longest, kInfinity);
  if (v.startEdge == kNone || v.endEdge == kNone) return;
  const uint32_t n = v.spokeCount;
  const FanLinks::Spoke* spokes = &links_.spokes[v.firstSpoke];
  const FanLinks::Edge& start = links_.edges[v.firstEdge + v.startEdge];
  const FanLinks::Edge& end = links_.edges[v.firstEdge + v.endEdge];
  leave_.assign(n, kInfinity);
  std::fill_n(leave_.begin() + start.firstSpoke, start.spokeCount, 0.0);
  for (uint32_t i = 0; i < v.longest; ++i) {
    double* arrive = &walks_[labels_[vertex].firstWalk + size_t(i) * n];
    for (uint32_t s = 0; s < n; ++s)
      arrive[spokes[s].partner] =
          leave_[s] + third_[spokes[s].corner / 3] + multiplier_[spokes[s].corner];
    cheapest[i] =
        *std::min_element(arrive + end.firstSpoke, arrive + end.firstSpoke + end.spokeCount);
    if (i + 1 < v.longest) links_.leave(v, arrive, transform_, leave_.data());
    if (!work_.tick(20 + 4 * n)) return;
  }
}

/// Chooses the length of each vertex's walk so that the total is right. The cost is the least that
/// a price on length can reach: finds the best price, and returns the cost with it.
double FanBound::shareOut() {
  const double wanted = 3 * triangleTotal_;
  // Sum of lengths of the walks that are cheapest at a price; the shortest or longest of ties.
  const auto choose = [&](double price, double& cost) {
    double total = 0;
    cost = -price * wanted;
    for (size_t i = 0; i < labels_.size(); ++i) {
      const Vertex& v = links_.vertices[i];
      const double* cheapest = &cheapest_[labels_[i].firstCheapest];
      double best = kInfinity;
      for (uint32_t l = 1; l <= v.longest; ++l) {
        const double w = cheapest[l - 1] + price * l;
        if (w < best) best = w, length_[i] = l;
      }
      if (best == kInfinity) return cost = kInfinity;
      cost += best;
      total += length_[i];
    }
    return total;
  };
  // The cost is concave in the price, with slope total - wanted: bisection, in a bracket around the
  // last price.
  const double reach = 0.1 * std::fabs(price_) + 1e-3 * stride_ / triangleTotal_;
  double low = price_ - reach, high = price_ + reach;
  double cost, best = -kInfinity;
  const auto tryPrice = [&](double price) {
    const double total = choose(price, cost);
    if (cost > best || cost == kInfinity) best = cost, price_ = price;
    return total - wanted;
  };
  for (int i = 0; i < 60 && tryPrice(low) < 0 && best < kInfinity; ++i) low -= high - low;
  for (int i = 0; i < 60 && tryPrice(high) > 0 && best < kInfinity; ++i) high += high - low;
  for (int i = 0; i < 40 && best < kInfinity && high - low > 1e-12 * std::fabs(low); ++i) {
    const double middle = 0.5 * (low + high);
    const double over = tryPrice(middle);
    if (over == 0) break;
    (over > 0 ? low : high) = middle;
  }
  if (best < kInfinity) choose(price_, cost);
  return best;
}

void FanBound::traceWalk(uint32_t vertex, uint32_t length) {
  const Vertex& v = links_.vertices[vertex];
  const uint32_t n = v.spokeCount;
  const FanLinks::Spoke* spokes = &links_.spokes[v.firstSpoke];
  const FanLinks::Edge& end = links_.edges[v.firstEdge + v.endEdge];
  const double* walks = &walks_[labels_[vertex].firstWalk];
  const double* last = walks + size_t(length - 1) * n;
  uint32_t s = uint32_t(
      std::min_element(last + end.firstSpoke, last + end.firstSpoke + end.spokeCount) - last);
  for (uint32_t left = length;; --left) {
    const uint32_t corner = spokes[s].corner;
    if (used_[corner]++ == 0) usedCorners_.push_back(corner);
    if (left == 1) return;
    s = arrivedFrom(v, walks + size_t(left - 2) * n, spokes[s].partner);
  }
}

double FanBound::evaluate() {
  for (uint32_t v = 0; v < labels_.size(); ++v) labelWalks(v);
  if (!work_.going()) return best_;
  const double bound = shareOut();
  for (const uint32_t corner : usedCorners_) used_[corner] = 0;
  usedCorners_.clear();
  if (bound == kInfinity) return bound;
  for (uint32_t v = 0; v < labels_.size(); ++v) traceWalk(v, length_[v]);
  return bound - rounding(bound);
}

/// How the corners of each triangle disagree.
void FanBound::gradient() {
  std::fill(gradient_.begin(), gradient_.end(), 0.0);
  for (const uint32_t corner : usedCorners_) {
    const size_t first = corner - corner % 3;
    const double mean = (used_[first] + used_[first + 1] + used_[first + 2]) / 3.0;
    for (size_t i = 0; i < 3; ++i) gradient_[first + i] = used_[first + i] - mean;
  }
}

bool FanBound::ascend(uint32_t steps, double target) {
  if (stride_ == 0) {
    // The first aim is a share of what a surface of average triangles would cost.
    double sum = 0;
    size_t count = 0;
    for (const double third : third_)
      if (third < kInfinity) sum += 3 * third, ++count;
    stride_ =
        0.1 * triangleTotal_ * ((count ? sum / double(count) : 0) + measure_.dihedralWeight());
  }
  for (uint32_t i = 0; i < steps; ++i) {
    double bound = evaluate();
    if (!work_.going()) return false;
    if (bound == kInfinity) {
      best_ = kInfinity;
      return true;
    }
    if (bound > best_ + 0.02 * stride_)
      idle_ = 0;
    else
      ++idle_;
    if (bound > best_) {
      best_ = bound;
      bestMultiplier_ = multiplier_;
      bestPrice_ = price_;
      bestRounding_ = rounding(bound);
    }
    if (idle_ > kPatienceOfAscent) {
      idle_ = 0;
      stride_ *= 0.6;
      multiplier_ = bestMultiplier_;
      std::fill(direction_.begin(), direction_.end(), 0.0);
      bound = evaluate();
      if (bound == kInfinity || !work_.going()) return work_.going();
    }
    gradient();
    double gg = 0, gd = 0, dd = 0;
    for (size_t j = 0; j < gradient_.size(); ++j) {
      gg += gradient_[j] * gradient_[j];
      gd += gradient_[j] * direction_[j];
      dd += direction_[j] * direction_[j];
    }
    if (gg < 1e-12 || best_ >= target || stride_ < kShortestStride * std::fabs(best_)) return true;
    // Deflection (Camerini, Fratta, Maffioli 1975): no step undoes the last one. If that would turn
    // the step against the gradient, the last one went too far, and only the gradient counts.
    const double keep = gd < 0 && 1.5 * gd * gd < gg * dd ? -1.5 * gd / dd : 0;
    dd = 0;
    for (size_t j = 0; j < gradient_.size(); ++j) {
      direction_[j] = gradient_[j] + keep * direction_[j];
      dd += direction_[j] * direction_[j];
    }
    const double step = (std::min(target, best_ + stride_) - bound) / dd;
    for (size_t j = 0; j < multiplier_.size(); ++j) multiplier_[j] += step * direction_[j];
  }
  return true;
}

FanCosts FanBound::costs() const {
  FanCosts costs;
  costs.corner.resize(bestMultiplier_.size());
  for (size_t corner = 0; corner < costs.corner.size(); ++corner)
    costs.corner[corner] = third_[corner / 3] + bestMultiplier_[corner] + bestPrice_;
  costs.price = bestPrice_;
  costs.lowerBound = best_;
  costs.rounding = bestRounding_;
  return costs;
}

}  // namespace sf
