#include "loops/one_loop/segment_table.h"

#include "loops/one_loop/angular_transform.h"

namespace sf {

SegmentTable::~SegmentTable() {
  if (work_) work_->release(values_.size() * sizeof(double));
}

uint32_t SegmentTable::segmentLength(ClosedSegment segment) const {
  const uint32_t a = set_->edgeVertices[2 * size_t(segment.edge)];
  const uint32_t b = set_->edgeVertices[2 * size_t(segment.edge) + 1];
  return segment.side == 0 ? b - a : loops_->size(loops_->loopOf(a)) - (b - a);
}

bool SegmentTable::isInside(ClosedSegment segment, uint32_t v) const {
  const uint32_t a = set_->edgeVertices[2 * size_t(segment.edge)];
  const uint32_t b = set_->edgeVertices[2 * size_t(segment.edge) + 1];
  if (loops_->loopOf(v) != loops_->loopOf(a)) return false;
  const bool between = a < v && v < b;
  return segment.side == 0 ? between : !between;
}

void SegmentTable::parts(ClosedSegment segment, uint32_t slot, ClosedSegment part[2]) const {
  const uint32_t a = set_->edgeVertices[2 * size_t(segment.edge)];
  const uint32_t b = set_->edgeVertices[2 * size_t(segment.edge) + 1];
  const uint32_t start = segment.side == 0 ? a : b, end = segment.side == 0 ? b : a;
  const uint32_t t = set_->slotTriangle[slot], apex = set_->slotApex[slot];
  const uint32_t first = set_->edgeOpposite(t, end), second = set_->edgeOpposite(t, start);
  part[0] = {first, sideFrom(first, start)};
  part[1] = {second, sideFrom(second, apex)};
}

double SegmentTable::splitValue(ClosedSegment segment, uint32_t slot) const {
  ClosedSegment part[2];
  parts(segment, slot, part);
  const uint32_t t = set_->slotTriangle[slot];
  double sum = (*triangleCost_)[t];
  for (const ClosedSegment& p : part) {
    const uint32_t* v = &set_->edgeVertices[2 * size_t(p.edge)];
    const uint32_t* corners = &set_->triangles[3 * size_t(t)];
    const uint32_t opposite = corners[0] + corners[1] + corners[2] - v[0] - v[1];
    sum = measure_.join(sum, value(set_->slotOpposite(t, opposite), p.side));
  }
  return sum;
}

uint32_t SegmentTable::bestSplit(ClosedSegment segment, uint32_t accessSlot) const {
  if (segmentLength(segment) == 1) return kNone;
  double best = kInfinity;
  uint32_t bestSlot = kNone;
  for (uint32_t s = set_->edgeSlots[segment.edge]; s < set_->edgeSlots[segment.edge + 1]; ++s) {
    if (!isInside(segment, set_->slotApex[s])) continue;
    double w = splitValue(segment, s);
    if (accessSlot != kNone)
      w = measure_.join(w, measure_.pair(set_->slotTheta[s], set_->slotTheta[accessSlot]));
    if (w < best) best = w, bestSlot = s;
  }
  return bestSlot;
}

bool SegmentTable::compute(const LoopSet& loops, const CandidateSet& set,
                           const std::vector<double>& triangleCost, Measure measure, Work& work) {
  loops_ = &loops, set_ = &set, triangleCost_ = &triangleCost, measure_ = measure;
  const size_t bytes = 2 * set.slotTriangle.size() * sizeof(double);
  if (!work.charge(bytes)) {
    work.release(bytes);
    return false;
  }
  work_ = &work;
  values_.assign(2 * set.slotTriangle.size(), kInfinity);

  // Both segments of every edge that has its ends on one loop, by increasing length.
  uint32_t longest = 0;
  for (uint32_t c = 0; c < loops.loopCount(); ++c) longest = std::max(longest, loops.size(c));
  std::vector<uint32_t> count(size_t(longest) + 1, 0);
  auto forEachSegment = [&](auto&& visit) {
    for (uint32_t e = 0; e < set.edgeCount(); ++e) {
      const uint32_t* v = &set.edgeVertices[2 * size_t(e)];
      if (loops.loopOf(v[0]) != loops.loopOf(v[1])) continue;
      for (uint32_t side = 0; side < 2; ++side) visit(ClosedSegment{e, side});
    }
  };
  forEachSegment([&](ClosedSegment s) { ++count[segmentLength(s)]; });
  for (uint32_t l = 1; l <= longest; ++l) count[l] += count[l - 1];
  std::vector<ClosedSegment> segments(count[longest]);
  forEachSegment([&](ClosedSegment s) { segments[--count[segmentLength(s)]] = s; });

  AngularTransform transform(measure);
  std::vector<double> innerTheta, base, outerTheta, result;
  std::vector<uint32_t> outer;
  for (size_t i = 0; i < segments.size(); ++i) {
    const ClosedSegment segment = segments[i];
    const uint32_t begin = set.edgeSlots[segment.edge], end = set.edgeSlots[segment.edge + 1];
    if (!work.tick(50 + 20 * (end - begin))) return false;
    if (loops.loopCount() == 1) work.setFraction(double(i) / double(segments.size()));
    if (segmentLength(segment) == 1) {
      for (uint32_t s = begin; s < end; ++s) values_[2 * size_t(s) + segment.side] = 0;
      continue;
    }
    // A loop edge belongs to one triangle: closing a longer run with it would need a second.
    if (set.isLoopEdge[segment.edge]) continue;
    innerTheta.clear(), base.clear(), outerTheta.clear(), outer.clear();
    for (uint32_t s = begin; s < end; ++s) {
      if (!isInside(segment, set.slotApex[s])) {
        outer.push_back(s);
        outerTheta.push_back(set.slotTheta[s]);
        continue;
      }
      const double w = splitValue(segment, s);
      if (w == kInfinity) continue;
      innerTheta.push_back(set.slotTheta[s]);
      base.push_back(w);
    }
    if (base.empty()) continue;
    result.resize(outer.size());
    transform.apply(innerTheta.data(), base.data(), base.size(), outerTheta.data(), outer.size(),
                    result.data());
    for (size_t j = 0; j < outer.size(); ++j)
      values_[2 * size_t(outer[j]) + segment.side] = result[j];
  }
  return true;
}

}  // namespace sf
