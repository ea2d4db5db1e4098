#include "mesh/rim_tree.h"

#include <algorithm>
#include <cmath>

#include "base/atan2.h"
#include "base/sort.h"

namespace sf {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr uint32_t kLeaf = 8;
/// Nodes that the search for one partner looks at. Rims of holes need some hundred; more
/// are needed among thousands of things that cross each other.
constexpr uint32_t kMostVisits = 2000;

double angleOf(double cosine) {
  const double square = 1 - cosine * cosine;
  return fastAtan2(square > 0 ? std::sqrt(square) : 0, cosine);
}

/// The places of things in an array: one type for all, so that selecting is compiled once.
struct Places {
  const Vec3* first;
  size_t stride;  // in bytes

  Vec3 operator()(uint32_t i) const {
    return *reinterpret_cast<const Vec3*>(reinterpret_cast<const char*>(first) + i * stride);
  }
};

/// Puts half of the items, by the longest side of the box around their places, in front.
void halve(uint32_t* items, uint32_t count, Vec3 size, Places placeOf) {
  double Vec3::*const axis = size.x >= size.y && size.x >= size.z ? &Vec3::x
                             : size.y >= size.z                   ? &Vec3::y
                                                                  : &Vec3::z;
  sf::select(items, items + count / 2, items + count, [&](uint32_t i, uint32_t j) {
    const double a = placeOf(i).*axis, b = placeOf(j).*axis;
    return a != b ? a < b : i < j;
  });
}

struct Box {
  Vec3 low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
  void add(Vec3 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  Vec3 centre() const { return 0.5 * (low + high); }
};

/// The cost of a partner as a logarithm, or infinity if that is not less than `least`.
RimPartner costBetween(const RimSide& p, const RimSide& q, uint32_t edge, double least) {
  RimPartner result;
  result.edge = edge;
  const Vec3 d = q.at - p.at;
  const double l = length(d);
  double cost = std::log(l);
  if (!(cost < least)) return result;
  const double scale = l > 0 ? 1 / l : 0;
  const double a = angleOf(scale * dot(d, p.ahead));
  if (!(cost + a < least)) return result;
  result.turn = a + angleOf(-scale * dot(d, q.ahead));
  cost += result.turn;
  if (!(cost < least)) return result;
  // The trace of the rotation between the frames ahead, normal, along at p and turned about at q.
  const double trace = -dot(p.ahead, q.ahead) + dot(p.normal, q.normal) - dot(p.along, q.along);
  result.rotation = angleOf(std::max(-1.0, std::min(1.0, (trace - 1) / 2)));
  result.cost = cost + result.rotation;
  return result;
}

}  // namespace

bool RimTree::build(ArrayView<const RimSide> sides, ArrayView<const uint32_t> starts,
                    ArrayView<const RimBall> balls) {
  sides_ = sides, starts_ = starts, balls_ = balls;
  const uint64_t n = sides.size(), k = balls.size();
  if (!charge_.add(n * (sizeof(uint32_t) + sizeof(Node)) +
                   k * (2 * sizeof(uint32_t) + sizeof(Node) + 2 * sizeof(RimNode))) ||
      !work_.tick(uint32_t(std::min<uint64_t>(n * 200, 1u << 30))))
    return false;
  order_.resize(n), rimOrder_.resize(k), roots_.resize(k);
  nodes_.clear(), rimNodes_.clear();
  nodes_.reserve(n / 2 + k), rimNodes_.reserve(2 * k);
  for (uint32_t i = 0; i < n; ++i) order_[i] = i;
  for (uint32_t r = 0; r < k; ++r) {
    rimOrder_[r] = r;
    roots_[r] = splitEdges(starts[r], starts[r + 1] - starts[r]);
  }
  if (k > 0) splitRims(0, uint32_t(k));
  return true;
}

/// Makes the node of some edges of a rim, and those below it; returns its number.
uint32_t RimTree::splitEdges(uint32_t first, uint32_t count) {
  Box box;
  for (uint32_t i = first; i < first + count; ++i) box.add(sides_[order_[i]].at);
  Node node{box.centre(), 0, first, count};
  for (uint32_t i = first; i < first + count; ++i)
    node.radius = std::max(node.radius, distance(node.centre, sides_[order_[i]].at));
  const uint32_t number = uint32_t(nodes_.size());
  nodes_.push_back(node);
  if (count <= kLeaf) return number;
  halve(&order_[first], count, box.high - box.low, {&sides_[0].at, sizeof(RimSide)});
  splitEdges(first, count / 2);
  const uint32_t second = splitEdges(first + count / 2, count - count / 2);
  nodes_[number].first = second, nodes_[number].count = 0;
  return number;
}

/// The same for rims.
uint32_t RimTree::splitRims(uint32_t first, uint32_t count) {
  Box box, centres;
  RimNode node{{}, 0, {}, 0, 0, kNone, rimOrder_[first]};
  for (uint32_t i = first; i < first + count; ++i) {
    centres.add(balls_[rimOrder_[i]].centre);
    box.add(nodes_[roots_[rimOrder_[i]]].centre);
  }
  node.centre = box.centre(), node.rimsCentre = centres.centre();
  for (uint32_t i = first; i < first + count; ++i) {
    const uint32_t r = rimOrder_[i];
    const Node& root = nodes_[roots_[r]];
    node.radius = std::max(node.radius, distance(node.centre, root.centre) + root.radius);
    node.rimsRadius = std::max(node.rimsRadius, distance(node.rimsCentre, balls_[r].centre));
    node.largest = std::max(node.largest, balls_[r].radius);
  }
  const uint32_t number = uint32_t(rimNodes_.size());
  rimNodes_.push_back(node);
  if (count == 1) return number;
  halve(&rimOrder_[first], count, centres.high - centres.low, {&balls_[0].centre, sizeof(RimBall)});
  splitRims(first, count / 2);
  const uint32_t second = splitRims(first + count / 2, count - count / 2);
  rimNodes_[number].second = second;
  return number;
}

/// No edge with its middle in the ball costs less.
double RimTree::bound(const RimSide& from, Vec3 centre, double radius) {
  const Vec3 d = centre - from.at;
  const double l = length(d);
  if (l <= radius) return -kInfinity;
  const double a =
      angleOf(dot(d, from.ahead) / l) - fastAtan2(radius, std::sqrt(l * l - radius * radius));
  // A little less, for rounding.
  return std::log(l - radius) + (a > 0 ? a : 0) - 1e-9;
}

RimPartner RimTree::best(uint32_t edge, double reach, RimPartner& own) {
  RimPartner best;
  visits_ = 0;
  const RimSide& from = sides_[edge];
  const Vec3 centre = balls_[from.rim].centre;
  searchRim(edge, from.rim, best);
  own = best;
  rimStack_.clear();
  const auto pushRims = [&](uint32_t number) {
    const RimNode& node = rimNodes_[number];
    if (distance(centre, node.rimsCentre) - node.rimsRadius - node.largest > reach) return;
    const double least = bound(from, node.centre, node.radius);
    if (least < best.cost) rimStack_.push_back({number, least});
  };
  pushRims(0);
  while (!rimStack_.empty() && visits_ < kMostVisits) {
    const Pending top = rimStack_.back();
    rimStack_.pop_back();
    if (!(top.bound < best.cost)) continue;
    ++visits_;
    const RimNode& node = rimNodes_[top.node];
    if (node.second != kNone) {
      const size_t before = rimStack_.size();
      pushRims(top.node + 1);
      pushRims(node.second);
      // The nearer one comes first.
      if (rimStack_.size() == before + 2 && rimStack_[before].bound < rimStack_[before + 1].bound)
        std::swap(rimStack_[before], rimStack_[before + 1]);
    } else if (node.rim != from.rim &&
               distance(centre, balls_[node.rim].centre) - balls_[node.rim].radius <= reach) {
      searchRim(edge, node.rim, best);
    }
  }
  work_.tick(visits_ * 100);
  return best;
}

void RimTree::searchRim(uint32_t edge, uint32_t rim, RimPartner& best) {
  const RimSide& from = sides_[edge];
  const uint32_t n = starts_[rim + 1] - starts_[rim];
  const auto isAllowed = [&](uint32_t f) {
    if (rim != from.rim) return true;
    const uint32_t apart = edge > f ? edge - f : f - edge;
    return apart != 0 && (n <= 5 || (apart != 1 && apart != n - 1));
  };
  stack_.clear();
  stack_.push_back({roots_[rim], -kInfinity});
  while (!stack_.empty() && visits_ < kMostVisits) {
    const Pending top = stack_.back();
    stack_.pop_back();
    if (!(top.bound < best.cost)) continue;
    ++visits_;
    const Node& node = nodes_[top.node];
    if (node.count == 0) {
      const auto pendingOf = [&](uint32_t i) {
        return Pending{i, bound(from, nodes_[i].centre, nodes_[i].radius)};
      };
      const Pending one = pendingOf(top.node + 1), other = pendingOf(node.first);
      const bool oneFirst = one.bound <= other.bound;
      stack_.push_back(oneFirst ? other : one);
      stack_.push_back(oneFirst ? one : other);
      continue;
    }
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (!isAllowed(order_[i])) continue;
      const RimPartner found = costBetween(from, sides_[order_[i]], order_[i], best.cost);
      if (found.cost < best.cost) best = found;
    }
  }
}

}  // namespace sf
