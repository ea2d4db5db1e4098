// Exact tests of triangle lists and segments for intersection.
#pragma once
#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace sftest {

/// A pair of triangles that meet elsewhere than in the vertices and edges they share.
struct Crossing {
  bool found = false;
  uint32_t first = 0, second = 0;
};

/// The first such pair. Exact for coordinates whose products neither overflow nor underflow.
///   positions  [n]
///   triangles  [3m], none collinear
/// O(m^2): meant for small surfaces.
Crossing findCrossing(const std::vector<sf::Vec3>& positions,
                      const std::vector<uint32_t>& triangles);

/// Whether the closed segments a-b and c-d, neither of length 0, have a point in common. Exact.
bool segmentsMeet(sf::Vec3 a, sf::Vec3 b, sf::Vec3 c, sf::Vec3 d);

/// Whether three points lie exactly on one line (or coincide).
bool collinear(sf::Vec3 a, sf::Vec3 b, sf::Vec3 c);

}  // namespace sftest
