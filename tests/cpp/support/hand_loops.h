// Loops as hands draw them and scanners leave them: noisy, uneven, close to themselves and to each
// other. The same families as in tests/support/hand_loops.ts.
#pragma once
#include "support/generators.h"

namespace sftest {

enum class Hand {
  Stroke,           // one closed stroke: jittered spacing, noise of 0 to .2 of its radius, tilted
  Pair,             // two strokes, one above the other
  Several,          // three to six strokes around a centre
  SelfApproaching,  // strokes that come near to themselves: horseshoes, gaps of some noise
  DenseCurve,       // one or two smooth curves in space, densely sampled
  Rims,             // rims of one mesh, of very different sizes
  Linked,           // rings that are linked
  Knot,             // a torus knot
  ManySmall,        // 20 to 40 loops of 3 to 8 vertices, flat or noisy
  Count
};
const char* nameOf(Hand kind);

/// A closed stroke of n points: radius 1 + sum of a_k cos((k + 2) t + phase_k), k < 4, a_k normal
/// with deviation .25 / (k + 1); spacing jittered by 30 %; noise in all coordinates; in the plane
/// across `axis`.
Curve handStroke(uint32_t n, double noise, Vec3 centre, Vec3 axis, Random& random);

/// Loops of one kind with about `size` vertices in all, at least 3 each. Edges rarely meet, but
/// nothing rules it out: hands do not either.
Curves handLoops(Hand kind, uint32_t size, Random& random);

/// A number from `low` to `high` whose logarithm is uniform.
uint32_t logUniform(uint32_t low, uint32_t high, Random& random);

}  // namespace sftest
