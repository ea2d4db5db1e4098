#include "polygon/fill/constrained_delaunay.h"

#include <algorithm>

#include "base/assert.h"
#include "base/in_circle.h"
#include "base/turn.h"
#include "polygon/input/metric_points.h"

namespace sf {
namespace {

// Size of a block of triangles in any order, all next to each other; a list of up to twice as many
// is one block. At this size flips are less work than what merges would need, also on smooth
// curves; measured.
constexpr uint32_t kBlockHalves = 3 * 32, kFewHalves = 2 * kBlockHalves;
// A block of triangles from flooding ends at this size, or once its flips exceed kFlips and
// kFlipsPerTriangle for each triangle. If flips become more, merges are less work; measured.
constexpr uint32_t kMostHalves = 3 * 256;
constexpr int32_t kFlips = 48, kFlipsPerTriangle = 2;
// Triangles are near each other in the list if they are in the same group of 2^4.
constexpr int kNearBits = 4;
constexpr int kLevels = 32;

/// How far apart two triangles are in the list:
/// the first binary digit in which their places differ.
int levelOf(uint32_t t, uint32_t s) {
  int level = 0;
  for (uint32_t d = (t ^ s) >> kNearBits; d != 0; d >>= 1) ++level;
  return level;
}

}  // namespace

bool ConstrainedDelaunay::begin(const LinkedPolygon& loops, ArrayView<uint32_t> triangles,
                                ClosableTwins& twins, Charge& charge) {
  // Memory: borders and triangles of merges, 20 bytes a triangle; the edges to look at, and a mark
  // for each; closed edges and their far sides.
  constexpr uint64_t kPerCorner = 6 * sizeof(uint32_t);
  count_ = uint32_t(triangles.size());
  if (!charge.add(kPerCorner * count_ + sizeof(Point2) * uint64_t(loops.at.size()))) return false;
  at_ = loops.at.data();
  int exponent;
  metric_ = metricPoints(loops, scaled_, exponent, isExact_).data();
  const auto inMetric = [&](Point2 p) { return exponent == 0 ? p : scaledDown(p, exponent); };
  error_ = errorOfCircles(inMetric(loops.least), inMetric(loops.greatest));
  corners_ = triangles.data(), twins_ = twins.of.data();
  closable_ = &twins;
  // Flips stay within a block, unless they take the place of merges.
  const size_t room = isExact_ ? std::max(kMostHalves / 3, kFewHalves) : count_;
  const size_t row = count_ / 3 + 2;
  if (stack_.size() < room) stack_.resize(room);
  if (free_.items.size() < row)
    left_.items.resize(row), right_.items.resize(row), free_.items.resize(row);
  return true;
}

bool ConstrainedDelaunay::run(const LinkedPolygon& loops, Work& work, ArrayView<uint32_t> triangles,
                              ClosableTwins& twins) {
  if (triangles.size() < 6) return true;
  Charge charge(work);
  return begin(loops, triangles, twins, charge) && flipBlocks(work) && giveUpEdges(work);
}

bool ConstrainedDelaunay::runFlooded(const LinkedPolygon& loops, Work& work, Flood& flood) {
  const ArrayView<uint32_t> triangles = flood.triangles();
  if (triangles.size() < 6) return true;
  Charge charge(work);
  return begin(loops, triangles, flood.twins(), charge) &&
         (isExact_ ? insertBlocks(work) : flipBlocks(work)) && giveUpEdges(work);
}

void ConstrainedDelaunay::close(uint32_t h) {
  closable_->close(h);
  twins_ = closable_->of.data();
}

/// Makes blocks constrained Delaunay, vertex by vertex. A block ends where flips become many.
bool ConstrainedDelaunay::insertBlocks(Work& work) {
  for (uint32_t first = 0, t = 0; t < count_; first = t) {
    const uint32_t end = std::min(first + kMostHalves, count_);
    int32_t left = kFlips, flips = 0;
    for (; t < end && left >= 0; t += 3) {
      for (uint32_t h = t; first > 0 && h < t + 3; ++h)
        if (twins_[h] < first) close(h);
      const int32_t more = int32_t(insert(t));
      left += kFlipsPerTriangle - more, flips += more;
    }
    if (!work.tick(20 * (t - first) + 50 * uint32_t(flips))) return false;
  }
  return true;
}

/// Inserts the first corner of a triangle into the triangles before it in the block. Flips edges,
/// which then start at that corner, until it sees no illegal one. Returns the number of flips.
///   first  the triangle's first half-edge
uint32_t ConstrainedDelaunay::insert(uint32_t first) {
  const uint32_t end = first + 3, apex = corners_[first];
  const Point2 c = metric_[apex];
  // Whether the corner that half-edge g, from b to a, sees lies inside the circle through a, b, c.
  // Triangles later in the list count as closed.
  const auto isIllegal = [&](Point2 a, Point2 b, uint32_t g) {
    return g < end && inCircle(a, b, c, metric_[corners_[g]], error_);
  };
  uint32_t* const waiting = stack_.data();
  uint32_t count = 0, flips = 0, t = first;
  if (!isIllegal(metric_[corners_[t + 1]], metric_[corners_[t + 2]], twins_[t])) return 0;
  // The edge opposite the apex is illegal in the triangle whose first half-edge is t. The flip
  // leaves two triangles at the apex, with first half-edges t and s.
  for (;;) {
    const uint32_t g = twins_[t], g1 = nextInTriangle(g), g2 = prevInTriangle(g);
    const uint32_t s = std::min(std::min(g, g1), g2);
    const uint32_t opposite = corners_[g], last = corners_[t + 2];
    const uint32_t twin1 = twins_[g1], twin2 = twins_[g2];
    const Point2 a = metric_[corners_[t + 1]], b = metric_[last], d = metric_[opposite];
    corners_[s] = apex, corners_[s + 1] = opposite, corners_[s + 2] = last;
    corners_[t + 2] = opposite;
    pair(s + 1, twins_[t + 1]), pair(t + 1, s + 2);
    pair(t, twin1), pair(s, twin2);
    ++flips;
    const bool goesOn = isIllegal(a, d, twin1), waits = isIllegal(d, b, twin2);
    if (goesOn) {
      if (waits) waiting[count++] = s;
    } else if (waits) {
      t = s;
    } else {
      if (count == 0) return flips;
      t = waiting[--count];
    }
  }
}

inline void ConstrainedDelaunay::push(uint32_t h) {
  stack_[waiting_++] = h;
  waits_[h] = true;
}

/// Makes each block constrained Delaunay by itself; the edges between blocks become closed.
bool ConstrainedDelaunay::flipBlocks(Work& work) {
  waits_.assign(count_, false);
  waiting_ = 0;
  const uint32_t size = count_ <= kFewHalves ? kFewHalves : kBlockHalves;
  for (uint32_t first = 0; first < count_; first += size) {
    const uint32_t end = std::min(first + size, count_);
    for (uint32_t h = first; h < end; ++h) {
      if (twins_[h] >= end && isOpen(twins_[h])) close(h);
      if (twins_[h] > h && twins_[h] < end) push(h);
    }
    if (!work.tick(50 * (end - first)) || !flipStacked(work)) return false;
  }
  return true;
}

/// Puts the closed edges into the order in which they are given up.
void ConstrainedDelaunay::orderEdges() {
  uint32_t starts[kLevels + 1] = {};
  const uint32_t begin = closable_->outside + 2, end = closable_->end;
  order_.resize((end - begin) / 2);
  if (order_.size() == 1) {
    order_[0] = begin;
    return;
  }
  const auto level = [&](uint32_t c) { return levelOf(twins_[c] / 3, twins_[c + 1] / 3); };
  for (uint32_t c = begin; c < end; c += 2) ++starts[level(c) + 1];
  for (int l = 0; l < kLevels; ++l) starts[l + 1] += starts[l];
  for (uint32_t c = begin; c < end; c += 2) order_[starts[level(c)]++] = c;
}

bool ConstrainedDelaunay::giveUpEdges(Work& work) {
  if (closable_->end == closable_->outside + 2) return true;
  orderEdges();
  for (const uint32_t c : order_) {
    const uint32_t h = twins_[c], g = twins_[c + 1];
    pair(h, g);
    uint32_t changes = 1;
    if (isIllegal(h)) {
      if (isExact_) {
        changes += merge(h);
      } else {
        push(h);
        if (!flipStacked(work)) return false;
      }
    }
    if (!work.tick(50 * changes)) return false;
  }
  closable_->end = closable_->outside + 2;
  return true;
}

// Inline: calls would take a twentieth of the time.
inline __attribute__((always_inline)) bool ConstrainedDelaunay::isIllegal(uint32_t h) const {
  const uint32_t g = twins_[h];
  const uint32_t a = corners_[nextInTriangle(h)], b = corners_[prevInTriangle(h)];
  const uint32_t c = corners_[h], d = corners_[g];
  if (!inCircle(metric_[a], metric_[b], metric_[c], metric_[d], error_)) return false;
  // Always true if circles are exact; otherwise what they say may be all wrong.
  return isExact_ || (turn(at_[a], at_[d], at_[c]) > 0 && turn(at_[b], at_[c], at_[d]) > 0);
}

/// Puts the other diagonal into the two triangles at h: it follows h, and the twin of h.
void ConstrainedDelaunay::flip(uint32_t h) {
  const uint32_t g = twins_[h];
  const uint32_t h1 = nextInTriangle(h), g1 = nextInTriangle(g);
  corners_[prevInTriangle(h)] = corners_[g], corners_[prevInTriangle(g)] = corners_[h];
  pair(h, twins_[g1]), pair(g, twins_[h1]), pair(h1, g1);
}

/// Flips the edges of the stack that are illegal, and all that become so.
bool ConstrainedDelaunay::flipStacked(Work& work) {
  constexpr uint32_t kTick = 1024;
  uint32_t flips = 0;
  while (waiting_ > 0) {
    const uint32_t h = stack_[--waiting_], g = twins_[h];
    waits_[h] = false;
    if (!isOpen(g) || !isIllegal(h)) continue;
    flip(h);
    for (const uint32_t e : {h, prevInTriangle(h), g, prevInTriangle(g)})
      if (isOpen(twins_[e]) && !waits_[e] && !waits_[twins_[e]]) push(e);
    if (++flips % kTick == 0 && !work.tick(50 * kTick)) return false;
  }
  return work.tick(50 * (flips % kTick));
}

/// Puts a triangle in the place of one taken away; returns its first half-edge.
uint32_t ConstrainedDelaunay::create(uint32_t a, uint32_t b, uint32_t c) {
  SF_ASSERT(turn(at_[a], at_[b], at_[c]) > 0);
  const uint32_t h = 3 * free_.last();
  free_.pop();
  corners_[h] = c, corners_[h + 1] = a, corners_[h + 2] = b;
  return h;
}

/// Takes away the triangles on the first edge of the left border,
/// as long as `right` is in their circles.
inline void ConstrainedDelaunay::takeLeft(uint32_t left, uint32_t right) {
  const Point2 a = metric_[left], d = metric_[right];
  Border first = *--left_.top;
  for (uint32_t h = first.outer; isOpen(h); h = first.outer) {
    const uint32_t apex = corners_[h];
    if (!inCircle(a, metric_[first.vertex], metric_[apex], d, error_)) break;
    free_.push(h / 3);
    left_.push({first.vertex, twins_[nextInTriangle(h)]});
    first = {apex, twins_[prevInTriangle(h)]};
  }
  left_.push(first);
}

/// The same for the right border.
inline void ConstrainedDelaunay::takeRight(uint32_t left, uint32_t right) {
  const Point2 b = metric_[right], d = metric_[left];
  Border first = *--right_.top;
  for (uint32_t h = first.outer; isOpen(h); h = first.outer) {
    const uint32_t apex = corners_[h];
    if (!inCircle(metric_[first.vertex], b, metric_[apex], d, error_)) break;
    free_.push(h / 3);
    right_.push({first.vertex, twins_[prevInTriangle(h)]});
    first = {apex, twins_[nextInTriangle(h)]};
  }
  right_.push(first);
}

/// Merges the triangles to the left and to the right of edge h, which is illegal. Returns how many
/// triangles change.
uint32_t ConstrainedDelaunay::merge(uint32_t h) {
  const uint32_t g = twins_[h], bottom = corners_[nextInTriangle(h)],
                 top = corners_[prevInTriangle(h)];
  const uint32_t h1 = nextInTriangle(h), h2 = prevInTriangle(h);
  const uint32_t g1 = nextInTriangle(g), g2 = prevInTriangle(g);
  left_.clear(), right_.clear(), free_.clear();
  left_.push({top, twins_[h1]}), left_.push({corners_[h], twins_[h2]});
  right_.push({top, twins_[g2]}), right_.push({corners_[g], twins_[g1]});
  free_.push(h / 3), free_.push(g / 3);
  // The first triangle is the tangent of two convex chains: of the neighbours of the lower end to
  // either side, under inversion at it.
  for (size_t taken = 0; taken != free_.size();) {
    taken = free_.size();
    takeLeft(bottom, right_.last().vertex);
    takeRight(left_.last().vertex, bottom);
  }
  uint32_t left = left_.last().vertex, right = right_.last().vertex;
  uint32_t t = create(bottom, right, left), base = t + 1;
  pair(t, right_.last().outer), pair(t + 2, left_.last().outer);
  left_.pop(), right_.pop();
  uint32_t created = 1;
  for (;; ++created) {
    const bool seesLeft = turn(at_[left], at_[right], at_[left_.last().vertex]) > 0;
    const bool seesRight = turn(at_[left], at_[right], at_[right_.last().vertex]) > 0;
    if (seesLeft) takeLeft(left, right);
    if (seesRight) takeRight(left, right);
    const Border l = left_.last(), r = right_.last();
    const bool endsLeft = l.vertex == top, endsRight = r.vertex == top;
    const bool goesRight =
        !seesLeft || endsLeft ||
        (seesRight && !endsRight &&
         inCircle(metric_[left], metric_[right], metric_[l.vertex], metric_[r.vertex], error_));
    t = create(left, right, goesRight ? r.vertex : l.vertex);
    pair(t, base);
    if (endsLeft && endsRight) {
      pair(t + 1, r.outer), pair(t + 2, l.outer);
      break;
    }
    if (goesRight) {
      pair(t + 1, r.outer);
      base = t + 2, right = r.vertex;
      right_.pop();
    } else {
      pair(t + 2, l.outer);
      base = t + 1, left = l.vertex;
      left_.pop();
    }
  }
  SF_ASSERT(free_.size() == 0);
  return created + 1;
}

}  // namespace sf
