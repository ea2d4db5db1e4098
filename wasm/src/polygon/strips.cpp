#include "polygon/strips.h"

#include "base/charge.h"

namespace sf {
namespace {

// Costs in sixteenths of an index, so that of equal index counts the one with fewer strips wins.
constexpr uint32_t kStripCost = 33;
constexpr uint32_t kSwapCost = 16;
constexpr uint32_t kForbidden = 1u << 30;

// A turn of a path in a triangle that it enters by half-edge `in` and leaves by `out`: 0 if out
// follows in, 1 otherwise. Travelled the other way, the turn is the other one.
uint32_t turnOf(uint32_t in, uint32_t out) { return out == nextInTriangle(in) ? 0 : 1; }
// The first turn of a strip, in its second triangle, has to be 1 or costs a swap.
uint32_t firstTurnCost(uint32_t turn) { return turn == 0 ? kSwapCost : 0; }

class StripFinder {
 public:
  StripFinder(ArrayView<const uint32_t> twins, Work& work, StripLinks& links)
      : twins_(twins), work_(work), charge_(work), links_(links) {}

  bool run();

 private:
  // Least costs of what hangs below a triangle t in the forest, by what t has to do with the strip
  // of the triangle above. The strip itself is paid for at its upper end.
  struct Costs {
    uint32_t apart;        // not in the strip of the triangle above
    uint32_t ends;         // that strip ends in t
    uint32_t turns[2][2];  // it goes on below t: [turn in t, seen from above][it starts down there]
  };

  bool growForest();
  void findCosts(uint32_t t);
  bool choosePaths();
  bool joinEnds();

  uint32_t triangleCount() const { return uint32_t(twins_.size() / 3); }
  // The triangle below t across its half-edge h, or kNone.
  uint32_t childAcross(uint32_t h) const {
    const uint32_t g = twins_[h];
    return g != kNone && up_[g / 3] == g ? g / 3 : kNone;
  }
  uint32_t apart(uint32_t child) const { return child == kNone ? 0 : costs_[child].apart; }
  uint32_t tail(uint32_t child, uint32_t turn, bool starts, int& choice) const;
  uint32_t tailOfTop(uint32_t child, bool starts, int& choice) const;
  struct Choice {
    uint32_t cost = kForbidden;
    int links = 0;  // half-edges of the triangle that its strip crosses downwards
    uint32_t edge[2] = {kNone, kNone};
    int state[2] = {0, 0};  // of the triangles there
  };
  Choice bestTop(uint32_t t) const;

  uint32_t root(uint32_t t) {
    while (path_[t] != t) t = path_[t] = path_[path_[t]];
    return t;
  }

