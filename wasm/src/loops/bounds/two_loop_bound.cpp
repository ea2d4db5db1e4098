#include "loops/bounds/two_loop_bound.h"

#include <algorithm>

#include "base/sort.h"

namespace sf {
namespace {

/// Incidences that a context visits in the time of a split of RelaxedBound.
constexpr uint64_t kVisitsPerSplit = 16;

}  // namespace

TwoLoopBound::TwoLoopBound(const Pass& pass, uint32_t rootVertex)
    : pass_(pass), memory_(pass.work), transform_(pass.measure) {
  const LoopSet& loops = pass.loops;
  const uint32_t a = loops.loopOf(rootVertex), b = 1 - a;
  firstA_ = loops.first(a);
  sizeA_ = loops.size(a);
  rootPlace_ = loops.next(rootVertex) - firstA_;
  firstB_ = loops.first(b);
  sizeB_ = loops.size(b);
}

/// W of the run from `start` forward to `end`, closed by the edge of t opposite to the vertex
/// `opposite`: 0 for a loop edge, infinity where a loop edge would close a longer run.
double TwoLoopBound::segmentValue(uint32_t t, uint32_t opposite, uint32_t start,
                                  uint32_t end) const {
  if (pass_.loops.next(start) == end) return 0;
  const uint32_t edge = pass_.set.edgeOpposite(t, opposite);
  if (pass_.set.isLoopEdge[edge]) return kInfinity;
  return pass_.segments.value(pass_.set.slotOpposite(t, opposite),
                              pass_.segments.sideFrom(edge, start));
}

void TwoLoopBound::findSpanningEdges() {
  const CandidateSet& set = pass_.set;
  std::vector<std::pair<uint32_t, uint32_t>> ends;  // place and number
  for (uint32_t e = 0; e < set.edgeCount(); ++e) {
    uint32_t u = set.edgeVertices[2 * size_t(e)], v = set.edgeVertices[2 * size_t(e) + 1];
    if (isOnA(u) == isOnA(v)) continue;
    if (isOnA(v)) std::swap(u, v);
    ends.push_back({placeOf(u), v - firstB_});
  }
  sf::sort(ends.begin(), ends.end());
  for (const auto& [place, number] : ends)
    spans_.push_back({set.edgeBetween(vertexA(place), firstB_ + number), place, number, 0, 0});
  firstSpan_.assign(sizeA_ + 1, 0);
  columnSize_.assign(sizeB_, 0);
  uint32_t incidences = 0;
  for (uint32_t i = 0; i < spans_.size(); ++i) {
    SpanningEdge& span = spans_[i];
    spanOf_[span.edge] = i;
    ++firstSpan_[span.place + 1];
    span.first = incidences;
    span.column = columnSize_[span.number];
    incidences += set.degree(span.edge);
    columnSize_[span.number] += set.degree(span.edge);
  }
  for (uint32_t place = 0; place < sizeA_; ++place) firstSpan_[place + 1] += firstSpan_[place];
  spans_.push_back({kNone, kNone, kNone, incidences, 0});
}

bool TwoLoopBound::buildIncidences() {
  const CandidateSet& set = pass_.set;
  const Measure& measure = pass_.measure;
  std::vector<uint32_t> around;
  for (size_t i = 0; i + 1 < spans_.size(); ++i) {
    const uint32_t edge = spans_[i].edge;
    around.clear();
    for (uint32_t s = set.edgeSlots[edge]; s < set.edgeSlots[edge + 1]; ++s) around.push_back(s);
    sf::sort(around.begin(), around.end(),
             [&](uint32_t x, uint32_t y) { return set.slotTheta[x] < set.slotTheta[y]; });
    for (size_t j = 0; j < around.size(); ++j)
      incidenceOf_[around[j]] = spans_[i].first + uint32_t(j);
  }
  incidences_.resize(spans_.back().first);
  for (size_t i = 0; i + 1 < spans_.size(); ++i) {
    const uint32_t edge = spans_[i].edge;
    const uint32_t u = vertexA(spans_[i].place), v = firstB_ + spans_[i].number;
    for (uint32_t s = set.edgeSlots[edge]; s < set.edgeSlots[edge + 1]; ++s) {
      const uint32_t t = set.slotTriangle[s], apex = set.slotApex[s];
      const double w = pass_.triangleCost[t];
      Incidence& at = incidences_[incidenceOf_[s]];
      at.theta = set.slotTheta[s];
      at.isOnA = isOnA(apex);
      at.apex = at.isOnA ? placeOf(apex) : apex - firstB_;
      const uint32_t left = at.isOnA ? u : v;
      at.rest = incidenceOf_[set.slotOpposite(t, left)];
      const SpanningEdge& rest = spans_[spanOf_[set.edgeOpposite(t, left)]];
      at.column = rest.column + at.rest - rest.first;
      for (int backward = 0; backward < 2; ++backward)
        at.base[backward] = measure.join(w, at.isOnA   ? segmentValue(t, v, u, apex)
                                            : backward ? segmentValue(t, u, v, apex)
                                                       : segmentValue(t, u, apex, v));
    }
    if (!pass_.work.tick(100 * set.degree(edge))) return false;
  }
  return true;
}

/// Computes the front before the access edge, with `length` edges of B.
void TwoLoopBound::computeFront(Context& c, const SpanningEdge& access, uint32_t length) {
  const uint32_t closingPlace = spans_[c.closing].place, q = spans_[c.closing].number;
  const bool whole = length == sizeB_;
  const Incidence* around = &incidences_[access.first];
  const uint32_t degree = (&access)[1].first - access.first;
  double* values = whole ? &c.whole[access.column] : &c.values[access.first];
  size_t inner = 0, outer = 0;
  for (uint32_t i = 0; i < degree; ++i) {
    const Incidence& t = around[i];
    uint32_t at = t.apex;
    if (!t.isOnA) {
      at = c.reversed ? q - at : at - q;
      if (at >= sizeB_) at += sizeB_;  // below 0
    }
    // The access triangle is outside of the front. At the ends of the closing edge there are
    // triangles on both sides.
    if (t.isOnA ? at < access.place || at >= closingPlace : at == 0 || at >= length) {
      outerTheta_[outer] = t.theta;
      outer_[outer++] = i;
    }
    if (t.isOnA ? at < access.place || at > closingPlace : at >= length) continue;
    const double rest = whole && t.isOnA ? c.whole[t.column] : c.values[t.rest];
    const double base = pass_.measure.join(t.base[c.reversed], rest);
    if (base == kInfinity) continue;
    innerTheta_[inner] = t.theta;
    innerBase_[inner++] = base;
  }
  if (inner == 0) return;
  ++domainCount_;
  transform_.applySorted(innerTheta_.data(), innerBase_.data(), inner, outerTheta_.data(), outer,
                         outerValue_.data());
  for (size_t j = 0; j < outer; ++j) values[outer_[j]] = outerValue_[j];
}

bool TwoLoopBound::computeContext(Context& c) {
  const CandidateSet& set = pass_.set;
  const SpanningEdge& closing = spans_[c.closing];
  const uint32_t q = closing.number;
  c.values.assign(incidenceEnd(closing.place), kInfinity);
  c.whole.assign(columnSize_[q], kInfinity);
  for (uint32_t place = closing.place + 1; place-- > 0;) {
    const SpanningEdge *first = &spans_[firstSpan_[place]], *last = &spans_[firstSpan_[place + 1]];
    // The edges at this vertex of A in the order in which B is passed from q on.
    const SpanningEdge* from = first;
    while (from < last && from->number < q) ++from;
    const bool touchesQ = from < last && from->number == q;
    if (touchesQ && place == closing.place)
      for (uint32_t s = set.edgeSlots[from->edge]; s < set.edgeSlots[from->edge + 1]; ++s)
        c.values[incidenceOf_[s]] = leastPair_[s];
    else if (touchesQ)
      computeFront(c, *from, 0);
    if (c.reversed) {
      for (const SpanningEdge* e = from; e-- > first;) computeFront(c, *e, q - e->number);
      for (const SpanningEdge* e = last; e-- > from + touchesQ;)
        computeFront(c, *e, q + sizeB_ - e->number);
    } else {
      for (const SpanningEdge* e = from + touchesQ; e < last; ++e)
        computeFront(c, *e, e->number - q);
      for (const SpanningEdge* e = first; e < from; ++e)
        computeFront(c, *e, e->number + sizeB_ - q);
    }
    // The closing edge cannot be closed by all of B.
    if (touchesQ && place < closing.place) computeFront(c, *from, sizeB_);
  }
  return pass_.work.tick(uint32_t(std::min<size_t>(10 * c.values.size(), 1u << 30)));
}

/// The edges between vertices of A, short runs first, the root last.
std::vector<uint32_t> TwoLoopBound::chordsByLength() const {
  const CandidateSet& set = pass_.set;
  std::vector<std::pair<uint32_t, uint32_t>> byLength;
  for (uint32_t e = 0; e < set.edgeCount(); ++e) {
    const uint32_t u = set.edgeVertices[2 * size_t(e)], v = set.edgeVertices[2 * size_t(e) + 1];
    if (!isOnA(u) || !isOnA(v)) continue;
    const uint32_t x = placeOf(u), y = placeOf(v), length = x < y ? y - x : x - y;
    // Only at the root may a loop edge close more than itself.
    if (!set.isLoopEdge[e] || length + 1 == sizeA_) byLength.push_back({length, e});
  }
  sf::sort(byLength.begin(), byLength.end());
  std::vector<uint32_t> chords;
  chords.reserve(byLength.size());
  for (const auto& [length, e] : byLength) chords.push_back(e);
  return chords;
}

/// The ends of an edge within A, the one whose place comes first before the other.
std::pair<uint32_t, uint32_t> TwoLoopBound::endsOf(uint32_t chord) const {
  const uint32_t* v = &pass_.set.edgeVertices[2 * size_t(chord)];
  return placeOf(v[0]) < placeOf(v[1]) ? std::make_pair(v[0], v[1]) : std::make_pair(v[1], v[0]);
}

/// Marks the closing edges that splits of the root lead to; returns how many incidences the
/// contexts of all of them have.
uint64_t TwoLoopBound::findContexts(const std::vector<uint32_t>& chords,
                                    std::vector<uint8_t>& wanted) const {
  const CandidateSet& set = pass_.set;
  std::vector<uint8_t> reached(set.edgeCount(), 0);
  wanted.assign(spans_.size() - 1, 0);
  if (!chords.empty()) reached[chords.back()] = 1;
  uint64_t visits = 0;
  for (size_t i = chords.size(); i-- > 0;) {
    const uint32_t edge = chords[i];
    if (!reached[edge]) continue;
    const auto [u, v] = endsOf(edge);
    for (uint32_t s = set.edgeSlots[edge]; s < set.edgeSlots[edge + 1]; ++s) {
      const uint32_t t = set.slotTriangle[s], apex = set.slotApex[s];
      if (!isOnA(apex)) {
        const uint32_t closing = spanOf_[set.edgeOpposite(t, u)];
        if (!wanted[closing]) visits += 2 * uint64_t(incidenceEnd(spans_[closing].place));
        wanted[closing] = 1;
      } else if (placeOf(u) < placeOf(apex) && placeOf(apex) < placeOf(v)) {
        reached[set.edgeOpposite(t, u)] = reached[set.edgeOpposite(t, v)] = 1;
      }
    }
  }
  return visits;
}

/// Case I enters B from its triangle's two spanning edges: one closes,
/// the other is the access edge.
void TwoLoopBound::keepStarts(const Context& c) {
  const CandidateSet& set = pass_.set;
  const SpanningEdge& closing = spans_[c.closing];
  for (uint32_t s = set.edgeSlots[closing.edge]; s < set.edgeSlots[closing.edge + 1]; ++s) {
    const Incidence& at = incidences_[incidenceOf_[s]];
    if (at.isOnA && at.apex < closing.place)
      starts_[2 * size_t(set.slotTriangle[s]) + c.reversed] = c.whole[at.column];
  }
}

/// The run of A between the ends of the edge, with B as hole.
bool TwoLoopBound::computeWithHole(uint32_t chord) {
  const CandidateSet& set = pass_.set;
  const Measure& measure = pass_.measure;
  const auto [u, v] = endsOf(chord);
  const bool root = placeOf(v) - placeOf(u) + 1 == sizeA_;
  size_t inner = 0;
  for (uint32_t s = set.edgeSlots[chord]; s < set.edgeSlots[chord + 1]; ++s) {
    const uint32_t t = set.slotTriangle[s], apex = set.slotApex[s];
    double parts;
    if (isOnA(apex)) {
      const uint32_t at = placeOf(apex);
      if (at <= placeOf(u) || at >= placeOf(v)) continue;
      parts =
          std::min(measure.join(withHole_[set.slotOpposite(t, v)], segmentValue(t, u, apex, v)),
                   measure.join(segmentValue(t, v, u, apex), withHole_[set.slotOpposite(t, u)]));
    } else {
      parts = std::min(starts_[2 * size_t(t)], starts_[2 * size_t(t) + 1]);
    }
    const double base = measure.join(pass_.triangleCost[t], parts);
    if (base == kInfinity) continue;
    innerTheta_[inner] = set.slotTheta[s];
    innerBase_[inner++] = base;
  }
  if (root) {
    for (size_t i = 0; i < inner; ++i) rootBound_ = std::min(rootBound_, innerBase_[i]);
  } else {
    const uint32_t begin = set.edgeSlots[chord];
    transform_.apply(innerTheta_.data(), innerBase_.data(), inner, &set.slotTheta[begin],
                     set.degree(chord), &withHole_[begin]);
  }
  ++domainCount_;
  return pass_.work.tick(30 * set.degree(chord));
}

bool TwoLoopBound::compute(uint64_t maxSplits) {
  const CandidateSet& set = pass_.set;
  const size_t slots = set.slotTriangle.size(), edges = set.edgeCount();
  // At most two of three slots are at spanning edges.
  const double bytes = double(slots) * (2 * sizeof(Incidence) / 3.0 + 4 + 8 + 16 / 3.0 + 8) +
                       double(edges) * (sizeof(SpanningEdge) + 4 + 4 + 4 + 8);
  contextBytes_ = 8.0 * double(slots);
  if (!pass_.work.fits(bytes + contextBytes_)) {
    pass_.work.fail(Status::TooLarge);
    return false;
  }
  if (!memory_.add(size_t(bytes + contextBytes_))) return false;
  spanOf_.assign(edges, kNone);
  incidenceOf_.assign(slots, kNone);
  findSpanningEdges();
  if (!buildIncidences()) return false;
  contextBytes_ = 8.0 * double(incidences_.size());
  mostContexts_ = size_t(std::max(1.0, contextBytes / std::max(1.0, contextBytes_)));
  const std::vector<uint32_t> chords = chordsByLength();
  std::vector<uint8_t> wanted;
  const uint64_t visits = findContexts(chords, wanted);
  if (visits / kVisitsPerSplit > maxSplits) return false;
  leastPair_ = leastPairs(set, pass_.measure);
  starts_.assign(2 * set.size(), kInfinity);
  withHole_.assign(slots, kInfinity);
  contextAt_.assign(2 * wanted.size(), kNone);
  uint32_t mostAround = 0;
  for (uint32_t e = 0; e < edges; ++e) mostAround = std::max(mostAround, set.degree(e));
  for (auto* scratch : {&innerTheta_, &innerBase_, &outerTheta_, &outerValue_})
    scratch->resize(mostAround);
  outer_.resize(mostAround);
  Context c;
  uint64_t visited = 0;
  for (c.closing = 0; c.closing < wanted.size(); ++c.closing) {
    if (!wanted[c.closing]) continue;
    for (const bool reversed : {false, true}) {
      c.reversed = reversed;
      if (!computeContext(c)) return false;
      keepStarts(c);
      visited += c.values.size();
    }
    pass_.work.setFraction(double(visited) / double(visits));
  }
  for (const uint32_t chord : chords)
    if (!computeWithHole(chord)) return false;
  return true;
}

TwoLoopBound::Context& TwoLoopBound::contextOf(uint32_t closing, Segment b) {
  // If B is passed as one vertex, both directions are the same.
  const size_t number = 2 * size_t(closing) + b.reversed;
  uint32_t at = contextAt_[number];
  if (at == kNone && b.isVertex()) at = contextAt_[number ^ 1];
  if (at == kNone) {
    if (contexts_.empty() || (contexts_.size() < mostContexts_ && pass_.work.fits(contextBytes_))) {
      // The first one takes the place of that in which compute() worked.
      if (!contexts_.empty()) memory_.add(size_t(contextBytes_));
      at = uint32_t(contexts_.size());
      contexts_.emplace_back();
    } else {
      const auto oldest = std::min_element(
          contexts_.begin(), contexts_.end(),
          [](const Context& x, const Context& y) { return x.lastUse < y.lastUse; });
      at = uint32_t(oldest - contexts_.begin());
      contextAt_[2 * size_t(oldest->closing) + oldest->reversed] = kNone;
    }
    contextAt_[number] = at;
    contexts_[at].closing = closing;
    contexts_[at].reversed = b.reversed;
    computeContext(contexts_[at]);
  }
  contexts_[at].lastUse = ++uses_;
  return contexts_[at];
}

double TwoLoopBound::value(Shape shape, uint32_t slot) {
  const Domains domains(pass_.loops);
  const CandidateSet& set = pass_.set;
  Segment first = domains.segment(shape, 0);
  if (domains.segmentCount(shape) == 1) return withHole_[slot];
  // Takes the mirror image that passes A forward, and A first, so that the closing edge follows A.
  Segment a = first, b = domains.segment(shape, 1);
  if (!isOnA(a.start)) {
    std::swap(a, b);
    std::swap(a.start, a.end);
    std::swap(b.start, b.end);
    b.reversed = !b.reversed;
  }
  const uint32_t t = set.slotTriangle[slot];
  // What case I needs is kept.
  if (b.whole && placeOf(a.end) > placeOf(a.start) && set.slotApex[slot] == a.end)
    return starts_[2 * size_t(t) + b.reversed];
  const Context& context = contextOf(spanOf_[set.edgeBetween(a.end, b.start)], b);
  const uint32_t at = incidenceOf_[slot];
  if (!b.whole) return context.values[at];
  const SpanningEdge& access = spans_[spanOf_[set.edgeOpposite(t, set.slotApex[slot])]];
  return context.whole[access.column + at - access.first];
}

}  // namespace sf
