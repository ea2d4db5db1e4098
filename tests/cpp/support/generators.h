// Loops to test with. Everything random takes its numbers from one seeded generator, the same one
// as in tests/support/generators.ts.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "loops/problem/loop_set.h"

namespace sftest {

using sf::Vec3;

/// Uniform numbers from a 32-bit xorshift (Marsaglia 2003), alike on every machine.
class Random {
 public:
  explicit Random(uint32_t seed);
  uint32_t bits();
  uint32_t below(uint32_t n) { return uint32_t(uint64_t(bits()) * n >> 32); }
  double unit() { return bits() / 4294967296.0; }
  double range(double low, double high) { return low + (high - low) * unit(); }
  bool chance(double p) { return unit() < p; }
  Vec3 inCube(double half) {
    double x = range(-half, half), y = range(-half, half);
    return {x, y, range(-half, half)};
  }
  Vec3 direction();

 private:
  uint32_t state_;
};

using Curve = std::vector<Vec3>;
using Curves = std::vector<Curve>;

sf::LoopSet loopSet(const Curves& curves);

/// Rotation by a random axis and angle, as rows.
struct Rotation {
  Vec3 x, y, z;
  Vec3 operator()(Vec3 p) const { return {dot(x, p), dot(y, p), dot(z, p)}; }
};
Rotation rotationAbout(Vec3 axis, double angle);
Rotation randomRotation(Random& random);

/// n points at equal angles on a circle about `centre` in the plane across `axis` (unit).
Curve circle(uint32_t n, double radius = 1, Vec3 centre = {0, 0, 0}, Vec3 axis = {0, 0, 1});
/// (cos t, sin t, cos(3t) / 2) at n equal steps.
Curve monkeySaddle(uint32_t n);
/// k (at most 6) saddle curves (r cos t, r sin t, h cos 2t) facing outward at the corners of a
/// regular octahedron, each turned and moved a little.
Curves regularSaddles(uint32_t k, uint32_t n, Random& random);
/// Loops of random points in unit cubes, loop c moved by `apart` along a direction of its own.
Curves randomLoops(const std::vector<uint32_t>& sizes, double apart, Random& random);
/// A circle whose points are moved by up to `noise`.
Curve noisyCircle(uint32_t n, double noise, Random& random);
/// Disjoint simple loops along edges of a sphere's mesh (an icosahedron divided `levels` times):
/// the rims of `count` random discs of `faces` faces each. Fewer than asked for if none fits.
Curves meshLoops(uint32_t levels, uint32_t count, uint32_t faces, Random& random);
/// The same with faces[c] faces for disc c.
Curves meshRims(uint32_t levels, const std::vector<uint32_t>& faces, Random& random);

/// The curves of a file in the .curve format; empty if it cannot be read.
Curves readCurves(const std::string& path);
/// The curves as nested lists, every digit kept: to rerun a failure.
std::string describe(const Curves& curves);

}  // namespace sftest
