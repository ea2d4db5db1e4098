#include "polygon/triangulate.h"

#include "base/charge.h"
#include "polygon/flood.h"
#include "polygon/sweep.h"

namespace sf {

struct PolygonTriangulator::State {
  PlaneSweep sweep;
  Flood flood;
  LinkedPolygon loops;
  Visibility seen;

  Outcome flooding(const PolygonView& polygon, const PolygonOptions& options, Work& work,
                   std::vector<uint32_t>& triangles, std::vector<FloodStep>* trace);
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

Outcome PolygonTriangulator::triangulate(const PolygonView& polygon, const PolygonOptions& options,
                                         Work& work, PolygonTriangulation& result) {
  result = {};
  return state_->flooding(polygon, options, work, result.triangles,
                          options.trace ? &result.trace : nullptr);
}

Outcome triangulatePolygon(const PolygonView& polygon, const PolygonOptions& options, Work& work,
                           PolygonTriangulation& result) {
  PolygonTriangulator triangulator;
  return triangulator.triangulate(polygon, options, work, result);
}

}  // namespace sf
