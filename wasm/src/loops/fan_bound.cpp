#include "loops/fan_bound.h"

#include <algorithm>

namespace sf {
namespace {

constexpr uint32_t kPatienceOfAscent = 12;  // steps without progress before they become shorter
constexpr double kShortestStride = 1e-7;    // of the bound, at which the ascent ends

/// At most how far rounding has lifted a bound. Large terms cancel in a cheap walk only if some of
/// them are negative: those, and the bound itself, say how large partial sums can be.
///   terms, vertices  how many are added up
double liftByRounding(double bound, double terms, double vertices, double price, double angleWeight,
                      const std::vector<double>& third, const std::vector<double>& multiplier) {
  double most = std::max(std::fabs(price), 0.5 * kPi * angleWeight);
  for (size_t corner = 0; corner < multiplier.size(); ++corner)
    most = std::max(most, -(third[corner / 3] + multiplier[corner]));
  return std::numeric_limits<double>::epsilon() * (2 * terms + vertices) *
         (std::fabs(bound) + terms * most);
}

}  // namespace

FanBound::FanBound(const LoopSet& loops, const CandidateSet& set,
                   const std::vector<double>& triangleCost, Measure measure, Work& work)
    : set_(set),
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

  // Edges at each vertex, at both of their ends.
  std::vector<uint32_t> first(n + 1, 0);
  for (const uint32_t v : set.edgeVertices) ++first[v + 1];
  for (uint32_t v = 0; v < n; ++v) first[v + 1] += first[v];
  std::vector<uint32_t> incident(set.edgeVertices.size()), cursor(first.begin(), first.end() - 1);
  for (uint32_t e = 0; e < set.edgeCount(); ++e)
    for (int end = 0; end < 2; ++end) incident[cursor[set.edgeVertices[2 * size_t(e) + end]]++] = e;

