#include "polygon/input/plane.h"

#include <algorithm>
#include <cmath>

namespace sf {
namespace {

/// Normals shorter than this, for rings in a unit cube, are not used.
constexpr double kLeastNormal = 1e-9;

/// Sums over the edges of a ring, relative to its first vertex and divided by its extent.
struct RingSums {
  double newell[3] = {};
  double squares[3][3] = {};  // of vertices' coordinates, two by two
  double means[3] = {};
};

RingSums sumOver(ArrayView<const double> ring) {
  RingSums sums;
  double extent = 0;
  for (size_t i = 3; i < ring.size(); ++i)
    extent = std::max(extent, std::fabs(ring[i] - ring[i % 3]));
  if (!(extent > 0) || !std::isfinite(extent)) return sums;
  const int exponent = -std::ilogb(extent);
  const size_t n = ring.size() / 3;
  const auto at = [&](size_t i, uint32_t k) {
    return std::ldexp(ring[3 * i + k] - ring[k], exponent);
  };
  double before[3] = {at(n - 1, 0), at(n - 1, 1), at(n - 1, 2)};
  for (size_t i = 0; i < n; ++i) {
    const double now[3] = {at(i, 0), at(i, 1), at(i, 2)};
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t u = (k + 1) % 3, v = (k + 2) % 3;
      sums.newell[k] += before[u] * now[v] - before[v] * now[u];
      sums.means[k] += now[k] / double(n);
      for (uint32_t l = 0; l < 3; ++l) sums.squares[k][l] += now[k] * now[l] / double(n);
    }
    std::copy(now, now + 3, before);
  }
  return sums;
}

uint32_t largest(const double (&values)[3]) {
  uint32_t best = 2;
  for (uint32_t k = 0; k < 2; ++k)
    if (std::fabs(values[k]) > std::fabs(values[best])) best = k;
  return best;
}

/// The column of the covariance's adjugate with the largest diagonal entry. If the ring is planar,
/// the adjugate is a multiple of the normal times itself. Zero for collinear points.
void leastVariance(const RingSums& sums, double (&normal)[3]) {
  const auto c = [&](uint32_t k, uint32_t l) {
    return sums.squares[k % 3][l % 3] - sums.means[k % 3] * sums.means[l % 3];
  };
  const auto cofactor = [&](uint32_t k, uint32_t l) {
    return c(k + 1, l + 1) * c(k + 2, l + 2) - c(k + 1, l + 2) * c(k + 2, l + 1);
  };
  const double diagonal[3] = {cofactor(0, 0), cofactor(1, 1), cofactor(2, 2)};
  const uint32_t k = largest(diagonal);
  for (uint32_t l = 0; l < 3; ++l) normal[l] = cofactor(k, l);
}

}  // namespace

Vec3 Plane::lift(double x, double y) const {
  double at[3];
  const double origin[3] = {through.x, through.y, through.z};
  at[u] = x, at[v] = y;
  const double along = normal[u] * (x - origin[u]) + normal[v] * (y - origin[v]);
  at[dropped] = origin[dropped] - along / normal[dropped];
  return {at[0], at[1], at[2]};
}

Plane planeOf(ArrayView<const double> ring) {
  RingSums sums = sumOver(ring);
  double(&normal)[3] = sums.newell;
  if (std::fabs(normal[largest(normal)]) < kLeastNormal) leastVariance(sums, normal);
  const uint32_t k = largest(normal);
  if (normal[k] == 0) normal[k] = 1;
  Plane plane{};
  if (ring.size() >= 3) plane.through = {ring[0], ring[1], ring[2]};
  std::copy(normal, normal + 3, plane.normal);
  plane.dropped = k;
  plane.u = (k + 1) % 3, plane.v = (k + 2) % 3;
  if (normal[k] < 0) std::swap(plane.u, plane.v);
  return plane;
}

void flatten(const Plane& plane, bool isometric, ArrayView<const double> from,
             std::vector<double>& to) {
  const size_t n = from.size() / 3;
  to.resize(2 * n);
  if (!isometric) {
    for (size_t i = 0; i < n; ++i) {
      to[2 * i] = from[3 * i + plane.u];
      to[2 * i + 1] = from[3 * i + plane.v];
    }
    return;
  }
  const Vec3 normal = {plane.normal[0], plane.normal[1], plane.normal[2]};
  double axis[3] = {};
  axis[plane.u] = 1;
  // u leans into the plane, v is across both: like u and v themselves, seen from where the ring is
  // counter-clockwise.
  Vec3 across = cross(normal, {axis[0], axis[1], axis[2]});
  across = (1 / length(across)) * across;
  Vec3 along = cross(across, normal);
  along = (1 / length(along)) * along;
  for (size_t i = 0; i < n; ++i) {
    const Vec3 p = Vec3{from[3 * i], from[3 * i + 1], from[3 * i + 2]} - plane.through;
    to[2 * i] = dot(along, p);
    to[2 * i + 1] = dot(across, p);
  }
}

}  // namespace sf
