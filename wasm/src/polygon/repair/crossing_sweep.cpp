#include "polygon/repair/crossing_sweep.h"

#include <algorithm>

#include "base/predicates.h"
#include "base/turn.h"
#include "polygon/repair/crossing_point.h"
#include "polygon/sweep/segment_order.h"

namespace sf {
namespace {

constexpr uint32_t kUnitsPerEvent = 500, kUnitsPerCrossing = 5000;

class Sweep {
 public:
  Sweep(ArrayView<const Point2> at, ArrayView<const WeightedEdge> edges, size_t most, Work& work,
        Charge& charge, Crossings& result)
      : at_(at),
        edges_(edges),
        most_(most),
        work_(work),
        charge_(charge),
        ownCharge_(work),
        result_(result) {}

  bool run() {
    const size_t e = edges_.size();
    if (!ownCharge_.add(SegmentOrder::bytes(e)) || !reserve(result_.winding, e, charge_) ||
        !reserve(result_.left, e, charge_))
      return false;
    order_.reset(e);
    result_.crossings.clear(), result_.cuts.clear();
    result_.winding.assign(e, 0), result_.left.assign(e, kNone);
    while ((vertex_ < at_.size() || !pending_.empty()) && result_.cuts.size() <= most_)
      if (!work_.tick(kUnitsPerEvent) || !pass()) return false;
    return true;
  }

 private:
  /// Two edges that will cross, and where.
  struct Pending {
    uint32_t first, second;
    Point2 at;
  };

  Line line(uint32_t e) const { return {at_[edges_[e].low], at_[edges_[e].high]}; }
  CrossingPoint exact(const Pending& p) const { return {line(p.first), line(p.second), p.at}; }

  bool takePending() {
    std::pop_heap(pending_.begin(), pending_.end(), Later{*this});
    crossing_ = pending_.back();
    pending_.pop_back();
    return work_.tick(kUnitsPerCrossing);
  }

  /// Finds the next event: a vertex, or a crossing if there is one before it.
  bool next() {
    isVertex_ = pending_.empty();
    if (!isVertex_ && vertex_ < at_.size()) {
      const int order = compare(exact(pending_.front()), at_[vertex_]);
      isVertex_ = order >= 0;
      // The same pair of edges, or others through the point, may be waiting as well.
      while (!pending_.empty() && order == 0 && compare(exact(pending_.front()), at_[vertex_]) == 0)
        if (!takePending()) return false;
    }
    if (isVertex_) return true;
    if (!takePending()) return false;
    const CrossingPoint here = exact(crossing_);
    const Pending first = crossing_;
    while (!pending_.empty() && compare(exact(pending_.front()), here) == 0)
      if (!takePending()) return false;
    crossing_ = first;
    return true;
  }

  /// Positive if the event is left of an edge, negative right, 0 on it.
  int side(uint32_t e) const {
    if (!isVertex_) return sideOf(line(e), exact(crossing_));
    if (edges_[e].high == vertex_) return 0;
    const double s = turn(at_[edges_[e].low], at_[edges_[e].high], at_[vertex_]);
    return s > 0 ? 1 : s < 0 ? -1 : 0;
  }

  bool pass() {
    if (!next()) return false;
    const uint32_t left = order_.lastThat([&](uint32_t e) { return side(e) < 0; });
    uint32_t right = order_.rightOf(left);
    through_.clear();
    const uint32_t point = isVertex_ ? vertex_ : uint32_t(at_.size() + result_.crossings.size());
    if (!takeOut(point, right)) return false;
    if (isVertex_) {
      for (; nextEdge_ < edges_.size() && edges_[nextEdge_].low == vertex_; ++nextEdge_)
        if (!push(through_, nextEdge_, ownCharge_)) return false;
      ++vertex_;
    } else {
      const EdgeCrossing found = {crossing_.first, crossing_.second, crossing_.at};
      if (!push(result_.crossings, found, charge_)) return false;
    }
    return putBack(left, right);
  }

  /// Takes the edges through the event out, from `right` on, which becomes the edge right of them.
  bool takeOut(uint32_t point, uint32_t& right) {
    while (right != kNone && side(right) == 0) {
      const uint32_t e = right;
      right = order_.rightOf(e);
      order_.remove(e);
      if (isVertex_ && edges_[e].high == vertex_) continue;
      if (!push(result_.cuts, {e, point}, charge_) || !push(through_, e, ownCharge_)) return false;
    }
    return true;
  }

  /// Puts the edges that leave the event upward in, from left to right, and looks for crossings of
  /// those that have become neighbours.
  bool putBack(uint32_t left, uint32_t right) {
    std::sort(through_.begin(), through_.end(), [&](uint32_t a, uint32_t b) {
      const Line s = line(a), t = line(b);
      const int turned =
          turn2d(t.low.x, t.low.y, t.high.x, t.high.y, s.low.x, s.low.y, s.high.x, s.high.y);
      return turned > 0 || (turned == 0 && a < b);
    });
    if (through_.empty()) return check(left, right);
    uint32_t last = left;
    for (const uint32_t e : through_) {
      result_.winding[e] = last == kNone ? 0 : result_.winding[last] - edges_[last].weight;
      result_.left[e] = last;
      order_.insertAfter(last, e);
      last = e;
    }
    return check(left, through_.front()) && check(last, right);
  }

  /// Notes the crossing of two edges next to each other, above the event. They cross if the upper
  /// end that comes first is on the wrong side of the other edge.
  bool check(uint32_t left, uint32_t right) {
    if (left == kNone || right == kNone) return true;
    const Line s = line(left), t = line(right);
    const uint32_t a = edges_[left].high, b = edges_[right].high;
    const bool cross = a < b   ? turn(t.low, t.high, s.high) < 0
                       : b < a ? turn(s.low, s.high, t.high) > 0
                               : false;
    if (!cross) return true;
    const Pending found = {left, right, crossingPoint(s, t).at};
    if (!push(pending_, found, ownCharge_)) return false;
    std::push_heap(pending_.begin(), pending_.end(), Later{*this});
    return work_.tick(kUnitsPerCrossing);
  }

  /// The order of the heap, whose greatest element comes out first. It is total, so that the choice
  /// among pairs that cross at one point does not depend on how heaps are built.
  struct Later {
    const Sweep& sweep;
    bool operator()(const Pending& a, const Pending& b) const {
      if (const int order = compare(sweep.exact(a), sweep.exact(b))) return order > 0;
      return a.first != b.first ? a.first > b.first : a.second > b.second;
    }
  };

  ArrayView<const Point2> at_;
  ArrayView<const WeightedEdge> edges_;
  size_t most_;
  Work& work_;
  Charge& charge_;    // of the result
  Charge ownCharge_;  // of all else
  Crossings& result_;
  SegmentOrder order_;
  std::vector<Pending> pending_;  // a heap
  uint32_t vertex_ = 0;           // the next vertex; during an event at one, that
  uint32_t nextEdge_ = 0;         // the next edge to start
  bool isVertex_ = false;
  Pending crossing_ = {};          // the event, if it is no vertex
  std::vector<uint32_t> through_;  // edges that leave the event upward
};

}  // namespace

bool findCrossings(ArrayView<const Point2> at, ArrayView<const WeightedEdge> edges, size_t most,
                   Work& work, Charge& charge, Crossings& result) {
  return Sweep(at, edges, most, work, charge, result).run();
}

}  // namespace sf
