// A tree over the edges of rims, for the partner of an edge that a fair surface leads to at least cost.
#pragma once
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/array_view.h"
#include "base/charge.h"
#include "base/vec.h"

namespace sf {

/// An edge of a rim with its frame.
struct RimSide {
  Vec3 at;      // its middle
  Vec3 ahead;   // unit, on the surface, away from the face: into the hole
  Vec3 normal;  // unit, of the face
  Vec3 along;   // ahead x normal
  uint32_t rim;
};

struct RimPartner {
  uint32_t edge = kNone;
  double turn = 0;  // radians that the straight way bends at its two ends
  double cost = std::numeric_limits<double>::infinity();  // logarithm
};

/// The logarithm of L exp(a + b + w): L is the distance of the middles, a and b are the angles
/// of the straight line with the surfaces at its ends, w is the angle by which the frames are
/// rotated against each other. -infinity at distance 0.
inline RimPartner costBetween(const RimSide& p, const RimSide& q, uint32_t edge, double least) {
  RimPartner result{edge, 0, std::numeric_limits<double>::infinity()};
  const Vec3 d = q.at - p.at;
  const double l = length(d);
  const auto angle = [](double cosine) {
    return std::acos(cosine < -1 ? -1 : cosine > 1 ? 1 : cosine);
  };
  double cost = std::log(l);
  if (!(cost < least)) return result;
  const double scale = l > 0 ? 1 / l : 0;
  const double a = angle(scale * dot(d, p.ahead));
  if (!(cost + a < least)) return result;
  result.turn = a + angle(-scale * dot(d, q.ahead));
  cost += result.turn;
  if (!(cost < least)) return result;
  // The trace of the rotation between the frames.
  const double trace =
      -dot(p.ahead, q.ahead) + dot(p.normal, q.normal) - dot(p.along, q.along);
  result.cost = cost + angle((trace - 1) / 2);
  return result;
}

class RimTree {
 public:
  explicit RimTree(Work& work) : work_(work), charge_(work) {}

  /// Keeps a view of the sides. O(r log r). False once the work has to end.
  bool build(ArrayView<const RimSide> sides);

  /// The partner of least cost of an edge, among those that `isAllowed(edge)`; of equal ones the first.
  /// The work may have ended.
  template <class IsAllowed>
  RimPartner best(uint32_t edge, IsAllowed isAllowed) {
    RimPartner best;
    const RimSide& from = sides_[edge];
    stack_.clear();
    if (!nodes_.empty()) stack_.push_back({0, bound(from, nodes_[0])});
    uint32_t visited = 0;
    while (!stack_.empty()) {
      const Pending top = stack_.back();
      stack_.pop_back();
      if (top.bound > best.cost) continue;
      ++visited;
      const Node& node = nodes_[top.node];
      if (node.count == 0) {
        const Pending one{top.node + 1, bound(from, nodes_[top.node + 1])};
        const Pending other{node.first, bound(from, nodes_[node.first])};
        const bool oneFirst = one.bound <= other.bound;
        stack_.push_back(oneFirst ? other : one);
        stack_.push_back(oneFirst ? one : other);
        continue;
      }
      for (uint32_t i = node.first; i < node.first + node.count; ++i) {
        const uint32_t f = order_[i];
        const RimPartner found = costBetween(from, sides_[f], f, best.cost);
        const bool isBetter =
            found.cost < best.cost || (found.cost == best.cost && f < best.edge);
        if (isBetter && isAllowed(f)) best = found;
      }
    }
    work_.tick(visited * 100);
    return best;
  }

 private:
  /// A ball around sides. An inner node's children are the next node and `first`.
  struct Node {
    Vec3 centre;
    double radius;
    uint32_t first, count;  // sides in order_; or count 0
  };
  struct Pending {
    uint32_t node;
    double bound;
  };

  /// No side in the node costs less.
  static double bound(const RimSide& from, const Node& node) {
    const Vec3 d = node.centre - from.at;
    const double l = length(d);
    if (l <= node.radius) return -std::numeric_limits<double>::infinity();
    double cosine = dot(d, from.ahead) / l;
    cosine = cosine < -1 ? -1 : cosine > 1 ? 1 : cosine;
    const double a = std::acos(cosine) - std::asin(node.radius / l);
    // A little less, for rounding.
    return std::log(l - node.radius) + (a > 0 ? a : 0) - 1e-9;
  }
  uint32_t split(uint32_t first, uint32_t count);

  Work& work_;
  Charge charge_;
  ArrayView<const RimSide> sides_;
  std::vector<uint32_t> order_;
  std::vector<Node> nodes_;
  std::vector<Pending> stack_;
};

}  // namespace sf
