#include "polygon/constrained_delaunay.h"

#include <numeric>

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
// Edges between triangles among so many, to the power of two, come in any order.
constexpr int kFirstLevel = 3;
constexpr int kLevels = 32;
// Half-edges up to which flips are fewer than what merges have to prepare, measured.
constexpr uint32_t kFewHalves = 3 * 64;

/// How far apart two triangles are in the list: the first binary digit in which they differ.
int levelOf(uint32_t t, uint32_t s) {
  int level = 0;
  for (uint32_t d = (t ^ s) >> kFirstLevel; d != 0; d >>= 1) ++level;
  return level;
}

}  // namespace

bool ConstrainedDelaunay::run(const LinkedPolygon& loops, bool simple, Work& work,
                              std::vector<uint32_t>& triangles, std::vector<uint32_t>& twins) {
  if (triangles.size() < 6) return true;
  Charge charge(work);
  const uint64_t perCorner = 3 * sizeof(uint32_t) + (simple ? 0 : 2);
  if (!charge.add(perCorner * triangles.size() + sizeof(Point2) * uint64_t(loops.at.size())))
    return false;
  at_ = loops.at.data();
  metric_ = metricPoints(loops.at, scaled_, isExact_).data();
  count_ = uint32_t(triangles.size());
  corners_ = triangles.data(), twins_ = twins.data();
  return isExact_ && count_ <= kFewHalves ? flipAll(work) : giveUpEdges(fixEdges(), simple, work);
}

bool ConstrainedDelaunay::flipAll(Work& work) {
  stack_.clear();
  for (uint32_t h = 0; h < count_; ++h)
    if (h < twins_[h] && twins_[h] != kNone) stack_.push_back(h);
  return work.tick(50 * (count_ + flipStacked()));
}

/// Fixes all edges, and orders them; returns how many there are.
uint32_t ConstrainedDelaunay::fixEdges() {
  uint32_t starts[kLevels + 1] = {};
  for (uint32_t h = 0; h < count_; ++h)
    if (h < twins_[h] && twins_[h] != kNone) ++starts[levelOf(h / 3, twins_[h] / 3) + 1];
  for (int level = 0; level < kLevels; ++level) starts[level + 1] += starts[level];
  const uint32_t edges = starts[kLevels];
  halves_.resize(2 * size_t(edges));
  for (uint32_t h = 0; h < count_; ++h) {
    const uint32_t g = twins_[h];
    if (g >= kFixed) continue;
    const uint32_t i = 2 * starts[levelOf(h / 3, g / 3)]++;
    halves_[i] = h, halves_[i + 1] = g;
    twins_[h] = kFixed + i + 1, twins_[g] = kFixed + i;
  }
  return edges;
}

bool ConstrainedDelaunay::giveUpEdges(uint32_t count, bool simple, Work& work) {
  if (!simple) {
    parts_.resize(count_ / 3);
    std::iota(parts_.begin(), parts_.end(), 0);
  }
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t h = halves_[2 * i], g = halves_[2 * i + 1];
    twins_[h] = g, twins_[g] = h;
    bool apart = isExact_;
    if (!simple) {
      const uint32_t a = partOf(h / 3), b = partOf(g / 3);
      apart &= a != b;
      parts_[a] = b;
    }
    uint32_t changes = 1;
    if (isIllegal(h)) {
      stack_.assign(1, h);
      changes += apart ? merge(h) : flipStacked();
    }
    if (!work.tick(50 * changes)) return false;
  }
  return true;
}

/// A name for the part of the polygon, between fixed edges, that triangle t belongs to.
uint32_t ConstrainedDelaunay::partOf(uint32_t t) {
  while (parts_[t] != t) t = parts_[t] = parts_[parts_[t]];
  return t;
}

bool ConstrainedDelaunay::isIllegal(uint32_t h) const {
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

/// Flips the edges of the stack that are illegal, and all that become so. Returns the number of flips.
uint32_t ConstrainedDelaunay::flipStacked() {
  uint32_t flips = 0;
  while (!stack_.empty()) {
    const uint32_t h = stack_.back(), g = twins_[h];
    stack_.pop_back();
    if (g >= kFixed || !isIllegal(h)) continue;
    const uint32_t h1 = nextInTriangle(h), g1 = nextInTriangle(g);
    const uint32_t h2 = prevInTriangle(h), g2 = prevInTriangle(g);
    corners_[h1] = corners_[g2], corners_[g1] = corners_[h2];
    setTwin(h, twins_[g1]), setTwin(g, twins_[h1]);
    twins_[h1] = g1, twins_[g1] = h1;
    stack_.insert(stack_.end(), {h, h2, g, g2});
    ++flips;
  }
  return flips;
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
