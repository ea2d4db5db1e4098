#include "polygon/repair/snap_rounding.h"

#include <algorithm>
#include <cmath>

#include "base/turn.h"

namespace sf {
namespace {

struct Box {
  Point2 low, high;
};

class Rounding {
 public:
  Rounding(ArrayView<const Point2> at, ArrayView<const WeightedEdge> edges, const Crossings& found,
           double cellSize, Work& work, Charge& charge, std::vector<HotCell>& cells,
           std::vector<SnappedPiece>& pieces)
      : at_(at),
        edges_(edges),
        found_(found),
        size_(cellSize),
        work_(work),
        charge_(charge),
        cells_(cells),
        pieces_(pieces) {}

  bool run() {
    if (!findHotCells() || !buildTree()) return false;
    pieces_.clear();
    for (uint32_t e = 0; e < edges_.size(); ++e)
      if (!bend(e)) return false;
    return true;
  }

 private:
  static constexpr uint32_t kLeaf = 4;

  /// The multiple of the cell size whose cell [-1/2, 1/2) holds x.
  double centreOf(double x) const {
    const double cells = x / size_, whole = std::floor(cells);
    return size_ * (cells - whole >= 0.5 ? whole + 1 : whole);
  }

  bool findHotCells() {
    const size_t m = at_.size(), k = found_.crossings.size();
    if (!charge_.add((m + 4 * uint64_t(k)) * sizeof(HotCell))) return false;
    cells_.clear();
    cells_.reserve(m + 4 * k);
    for (uint32_t v = 0; v < m; ++v)
      cells_.push_back({{centreOf(at_[v].x), centreOf(at_[v].y)}, v});
    for (size_t c = 0; c < k; ++c) {
      const Point2 p = found_.crossings[c].at;
      // Its error is at most a quarter of a cell, so that it is in one cell or one of two.
      const double ex = 0x1p-50 * std::fabs(p.x), ey = 0x1p-50 * std::fabs(p.y);
      const double x0 = centreOf(p.x - ex), x1 = centreOf(p.x + ex);
      const double y0 = centreOf(p.y - ey), y1 = centreOf(p.y + ey);
      for (const double y : {y0, y1})
        for (const double x : {x0, x1}) {
          cells_.push_back({{x, y}, uint32_t(m + c)});
          if (x0 == x1) break;
        }
    }
    // At each place the best cause comes first: a point at the centre, a crossing, any point.
    const auto rank = [&](const HotCell& c) {
      return c.cause >= m ? 1 : at_[c.cause] == c.centre ? 0 : 2;
    };
    std::sort(cells_.begin(), cells_.end(), [&](const HotCell& a, const HotCell& b) {
      if (!(a.centre == b.centre)) return below(a.centre, b.centre);
      return rank(a) != rank(b) ? rank(a) < rank(b) : a.cause < b.cause;
    });
    cells_.erase(
        std::unique(cells_.begin(), cells_.end(),
                    [](const HotCell& a, const HotCell& b) { return a.centre == b.centre; }),
        cells_.end());
    return work_.tick(uint32_t(std::min<size_t>(m + k, 1u << 20)) * 100);
  }

  // A balanced tree of boxes over the cells, as an array: the children of node k are 2k and 2k + 1.
  uint32_t bound(size_t node, size_t offset) const {
    size_t level = 1;
    while (2 * level <= node) level *= 2;
    return uint32_t(uint64_t(cells_.size()) * (node - level + offset) / level);
  }
  bool buildTree() {
    const uint32_t c = uint32_t(cells_.size());
    leaves_ = 1;
    while (leaves_ * kLeaf < c) leaves_ *= 2;
    if (!charge_.add(uint64_t(c) * sizeof(uint32_t) + 2 * uint64_t(leaves_) * sizeof(Box)))
      return false;
    order_.resize(c);
    for (uint32_t i = 0; i < c; ++i) order_[i] = i;
    boxes_.assign(2 * leaves_, Box{});
    for (size_t node = 1; node < 2 * leaves_; ++node) {
      const uint32_t begin = bound(node, 0), end = bound(node, 1);
      if (begin == end) continue;
      Box box = {cells_[order_[begin]].centre, cells_[order_[begin]].centre};
      for (uint32_t i = begin; i < end; ++i) {
        const Point2 p = cells_[order_[i]].centre;
        box.low = {std::fmin(box.low.x, p.x), std::fmin(box.low.y, p.y)};
        box.high = {std::fmax(box.high.x, p.x), std::fmax(box.high.y, p.y)};
      }
      boxes_[node] = box;
      if (node < leaves_) {
        const bool wide = box.high.x - box.low.x > box.high.y - box.low.y;
        std::nth_element(order_.begin() + begin, order_.begin() + bound(2 * node + 1, 0),
                         order_.begin() + end, [&](uint32_t i, uint32_t j) {
                           const Point2 p = cells_[i].centre, q = cells_[j].centre;
                           return wide ? p.x < q.x : p.y < q.y;
                         });
      }
      if (!work_.tick(20 * (end - begin))) return false;
    }
    return true;
  }

