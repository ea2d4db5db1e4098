#include "polygon/strips.h"

#include "base/charge.h"
#include "polygon/triangle_mesh.h"

namespace sf {
namespace {

// Costs in sixteenths of an index, so that of equal index counts the one with fewer strips wins.
constexpr uint32_t kStripCost = 33;
constexpr uint32_t kSwapCost = 16;
constexpr uint32_t kForbidden = 1u << 30;

// A turn of a path in a triangle that it enters by half-edge `in` and leaves by `out`: 0 if out follows
// in, 1 otherwise. Travelled the other way, the turn is the other one.
uint32_t turnOf(uint32_t in, uint32_t out) { return out == nextInTriangle(in) ? 0 : 1; }
// The first turn of a strip, in its second triangle, has to be 1 or costs a swap.
uint32_t firstTurnCost(uint32_t turn) { return turn == 0 ? kSwapCost : 0; }

class StripMaker {
 public:
  StripMaker(ArrayView<const uint32_t> corners, ArrayView<const uint32_t> twins, Work& work)
      : corners_(corners), twins_(twins), work_(work), charge_(work) {}

  bool run(std::vector<uint32_t>& vertices, std::vector<uint32_t>& starts);

 private:
  // Least costs of what hangs below a triangle t in the forest, by what t has to do with the strip of
  // the triangle above. The strip itself is paid for at its upper end.
  struct Costs {
    uint32_t apart;        // not in the strip of the triangle above
    uint32_t ends;         // that strip ends in t
    uint32_t turns[2][2];  // it goes on below t: [turn in t, seen from above][it starts down there]
  };

  bool growForest();
  void findCosts(uint32_t t);
  bool choosePaths();
  bool joinEnds();
  void writeStrip(uint32_t first, std::vector<uint32_t>& vertices);

  uint32_t triangleCount() const { return uint32_t(corners_.size() / 3); }
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

  bool linked(uint32_t h) const { return links_[h / 3] >> (h % 3) & 1; }
  void link(uint32_t h) {
    links_[h / 3] |= uint8_t(1u << (h % 3));
    const uint32_t g = twins_[h];
    links_[g / 3] |= uint8_t(1u << (g % 3));
  }
  int linkCount(uint32_t t) const {
    return (links_[t] & 1) + (links_[t] >> 1 & 1) + (links_[t] >> 2 & 1);
  }
  uint32_t onlyLink(uint32_t t) const {
    return links_[t] == 0 ? kNone : 3 * t + (links_[t] == 1 ? 0 : links_[t] == 2 ? 1 : 2);
  }
  // The half-edge by which a path that entered t by `in` leaves it, kNone where it ends.
  uint32_t exitOf(uint32_t in) const {
    if (linked(nextInTriangle(in))) return nextInTriangle(in);
    return linked(prevInTriangle(in)) ? prevInTriangle(in) : kNone;
  }
  uint32_t swapsFrom(uint32_t first) const;
  uint32_t root(uint32_t t) {
    while (path_[t] != t) t = path_[t] = path_[path_[t]];
    return t;
  }

