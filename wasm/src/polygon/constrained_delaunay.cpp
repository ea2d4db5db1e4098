#include "polygon/constrained_delaunay.h"

#include <algorithm>

#include "base/assert.h"
#include "base/charge.h"
#include "polygon/in_circle.h"
#include "polygon/metric.h"
#include "polygon/triangle_mesh.h"
#include "polygon/turn.h"

namespace sf {
namespace {

// Twins from here on are no half-edges: kNone at the loops, else kFixed + i for what halves_[i], the
// other half-edge of a fixed edge being that of i ^ 1.
constexpr uint32_t kFixed = 1u << 31;
// So many triangles next to each other in the list, to the power of two, are a block; so few are one.
// Within a block flips are fewer than what merges have to prepare, also on smooth curves; measured.
constexpr int kBlockBits = 5;
constexpr uint32_t kBlockHalves = 3u << kBlockBits, kFewHalves = 2 * kBlockHalves;
constexpr int kLevels = 32;

/// How far apart the blocks of two triangles are: the first binary digit in which they differ.
int levelOf(uint32_t t, uint32_t s) {
  int level = 0;
  for (uint32_t d = (t ^ s) >> kBlockBits; d != 0; d >>= 1) ++level;
  return level;
}

}  // namespace

bool ConstrainedDelaunay::run(const LinkedPolygon& loops, Work& work, ArrayView<uint32_t> triangles,
                              ArrayView<uint32_t> twins) {
  if (triangles.size() < 6) return true;
  Charge charge(work);
  constexpr uint64_t kPerCorner = 4 * sizeof(uint32_t);
  if (!charge.add(kPerCorner * triangles.size() + sizeof(Point2) * uint64_t(loops.at.size())))
    return false;
  at_ = loops.at.data();
  metric_ = metricPoints(loops.at, scaled_, isExact_).data();
  count_ = uint32_t(triangles.size());
  corners_ = triangles.data(), twins_ = twins.data();
  waits_.assign(count_, false);
  waiting_ = 0;
  // Flips stay within a block, unless they take the place of merges.
  const uint32_t room = isExact_ ? kFewHalves : count_;
  if (stack_.size() < room) stack_.resize(room);
  return flipBlocks(work) && giveUpEdges(work);
}

inline void ConstrainedDelaunay::push(uint32_t h) {
  stack_[waiting_++] = h;
  waits_[h] = true;
}

/// Makes each block constrained Delaunay by itself; the edges between blocks become fixed.
bool ConstrainedDelaunay::flipBlocks(Work& work) {
  halves_.clear();
  const uint32_t size = count_ <= kFewHalves ? kFewHalves : kBlockHalves;
  for (uint32_t first = 0; first < count_; first += size) {
    const uint32_t end = std::min(first + size, count_);
    for (uint32_t h = first; h < end; ++h) {
      const uint32_t g = twins_[h];
      if (g <= h || g >= kFixed) continue;
      if (g < end) {
        push(h);
        continue;
      }
      const uint32_t i = uint32_t(halves_.size());
      halves_.push_back(h), halves_.push_back(g);
      twins_[h] = kFixed + i + 1, twins_[g] = kFixed + i;
    }
    if (!work.tick(50 * (end - first)) || !flipStacked(work)) return false;
  }
  return true;
}

/// The fixed edges in the order of giving up, as places in halves_.
void ConstrainedDelaunay::orderEdges() {
  uint32_t starts[kLevels + 1] = {};
  const uint32_t count = uint32_t(halves_.size());
  const auto level = [&](uint32_t i) { return levelOf(halves_[i] / 3, halves_[i + 1] / 3); };
  for (uint32_t i = 0; i < count; i += 2) ++starts[level(i) + 1];
  for (int l = 0; l < kLevels; ++l) starts[l + 1] += starts[l];
  order_.resize(count / 2);
  for (uint32_t i = 0; i < count; i += 2) order_[starts[level(i)]++] = i;
}

bool ConstrainedDelaunay::giveUpEdges(Work& work) {
  orderEdges();
  for (const uint32_t i : order_) {
    const uint32_t h = halves_[i], g = halves_[i + 1];
    twins_[h] = g, twins_[g] = h;
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
  return true;
}

// Inline: calls would take a twentieth of the time.
inline __attribute__((always_inline)) bool ConstrainedDelaunay::isIllegal(uint32_t h) const {
  const uint32_t g = twins_[h];
  const uint32_t a = corners_[h], b = corners_[g];
  const uint32_t c = corners_[prevInTriangle(h)], d = corners_[prevInTriangle(g)];
  if (!inCircle(metric_[a], metric_[b], metric_[c], metric_[d])) return false;
  // Implied where circles are exact; elsewhere what they say may be all wrong.
  return isExact_ || (turn(at_[a], at_[d], at_[c]) > 0 && turn(at_[b], at_[c], at_[d]) > 0);
}

void ConstrainedDelaunay::setTwin(uint32_t h, uint32_t g) {
  twins_[h] = g;
  if (g < kFixed)
    twins_[g] = h;
  else if (g != kNone)
    halves_[(g - kFixed) ^ 1] = h;
}

/// Puts the other diagonal into the two triangles at h; it comes after h, and after its twin.
void ConstrainedDelaunay::flip(uint32_t h) {
  const uint32_t g = twins_[h];
  const uint32_t h1 = nextInTriangle(h), g1 = nextInTriangle(g);
  corners_[h1] = corners_[prevInTriangle(g)], corners_[g1] = corners_[prevInTriangle(h)];
  setTwin(h, twins_[g1]), setTwin(g, twins_[h1]);
  twins_[h1] = g1, twins_[g1] = h1;
}

/// Flips the edges of the stack that are illegal, and all that become so.
bool ConstrainedDelaunay::flipStacked(Work& work) {
  constexpr uint32_t kTick = 1024;
  uint32_t flips = 0;
  while (waiting_ > 0) {
    const uint32_t h = stack_[--waiting_], g = twins_[h];
    waits_[h] = false;
    if (g >= kFixed || !isIllegal(h)) continue;
    flip(h);
    for (const uint32_t e : {h, prevInTriangle(h), g, prevInTriangle(g)})
      if (twins_[e] < kFixed && !waits_[e] && !waits_[twins_[e]]) push(e);
    if (++flips % kTick == 0 && !work.tick(50 * kTick)) return false;
  }
  return work.tick(50 * (flips % kTick));
}

/// A triangle in the place of one taken away: its first half-edge.
uint32_t ConstrainedDelaunay::create(uint32_t a, uint32_t b, uint32_t c) {
  SF_ASSERT(turn(at_[a], at_[b], at_[c]) > 0);
  const uint32_t h = 3 * free_.back();
  free_.pop_back();
  corners_[h] = a, corners_[h + 1] = b, corners_[h + 2] = c;
  return h;
}

/// Takes away the triangles on the left border's first edge, as long as `right` is in their circles.
void ConstrainedDelaunay::takeLeft(uint32_t left, uint32_t right) {
  for (;;) {
    Border& border = left_.back();
    const uint32_t h = border.outer;
    if (h >= kFixed) return;
    const uint32_t after = nextInTriangle(h), before = prevInTriangle(h), apex = corners_[before];
    if (!inCircle(metric_[left], metric_[border.vertex], metric_[apex], metric_[right])) return;
    free_.push_back(h / 3);
    border.outer = twins_[after];
    left_.push_back({apex, twins_[before]});
  }
}

/// The same for the right border.
void ConstrainedDelaunay::takeRight(uint32_t left, uint32_t right) {
  for (;;) {
    Border& border = right_.back();
    const uint32_t h = border.outer;
    if (h >= kFixed) return;
    const uint32_t after = nextInTriangle(h), before = prevInTriangle(h), apex = corners_[before];
    if (!inCircle(metric_[border.vertex], metric_[right], metric_[apex], metric_[left])) return;
    free_.push_back(h / 3);
    border.outer = twins_[before];
    right_.push_back({apex, twins_[after]});
  }
}

/// Merges what lies to the left of edge h, which is illegal, and to the right of it. Returns how many
/// triangles change.
uint32_t ConstrainedDelaunay::merge(uint32_t h) {
  const uint32_t g = twins_[h], bottom = corners_[h], top = corners_[g];
  const uint32_t h1 = nextInTriangle(h), h2 = prevInTriangle(h);
  const uint32_t g1 = nextInTriangle(g), g2 = prevInTriangle(g);
  left_.clear(), right_.clear(), free_.clear();
  left_.push_back({top, twins_[h1]}), left_.push_back({corners_[h2], twins_[h2]});
  right_.push_back({top, twins_[g2]}), right_.push_back({corners_[g2], twins_[g1]});
  free_.push_back(h / 3), free_.push_back(g / 3);
  // The first triangle is the tangent of two convex chains: of the neighbours of the lower end to
  // either side, under inversion at it.
  for (size_t taken = 0; taken != free_.size();) {
    taken = free_.size();
    takeLeft(bottom, right_.back().vertex);
    takeRight(left_.back().vertex, bottom);
  }
  uint32_t left = left_.back().vertex, right = right_.back().vertex;
  uint32_t t = create(bottom, right, left), base = t + 1;
  setTwin(t, right_.back().outer), setTwin(t + 2, left_.back().outer);
  left_.pop_back(), right_.pop_back();
  uint32_t created = 1;
  for (;; ++created) {
    const bool seesLeft = turn(at_[left], at_[right], at_[left_.back().vertex]) > 0;
    const bool seesRight = turn(at_[left], at_[right], at_[right_.back().vertex]) > 0;
    if (seesLeft) takeLeft(left, right);
    if (seesRight) takeRight(left, right);
    const Border l = left_.back(), r = right_.back();
    const bool endsLeft = l.vertex == top, endsRight = r.vertex == top;
    const bool goesRight =
        !seesLeft || endsLeft ||
        (seesRight && !endsRight &&
         inCircle(metric_[left], metric_[right], metric_[l.vertex], metric_[r.vertex]));
    t = create(left, right, goesRight ? r.vertex : l.vertex);
    setTwin(t, base);
    if (endsLeft && endsRight) {
      setTwin(t + 1, r.outer), setTwin(t + 2, l.outer);
      break;
    }
    if (goesRight) {
      setTwin(t + 1, r.outer);
      base = t + 2, right = r.vertex;
      right_.pop_back();
    } else {
      setTwin(t + 2, l.outer);
      base = t + 1, left = l.vertex;
      left_.pop_back();
    }
  }
  SF_ASSERT(free_.empty());
  return created + 1;
}

}  // namespace sf
