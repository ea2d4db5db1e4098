#include "loops/bounds/focused_bound.h"

#include <algorithm>

namespace sf {

FocusedBound::FocusedBound(const Pass& pass, const std::vector<double>& leastPair,
                           FanEstimate& estimate)
    : pass_(pass),
      leastPair_(leastPair),
      estimate_(estimate),
      memory_(pass.work),
      domains_(pass.loops),
      table_(pass.work),
      arena_(pass.work),
      transform_(pass.measure) {}

/// The node of a domain, which this round will visit; kNone when memory has run out.
uint32_t FocusedBound::reach(ArrayView<const uint32_t> key) {
  const uint32_t node = table_.insert(key);
  if (node == kNone) return kNone;
  const CandidateSet& set = pass_.set;
  const uint32_t edge = accessEdge(set, domains_, key), degree = set.degree(edge);
  if (node == nodes_.size()) {
    const Node made{arena_.allocate<double>(degree), arena_.allocate<double>(degree), 0, kNone};
    if (!made.inside || !made.outside || !push(nodes_, made, memory_)) return kNone;
    for (uint32_t i = 0; i < degree; ++i)
      made.inside[i] = node == 0 ? 0 : estimate_.value(key, set.edgeSlots[edge] + i);
  }
  Node& n = nodes_[node];
  if (n.round == round_) return node;
  n.round = round_;
  std::fill_n(n.outside, degree, node == 0 ? 0 : kInfinity);
  uint32_t& first = bySize_[estimate_.triangleCount(key)];
  n.next = first;
  first = node;
  return node;
}

/// Takes up one split by triangle t, the index-th at the access edge. If it is too dear, keeps its
/// cost in `dear`.
bool FocusedBound::addSplit(const Split& split, uint32_t t, uint32_t index, double outside,
                            double& dear) {
  const CandidateSet& set = pass_.set;
  double cost = pass_.triangleCost[t];
  for (uint32_t i = 0; i < split.partCount; ++i)
    cost += leafCost(pass_, domains_, leastPair_, split.part[i], t);
  double inside = cost;
  for (uint32_t i = 0; i < 2; ++i) {
    Part& part = part_[i];
    part.inside = 0;
    part.key.clear();
    if (inside == kInfinity || i >= split.partCount || split.part[i].kind != PartKind::Domain)
      continue;
    part.key = split.part[i].shape;
    domains_.makeCanonical(part.key);
    const uint32_t apex = split.part[i].apexOpposite, partSlot = set.slotOpposite(t, apex);
    part.index = partSlot - set.edgeSlots[set.edgeOpposite(t, apex)];
    part.node = table_.find(part.key);
    part.inside = part.node == kNone ? estimate_.value(part.key, partSlot)
                                     : nodes_[part.node].inside[part.index];
    inside += part.inside;
  }
  if (inside == kInfinity) return true;
  if (outside + inside > most_) {
    dear = std::min(dear, inside);
    return true;
  }
  Entry entry{index, {kNone, kNone}, {0, 0}, cost};
  for (uint32_t i = 0; i < 2; ++i) {
    if (part_[i].key.empty()) continue;
    entry.part[i] = reach(part_[i].key);
    if (entry.part[i] == kNone) return false;
    entry.partIndex[i] = part_[i].index;
    double& least = nodes_[entry.part[i]].outside[part_[i].index];
    least = std::min(least, outside + cost + part_[1 - i].inside);
  }
  return push(entries_, entry, memory_);
}

bool FocusedBound::visit(uint32_t node, uint64_t& splitsLeft) {
  const CandidateSet& set = pass_.set;
  // Keys stay where they are while the table grows.
  const Shape shape = table_.key(node);
  const uint32_t edge = accessEdge(set, domains_, shape);
  const uint32_t begin = set.edgeSlots[edge], degree = set.degree(edge);
  if (!push(visits_, {node, entries_.size(), dear_.size()}, memory_)) return false;
  for (uint32_t i = 0; i < degree; ++i)
    if (!push(dear_, kInfinity, memory_)) return false;
  at_.assign(degree, 0.0);
  if (node != 0) {
    theta_.clear();
    base_.clear();
    for (uint32_t i = 0; i < degree; ++i) {
      if (nodes_[node].outside[i] == kInfinity) continue;
      theta_.push_back(set.slotTheta[begin + i]);
      base_.push_back(nodes_[node].outside[i]);
    }
    transform_.apply(theta_.data(), base_.data(), base_.size(), &set.slotTheta[begin], degree,
                     at_.data());
  }
  bool good = true;
  for (uint32_t i = 0; i < degree && good; ++i) {
    const uint32_t t = set.slotTriangle[begin + i];
    // Even if no angle to the triangles outside allows this one yet, others may need its cost.
    if (pass_.triangleCost[t] == kInfinity) continue;
    domains_.forEachSplit(shape, set.slotApex[begin + i], [&](const Split& split) {
      if (splitsLeft == 0 || !pass_.work.tick(800)) return good = false;
      --splitsLeft;
      return good = addSplit(split, t, i, at_[i], dear_[visits_.back().firstDear + i]);
    });
  }
  return good && pass_.work.going();
}

/// Improves what is known of the inside of a domain, once all of its parts are known.
void FocusedBound::improve(const Visit& visit, size_t endOfEntries) {
  const CandidateSet& set = pass_.set;
  const uint32_t edge = accessEdge(set, domains_, table_.key(visit.node));
  const uint32_t begin = set.edgeSlots[edge], degree = set.degree(edge);
  best_.assign(dear_.begin() + std::ptrdiff_t(visit.firstDear),
               dear_.begin() + std::ptrdiff_t(visit.firstDear + degree));
  for (size_t i = visit.firstEntry; i < endOfEntries; ++i) {
    const Entry& entry = entries_[i];
    double cost = entry.cost;
    for (int j = 0; j < 2; ++j)
      if (entry.part[j] != kNone) cost += nodes_[entry.part[j]].inside[entry.partIndex[j]];
    best_[entry.index] = std::min(best_[entry.index], cost);
  }
  if (visit.node == 0) {
    rootBound_ = std::max(rootBound_, *std::min_element(best_.begin(), best_.end()));
    return;
  }
  theta_.clear();
  base_.clear();
  for (uint32_t i = 0; i < degree; ++i) {
    if (best_[i] == kInfinity) continue;
    theta_.push_back(set.slotTheta[begin + i]);
    base_.push_back(best_[i]);
  }
  at_.resize(degree);
  transform_.apply(theta_.data(), base_.data(), base_.size(), &set.slotTheta[begin], degree,
                   at_.data());
  double* inside = nodes_[visit.node].inside;
  for (uint32_t i = 0; i < degree; ++i) inside[i] = std::max(inside[i], at_[i]);
}

bool FocusedBound::compute(ArrayView<const uint32_t> root, double most, uint64_t& splitsLeft) {
  SF_ASSERT(most >= most_);
  most_ = most;
  ++round_;
  visits_.clear();
  entries_.clear();
  dear_.clear();
  bySize_.assign(size_t(estimate_.triangleCount(root)) + 1, kNone);
  if (reach(root) == kNone) return false;
  for (size_t size = bySize_.size(); size-- > 0;) {
    // Parts are smaller than their domain. So all domains of this size exist, with all that is
    // outside of them.
    for (uint32_t node = bySize_[size]; node != kNone; node = nodes_[node].next)
      if (!visit(node, splitsLeft)) return false;
  }
  for (size_t i = visits_.size(), end = entries_.size(); i-- > 0;) {
    improve(visits_[i], end);
    end = visits_[i].firstEntry;
  }
  return true;
}

double FocusedBound::value(Shape shape, uint32_t slot) {
  const uint32_t node = table_.find(shape);
  if (node == kNone || nodes_[node].round != round_) return kInfinity;
  const uint32_t edge =
      pass_.set.edgeOpposite(pass_.set.slotTriangle[slot], pass_.set.slotApex[slot]);
  return nodes_[node].inside[slot - pass_.set.edgeSlots[edge]];
}

double FocusedBound::limit(Shape shape, uint32_t slot) {
  if (slot == kNone) return most_;
  const uint32_t node = table_.find(shape);
  if (node == kNone || nodes_[node].round != round_) return -kInfinity;
  const uint32_t edge =
      pass_.set.edgeOpposite(pass_.set.slotTriangle[slot], pass_.set.slotApex[slot]);
  return most_ - nodes_[node].outside[slot - pass_.set.edgeSlots[edge]];
}

}  // namespace sf
