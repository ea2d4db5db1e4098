#include "loops/problem/loop_check.h"

#include <algorithm>
#include <cmath>

#include "base/charge.h"
#include "base/predicates.h"
#include "delaunay/insertion_order.h"

namespace sf {
namespace {

bool isBefore(const Vec3& a, const Vec3& b) {  // along any line
  return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

struct Flat {
  double u, v;
};
// One of the three projections along an axis.
Flat project(const Vec3& p, int axis) {
  return axis == 0 ? Flat{p.y, p.z} : axis == 1 ? Flat{p.z, p.x} : Flat{p.x, p.y};
}
int turn(Flat a, Flat b, Flat c) { return orient2d(a.u, a.v, b.u, b.v, c.u, c.v); }

// Whether two closed segments without a common end have a point in common.
bool segmentsMeet(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  if (orient3d(a, b, c, d) != 0) return false;
  for (int axis = 0; axis < 3; ++axis) {
    Flat p = project(a, axis), q = project(b, axis), r = project(c, axis), s = project(d, axis);
    int pqr = turn(p, q, r), pqs = turn(p, q, s), rsp = turn(r, s, p), rsq = turn(r, s, q);
    if (pqr == 0 && pqs == 0 && rsp == 0 && rsq == 0) continue;
    // The plane of the four does not project to a line, so the projection decides.
    return pqr * pqs <= 0 && rsp * rsq <= 0;
  }
  const Vec3 &ab0 = isBefore(a, b) ? a : b, &ab1 = isBefore(a, b) ? b : a;
  const Vec3 &cd0 = isBefore(c, d) ? c : d, &cd1 = isBefore(c, d) ? d : c;
  return !isBefore(ab1, cd0) && !isBefore(cd1, ab0);
}

struct Box {
  Vec3 low, high;
  void add(const Vec3& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  bool meets(const Box& o) const {
    return low.x <= o.high.x && o.low.x <= high.x && low.y <= o.high.y && o.low.y <= high.y &&
           low.z <= o.high.z && o.low.z <= high.z;
  }
};

// A balanced tree of boxes over the edges, to find the pairs that may meet.
class EdgePairs {
 public:
  EdgePairs(const LoopSet& loops, ArrayView<const Vec3> positions, Work& work)
      : loops_(loops), p_(positions), work_(work), charge_(work) {}

  /// Finds two edges that meet, given by their first vertices; false if there are none or the work
  /// has to end.
  bool find(uint32_t& first, uint32_t& second) {
    uint32_t n = loops_.vertexCount();
    size_t leaves = 1;
    while (leaves * kLeaf < n) leaves *= 2;
    if (!charge_.add(uint64_t(n) * sizeof(uint32_t) + 2 * uint64_t(leaves) * sizeof(Box)))
      return false;
    order_.resize(n);
    for (uint32_t i = 0; i < n; ++i) order_[i] = i;
    leaves_ = leaves;
    boxes_.resize(2 * leaves);
    // Top down; a node's children are 2 k and 2 k + 1.
    for (size_t k = 1; k < 2 * leaves; ++k) {
      uint32_t begin = start(k), end = stop(k);
      Box box = {{1, 1, 1}, {-1, -1, -1}};  // empty; coordinates are below 1
      for (uint32_t i = begin; i < end; ++i) box.add(p_[order_[i]]), box.add(p_[next(order_[i])]);
      boxes_[k] = box;
      if (k < leaves && end > begin) divide(box, begin, start(2 * k + 1), end);
      if (!work_.tick(20 * (end - begin))) return false;
    }
    return search(first, second);
  }

 private:
  static constexpr uint32_t kLeaf = 4;

  uint32_t next(uint32_t v) const { return loops_.next(v); }
  // The edges under a node: an even share of all at each level.
  uint32_t bound(size_t k, size_t offset) const {
    size_t level = 1;
    while (2 * level <= k) level *= 2;
    return uint32_t(uint64_t(order_.size()) * (k - level + offset) / level);
  }
  uint32_t start(size_t k) const { return bound(k, 0); }
  uint32_t stop(size_t k) const { return bound(k, 1); }

  void divide(const Box& box, uint32_t begin, uint32_t middle, uint32_t end) {
    Vec3 size = box.high - box.low;
    double Vec3::*axis = size.x >= size.y && size.x >= size.z ? &Vec3::x
                         : size.y >= size.z                   ? &Vec3::y
                                                              : &Vec3::z;
    auto place = [&](uint32_t v) { return p_[v].*axis + p_[next(v)].*axis; };
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](uint32_t a, uint32_t b) { return place(a) < place(b); });
  }

  bool search(uint32_t& first, uint32_t& second) {
    struct Pair {
      size_t a, b;
    };
    std::vector<Pair> stack = {{1, 1}};  // at most a few per level
    while (!stack.empty()) {
      Pair t = stack.back();
      stack.pop_back();
      if (!boxes_[t.a].meets(boxes_[t.b])) continue;
      if (t.a >= leaves_) {
        if (meetInLeaves(t.a, t.b, first, second)) return true;
        if (!work_.tick(100)) return false;
      } else if (t.a == t.b) {
        stack.insert(stack.end(),
                     {{2 * t.a, 2 * t.a}, {2 * t.a + 1, 2 * t.a + 1}, {2 * t.a, 2 * t.a + 1}});
      } else {  // both are on one level
        for (size_t i = 0; i < 4; ++i) stack.push_back({2 * t.a + i / 2, 2 * t.b + i % 2});
      }
    }
    return false;
  }

  bool meetInLeaves(size_t a, size_t b, uint32_t& first, uint32_t& second) const {
    for (uint32_t i = start(a); i < stop(a); ++i)
      for (uint32_t j = a == b ? i + 1 : start(b); j < stop(b); ++j) {
        uint32_t u = std::min(order_[i], order_[j]), v = std::max(order_[i], order_[j]);
        if (!edgesMeet(u, v)) continue;
        first = u, second = v;
        return true;
      }
    return false;
  }

  bool edgesMeet(uint32_t u, uint32_t v) const {
    uint32_t nu = next(u), nv = next(v);
    if (nv == u) return foldsBack(v, u, nu) || (nu == v && foldsBack(u, v, nv));
    if (nu == v) return foldsBack(u, v, nv);
    Box box = {p_[u], p_[u]}, other = {p_[v], p_[v]};
    box.add(p_[nu]), other.add(p_[nv]);
    return box.meets(other) && segmentsMeet(p_[u], p_[nu], p_[v], p_[nv]);
  }
  bool foldsBack(uint32_t a, uint32_t at, uint32_t b) const {
    return isBefore(p_[a], p_[at]) == isBefore(p_[b], p_[at]) && collinear(p_[a], p_[at], p_[b]);
  }

  const LoopSet& loops_;
  ArrayView<const Vec3> p_;
  Work& work_;
  Charge charge_;
  size_t leaves_ = 1;
  std::vector<uint32_t> order_;
  std::vector<Box> boxes_;
};

}  // namespace

Outcome checkLoops(const LoopSet& loops, bool intersections, Work& work) {
  Outcome outcome;
  auto name = [&](uint32_t v, uint32_t& loop, uint32_t& vertex) {
    loop = loops.loopOf(v);
    vertex = v - loops.first(loop);
  };
  for (uint32_t v = 0; v < loops.vertexCount(); ++v) {
    Vec3 p = loops.position(v);
    const auto isAccepted = [](double x) { return std::fabs(x) <= kLargestCoordinate; };
    if (isAccepted(p.x) && isAccepted(p.y) && isAccepted(p.z)) continue;
    outcome.status = Status::NotFinite;
    name(v, outcome.loop, outcome.vertex);
    return outcome;
  }
  for (uint32_t c = 0; c < loops.loopCount(); ++c)
    if (loops.size(c) < 3) {
      outcome.status = Status::TooFewVertices;
      outcome.loop = c;
      return outcome;
    }

  Charge charge(work);
  std::vector<Vec3> positions;
  std::vector<uint32_t> firstOf;
  auto ended = [&] {
    outcome.status = work.status();
    return outcome;
  };
  if (!charge.add(uint64_t(loops.vertexCount()) * (sizeof(Vec3) + sizeof(uint32_t))))
    return ended();
  scaleToUnit(loops.positions(), positions);
  if (!findEqualPoints(positions, work, firstOf)) return ended();
  uint32_t u = 0, v = 0;
  while (v < firstOf.size() && firstOf[v] == v) ++v;
  if (v < firstOf.size()) {
    outcome.status = Status::RepeatedVertex;
    u = firstOf[v];
  } else if (intersections && EdgePairs(loops, positions, work).find(u, v)) {
    outcome.status = Status::LoopsIntersect;
  } else {
    return ended();
  }
  name(u, outcome.loop, outcome.vertex);
  name(v, outcome.otherLoop, outcome.otherVertex);
  return outcome;
}

}  // namespace sf
