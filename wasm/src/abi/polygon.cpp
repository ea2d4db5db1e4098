// sf_triangulate_polygons: polygons one by one or all at once, in the plane or flattened into it.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>

#include "abi/host_work.h"
#include "abi/result.h"
#include "base/charge.h"
#include "polygon/input/fault_point.h"
#include "polygon/input/plane.h"
#include "polygon/triangulate.h"

namespace {

/// A triangulator that has held no more than this many vertices is kept for the next call.
constexpr uint32_t kMostKept = 1u << 16;

/// Bytes a vertex that the triangulation of a large polygon takes, at least.
constexpr size_t kLeastPerVertex = 160;

struct Settings {
  uint32_t dimension;
  sf::PolygonOptions options;
};

/// Everything of one call, polygon by polygon.
class Call {
 public:
  Call(const Settings& settings, sf::ArrayView<const double> positions,
       sf::ArrayView<const uint32_t> ringStarts, sf::ArrayView<const uint32_t> polygonStarts,
       sf::ArrayView<const double> points, sf::PolygonTriangulator& triangulator, sf::Work& work)
      : dimension_(settings.dimension),
        options_(settings.options),
        positions_(positions),
        ringStarts_(ringStarts),
        polygonStarts_(polygonStarts),
        points_(points),
        triangulator_(triangulator),
        work_(work),
        charge_(work) {}

  /// Fails as a whole only for reasons that no polygon is to blame for.
  sf::Outcome run() {
    const size_t count = polygonStarts_.size() - 1;
    if (dimension_ == 3 && !charge_.add(8 * (positions_.size() + points_.size())))
      return {work_.status()};
    const bool plain = !options_.strips && !options_.trace && options_.repair == sf::Repair::None;
    return count != 1 && plain && dimension_ == 2 ? runBatch() : runEach();
  }
  SfResult* pack();

 private:
  sf::Outcome runBatch();
  sf::Outcome runEach();
  sf::Outcome triangulate(uint32_t polygon, sf::PolygonView view);
  sf::Outcome triangulateInSpace(uint32_t polygon, sf::PolygonView view);
  void take(uint32_t polygon, const sf::PolygonView& view);
  void blame(uint32_t polygon, const sf::Outcome& outcome, const sf::PolygonView& view);
  void append(double x, double y, std::vector<double>& to) const;
  uint32_t firstVertex(uint32_t polygon) const { return ringStarts_[polygonStarts_[polygon]]; }
  sf::PolygonView viewOf(uint32_t polygon);

  const uint32_t dimension_;
  const sf::PolygonOptions options_;
  const sf::ArrayView<const double> positions_;
  const sf::ArrayView<const uint32_t> ringStarts_, polygonStarts_;
  const sf::ArrayView<const double> points_;
  sf::PolygonTriangulator& triangulator_;
  sf::Work& work_;
  sf::Charge charge_;

