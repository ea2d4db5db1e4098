// Holes in surfaces that are known exactly, with the patch of the solver in them.
#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "base/vec.h"
#include "mesh/local_surface.h"

namespace sftest {

struct Sheet {
  std::vector<double> positions;    // [3n]
  std::vector<uint32_t> triangles;  // [3m]
  sf::Vec3 at(uint32_t v) const {
    return {positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]};
  }
};

/// Surfaces of regular make whose vertices are shifted in the surface at random by up to `jitter` of an edge.
/// A sphere of radius 1: 20 * 4^level triangles.
Sheet sphereSheet(uint32_t level, double jitter = 0.2, uint32_t seed = 1);
Sheet torusSheet(uint32_t around, uint32_t across, double radius, double tube, double jitter = 0.2,
                 uint32_t seed = 1);
/// Of radius 1, without ends.
Sheet cylinderSheet(uint32_t around, uint32_t along, double height, double jitter = 0.2,
                    uint32_t seed = 1);
/// A square [-1, 1]^2 at the height that a function gives.
Sheet graphSheet(uint32_t n, const std::function<double(double, double)>& height,
                 double jitter = 0.2, uint32_t seed = 1);

/// One hole of a sheet, with its surroundings and a patch of the solver.
struct Hole {
  sf::LocalSurface surface;
  std::vector<uint32_t> vertices;  // [fixedVertices] their numbers in the sheet
  std::vector<uint32_t> cutAway;   // [3c] triangles that were there, in the sheet's numbers
  double meanEdge = 0;             // of the surroundings
  uint32_t rim = 0;                // vertices on it
};

/// Fills the loops of one hole of a mesh with spanLoops.
///   loops  vertices as the patch runs along them
Hole fillLoops(const Sheet& mesh, const std::vector<std::vector<uint32_t>>& loops,
               uint32_t rings = 5);

/// Cuts away the triangles whose centroid is in a region, which must leave simple rims of one hole, and fills it
/// with spanLoops. `rings` of triangles around it are kept.
Hole cutHole(const Sheet& sheet, const std::function<bool(sf::Vec3)>& region, uint32_t rings = 5);

/// What is within so many degrees of the z axis, for `cutHole`.
std::function<bool(sf::Vec3)> cap(double degrees);

/// Root mean square of a distance over the patch: at the centroids and vertices of its triangles, by area.
double patchError(const sf::LocalSurface& surface, const std::function<double(sf::Vec3)>& distance);

/// Area and angles of the patch.
struct PatchShape {
  uint32_t triangles = 0;
  double area = 0;
  double leastAngle = 0,
         meanLeastAngle = 0;  // degrees; of triangles with no vertex outside the patch as well
  double rimAngle = 0;        // degrees, mean over rim edges
  bool isManifold = true;     // no edge of the whole in three triangles, or twice in one direction
};
PatchShape shapeOf(const sf::LocalSurface& surface);

}  // namespace sftest
