// See batch.h.
#include "polygon/batch.h"

#include <cmath>
#include <utility>

#include "base/charge.h"
#include "polygon/input/fault_point.h"
#include "polygon/input/plane.h"

namespace sf {
namespace {

/// One call, polygon by polygon.
class Call {
 public:
  Call(const FlatPolygons& polygons, const PolygonOptions& options,
       PolygonTriangulator& triangulator, Work& work, FlatTriangulation& result)
      : dimension_(polygons.dimension),
        options_(options),
        positions_(polygons.positions),
        ringStarts_(polygons.ringStarts),
        polygonStarts_(polygons.polygonStarts),
        points_(polygons.points),
        triangulator_(triangulator),
        work_(work),
        charge_(work),
        all_(result) {}

  Outcome run() {
    const size_t count = polygonStarts_.size() - 1;
    const uint64_t coordinates = uint64_t(positions_.size()) + points_.size();
    if (dimension_ == 3 && !charge_.add(sizeof(double) * coordinates)) return {work_.status()};
    const bool plain = !options_.strips && !options_.trace && options_.repair == Repair::None;
    return count != 1 && plain && dimension_ == 2 ? runBatch() : runEach();
  }

 private:
  Outcome runBatch();
  Outcome runEach();
  Outcome triangulate(uint32_t polygon, PolygonView view);
  Outcome triangulateInSpace(uint32_t polygon, PolygonView view);
  void take(uint32_t polygon, const PolygonView& view);
  void blame(uint32_t polygon, const Outcome& outcome, const PolygonView& view);
  void append(double x, double y, std::vector<double>& to) const;
  uint32_t firstVertex(uint32_t polygon) const { return ringStarts_[polygonStarts_[polygon]]; }
  PolygonView viewOf(uint32_t polygon);

  const uint32_t dimension_;
  const PolygonOptions options_;
  const ArrayView<const double> positions_;
  const ArrayView<const uint32_t> ringStarts_, polygonStarts_;
  const ArrayView<const double> points_;
  PolygonTriangulator& triangulator_;
  Work& work_;
  Charge charge_;

