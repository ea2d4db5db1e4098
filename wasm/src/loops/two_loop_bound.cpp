#include "loops/two_loop_bound.h"

#include <algorithm>

#include "base/sort.h"

namespace sf {

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

/// What innerTheta_ and innerBase_ cost each triangle at the edge as access triangle.
void TwoLoopBound::apply(uint32_t edge, double* values) {
  transform_.apply(innerTheta_.data(), innerBase_.data(), innerBase_.size(),
                   &pass_.set.slotTheta[pass_.set.edgeSlots[edge]], pass_.set.degree(edge), values);
}

bool TwoLoopBound::buildIncidences() {
  const CandidateSet& set = pass_.set;
  const Measure& measure = pass_.measure;
  firstIncidence_.assign(size_t(sizeA_) * sizeB_ + 1, 0);
  incidences_.clear();
  const auto indexAt = [&](uint32_t t, uint32_t opposite) {
    return set.slotOpposite(t, opposite) - set.edgeSlots[set.edgeOpposite(t, opposite)];
  };
  for (uint32_t place = 0; place < sizeA_; ++place) {
    for (uint32_t b = 0; b < sizeB_; ++b) {
      const size_t number = size_t(place) * sizeB_ + b, first = incidences_.size();
      const uint32_t u = vertexA(place), v = firstB_ + b, edge = set.edgeBetween(u, v);
      for (uint32_t s = edge == kNone ? 0 : set.edgeSlots[edge];
           edge != kNone && s < set.edgeSlots[edge + 1]; ++s) {
        const uint32_t t = set.slotTriangle[s], apex = set.slotApex[s];
        const double w = pass_.triangleCost[t];
        Incidence at{};
        at.theta = set.slotTheta[s];
        at.isOnA = apex - firstA_ < sizeA_;
        at.apex = at.isOnA ? placeOf(apex) : apex - firstB_;
        at.ownIndex = s - set.edgeSlots[edge];
        at.index = indexAt(t, at.isOnA ? u : v);
        for (int backward = 0; backward < 2; ++backward)
          at.base[backward] = measure.join(w, at.isOnA   ? segmentValue(t, v, u, apex)
                                              : backward ? segmentValue(t, u, v, apex)
                                                         : segmentValue(t, u, apex, v));
        incidences_.push_back(at);
      }
      sf::sort(incidences_.begin() + std::ptrdiff_t(first), incidences_.end(),
               [](const Incidence& x, const Incidence& y) { return x.theta < y.theta; });
      firstIncidence_[number + 1] = incidences_.size();
      if (!pass_.work.tick(uint32_t(100 * (incidences_.size() - first)) + 10)) return false;
    }
  }
  return true;
}

void TwoLoopBound::computeFront(Context& c, uint32_t place, uint32_t length) {
  const CandidateSet& set = pass_.set;
  const uint32_t v = vertexB(c, length), edge = set.edgeBetween(vertexA(place), v);
  size_t& offset = c.offset[size_t(place) * (sizeB_ + 1) + length];
  offset = kNoEdge;
  // The closing edge cannot be closed by all of B.
  if (edge == kNone || (place == c.end && length == sizeB_)) return;
  offset = c.values.size();
  c.values.resize(offset + set.degree(edge), kInfinity);
  double* values = &c.values[offset];
  if (place == c.end && length == 0) {
    const uint32_t begin = set.edgeSlots[edge];
    std::copy(&leastPair_[begin], &leastPair_[begin] + set.degree(edge), values);
    return;
  }
  innerTheta_.clear();
  innerBase_.clear();
  outerTheta_.clear();
  outerIndex_.clear();
  const size_t number = size_t(place) * sizeB_ + (v - firstB_);
  for (size_t i = firstIncidence_[number]; i < firstIncidence_[number + 1]; ++i) {
    const Incidence& t = incidences_[i];
    const uint32_t at = t.isOnA ? t.apex : lengthTo(c, firstB_ + t.apex);
    // The access triangle is outside of the front; at the closing edge's ends there are both kinds.
    if (t.isOnA ? at < place || at >= c.end : at == 0 || at >= length) {
      outerTheta_.push_back(t.theta);
      outerIndex_.push_back(t.ownIndex);
    }
    if (t.isOnA ? at < place || at > c.end : at >= length) continue;
    const size_t rest =
        t.isOnA ? size_t(at) * (sizeB_ + 1) + length : size_t(place) * (sizeB_ + 1) + at;
    if (c.offset[rest] == kNoEdge) continue;
    const double base = pass_.measure.join(t.base[c.reversed], c.values[c.offset[rest] + t.index]);
    if (base == kInfinity) continue;
    innerTheta_.push_back(t.theta);
    innerBase_.push_back(base);
  }
  outerValue_.resize(outerIndex_.size());
  transform_.applySorted(innerTheta_.data(), innerBase_.data(), innerBase_.size(),
                         outerTheta_.data(), outerTheta_.size(), outerValue_.data());
  for (size_t j = 0; j < outerIndex_.size(); ++j) values[outerIndex_[j]] = outerValue_[j];
}

bool TwoLoopBound::computeContext(Context& c) {
  c.values.clear();
  c.offset.assign(size_t(sizeA_) * (sizeB_ + 1), kNoEdge);
  for (uint32_t length = 0; length <= sizeB_; ++length)
    for (uint32_t place = c.end + 1; place-- > 0;) computeFront(c, place, length);
  domainCount_ += size_t(c.end + 1) * (sizeB_ + 1);
  return pass_.work.tick(uint32_t(std::min<size_t>(30 * c.values.size(), 1u << 30)));
}

/// The run of A from place x to place y, with B as hole.
bool TwoLoopBound::computeWithHole(uint32_t x, uint32_t y) {
  const CandidateSet& set = pass_.set;
  const uint32_t u = vertexA(x), v = vertexA(y), edge = set.edgeBetween(u, v);
  const bool root = x == 0 && y + 1 == sizeA_;
  // Only at the root may a loop edge close more than itself.
  if (edge == kNone || (set.isLoopEdge[edge] && !root)) return true;
  const auto withHole = [&](uint32_t from, uint32_t to, uint32_t slot) {
    const size_t at = holeOffset_[size_t(from) * sizeA_ + to];
    if (at == kNoEdge) return kInfinity;
    return holeValues_[at + slot -
                       set.edgeSlots[set.edgeOpposite(set.slotTriangle[slot], set.slotApex[slot])]];
  };
  innerTheta_.clear();
  innerBase_.clear();
  const Measure& measure = pass_.measure;
  for (uint32_t s = set.edgeSlots[edge]; s < set.edgeSlots[edge + 1]; ++s) {
    const uint32_t t = set.slotTriangle[s], apex = set.slotApex[s];
    double parts;
    if (apex - firstA_ < sizeA_) {
      const uint32_t at = placeOf(apex);
      if (at <= x || at >= y) continue;
      parts = std::min(
          measure.join(withHole(x, at, set.slotOpposite(t, v)), segmentValue(t, u, apex, v)),
          measure.join(segmentValue(t, v, u, apex), withHole(at, y, set.slotOpposite(t, u))));
    } else {
      parts = std::min(start(x, y, apex, false), start(x, y, apex, true));
    }
    const double base = measure.join(pass_.triangleCost[t], parts);
    if (base == kInfinity) continue;
    innerTheta_.push_back(set.slotTheta[s]);
    innerBase_.push_back(base);
  }
  if (root) {
    for (const double base : innerBase_) rootBound_ = std::min(rootBound_, base);
  } else {
    holeOffset_[size_t(x) * sizeA_ + y] = holeValues_.size();
    holeValues_.resize(holeValues_.size() + set.degree(edge));
    apply(edge, &holeValues_[holeOffset_[size_t(x) * sizeA_ + y]]);
  }
  ++domainCount_;
  return pass_.work.tick(30 * set.degree(edge));
}

bool TwoLoopBound::compute() {
  const CandidateSet& set = pass_.set;
  const double fronts = double(sizeA_) * (sizeB_ + 1);
  const double degree =
      double(set.slotTriangle.size()) / double(std::max<size_t>(set.edgeCount(), 1));
  const double bytes =
      8.0 * (double(set.slotTriangle.size()) + 2 * fronts * sizeA_ + fronts * (degree + 1) +
             6 * sizeA_ * (sizeB_ * degree) + 0.5 * sizeA_ * sizeA_ * (degree + 2));
  contextBytes_ = 8.0 * fronts * (degree + 1);
  mostContexts_ = size_t(std::max(1.0, contextBytes / contextBytes_));
  if (!pass_.work.fits(bytes)) {
    pass_.work.fail(Status::TooLarge);
    return false;
  }
  if (!memory_.add(size_t(bytes))) return false;
  contextAt_.assign(2 * size_t(sizeA_) * sizeB_, kNone);
  leastPair_ = leastPairs(set, pass_.measure);
  starts_.assign(2 * size_t(sizeA_) * sizeB_ * sizeA_, kInfinity);
  holeOffset_.assign(size_t(sizeA_) * sizeA_, kNoEdge);
  if (!buildIncidences()) return false;
  Context c;
  for (c.end = 1; c.end < sizeA_; ++c.end) {
    pass_.work.setFraction(double(c.end) * c.end / (double(sizeA_) * sizeA_));
    for (c.first = firstB_; c.first < firstB_ + sizeB_; ++c.first) {
      const uint32_t p = vertexA(c.end);
      if (set.edgeBetween(p, c.first) == kNone) continue;
      for (const bool reversed : {false, true}) {
        c.reversed = reversed;
        if (!computeContext(c)) return false;
        for (uint32_t place = 0; place < c.end; ++place) {
          const size_t offset = c.offset[size_t(place) * (sizeB_ + 1) + sizeB_];
          if (offset == kNoEdge) continue;
          const uint32_t edge = set.edgeBetween(vertexA(place), c.first);
          for (uint32_t s = set.edgeSlots[edge]; s < set.edgeSlots[edge + 1]; ++s)
            if (set.slotApex[s] == p)
              start(place, c.end, c.first, reversed) = c.values[offset + s - set.edgeSlots[edge]];
        }
      }
    }
  }
  for (uint32_t length = 1; length < sizeA_; ++length)
    for (uint32_t x = 0; x + length < sizeA_; ++x)
      if (!computeWithHole(x, x + length)) return false;
  return true;
}

TwoLoopBound::Context& TwoLoopBound::contextOf(Segment a, Segment b) {
  const uint32_t end = placeOf(a.end);
  // With one vertex of B, both directions are the same.
  const size_t number = contextNumber(end, b.start, b.reversed);
  const size_t other = contextNumber(end, b.start, !b.reversed);
  uint32_t at = contextAt_[number];
  if (at == kNone && b.isVertex()) at = contextAt_[other];
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
      contextAt_[contextNumber(oldest->end, oldest->first, oldest->reversed)] = kNone;
    }
    contextAt_[number] = at;
    contexts_[at].end = end;
    contexts_[at].first = b.start;
    contexts_[at].reversed = b.reversed;
    computeContext(contexts_[at]);
  }
  contexts_[at].lastUse = ++uses_;
  return contexts_[at];
}

