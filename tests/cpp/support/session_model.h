// A polygon edited alongside a session, to judge the session by.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "polygon/session/session.h"
#include "support/polygon_oracle.h"

namespace sftest {

using Triangle = std::array<uint32_t, 3>;

/// A polygon as lists of vertices with the session's numbers.
struct Model {
  struct Vertex {
    uint32_t number;
    Point at;
  };
  std::vector<std::vector<Vertex>> rings;
  std::vector<Vertex> islands;

  Polygon polygon() const;
  std::vector<uint32_t> numbers() const;
};

/// Whether a session has to accept the polygon: valid, no two points equal, no touches, islands
/// inside.
bool acceptable(const Model& model);

/// Triangles, each beginning with its least vertex, in order.
std::vector<Triangle> sorted(sf::ArrayView<const uint32_t> corners);
/// The triangles that OpenGL draws of the session's strips; `indices` becomes their index count.
std::vector<Triangle> drawn(const sf::PolygonSession& session, size_t& indices);

/// Which promise the session breaks, judged from outside; empty if none.
std::string faultOf(const sf::PolygonSession& session, const Model& model);

/// Starts both with an acceptable polygon. False if the session refuses it.
bool startBoth(sf::PolygonSession& session, Model& model, const Polygon& polygon,
               const std::vector<Point>& islands);

/// Makes one random edit to both. Positions change by about `reach`, to points of a lattice if
/// `lattice` is not 0. Adds to `accepted` if the session took it. Returns what is wrong, empty if
/// nothing: the session accepts what is not acceptable or refuses what is, does not report all
/// changes, or has a fault.
std::string editBoth(sf::PolygonSession& session, Model& model, double reach, uint32_t lattice,
                     Random& random, uint32_t& accepted);

}  // namespace sftest
