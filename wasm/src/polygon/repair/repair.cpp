#include "polygon/repair/repair.h"

#include <algorithm>
#include <cmath>

#include "base/metric.h"
#include "polygon/repair/crossing_point.h"
#include "polygon/repair/crossing_sweep.h"
#include "polygon/repair/face_rings.h"
#include "polygon/repair/snap_rounding.h"

namespace sf {
namespace {

/// The exponent e that brings the largest magnitude along an axis into [1/2, 1) times 2^e.
int exponentOf(ArrayView<const double> positions, size_t axis) {
  double largest = 0;
  for (size_t i = axis; i < positions.size(); i += 2)
    largest = std::fmax(largest, std::fabs(positions[i]));
  int exponent = 0;
  if (largest > 0) std::frexp(largest, &exponent);
  return exponent;
}

class Repairer {
 public:
  Repairer(const PolygonView& polygon, Repair rule, Work& work, RepairLimits limits,
           RepairedPolygons& result)
      : polygon_(polygon),
        rule_(rule),
        limits_(limits),
        work_(work),
        charge_(work),
        result_(result) {}

  Status run() {
    const size_t n = polygon_.positions.size() / 2;
    if (n >= kNone / 8 || !work_.fits(double(n) * kBytesPerVertex)) return Status::TooLarge;
    if (!start() || !resolve()) return work_.status();
    if (!found_.cuts.empty()) return Status::TooLarge;  // not reached: snap rounding leaves none
    if (!traceFaces(at_, edges_, found_, rule_, work_, charge_, faces_)) return work_.status();
    return handBack() ? Status::Ok : work_.status();
  }

 private:
  // Points and edges twice (before and after a round), the sweep's records, rings.
  static constexpr double kBytesPerVertex = 400;

  /// A point before it is numbered: `origin` is a vertex of the input or n + an added point.
  struct Raw {
    Point2 at;
    uint32_t origin;
  };
  struct Added {
    Point2 at;
    uint32_t on[2];
  };

  uint32_t vertexCount() const { return uint32_t(polygon_.positions.size() / 2); }
  Point2 scaled(uint32_t v) const {
    return {scaledDown(polygon_.positions[2 * v], exponent_[0]),
            scaledDown(polygon_.positions[2 * v + 1], exponent_[1])};
  }
  uint32_t previousOf(uint32_t v) const {
    const auto& starts = polygon_.starts;
    const size_t ring = size_t(std::upper_bound(starts.begin(), starts.end(), v) - starts.begin());
    return v > starts[ring - 1] ? v - 1 : starts[ring] - 1;
  }

  bool start();
  bool resolve();
  bool splitAtCuts();
  bool snap();
  bool renumber();
  void mergeEdges();
  uint32_t addPoint(Point2 at, uint32_t first, uint32_t second);
  uint32_t movedTo(Point2 at, uint32_t origin);
  bool handBack();

