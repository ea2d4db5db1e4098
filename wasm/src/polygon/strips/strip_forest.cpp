#include "polygon/strips/strip_forest.h"

namespace sf {
namespace {

constexpr int kSwapCost = StripForest::kIndex;
constexpr int kStripCost = 2 * StripForest::kIndex + 1;
constexpr int kForbidden = 1 << 13;

// The first turn of a strip, in its second triangle, has to be 1 or costs a swap.
int firstTurnCost(int turn) { return turn == 0 ? kSwapCost : 0; }

/// As StripForest::tail where the upper end of the strip is in the triangle above itself.
int tailOfTop(const StripCosts& c, int starts, int& state) {
  int best = c.ends;
  state = kStripEnds;
  for (int d = 0; d < 2; ++d) {
    const int cost = c.turns[d][starts] + (starts == 1 ? 0 : firstTurnCost(d));
    if (cost < best) best = cost, state = kStripTurns + 2 * d + starts;
  }
  return best;
}

}  // namespace

/// Notes triangle t, and where to go from there. The triangle straight on, where turns alternate,
/// is noted last and so taken first.
void StripForest::enter(ArrayView<const uint32_t> twins, uint32_t t) {
  seen_[t] = true;
  order.push_back(t);
  const uint32_t in = up[t] == kNone ? 3 * t : up[t];
  uint32_t turn = 0;
  if (up[t] != kNone) {  // the turn in the triangle above
    const uint32_t above = twins[in] / 3;
    turn = up[above] == kNone ? 0 : turnOf(up[above], twins[in]);
  }
  const uint32_t last = turn == 0 ? prevInTriangle(in) : nextInTriangle(in);
  const uint32_t first = turn == 0 ? nextInTriangle(in) : prevInTriangle(in);
  const uint32_t exits[3] = {up[t] == kNone ? in : kNone, first, last};
  for (const uint32_t h : exits)
    if (h != kNone && twins[h] != kNone && !seen_[twins[h] / 3]) stack_.push_back(twins[h]);
}

bool StripForest::growFrom(ArrayView<const uint32_t> twins, uint32_t seed, Work& work) {
  enter(twins, seed);
  while (!stack_.empty()) {
    const uint32_t in = stack_.back();
    stack_.pop_back();
    if (seen_[in / 3]) continue;
    up[in / 3] = in;
    enter(twins, in / 3);
    if (!work.tick(32)) return false;
  }
  return true;
}

// Depth first, so that paths are long.
bool StripForest::grow(ArrayView<const uint32_t> twins, Work& work) {
  const uint32_t count = uint32_t(twins.size() / 3);
  order.clear(), stack_.clear();
  order.reserve(count);
  up.assign(count, kNone);
  seen_.assign(count, false);
  // Starts from ears if there are any: a path that begins in the middle leaves two ends there.
  for (uint32_t t = 0; t < count; ++t) {
    const int neighbours =
        (twins[3 * t] != kNone) + (twins[3 * t + 1] != kNone) + (twins[3 * t + 2] != kNone);
    if (!seen_[t] && neighbours <= 1 && !growFrom(twins, t, work)) return false;
  }
  for (uint32_t t = 0; t < count; ++t)
    if (!seen_[t] && !growFrom(twins, t, work)) return false;
  costs.resize(count);
  for (uint32_t i = count; i-- > 0;) costs[order[i]] = costsOf(below(twins, order[i]));
  return work.tick(64 * uint64_t(count));
}

StripForest::Below StripForest::below(ArrayView<const uint32_t> twins, uint32_t t) const {
  Below result;
  for (int place = 0; place < (up[t] == kNone ? 3 : 2); ++place) {
    const uint32_t child = childAcross(twins, edgeOf(t, place));
    if (child != kNone) result.costs[place] = &costs[child];
  }
  return result;
}

int64_t StripForest::total() const {
  int64_t sum = 0;
  for (const StripCosts& c : costs) sum += c.own;
  return sum;
}

int StripForest::tail(const StripCosts& below, int turn, int starts, int& state) {
  int best = below.ends + (starts == 1 ? firstTurnCost(1 - turn) : 0);
  state = kStripEnds;
  for (int d = 0; d < 2; ++d) {
    const int cost = below.turns[d][starts] + (d == turn ? kSwapCost : 0);
    if (cost < best) best = cost, state = kStripTurns + 2 * d + starts;
  }
  return best;
}

StripTop StripForest::bestTop(const Below& below) {
  StripTop best;
  best.cost = kStripCost;
  for (int k = 0; k < 3; ++k) {
    if (below.costs[k] == nullptr) continue;
    for (int starts = 0; starts < 2; ++starts) {
      int state;
      const int cost = kStripCost + tailOfTop(*below.costs[k], starts, state);
      if (cost < best.cost) best = {cost, 1, {k, 0}, {state, 0}};
    }
    const int l = (k + 1) % 3;  // and on through the next half-edge: turn 0 from k to l
    if (below.costs[l] == nullptr) continue;
    for (int starts = 0; starts < 2; ++starts) {
      // From k the path comes up, so that seen downwards into k its turn is the other one.
      int a, b;
      const int cost = kStripCost + tail(*below.costs[k], 1, starts, a) +
                       tail(*below.costs[l], 0, 1 - starts, b);
      if (cost < best.cost) best = {cost, 2, {k, l}, {a, b}};
    }
  }
  return best;
}

StripCosts StripForest::costsOf(const Below& below) {
  StripCosts c;
  c.own = int16_t(bestTop(below).cost);
  c.ends = int16_t(-c.own);
  for (int turn = 0; turn < 2; ++turn)
    for (int starts = 0; starts < 2; ++starts) {
      int state;
      c.turns[turn][starts] = int16_t(below.costs[turn] == nullptr
                                          ? kForbidden
                                          : tail(*below.costs[turn], turn, starts, state) - c.own);
    }
  return c;
}

}  // namespace sf
