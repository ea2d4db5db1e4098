// The triangulators on one polygon, judged by the oracles.
#pragma once
#include <string>

#include "polygon/triangulate.h"
#include "support/polygon_oracle.h"

namespace sftest {

sf::PolygonView viewOf(const Polygon& polygon);

/// The fault that a status of the triangulators stands for.
uint32_t faultOfStatus(sf::Status status);

/// What either method gets wrong about a polygon, with and without Delaunay flips, strips and a
/// certificate; empty if nothing. It is wrong to report a fault that the polygon does not have, or
/// none if it has one; to name two edges that do not meet; to return an invalid triangulation, or
/// strips of other triangles; to leave memory charged.
std::string faultOfTriangulators(const Polygon& polygon);

/// What either method gets wrong when it repairs any finite rings; empty if nothing.
std::string faultOfRepair(const Polygon& polygon, sf::Repair rule);

}  // namespace sftest