  const PolygonView& polygon_;
  Repair rule_;
  RepairLimits limits_;
  Work& work_;
  Charge charge_;
  RepairedPolygons& result_;
  int exponent_[2] = {0, 0};
  std::vector<Added> added_;
  // The points and edges of this round, and as they will be in the next.
  std::vector<Point2> at_;
  std::vector<uint32_t> origin_;
  std::vector<WeightedEdge> edges_;
  Crossings found_;
  std::vector<Raw> raw_;
  std::vector<WeightedEdge> rawEdges_;  // ends are numbers of raw points, low and high as it comes
  FaceRings faces_;
};

/// Raw points and edges are the input's, rings turned the way they should run.
bool Repairer::start() {
  const uint32_t n = vertexCount();
  Charge charge(work_);
  std::vector<Point2> ring;
  if (!reserve(raw_, n, charge_) || !reserve(rawEdges_, n, charge_) || !reserve(ring, n, charge))
    return false;
  for (int axis : {0, 1}) exponent_[axis] = exponentOf(polygon_.positions, size_t(axis));
  for (size_t r = 0; r + 1 < polygon_.starts.size(); ++r) {
    const uint32_t first = polygon_.starts[r], last = polygon_.starts[r + 1];
    ring.clear();
    for (uint32_t v = first; v < last; ++v) ring.push_back(scaled(v));
    const int32_t weight = (areaSign(ring) < 0) == (r == 0) ? -1 : 1;
    for (uint32_t v = first; v < last; ++v) {
      const Point2 p = ring[v - first];
      const bool isSame = std::ldexp(p.x, exponent_[0]) == polygon_.positions[2 * v] &&
                          std::ldexp(p.y, exponent_[1]) == polygon_.positions[2 * v + 1];
      raw_.push_back({p, isSame ? v : addPoint(p, v, previousOf(v))});
      rawEdges_.push_back({v, v + 1 < last ? v + 1 : first, weight, v});
    }
    if (!work_.tick(20 * (last - first))) return false;
  }
  return renumber();
}

/// Goes on until nothing crosses. If edges are nearly parallel, every bend may make more crossings
/// than it ends, so neither rounds nor edges may go on growing.
bool Repairer::resolve() {
  size_t allowed = size_t(-1);
  for (uint32_t round = 0;; ++round) {
    if (!findCrossings(at_, edges_, allowed, work_, charge_, found_)) return false;
    if (found_.cuts.empty()) return true;
    const size_t pieces = edges_.size() + found_.cuts.size();
    if (round == 0) allowed = 2 * pieces;
    if (round >= limits_.rounds || pieces > allowed) break;
    if (!splitAtCuts()) return false;
  }
  // First to the cells of vertices alone: that leaves few of many edges that are nearly one.
  found_.crossings.clear();
  if (!snap() || !findCrossings(at_, edges_, size_t(-1), work_, charge_, found_)) return false;
  if (found_.cuts.empty()) return true;
  return snap() && findCrossings(at_, edges_, size_t(-1), work_, charge_, found_);
}

/// Every edge becomes the chain of its pieces between the rounded points on it.
bool Repairer::splitAtCuts() {
  const uint32_t m = uint32_t(at_.size());
  const size_t crossings = found_.crossings.size(), cuts = found_.cuts.size();
  Charge charge(work_);
  if (!reserve(raw_, m + crossings, charge_) ||
      !reserve(rawEdges_, edges_.size() + cuts, charge_) ||
      !charge.add((uint64_t(edges_.size()) + 1 + cuts) * sizeof(uint32_t)))
    return false;
  raw_.clear(), rawEdges_.clear();
  for (uint32_t v = 0; v < m; ++v) raw_.push_back({at_[v], origin_[v]});
  for (const EdgeCrossing& c : found_.crossings)
    raw_.push_back({c.at, addPoint(c.at, edges_[c.first].input, edges_[c.second].input)});
  // The cuts by edge; those of each are in order already.
  std::vector<uint32_t> starts(edges_.size() + 1), points(cuts);
  for (const EdgeCut& cut : found_.cuts) ++starts[cut.edge + 1];
  for (size_t e = 0; e < edges_.size(); ++e) starts[e + 1] += starts[e];
  for (const EdgeCut& cut : found_.cuts) points[starts[cut.edge]++] = cut.point;
  uint32_t next = 0;
  for (size_t e = 0; e < edges_.size(); ++e) {
    const WeightedEdge& edge = edges_[e];
    uint32_t from = edge.low;
    for (; next < starts[e]; ++next) {
      rawEdges_.push_back({from, points[next], -edge.weight, edge.input});
      from = points[next];
    }
    rawEdges_.push_back({from, edge.high, -edge.weight, edge.input});
  }
  return renumber();
}

bool Repairer::snap() {
  Charge charge(work_);
  std::vector<HotCell> cells;
  std::vector<SnappedPiece> pieces;
  const double size = std::ldexp(1.0, -limits_.gridBits);
  if (!snapRound(at_, edges_, found_, size, work_, charge, cells, pieces)) return false;
  if (!reserve(raw_, cells.size(), charge_) || !reserve(rawEdges_, pieces.size(), charge_))
    return false;
  raw_.clear(), rawEdges_.clear();
  for (const HotCell& cell : cells) {
    uint32_t origin;
    if (cell.cause >= at_.size()) {
      const EdgeCrossing& c = found_.crossings[cell.cause - at_.size()];
      origin = addPoint(cell.centre, edges_[c.first].input, edges_[c.second].input);
    } else {
      origin = origin_[cell.cause];
      if (!(at_[cell.cause] == cell.centre)) origin = movedTo(cell.centre, origin);
    }
    raw_.push_back({cell.centre, origin});
  }
  for (const SnappedPiece& piece : pieces) {
    const WeightedEdge& edge = edges_[piece.edge];
    rawEdges_.push_back({piece.from, piece.to, -edge.weight, edge.input});
  }
  return renumber();
}

uint32_t Repairer::addPoint(Point2 at, uint32_t first, uint32_t second) {
  push(added_, Added{at, {std::min(first, second), std::max(first, second)}},
       charge_);  // the next round sees it if memory is short
  return vertexCount() + uint32_t(added_.size()) - 1;
}
uint32_t Repairer::movedTo(Point2 at, uint32_t origin) {
  if (origin < vertexCount()) return addPoint(at, origin, previousOf(origin));
  const Added old = added_[origin - vertexCount()];
  return addPoint(at, old.on[0], old.on[1]);
}

/// Numbers the raw points that edges end at by height, equal ones alike, and turns raw edges
/// (from, to, weight to the left) into edges from low to high, merged where they coincide.
bool Repairer::renumber() {
  const size_t m = raw_.size();
  if (m >= kNone / 2) work_.fail(Status::TooLarge);
  Charge charge(work_);
  std::vector<uint32_t> order, number;
  if (!reserve(order, m, charge) || !reserve(number, m, charge) || !reserve(at_, m, charge_) ||
      !reserve(origin_, m, charge_) || !reserve(edges_, rawEdges_.size(), charge_))
    return false;
  number.assign(m, kNone);
  for (const WeightedEdge& e : rawEdges_) {
    if (raw_[e.low].at == raw_[e.high].at) continue;
    for (const uint32_t v : {e.low, e.high})
      if (number[v] == kNone) number[v] = 0, order.push_back(v);
  }
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    const Point2 p = raw_[a].at, q = raw_[b].at;
    return p == q ? raw_[a].origin < raw_[b].origin : below(p, q);
  });
  at_.clear(), origin_.clear();
  for (const uint32_t v : order) {
    if (at_.empty() || !(at_.back() == raw_[v].at)) {
      at_.push_back(raw_[v].at);
      origin_.push_back(raw_[v].origin);
    }
    number[v] = uint32_t(at_.size()) - 1;
  }
  edges_.clear();
  for (const WeightedEdge& e : rawEdges_) {
    const uint32_t a = number[e.low], b = number[e.high];
    if (raw_[e.low].at == raw_[e.high].at) continue;
    edges_.push_back({std::min(a, b), std::max(a, b), a < b ? e.weight : -e.weight, e.input});
  }
  mergeEdges();
  return work_.tick(uint32_t(std::min<size_t>(m, 1u << 20)) * 400);
}

