// The triangulators on one polygon, judged by the oracles.
#pragma once
#include <string>

#include "polygon/triangulate.h"
#include "support/polygon_oracle.h"

namespace sftest {

sf::PolygonView viewOf(const Polygon& polygon);

/// The fault that a status of the triangulators stands for.
uint32_t faultOfStatus(sf::Status status);

/// What either method gets wrong about a polygon, empty if nothing: a fault that it does not have, or
/// none where it has one; a pair of edges that do not meet; a triangulation that is none; memory
/// that is still charged.
std::string faultOfTriangulators(const Polygon& polygon);

}  // namespace sftest
