#include "mesh/find.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/accurate_cross.h"
#include "base/sort.h"
#include "delaunay/insertion_order.h"

namespace sf {
namespace {

/// How many rims that meet at a vertex are paired in the best way; more are paired one by one.
constexpr uint32_t kMostTried = 6;
/// How far the normal of a face without area is looked for among its neighbours.
constexpr int kMostSteps = 8;
/// Vertices of a rim whose distances are all compared.
constexpr size_t kAllPairs = 1000;

/// Half-edge h of a rim has two ends: 2i where its filling edge begins, the half-edge's head,
/// and 2i + 1 where it ends, for the i-th of all half-edges of rims.
using End = uint32_t;

class RimFinder {
 public:
  RimFinder(const MeshView& mesh, const Adjacency& adjacency, Work& work, Charge& charge,
            Rims& result)
      : at_(mesh.positions),
        a_(adjacency),
        work_(work),
        charge_(charge),
        temporary_(work),
        rims_(result) {}

  bool run() {
    rims_ = {};
    return collect() && joinThroughFans() && joinThroughGaps() && trace() && markSeams();
  }

 private:
  struct Step {
    uint32_t edge;   // index in edges_
    bool isAgainst;  // passed from its filling edge's end to its beginning
  };

  bool collect();
  bool joinThroughFans();
  End acrossFan(End end) const;
  bool joinThroughGaps();
  void joinAt(ArrayView<const End> arriving);
  double gapCost(End arriving, End leaving) const;
  bool trace();
  bool split(const std::vector<Step>& walk);
  bool noteTouches(const std::vector<Step>& walk);
  bool add(ArrayView<Step> walk);
  bool markSeams();
  double diameterOf(ArrayView<const uint32_t> vertices);
  Vec3 normalOf(uint32_t h) const;
  Vec3 areaNormal(uint32_t face) const;

  uint32_t indexOf(uint32_t h) const {
    return uint32_t(std::lower_bound(edges_.begin(), edges_.end(), h) - edges_.begin());
  }
  uint32_t vertexOf(End end) const {
    const uint32_t h = edges_[end / 2];
    return end % 2 == 0 ? a_.head(h) : a_.tail(h);
  }
  bool isOfRim(uint32_t h) const {
    return a_.twins[h] == kNone && (a_.seams.empty() || a_.acrossSeam(h) == kNone);
  }

