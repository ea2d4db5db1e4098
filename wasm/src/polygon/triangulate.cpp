#include "polygon/triangulate.h"

#include "base/charge.h"
#include "polygon/flood.h"
#include "polygon/strips.h"
#include "polygon/sweep.h"
#include "polygon/trapezoidation.h"

namespace sf {
namespace {

// Flips a triangle that improve angles after the u-trees: nearly all gain is made by then.
constexpr double kFlips = 1;

}  // namespace

struct PolygonTriangulator::State {
  PlaneSweep sweep;
  Flood flood;
  TrapezoidTriangulator trapezoids;
  LinkedPolygon loops;
  Visibility seen;

  Outcome flooding(const PolygonView& polygon, const PolygonOptions& options, Work& work,
                   std::vector<uint32_t>& triangles, std::vector<FloodStep>* trace);
  Outcome byTrapezoids(const PolygonView& polygon, bool strips, Work& work,
                       std::vector<uint32_t>& triangles);
};

PolygonTriangulator::PolygonTriangulator() : state_(new State) {}
PolygonTriangulator::~PolygonTriangulator() = default;

Outcome PolygonTriangulator::State::flooding(const PolygonView& polygon,
                                             const PolygonOptions& options, Work& work,
                                             std::vector<uint32_t>& triangles,
                                             std::vector<FloodStep>* trace) {
  Outcome outcome = sweep.run(polygon, true, work, loops, seen);
  if (!outcome.ok()) return outcome;
  const size_t before = triangles.size();
  if (!flood.run(loops, seen, work, triangles, trace)) {
    SF_ASSERT(!work.going());
    triangles.resize(before);
    outcome.status = work.going() ? Status::SelfIntersecting : work.status();
    return outcome;
  }
  triangles.insert(triangles.end(), loops.flat.begin(), loops.flat.end());
  (void)options;
  return outcome;
}

Outcome PolygonTriangulator::State::byTrapezoids(const PolygonView& polygon, bool strips,
                                                 Work& work, std::vector<uint32_t>& triangles) {
  Outcome outcome = sweep.run(polygon, false, work, loops, seen);
  if (!outcome.ok()) return outcome;
  const size_t before = triangles.size();
  if (!trapezoids.triangulate(loops, seen, kFlips, strips, work, triangles)) {
    triangles.resize(before);
    outcome.status = work.status();
    return outcome;
  }
  for (size_t i = before; i < triangles.size(); ++i) triangles[i] = loops.vertex[triangles[i]];
  triangles.insert(triangles.end(), loops.flat.begin(), loops.flat.end());
  return outcome;
}

Outcome PolygonTriangulator::triangulate(const PolygonView& polygon, const PolygonOptions& options,
                                         Work& work, PolygonTriangulation& result) {
  result = {};
  Outcome outcome = options.method == PolygonMethod::Trapezoids
                        ? state_->byTrapezoids(polygon, options.strips, work, result.triangles)
                        : state_->flooding(polygon, options, work, result.triangles,
                                           options.trace ? &result.trace : nullptr);
  if (!outcome.ok() || !options.strips) return outcome;
  const uint32_t vertices = uint32_t((polygon.positions.size() + polygon.points.size()) / 2);
  std::vector<uint32_t> twins;
  if (!findTwins(result.triangles, vertices, work, twins) ||
      !makeStrips(result.triangles, twins, work, result.strips, result.stripStarts))
    outcome.status = work.status();
  return outcome;
}

Outcome triangulatePolygon(const PolygonView& polygon, const PolygonOptions& options, Work& work,
                           PolygonTriangulation& result) {
  PolygonTriangulator triangulator;
  return triangulator.triangulate(polygon, options, work, result);
}

}  // namespace sf
