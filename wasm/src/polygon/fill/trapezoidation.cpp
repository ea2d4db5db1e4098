#include "polygon/fill/trapezoidation.h"

#include "base/charge.h"
#include "base/predicates.h"
#include "polygon/input/metric_points.h"
#include "triangles/insertion_order.h"
#include "triangles/locate.h"

namespace sf {
namespace {

// Edges by number: 2u is the edge up from u with the polygon to its right, 2u + 1 to its left.
uint32_t leftEdge(uint32_t lower) { return 2 * lower; }
uint32_t rightEdge(uint32_t lower) { return 2 * lower + 1; }
uint32_t lowerNode(uint32_t edge) { return edge >> 1; }
uint32_t upperNode(const LinkedPolygon& linked, uint32_t edge) {
  const uint32_t u = lowerNode(edge);
  return edge & 1 ? linked.next[u] : linked.prev[u];
}

constexpr size_t kFlipsForIslands = 16;
// If the next island is more steps away than this, going along the line of sight is better.
constexpr uint32_t kLongestWalk = 40;

}  // namespace

bool findTrapezoids(const LinkedPolygon& linked, const Visibility& seen, Work& work,
                    std::vector<Trapezoid>& trapezoids) {
  Charge charge(work);
  if (!charge.add(8 * uint64_t(linked.at.size()))) return false;
  trapezoids.clear();
  // The node that saw each edge last; at first the node where the edge begins.
  std::vector<uint32_t> last(2 * linked.at.size());
  for (uint32_t e = 0; e < last.size(); ++e) last[e] = lowerNode(e);
  for (const uint32_t v : seen.order) {
    const uint32_t l = seen.left[v] == kNone ? kNone : leftEdge(seen.left[v]);
    const uint32_t r = seen.right[v] == kNone ? kNone : rightEdge(seen.right[v]);
    const uint32_t endsLeft = leftEdge(linked.next[v]), endsRight = rightEdge(linked.prev[v]);
    const auto close = [&](uint32_t left, uint32_t right) {
      SF_ASSERT(last[left] == last[right]);
      trapezoids.push_back({last[left], v, lowerNode(left), lowerNode(right)});
    };
    switch (linked.kind[v]) {
      case VertexKind::LeftBank:
        close(endsLeft, r);
        break;
      case VertexKind::RightBank:
        close(l, endsRight);
        break;
      case VertexKind::Sag:
      case VertexKind::Island:
        close(l, r);
        break;
      case VertexKind::Top:
        close(l, endsRight), close(endsLeft, r);
        break;
      case VertexKind::Ceiling:
        close(endsLeft, endsRight);
        break;
      case VertexKind::Bottom:
      case VertexKind::Unused:
        break;
    }
    if (l != kNone) last[l] = v;
    if (r != kNone) last[r] = v;
    if (!work.tick(16)) return false;
  }
  return true;
}

bool findUniMonotonePolygons(const LinkedPolygon& linked, const Visibility& seen, bool islands,
                             Work& work, UniMonotonePolygons& polygons) {
  const uint32_t edges = 2 * uint32_t(linked.at.size());
  std::vector<uint32_t>& starts = polygons.starts;
  starts.assign(size_t(edges) + 1, 0);
  const auto forEachSight = [&](auto&& see) {
    for (const uint32_t v : seen.order) {
      if (!islands && linked.kind[v] == VertexKind::Island) continue;
      if (seen.left[v] != kNone) see(v, leftEdge(seen.left[v]));
      if (seen.right[v] != kNone) see(v, rightEdge(seen.right[v]));
    }
  };
  forEachSight([&](uint32_t, uint32_t e) { ++starts[e]; });
  uint32_t size = 0;
  for (uint32_t e = 0; e < edges; ++e) {
    const uint32_t count = starts[e];
    starts[e] = size;
    if (count > 0) size += count + 2;
  }
  starts[edges] = size;
  if (!work.tick(edges)) return false;

  // starts[e] runs ahead to the last vertex put in, which leaves room for the ends of the base.
  polygons.chain.resize(size);
  uint32_t* chain = polygons.chain.data();
  forEachSight([&](uint32_t v, uint32_t e) { chain[++starts[e]] = v; });
  uint32_t first = 0;
  for (uint32_t e = 0; e < edges; ++e) {
    const uint32_t last = starts[e];
    starts[e] = first;
    if (last == first) continue;
    chain[first] = lowerNode(e);
    chain[last + 1] = upperNode(linked, e);
    first = last + 2;
  }
  return work.tick(2 * size);
}

/// Where point p lies: along the horizontal line by which it sees the edge e to its left, whose
/// half-edge runs down. No vertex is level with p, since `below` tilts horizontals.
TriangleMesh::Place TrapezoidTriangulator::followSight(uint32_t e, uint32_t p) const {
  for (;;) {
    const uint32_t w = mesh_.apex(e);
    const bool under = below(mesh_.at[w], mesh_.at[p]);
    if (!under && mesh_.at[w] == mesh_.at[p]) return {};
    const uint32_t exit = under ? prevInTriangle(e) : nextInTriangle(e);
    const int side = mesh_.orient(mesh_.from(exit), mesh_.to(exit), p);
    if (side >= 0) return {exit, side == 0};
    e = mesh_.twins[exit];
    if (e == kNone) return {};
  }
}

bool TrapezoidTriangulator::insertIslands(const LinkedPolygon& linked, const Visibility& seen,
                                          Work& work) {
  islands_.clear(), edges_.clear();
  for (const uint32_t v : seen.order)
    if (linked.kind[v] == VertexKind::Island) islands_.push_back(v);
  if (islands_.empty()) return true;
  sortForInsertion(mesh_.at, islands_);
  mesh_.findEdges();
  // Few flips are needed for each on average; a limit guards against inputs made to need many.
  uint32_t budget = uint32_t(kFlipsForIslands * islands_.size() + mesh_.corners.size());
  Locator locator;
  uint32_t near = kNone;
  for (const uint32_t v : islands_) {
    TriangleMesh::Place place;
    if (near != kNone) place = locator.walk(mesh_, mesh_.edgeFrom[near], mesh_.at[v], kLongestWalk);
    if (place.edge == kNone || (place.onEdge && mesh_.twins[place.edge] == kNone))
      place = followSight(mesh_.edgeFrom[linked.prev[seen.left[v]]], v);
    if (place.edge == kNone || (place.onEdge && mesh_.twins[place.edge] == kNone)) {
      SF_ASSERT(!"an island on a boundary");
      return false;
    }
    mesh_.insert(place, v, edges_);
    budget = legalize(mesh_, edges_, budget, work);
    if (!work.going()) return false;
    near = v;
  }
  return true;
}

/// Makes the triangles constrained Delaunay, if `delaunay`, and inserts the islands.
bool TrapezoidTriangulator::improve(const LinkedPolygon& linked, const Visibility& seen,
                                    bool delaunay, Work& work) {
  const uint32_t nodes = uint32_t(linked.at.size());
  Charge charge(work);
  if (!charge.add(8 * uint64_t(mesh_.corners.size()))) return false;
  mesh_.at = linked.at;
  int exponent;
  bool isExact;
  mesh_.metric = metricPoints(linked, scaled_, exponent, isExact);
  mesh_.unused.clear();
  mesh_.edgeFrom.clear();
  if (!findTwins(mesh_.corners, nodes, work, mesh_.twins)) return false;
  if (delaunay) {
    twins_.fromPlain(mesh_.twins);
    if (!delaunay_.run(linked, work, mesh_.corners, twins_)) return false;
    twins_.toPlain(mesh_.twins);
  }
  return work.going() && insertIslands(linked, seen, work);
}

bool TrapezoidTriangulator::triangulate(const LinkedPolygon& linked, const Visibility& seen,
                                        bool delaunay, bool forStrips, Work& work,
                                        std::vector<uint32_t>& triangles) {
  Charge charge(work);
  const uint64_t nodes = linked.at.size();
  if (!charge.add(nodes * (2 * 4 + 4 * 4 + 6 * 4))) return false;
  if (!findUniMonotonePolygons(linked, seen, false, work, polygons_)) return false;
  const std::vector<uint32_t>& starts = polygons_.starts;
  const ArrayView<const uint32_t> chain = polygons_.chain;

  // Each uni-monotone polygon of k vertices has k - 2 triangles, so 3 k indices are room enough.
  std::vector<uint32_t>& corners = mesh_.corners;
  corners.resize(3 * chain.size());
  uint32_t* out = corners.data();
  // From the bottom to the top, so that triangles near each other are near each other in the list.
  for (const uint32_t u : seen.order)
    for (const uint32_t e : {leftEdge(u), rightEdge(u)}) {
      const uint32_t size = starts[e + 1] - starts[e];
      if (size == 0) continue;
      out = tree_.triangulate(linked.at, chain.slice(starts[e], size), (e & 1) == 1, out);
      if (!work.tick(16 * size)) return false;
    }
  corners.resize(size_t(out - corners.data()));

  bool islands = false;
  for (const VertexKind kind : linked.kind) islands |= kind == VertexKind::Island;
  if ((delaunay || islands || forStrips) && !improve(linked, seen, delaunay, work)) return false;
  if (forStrips && !stripFlips_.run(mesh_, work)) return false;
  triangles.insert(triangles.end(), corners.begin(), corners.end());
  return work.going();
}

}  // namespace sf