  ArrayView<const uint32_t> twins_;
  Work& work_;
  Charge charge_;
  std::vector<uint32_t> order_;  // triangles, each after the one above it
  std::vector<uint32_t> up_;     // half-edge of each triangle towards the one above, kNone at roots
  std::vector<Costs> costs_;
  StripLinks& links_;
  std::vector<uint32_t> path_;  // union-find over the triangles of one path
};

// How a triangle stands to the strip of the triangle above: the members of Costs by number, the
// turns as kTurns + 2 turn + starts.
constexpr int kApart = 0, kEnds = 1, kTurns = 2;

// Depth first, so that paths are long; straight on (the turns alternating) where there is a choice.
bool StripFinder::growForest() {
  const uint32_t count = triangleCount();
  order_.reserve(count);
  up_.assign(count, kNone);
  std::vector<bool> seen(count, false);
  std::vector<uint32_t> stack;  // half-edges to enter a triangle by
  const auto enter = [&](uint32_t t) {
    seen[t] = true;
    order_.push_back(t);
    const uint32_t in = up_[t] == kNone ? 3 * t : up_[t];
    uint32_t turn = 0;
    if (up_[t] != kNone) {  // the turn in the triangle above
      const uint32_t above = twins_[in] / 3;
      turn = up_[above] == kNone ? 0 : turnOf(up_[above], twins_[in]);
    }
    const uint32_t last = turn == 0 ? prevInTriangle(in) : nextInTriangle(in);
    const uint32_t first = turn == 0 ? nextInTriangle(in) : prevInTriangle(in);
    const uint32_t exits[3] = {up_[t] == kNone ? in : kNone, first, last};
    for (const uint32_t h : exits)
      if (h != kNone && twins_[h] != kNone && !seen[twins_[h] / 3]) stack.push_back(twins_[h]);
  };
  const auto grow = [&](uint32_t seed) {
    enter(seed);
    while (!stack.empty()) {
      const uint32_t in = stack.back();
      stack.pop_back();
      if (seen[in / 3]) continue;
      up_[in / 3] = in;
      enter(in / 3);
      if (!work_.tick(32)) return false;
    }
    return true;
  };
  // From ears where there are any: a path that begins in the middle leaves two ends there.
  for (uint32_t t = 0; t < count; ++t) {
    const int neighbours =
        (twins_[3 * t] != kNone) + (twins_[3 * t + 1] != kNone) + (twins_[3 * t + 2] != kNone);
    if (!seen[t] && neighbours <= 1 && !grow(t)) return false;
  }
  for (uint32_t t = 0; t < count; ++t)
    if (!seen[t] && !grow(t)) return false;
  return true;
}

/// Cost below t of a strip that comes from t, with that turn there, and ends below; `starts` if the
/// lower end is where the strip starts. `choice` is the State of the child.
uint32_t StripFinder::tail(uint32_t child, uint32_t turn, bool starts, int& choice) const {
  const Costs& c = costs_[child];
  uint32_t best = c.ends + (starts ? firstTurnCost(1 - turn) : 0);
  choice = kEnds;
  for (uint32_t d = 0; d < 2; ++d) {
    const uint32_t cost = c.turns[d][starts] + (d == turn ? kSwapCost : 0);
    if (cost < best) best = cost, choice = int(kTurns + 2 * d + starts);
  }
  return best;
}

/// The same where the upper end of the strip is in t itself.
uint32_t StripFinder::tailOfTop(uint32_t child, bool starts, int& choice) const {
  const Costs& c = costs_[child];
  uint32_t best = c.ends;
  choice = kEnds;
  for (uint32_t d = 0; d < 2; ++d) {
    const uint32_t cost = c.turns[d][starts] + (starts ? 0 : firstTurnCost(d));
    if (cost < best) best = cost, choice = int(kTurns + 2 * d + starts);
  }
  return best;
}

/// The best strip whose uppermost triangle is t.
StripFinder::Choice StripFinder::bestTop(uint32_t t) const {
  uint32_t sum = kStripCost, child[3];
  for (uint32_t k = 0; k < 3; ++k) sum += apart(child[k] = childAcross(3 * t + k));
  Choice best;
  best.cost = sum;
  for (uint32_t k = 0; k < 3; ++k) {
    if (child[k] == kNone) continue;
    for (const bool starts : {false, true}) {
      int state;
      const uint32_t cost = sum - apart(child[k]) + tailOfTop(child[k], starts, state);
      if (cost < best.cost) best = {cost, 1, {3 * t + k, kNone}, {state, 0}};
    }
    const uint32_t l = (k + 1) % 3;  // and on through the next half-edge: turn 0 in t from k to l
    if (child[l] == kNone) continue;
    const uint32_t others = sum - apart(child[k]) - apart(child[l]);
    for (const bool starts : {false, true}) {
      // From k the path comes up, so that seen downwards into k its turn is the other one.
      int a, b;
      const uint32_t cost = others + tail(child[k], 1, starts, a) + tail(child[l], 0, !starts, b);
      if (cost < best.cost) best = {cost, 2, {3 * t + k, 3 * t + l}, {a, b}};
    }
  }
  return best;
}

void StripFinder::findCosts(uint32_t t) {
  Costs& c = costs_[t];
  c.apart = bestTop(t).cost;
  if (up_[t] == kNone) return;
  const uint32_t exits[2] = {nextInTriangle(up_[t]), prevInTriangle(up_[t])};
  const uint32_t child[2] = {childAcross(exits[0]), childAcross(exits[1])};
  c.ends = apart(child[0]) + apart(child[1]);
  for (uint32_t turn = 0; turn < 2; ++turn)
    for (uint32_t starts = 0; starts < 2; ++starts) {
      int choice;
      c.turns[turn][starts] =
          child[turn] == kNone ? kForbidden
                               : apart(child[1 - turn]) + tail(child[turn], turn, starts, choice);
    }
}

/// Costs from the leaves up, then the choices behind the best of them from the roots down.
bool StripFinder::choosePaths() {
  const uint32_t count = triangleCount();
  costs_.resize(count);
  for (uint32_t i = count; i-- > 0;) {
    findCosts(order_[i]);
    if (!work_.tick(64)) return false;
  }
  links_.bits.assign(count, 0);
  std::vector<uint8_t> state(count, kApart);
  for (const uint32_t t : order_) {
    if (state[t] == kApart) {
      const Choice best = bestTop(t);
      for (int i = 0; i < best.links; ++i) {
        links_.link(best.edge[i], twins_[best.edge[i]]);
        state[twins_[best.edge[i]] / 3] = uint8_t(best.state[i]);
      }
    } else if (state[t] >= kTurns) {
      const uint32_t turn = (state[t] - kTurns) >> 1, starts = (state[t] - kTurns) & 1;
      const uint32_t exit = turn == 0 ? nextInTriangle(up_[t]) : prevInTriangle(up_[t]);
      int choice;
      const uint32_t child = childAcross(exit);
      tail(child, turn, starts, choice);
      links_.link(exit, twins_[exit]);
      state[child] = uint8_t(choice);
    }
  }
  return true;
}

/// Joins paths end to end across edges that the forest has not, while that saves indices.
bool StripFinder::joinEnds() {
  const uint32_t count = triangleCount();
  path_.resize(count);
  for (uint32_t t = 0; t < count; ++t) path_[t] = t;
  for (uint32_t h = 0; h < 3 * count; ++h)
    if (links_.linked(h)) path_[root(h / 3)] = root(twins_[h] / 3);
  for (uint32_t allowed = 0; allowed < 2; ++allowed) {
    for (uint32_t h = 0; h < 3 * count; ++h) {
      const uint32_t g = twins_[h];
      if (g == kNone || g < h || links_.linked(h)) continue;
      if (links_.count(h / 3) > 1 || links_.count(g / 3) > 1) continue;
      if (links_.swapsToJoin(twins_, h) > allowed || root(h / 3) == root(g / 3)) continue;
      links_.link(h, g);
      path_[root(h / 3)] = root(g / 3);
    }
    if (!work_.tick(16 * count)) return false;
  }
  return true;
}

bool StripFinder::run() {
  if (!charge_.add(uint64_t(triangleCount()) * (sizeof(Costs) + 16))) return false;
  return growForest() && choosePaths() && joinEnds();
}

/// Swaps of the path that starts in the end triangle `first`.
uint32_t swapsFrom(ArrayView<const uint32_t> twins, const StripLinks& links, uint32_t first) {
  uint32_t swaps = 0, last = 0;  // a first turn 0 costs as much as one after another turn 0
  for (uint32_t out = links.only(first); out != kNone;) {
    const uint32_t in = twins[out];
    out = links.exit(in);
    if (out == kNone) break;
    const uint32_t turn = turnOf(in, out);
    swaps += turn == last;
    last = turn;
  }
  return swaps;
}

void writeStrip(ArrayView<const uint32_t> corners, ArrayView<const uint32_t> twins,
                const StripLinks& links, uint32_t first, std::vector<uint32_t>& vertices) {
  uint32_t out = links.only(first);
  if (out == kNone) {
    vertices.insert(vertices.end(), &corners[3 * first], &corners[3 * first] + 3);
    return;
  }
  uint32_t p = corners[out], q = corners[nextInTriangle(out)];  // the last two indices
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

bool linkStrips(ArrayView<const uint32_t> twins, Work& work, StripLinks& links) {
  return StripFinder(twins, work, links).run();
}

bool writeStrips(ArrayView<const uint32_t> corners, ArrayView<const uint32_t> twins,
                 const StripLinks& links, ArrayView<const uint32_t> among, Work& work,
                 std::vector<uint32_t>& vertices, std::vector<uint32_t>& starts) {
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
    const bool reversed = swapsFrom(twins, links, last) < swapsFrom(twins, links, t);
    writeStrip(corners, twins, links, reversed ? last : t, vertices);
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
