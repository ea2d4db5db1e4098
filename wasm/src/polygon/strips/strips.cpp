#include "polygon/strips/strips.h"

#include "base/charge.h"
#include "base/union_find.h"
#include "polygon/strips/strip_forest.h"

namespace sf {
namespace {

// Strips longer than twice this are not joined: not worth walking along.
constexpr int kLongestStrip = 200;

class StripFinder {
 public:
  StripFinder(ArrayView<const uint32_t> twins, Work& work, StripLinks& links)
      : twins_(twins), work_(work), charge_(work), links_(links) {}

  bool run();

 private:
  void choosePaths();

  uint32_t triangleCount() const { return uint32_t(twins_.size() / 3); }

  ArrayView<const uint32_t> twins_;
  Work& work_;
  Charge charge_;
  StripForest forest_;
  StripLinks& links_;
};

/// The choices behind the least costs, from the roots down.
void StripFinder::choosePaths() {
  links_.bits.assign(triangleCount(), 0);
  std::vector<uint8_t> states(triangleCount(), kStripApart);
  const auto cross = [&](uint32_t h, int state) {
    links_.link(h, twins_[h]);
    states[twins_[h] / 3] = uint8_t(state);
  };
  for (const uint32_t t : forest_.order) {
    if (states[t] == kStripApart) {
      const StripTop top = StripForest::bestTop(forest_.below(twins_, t));
      for (int i = 0; i < top.links; ++i) cross(forest_.edgeOf(t, top.edge[i]), top.state[i]);
    } else if (states[t] >= kStripTurns) {
      const int turn = (states[t] - kStripTurns) >> 1, starts = (states[t] - kStripTurns) & 1;
      const uint32_t exit = forest_.edgeOf(t, turn);
      int state;
      StripForest::tail(forest_.costs[twins_[exit] / 3], turn, starts, state);
      cross(exit, state);
    }
  }
}

bool StripFinder::run() {
  if (!charge_.add(uint64_t(triangleCount()) * (sizeof(StripCosts) + 16))) return false;
  if (!forest_.grow(twins_, work_)) return false;
  choosePaths();
  // Across edges that the forest has not.
  return joinStripEnds(twins_, 1, work_, links_);
}

/// Whether the path that starts in the end triangle `first` begins with a swap: on the other side of the triangles it does where it
/// does not on this one. All other swaps are the same from either end.
bool beginsWithSwap(ArrayView<const uint32_t> twins, const StripLinks& links, uint32_t first,
                    bool turned) {
  const uint32_t out = links.only(first);
  if (out == kNone) return false;
  const uint32_t in = twins[out], next = links.exit(in);
  return next != kNone && turnOf(in, next) == uint32_t(turned);
}

void writeStrip(ArrayView<const uint32_t> corners, ArrayView<const uint32_t> twins,
                const StripLinks& links, uint32_t first, bool turned,
                std::vector<uint32_t>& vertices) {
  uint32_t out = links.only(first);
  if (out == kNone) {
    vertices.insert(vertices.end(), &corners[3 * first], &corners[3 * first] + 3);
    if (turned) std::swap(vertices[vertices.size() - 2], vertices.back());
    return;
  }
  uint32_t p = corners[out], q = corners[nextInTriangle(out)];  // the last two indices
  if (turned) std::swap(p, q);
  vertices.push_back(corners[prevInTriangle(out)]);
  vertices.push_back(p);
  vertices.push_back(q);
  while (out != kNone) {
    const uint32_t in = twins[out], apex = corners[prevInTriangle(in)];
    out = links.exit(in);
    if (out != kNone) {
      const uint32_t a = corners[out], b = corners[nextInTriangle(out)];
      const bool swap = (a == apex ? b : a) != q;
      if (swap) vertices.push_back(p);
      p = swap ? p : q;
      q = apex;
    }
    vertices.push_back(apex);
  }
}

}  // namespace

bool StripLinks::onOnePath(ArrayView<const uint32_t> twins, uint32_t h) const {
  const uint32_t ends[2] = {h / 3, twins[h] / 3};
  uint32_t out[2] = {only(ends[0]), only(ends[1])};
  uint32_t at[2] = {ends[0], ends[1]};
  for (int step = 0; step < kLongestStrip; ++step)
    for (int i = 0; i < 2; ++i) {
      if (out[i] == kNone) return at[i] == ends[1 - i];
      at[i] = twins[out[i]] / 3;
      out[i] = exit(twins[out[i]]);
    }
  return true;  // perhaps not; but then both are long
}

uint32_t StripLinks::swapsToJoin(ArrayView<const uint32_t> twins, uint32_t h) const {
  // The turn in the triangle of an end when its strip goes on across its half-edge, and the turn
  // before that; 2 where there is none.
  const auto turnsTo = [&](uint32_t out, uint32_t& before) {
    before = 2;
    const uint32_t in = only(out / 3);
    if (in == kNone) return 2u;
    const uint32_t g = twins[in], entry = exit(g);
    if (entry != kNone) before = turnOf(entry, g);
    return turnOf(in, out);
  };
  uint32_t before, after, swaps = 0;
  const uint32_t here = turnsTo(h, before), there = turnsTo(twins[h], after);
  if (here < 2) swaps += before == here;
  if (there < 2) swaps += after == there;
  if (here < 2 && there < 2) swaps += here == 1 - there;  // `there` is seen the other way round
  return swaps;
}

bool joinStripEnds(ArrayView<const uint32_t> twins, uint32_t mostSwaps, Work& work,
                   StripLinks& links) {
  const uint32_t count = uint32_t(twins.size() / 3);
  UnionFind paths(count);
  for (uint32_t h = 0; h < 3 * count; ++h)
    if (links.linked(h) && twins[h] < h) paths.unite(h / 3, twins[h] / 3);
  for (uint32_t allowed = 0; allowed <= mostSwaps; ++allowed) {
    for (uint32_t t = 0; t < count; ++t) {
      if (links.count(t) > 1) continue;
      for (uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
        const uint32_t g = twins[h];
        if (g == kNone || links.linked(h)) continue;
        if (links.count(t) > 1 || links.count(g / 3) > 1) continue;
        if (links.swapsToJoin(twins, h) > allowed || !paths.unite(t, g / 3)) continue;
        links.link(h, g);
      }
    }
    if (!work.tick(16 * count)) return false;
  }
  return true;
}

bool linkStrips(ArrayView<const uint32_t> twins, Work& work, StripLinks& links) {
  return StripFinder(twins, work, links).run();
}

bool writeStrips(ArrayView<const uint32_t> corners, ArrayView<const uint32_t> twins,
                 const StripLinks& links, ArrayView<const uint32_t> among, Work& work,
                 std::vector<uint32_t>& vertices, std::vector<uint32_t>& starts, bool turned) {
  std::vector<bool> written(corners.size() / 3, false);
  vertices.clear();
  vertices.reserve(among.size() + among.size() / 2);
  starts.assign(1, 0);
  for (const uint32_t t : among) {
    if (written[t] || links.count(t) > 1) continue;
    uint32_t last = t;
    written[t] = true;
    for (uint32_t out = links.only(t); out != kNone; out = links.exit(twins[out])) {
      last = twins[out] / 3;
      written[last] = true;
    }
    const bool reversed =
        beginsWithSwap(twins, links, t, turned) && !beginsWithSwap(twins, links, last, turned);
    writeStrip(corners, twins, links, reversed ? last : t, turned, vertices);
    starts.push_back(uint32_t(vertices.size()));
    if (!work.tick(32)) return false;
  }
  return true;
}

bool makeStrips(ArrayView<const uint32_t> corners, ArrayView<const uint32_t> twins, Work& work,
                std::vector<uint32_t>& vertices, std::vector<uint32_t>& starts) {
  StripLinks links;
  if (!linkStrips(twins, work, links)) return false;
  std::vector<uint32_t> all(corners.size() / 3);
  for (uint32_t t = 0; t < all.size(); ++t) all[t] = t;
  return writeStrips(corners, twins, links, all, work, vertices, starts);
}

}  // namespace sf