  std::vector<uint32_t> spokeOfSlot(set.slotTriangle.size());
  spokes_.reserve(6 * c);
  size_t walks = 0, cheapest = 0;
  for (uint32_t v = 0; v < n; ++v) {
    Vertex vertex{};
    vertex.firstSpoke = spokes_.size();
    vertex.firstEdge = uint32_t(edges_.size());
    vertex.edgeCount = first[v + 1] - first[v];
    vertex.startEdge = vertex.endEdge = kNone;
    for (uint32_t i = first[v]; i < first[v + 1]; ++i) {
      const uint32_t e = incident[i];
      if (e == set.loopEdges[loops.previous(v)]) vertex.startEdge = i - first[v];
      if (e == set.loopEdges[v]) vertex.endEdge = i - first[v];
      edges_.push_back({vertex.spokeCount, set.degree(e), set.isLoopEdge[e] != 0});
      for (uint32_t s = set.edgeSlots[e]; s < set.edgeSlots[e + 1]; ++s) {
        spokeOfSlot[s] = vertex.spokeCount++;
        const uint32_t t = set.slotTriangle[s];
        spokes_.push_back({3 * t + set.corner(t, v), 0});
        theta_.push_back(set.slotTheta[s]);
      }
    }
    for (uint32_t i = first[v]; i < first[v + 1]; ++i) {
      const uint32_t e = incident[i];
      const uint32_t u = set.edgeVertices[2 * size_t(e)] == v ? set.edgeVertices[2 * size_t(e) + 1]
                                                              : set.edgeVertices[2 * size_t(e)];
      for (uint32_t s = set.edgeSlots[e]; s < set.edgeSlots[e + 1]; ++s)
        spokes_[vertex.firstSpoke + spokeOfSlot[s]].partner =
            spokeOfSlot[set.slotOpposite(set.slotTriangle[s], u)];
    }
    // A fan passes each edge at most once.
    vertex.longest = vertex.edgeCount ? vertex.edgeCount - 1 : 0;
    vertex.firstWalk = walks;
    vertex.firstCheapest = cheapest;
    walks += size_t(vertex.longest) * vertex.spokeCount;
    cheapest += vertex.longest;
    vertices_.push_back(vertex);
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

/// out[s] = the least over the edge's spokes of arriving there and turning over into s. Turning back
/// into the same triangle costs a fold and only loosens the bound.
void FanBound::leave(const Vertex& v, const double* arrive, double* out) {
  for (uint32_t i = 0; i < v.edgeCount; ++i) {
    const Edge& edge = edges_[v.firstEdge + i];
    const uint32_t first = edge.firstSpoke, count = edge.spokeCount;
    // A fan ends where it comes to a loop edge.
    if (edge.onLoop || std::all_of(arrive + first, arrive + first + count,
                                   [](double w) { return w == kInfinity; })) {
      std::fill(out + first, out + first + count, kInfinity);
      continue;
    }
    const double* theta = &theta_[v.firstSpoke + first];
    transform_.apply(theta, arrive + first, count, theta, count, out + first);
  }
}

/// The spoke from which the walk turned over into `left`.
uint32_t FanBound::arrivedFrom(const Vertex& v, const double* arrive, uint32_t left) const {
  uint32_t i = 0;
  while (edges_[v.firstEdge + i].firstSpoke + edges_[v.firstEdge + i].spokeCount <= left) ++i;
  const Edge& edge = edges_[v.firstEdge + i];
  const double* theta = &theta_[v.firstSpoke];
  uint32_t from = edge.firstSpoke;
  double best = kInfinity;
  for (uint32_t s = edge.firstSpoke; s < edge.firstSpoke + edge.spokeCount; ++s) {
    const double w = arrive[s] + 0.5 * measure_.pair(theta[s], theta[left]);
    if (w < best) best = w, from = s;
  }
  return from;
}

/// Labels of the cheapest walks of each length at a vertex: in walks_ to each spoke, in cheapest_ to
/// the loop edge where fans end. Prices of triangles are left out.
void FanBound::labelWalks(const Vertex& v) {
  double* cheapest = &cheapest_[v.firstCheapest];
  std::fill(cheapest, cheapest + v.longest, kInfinity);
  if (v.startEdge == kNone || v.endEdge == kNone) return;
  const uint32_t n = v.spokeCount;
  const Spoke* spokes = &spokes_[v.firstSpoke];
  const Edge& start = edges_[v.firstEdge + v.startEdge];
  const Edge& end = edges_[v.firstEdge + v.endEdge];
  leave_.assign(n, kInfinity);
  std::fill_n(leave_.begin() + start.firstSpoke, start.spokeCount, 0.0);
  for (uint32_t i = 0; i < v.longest; ++i) {
    double* arrive = &walks_[v.firstWalk + size_t(i) * n];
    for (uint32_t s = 0; s < n; ++s)
      arrive[spokes[s].partner] =
          leave_[s] + third_[spokes[s].corner / 3] + multiplier_[spokes[s].corner];
    cheapest[i] =
        *std::min_element(arrive + end.firstSpoke, arrive + end.firstSpoke + end.spokeCount);
    if (i + 1 < v.longest) leave(v, arrive, leave_.data());
    if (!work_.tick(20 + 4 * n)) return;
  }
}

/// Chooses the length of each vertex's walk such that the total is right and the cost is least, as
/// far as a price on length can tell: the best price, and the cost with it.
double FanBound::shareOut() {
  const double wanted = 3 * triangleTotal_;
  // Sum of lengths of the walks that are cheapest at a price; the shortest or longest of ties.
  const auto choose = [&](double price, double& cost) {
    double total = 0;
    cost = -price * wanted;
    for (size_t i = 0; i < vertices_.size(); ++i) {
      const Vertex& v = vertices_[i];
      const double* cheapest = &cheapest_[v.firstCheapest];
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

void FanBound::traceWalk(const Vertex& v, uint32_t length) {
  const uint32_t n = v.spokeCount;
  const Spoke* spokes = &spokes_[v.firstSpoke];
  const Edge& end = edges_[v.firstEdge + v.endEdge];
  const double* walks = &walks_[v.firstWalk];
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
  for (const Vertex& v : vertices_) labelWalks(v);
  if (!work_.going()) return best_;
  const double bound = shareOut();
  for (const uint32_t corner : usedCorners_) used_[corner] = 0;
  usedCorners_.clear();
  if (bound == kInfinity) return bound;
  for (size_t i = 0; i < vertices_.size(); ++i) traceWalk(vertices_[i], length_[i]);
  return bound - liftByRounding(bound, 3 * triangleTotal_, double(vertices_.size()), price_,
                                measure_.dihedralWeight(), third_, multiplier_);
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
    // The first aim is of the size of what a surface of middling triangles costs.
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
    // Deflection (Camerini, Fratta, Maffioli 1975): no step undoes the last one. Where that would
    // turn it against the gradient, the last one went too far, and the gradient alone serves.
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

bool FanBound::excess(std::vector<double>& excess) {
  multiplier_ = bestMultiplier_;
  price_ = bestPrice_;
  excess.assign(set_.size(), 0);
  std::vector<double> to, from, entering, turned, through(set_.size());
  for (const Vertex& v : vertices_) {
    const uint32_t n = v.spokeCount;
    const Spoke* spokes = &spokes_[v.firstSpoke];
    labelWalks(v);
    if (!work_.going()) return false;
    // to: the cheapest walk, price included, that arrives at each spoke.
    to.assign(n, kInfinity);
    double best = kInfinity;
    for (uint32_t l = 1; l <= v.longest && v.endEdge != kNone && v.startEdge != kNone; ++l) {
      const double* arrive = &walks_[v.firstWalk + size_t(l - 1) * n];
      for (uint32_t s = 0; s < n; ++s) to[s] = std::min(to[s], arrive[s] + price_ * l);
      best = std::min(best, cheapest_[v.firstCheapest + l - 1] + price_ * l);
    }
    if (best == kInfinity) {
      std::fill(excess.begin(), excess.end(), kInfinity);
      return work_.going();
    }
    // from: the cheapest that goes on from there to the end; a walk backwards.
    const Edge& end = edges_[v.firstEdge + v.endEdge];
    from.assign(n, kInfinity);
    entering.resize(n);
    turned.resize(n);
    std::fill_n(from.begin() + end.firstSpoke, end.spokeCount, 0.0);
    for (uint32_t l = 1; l < v.longest; ++l) {
      for (uint32_t s = 0; s < n; ++s)
        entering[s] = from[spokes[s].partner] + third_[spokes[s].corner / 3] +
                      multiplier_[spokes[s].corner] + price_;
      if (!work_.tick(20 + 6 * n)) return false;
      leave(v, entering.data(), turned.data());
      bool progress = false;
      for (uint32_t s = 0; s < n; ++s)
        if (turned[s] < from[s]) from[s] = turned[s], progress = true;
      if (!progress) break;
    }
    for (uint32_t s = 0; s < n; ++s) through[spokes[s].corner / 3] = kInfinity;
    for (uint32_t s = 0; s < n; ++s) {
      double& at = through[spokes[s].corner / 3];
      at = std::min(at, to[s] + from[s]);
    }
    for (uint32_t s = 0; s < n; ++s)
      if (s < spokes[s].partner)
        excess[spokes[s].corner / 3] += std::max(0.0, through[spokes[s].corner / 3] - best);
  }
  return true;
}

}  // namespace sf