void Repairer::mergeEdges() {
  std::sort(edges_.begin(), edges_.end(), [](const WeightedEdge& a, const WeightedEdge& b) {
    return a.low != b.low ? a.low < b.low : a.high != b.high ? a.high < b.high : a.input < b.input;
  });
  size_t kept = 0;
  for (size_t i = 0; i < edges_.size();) {
    WeightedEdge edge = edges_[i];
    for (++i; i < edges_.size() && edges_[i].low == edge.low && edges_[i].high == edge.high; ++i)
      edge.weight += edges_[i].weight;
    if (rule_ == Repair::EvenOdd) edge.weight &= 1;
    if (edge.weight != 0) edges_[kept++] = edge;
  }
  edges_.resize(kept);
}

/// Rings in the numbers of the input; added points that rings use, scaled back.
bool Repairer::handBack() {
  const uint32_t n = vertexCount();
  const uint64_t size = faces_.vertices.size();
  Charge charge(work_);
  if (!charge.add(size * 2 * (2 * sizeof(uint32_t) + 2 * sizeof(double)) +
                  added_.size() * sizeof(uint32_t)))
    return false;
  result_.added.clear(), result_.addedOn.clear(), result_.vertices.clear();
  std::vector<uint32_t> number(added_.size(), kNone);
  for (const uint32_t v : faces_.vertices) {
    uint32_t vertex = origin_[v];
    if (vertex >= n) {
      const Added& point = added_[vertex - n];
      uint32_t& given = number[vertex - n];
      if (given == kNone) {
        given = n + uint32_t(result_.added.size() / 2);
        result_.added.push_back(std::ldexp(point.at.x, exponent_[0]));
        result_.added.push_back(std::ldexp(point.at.y, exponent_[1]));
        result_.addedOn.insert(result_.addedOn.end(), {point.on[0], point.on[1]});
      }
      vertex = given;
    }
    result_.vertices.push_back(vertex);
  }
  result_.ringStarts = std::move(faces_.ringStarts);
  result_.polygonStarts = std::move(faces_.polygonStarts);
  return true;
}

/// Whether `starts` runs from 0 to n without a step down, and all coordinates are accepted.
Outcome checkInput(const PolygonView& polygon) {
  Outcome outcome;
  const auto& starts = polygon.starts;
  bool good = starts.size() >= 1 && starts[0] == 0 && polygon.positions.size() % 2 == 0 &&
              starts[starts.size() - 1] == polygon.positions.size() / 2;
  for (size_t r = 0; good && r + 1 < starts.size(); ++r) good = starts[r] <= starts[r + 1];
  if (!good) outcome.status = Status::BadStarts;
  for (size_t r = 0; good && r + 1 < starts.size(); ++r)
    for (uint32_t v = starts[r]; v < starts[r + 1]; ++v) {
      if (isAccepted({polygon.positions[2 * v], polygon.positions[2 * v + 1]})) continue;
      outcome.status = Status::NotFinite;
      outcome.loop = uint32_t(r), outcome.vertex = v - starts[r];
      return outcome;
    }
  return outcome;
}

}  // namespace

Outcome repairPolygon(const PolygonView& polygon, Repair rule, Work& work, RepairedPolygons& result,
                      RepairLimits limits) {
  Outcome outcome = checkInput(polygon);
  if (outcome.ok()) outcome.status = Repairer(polygon, rule, work, limits, result).run();
  return outcome;
}

}  // namespace sf
