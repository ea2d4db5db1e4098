#include "polygon/repair/face_rings.h"

#include <algorithm>

#include "base/turn.h"

namespace sf {
namespace {

class FaceTracer {
 public:
  FaceTracer(ArrayView<const Point2> at, ArrayView<const WeightedEdge> edges,
             const Crossings& found, Repair rule, Work& work, Charge& charge, FaceRings& result)
      : at_(at),
        edges_(edges),
        found_(found),
        rule_(rule),
        work_(work),
        charge_(charge),
        result_(result) {}

  bool run() {
    const uint64_t m = at_.size(), e = edges_.size();
    if (!charge_.add(e * (sizeof(Arc) + sizeof(WeightedEdge) + 6 * sizeof(uint32_t)) +
                     m * 3 * sizeof(uint32_t)))
      return false;
    chooseArcs();
    joinArcs();
    if (!work_.tick(uint32_t(std::min<size_t>(e, 1u << 20)) * 200)) return false;
    traceRings();
    return nest();
  }

 private:
  /// A directed edge with a chosen face to the left and none to the right.
  struct Arc {
    uint32_t from, to;
    uint32_t next;  // the arc that goes on around the face
  };

  bool isChosen(int32_t winding) const {
    return rule_ == Repair::EvenOdd ? (winding & 1) != 0 : winding != 0;
  }
  void chooseArcs();
  void joinArcs();
  void joinAt(uint32_t v, std::vector<uint32_t>& arcs);
  void traceRings();
  void cutRing(std::vector<uint32_t>& walk, size_t first);
  bool nest();
  void group(const std::vector<uint32_t>& outerOf);