  ArrayView<const uint32_t> corners_, twins_;
  Work& work_;
  Charge charge_;
  std::vector<uint32_t> order_;  // triangles, each after the one above it
  std::vector<uint32_t> up_;     // half-edge of each triangle towards the one above, kNone at roots
  std::vector<Costs> costs_;
  std::vector<uint8_t> links_;  // bit k: the strip crosses half-edge 3t + k
  std::vector<uint32_t> path_;  // union-find over the triangles of one path
};

// How a triangle stands to the strip of the triangle above: Costs' members by number.
enum State { kApart = 0, kEnds = 1, kTurns = 2 };  // kTurns + 2 turn + starts

// Depth first, so that paths are long; straight on (the turns alternating) where there is a choice.
bool StripMaker::growForest() {
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
uint32_t StripMaker::tail(uint32_t child, uint32_t turn, bool starts, int& choice) const {
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
uint32_t StripMaker::tailOfTop(uint32_t child, bool starts, int& choice) const {
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
StripMaker::Choice StripMaker::bestTop(uint32_t t) const {
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

void StripMaker::findCosts(uint32_t t) {
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
bool StripMaker::choosePaths() {
  const uint32_t count = triangleCount();
  costs_.resize(count);
  for (uint32_t i = count; i-- > 0;) {
    findCosts(order_[i]);
    if (!work_.tick(64)) return false;
  }
  links_.assign(count, 0);
  std::vector<uint8_t> state(count, kApart);
  for (const uint32_t t : order_) {
    if (state[t] == kApart) {
      const Choice best = bestTop(t);
      for (int i = 0; i < best.links; ++i) {
        link(best.edge[i]);
        state[twins_[best.edge[i]] / 3] = uint8_t(best.state[i]);
      }
    } else if (state[t] >= kTurns) {
      const uint32_t turn = (state[t] - kTurns) >> 1, starts = (state[t] - kTurns) & 1;
      const uint32_t exit = turn == 0 ? nextInTriangle(up_[t]) : prevInTriangle(up_[t]);
      int choice;
      const uint32_t child = childAcross(exit);
      tail(child, turn, starts, choice);
      link(exit);
      state[child] = uint8_t(choice);
    }
  }
  return true;
}

/// Joins paths end to end across edges that the forest has not, while that saves indices.
bool StripMaker::joinEnds() {
  const uint32_t count = triangleCount();
  path_.resize(count);
  for (uint32_t t = 0; t < count; ++t) path_[t] = t;
  for (uint32_t h = 0; h < 3 * count; ++h)
    if (twins_[h] != kNone && linked(h)) path_[root(h / 3)] = root(twins_[h] / 3);

  // Turn in triangle h / 3 when its path leaves by h, and the one before: 2 where there is none.
  const auto turnsTo = [&](uint32_t h, uint32_t& before) {
    before = 2;
    const uint32_t in = onlyLink(h / 3);
    if (in == kNone) return 2u;
    const uint32_t g = twins_[in], entry = linkCount(g / 3) < 2 ? kNone : exitOf(g);
    if (entry != kNone) before = turnOf(entry, g);
    return turnOf(in, h);
  };
  for (uint32_t allowed = 0; allowed < 2; ++allowed) {
    for (uint32_t h = 0; h < 3 * count; ++h) {
      const uint32_t g = twins_[h];
      if (g == kNone || g < h || linked(h)) continue;
      if (linkCount(h / 3) > 1 || linkCount(g / 3) > 1 || root(h / 3) == root(g / 3)) continue;
      uint32_t before, after;
      const uint32_t here = turnsTo(h, before);
      const uint32_t there = turnsTo(g, after);  // seen the other way round
      uint32_t swaps = 0;
      if (here < 2) swaps += before == here;
      if (there < 2) swaps += after == there;
      if (here < 2 && there < 2) swaps += here == 1 - there;
      if (swaps > allowed) continue;
      link(h);
      path_[root(h / 3)] = root(g / 3);
    }
    if (!work_.tick(16 * count)) return false;
  }
  return true;
}

/// Swaps of the path that starts in the end triangle `first`.
uint32_t StripMaker::swapsFrom(uint32_t first) const {
  uint32_t swaps = 0, last = 0;  // a first turn 0 costs as much as one after another turn 0
  for (uint32_t out = onlyLink(first); out != kNone;) {
    const uint32_t in = twins_[out];
    out = exitOf(in);
    if (out == kNone) break;
    const uint32_t turn = turnOf(in, out);
    swaps += turn == last;
    last = turn;
  }
  return swaps;
}

void StripMaker::writeStrip(uint32_t first, std::vector<uint32_t>& vertices) {
  uint32_t out = onlyLink(first);
  if (out == kNone) {
    vertices.insert(vertices.end(), &corners_[3 * first], &corners_[3 * first] + 3);
    return;
  }
  uint32_t p = corners_[out], q = corners_[nextInTriangle(out)];  // the last two indices
  vertices.push_back(corners_[prevInTriangle(out)]);
  vertices.push_back(p);
  vertices.push_back(q);
  while (out != kNone) {
    const uint32_t in = twins_[out], apex = corners_[prevInTriangle(in)];
    out = exitOf(in);
    if (out != kNone) {
      const uint32_t a = corners_[out], b = corners_[nextInTriangle(out)];
      const bool swap = (a == apex ? b : a) != q;
      if (swap) vertices.push_back(p);
      p = swap ? p : q;
      q = apex;
    }
    vertices.push_back(apex);
  }
}

bool StripMaker::run(std::vector<uint32_t>& vertices, std::vector<uint32_t>& starts) {
  const uint32_t count = triangleCount();
  vertices.clear();
  starts.assign(1, 0);
  if (!charge_.add(uint64_t(count) * (sizeof(Costs) + 16))) return false;
  if (!growForest() || !choosePaths() || !joinEnds()) return false;
  std::vector<bool> written(count, false);
  vertices.reserve(size_t(count) + count / 2);
  for (const uint32_t t : order_) {
    if (written[t] || linkCount(t) > 1) continue;
    uint32_t last = t;
    written[t] = true;
    for (uint32_t out = onlyLink(t); out != kNone; out = exitOf(twins_[out])) {
      last = twins_[out] / 3;
      written[last] = true;
    }
    writeStrip(swapsFrom(last) < swapsFrom(t) ? last : t, vertices);
    starts.push_back(uint32_t(vertices.size()));
    if (!work_.tick(32)) return false;
  }
  return true;
}

}  // namespace

bool makeStrips(ArrayView<const uint32_t> corners, ArrayView<const uint32_t> twins, Work& work,
                std::vector<uint32_t>& vertices, std::vector<uint32_t>& starts) {
  return StripMaker(corners, twins, work).run(vertices, starts);
}

}  // namespace sf
