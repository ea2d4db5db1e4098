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
/// certificate, empty if nothing: a fault that it does not have, or none where it has one; a pair of
/// edges that do not meet; a triangulation that is none; strips of other triangles; memory that is
/// still charged.
std::string faultOfTriangulators(const Polygon& polygon);

/// What either method gets wrong about any finite rings when it is to repair them.
std::string faultOfRepair(const Polygon& polygon, sf::Repair rule);

}  // namespace sftest
