// A tree over the edges of rims, for the partner of an edge that a fair surface leads to at least cost.
#pragma once
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
  double turn = 0;      // radians that the straight way bends at its two ends
  double rotation = 0;  // radians by which the frames are rotated against each other
  double cost = std::numeric_limits<double>::infinity();  // logarithm
};

/// A rim as a ball around the middles of its edges.
struct RimBall {
  Vec3 centre;
  double radius;
};

/// Trees of balls: one over the rims, and in it one over the edges of each rim.
class RimTree {
 public:
  explicit RimTree(Work& work) : work_(work), charge_(work) {}

  /// Keeps views of all. O(r log r). False once the work has to end.
  ///   sides   [e] of all rims
  ///   starts  [k+1] in `sides`
  ///   balls   [k]
  bool build(ArrayView<const RimSide> sides, ArrayView<const uint32_t> starts,
             ArrayView<const RimBall> balls);

  /// The partner of least cost of an edge: not itself or, on rims of more than five edges, one beside
  /// it; and on rims not farther from its own than `reach`, centre to ball. kNone if there is none.
  /// Cost is L exp(a + b + w): L is the distance of the middles, a and b are the angles of the
  /// straight line with the surfaces at its ends, w is the rotation between the frames.
  /// Of equal ones, the first that is found. The work may have ended.
  ///   own  the partner on its own rim
  RimPartner best(uint32_t edge, double reach, RimPartner& own);

 private:
  /// An inner node's children are the next node and `first`.
  struct Node {
    Vec3 centre;
    double radius;
    uint32_t first, count;  // sides in order_; or count 0
  };
  /// A leaf is one rim: then `second` is kNone, and `rim` is its number.
  struct RimNode {
    Vec3 centre;  // of a ball around all edges
    double radius;
    Vec3 rimsCentre;  // of a ball around the rims' centres
    double rimsRadius;
    double largest;  // radius of a rim
    uint32_t second, rim;
  };
  struct Pending {
    uint32_t node;
    double bound;
  };

  static double bound(const RimSide& from, Vec3 centre, double radius);
  void searchRim(uint32_t edge, uint32_t rim, RimPartner& best);
  uint32_t splitEdges(uint32_t first, uint32_t count);
  uint32_t splitRims(uint32_t first, uint32_t count);

  Work& work_;
  Charge charge_;
  ArrayView<const RimSide> sides_;
  ArrayView<const uint32_t> starts_;
  ArrayView<const RimBall> balls_;
  std::vector<uint32_t> order_;     // [e] edges, rim by rim
  std::vector<uint32_t> rimOrder_;  // [k]
  std::vector<uint32_t> roots_;     // [k] of each rim's tree
  std::vector<Node> nodes_;
  std::vector<RimNode> rimNodes_;
  std::vector<Pending> rimStack_, stack_;
  uint32_t visits_ = 0;
};

}  // namespace sf
