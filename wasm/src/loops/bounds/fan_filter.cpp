#include "loops/bounds/fan_filter.h"

#include <algorithm>

namespace sf {
namespace {

constexpr double kBoundStep = 1e-3;

}  // namespace

FanFilter::FanFilter(const LoopSet& loops, const CandidateSet& set,
                     const std::vector<double>& triangleCost, Work& work)
    : loops_(loops), set_(set), triangleCost_(triangleCost), work_(work), memory_(work) {
  const size_t slots = set.slotTriangle.size();
  if (!memory_.add(16 * slots + set.size())) return;
  edgeOfSlot_.resize(slots);
  for (uint32_t e = 0; e < set.edgeCount(); ++e)
    for (uint32_t s = set.edgeSlots[e]; s < set.edgeSlots[e + 1]; ++s) edgeOfSlot_[s] = e;
}

uint32_t FanFilter::spoke(uint32_t slot, uint32_t v) const {
  return 2 * slot + (set_.edgeVertices[2 * size_t(edgeOfSlot_[slot])] == v ? 0 : 1);
}

uint32_t FanFilter::vertexOf(uint32_t spoke) const {
  return set_.edgeVertices[2 * size_t(edgeOfSlot_[spoke / 2]) + spoke % 2];
}

uint32_t FanFilter::partner(uint32_t spoke) const {
  const size_t edge = edgeOfSlot_[spoke / 2];
  const uint32_t far = set_.edgeVertices[2 * edge + 1 - spoke % 2];
  return this->spoke(set_.slotOpposite(set_.slotTriangle[spoke / 2], far), vertexOf(spoke));
}

bool FanFilter::passes(uint32_t slot, uint32_t other) const {
  return other != slot && alive_[set_.slotTriangle[other]] &&
         dihedralAngle(set_.slotTheta[slot], set_.slotTheta[other]) <= cap_;
}

/// Marks the spokes that walks reach. Forward walks begin at the triangles at the loop edge before
/// each vertex and leave out of them; backward walks begin at those at the loop edge after it.
bool FanFilter::walk(bool backward, std::vector<uint8_t>& reached) {
  reached.assign(2 * set_.slotTriangle.size(), 0);
  queue_.clear();
  const auto reach = [&](uint32_t at) {
    if (!reached[at]) reached[at] = 1, queue_.push_back(at);
  };
  for (uint32_t v = 0; v < loops_.vertexCount(); ++v) {
    const uint32_t edge = set_.loopEdges[backward ? v : loops_.previous(v)];
    if (edge == kNone) continue;
    for (uint32_t s = set_.edgeSlots[edge]; s < set_.edgeSlots[edge + 1]; ++s)
      if (alive_[set_.slotTriangle[s]]) reach(backward ? spoke(s, v) : partner(spoke(s, v)));
  }
  for (size_t i = 0; i < queue_.size(); ++i) {
    // Forward: across the edge by which the walk leaves. Backward:
    // across the one by which it came in.
    const uint32_t across = backward ? partner(queue_[i]) : queue_[i];
    const uint32_t slot = across / 2, edge = edgeOfSlot_[slot], v = vertexOf(across);
    if (set_.isLoopEdge[edge]) continue;
    if (!work_.tick(20 + 4 * set_.degree(edge))) return false;
    for (uint32_t s = set_.edgeSlots[edge]; s < set_.edgeSlots[edge + 1]; ++s)
      if (passes(slot, s)) reach(backward ? spoke(s, v) : partner(spoke(s, v)));
  }
  return work_.going();
}

bool FanFilter::filter(double cap, std::vector<uint32_t>& kept) {
  kept.clear();
  if (!work_.going()) return false;
  cap_ = cap;
  alive_.resize(set_.size());
  for (uint32_t t = 0; t < set_.size(); ++t) alive_[t] = triangleCost_[t] <= cap;
  for (bool changed = true; changed;) {
    if (!walk(false, forward_) || !walk(true, backward_)) return false;
    changed = false;
    for (uint32_t t = 0; t < set_.size(); ++t) {
      if (!alive_[t]) continue;
      for (int i = 0; i < 3 && alive_[t]; ++i) {
        const uint32_t v = set_.triangles[3 * size_t(t) + i];
        const uint32_t a = spoke(set_.triangleSlots[3 * size_t(t) + (i + 1) % 3], v);
        const uint32_t b = partner(a);
        if (!(forward_[a] && backward_[a]) && !(forward_[b] && backward_[b])) alive_[t] = 0;
      }
      changed = changed || !alive_[t];
    }
  }
  for (uint32_t v = 0; v < loops_.vertexCount(); ++v) {
    // If some vertex has no fan there is no surface, whatever else is left.
    const uint32_t edge = set_.loopEdges[v];
    bool any = false;
    for (uint32_t s = edge == kNone ? 0 : set_.edgeSlots[edge];
         edge != kNone && s < set_.edgeSlots[edge + 1]; ++s)
      any = any || alive_[set_.slotTriangle[s]];
    if (!any) return work_.going();
  }
  for (uint32_t t = 0; t < set_.size(); ++t)
    if (alive_[t]) kept.push_back(t);
  return work_.going();
}

bool FanFilter::bound(double best, double& lowerBound) {
  double low = 0, high = std::min(best, kPi);
  std::vector<uint32_t> kept;
  while (high - low > kBoundStep) {
    const double middle = 0.5 * (low + high);
    if (!filter(middle, kept)) return false;
    (kept.empty() ? low : high) = middle;
    lowerBound = low;
  }
  return true;
}

}  // namespace sf
