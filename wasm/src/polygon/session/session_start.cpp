// How a session begins, and begins anew.
#include <algorithm>
#include <cmath>

#include "base/charge.h"
#include "polygon/fill/constrained_delaunay.h"
#include "polygon/fill/flood.h"
#include "polygon/session/session.h"
#include "polygon/sweep/complement.h"
#include "polygon/sweep/sweep.h"

namespace sf {
namespace {

/// Half the side of a box far around points with coordinates up to `largest`.
double sideOfBox(double largest, int& exponent) {
  exponent = 0;
  if (largest > 0) std::frexp(largest, &exponent);
  return std::ldexp(4, exponent);
}

/// Makes the frame of a complement, its last four nodes, as large as the box.
void widenFrame(LinkedPolygon& complement) {
  Point2* corners = complement.at.data() + complement.at.size() - 4;
  int exponent;
  const double side = sideOfBox(std::fabs(corners[2].x) / 2, exponent);
  for (uint32_t k = 0; k < 4; ++k)
    corners[k] = {std::copysign(side, corners[k].x), std::copysign(side, corners[k].y)};
  complement.least = {-side, -side}, complement.greatest = {side, side};
}

}  // namespace

/// Numbers and links the vertices; the mesh has no triangles yet.
Outcome PolygonSession::readRings(const PolygonView& polygon) {
  const uint32_t n = uint32_t(polygon.positions.size() / 2);
  const uint32_t islands = uint32_t(polygon.points.size() / 2);
  const ArrayView<const uint32_t> starts = polygon.starts;
  Outcome outcome;
  outcome.status = Status::BadStarts;
  if (starts.size() < 2 || starts[0] != 0 || starts[starts.size() - 1] != n) return outcome;
  for (size_t r = 0; r + 1 < starts.size(); ++r)
    if (starts[r + 1] < starts[r]) return outcome;

  const uint32_t rings = uint32_t(starts.size()) - 1;
  mesh_.at.assign(kShift, {0, 0});
  ring_.assign(kShift, kNone);
  for (uint32_t v = 0; v < n; ++v)
    mesh_.at.push_back({polygon.positions[2 * v], polygon.positions[2 * v + 1]});
  for (uint32_t i = 0; i < islands; ++i)
    mesh_.at.push_back({polygon.points[2 * i], polygon.points[2 * i + 1]});
  mesh_.next.assign(mesh_.at.size(), kNone), mesh_.prev.assign(mesh_.at.size(), kNone);
  ring_.resize(kShift + n, kNone);
  ring_.resize(mesh_.at.size(), kIsland);
  for (uint32_t r = 0; r < rings; ++r) {
    const uint32_t first = kShift + starts[r];
    uint32_t end = kShift + starts[r + 1];
    for (uint32_t v = first; v < end; ++v)
      if (!isAccepted(mesh_.at[v])) return {Status::NotFinite, r, v - first};
    if (end - first > 1 && mesh_.at[first] == mesh_.at[end - 1]) unused_.push_back(--end);
    if (end - first < 3) return {Status::DegeneratePolygon, r};
    for (uint32_t v = first; v < end; ++v) {
      ring_[v] = r;
      link(v, v + 1 < end ? v + 1 : first);
    }
    ringSizes_.push_back(end - first);
  }
  for (uint32_t i = 0; i < islands; ++i)
    if (!isAccepted(mesh_.at[kShift + n + i])) return {Status::NotFinite, rings + i, 0};
  return {};
}

Outcome PolygonSession::start(const PolygonView& polygon, Work& work) {
  clear();
  Charge charge(work);
  const uint64_t vertices = (polygon.positions.size() + polygon.points.size()) / 2;
  Outcome outcome;
  if (!charge.add(300 * vertices)) {
    outcome.status = work.status();
    return outcome;
  }
  outcome = readRings(polygon);
  if (outcome.ok()) {
    outcome = build(work);
    // From the session's numbers to vertices of rings.
    const uint32_t n = uint32_t(polygon.positions.size() / 2);
    const uint32_t rings = uint32_t(polygon.starts.size()) - 1;
    const auto inRing = [&](uint32_t& loop, uint32_t& vertex) {
      if (vertex == kNone) return;
      const bool island = vertex >= n;
      loop = island ? rings + vertex - n : ring_[kShift + vertex];
      vertex = island ? 0 : vertex - polygon.starts[loop];
    };
    inRing(outcome.loop, outcome.vertex);
    inRing(outcome.otherLoop, outcome.otherVertex);
  }
  if (!outcome.ok()) clear();
  return outcome;
}

/// Fills the box with triangles of the polygon and of what is around it, each by flooding, and
/// makes them Delaunay. False if the polygon is not valid, if rings touch, or if too many flips
/// would be needed; what is wrong is not found out here.
bool PolygonSession::flood(ArrayView<const uint32_t> ringNext, Work& work) {
  // Rings one after the other again, whatever numbers edits have given to their vertices.
  std::vector<uint32_t> numbers, starts = {0}, corners;
  std::vector<double> xy[2];
  std::vector<uint32_t> firsts(ringSizes_.size(), kNone), islands;
  for (uint32_t v = uint32_t(ring_.size()); v-- > kShift;) {
    if (ring_[v] == kIsland)
      islands.push_back(v);
    else if (ring_[v] != kNone)
      firsts[ring_[v]] = v;
  }
  const auto add = [&](uint32_t v, bool island) {
    numbers.push_back(v);
    xy[island].push_back(mesh_.at[v].x), xy[island].push_back(mesh_.at[v].y);
  };
  for (const uint32_t first : firsts) {
    uint32_t v = first;
    do add(v, false);
    while ((v = ringNext[v]) != first);
    starts.push_back(uint32_t(numbers.size()));
  }
  for (const uint32_t v : islands) add(v, true);

  PlaneSweep sweep;
  Flood flood;
  ConstrainedDelaunay delaunay;
  LinkedPolygon inside, outside;
  Visibility seen, seenOutside;
  Charge charge(work);
  if (!sweep.run({xy[0], starts, xy[1]}, true, false, work, inside, seen).ok()) return false;
  if (!sweep.isPlain() || !flood.run(inside, seen, work, charge, nullptr, true)) return false;
  if (!delaunay.runFlooded(inside, work, flood)) return false;
  for (const uint32_t v : flood.triangles()) corners.push_back(numbers[v]);
  takeComplement(inside, seen, outside, seenOutside);
  widenFrame(outside);
  if (!flood.run(outside, seenOutside, work, charge, nullptr, true)) return false;
  if (!delaunay.runFlooded(outside, work, flood)) return false;
  const uint32_t count = uint32_t(numbers.size());
  for (const uint32_t v : flood.triangles()) corners.push_back(v < count ? numbers[v] : v - count);
  return mesh_.adopt(corners, ringNext, work);
}

/// Triangulates the polygon of the rings' links and the islands anew.
Outcome PolygonSession::build(Work& work) {
  std::vector<uint32_t> vertices, edges = mesh_.next;
  double largest = 0;
  for (uint32_t v = kShift; v < mesh_.at.size(); ++v) {
    if (ring_[v] == kNone) continue;
    vertices.push_back(v);
    largest = std::max({largest, std::fabs(mesh_.at[v].x), std::fabs(mesh_.at[v].y)});
  }
  int exponent;
  side_ = sideOfBox(largest, exponent);
  const auto empty = [&] {
    mesh_.reset(side_, exponent, mesh_.at.size() - kShift);
    mesh_.next.assign(mesh_.at.size(), kNone), mesh_.prev.assign(mesh_.at.size(), kNone);
  };
  empty();
  for (const uint32_t v : vertices) mesh_.setPosition(v, mesh_.at[v]);

  if (!flood(edges, work)) {
    if (!work.going()) return Outcome{work.status()};
    Obstacle obstacle;
    uint32_t refused;
    empty();
    if (!mesh_.insertAll(vertices, edges, work, refused, obstacle))
      return work.going() ? refusal(refused, obstacle) : Outcome{work.status()};
  }
  near_ = vertices[0];
  const Outcome outcome = findInsideAnew();
  if (!outcome.ok()) return outcome;

  for (uint32_t t = 0; t < mesh_.mesh.triangleCount(); ++t) mesh_.touch(t);
  slots_.assign(mesh_.mesh.triangleCount(), kNone);
  triangleIn_.clear(), triangles_.clear();
  updateSlots();
  std::vector<uint32_t> twins = mesh_.mesh.twins;
  for (uint32_t h = 0; h < twins.size(); ++h)
    if (twins[h] != kNone && (inside_[h / 3] == 0 || mesh_.isFixed(h))) twins[h] = kNone;
  linkStrips(twins, work, mesh_.links);
  mesh_.forgetChanges();
  return Outcome{work.status()};
}

}  // namespace sf