  UnitScale at_;
  const Adjacency& a_;
  Work& work_;
  Charge& charge_;    // of the result
  Charge temporary_;  // of what follows
  Rims& rims_;
  std::vector<uint32_t> edges_;   // half-edges of rims, by number
  std::vector<End> mates_;        // [2 edges] the end that a rim goes on with
  std::vector<uint32_t> seenAt_;  // [n] place in a walk, while one is split
  std::vector<uint32_t> places_;  // [edges] in `rims_`, or kNone
  std::vector<uint32_t> slits_;   // [edges] of slits: the other edge of each
  std::vector<uint32_t> after_;   // [edges] of a walk: the next one
};

bool RimFinder::collect() {
  for (uint32_t h = 0; h < a_.twins.size(); ++h) {
    if (h % 4096 == 0 && !work_.tick(4096)) return false;
    if (a_.corners[h] == kNone || !isOfRim(h)) continue;
    if (!push(edges_, h, temporary_)) return false;
  }
  return temporary_.add(2 * edges_.size() * sizeof(End) + a_.vertices * sizeof(uint32_t));
}

/// Every rim goes on at the other side of the fan of faces around its end.
bool RimFinder::joinThroughFans() {
  mates_.assign(2 * edges_.size(), kNone);
  for (End end = 0; end < mates_.size(); ++end) {
    if (mates_[end] != kNone) continue;
    if (!work_.tick(200)) return false;
    const End other = acrossFan(end);
    mates_[end] = other, mates_[other] = end;
  }
  return true;
}

/// Turns around the vertex at an end, from the face of the rim to the other rim. Seams are crossed.
End RimFinder::acrossFan(End end) const {
  uint32_t h = edges_[end / 2];
  bool startsHere = end % 2 == 1;  // whether h starts at the vertex
  for (;;) {
    const uint32_t g = startsHere ? prevInTriangle(h) : nextInTriangle(h);
    // g ends at the vertex if h starts there.
    if (a_.twins[g] != kNone) {
      h = a_.twins[g];
      continue;
    }
    const uint32_t seam = a_.seams.empty() ? kNone : a_.acrossSeam(g);
    if (seam == kNone) return 2 * indexOf(g) + End(!startsHere);
    h = seam;
    startsHere = !startsHere;
  }
}

/// Where several rims meet at a vertex, joins them across the gaps if that costs less.
bool RimFinder::joinThroughGaps() {
  struct Arrival {
    uint32_t vertex;
    End end;
  };
  std::vector<Arrival> arrivals;
  if (!reserve(arrivals, edges_.size(), temporary_)) return false;
  for (End end = 1; end < mates_.size(); end += 2) arrivals.push_back({vertexOf(end), end});
  sf::sort(arrivals.begin(), arrivals.end(), [](const Arrival& p, const Arrival& q) {
    return p.vertex != q.vertex ? p.vertex < q.vertex : p.end < q.end;
  });
  std::vector<End> here;
  for (size_t i = 0, j; i < arrivals.size(); i = j) {
    for (j = i + 1; j < arrivals.size() && arrivals[j].vertex == arrivals[i].vertex;) ++j;
    if (j - i == 1) continue;
    here.clear();
    bool isOriented = true;
    for (size_t k = i; k < j; ++k) {
      if (!push(here, arrivals[k].end, temporary_)) return false;
      isOriented &= mates_[arrivals[k].end] % 2 == 0;
    }
    if (!work_.tick(uint32_t(std::min<size_t>(here.size() * here.size() * 200, 1u << 30))))
      return false;
    if (isOriented) joinAt(here);
  }
  return true;
}

void RimFinder::joinAt(ArrayView<const End> arriving) {
  const uint32_t k = uint32_t(arriving.size());
  if (k > kMostTried) return;  // through fans, then; `split` parts what comes back to the vertex
  std::array<End, kMostTried> leaving;
  std::array<std::array<double, kMostTried>, kMostTried> costs;
  for (uint32_t i = 0; i < k; ++i) leaving[i] = mates_[arriving[i]];
  for (uint32_t i = 0; i < k; ++i)
    for (uint32_t j = 0; j < k; ++j) costs[i][j] = gapCost(arriving[i], leaving[j]);
  std::array<uint32_t, kMostTried> order, best;
  for (uint32_t i = 0; i < k; ++i) order[i] = best[i] = i;
  double least = std::numeric_limits<double>::infinity();
  do {
    double sum = 0;
    for (uint32_t i = 0; i < k; ++i) sum += costs[i][order[i]];
    if (sum < least - 1e-9) least = sum, best = order;
  } while (std::next_permutation(order.begin(), order.begin() + k));
  for (uint32_t i = 0; i < k; ++i) {
    mates_[arriving[i]] = leaving[best[i]];
    mates_[leaving[best[i]]] = arriving[i];
  }
}

/// The angle of the gap between two rim edges at their vertex, and twice the angle between the
/// faces' normals: in a plane, pairs across the gaps come to a whole turn less than any others.
double RimFinder::gapCost(End arriving, End leaving) const {
  const uint32_t in = edges_[arriving / 2], out = edges_[leaving / 2];
  const Vec3 v = at_(a_.tail(in));
  const Vec3 back = at_(a_.head(in)) - v, on = at_(a_.tail(out)) - v;
  const Vec3 p = normalOf(in), q = normalOf(out);
  const double turned = angleBetween(p, q);
  Vec3 normal = p + q;
  if (dot(normal, normal) < 1e-12) normal = p;
  const double size = length(normal);
  if (!(size > 0)) return kPi + 2 * turned;
  normal = (1 / size) * normal;
  const Vec3 flatBack = back - dot(back, normal) * normal, flatOn = on - dot(on, normal) * normal;
  double gap = std::atan2(dot(normal, cross(flatOn, flatBack)), dot(flatOn, flatBack));
  if (gap < 0) gap += 2 * kPi;
  return gap + 2 * turned;
}

bool RimFinder::trace() {
  std::vector<uint8_t> isDone(edges_.size(), 0);
  seenAt_.assign(a_.vertices, kNone);
  for (auto* list : {&places_, &slits_, &after_}) list->assign(edges_.size(), kNone);
  rims_.starts.push_back(0);
  if (!charge_.add(edges_.size() * (2 * sizeof(uint32_t) + sizeof(Vec3))) ||
      !temporary_.add(edges_.size() * (1 + 2 * sizeof(Step) + 3 * sizeof(uint32_t))))
    return false;
  rims_.vertices.reserve(edges_.size());
  rims_.halves.reserve(edges_.size());
  rims_.normals.reserve(edges_.size());
  std::vector<Step> walk;
  for (uint32_t seed = 0; seed < edges_.size(); ++seed) {
    if (isDone[seed]) continue;
    walk.clear();
    End end = 2 * seed;  // where the walk comes to the edge
    do {
      walk.push_back({end / 2, end % 2 == 1});
      isDone[end / 2] = 1;
      end = mates_[end ^ 1];
    } while (end / 2 != seed);
    SF_ASSERT(end % 2 == 0);
    if (!work_.tick(uint32_t(std::min<size_t>(walk.size() * 300, 1u << 30)))) return false;
    const uint32_t before = rims_.count();
    if (!split(walk) || (rims_.count() > before + 1 && !noteTouches(walk))) return false;
  }
  sf::sort(rims_.touches.begin(), rims_.touches.end(),
           [](const RimTouch& p, const RimTouch& q) { return p.before < q.before; });
  return true;
}

/// Where a walk that was parted went on from one rim to another. At a slit it goes on as behind it.
bool RimFinder::noteTouches(const std::vector<Step>& walk) {
  for (const Step s : walk)
    if (s.isAgainst) return true;  // across a seam: parts of it may run either way
  for (size_t i = 0; i < walk.size(); ++i) after_[walk[i].edge] = walk[(i + 1) % walk.size()].edge;
  for (const Step s : walk) {
    const uint32_t before = places_[s.edge];
    if (before == kNone) continue;
    uint32_t next = after_[s.edge];
    while (places_[next] == kNone) next = after_[slits_[next]];
    if (rims_.nextEdge(rims_.rimOf(before), before) == places_[next]) continue;
    if (!push(rims_.touches, {before, places_[next]}, charge_)) return false;
  }
  return true;
}

/// Parts a walk at vertices that it passes twice.
bool RimFinder::split(const std::vector<Step>& walk) {
  const auto beginOf = [&](Step s) { return vertexOf(2 * s.edge + End(s.isAgainst)); };
  std::vector<Step> open;
  open.reserve(walk.size());
  bool isGood = true;
  for (const Step s : walk) {
    const uint32_t v = beginOf(s);
    if (seenAt_[v] != kNone) {
      const uint32_t first = seenAt_[v];
      for (size_t i = first; i < open.size(); ++i) seenAt_[beginOf(open[i])] = kNone;
      isGood = isGood && add({open.data() + first, open.size() - first});
      open.resize(first);
    }
    seenAt_[v] = uint32_t(open.size());
    open.push_back(s);
  }
  for (const Step s : open) seenAt_[beginOf(s)] = kNone;
  return isGood && add(open);
}

bool RimFinder::add(ArrayView<Step> walk) {
  if (walk.size() < 3) {
    SF_ASSERT(walk.size() == 2);  // a slit
    slits_[walk[0].edge] = walk[1].edge, slits_[walk[1].edge] = walk[0].edge;
    return true;
  }
  // Parts of a walk across seams may run the wrong way.
  if (walk[0].isAgainst) {
    std::reverse(walk.begin(), walk.end());
    for (Step& s : walk) s.isAgainst = !s.isAgainst;
  }
  const uint32_t first = uint32_t(rims_.vertices.size());
  Rim rim{0, 0, kNone, false, false};
  for (const Step s : walk) {
    const uint32_t h = edges_[s.edge], v = vertexOf(2 * s.edge + End(s.isAgainst));
    const Vec3 normal = normalOf(h);
    places_[s.edge] = uint32_t(rims_.vertices.size());
    rims_.vertices.push_back(v);
    rims_.halves.push_back(h);
    rims_.normals.push_back(s.isAgainst ? -normal : normal);
    rim.length += distance(at_(a_.head(h)), at_(a_.tail(h)));
    rim.crossesSeam |= s.isAgainst != walk[0].isAgainst;
  }
  rim.length /= at_.factor;
  rim.component = a_.component[rims_.halves[first] / 3];
  const ArrayView<const uint32_t> all(rims_.vertices);
  rim.diameter = diameterOf(all.slice(first, walk.size())) / at_.factor;
  return push(rims_.rims, rim, charge_) &&
         push(rims_.starts, uint32_t(rims_.vertices.size()), charge_);
}

/// Finds rims that welding would join to others, or to themselves.
bool RimFinder::markSeams() {
  struct Side {
    uint32_t low, high, edge;  // places, as the first edge that begins there
  };
  const uint32_t count = uint32_t(rims_.vertices.size());
  std::vector<Side> sides;
  std::vector<Vec3> points;
  std::vector<uint32_t> places;
  if (!temporary_.add(count * (sizeof(Side) + sizeof(Vec3) + sizeof(uint32_t) + sizeof(double))) ||
      !work_.tick(uint32_t(std::min<size_t>(count * size_t(100), 1u << 30))))
    return false;
  for (const uint32_t v : rims_.vertices) points.push_back(at_(v));
  if (!findEqualPoints(points, work_, places)) return false;
  const auto headOf = [&](uint32_t e) { return rims_.nextEdge(rims_.rimOf(e), e); };
  for (uint32_t e = 0; e < count; ++e) {
    const uint32_t p = places[e], q = places[headOf(e)];
    if (p != q) sides.push_back({std::min(p, q), std::max(p, q), e});
  }
  const auto isSamePlace = [](const Side& p, const Side& q) {
    return p.low == q.low && p.high == q.high;
  };
  sf::sort(sides.begin(), sides.end(), [&](const Side& p, const Side& q) {
    return p.low != q.low ? p.low < q.low : p.high != q.high ? p.high < q.high : p.edge < q.edge;
  });
  const auto verticesOf = [&](const Side& s) {
    return std::minmax(rims_.vertices[s.edge], rims_.vertices[headOf(s.edge)]);
  };
  std::vector<double> lengths(rims_.count());
  for (size_t i = 0, j; i < sides.size(); i = j) {
    bool isSeam = false;
    for (j = i; j < sides.size() && isSamePlace(sides[i], sides[j]); ++j)
      isSeam |= verticesOf(sides[j]) != verticesOf(sides[i]);
    for (size_t k = i; k < j && isSeam; ++k)
      lengths[rims_.rimOf(sides[k].edge)] += distance(points[sides[i].low], points[sides[i].high]);
  }
  for (uint32_t r = 0; r < rims_.count(); ++r)
    rims_.rims[r].isSeam = 2 * lengths[r] > rims_.rims[r].length * at_.factor;
  return true;
}

/// The largest distance between two of the vertices; of many, between two that are extreme in some
/// direction.
double RimFinder::diameterOf(ArrayView<const uint32_t> vertices) {
  std::vector<Vec3> points;
  if (vertices.size() <= kAllPairs) {
    for (const uint32_t v : vertices) points.push_back(at_(v));
  } else {
    for (int d = 0; d < 125; ++d) {
      const Vec3 to{double(d % 5 - 2), double(d / 5 % 5 - 2), double(d / 25 - 2)};
      Vec3 extreme = at_(vertices[0]);
      for (const uint32_t v : vertices)
        if (dot(at_(v), to) > dot(extreme, to)) extreme = at_(v);
      points.push_back(extreme);
    }
  }
  double largest = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      const Vec3 d = points[j] - points[i];
      largest = std::max(largest, dot(d, d));
    }
  }
  return std::sqrt(largest);
}

