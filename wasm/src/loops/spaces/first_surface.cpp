#include "loops/spaces/first_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/accurate_cross.h"
#include "base/predicates.h"
#include "loops/problem/weight.h"

namespace sf {
namespace {

using Triangle = std::array<uint32_t, 3>;

constexpr uint32_t kMostVertices = 2000;
/// How many discs of one triangle are tried, the nearest ones, and how many of these may grow.
constexpr size_t kDiscs = 12, kGrown = 3;
/// The most sides of a disc.
constexpr size_t kMostSides = 12;
/// How many corners of the disc's boundary, the nearest to the loop, a band may begin at.
constexpr size_t kBeginnings = 2;
/// Nanoseconds for each cell of a band's table.
constexpr uint32_t kTimeOfCell = 100;

/// Something by its number, and what it is ranked by.
using Ranked = std::pair<double, uint32_t>;

/// Keeps the `count` least, in increasing order.
void keepLeast(std::vector<Ranked>& items, size_t count) {
  count = std::min(count, items.size());
  for (size_t i = 0; i < count; ++i)
    for (size_t j = i + 1; j < items.size(); ++j)
      if (items[j] < items[i]) std::swap(items[i], items[j]);
  items.resize(count);
}

/// The triangles so far, wound alike.
class Patchwork {
 public:
  Patchwork(const LoopSet& loops, const TriangleWeights& weights, Work& work)
      : loops_(loops), weights_(weights), work_(work) {}

  /// Fills one loop, ear by ear, the shortest chord first. False if only collinear ears are left.
  bool fill(uint32_t loop);
  /// Puts one more loop in. False if no band can be sewn.
  bool insert(uint32_t loop);
  const std::vector<Triangle>& triangles() const { return triangles_; }

 private:
  /// A disc of triangles and its boundary, as the triangles pass it.
  struct Disc {
    std::vector<uint32_t> triangles;
    std::vector<uint32_t> boundary;
  };
  struct Band {
    double cost =
        kInfinity;  // with the angles to what is around the disc, less what the disc costs
    std::vector<Triangle> triangles;
  };
  struct Try {
    Disc disc;
    Band band;
  };
  /// What stands across each side of a disc: its normal, or zero where a loop runs.
  using Around = std::vector<Vec3>;

  Vec3 normalOf(const Triangle& t) const {
    return accurateCross(loops_.position(t[0]), loops_.position(t[1]), loops_.position(t[2]));
  }
  double costOf(const Triangle& t) const;
  double angleCost(Vec3 a, Vec3 b) const { return weights_.dihedral * angleBetween(a, b); }
  /// The triangle that passes from a to b, or kNone.
  uint32_t triangleAt(uint32_t a, uint32_t b) const;
  double costOf(const Disc& disc, Around& around) const;
  /// The disc with the triangle across a side added; empty if its boundary would touch itself.
  Disc grown(const Disc& disc, size_t side) const;
  /// How far a loop is from p, and its vertex there.
  Ranked distanceTo(uint32_t loop, Vec3 p) const;
  Band sew(const Disc& disc, uint32_t loop);
  void grow(Try& grows, uint32_t loop);
  void sewFrom(const std::vector<uint32_t>& boundary, const Around& around,
               const std::vector<uint32_t>& way, Band& best);