  Plane plane_{};                          // of the current polygon, in space
  std::vector<double> flat_, flatPoints_;  // its vertices and points in the plane
  std::vector<uint32_t> starts_;           // its rings
  PolygonTriangulation found_;             // its triangulation
  FlatTriangulation& all_;
};

bool isFault(Status status) {
  return status != Status::Ok && status != Status::OutOfMemory && status != Status::TooLarge &&
         status != Status::Stopped;
}

PolygonView Call::viewOf(uint32_t polygon) {
  const uint32_t firstRing = polygonStarts_[polygon];
  const uint32_t rings = polygonStarts_[polygon + 1] - firstRing;
  const uint32_t first = ringStarts_[firstRing];
  starts_.resize(rings + 1);
  for (uint32_t r = 0; r <= rings; ++r) starts_[r] = ringStarts_[firstRing + r] - first;
  return {positions_.slice(dimension_ * size_t(first), dimension_ * size_t(starts_[rings])),
          starts_, points_};
}

Outcome Call::runBatch() {
  const PolygonBatch batch{positions_, ringStarts_, polygonStarts_};
  PolygonBatchResult found;
  const Outcome outcome = triangulator_.triangulateBatch(batch, options_, work_, found);
  if (!outcome.ok()) return outcome;
  all_.triangles = std::move(found.triangles);
  all_.triangleStarts = std::move(found.triangleStarts);
  all_.stripStarts.assign(1, 0);
  all_.polygonStrips.assign(polygonStarts_.size(), 0);
  for (const PolygonFault& fault : found.faults)
    blame(fault.polygon, fault.outcome, viewOf(fault.polygon));
  return {};
}

Outcome Call::runEach() {
  const uint32_t count = uint32_t(polygonStarts_.size()) - 1;
  all_.triangleStarts.assign(1, 0);
  all_.stripStarts.assign(1, 0);
  all_.polygonStrips.assign(1, 0);
  for (uint32_t p = 0; p < count; ++p) {
    // A polygon without rings is empty; GeoJSON has such.
    if (polygonStarts_[p] < polygonStarts_[p + 1]) {
      const PolygonView view = viewOf(p);
      const Outcome outcome = dimension_ == 3 ? triangulateInSpace(p, view) : triangulate(p, view);
      if (!outcome.ok() && !isFault(outcome.status)) return outcome;
    }
    all_.triangleStarts.push_back(uint32_t(all_.triangles.size() / 3));
    all_.polygonStrips.push_back(uint32_t(all_.stripStarts.size()) - 1);
  }
  return {};
}

Outcome Call::triangulate(uint32_t polygon, PolygonView view) {
  const Outcome outcome = triangulator_.triangulate(view, options_, work_, found_);
  if (outcome.ok()) take(polygon, view);
  if (isFault(outcome.status)) blame(polygon, outcome, view);
  return outcome;
}

/// If lengths matter, this first takes coordinates along axes in the polygon's plane. They are rounded, so
/// a fault found with them is not trusted. The polygon is then triangulated or repaired with two of its own
/// coordinates, which are not rounded.
Outcome Call::triangulateInSpace(uint32_t polygon, PolygonView view) {
  plane_ = planeOf(view.positions.slice(0, 3 * size_t(view.starts[1])));
  PolygonView flat{{}, view.starts, {}};
  const auto project = [&](bool isometric) {
    flatten(plane_, isometric, view.positions, flat_);
    flatten(plane_, isometric, view.points, flatPoints_);
    flat.positions = flat_, flat.points = flatPoints_;
  };
  const bool lengthsMatter = options_.delaunay || options_.method == PolygonMethod::Trapezoids;
  if (lengthsMatter && !plane_.isAcrossAxis()) {
    project(true);
    PolygonOptions options = options_;
    options.repair = Repair::None;
    const Outcome outcome = triangulator_.triangulate(flat, options, work_, found_);
    if (outcome.ok()) take(polygon, flat);
    if (!isFault(outcome.status)) return outcome;
  }
  project(false);
  // The triangulator does not see the coordinate that is left out, so it is checked here.
  for (uint32_t r = 0; r + 1 < view.starts.size(); ++r)
    for (uint32_t v = view.starts[r]; v < view.starts[r + 1]; ++v)
      if (!(std::fabs(view.positions[3 * size_t(v) + plane_.dropped]) <= kLargestCoordinate)) {
        const Outcome outcome{Status::NotFinite, r, v - view.starts[r]};
        blame(polygon, outcome, flat);
        return outcome;
      }
  return triangulate(polygon, flat);
}

/// Appends the triangulation of a polygon, with vertices numbered as in the whole input.
void Call::take(uint32_t polygon, const PolygonView& view) {
  const uint32_t base = firstVertex(polygon);
  const uint32_t own = uint32_t(view.positions.size() / 2);
  const uint32_t others = ringStarts_[ringStarts_.size() - 1];
  const uint32_t shift = others - own + uint32_t(all_.added.size() / dimension_);
  const auto name = [&](uint32_t v) { return v < own ? base + v : v + shift; };
  if (base == 0 && others == own && all_.triangles.empty()) {
    all_.triangles = std::move(found_.triangles);
  } else {
    for (const uint32_t v : found_.triangles) all_.triangles.push_back(name(v));
  }
  const uint32_t stripped = uint32_t(all_.strips.size());
  for (const uint32_t v : found_.strips) all_.strips.push_back(name(v));
  for (size_t s = 1; s < found_.stripStarts.size(); ++s)
    all_.stripStarts.push_back(stripped + found_.stripStarts[s]);
  for (const uint32_t edge : found_.addedOn) all_.addedOn.push_back(base + edge);
  for (size_t i = 0; i + 1 < found_.added.size(); i += 2)
    append(found_.added[i], found_.added[i + 1], all_.added);
  if (options_.trace) all_.trace = std::move(found_.trace);
}

void Call::blame(uint32_t polygon, const Outcome& outcome, const PolygonView& view) {
  all_.faults.push_back({polygon, outcome});
  const Point2 place = faultPoint(view, outcome);
  append(place.x, place.y, all_.faultPoints);
}

void Call::append(double x, double y, std::vector<double>& to) const {
  if (dimension_ == 2) {
    to.insert(to.end(), {x, y});
  } else {
    const Vec3 p = plane_.lift(x, y);
    to.insert(to.end(), {p.x, p.y, p.z});
  }
}

}  // namespace

Outcome triangulateAll(const FlatPolygons& polygons, const PolygonOptions& options,
                       PolygonTriangulator& triangulator, Work& work, FlatTriangulation& result) {
  return Call(polygons, options, triangulator, work, result).run();
}

}  // namespace sf
