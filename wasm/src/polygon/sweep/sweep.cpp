#include "polygon/sweep/sweep.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/charge.h"
#include "polygon/sweep/link_rings.h"
#include "polygon/sweep/sweep_state.h"

namespace sf {

using State = SweepState;

namespace {

constexpr size_t kFewToRank = 128;
constexpr size_t kFewInBucket = 8, kMostLayers = 1024;
// How many events' data are touched at once; and the number of nodes from which they do not fit the
// nearer caches.
constexpr size_t kAhead = 64, kFarApart = 32768;
bool comesBefore(const State::Event& a, const State::Event& b) {
  return below(a.at, b.at) || (a.at == b.at && a.node < b.node);
}
// How far along a loop to look for an edge near a new one.
constexpr int kRingSteps = 24;

}  // namespace

PlaneSweep::PlaneSweep() : state_(new SweepState) {}
PlaneSweep::~PlaneSweep() = default;

const std::vector<uint8_t>& PlaneSweep::reversed() const { return state_->reversed; }

bool PlaneSweep::isPlain() const { return state_->isPlain; }

void PlaneSweep::findEqual(std::vector<uint32_t>& same) const {
  const State& s = *state_;
  const ArrayView<const Point2> at = s.loops->at;
  same.resize(s.inputNodes);
  for (size_t i = 0; i < s.events.size(); ++i) {
    const bool equal = i > 0 && s.events[i - 1].at == s.events[i].at;
    same[s.events[i].node] = equal ? same[s.events[i - 1].node] : s.events[i].node;
  }
  // Vertices that no loop visits repeat a neighbour, in one direction or the other.
  const ArrayView<const uint32_t> starts = s.view->starts;
  for (uint32_t v = 0; v < starts[starts.size() - 1]; ++v) {
    if (s.loops->kind[v] != VertexKind::Unused) continue;
    const uint32_t before = s.step(v, true);
    same[v] = same[at[before] == at[v] ? before : s.step(v, false)];
  }
}

Outcome PlaneSweep::run(const PolygonView& polygon, bool sagsOnly, bool mayTurn, Work& work,
                        LinkedPolygon& linked, Visibility& seen) {
  const Outcome outcome = run(polygon, false, sagsOnly, mayTurn, work, linked, seen);
  if (outcome.ok() || !linked.turned || !work.going()) return outcome;
  // If there are several faults, the same one is reported whichever way the sweep has run.
  return run(polygon, false, sagsOnly, false, work, linked, seen);
}

Outcome PlaneSweep::runComplement(const PolygonView& polygon, Work& work, LinkedPolygon& linked,
                                  Visibility& seen) {
  return run(polygon, true, true, true, work, linked, seen);
}

Outcome PlaneSweep::run(const PolygonView& polygon, bool complement, bool sagsOnly, bool mayTurn,
                        Work& work, LinkedPolygon& linked, Visibility& seen) {
  State& s = *state_;
  Charge charge(work);
  const uint64_t n = (polygon.positions.size() + polygon.points.size()) / 2 + 4;
  const uint64_t perNode = 2 * sizeof(State::Event) + 5 * sizeof(uint32_t);
  Outcome outcome;
  if (!charge.add(n * perNode)) {
    outcome.status = work.status();
    return outcome;
  }
  outcome = linkRings(polygon, mayTurn, complement, linked, s.reversed);
  if (!outcome.ok()) return outcome;
  s.sagsOnly = sagsOnly;
  if (!s.begin(polygon, linked, seen, work)) {
    outcome.status = work.status();
    return outcome;
  }
  if (!charge.add(EdgeOrder::bytes(2 * uint64_t(n)))) outcome.status = work.status();
  if (outcome.ok()) s.sweep(work);
  if (!work.going()) {
    outcome.status = work.status();
    return outcome;
  }
  if (s.outcome.ok()) s.outcome = s.misplaced;
  if (!s.outcome.ok()) s.findSpike();
  return s.outcome;
}

/// Reports two consecutive edges in one direction, if there are any, in place of what they cause.
void State::findSpike() {
  const ArrayView<const Point2> at = loops->at;
  const uint32_t rings = uint32_t(view->starts.size()) - 1;
  for (uint32_t c = 0; c < rings; ++c)
    for (uint32_t v = view->starts[c]; v < view->starts[c + 1]; ++v) {
      if (loops->kind[v] == VertexKind::Unused) continue;
      const Point2 p = at[v], a = at[step(v, true)], b = at[step(v, false)];
      if (below(a, p) != below(b, p) || turn(p, a, b) != 0) continue;
      outcome = {};
      outcome.status = Status::DegeneratePolygon;
      outcome.loop = c, outcome.vertex = v - view->starts[c];
      return;
    }
}

bool State::begin(const PolygonView& polygon, LinkedPolygon& linked, Visibility& visibility,
                  Work& work) {
  view = &polygon, loops = &linked, seen = &visibility;
  outcome = misplaced = {};
  error = errorOfTurns(linked.least, linked.greatest);
  const size_t m = linked.at.size();
  inputNodes = m;
  // Edges come into the order in pairs, at local minima alone.
  const uint32_t chainCount = numberChains();
  const size_t count = makeEvents(EdgeOrder::takesHints(chainCount));
  isPlain = count == m;
  if (!work.tick(uint32_t(std::min<size_t>(m, 1u << 24)) * 60)) return false;
  edges.reset(chainCount, linked.least.x, linked.greatest.x);
  seen->order.clear();
  seen->left.resize(m);
  if (!sagsOnly) {
    seen->order.reserve(m);
    std::fill(seen->left.begin(), seen->left.end(), kNone);
    seen->right.assign(m, kNone);
  }
  return true;
}

/// Numbers the records of chains; returns how many there are.
uint32_t State::numberChains() {
  const ArrayView<const uint32_t> starts = view->starts;
  const uint32_t rings = uint32_t(starts.size()) - 1, n = starts[rings];
  const uint32_t m = uint32_t(loops->at.size());
  chains.resize(m);
  uint32_t count = 0;
  for (uint32_t r = 0; r < rings; ++r)
    count = numberRing(starts[r], starts[r + 1], reversed[r], count);
  if (m > n && loops->kind[n] != VertexKind::Island) count = numberRing(n, m, false, count);
  return count;
}

/// The same for the nodes from `first` to `end`, with records from `record` on. Along the loop come
/// a chain that leads down, the minimum, the chain that leads up from it, the maximum.
uint32_t State::numberRing(uint32_t first, uint32_t end, bool backwards, uint32_t record) {
  const VertexKind* kind = loops->kind.data();
  const uint32_t size = end - first, begin = backwards ? end - 1 : first,
                 step = backwards ? kNone : 1;
  // If the ring begins on a way up, its minimum comes last.
  uint32_t v = begin;
  while (kind[v] == VertexKind::Unused) v += step;
  const bool startsUp = kind[v] == VertexKind::RightBank || kind[v] == VertexKind::Ceiling;
  uint32_t e = record + uint32_t(startsUp);
  for (uint32_t i = 0, u = begin; i < size; ++i, u += step) {
    e += uint32_t(kind[u] == VertexKind::Bottom);
    chains[u] = e;
    e += uint32_t(kind[u] == VertexKind::Ceiling);
  }
  // The chain at the end is that of the beginning.
  const uint32_t next = e & ~1u;
  const uint32_t around = next - record;
  for (uint32_t i = size, u = begin + step * (size - 1); i > 0 && chains[u] >= next; --i, u -= step)
    chains[u] -= around;
  return next;
}

/// The record of an edge at the height of a local minimum, not far from it along its loop;
/// or kNone.
uint32_t State::edgeNear(uint32_t v) const {
  const Point2 at = loops->at[v];
  uint32_t after = v, before = v;
  for (int steps = 0; steps < kRingSteps; ++steps) {
    after = loops->next[after], before = loops->prev[before];
    if (below(loops->at[after], at))
      return chains[after] ^ uint32_t(loops->kind[after] == VertexKind::Bottom);
    if (below(loops->at[before], at)) return chains[before];
  }
  return kNone;
}

State::Event State::eventOf(uint32_t v, bool hints) const {
  const VertexKind kind = loops->kind[v];
  uint32_t near = kind == VertexKind::RightBank ? loops->next[v] : loops->prev[v];
  if (kind == VertexKind::Bottom) near = hints ? edgeNear(v) : kNone;
  if (kind == VertexKind::Island) near = kNone;
  return {loops->at[v], v, chains[v], near, kind};
}

/// Makes the events, sorted by height; returns how many there are.
size_t State::makeEvents(bool hints) {
  const size_t m = loops->at.size();
  const size_t count =
      m - size_t(std::count(loops->kind.begin(), loops->kind.end(), VertexKind::Unused));
  const double toKey = double(1 << 23) / (loops->greatest.y - loops->least.y);
  if (m <= kFewToRank && toKey < 1e300) {
    rankEvents(hints, toKey);
    events.resize(count);
    bool rises = true;
    for (size_t i = 1; i < count; ++i) rises &= events[i - 1].at.y < events[i].at.y;
    if (!rises) sortNearby();
    return count;
  }
  events.resize(count);
  for (uint32_t v = 0, i = 0; v < m; ++v)
    if (loops->kind[v] != VertexKind::Unused) events[i++] = eventOf(v, hints);
  sortEvents();
  return count;
}

/// Makes the events in order, if they are few. A key is a height in 2^23 steps. An event's place is
/// the number of keys below its own, which takes no branches. Events of unused nodes all get one
/// place past the others.
void State::rankEvents(bool hints, double toKey) {
  using Int4 = int32_t __attribute__((vector_size(16)));
  constexpr size_t kAtOnce = 16;
  const size_t count = loops->at.size();
  alignas(16) int32_t keys[kFewToRank + kAtOnce];
  for (size_t v = 0; v < count; ++v) {
    // The last bits of a number beyond 2^52 are an integer.
    const double height = (loops->at[v].y - loops->least.y) * toKey + 0x1p52;
    uint64_t bits;
    std::memcpy(&bits, &height, sizeof bits);
    const int32_t key = int32_t(bits) << 7 | int32_t(v);
    keys[v] = loops->kind[v] == VertexKind::Unused ? INT32_MAX : key;
  }
  std::fill(keys + count, keys + count + kAtOnce, INT32_MAX);
  events.resize(count);
  for (size_t i = 0; i < count; i += kAtOnce) {
    Int4 own[4], ranks[4] = {};
    std::memcpy(own, keys + i, sizeof own);
    for (size_t j = 0; j < count; j += 2) {
      const Int4 key = {keys[j], keys[j], keys[j], keys[j]};
      const Int4 next = {keys[j + 1], keys[j + 1], keys[j + 1], keys[j + 1]};
      for (int k = 0; k < 4; ++k) ranks[k] -= key < own[k];
      for (int k = 0; k < 4; ++k) ranks[k] -= next < own[k];
    }
    for (size_t k = 0; k < kAtOnce && i + k < count; ++k)
      events[size_t(ranks[k / 4][k % 4])] = eventOf(uint32_t(i + k), hints);
  }
}

/// Sorts the events by height: first into as many buckets as events, then each bucket. A layer of
/// equal height has as many buckets as events.
void State::sortEvents() {
  const size_t count = events.size(), layerCount = std::min(count / kFewInBucket, kMostLayers);
  const double scale = double(layerCount) / (loops->greatest.y - loops->least.y);
  if (!(scale < 1e300)) {
    std::sort(events.begin(), events.end(), comesBefore);
    return;
  }
  layers.assign(layerCount + 1, {0, 0});
  places.resize(count);
  for (size_t i = 0; i < count; ++i) {
    places[i] = uint32_t((events[i].at.y - loops->least.y) * scale);
    layers[places[i]].count += 1;
  }
  double sum = 0;
  for (Layer& layer : layers) layer.below = sum, sum += layer.count;
  buckets.assign(count + 2, 0);
  for (size_t i = 0; i < count; ++i) {
    const Layer& layer = layers[places[i]];
    const double height = (events[i].at.y - loops->least.y) * scale - places[i];
    places[i] = uint32_t(layer.below + height * layer.count);
    ++buckets[places[i] + 1];
  }
  for (size_t b = 1; b < buckets.size(); ++b) buckets[b] += buckets[b - 1];
  unsorted.swap(events);
  events.resize(count);
  for (size_t i = 0; i < count; ++i) events[buckets[places[i]]++] = unsorted[i];
  if (count > kFarApart) Buffer<Event>().swap(unsorted);  // room that flooding will want
  // Each start has moved to the end of its bucket. Buckets of a few are sorted all together, by
  // insertion, since nothing moves out of its own.
  for (size_t b = 0, begin = 0; b + 1 < buckets.size(); begin = buckets[b++])
    if (buckets[b] - begin > kFewInBucket)
      std::sort(events.begin() + ptrdiff_t(begin), events.begin() + ptrdiff_t(buckets[b]),
                comesBefore);
  sortNearby();
}

/// Sorts events none of which is far from its place.
void State::sortNearby() {
  for (size_t i = 1; i < events.size(); ++i) {
    if (!comesBefore(events[i], events[i - 1])) continue;
    const Event event = events[i];
    size_t place = i;
    do events[place] = events[place - 1];
    while (--place > 0 && comesBefore(event, events[place - 1]));
    events[place] = event;
  }
}

/// Reads what the next events will need, without waiting for it. So the delays of memory overlap;
/// one after the other they would take most of the time for large polygons.
void State::touchAhead(size_t i, size_t end) {
  const auto touchEdge = [&](uint32_t e) {
    if (e < edges.capacity()) touched += edges[e].lower;
  };
  for (; i < end; ++i) {
    const Event& event = events[i];
    const uint32_t v = event.node;
    uint32_t e = event.edge;
    switch (event.kind) {
      case VertexKind::LeftBank:
      case VertexKind::RightBank:
        touched += loops->at[event.near].x > 0;
        break;
      case VertexKind::Bottom:
        touched += loops->at[loops->prev[v]].x + loops->at[loops->next[v]].x > 0;
        touchEdge(e);
        e = event.near;
        break;
      default:
        break;
    }
    if (e >= edges.capacity()) continue;
    touchEdge(edges[e].left), touchEdge(edges[e].right);
  }
}

void State::sweep(Work& work) {
  for (size_t i = 0; i < events.size();) {
    const size_t end = std::min(i + kAhead, events.size());
    if (events.size() > kFarApart) touchAhead(i, end);
    while (i < end) {
      const size_t passed = step(i);
      if (passed == 0) return;
      i += passed;
    }
    if (!work.tick(60 * kAhead)) return;
  }
  SF_ASSERT(!misplaced.ok() || edges.leftmost() == kNone);
}

size_t State::step(size_t i) {
  const Event& event = events[i];
  size_t count = 1;
  while (i + count < events.size() && events[i + count].at == event.at) ++count;
  const auto pass = [&] {
    switch (event.kind) {
      case VertexKind::LeftBank:
      case VertexKind::RightBank:
        return passMonotone(event, event.kind == VertexKind::LeftBank);
      case VertexKind::Bottom:
        return passMinimum(event);
      case VertexKind::Ceiling:
        return passMaximum(event);
      default:
        return passIsland(event);
    }
  };
  // Nodes that the simple cases cannot pass have something else at their point, or are in disorder.
  if ((count == 1 && pass()) || passTouch(i, count)) return count;
  return 0;
}

void State::set(uint32_t e, uint32_t lower, uint32_t upper, uint32_t input, bool down) {
  CrossedEdge& edge = edges[e];
  edge.lo = loops->at[lower], edge.hi = loops->at[upper];
  edge.lower = lower, edge.upper = upper;
  edge.input = input, edge.down = down;
  edges.remember(e, edge.lo.x);
}

void State::see(uint32_t v, uint32_t left, uint32_t right) {
  if (!sagsOnly)
    seen->left[v] = lowerNode(left), seen->right[v] = lowerNode(right);
  else
    seen->left[v] = lowerNode(left);
  seen->order.push_back(v);
}

bool State::passMonotone(const Event& event, bool down) {
  const uint32_t v = event.node, e = event.edge;
  const uint32_t left = edges[e].left, right = edges[e].right;
  if (left != kNone && !(side(left, event.at) < 0)) return false;
  if (right != kNone && !(side(right, event.at) > 0)) return false;
  if (!sagsOnly) see(v, down ? kNone : left, down ? right : kNone);
  // Links to what is above the sweep line are as they were, and so is the direction.
  const uint32_t upper = event.near;
  SF_ASSERT(upper == (down ? loops->prev : loops->next)[v]);
  CrossedEdge& edge = edges[e];
  edge.lo = event.at, edge.hi = loops->at[upper];
  edge.lower = v, edge.upper = upper;
  edge.input = down ? upper : v;
  edges.remember(e, edge.lo.x);
  return true;
}

bool State::passMinimum(const Event& event) {
  const uint32_t v = event.node, prev = loops->prev[v], next = loops->next[v];
  uint32_t left, right;
  if (edges.find(event.at, event.near, left, right)) return false;
  const double shape = turn(event.at, loops->at[prev], loops->at[next]);
  if (shape == 0) return false;
  const bool concave = shape > 0;  // the link that leads up is left of the one that leads down
  if (concave != isInside(left)) misplace(v, inputOf(left));
  if (concave) loops->kind[v] = VertexKind::Sag;
  see(v, concave || sagsOnly ? left : kNone, concave ? right : kNone);
  const uint32_t up = event.edge, down = up ^ 1;
  edges.insertAfter(left, concave ? up : down);
  edges.insertAfter(concave ? up : down, concave ? down : up);
  set(down, v, prev, prev, true);
  set(up, v, next, v, false);
  return true;
}

bool State::passMaximum(const Event& event) {
  const uint32_t v = event.node, up = event.edge;
  const auto endsHere = [&](uint32_t e) { return e != kNone && edges[e].upper == v; };
  const bool concave = endsHere(edges[up].right);
  if (!concave && !endsHere(edges[up].left)) return false;
  const uint32_t first = concave ? up : edges[up].left, last = concave ? edges[up].right : up;
  const uint32_t left = edges[first].left, right = edges[last].right;
  if (left != kNone && !(side(left, event.at) < 0)) return false;
  if (right != kNone && !(side(right, event.at) > 0)) return false;
  if (concave) loops->kind[v] = VertexKind::Top;
  if (!sagsOnly) see(v, concave ? left : kNone, concave ? right : kNone);
  edges.remove(first), edges.remove(last);
  return true;
}

bool State::passIsland(const Event& event) {
  uint32_t left, right;
  if (edges.find(event.at, event.near, left, right)) return false;
  if (!isInside(left)) misplace(event.node, inputOf(left));
  see(event.node, left, right);
  return true;
}

uint32_t State::ringOf(uint32_t vertex) const {
  const ArrayView<const uint32_t> starts = view->starts;
  const uint32_t rings = uint32_t(starts.size()) - 1;
  if (vertex >= starts[rings]) return rings + (vertex - starts[rings]);  // an isolated point
  return uint32_t(std::upper_bound(starts.begin(), starts.end(), vertex) - starts.begin()) - 1;
}

/// The next vertex along the ring as it comes, or backwards, that does not repeat another.
uint32_t State::step(uint32_t v, bool backwards) const {
  const uint32_t ring = ringOf(v), first = view->starts[ring], last = view->starts[ring + 1] - 1;
  do {
    if (backwards)
      v = v == first ? last : v - 1;
    else
      v = v == last ? first : v + 1;
  } while (loops->kind[v] == VertexKind::Unused);
  return v;
}

/// The first vertex, as the ring comes, of the edge that starts at `input` along the oriented loop.
uint32_t State::inputEdge(uint32_t input) const {
  const uint32_t ring = ringOf(input);
  if (reversed[ring]) return step(input, true);
  // Of vertices at one place, the last one has the edge.
  const uint32_t last = view->starts[ring + 1] - 1;
  uint32_t v = input;
  for (;;) {
    const uint32_t next = v == last ? view->starts[ring] : v + 1;
    if (next == input || !(loops->at[next] == loops->at[v])) return v;
    v = next;
  }
}

/// Records that two edges meet as they must not. Always false.
bool State::crossing(uint32_t inputA, uint32_t inputB) {
  uint32_t a = inputEdge(inputA), b = inputEdge(inputB);
  if (a > b) std::swap(a, b);
  uint32_t ringA = ringOf(a), ringB = ringOf(b);
  outcome.status = Status::HolesOverlap;
  if (ringA == ringB) outcome.status = Status::SelfIntersecting;
  if (ringA == 0 && ringB != 0) {
    outcome.status = Status::HoleOutside;
    std::swap(a, b), std::swap(ringA, ringB);
  }
  outcome.loop = ringA, outcome.vertex = a - view->starts[ringA];
  outcome.otherLoop = ringB, outcome.otherVertex = b - view->starts[ringB];
  return false;
}

/// Records that the loop at vertex `input` is not where the polygon needs it: it is beside the edge
/// from `besideInput`, or left of everything.
void State::misplace(uint32_t input, uint32_t besideInput) {
  if (!misplaced.ok()) return;
  uint32_t ring = ringOf(input), around = besideInput == kNone ? 0 : ringOf(besideInput);
  if (ring == 0) std::swap(ring, around);
  const bool isPoint = ring + 1 >= view->starts.size();
  const bool nested = around != 0 && around != ring && !isPoint;
  misplaced.status = nested ? Status::NestedHole : Status::HoleOutside;
  misplaced.loop = ring;
  if (nested) misplaced.otherLoop = around;
}

}  // namespace sf