  const LoopSet& loops_;
  const TriangleWeights& weights_;
  Work& work_;
  std::vector<Triangle> triangles_;
};

double Patchwork::costOf(const Triangle& t) const {
  const Vec3 a = loops_.position(t[0]), b = loops_.position(t[1]), c = loops_.position(t[2]);
  if (collinear(a, b, c)) return kInfinity;
  return weights_.area * 0.5 * length(normalOf(t)) +
         weights_.perimeter * (distance(a, b) + distance(b, c) + distance(c, a));
}

bool Patchwork::fill(uint32_t loop) {
  struct Ear {
    double chord;
    uint32_t at, before, after;
    bool operator<(const Ear& e) const {
      return chord > e.chord || (chord == e.chord && at > e.at);  // the shortest on top
    }
  };
  const uint32_t first = loops_.first(loop), n = loops_.size(loop);
  std::vector<uint32_t> next(n), before(n);
  std::vector<Ear> heap;
  const auto vertex = [&](uint32_t i) { return loops_.position(first + i); };
  const auto offer = [&](uint32_t i) {
    const Vec3 a = vertex(before[i]), b = vertex(next[i]);
    // An ear without area may get some once its neighbours have gone.
    if (collinear(a, vertex(i), b)) return;
    heap.push_back({distance(a, b), i, before[i], next[i]});
    std::push_heap(heap.begin(), heap.end());
  };
  for (uint32_t i = 0; i < n; ++i) next[i] = (i + 1) % n, before[i] = (i + n - 1) % n;
  for (uint32_t i = 0; i < n; ++i) offer(i);
  for (uint32_t left = n; left > 2 && !heap.empty();) {
    std::pop_heap(heap.begin(), heap.end());
    const Ear ear = heap.back();
    heap.pop_back();
    if (before[ear.at] != ear.before || next[ear.at] != ear.after) continue;  // outdated
    triangles_.push_back({first + ear.before, first + ear.at, first + ear.after});
    next[ear.before] = ear.after, before[ear.after] = ear.before;
    next[ear.at] = before[ear.at] = kNone;
    if (--left == 2) return true;
    offer(ear.before);
    offer(ear.after);
  }
  return false;
}

uint32_t Patchwork::triangleAt(uint32_t a, uint32_t b) const {
  for (uint32_t t = 0; t < triangles_.size(); ++t)
    for (int i = 0; i < 3; ++i)
      if (triangles_[t][i] == a && triangles_[t][(i + 1) % 3] == b) return t;
  return kNone;
}

Ranked Patchwork::distanceTo(uint32_t loop, Vec3 p) const {
  Ranked nearest{kInfinity, kNone};
  for (uint32_t v = loops_.first(loop); v < loops_.first(loop) + loops_.size(loop); ++v)
    nearest = std::min(nearest, Ranked{distance(p, loops_.position(v)), v});
  return nearest;
}

double Patchwork::costOf(const Disc& disc, Around& around) const {
  double cost = 0;
  for (const uint32_t t : disc.triangles) {
    cost += costOf(triangles_[t]);
    for (int i = 0; i < 3; ++i) {
      const uint32_t a = triangles_[t][i], b = triangles_[t][(i + 1) % 3];
      const uint32_t across = triangleAt(b, a);
      if (across == kNone) continue;
      const bool isInside =
          std::find(disc.triangles.begin(), disc.triangles.end(), across) != disc.triangles.end();
      cost +=
          (isInside ? 0.5 : 1) * angleCost(normalOf(triangles_[t]), normalOf(triangles_[across]));
    }
  }
  around.clear();
  for (size_t s = 0; s < disc.boundary.size(); ++s) {
    const uint32_t across =
        triangleAt(disc.boundary[(s + 1) % disc.boundary.size()], disc.boundary[s]);
    around.push_back(across == kNone ? Vec3{0, 0, 0} : normalOf(triangles_[across]));
  }
  return cost;
}

Patchwork::Disc Patchwork::grown(const Disc& disc, size_t side) const {
  const uint32_t a = disc.boundary[side], b = disc.boundary[(side + 1) % disc.boundary.size()];
  const uint32_t across = triangleAt(b, a);
  if (across == kNone) return {};
  const Triangle& t = triangles_[across];
  const uint32_t apex = t[0] != a && t[0] != b ? t[0] : t[1] != a && t[1] != b ? t[1] : t[2];
  if (std::find(disc.boundary.begin(), disc.boundary.end(), apex) != disc.boundary.end()) return {};
  Disc larger = disc;
  larger.triangles.push_back(across);
  larger.boundary.insert(larger.boundary.begin() + std::ptrdiff_t(side) + 1, apex);
  return larger;
}

/// The best band that begins with the first side of the boundary at the first vertex of the way,
/// and ends with the last side of the way at the first vertex of the boundary. So a vertex of the
/// boundary and one of the way are joined by an edge of the band at most once.
///   around  across each side of the boundary
///   way     the loop, in the direction opposite to that in which the band passes it
void Patchwork::sewFrom(const std::vector<uint32_t>& boundary, const Around& around,
                        const std::vector<uint32_t>& way, Band& best) {
  const size_t p = boundary.size(), l = way.size();
  // A state is an edge of the band, from boundary i to way j, with the triangle before it: one
  // along the boundary (0), or along the way (1).
  struct State {
    double cost = kInfinity;
    uint8_t from = 0;
    Vec3 normal{};
  };
  std::vector<State> table((p + 1) * (l + 1) * 2);
  const auto at = [&](size_t i, size_t j, int move) -> State& {
    return table[((i * (l + 1)) + j) * 2 + size_t(move)];
  };
  const auto triangleOf = [&](size_t i, size_t j, int move) -> Triangle {
    // The triangle before the edge (i, j).
    if (move == 0) return {boundary[i - 1], boundary[i % p], way[j % l]};
    return {boundary[i % p], way[j % l], way[j - 1]};
  };
  if (!work_.tick(uint32_t(2 * p * l) * kTimeOfCell)) return;
  Vec3 firstNormal{};
  for (size_t i = 1; i <= p; ++i)
    for (size_t j = 0; j <= l; ++j) {
      // The pair of the first edge may not come again before the end.
      if ((i == p && j == 0) || (j == l && i < p)) continue;
      for (int move = 0; move < 2; ++move) {
        if (move == 0 ? (j == l) : j == 0) continue;
        const Triangle t = triangleOf(i, j, move);
        double own = costOf(t);
        if (own == kInfinity) continue;
        State& state = at(i, j, move);
        state.normal = normalOf(t);
        if (move == 0 && dot(around[i - 1], around[i - 1]) > 0)
          own += angleCost(state.normal, around[i - 1]);
        if (move == 0 && i == 1 && j == 0) {
          state.cost = own;
          firstNormal = state.normal;
          continue;
        }
        for (int from = 0; from < 2; ++from) {
          const State& before = move == 0 ? at(i - 1, j, from) : at(i, j - 1, from);
          if (before.cost == kInfinity) continue;
          const double cost = before.cost + own + angleCost(before.normal, state.normal);
          if (cost < state.cost) state.cost = cost, state.from = uint8_t(from);
        }
      }
    }
  const State& end = at(p, l, 1);
  const double cost = end.cost + angleCost(end.normal, firstNormal);
  if (!(cost < best.cost)) return;
  best.cost = cost;
  best.triangles.clear();
  size_t i = p, j = l;
  for (int move = 1; i > 0;) {
    best.triangles.push_back(triangleOf(i, j, move));
    const int from = at(i, j, move).from;
    if (move == 0 && i == 1 && j == 0) break;
    if (move == 0)
      --i;
    else
      --j;
    move = from;
  }
}

Patchwork::Band Patchwork::sew(const Disc& disc, uint32_t loop) {
  Around around;
  const double saved = costOf(disc, around);
  const uint32_t first = loops_.first(loop), l = loops_.size(loop);
  std::vector<Ranked> corners;
  for (uint32_t c = 0; c < disc.boundary.size(); ++c)
    corners.push_back({distanceTo(loop, loops_.position(disc.boundary[c])).first, c});
  keepLeast(corners, kBeginnings);
  Band best;
  for (const Ranked& corner : corners) {
    std::vector<uint32_t> boundary = disc.boundary;
    Around turned = around;
    std::rotate(boundary.begin(), boundary.begin() + corner.second, boundary.end());
    std::rotate(turned.begin(), turned.begin() + corner.second, turned.end());
    const uint32_t begin = distanceTo(loop, loops_.position(boundary[0])).second;
    std::vector<uint32_t> way;
    for (uint32_t i = 0; i < l; ++i) way.push_back(first + (begin - first + i) % l);
    sewFrom(boundary, turned, way, best);
    std::reverse(way.begin() + 1, way.end());
    sewFrom(boundary, turned, way, best);
  }
  best.cost -= saved;
  return best;
}

/// Lets a disc grow by the triangles across its sides while that makes its band cheaper.
void Patchwork::grow(Try& grows, uint32_t loop) {
  for (bool more = true; more && grows.disc.boundary.size() < kMostSides && work_.going();) {
    more = false;
    const Disc now = grows.disc;
    for (size_t side = 0; side < now.boundary.size(); ++side) {
      Try larger{grown(now, side), {}};
      if (larger.disc.boundary.empty()) continue;
      larger.band = sew(larger.disc, loop);
      if (!(larger.band.cost < grows.band.cost)) continue;
      grows = std::move(larger);
      more = true;
    }
  }
}

bool Patchwork::insert(uint32_t loop) {
  std::vector<Ranked> nearest;
  for (uint32_t t = 0; t < triangles_.size(); ++t) {
    Vec3 middle{0, 0, 0};
    for (const uint32_t v : triangles_[t]) middle = middle + (1.0 / 3) * loops_.position(v);
    nearest.push_back({distanceTo(loop, middle).first, t});
  }
  keepLeast(nearest, kDiscs);
  std::vector<Try> tries;
  std::vector<Ranked> cheapest;
  for (const Ranked& near : nearest) {
    const Triangle& t = triangles_[near.second];
    Try first{{{near.second}, {t[0], t[1], t[2]}}, {}};
    first.band = sew(first.disc, loop);
    cheapest.push_back({first.band.cost, uint32_t(tries.size())});
    tries.push_back(std::move(first));
  }
  keepLeast(cheapest, kGrown);
  Try best;
  for (const Ranked& cheap : cheapest) {
    Try& grows = tries[cheap.second];
    grow(grows, loop);
    if (grows.band.cost < best.band.cost) best = std::move(grows);
  }
  if (best.band.cost == kInfinity || !work_.going()) return false;
  for (const uint32_t t : best.disc.triangles) triangles_[t][0] = kNone;
  size_t kept = 0;
  for (const Triangle& t : triangles_)
    if (t[0] != kNone) triangles_[kept++] = t;
  triangles_.resize(kept);
  triangles_.insert(triangles_.end(), best.band.triangles.begin(), best.band.triangles.end());
  return true;
}

/// The loops, each after one that it is near to: the first is the largest.
std::vector<uint32_t> orderOf(const LoopSet& loops) {
  const uint32_t k = loops.loopCount();
  std::vector<double> away(k, kInfinity);
  std::vector<uint32_t> order;
  uint32_t next = 0;
  for (uint32_t c = 1; c < k; ++c)
    if (loops.size(c) > loops.size(next)) next = c;
  while (true) {
    order.push_back(next);
    away[next] = -1;
    if (order.size() == k) return order;
    const uint32_t last = next;
    next = kNone;
    for (uint32_t c = 0; c < k; ++c) {
      if (away[c] < 0) continue;
      for (uint32_t u = loops.first(last); u < loops.first(last) + loops.size(last); ++u)
        for (uint32_t v = loops.first(c); v < loops.first(c) + loops.size(c); ++v)
          away[c] = std::min(away[c], distance(loops.position(u), loops.position(v)));
      if (next == kNone || away[c] < away[next]) next = c;
    }
  }
}

}  // namespace

bool hasFirstSurface(const LoopSet& loops) { return loops.vertexCount() <= kMostVertices; }

bool firstSurface(const LoopSet& loops, const TriangleWeights& weights, Work& work,
                  std::vector<uint32_t>& triangles) {
  triangles.clear();
  Patchwork patchwork(loops, weights, work);
  const std::vector<uint32_t> order = orderOf(loops);
  bool found = patchwork.fill(order[0]);
  for (size_t i = 1; found && i < order.size(); ++i) found = patchwork.insert(order[i]);
  if (!work.going()) return false;
  if (!found) return true;
  for (const Triangle& t : patchwork.triangles())
    triangles.insert(triangles.end(), t.begin(), t.end());
  return true;
}

}  // namespace sf
