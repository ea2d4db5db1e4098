// Polygons to test with; random ones take their numbers from a seeded generator.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "support/generators.h"

namespace sftest {

struct Point {
  double x, y;
};
inline bool operator==(Point a, Point b) { return a.x == b.x && a.y == b.y; }

/// A closed ring; the last point is joined to the first.
using Ring = std::vector<Point>;

/// Rings in flat arrays, as the core takes them: the outer one first, then the holes.
struct Polygon {
  std::vector<double> positions;  // [2n]
  std::vector<uint32_t> starts;   // [r+1]

  uint32_t vertexCount() const { return uint32_t(positions.size() / 2); }
  uint32_t ringCount() const { return uint32_t(starts.size()) - 1; }
  Point point(uint32_t v) const { return {positions[2 * v], positions[2 * v + 1]}; }
};
Polygon polygonOf(const std::vector<Ring>& rings);
std::vector<Ring> ringsOf(const Polygon& polygon);
/// The polygon as nested lists, every digit kept: to rerun a failure.
std::string describe(const Polygon& polygon);

// Rings without crossings, counter-clockwise unless said otherwise.
Ring regularRing(uint32_t n, double radius, Point centre, double turn = 0);
/// Random radii at random increasing angles. `roughness` 0 to 1.
Ring starRing(uint32_t n, double roughness, Random& random, double radius = 1,
              Point centre = {0, 0});
/// A smooth curve about the origin.
Ring blobRing(uint32_t n, Random& random);
/// A random polygon through n random points of the unit square, by space partition.
/// Source: Auer, Held 1996, "Heuristics for the generation of random polygons".
Ring partitionRing(uint32_t n, Random& random);
/// `teeth` spikes upward on a common base.
Ring combRing(uint32_t teeth, Random& random);
/// Teeth up and down from a common bar.
Ring doubleCombRing(uint32_t teeth, Random& random);
/// A corridor that winds between teeth from above and from below: every sag sees another gorge.
Ring interleavedCombRing(uint32_t teeth, Random& random);
Ring spiralRing(uint32_t n, double turns);
/// A Koch snowflake of 3 4^levels vertices.
Ring kochRing(uint32_t levels);
/// Strictly rising steps on either side: collinear and equal coordinates.
Ring staircaseRing(uint32_t steps);
/// A zigzag band, monotone along x.
Ring zigzagRing(uint32_t n, Random& random);
/// Long thin triangles all through one corner's neighbourhood.
Ring fanRing(uint32_t n, Random& random);

/// The unit square with columns x rows square holes, each turned by its own angle unless aligned.
Polygon holeGrid(uint32_t columns, uint32_t rows, bool aligned, Random& random);
/// The same with stars of `corners` vertices for holes, in a star.
Polygon starsInHoles(uint32_t columns, uint32_t rows, uint32_t corners, Random& random);
/// A blob and the points of a columns x columns grid inside it, off its edges.
struct GriddedBlob {
  Polygon polygon;
  std::vector<Point> inner;
};
GriddedBlob blobWithGrid(uint32_t samples, uint32_t columns, Random& random);

/// A random connected set of about `count` triangles of a triangulated lattice of columns x columns
/// points: outer ring, holes, touches at points, collinear runs. With `moved` the points leave the
/// lattice.
///   selfTouching  rings may pass a point twice; otherwise such rings are split
Polygon latticeRegion(uint32_t columns, uint32_t count, bool moved, bool selfTouching,
                      Random& random);

/// A random valid polygon of 5 to 100 vertices of any of the kinds above.
Polygon smallPolygon(Random& random);

/// Closed rings of random points, crossing at will: on a coarse lattice if `lattice` is not 0.
Polygon garbage(uint32_t rings, uint32_t pointsEach, uint32_t lattice, Random& random);

// Symmetries that keep all faults as they are, but for rounding where said.
Polygon quarterTurned(const Polygon& polygon);
Polygon mirrored(const Polygon& polygon);
Polygon scaledBy(const Polygon& polygon, double powerOfTwo);
/// Turns by an angle and moves. Rounds, so only for polygons with room to spare.
Polygon placed(const Polygon& polygon, double angle, double scale, Point shift);
/// Each ring from another start, some backwards; holes in another order.
Polygon rewritten(const Polygon& polygon, Random& random);

}  // namespace sftest