Vec3 RimFinder::areaNormal(uint32_t face) const {
  const uint32_t h = 3 * face;
  const Vec3 a = at_(a_.tail(h)), b = at_(a_.tail(h + 1)), c = at_(a_.tail(h + 2));
  return accurateCross(a, b, c);
}

/// The unit normal of the face of h, or of the nearest neighbour that has one, across longest edges.
Vec3 RimFinder::normalOf(uint32_t h) const {
  uint32_t face = h / 3;
  for (int step = 0; step < kMostSteps; ++step) {
    const Vec3 n = areaNormal(face);
    const double size = length(n);
    if (size > 1e-290) return (1 / size) * n;
    uint32_t next = kNone;
    double longest = -1;
    for (uint32_t g = 3 * face; g < 3 * face + 3; ++g) {
      const double l = distance(at_(a_.tail(g)), at_(a_.head(g)));
      if (a_.twins[g] != kNone && l > longest) longest = l, next = a_.twins[g] / 3;
    }
    if (next == kNone) break;
    face = next;
  }
  return {0, 0, 0};
}

}  // namespace

bool findRims(const MeshView& mesh, const Adjacency& adjacency, Work& work, Charge& charge,
              Rims& result) {
  return RimFinder(mesh, adjacency, work, charge, result).run();
}

}  // namespace sf