double TwoLoopBound::value(Shape shape, uint32_t slot) {
  const Domains domains(pass_.loops);
  const CandidateSet& set = pass_.set;
  const uint32_t edge = set.edgeOpposite(set.slotTriangle[slot], set.slotApex[slot]);
  const uint32_t index = slot - set.edgeSlots[edge];
  Segment first = domains.segment(shape, 0);
  if (domains.segmentCount(shape) == 1) {
    const uint32_t from = placeOf(first.reversed ? first.end : first.start);
    const uint32_t to = placeOf(first.reversed ? first.start : first.end);
    const size_t at = holeOffset_[size_t(from) * sizeA_ + to];
    return at == kNoEdge ? kInfinity : holeValues_[at + index];
  }
  // As the mirror image that passes A forward, and A first, so that the closing edge follows A.
  Segment a = first, b = domains.segment(shape, 1);
  if (pass_.loops.loopOf(a.start) != pass_.loops.loopOf(firstA_)) {
    std::swap(a, b);
    std::swap(a.start, a.end);
    std::swap(b.start, b.end);
    b.reversed = !b.reversed;
  }
  const uint32_t place = placeOf(a.start);
  // What case I asks is kept.
  if (b.whole && placeOf(a.end) > place && set.slotApex[slot] == a.end)
    return start(place, placeOf(a.end), b.start, b.reversed);
  const Context* context = &contextOf(a, b);
  const uint32_t length = b.whole ? sizeB_ : lengthTo(*context, b.end);
  const size_t at = context->offset[size_t(place) * (sizeB_ + 1) + length];
  return at == kNoEdge ? kInfinity : context->values[at + index];
}

}  // namespace sf
