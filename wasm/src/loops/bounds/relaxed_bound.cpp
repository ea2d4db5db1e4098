#include "loops/bounds/relaxed_bound.h"

#include <algorithm>
#include <cmath>

namespace sf {

RelaxedBound::RelaxedBound(const Pass& pass)
    : pass_(pass),
      domains_(pass.loops),
      table_(pass.work),
      arena_(pass.work),
      memory_(pass.work),
      transform_(pass.measure) {}

uint32_t RelaxedBound::pairOf(uint32_t u, uint32_t v) const {
  const uint32_t a = pass_.loops.loopOf(u), b = pass_.loops.loopOf(v);
  return std::min(a, b) * pass_.loops.loopCount() + std::max(a, b);
}

void RelaxedBound::findEdges() {
  const CandidateSet& set = pass_.set;
  const uint32_t pairs = pass_.loops.loopCount() * pass_.loops.loopCount();
  firstOfPair_.assign(pairs + 1, 0);
  numberInPair_.resize(set.edgeCount());
  const auto pair = [&](uint32_t e) {
    return pairOf(set.edgeVertices[2 * size_t(e)], set.edgeVertices[2 * size_t(e) + 1]);
  };
  for (uint32_t e = 0; e < set.edgeCount(); ++e) numberInPair_[e] = firstOfPair_[pair(e) + 1]++;
  for (uint32_t p = 0; p < pairs; ++p) firstOfPair_[p + 1] += firstOfPair_[p];
  edgesOfPair_.resize(set.edgeCount());
  for (uint32_t e = 0; e < set.edgeCount(); ++e)
    edgesOfPair_[firstOfPair_[pair(e)] + numberInPair_[e]] = e;
}

/// The front at `edge` of the domain in key_, with `first` and `last` in place of its outer
/// segments; for a domain of one segment both are the same. Block kNone once memory has run out.
RelaxedBound::Front RelaxedBound::insertFront(Segment first, Segment last, uint32_t edge) {
  const uint32_t m = domains_.segmentCount(key_), any = Domains::kAnyVertex;
  Whole whole = 0;
  bool mirrored = false;
  if (m == 1) {
    domains_.setSegment(key_, 0,
                        {any, pass_.loops.first(pass_.loops.loopOf(first.end)), false, false});
  } else {
    whole = wholeOf(first, last);
    domains_.setSegment(key_, 0, {any, first.end, first.reversed, false});
    domains_.setSegment(key_, m - 1, {last.start, any, last.reversed, false});
    mirrored = domains_.makeCanonical(key_);
    if (mirrored) std::swap(first, last), whole = (whole >> 1) | ((whole & 1) << 1);
    // A single vertex has no direction.
    if (first.isVertex()) domains_.setForward(key_, 0);
    if (last.isVertex()) domains_.setForward(key_, m - 1);
  }
  const uint32_t context = table_.insert(key_);
  if (context == kNone ||
      (context == contexts_.size() && !push(contexts_, {{kNone, kNone, kNone, kNone}}, memory_)))
    return {kNone, 0};
  return frontOf(context, whole, first, edge);
}

/// The front at `edge` of a context.
///   first  the first segment
RelaxedBound::Front RelaxedBound::frontOf(uint32_t context, Whole whole, Segment first,
                                          uint32_t edge) {
  const uint32_t* ends = &pass_.set.edgeVertices[2 * size_t(edge)];
  // Within one loop, there are two runs between the ends of an edge.
  const bool isChord = pass_.loops.loopOf(ends[0]) == pass_.loops.loopOf(ends[1]);
  uint32_t& block = contexts_[context].block[whole];
  if (block == kNone) {
    const uint32_t pair = pairOf(ends[0], ends[1]);
    const size_t count = (firstOfPair_[pair + 1] - firstOfPair_[pair]) * (isChord ? 2 : 1);
    auto** values = arena_.allocate<double*>(count);
    if (!values || !push(blocks_, {context, whole, values}, memory_)) return {kNone, 0};
    std::fill(values, values + count, nullptr);
    block = uint32_t(blocks_.size()) - 1;
  }
  const uint32_t number = numberInPair_[edge];
  if (!isChord) return {block, number};
  return {block,
          2 * number + pass_.segments.sideFrom(edge, first.reversed ? first.end : first.start)};
}

/// Makes a front the current domain; returns its access edge.
uint32_t RelaxedBound::readDomain(Front front) {
  const LoopSet& loops = pass_.loops;
  const Block& block = blocks_[front.block];
  const Shape key = table_.key(block.context);
  const uint32_t m = domains_.segmentCount(key);
  context_ = block.context;
  holes_.clear();
  for (uint32_t c = 0; c < loops.loopCount(); ++c)
    if (domains_.hasHole(key, c)) holes_.push_back(c);
  segments_.clear();
  for (uint32_t i = 0; i < m; ++i) segments_.push_back(domains_.segment(key, i));
  Segment &first = segments_[0], &last = segments_[m - 1];
  const uint32_t pair = pairOf(first.end, m == 1 ? first.end : last.start);
  const uint32_t number = m == 1 ? front.number / 2 : front.number;
  const uint32_t edge = edgesOfPair_[firstOfPair_[pair] + number];
  const uint32_t* ends = &pass_.set.edgeVertices[2 * size_t(edge)];
  const uint32_t start =
      m == 1 ? front.number % 2 : loops.loopOf(ends[0]) != loops.loopOf(first.end);
  first.start = ends[start], last.end = ends[1 - start];
  first.whole = block.whole & kWholeFirst;
  if (m > 1) last.whole = block.whole & kWholeLast;
  return edge;
}

bool RelaxedBound::open(Front front) {
  const CandidateSet& set = pass_.set;
  const uint32_t edge = readDomain(front);
  frames_.push_back({front, edge, entries_.size(), entries_.size()});
  const uint32_t p = segments_.back().end, q = segments_[0].start;
  for (uint32_t slot = set.edgeSlots[edge]; slot < set.edgeSlots[edge + 1]; ++slot) {
    const uint32_t apex = set.slotApex[slot];
    if (pass_.triangleCost[set.slotTriangle[slot]] == kInfinity || apex == p || apex == q) continue;
    const uint32_t loop = pass_.loops.loopOf(apex);
    if (std::find(holes_.begin(), holes_.end(), loop) != holes_.end()) {
      if (!splitAtHole(slot, loop)) return false;
      continue;
    }
    for (uint32_t j = 0; j < segments_.size(); ++j)
      if (domains_.contains(segments_[j], apex)) {
        if (!splitAtBoundary(slot, j)) return false;
        break;
      }
  }
  return true;
}

/// Case I.
bool RelaxedBound::splitAtHole(uint32_t slot, uint32_t loop) {
  const CandidateSet& set = pass_.set;
  const uint32_t t = set.slotTriangle[slot], apex = set.slotApex[slot];
  const uint32_t m = uint32_t(segments_.size()), p = segments_.back().end;
  const uint32_t edge = set.edgeOpposite(t, p);
  for (const bool reversed : {false, true}) {
    key_.assign(domains_.holeWords() + 2 * (m + 1), 0);
    for (const uint32_t c : holes_)
      if (c != loop) key_[c / 32] |= 1u << (c % 32);
    for (uint32_t i = 1; i < m; ++i) domains_.setSegment(key_, i, segments_[i]);
    Entry entry{slot, {{kNone, 0}, {kNone, 0}}, {0, 0}, pass_.triangleCost[t]};
    entry.part[0] = insertFront(segments_[0], {apex, apex, reversed, true}, edge);
    entry.index[0] = set.slotOpposite(t, p) - set.edgeSlots[edge];
    if (entry.part[0].block == kNone || !addEntry(entry)) return false;
  }
  return true;
}

/// Case II, in all its ways.
bool RelaxedBound::splitAtBoundary(uint32_t slot, uint32_t j) {
  const uint32_t apex = pass_.set.slotApex[slot], m = uint32_t(segments_.size());
  const uint32_t p = segments_.back().end, q = segments_[0].start;
  const Segment s = segments_[j], vertex{apex, apex, false, false};
  // An edge that spans the domain already would get a third triangle, unless only two vertices are
  // left between it and the new one.
  bool repeats[2] = {false, false};
  for (uint32_t i = 0; i + 1 < m; ++i) {
    const uint32_t a = segments_[i].end, b = segments_[i + 1].start;
    if ((a == apex && b == q) || (b == apex && a == q)) repeats[0] = true;
    if ((a == apex && b == p) || (b == apex && a == p)) repeats[1] = true;
  }
  // A loop that is passed whole has two copies of its end vertex on the boundary.
  const bool twice = s.whole && apex == s.start;
  for (int copy = 0; copy < (twice ? 2 : 1); ++copy) {
    Segment before{s.start, apex, s.reversed, false}, after{apex, s.end, s.reversed, false};
    if (twice) before = copy == 0 ? vertex : s, after = copy == 0 ? s : vertex;
    const Part part[2] = {{0, j, j == 0 ? before : segments_[0], before, p, repeats[0]},
                          {j, m - 1, after, j == m - 1 ? after : segments_[m - 1], q, repeats[1]}};
    if (!splitWith(slot, part)) return false;
  }
  return true;
}

/// All distributions of the holes.
bool RelaxedBound::splitWith(uint32_t slot, const Part part[2]) {
  // A part that is closed by a loop edge, or by an edge that spans the domain already,
  // has no holes.
  bool mayHold[2];
  for (int i = 0; i < 2; ++i)
    mayHold[i] = !part[i].repeats && !pass_.loops.isLoopEdge(part[i].first.start, part[i].last.end);
  if (!mayHold[0] || !mayHold[1]) return distribute(slot, part, mayHold[1] ? 0 : all());
  for (uint64_t toFirst = 0;; ++toFirst) {
    if (!distribute(slot, part, toFirst)) return false;
    if (toFirst == all()) return true;
  }
}

/// Whether a surface can fill the part; its cost if it ends the recursion.
bool RelaxedBound::isFilled(const Part& part, uint32_t t, bool hasHoles, double& cost,
                            bool& isDomain) const {
  const Segment first = part.first, last = part.last;
  const LoopSet& loops = pass_.loops;
  isDomain = false;
  const uint32_t slot = pass_.set.slotOpposite(t, part.apexOpposite);
  if (part.to == part.from + 1 && first.isVertex() && last.isVertex()) {
    cost = pass_.measure.join(cost, leastPair_[slot]);
    return !hasHoles;
  }
  if (part.repeats) return false;
  if (part.from == part.to && !hasHoles) {
    const uint32_t start = first.reversed ? first.end : first.start;
    if (loops.next(start) == (first.reversed ? first.start : first.end)) return true;
    const uint32_t edge = pass_.set.edgeOpposite(t, part.apexOpposite);
    cost =
        pass_.measure.join(cost, pass_.segments.value(slot, pass_.segments.sideFrom(edge, start)));
    return !pass_.set.isLoopEdge[edge];
  }
  isDomain = true;
  return !loops.isLoopEdge(first.start, last.end);
}

bool RelaxedBound::distribute(uint32_t slot, const Part part[2], uint64_t toFirst) {
  const CandidateSet& set = pass_.set;
  const uint32_t t = set.slotTriangle[slot];
  const uint64_t holes[2] = {toFirst, all() & ~toFirst};
  Entry entry{slot, {{kNone, 0}, {kNone, 0}}, {0, 0}, pass_.triangleCost[t]};
  bool isDomain[2];
  for (int i = 0; i < 2; ++i)
    if (!isFilled(part[i], t, holes[i] != 0, entry.cost, isDomain[i])) return true;
  // If a leaf cannot be filled, the domain beside it is not needed.
  if (entry.cost < kInfinity) {
    for (int i = 0; i < 2; ++i) {
      if (!isDomain[i]) continue;
      entry.part[i] = frontOfPart(part[i], t, holes[i]);
      if (entry.part[i].block == kNone) return false;
      const uint32_t edge = set.edgeOpposite(t, part[i].apexOpposite);
      entry.index[i] = set.slotOpposite(t, part[i].apexOpposite) - set.edgeSlots[edge];
    }
  }
  return addEntry(entry);
}

RelaxedBound::Front RelaxedBound::frontOfPart(const Part& part, uint32_t t, uint64_t holes) {
  const uint32_t m = part.to - part.from + 1;
  const uint32_t edge = pass_.set.edgeOpposite(t, part.apexOpposite);
  // Most parts differ from the domain only in one end of the access edge.
  if (m == segments_.size() && holes == all() && part.first.isVertex() == segments_[0].isVertex() &&
      part.last.isVertex() == segments_.back().isVertex())
    return frontOf(context_, wholeOf(part.first, part.last), part.first, edge);
  key_.assign(domains_.holeWords() + 2 * m, 0);
  for (size_t i = 0; i < holes_.size(); ++i)
    if ((holes >> std::min<size_t>(i, 63)) & 1) key_[holes_[i] / 32] |= 1u << (holes_[i] % 32);
  for (uint32_t i = 1; i + 1 < m; ++i) domains_.setSegment(key_, i, segments_[part.from + i]);
  return insertFront(part.first, part.last, edge);
}

bool RelaxedBound::addEntry(const Entry& entry) {
  if (!pass_.work.tick(100) || splitsLeft_ == 0) return false;
  --splitsLeft_;
  return entry.cost == kInfinity || push(entries_, entry, memory_);
}

bool RelaxedBound::close(const Frame& frame) {
  const CandidateSet& set = pass_.set;
  const uint32_t begin = set.edgeSlots[frame.edge], degree = set.degree(frame.edge);
  auto* values = arena_.allocate<double>(degree);
  if (!values || !pass_.work.tick(100 + 20 * degree)) return false;
  best_.assign(degree, kInfinity);
  for (size_t i = frame.firstEntry; i < entries_.size(); ++i) {
    const Entry& entry = entries_[i];
    double cost = entry.cost;
    for (int j = 0; j < 2; ++j)
      if (entry.part[j].block != kNone)
        cost = pass_.measure.join(cost, valuesOf(entry.part[j])[entry.index[j]]);
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
  // Here a triangle can meet itself, which costs it a fold; that only loosens the bound.
  transform_.apply(innerTheta_.data(), innerBase_.data(), innerBase_.size(), &set.slotTheta[begin],
                   degree, values);
  if (frames_.size() == 1) rootBound_ = *std::min_element(best_.begin(), best_.end());
  valuesOf(frame.front) = values;
  ++domainCount_;
  entries_.resize(frame.firstEntry);
  return true;
}

bool RelaxedBound::compute(ArrayView<const uint32_t> root, uint64_t maxSplits) {
  splitsLeft_ = maxSplits;
  const double expectedSplits = std::min(double(maxSplits), 1e7);
  leastPair_ = leastPairs(pass_.set, pass_.measure);
  findEdges();
  const Front front = insertFront(root);
  if (front.block == kNone || !open(front)) return false;
  while (!frames_.empty()) {
    Frame& frame = frames_.back();
    Front missing{kNone, 0};
    while (frame.cursor < entries_.size() && missing.block == kNone) {
      const Entry& entry = entries_[frame.cursor];
      for (const Front part : entry.part)
        if (part.block != kNone && !valuesOf(part)) missing = part;
      if (missing.block == kNone) ++frame.cursor;
    }
    if (missing.block != kNone) {
      if (!open(missing)) return false;
      continue;
    }
    if (!close(frame)) return false;
    frames_.pop_back();
    // How much work is left is known only at the end;
    // this comes to 0.95 for an ordinary number of splits.
    if (domainCount_ % 64 == 0)
      pass_.work.setFraction(1 - std::exp(-3 * double(maxSplits - splitsLeft_) / expectedSplits));
  }
  return true;
}

RelaxedBound::Front RelaxedBound::insertFront(Shape shape) {
  key_.assign(shape.begin(), shape.end());
  return insertFront(domains_.segment(shape, 0),
                     domains_.segment(shape, domains_.segmentCount(shape) - 1),
                     accessEdge(pass_.set, domains_, shape));
}

double RelaxedBound::value(Shape shape, uint32_t slot) {
  const Front front = insertFront(shape);
  const double* values = front.block == kNone ? nullptr : valuesOf(front);
  if (!values) return kInfinity;
  return values[slot - pass_.set.edgeSlots[accessEdge(pass_.set, domains_, shape)]];
}

}  // namespace sf