  sf::Plane plane_{};                      // of the current polygon, in space
  std::vector<double> flat_, flatPoints_;  // its vertices and points in the plane
  std::vector<uint32_t> starts_;           // its rings
  sf::PolygonTriangulation found_;         // its triangulation
  sf::PolygonBatchResult all_;             // `faults` stays empty
  std::vector<uint32_t> strips_, stripStarts_{0}, stripGroups_{0};
  std::vector<double> added_;
  std::vector<uint32_t> addedOn_, faults_;
  std::vector<double> faultPoints_;
};

bool isFault(sf::Status status) {
  return status != sf::Status::Ok && status != sf::Status::OutOfMemory &&
         status != sf::Status::TooLarge && status != sf::Status::Stopped;
}

sf::PolygonView Call::viewOf(uint32_t polygon) {
  const uint32_t firstRing = polygonStarts_[polygon];
  const uint32_t rings = polygonStarts_[polygon + 1] - firstRing;
  const uint32_t first = ringStarts_[firstRing];
  starts_.resize(rings + 1);
  for (uint32_t r = 0; r <= rings; ++r) starts_[r] = ringStarts_[firstRing + r] - first;
  return {positions_.slice(dimension_ * size_t(first), dimension_ * size_t(starts_[rings])),
          starts_, points_};
}

sf::Outcome Call::runBatch() {
  const sf::PolygonBatch batch{positions_, ringStarts_, polygonStarts_};
  const sf::Outcome outcome = triangulator_.triangulateBatch(batch, options_, work_, all_);
  if (!outcome.ok()) return outcome;
  stripGroups_.assign(polygonStarts_.size(), 0);
  for (const sf::PolygonFault& fault : all_.faults)
    blame(fault.polygon, fault.outcome, viewOf(fault.polygon));
  return {};
}

sf::Outcome Call::runEach() {
  const uint32_t count = uint32_t(polygonStarts_.size()) - 1;
  all_.triangleStarts.assign(1, 0);
  for (uint32_t p = 0; p < count; ++p) {
    // A polygon without rings, such as GeoJSON has, is empty.
    if (polygonStarts_[p] < polygonStarts_[p + 1]) {
      const sf::PolygonView view = viewOf(p);
      const sf::Outcome outcome =
          dimension_ == 3 ? triangulateInSpace(p, view) : triangulate(p, view);
      if (!outcome.ok() && !isFault(outcome.status)) return outcome;
    }
    all_.triangleStarts.push_back(uint32_t(all_.triangles.size() / 3));
    stripGroups_.push_back(uint32_t(stripStarts_.size()) - 1);
  }
  return {};
}

sf::Outcome Call::triangulate(uint32_t polygon, sf::PolygonView view) {
  const sf::Outcome outcome = triangulator_.triangulate(view, options_, work_, found_);
  if (outcome.ok()) take(polygon, view);
  if (isFault(outcome.status)) blame(polygon, outcome, view);
  return outcome;
}

/// Where lengths matter, first with coordinates along axes in the plane; these are rounded, so that what
/// is found wrong there, or is to be repaired, is judged by coordinates that are not.
sf::Outcome Call::triangulateInSpace(uint32_t polygon, sf::PolygonView view) {
  plane_ = sf::planeOf(view.positions.slice(0, 3 * size_t(view.starts[1])));
  sf::PolygonView flat{{}, view.starts, {}};
  const auto project = [&](bool isometric) {
    sf::flatten(plane_, isometric, view.positions, flat_);
    sf::flatten(plane_, isometric, view.points, flatPoints_);
    flat.positions = flat_, flat.points = flatPoints_;
  };
  const bool lengthsMatter = options_.delaunay || options_.method == sf::PolygonMethod::Trapezoids;
  if (lengthsMatter && !plane_.isAcrossAxis()) {
    project(true);
    sf::PolygonOptions options = options_;
    options.repair = sf::Repair::None;
    const sf::Outcome outcome = triangulator_.triangulate(flat, options, work_, found_);
    if (outcome.ok()) take(polygon, flat);
    if (!isFault(outcome.status)) return outcome;
  }
  project(false);
  // The coordinate left out is the core's to see too.
  for (uint32_t r = 0; r + 1 < view.starts.size(); ++r)
    for (uint32_t v = view.starts[r]; v < view.starts[r + 1]; ++v)
      if (!(std::fabs(view.positions[3 * size_t(v) + plane_.dropped]) <= sf::kLargestCoordinate)) {
        const sf::Outcome outcome{sf::Status::NotFinite, r, v - view.starts[r]};
        blame(polygon, outcome, flat);
        return outcome;
      }
  return triangulate(polygon, flat);
}

/// Appends what was found of a polygon, its vertices numbered as in the whole input.
void Call::take(uint32_t polygon, const sf::PolygonView& view) {
  const uint32_t base = firstVertex(polygon);
  const uint32_t own = uint32_t(view.positions.size() / 2);
  const uint32_t others = ringStarts_[ringStarts_.size() - 1];
  const uint32_t shift = others - own + uint32_t(added_.size() / dimension_);
  const auto name = [&](uint32_t v) { return v < own ? base + v : v + shift; };
  if (base == 0 && others == own && all_.triangles.empty()) {
    all_.triangles = std::move(found_.triangles);
  } else {
    for (const uint32_t v : found_.triangles) all_.triangles.push_back(name(v));
  }
  const uint32_t stripped = uint32_t(strips_.size());
  for (const uint32_t v : found_.strips) strips_.push_back(name(v));
  for (size_t s = 1; s < found_.stripStarts.size(); ++s)
    stripStarts_.push_back(stripped + found_.stripStarts[s]);
  for (const uint32_t edge : found_.addedOn) addedOn_.push_back(base + edge);
  for (size_t i = 0; i + 1 < found_.added.size(); i += 2)
    append(found_.added[i], found_.added[i + 1], added_);
}

void Call::blame(uint32_t polygon, const sf::Outcome& outcome, const sf::PolygonView& view) {
  for (const uint32_t number : {polygon, uint32_t(outcome.status), outcome.loop, outcome.vertex,
                                outcome.otherLoop, outcome.otherVertex})
    faults_.push_back(number);
  const sf::Point2 place = sf::faultPoint(view, outcome);
  append(place.x, place.y, faultPoints_);
}

void Call::append(double x, double y, std::vector<double>& to) const {
  if (dimension_ == 2) {
    to.insert(to.end(), {x, y});
  } else {
    const sf::Vec3 p = plane_.lift(x, y);
    to.insert(to.end(), {p.x, p.y, p.z});
  }
}

SfResult* Call::pack() {
  auto* result = new SfResult;
  result->add(std::move(all_.triangles));
  result->add(std::move(all_.triangleStarts));
  result->add(std::move(strips_));
  result->add(std::move(stripStarts_));
  result->add(std::move(stripGroups_));
  result->add(std::move(added_));
  result->add(std::move(addedOn_));
  result->add(std::move(found_.trace), 4);
  result->add(std::move(faults_));
  result->add(std::move(faultPoints_));
  return result;
}

sf::Outcome check(const uint32_t* ringStarts, uint32_t ringCount, const uint32_t* polygonStarts,
                  uint32_t polygonCount, uint32_t pointCount, const double* settings) {
  const int last[] = {1, 1, 2, 1, 1, 1, 1};
  for (int i = 0; i < 7; ++i)
    if (!sf::isChoice(i == 0 ? settings[0] - 2 : settings[i], last[i]))
      return {sf::Status::BadOption};
  if (!(settings[7] >= 0)) return {sf::Status::BadOption};
  if (!sf::isRising(ringStarts, ringCount) || !sf::isRising(polygonStarts, polygonCount) ||
      polygonStarts[polygonCount] != ringCount)
    return {sf::Status::BadStarts};
  const bool several = polygonCount != 1, repairs = settings[2] != 0, traces = settings[6] != 0;
  if (pointCount > 0 && (several || repairs)) return {sf::Status::BadOption};
  if (traces && (several || settings[1] != 0)) return {sf::Status::BadOption};
  // Indices of corners are below 2^32.
  if (uint64_t(ringStarts[ringCount]) + pointCount >= 1u << 29) return {sf::Status::TooLarge};
  return {};
}

/// Has the memory grow by `bytes` at once, if so many are allowed, and not list by list: hosts collect
/// their garbage when it grows, which takes longer than a large polygon.
void growOnce(double bytes, double maxBytes) {
  if (bytes > maxBytes || bytes >= 0x1p31) return;
  void* volatile block = std::malloc(size_t(bytes));  // volatile, or else both calls are left out
  std::free(block);
}

std::unique_ptr<sf::PolygonTriangulator>& keptTriangulator() {
  static std::unique_ptr<sf::PolygonTriangulator> kept;
  return kept;
}

}  // namespace