  ArrayView<const Point2> at_;
  ArrayView<const WeightedEdge> edges_;
  const Crossings& found_;
  Repair rule_;
  Work& work_;
  Charge& charge_;
  FaceRings& result_;
  std::vector<Arc> arcs_;
  std::vector<WeightedEdge> kept_;  // their edges, `input` the number of the arc
  std::vector<uint32_t> ringOf_;    // [arcs]
  // Rings as lists of arcs.
  std::vector<uint32_t> ringArcs_, ringStarts_;
};

void FaceTracer::chooseArcs() {
  for (uint32_t e = 0; e < edges_.size(); ++e) {
    const WeightedEdge& edge = edges_[e];
    const bool left = isChosen(found_.winding[e]),
               right = isChosen(found_.winding[e] - edge.weight);
    if (left == right) continue;
    const uint32_t arc = uint32_t(arcs_.size());
    arcs_.push_back(left ? Arc{edge.low, edge.high, kNone} : Arc{edge.high, edge.low, kNone});
    kept_.push_back({edge.low, edge.high, left ? 1 : -1, arc});
  }
}

/// Sets `next` of all arcs.
void FaceTracer::joinArcs() {
  // The arcs by the vertices at both of their ends.
  std::vector<uint32_t> starts(at_.size() + 1), list(2 * arcs_.size());
  for (const Arc& a : arcs_) ++starts[a.from], ++starts[a.to];
  uint32_t sum = 0;
  for (uint32_t& s : starts) sum += s, s = sum - s;
  for (uint32_t a = 0; a < arcs_.size(); ++a)
    list[starts[arcs_[a].from]++] = a, list[starts[arcs_[a].to]++] = a;
  std::vector<uint32_t> here;
  uint32_t begin = 0;
  for (uint32_t v = 0; v < at_.size(); begin = starts[v++]) {
    here.assign(list.begin() + begin, list.begin() + starts[v]);
    if (!here.empty()) joinAt(v, here);
  }
}

void FaceTracer::joinAt(uint32_t v, std::vector<uint32_t>& arcs) {
  const auto other = [&](uint32_t a) { return arcs_[a].from == v ? arcs_[a].to : arcs_[a].from; };
  if (arcs.size() > 2)
    std::sort(arcs.begin(), arcs.end(), [&](uint32_t a, uint32_t b) {
      // Counter-clockwise, those to higher points first; points are numbered by height.
      const uint32_t p = other(a), q = other(b);
      if ((p > v) != (q > v)) return p > v;
      return turn(at_[v], at_[p], at_[q]) > 0;
    });
  // Arcs that end and arcs that start take turns, since every other sector is a chosen face. The
  // face to the left of an arc that ends here is clockwise of it.
  for (size_t i = 0; i < arcs.size(); ++i) {
    const uint32_t before = arcs[i > 0 ? i - 1 : arcs.size() - 1];
    if (arcs_[arcs[i]].to != v) continue;
    SF_ASSERT(arcs_[before].from == v);
    arcs_[arcs[i]].next = before;
  }
}

void FaceTracer::traceRings() {
  ringOf_.assign(arcs_.size(), kNone);
  ringStarts_.assign(1, 0);
  // Where each vertex is on the walk: arcs are stacked, and come off as a ring once the vertex that
  // the first of them leaves comes again.
  std::vector<uint32_t> place(at_.size(), kNone), walk;
  for (uint32_t first = 0; first < arcs_.size(); ++first) {
    if (ringOf_[first] != kNone) continue;
    uint32_t a = first;
    do {
      place[arcs_[a].from] = uint32_t(walk.size());
      walk.push_back(a);
      ringOf_[a] = 0;  // until it is known
      const uint32_t to = arcs_[a].to;
      if (place[to] != kNone) {
        const size_t from = place[to];
        for (size_t i = from; i < walk.size(); ++i) place[arcs_[walk[i]].from] = kNone;
        cutRing(walk, from);
      }
      a = arcs_[a].next;
    } while (a != first);
    SF_ASSERT(walk.empty());
  }
}

void FaceTracer::cutRing(std::vector<uint32_t>& walk, size_t first) {
  const uint32_t ring = uint32_t(ringStarts_.size()) - 1;
  for (size_t i = first; i < walk.size(); ++i) {
    ringOf_[walk[i]] = ring;
    ringArcs_.push_back(walk[i]);
  }
  ringStarts_.push_back(uint32_t(ringArcs_.size()));
  walk.resize(first);
}

/// Finds the outer ring around each hole: the one that bounds the face left of the hole's lowest
/// point, or belongs to the same polygon as the hole that does.
bool FaceTracer::nest() {
  const uint32_t rings = uint32_t(ringStarts_.size()) - 1;
  if (!charge_.add(uint64_t(rings) * 4 * sizeof(uint32_t))) return false;
  std::vector<uint32_t> outerOf(rings, kNone), lowest(rings, kNone);
  bool hasHoles = false;
  for (uint32_t r = 0; r < rings; ++r) {
    // Of the two edges that go up from the lowest point, the left one has the face of a hole to
    // its left, and leads down around an outer ring.
    uint32_t low = ringStarts_[r];
    for (uint32_t i = low; i < ringStarts_[r + 1]; ++i)
      if (arcs_[ringArcs_[i]].from < arcs_[ringArcs_[low]].from) low = i;
    const uint32_t before = low > ringStarts_[r] ? low - 1 : ringStarts_[r + 1] - 1;
    const Arc &out = arcs_[ringArcs_[low]], &in = arcs_[ringArcs_[before]];
    const bool isHole = turn(at_[in.from], at_[out.from], at_[out.to]) < 0;
    if (isHole)
      hasHoles = true, lowest[r] = ringArcs_[low];
    else
      outerOf[r] = r;
  }
  if (hasHoles) {
    Crossings order;
    if (!findCrossings(at_, kept_, 0, work_, charge_, order)) return false;
    SF_ASSERT(order.cuts.empty());
    std::vector<uint32_t> chain;
    for (uint32_t r = 0; r < rings; ++r) {
      uint32_t s = r;
      for (; outerOf[s] == kNone; s = ringOf_[order.left[lowest[s]]]) chain.push_back(s);
      for (const uint32_t hole : chain) outerOf[hole] = outerOf[s];
      chain.clear();
    }
  }
  group(outerOf);
  return true;
}

/// Writes the rings polygon by polygon.
void FaceTracer::group(const std::vector<uint32_t>& outerOf) {
  const uint32_t rings = uint32_t(outerOf.size());
  std::vector<uint32_t> order;
  for (uint32_t r = 0; r < rings; ++r) order.push_back(r);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    if (outerOf[a] != outerOf[b]) return outerOf[a] < outerOf[b];
    if ((outerOf[a] == a) != (outerOf[b] == b)) return outerOf[a] == a;
    return a < b;
  });
  result_ = {};
  result_.ringStarts.push_back(0);
  for (uint32_t i = 0; i < rings; ++i) {
    const uint32_t r = order[i];
    if (outerOf[r] == r) result_.polygonStarts.push_back(i);
    for (uint32_t k = ringStarts_[r]; k < ringStarts_[r + 1]; ++k)
      result_.vertices.push_back(arcs_[ringArcs_[k]].from);
    result_.ringStarts.push_back(uint32_t(result_.vertices.size()));
  }
  result_.polygonStarts.push_back(rings);
}

}  // namespace

bool traceFaces(ArrayView<const Point2> at, ArrayView<const WeightedEdge> edges,
                const Crossings& found, Repair rule, Work& work, Charge& charge,
                FaceRings& result) {
  return FaceTracer(at, edges, found, rule, work, charge, result).run();
}

}  // namespace sf
