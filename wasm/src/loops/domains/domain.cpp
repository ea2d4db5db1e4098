#include "loops/domains/domain.h"

#include <algorithm>

namespace sf {

std::vector<uint32_t> Domains::root(uint32_t v) const {
  std::vector<uint32_t> d(holeWords_ + 2, 0);
  for (uint32_t c = 0; c < loops_.loopCount(); ++c)
    if (c != loops_.loopOf(v)) d[c / 32] |= 1u << (c % 32);
  setSegment(d, 0, {loops_.next(v), v, false, false});
  makeCanonical(d);
  return d;
}

bool Domains::contains(Segment s, uint32_t v) const {
  const uint32_t loop = loops_.loopOf(s.start);
  if (loops_.loopOf(v) != loop) return false;
  if (s.whole) return true;
  const uint32_t from = s.reversed ? s.end : s.start, to = s.reversed ? s.start : s.end;
  const uint32_t size = loops_.size(loop);
  return (v + size - from) % size <= (to + size - from) % size;
}

bool Domains::isEnd(Shape d, uint32_t v) const {
  for (size_t i = holeWords_; i < d.size(); ++i)
    if ((d[i] & kVertexMask) == v) return true;
  return false;
}

bool Domains::makeCanonical(std::vector<uint32_t>& shape) const {
  const uint32_t m = segmentCount(shape);
  if (m == 1) {
    // Forward, so that case I enters a hole from the end of the segment (see two_loop_bound.h).
    const Segment s = segment(shape, 0);
    if (s.reversed) setSegment(shape, 0, {s.end, s.start, false, s.whole});
    return s.reversed;
  }
  // The mirror image passes the segments in reverse order, each the other way round. Both are
  // compared from the front, without building the second.
  int order = 0;
  for (uint32_t i = 0; i < m && order == 0; ++i) {
    const Segment a = segment(shape, i), b = segment(shape, m - 1 - i);
    const uint32_t keyA[3] = {a.start, a.end, a.isVertex() ? 0u : uint32_t(a.reversed)};
    const uint32_t keyB[3] = {b.end, b.start, b.isVertex() ? 0u : uint32_t(!b.reversed)};
    for (int j = 0; j < 3 && order == 0; ++j)
      order = keyA[j] < keyB[j] ? -1 : keyA[j] > keyB[j] ? 1 : 0;
  }
  if (order <= 0) return false;
  for (uint32_t i = 0; 2 * i < m; ++i) {
    const uint32_t j = m - 1 - i;
    const Segment a = segment(shape, i), b = segment(shape, j);
    setSegment(shape, i, {b.end, b.start, !b.reversed, b.whole});
    setSegment(shape, j, {a.end, a.start, !a.reversed, a.whole});
  }
  return true;
}

bool Domains::classify(SplitPart& part, bool repeatsSpanningEdge) const {
  const Shape d(part.shape.data(), part.shape.size());
  const uint32_t m = segmentCount(d);
  const bool holes = hasHoles(d);
  const Segment first = segment(d, 0), last = segment(d, m - 1);
  if (m == 2 && first.isVertex() && last.isVertex()) {
    part.kind = PartKind::EmptyPair;
    return !holes;
  }
  if (repeatsSpanningEdge) return false;
  if (m == 1 && !holes) {
    const bool isEdge = (first.reversed ? loops_.next(first.end) == first.start
                                        : loops_.next(first.start) == first.end);
    part.kind = isEdge ? PartKind::EmptyEdge : PartKind::Segment;
    return isEdge || !loops_.isLoopEdge(first.start, first.end);
  }
  part.kind = PartKind::Domain;
  return !loops_.isLoopEdge(last.end, first.start);
}

void Domains::splitAtHole(Shape d, uint32_t apex, bool reversed) {
  const uint32_t m = segmentCount(d);
  split_.partCount = 1;
  SplitPart& part = split_.part[0];
  part.shape.resize(d.size() + 2);
  std::copy(d.begin(), d.end(), part.shape.begin());
  const uint32_t loop = loops_.loopOf(apex);
  part.shape[loop / 32] &= ~(1u << (loop % 32));
  setSegment(part.shape, m, {apex, apex, reversed, true});
  part.kind = PartKind::Domain;
  part.apexOpposite = spanStart(d, m - 1);
  part.firstInherited = 0;
  part.inheritedCount = m - 1;
}

void Domains::splitAtBoundary(Shape d, uint32_t apex, uint32_t j, Segment before, Segment after) {
  const uint32_t m = segmentCount(d);
  const uint32_t p = spanStart(d, m - 1), q = spanEnd(d, m - 1);
  split_.partCount = 2;
  SplitPart& first = split_.part[0];
  first.shape.resize(holeWords_ + 2 * size_t(j + 1));
  std::copy(d.begin(), d.begin() + first.shape.size(), first.shape.begin());
  setSegment(first.shape, j, before);
  first.apexOpposite = p;
  first.firstInherited = 0;
  first.inheritedCount = j;
  SplitPart& second = split_.part[1];
  second.shape.resize(holeWords_ + 2 * size_t(m - j));
  std::copy(d.begin() + holeWords_ + 2 * j, d.end(), second.shape.begin() + holeWords_);
  setSegment(second.shape, 0, after);
  second.apexOpposite = q;
  second.firstInherited = j;
  second.inheritedCount = m - 1 - j;

  // An edge that spans the domain already would get a third triangle, unless only two vertices are
  // left between it and the new one.
  repeats_[0] = repeats_[1] = false;
  for (uint32_t i = 0; i + 1 < m; ++i) {
    const uint32_t a = spanStart(d, i), b = spanEnd(d, i);
    if ((a == apex && b == q) || (b == apex && a == q)) repeats_[0] = true;
    if ((a == apex && b == p) || (b == apex && a == p)) repeats_[1] = true;
  }
  firstDistribution(d);
}

void Domains::firstDistribution(Shape d) {
  holes_.clear();
  for (uint32_t c = 0; c < loops_.loopCount(); ++c)
    if (hasHole(d, c)) holes_.push_back(c);
  toFirst_.assign(holes_.size(), 0);
  // A part that is empty without holes, or closed by a loop edge, cannot have holes.
  bool mayHold[2];
  for (int i = 0; i < 2; ++i) {
    const Shape s(split_.part[i].shape.data(), split_.part[i].shape.size());
    const uint32_t m = segmentCount(s);
    mayHold[i] = !repeats_[i] && !loops_.isLoopEdge(spanStart(s, m - 1), spanEnd(s, m - 1));
  }
  oneDistribution_ = !mayHold[0] || !mayHold[1];
  if (!mayHold[1]) std::fill(toFirst_.begin(), toFirst_.end(), uint8_t(1));
}

bool Domains::nextDistribution() {
  if (oneDistribution_) return false;
  for (uint8_t& bit : toFirst_) {
    bit ^= 1;
    if (bit) return true;
  }
  return false;
}

void Domains::distribute() {
  for (SplitPart& part : split_.part)
    std::fill(part.shape.begin(), part.shape.begin() + holeWords_, 0u);
  for (size_t i = 0; i < holes_.size(); ++i)
    split_.part[toFirst_[i] ? 0 : 1].shape[holes_[i] / 32] |= 1u << (holes_[i] % 32);
}

}  // namespace sf
