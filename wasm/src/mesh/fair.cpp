#include "mesh/fair.h"

#include <cmath>

#include "base/charge.h"
#include "base/vec.h"
#include "mesh/fair_system.h"
#include "mesh/mesh.h"
#include "mesh/unit_box.h"
#include "triangles/triangle_mesh.h"

namespace sf {
namespace {

// Places are in a box of unit size. A solution beyond this is none.
constexpr double kFarthest = 1e3;
// A step shorter than this, in edges of the patch, is the last one.
constexpr double kLastStep = 0.02;
// What lies less far from a plane, for the extent of a patch, lies in it.
constexpr double kFlat = 1e-5;

ArrayView<const uint32_t> surroundings(const LocalSurface& surface) {
  return ArrayView<const uint32_t>(surface.triangles).slice(0, 3 * size_t(surface.fixedTriangles));
}

class Fairing {
 public:
  ///   unit  of the places that are faired
  Fairing(const LocalSurface& surface, double unit, Work& work)
      : surface_(surface), work_(work), clamps_(surface.clamps) {
    for (Clamp& clamp : clamps_) clamp.pull = (1 / unit) * clamp.pull;
    findNear();
  }

  /// Solves `rounds` times, of the order asked for or the next lower one that works. Returns that order.
  uint32_t solve(const FairOptions& options, std::vector<Vec3>& at);
  /// Steps to the least variation of curvature, as long as they lead there. Returns whether any did.
  bool leastVariation(uint32_t steps, std::vector<Vec3>& at);
  /// Steps to the least bending, as long as each is shorter than the one before. Returns whether there were any.
  bool leastBending(uint32_t steps, std::vector<Vec3>& at);

 private:
  void findNear();
  bool measure(ArrayView<const Vec3> at, uint32_t order);
  bool isTame(ArrayView<const Vec3> at) const {
    for (const Vec3& p : at)
      if (!(std::fabs(p.x) < kFarthest && std::fabs(p.y) < kFarthest && std::fabs(p.z) < kFarthest))
        return false;
    return true;
  }

