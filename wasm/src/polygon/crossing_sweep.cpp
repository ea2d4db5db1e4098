#include "polygon/crossing_sweep.h"

#include <algorithm>

#include "base/predicates.h"
#include "polygon/crossing_point.h"
#include "polygon/edge_order.h"
#include "polygon/turn.h"

namespace sf {
namespace {

constexpr uint32_t kUnitsPerEvent = 500, kUnitsPerCrossing = 5000;

/// push_back that charges the memory before it is taken; false if that exceeds the limit.
template <class T>
bool push(std::vector<T>& list, const T& item, Charge& charge) {
  if (list.size() == list.capacity()) {
    const size_t more = list.size() < 16 ? 16 : list.size();
    if (!charge.add(more * sizeof(T))) return false;
    list.reserve(list.size() + more);
  }
  list.push_back(item);
  return true;
}

class Sweep {
 public:
  Sweep(ArrayView<const Point2> at, ArrayView<const WeightedEdge> edges, Work& work, Charge& charge,
        Crossings& result)
      : at_(at), edges_(edges), work_(work), charge_(charge), result_(result) {}

  bool run() {
    const size_t e = edges_.size();
    if (!charge_.add(EdgeOrder::bytes(e) + e * (sizeof(int32_t) + 2 * sizeof(uint32_t))))
      return false;
    order_.reset(e);
    result_.crossings.clear(), result_.cuts.clear();
    result_.winding.assign(e, 0), result_.left.assign(e, kNone);
    while (vertex_ < at_.size() || !pending_.empty())
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

  /// Positive if the event is left of a crossed edge, negative right, 0 on it.
  int side(uint32_t record) const {
    const CrossedEdge& edge = order_[record];
    if (!isVertex_) return sideOf({edge.lo, edge.hi}, exact(crossing_));
    if (edge.upper == vertex_) return 0;
    const double s = turn(edge.lo, edge.hi, at_[vertex_]);
    return s > 0 ? 1 : s < 0 ? -1 : 0;
  }

  bool pass() {
    if (!next()) return false;
    uint32_t left = kNone, right = kNone;
    for (uint32_t r = order_.root(); r != kNone;) {
      const bool isLeft = side(r) < 0;
      (isLeft ? left : right) = r;
      r = order_[r].child[isLeft];
    }
    through_.clear();
    const uint32_t point = isVertex_ ? vertex_ : uint32_t(at_.size() + result_.crossings.size());
    if (!takeOut(point, right)) return false;
    if (isVertex_) {
      for (; nextEdge_ < edges_.size() && edges_[nextEdge_].low == vertex_; ++nextEdge_)
        through_.push_back(nextEdge_);
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
      const uint32_t e = order_[right].input, after = order_[right].right;
      order_.remove(right);
      right = after;
      if (isVertex_ && edges_[e].high == vertex_) continue;
      if (!push(result_.cuts, {e, point}, charge_)) return false;
      through_.push_back(e);
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
      result_.winding[e] = windingRightOf(last);
      result_.left[e] = last == kNone ? kNone : uint32_t(order_[last].input);
      last = order_.insertAfter(last);
      CrossedEdge& record = order_[last];
      record.lo = at_[edges_[e].low], record.hi = at_[edges_[e].high];
      record.lower = edges_[e].low, record.upper = edges_[e].high;
      record.input = e;
    }
    const uint32_t first = left == kNone ? order_.leftmost() : order_[left].right;
    return check(left, first) && check(last, right);
  }

  int32_t windingRightOf(uint32_t record) const {
    if (record == kNone) return 0;
    const uint32_t e = order_[record].input;
    return result_.winding[e] - edges_[e].weight;
  }

  /// Notes the crossing of two edges next to each other, above the event. They cross if the upper
  /// end that comes first is on the wrong side of the other edge.
  bool check(uint32_t left, uint32_t right) {
    if (left == kNone || right == kNone) return true;
    const CrossedEdge &a = order_[left], &b = order_[right];
    const bool cross = a.upper < b.upper   ? turn(b.lo, b.hi, a.hi) < 0
                       : b.upper < a.upper ? turn(a.lo, a.hi, b.hi) > 0
                                           : false;
    if (!cross) return true;
    const Line s = {a.lo, a.hi}, t = {b.lo, b.hi};
    const Pending found = {a.input, b.input, crossingPoint(s, t).at};
    if (!push(pending_, found, charge_)) return false;
    std::push_heap(pending_.begin(), pending_.end(), Later{*this});
    return work_.tick(kUnitsPerCrossing);
  }

  /// The order of the heap, whose greatest element comes out first.
  struct Later {
    const Sweep& sweep;
    bool operator()(const Pending& a, const Pending& b) const {
      return compare(sweep.exact(a), sweep.exact(b)) > 0;
    }
  };

  ArrayView<const Point2> at_;
  ArrayView<const WeightedEdge> edges_;
  Work& work_;
  Charge& charge_;
  Crossings& result_;
  EdgeOrder order_;               // `input` of a record is the number of the edge
  std::vector<Pending> pending_;  // a heap
  uint32_t vertex_ = 0;           // the next vertex; during an event at one, that
  uint32_t nextEdge_ = 0;         // the next edge to start
  bool isVertex_ = false;
  Pending crossing_ = {};          // the event, if it is no vertex
  std::vector<uint32_t> through_;  // edges that leave the event upward
};

}  // namespace

bool findCrossings(ArrayView<const Point2> at, ArrayView<const WeightedEdge> edges, Work& work,
                   Charge& charge, Crossings& result) {
  return Sweep(at, edges, work, charge, result).run();
}

}  // namespace sf