  /// Whether a segment may pass a cell of those with centres in a box.
  bool mayPass(const Box& box, Point2 a, Point2 b) const {
    const double h = size_ / 2;
    if (std::fmax(a.x, b.x) < box.low.x - h || std::fmin(a.x, b.x) > box.high.x + h ||
        std::fmax(a.y, b.y) < box.low.y - h || std::fmin(a.y, b.y) > box.high.y + h)
      return false;
    const double dx = b.x - a.x, dy = b.y - a.y;
    const double mx = (box.low.x + box.high.x) / 2, my = (box.low.y + box.high.y) / 2;
    const double cross = dx * (my - a.y) - dy * (mx - a.x);
    const double reach = std::fabs(dx) * ((box.high.y - box.low.y) / 2 + h) +
                         std::fabs(dy) * ((box.high.x - box.low.x) / 2 + h);
    return std::fabs(cross) <= 1.01 * reach + 0x1p-48 * (std::fabs(dx) + std::fabs(dy));
  }

  /// Whether a segment has a point in a cell, exactly.
  bool passes(Point2 centre, Point2 a, Point2 b) const {
    const double h = size_ / 2;
    const double x0 = centre.x - h, x1 = centre.x + h, y0 = centre.y - h, y1 = centre.y + h;
    const auto holds = [&](Point2 p) { return x0 <= p.x && p.x < x1 && y0 <= p.y && p.y < y1; };
    if (holds(a) || holds(b)) return true;
    const double lowX = std::fmin(a.x, b.x), highX = std::fmax(a.x, b.x);
    const double lowY = std::fmin(a.y, b.y), highY = std::fmax(a.y, b.y);
    if (highX < x0 || lowX > x1 || highY < y0 || lowY > y1) return false;
    const double s[4] = {turn(a, b, {x0, y0}), turn(a, b, {x1, y0}), turn(a, b, {x1, y1}),
                         turn(a, b, {x0, y1})};
    const bool left = s[0] > 0 || s[1] > 0 || s[2] > 0 || s[3] > 0;
    const bool right = s[0] < 0 || s[1] < 0 || s[2] < 0 || s[3] < 0;
    if (left && right && highX > x0 && lowX < x1 && highY > y0 && lowY < y1) return true;
    // Without an end in the cell or a point inside it, only its lower left corner remains.
    return s[0] == 0 && lowX <= x0 && x0 <= highX && lowY <= y0 && y0 <= highY;
  }

  bool bend(uint32_t e) {
    const Point2 a = at_[edges_[e].low], b = at_[edges_[e].high];
    passed_.clear();
    stack_.assign(1, 1);
    while (!stack_.empty()) {
      const size_t node = stack_.back();
      stack_.pop_back();
      if (!work_.tick(20)) return false;
      const uint32_t begin = bound(node, 0), end = bound(node, 1);
      if (begin == end || !mayPass(boxes_[node], a, b)) continue;
      if (node < leaves_) {
        stack_.push_back(2 * node), stack_.push_back(2 * node + 1);
        continue;
      }
      for (uint32_t i = begin; i < end; ++i)
        if (passes(cells_[order_[i]].centre, a, b)) passed_.push_back(order_[i]);
    }
    // A straight line passes cells by increasing sums of their coordinates, along its direction.
    const double sx = b.x < a.x ? -1 : 1;
    const auto sum = [&](uint32_t c) { return sx * cells_[c].centre.x + cells_[c].centre.y; };
    std::sort(passed_.begin(), passed_.end(),
              [&](uint32_t i, uint32_t j) { return sum(i) < sum(j); });
    if (passed_.size() < 2) return true;
    if (!charge_.add(uint64_t(passed_.size() - 1) * sizeof(SnappedPiece))) return false;
    for (size_t i = 0; i + 1 < passed_.size(); ++i)
      pieces_.push_back({e, passed_[i], passed_[i + 1]});
    return true;
  }

  ArrayView<const Point2> at_;
  ArrayView<const WeightedEdge> edges_;
  const Crossings& found_;
  double size_;
  Work& work_;
  Charge& charge_;
  std::vector<HotCell>& cells_;
  std::vector<SnappedPiece>& pieces_;
  size_t leaves_ = 1;
  std::vector<uint32_t> order_, passed_;
  std::vector<Box> boxes_;
  std::vector<size_t> stack_;
};

}  // namespace

bool snapRound(ArrayView<const Point2> at, ArrayView<const WeightedEdge> edges,
               const Crossings& found, double cellSize, Work& work, Charge& charge,
               std::vector<HotCell>& cells, std::vector<SnappedPiece>& pieces) {
  return Rounding(at, edges, found, cellSize, work, charge, cells, pieces).run();
}

}  // namespace sf