  const LocalSurface& surface_;
  Work& work_;
  std::vector<Clamp> clamps_;
  TriangleMesh near_;  // triangles that the system knows of
  std::vector<double> flat_;
  Laplacian laplacian_;
};

/// Rows of vertices at most two edges away from a free one are all that k = 3 takes.
void Fairing::findNear() {
  const std::vector<uint32_t>& t = surface_.triangles;
  if (!clamps_.empty()) {
    near_.corners = t;
    return;
  }
  std::vector<uint8_t> isNear(surface_.positions.size() / 3, 0);
  for (size_t v = surface_.fixedVertices; v < isNear.size(); ++v) isNear[v] = 1;
  std::vector<uint32_t> ring;
  for (int r = 0; r < 2; ++r) {
    ring.clear();
    for (size_t h = 0; h < t.size(); h += 3)
      if (isNear[t[h]] || isNear[t[h + 1]] || isNear[t[h + 2]])
        ring.insert(ring.end(), {t[h], t[h + 1], t[h + 2]});
    for (const uint32_t v : ring) isNear[v] = 1;
  }
  for (size_t h = 0; h < t.size(); h += 3)
    if (isNear[t[h]] || isNear[t[h + 1]] || isNear[t[h + 2]])
      near_.corners.insert(near_.corners.end(), {t[h], t[h + 1], t[h + 2]});
}

bool Fairing::measure(ArrayView<const Vec3> at, uint32_t order) {
  flat_.clear();
  for (const Vec3& p : at) flat_.insert(flat_.end(), {p.x, p.y, p.z});
  if (near_.twins.empty() && !findTwins(near_.corners, uint32_t(at.size()), work_, near_.twins))
    return false;
  return buildLaplacian(flat_, near_, clamps_, order == 3, work_, laplacian_);
}

uint32_t Fairing::solve(const FairOptions& options, std::vector<Vec3>& at) {
  const std::vector<Vec3> before = at;
  uint32_t order = options.order < 3 ? options.order : 3;
  for (uint32_t round = 0; round < options.rounds && order > 0;) {
    if (!measure(at, order)) return 0;
    FairSystem system(laplacian_, surface_.fixedVertices, work_);
    const bool isGood = system.solve(order, at) && isTame(at);
    if (!work_.going()) return 0;
    if (isGood) {
      ++round;
      continue;
    }
    // From the beginning: what a system without a good solution gave is no better than the patch.
    --order, round = 0;
    at = before;
  }
  return order;
}

bool Fairing::leastVariation(uint32_t steps, std::vector<Vec3>& at) {
  std::vector<Vec3> best = at;
  double least = 0;
  bool isBetter = false;
  for (uint32_t i = 0, halvings = 0; i <= steps; ++i) {
    if (!measure(at, 3)) return false;
    FairSystem system(laplacian_, surface_.fixedVertices, work_);
    system.measure(at, near_.corners);
    const double now = system.variation();
    if (i > 0 && !(now < least && isTame(at))) {
      // Too far: half of the step, or none.
      if (++halvings > 2) break;
      for (size_t v = surface_.fixedVertices; v < at.size(); ++v) at[v] = 0.5 * (at[v] + best[v]);
      continue;
    }
    isBetter = isBetter || i > 0;
    least = now, best = at;
    double most;
    if (i == steps || !system.step(3, at, most)) break;
    if (most < kLastStep * std::sqrt(1.0 / double(at.size()))) steps = i + 1;
  }
  at = best;
  return isBetter;
}

bool Fairing::leastBending(uint32_t steps, std::vector<Vec3>& at) {
  std::vector<Vec3> from = at;
  double shortest = kFarthest;
  uint32_t done = 0;
  while (done < steps) {
    if (!measure(at, 2)) return false;
    FairSystem system(laplacian_, surface_.fixedVertices, work_);
    system.measure(at, near_.corners);
    std::vector<Vec3> next = at;
    double most;
    const bool isGood = system.step(2, next, most) && isTame(next) && most < shortest;
    if (!work_.going()) return false;
    if (!isGood) {
      // The last step led to no better place.
      at = from;
      break;
    }
    from.swap(at), at.swap(next);
    shortest = most, ++done;
    if (most < kLastStep * std::sqrt(1.0 / double(at.size()))) break;
  }
  return done > 0;
}

}  // namespace

Status fair(LocalSurface& surface, const FairOptions& options, Work& work, Fairness& result) {
  result = {};
  const size_t n = surface.positions.size() / 3;
  const UnitBox box(surface.positions);
  if (n <= surface.fixedVertices || box.isPoint()) return work.status();
  Charge charge(work);
  if (!charge.add(n * 300 + surface.triangles.size() * 16)) return work.status();
  std::vector<Vec3> at(n);
  for (size_t v = 0; v < n; ++v) at[v] = box.in(&surface.positions[3 * v]);
  Fairing fairing(surface, box.extent(), work);
  uint32_t order = fairing.solve(options, at);
  const uint32_t steps = options.stepsOf(order);
  const bool isBetter = steps > 0 && (order == 2 ? fairing.leastBending(steps, at)
                                                 : fairing.leastVariation(steps, at));
  if (steps > 0 && !isBetter && options.rounds == 0) {
    // Something has to smooth it.
    FairOptions once = options;
    once.rounds = 1;
    order = fairing.solve(once, at);
  }
  if (!work.going() || order == 0) return work.status();
  result.order = order;
  for (size_t v = surface.fixedVertices; v < n; ++v) {
    double* p = &surface.positions[3 * v];
    const Vec3 before{p[0], p[1], p[2]};
    box.out(at[v], p);
    result.moved = std::fmax(result.moved, distance(before, {p[0], p[1], p[2]}));
  }
  return work.status();
}

bool roughness(const LocalSurface& surface, Work& work, double& result) {
  result = 0;
  const UnitBox box(surface.positions);
  if (surface.fixedTriangles == 0 || box.isPoint()) return work.going();
  const size_t n = surface.positions.size() / 3;
  Charge charge(work);
  if (!charge.add(n * 150 + size_t(surface.fixedTriangles) * 36)) return false;
  std::vector<Vec3> at(n);
  std::vector<double> flat;
  for (size_t v = 0; v < n; ++v) {
    at[v] = box.in(&surface.positions[3 * v]);
    flat.insert(flat.end(), {at[v].x, at[v].y, at[v].z});
  }
  const ArrayView<const uint32_t> around = surroundings(surface);
  Laplacian laplacian;
  TriangleMesh mesh;
  mesh.corners.assign(around.begin(), around.end());
  if (!findTwins(around, uint32_t(n), work, mesh.twins) ||
      !buildLaplacian(flat, mesh, {}, false, work, laplacian))
    return false;
  FairSystem system(laplacian, uint32_t(n), work);
  system.measure(at, around);
  double sum = 0;
  size_t count = 0;
  for (size_t h = 0; h < around.size(); ++h) {
    const uint32_t a = around[h], b = around[nextInTriangle(uint32_t(h))];
    if (laplacian.isBoundary[a] || laplacian.isBoundary[b]) continue;
    sum += std::fabs(system.curvature(a) - system.curvature(b)) * distance(at[a], at[b]), ++count;
  }
  // Curvatures are in units of the mean mass: times its inverse they would be those of the unit box.
  if (count > 0) result = sum / double(count) / laplacian.unit;
  return work.going();
}

bool isFlat(const LocalSurface& surface, double crease) {
  const std::vector<uint32_t>& t = surface.triangles;
  const size_t n = surface.positions.size() / 3, fixed = 3 * size_t(surface.fixedTriangles);
  const auto at = [&](uint32_t v) { return pointAt(surface.positions, v); };
  std::vector<uint8_t> isPatch(n, 0);
  for (size_t h = fixed; h < t.size(); ++h) isPatch[t[h]] = 1;
  Vec3 across{0, 0, 0}, middle{0, 0, 0};
  double number = 0, extent = 0;
  for (size_t h = fixed; h < t.size(); h += 3)
    across = across + cross(at(t[h + 1]) - at(t[h]), at(t[h + 2]) - at(t[h]));
  for (uint32_t v = 0; v < n; ++v)
    if (isPatch[v]) middle = middle + at(v), ++number;
  const double l = length(across);
  if (number == 0 || !(l > 0)) return false;
  middle = (1 / number) * middle, across = (1 / l) * across;
  for (uint32_t v = 0; v < n; ++v)
    if (isPatch[v]) extent = std::fmax(extent, distance(at(v), middle));
  const auto isInPlane = [&](uint32_t v) {
    return std::fabs(dot(at(v) - middle, across)) <= kFlat * extent;
  };
  for (uint32_t v = 0; v < n; ++v)
    if (isPatch[v] && !isInPlane(v)) return false;
  double inPlane = 0, bent = 0;
  for (uint32_t h = 0; h < fixed; ++h) {
    const uint32_t a = t[h], b = t[nextInTriangle(h)], c = t[prevInTriangle(h)];
    if (!isPatch[a] || !isPatch[b]) continue;
    const double side = distance(at(a), at(b));
    if (isInPlane(c))
      inPlane += side;
    else if (crease > 0 && angleBetween(across, cross(at(b) - at(a), at(c) - at(a))) > crease)
      bent += side;
    else
      return false;
  }
  return inPlane > 0 && 3 * inPlane >= bent;
}

}  // namespace sf