extern "C" SfStatus sf_triangulate_polygons(const double* positions, const uint32_t* ringStarts,
                                            uint32_t ringCount, const uint32_t* polygonStarts,
                                            uint32_t polygonCount, const double* points,
                                            uint32_t pointCount, const double* settings,
                                            uint32_t* where, SfResult** result) {
  *result = nullptr;
  sf::Outcome outcome =
      check(ringStarts, ringCount, polygonStarts, polygonCount, pointCount, settings);
  if (outcome.ok()) {
    const uint32_t dimension = uint32_t(settings[0]);
    const size_t n = ringStarts[ringCount];
    sf::PolygonOptions options;
    options.method = sf::PolygonMethod(int(settings[1]));
    options.repair = sf::Repair(int(settings[2]));
    options.delaunay = settings[3] == 1;
    options.strips = settings[4] == 1;
    options.verify = settings[5] == 1;
    options.trace = settings[6] == 1;
    sf::Work work = sf::hostWork(settings[7]);
    const bool isLarge = n + pointCount > kMostKept;
    if (isLarge && polygonCount == 1)
      growOnce(double(kLeastPerVertex) * double(n + pointCount), settings[7]);
    auto& triangulator = keptTriangulator();
    if (!triangulator) triangulator = std::make_unique<sf::PolygonTriangulator>();
    Call call({dimension, options}, {positions, dimension * n}, {ringStarts, size_t(ringCount) + 1},
              {polygonStarts, size_t(polygonCount) + 1}, {points, dimension * size_t(pointCount)},
              *triangulator, work);
    outcome = call.run();
    if (outcome.ok()) *result = call.pack();
    if (isLarge) triangulator.reset();
  }
  sf::tellWhere(outcome, where);
  return SfStatus(outcome.status);
}
