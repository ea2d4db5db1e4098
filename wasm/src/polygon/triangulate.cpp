#include "polygon/triangulate.h"

#include "base/charge.h"
#include "polygon/fill/certificate.h"
#include "polygon/fill/constrained_delaunay.h"
#include "polygon/fill/flood.h"
#include "polygon/fill/trapezoidation.h"
#include "polygon/repair/repair.h"
#include "polygon/strips/strips.h"
#include "polygon/sweep/complement.h"
#include "polygon/sweep/link_rings.h"
#include "polygon/sweep/sweep.h"

namespace sf {
namespace {

bool isFault(Status status) {
  switch (status) {
    case Status::SelfIntersecting:
    case Status::HoleOutside:
    case Status::HolesOverlap:
    case Status::NestedHole:
    case Status::DegeneratePolygon:
      return true;
    default:
      return false;
  }
}

}  // namespace

struct PolygonTriangulator::State {
  PlaneSweep sweep;
  Flood flood;
  TrapezoidTriangulator trapezoids;
  ConstrainedDelaunay delaunay;
  LinkedPolygon loops, outerLoops;
  Visibility seen, outside;
  Certificate certificate;
  std::vector<uint32_t> starts;
  std::vector<uint32_t> corners;     // by trapezoids
  std::vector<uint32_t> plainTwins;  // of these
  ClosableTwins twins;
  // The triangles of the current polygon, but for flat ones, and their twins where these are known.
  ArrayView<uint32_t> found;
  ClosableTwins* foundTwins = nullptr;

