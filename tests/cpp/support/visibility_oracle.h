// What each node of a polygon sees to its left and right, found by looking at every edge.
#pragma once
#include "polygon/sweep/sweep.h"
#include "support/polygon_generators.h"

namespace sftest {

struct Sight {
  sf::LinkedPolygon linked;  // node i is vertex i, islands after them
  sf::Visibility seen;
};

/// For valid polygons whose rings do not touch and whose vertices are all distinct. O(n^2) time.
///   islands  isolated vertices strictly inside
Sight lookAround(const Polygon& polygon, const std::vector<Point>& islands = {});

}  // namespace sftest
