#include "support/domains.h"

#include <vector>

#include "loops/domains/lower_bound.h"

using namespace sf;

namespace sftest {
namespace {

/// Whether v lies on a segment of the domain, not at an end of it: no triangle outside has its apex there.
bool isInside(const LoopSet& loops, const Domains& domains, Shape shape, uint32_t v) {
  for (uint32_t i = 0; i < domains.segmentCount(shape); ++i) {
    const Segment s = domains.segment(shape, i);
    uint32_t at = s.start;
    do {
      at = s.reversed ? loops.previous(at) : loops.next(at);
      if (at == v && at != s.end && at != s.start) return !s.isVertex();
    } while (at != s.end && at != s.start);
  }
  return false;
}

/// Finds how the triangles of a surface fill domains.
class Filling {
 public:
  Filling(const Pass& pass, const std::vector<uint32_t>& triangles)
      : pass_(pass), isIn_(pass.set.size(), 0) {
    for (const uint32_t t : triangles) isIn_[t] = 1;
  }

  bool fill(Shape shape, uint32_t accessSlot, double& cost, uint32_t& count,
            std::vector<FilledDomain>& domains) const {
    const CandidateSet& set = pass_.set;
    Domains scratch(pass_.loops);
    const uint32_t slot = other(accessEdge(set, scratch, shape), accessSlot);
    if (slot == kNone) return false;
    bool filled = false;
    scratch.forEachSplit(shape, set.slotApex[slot], [&](const Split& split) {
      std::vector<FilledDomain> inside;
      cost = pass_.triangleCost[set.slotTriangle[slot]] + angle(accessSlot, slot);
      count = 1;
      filled = true;
      for (uint32_t i = 0; i < split.partCount && filled; ++i)
        filled = fillPart(split.part[i], set.slotTriangle[slot], cost, count, inside);
      if (filled) domains.insert(domains.end(), inside.begin(), inside.end());
      return !filled;
    });
    return filled;
  }

 private:
  /// The one other triangle of the surface at the edge, by its slot.
  uint32_t other(uint32_t edge, uint32_t slot) const {
    uint32_t found = kNone;
    for (uint32_t s = pass_.set.edgeSlots[edge]; s < pass_.set.edgeSlots[edge + 1]; ++s)
      if (s != slot && isIn_[pass_.set.slotTriangle[s]]) found = s;
    return found;
  }
  double angle(uint32_t a, uint32_t b) const {
    if (a == kNone) return 0;
    return pass_.measure.pair(pass_.set.slotTheta[a], pass_.set.slotTheta[b]);
  }
  bool fillPart(const SplitPart& part, uint32_t t, double& cost, uint32_t& count,
                std::vector<FilledDomain>& domains) const {
    if (part.kind == PartKind::EmptyEdge) return true;
    const uint32_t slot = pass_.set.slotOpposite(t, part.apexOpposite);
    if (part.kind == PartKind::EmptyPair) {
      const uint32_t across = other(pass_.set.edgeOpposite(t, part.apexOpposite), slot);
      if (across != kNone) cost += angle(slot, across);
      return across != kNone;
    }
    // Which of its new edges is the access edge depends on how a domain is seen.
    std::vector<uint32_t> shape = part.shape;
    Domains(pass_.loops).makeCanonical(shape);
    double partCost;
    uint32_t partCount;
    if (!fill(shape, slot, partCost, partCount, domains)) return false;
    cost += partCost;
    count += partCount;
    if (part.kind == PartKind::Domain) domains.push_back({shape, slot, partCost});
    return true;
  }

  const Pass& pass_;
  std::vector<uint8_t> isIn_;
};

}  // namespace

std::vector<FilledDomain> domainsOf(const Pass& pass, uint32_t root,
                                    const std::vector<uint32_t>& triangles) {
  std::vector<FilledDomain> domains;
  double cost;
  uint32_t count;
  const std::vector<uint32_t> shape = Domains(pass.loops).root(root);
  if (!Filling(pass, triangles).fill(shape, kNone, cost, count, domains) ||
      count != triangles.size())
    domains.clear();
  return domains;
}

void walkDomains(const Pass& pass, uint32_t root, Random& random,
                 const std::function<void(Shape shape, uint32_t slot)>& visit) {
  const CandidateSet& set = pass.set;
  Domains domains(pass.loops);
  for (int walk = 0; walk < 60; ++walk) {
    std::vector<uint32_t> shape = domains.root(root);
    for (int depth = 0; depth < 12; ++depth) {
      const uint32_t edge = accessEdge(set, domains, shape);
      if (edge == kNone) break;
      for (uint32_t s = set.edgeSlots[edge]; depth > 0 && s < set.edgeSlots[edge + 1]; ++s)
        if (!isInside(pass.loops, domains, shape, set.slotApex[s])) visit(shape, s);
      std::vector<std::vector<uint32_t>> parts;
      for (uint32_t s = set.edgeSlots[edge]; s < set.edgeSlots[edge + 1]; ++s)
        domains.forEachSplit(shape, set.slotApex[s], [&](const Split& split) {
          for (uint32_t p = 0; p < split.partCount; ++p)
            if (split.part[p].kind == PartKind::Domain) parts.push_back(split.part[p].shape);
          return true;
        });
      if (parts.empty()) break;
      shape = parts[random.below(uint32_t(parts.size()))];
      domains.makeCanonical(shape);
    }
  }
}

}  // namespace sftest