  Outcome append(const PolygonView& polygon, const PolygonOptions& options, uint32_t first,
                 Work& work, std::vector<uint32_t>& triangles, std::vector<FloodStep>* trace);
  bool triangulateLoops(const PolygonOptions& options, Work& work, Charge& charge,
                        std::vector<FloodStep>* trace);
  Outcome appendRepaired(const PolygonView& polygon, const PolygonOptions& options, Work& work,
                         PolygonTriangulation& result);
  bool isCertain(const PolygonView& polygon, bool sagsOnly, Work& work);
};

PolygonTriangulator::PolygonTriangulator() : state_(new State) {}
PolygonTriangulator::~PolygonTriangulator() = default;

/// Finds the triangles of the linked loops, as nodes.
bool PolygonTriangulator::State::triangulateLoops(const PolygonOptions& options, Work& work,
                                                  Charge& charge, std::vector<FloodStep>* trace) {
  if (options.method == PolygonMethod::Flooding) {
    if (!flood.run(loops, seen, work, charge, trace, options.delaunay || options.verify))
      return false;
    found = flood.triangles(), foundTwins = &flood.twins();
    return !options.delaunay || delaunay.runFlooded(loops, work, flood);
  }
  // The triangles, and their twins in two forms.
  if (!charge.add(3 * sizeof(uint32_t) * uint64_t(loops.at.size()) * (options.delaunay ? 4 : 2)))
    return false;
  const bool forStrips = options.strips && !options.delaunay;
  corners.clear();
  if (!trapezoids.triangulate(loops, seen, true, forStrips, work, corners)) return false;
  found = corners, foundTwins = nullptr;
  if (!options.delaunay) return true;
  if (!findTwins(corners, uint32_t(loops.at.size()), work, plainTwins)) return false;
  twins.fromPlain(plainTwins);
  foundTwins = &twins;
  return delaunay.run(loops, work, found, twins);
}

/// Appends the triangles of one polygon, as its vertices, numbered from `first` on.
Outcome PolygonTriangulator::State::append(const PolygonView& polygon,
                                           const PolygonOptions& options, uint32_t first,
                                           Work& work, std::vector<uint32_t>& triangles,
                                           std::vector<FloodStep>* trace) {
  Charge charge(work);
  const uint64_t n = (uint64_t(polygon.positions.size()) + polygon.points.size()) / 2;
  Outcome outcome;
  if (!charge.add(n * (sizeof(Point2) + 10 * sizeof(uint32_t)))) {
    outcome.status = work.status();
    return outcome;
  }
  const bool sagsOnly = options.method == PolygonMethod::Flooding;
  // Trapezoids lie along x, and a trace is about heights along y.
  outcome = sweep.run(polygon, sagsOnly, sagsOnly && !trace, work, loops, seen);
  if (!outcome.ok()) return outcome;
  bool done = triangulateLoops(options, work, charge, trace);
  if (done && loops.at.size() > n) {
    for (uint32_t& v : found) v = loops.vertex[v];
    if (trace)
      for (FloodStep& step : *trace)
        step.left = loops.vertex[step.left], step.right = loops.vertex[step.right];
  }
  if (done && options.verify) done = isCertain(polygon, sagsOnly, work);
  if (!done) {
    SF_ASSERT(!work.going());
    outcome.status = work.going() ? Status::SelfIntersecting : work.status();
    return outcome;
  }
  if (first > 0) {
    for (uint32_t& v : found) v += first;
    for (uint32_t& v : loops.flat) v += first;
  }
  triangles.insert(triangles.end(), found.begin(), found.end());
  triangles.insert(triangles.end(), loops.flat.begin(), loops.flat.end());
  return outcome;
}

/// Whether the triangles and those of the complement prove each other right.
bool PolygonTriangulator::State::isCertain(const PolygonView& polygon, bool sagsOnly, Work& work) {
  Charge charge(work);
  const uint32_t n = uint32_t(polygon.positions.size() / 2);
  const uint32_t p = uint32_t(polygon.points.size() / 2);
  if (!charge.add((uint64_t(n) + p) * 120)) return false;
  Certificate& c = certificate;
  c.at.resize(size_t(n) + p + 4);
  Point2* at = c.at.data();
  for (const ArrayView<const double> xy : {polygon.positions, polygon.points})
    for (size_t i = 0; i < xy.size(); i += 2) *at++ = {xy[i], xy[i + 1]};
  frameAround(polygon, c.at.data() + n + p);
  if (sagsOnly)
    flood.handOver(c.inside);  // it is about to begin anew
  else
    c.inside.assign(found.begin(), found.end());
  c.inside.insert(c.inside.end(), loops.flat.begin(), loops.flat.end());
  found = {c.inside.data(), found.size()};
  const auto takeTwins = [](ClosableTwins& twins, Buffer<uint32_t>& to) {
    twins.open();
    to.swap(twins.of);
  };
  c.insidePaired = foundTwins ? found.size() : 0;
  if (foundTwins) takeTwins(*foundTwins, c.insideTwins);
  const bool plain = sweep.isPlain();
  c.same.clear();
  if (!plain) {
    sweep.findEqual(c.same);
    for (uint32_t k = 0; k < 4; ++k) c.same.push_back(n + p + k);
  }
  c.rings.resize(2 * size_t(n));
  for (uint32_t r = 0; r + 1 < polygon.starts.size(); ++r) {
    const uint32_t first = polygon.starts[r], last = polygon.starts[r + 1] - 1;
    const uint32_t turned = sweep.reversed()[r];
    for (uint32_t v = first; v <= last; ++v)
      c.rings[2 * v + turned] = v, c.rings[2 * v + 1 - turned] = v + 1;
    c.rings[2 * last + 1 - turned] = first;
  }
  if (plain && sagsOnly) {
    takeComplement(loops, seen, outerLoops, outside);
  } else if (!sweep.runComplement(polygon, work, outerLoops, outside).ok()) {
    return false;
  }
  if (!flood.run(outerLoops, outside, work, charge, nullptr, true)) return false;
  flood.handOver(c.complement);
  c.complementPaired = c.complement.size();
  takeTwins(flood.twins(), c.complementTwins);
  if (!plain || !sagsOnly) {
    c.complement.insert(c.complement.end(), outerLoops.flat.begin(), outerLoops.flat.end());
    // There, the frame's corners follow the vertices.
    for (uint32_t& v : c.complement) v = outerLoops.vertex[v];
    for (uint32_t& v : c.complement) v += v < n ? 0 : p;
  }
  return certify(c, work);
}

/// Triangulates what repair makes of the polygon.
Outcome PolygonTriangulator::State::appendRepaired(const PolygonView& polygon,
                                                   const PolygonOptions& options, Work& work,
                                                   PolygonTriangulation& result) {
  RepairedPolygons repaired;
  Outcome outcome = repairPolygon(polygon, options.repair, work, repaired);
  if (!outcome.ok()) return outcome;
  const uint32_t n = uint32_t(polygon.positions.size() / 2);
  std::vector<double> positions;
  for (size_t p = 0; p + 1 < repaired.polygonStarts.size(); ++p) {
    const uint32_t firstRing = repaired.polygonStarts[p], endRing = repaired.polygonStarts[p + 1];
    const uint32_t first = repaired.ringStarts[firstRing];
    positions.clear(), starts.clear();
    for (uint32_t r = firstRing; r <= endRing; ++r)
      starts.push_back(repaired.ringStarts[r] - first);
    for (uint32_t i = first; i < repaired.ringStarts[endRing]; ++i) {
      const uint32_t v = repaired.vertices[i];
      const double* xy =
          v < n ? polygon.positions.data() + 2 * size_t(v) : &repaired.added[2 * size_t(v - n)];
      positions.insert(positions.end(), xy, xy + 2);
    }
    const size_t before = result.triangles.size();
    outcome = append({positions, starts, {}}, options, 0, work, result.triangles, nullptr);
    if (!outcome.ok()) return outcome;
    for (size_t i = before; i < result.triangles.size(); ++i)
      result.triangles[i] = repaired.vertices[first + result.triangles[i]];
  }
  result.added.swap(repaired.added), result.addedOn.swap(repaired.addedOn);
  return outcome;
}

Outcome PolygonTriangulator::triangulate(const PolygonView& polygon, const PolygonOptions& options,
                                         Work& work, PolygonTriangulation& result) {
  result = {};
  Outcome outcome = state_->append(polygon, options, 0, work, result.triangles,
                                   options.trace ? &result.trace : nullptr);
  if (isFault(outcome.status) && options.repair != Repair::None)
    outcome = state_->appendRepaired(polygon, options, work, result);
  if (!outcome.ok() || !options.strips) return outcome;
  const uint32_t vertices =
      uint32_t((polygon.positions.size() + polygon.points.size() + result.added.size()) / 2);
  std::vector<uint32_t> twins;
  if (!findTwins(result.triangles, vertices, work, twins) ||
      !makeStrips(result.triangles, twins, work, result.strips, result.stripStarts))
    outcome.status = work.status();
  return outcome;
}

Outcome PolygonTriangulator::floodDelaunay(const PolygonView& polygon, Work& work,
                                           std::vector<uint32_t>& triangles) {
  State& s = *state_;
  Charge charge(work);
  triangles.clear();
  Outcome outcome = s.sweep.run(polygon, true, true, work, s.loops, s.seen);
  if (!outcome.ok()) return outcome;
  if (!s.flood.run(s.loops, s.seen, work, charge, nullptr, true) ||
      !s.delaunay.runFlooded(s.loops, work, s.flood)) {
    outcome.status = work.going() ? Status::SelfIntersecting : work.status();
    return outcome;
  }
  const ArrayView<uint32_t> found = s.flood.triangles();
  triangles.reserve(found.size() + s.loops.flat.size());
  for (const uint32_t v : found) triangles.push_back(s.loops.vertex[v]);
  triangles.insert(triangles.end(), s.loops.flat.begin(), s.loops.flat.end());
  return outcome;
}

Outcome PolygonTriangulator::triangulateBatch(const PolygonBatch& batch,
                                              const PolygonOptions& options, Work& work,
                                              PolygonBatchResult& result) {
  result = {};
  Outcome outcome;
  outcome.status = Status::BadStarts;
  const ArrayView<const uint32_t> rings = batch.ringStarts, polygons = batch.polygonStarts;
  const size_t vertices = batch.positions.size() / 2;
  if (rings.empty() || polygons.empty() || polygons[0] != 0 || rings[0] != 0) return outcome;
  if (polygons[polygons.size() - 1] != rings.size() - 1) return outcome;
  if (rings[rings.size() - 1] != vertices) return outcome;
  for (size_t p = 0; p + 1 < polygons.size(); ++p)
    if (polygons[p] > polygons[p + 1]) return outcome;
  for (size_t r = 0; r + 1 < rings.size(); ++r)
    if (rings[r] > rings[r + 1]) return outcome;
  outcome.status = Status::Ok;
  Charge charge(work);
  if (!charge.add(14 * uint64_t(vertices))) {
    outcome.status = work.status();
    return outcome;
  }
  result.triangles.reserve(3 * vertices);
  result.triangleStarts.push_back(0);
  PolygonOptions each = options;
  each.strips = each.trace = false, each.repair = Repair::None;
  std::vector<uint32_t>& starts = state_->starts;
  for (uint32_t p = 0; p + 1 < polygons.size(); ++p) {
    const uint32_t first = rings[polygons[p]], end = rings[polygons[p + 1]];
    starts.clear();
    for (uint32_t r = polygons[p]; r <= polygons[p + 1]; ++r) starts.push_back(rings[r] - first);
    const PolygonView view{
        batch.positions.slice(2 * size_t(first), 2 * size_t(end - first)), starts, {}};
    if (starts.size() > 1)
      outcome = state_->append(view, each, first, work, result.triangles, nullptr);
    if (!work.going()) return outcome;
    if (!outcome.ok()) result.faults.push_back({p, outcome});
    outcome = {};
    result.triangleStarts.push_back(uint32_t(result.triangles.size() / 3));
  }
  return outcome;
}

Outcome triangulatePolygon(const PolygonView& polygon, const PolygonOptions& options, Work& work,
                           PolygonTriangulation& result) {
  PolygonTriangulator triangulator;
  return triangulator.triangulate(polygon, options, work, result);
}

}  // namespace sf
