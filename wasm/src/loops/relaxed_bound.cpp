#include "loops/relaxed_bound.h"

#include <algorithm>
#include <cmath>

namespace sf {

RelaxedBound::RelaxedBound(const Pass& pass)
    : pass_(pass),
      domains_(pass.loops),
      table_(pass.work),
      arena_(pass.work),
      transform_(pass.measure) {}

RelaxedBound::~RelaxedBound() { pass_.work.release(entriesCharged_); }

bool RelaxedBound::open(uint32_t domain) {
  const CandidateSet& set = pass_.set;
  // Keys stay where they are while the table grows.
  const Shape shape = table_.key(domain);
  const uint32_t edge = accessEdge(set, domains_, shape);
  frames_.push_back({domain, entries_.size(), entries_.size()});
  for (uint32_t slot = set.edgeSlots[edge]; slot < set.edgeSlots[edge + 1]; ++slot) {
    if (pass_.triangleCost[set.slotTriangle[slot]] == kInfinity) continue;
    domains_.forEachSplit(shape, set.slotApex[slot],
                          [&](const Split& split) { return addEntry(split, slot); });
    if (!pass_.work.going() || splitsLeft_ == 0) return false;
  }
  if (values_.size() < table_.size()) values_.resize(table_.size(), nullptr);
  return true;
}

bool RelaxedBound::addEntry(const Split& split, uint32_t slot) {
  const CandidateSet& set = pass_.set;
  const uint32_t t = set.slotTriangle[slot];
  if (!pass_.work.tick(100) || splitsLeft_ == 0) return false;
  --splitsLeft_;
  Entry entry{slot, {kNone, kNone}, {0, 0}, pass_.triangleCost[t]};
  for (uint32_t i = 0; i < split.partCount; ++i)
    entry.cost =
        pass_.measure.join(entry.cost, leafCost(pass_, domains_, leastPair_, split.part[i], t));
  // A leaf that cannot be filled spares the domain beside it.
  if (entry.cost == kInfinity) return true;
  for (uint32_t i = 0; i < split.partCount; ++i) {
    const SplitPart& part = split.part[i];
    if (part.kind != PartKind::Domain) continue;
    scratchKey_ = part.shape;
    domains_.makeCanonical(scratchKey_);
    entry.part[i] = table_.insert(scratchKey_);
    if (entry.part[i] == kNone) return false;
    const uint32_t partEdge = set.edgeOpposite(t, part.apexOpposite);
    entry.index[i] = set.slotOpposite(t, part.apexOpposite) - set.edgeSlots[partEdge];
  }
  if (entries_.size() == entries_.capacity()) {
    const size_t more = std::max<size_t>(entries_.capacity(), 64);
    if (!pass_.work.charge(more * sizeof(Entry))) return false;
    entriesCharged_ += more * sizeof(Entry);
    entries_.reserve(entries_.capacity() + more);
  }
  entries_.push_back(entry);
  return true;
}

bool RelaxedBound::close(const Frame& frame) {
  const CandidateSet& set = pass_.set;
  const uint32_t edge = accessEdge(set, domains_, table_.key(frame.domain));
  const uint32_t begin = set.edgeSlots[edge], degree = set.degree(edge);
  auto* values = arena_.allocate<double>(degree);
  if (!values || !pass_.work.tick(100 + 20 * degree)) return false;
  best_.assign(degree, kInfinity);
  for (size_t i = frame.firstEntry; i < entries_.size(); ++i) {
    const Entry& entry = entries_[i];
    double cost = entry.cost;
    for (int j = 0; j < 2; ++j)
      if (entry.part[j] != kNone)
        cost = pass_.measure.join(cost, values_[entry.part[j]][entry.index[j]]);
    double& best = best_[entry.slot - begin];
    best = std::min(best, cost);
  }
  innerTheta_.clear();
  innerBase_.clear();
  for (uint32_t i = 0; i < degree; ++i) {
    if (best_[i] == kInfinity) continue;
    innerTheta_.push_back(set.slotTheta[begin + i]);
    innerBase_.push_back(best_[i]);
  }
  // A triangle is met by itself here, which costs it a fold; that only loosens the bound.
  transform_.apply(innerTheta_.data(), innerBase_.data(), innerBase_.size(), &set.slotTheta[begin],
                   degree, values);
  if (frame.domain == 0) rootBound_ = *std::min_element(best_.begin(), best_.end());
  values_[frame.domain] = values;
  // The vector of pointers grows with the table; it is given back with the entries.
  if (!pass_.work.charge(2 * sizeof(double*))) return false;
  entriesCharged_ += 2 * sizeof(double*);
  entries_.resize(frame.firstEntry);
  return true;
}

bool RelaxedBound::compute(ArrayView<const uint32_t> root, uint64_t maxSplits) {
  splitsLeft_ = maxSplits;
  const double expectedSplits = std::min(double(maxSplits), 1e7);
  leastPair_ = leastPairs(pass_.set, pass_.measure);
  if (table_.insert(root) == kNone || !open(0)) return false;
  uint64_t closed = 0;
  while (!frames_.empty()) {
    Frame& frame = frames_.back();
    uint32_t missing = kNone;
    while (frame.cursor < entries_.size() && missing == kNone) {
      const Entry& entry = entries_[frame.cursor];
      for (const uint32_t part : entry.part)
        if (part != kNone && !values_[part]) missing = part;
      if (missing == kNone) ++frame.cursor;
    }
    if (missing != kNone) {
      if (!open(missing)) return false;
      continue;
    }
    if (!close(frame)) return false;
    frames_.pop_back();
    // How much is left shows only at the end; this comes to 0.95 for an ordinary number of splits.
    if (++closed % 64 == 0)
      pass_.work.setFraction(1 - std::exp(-3 * double(maxSplits - splitsLeft_) / expectedSplits));
  }
  return true;
}

double RelaxedBound::value(Shape shape, uint32_t slot) {
  const uint32_t domain = table_.find(shape);
  if (domain == kNone) return kInfinity;
  return values_[domain][slot - pass_.set.edgeSlots[accessEdge(pass_.set, domains_, shape)]];
}

}  // namespace sf
