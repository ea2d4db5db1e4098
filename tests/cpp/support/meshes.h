// Meshes to test with: smooth and sharp, closed and open, with regions cut out and without.
#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "base/vec.h"
#include "mesh/mesh.h"
#include "support/generators.h"

namespace sftest {

struct TestMesh {
  std::vector<double> positions;  // [3n]
  std::vector<uint32_t> faces;    // [3m]

  sf::MeshView view() const { return {positions, faces}; }
  uint32_t vertexCount() const { return uint32_t(positions.size() / 3); }
  uint32_t faceCount() const { return uint32_t(faces.size() / 3); }
  Vec3 at(uint32_t v) const {
    return {positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]};
  }
  uint32_t addVertex(Vec3 p);
  void addFace(uint32_t a, uint32_t b, uint32_t c) { faces.insert(faces.end(), {a, b, c}); }
  /// The middle of a face.
  Vec3 middle(uint32_t f) const;
};

/// Closed surfaces wound outwards, about the origin.
TestMesh sphereMesh(uint32_t levels);  // of radius 1: an icosahedron divided `levels` times
TestMesh torusMesh(uint32_t around, uint32_t along, double tube = 0.4);  // centre line of radius 1
TestMesh boxMesh(uint32_t n);  // [-1, 1]^3, n x n squares a side
/// Of radius 1, z in [-height / 2, height / 2]; open at both ends.
TestMesh tubeMesh(uint32_t around, uint32_t rows, double height);
/// The graph z = bend x y over [-1, 1]^2, n x n squares, wound upwards.
TestMesh saddleMesh(uint32_t n, double bend);
/// One strip of 2 m triangles with a half twist.
TestMesh moebiusMesh(uint32_t m);
/// m x n squares; every way round it the long way comes back mirrored.
TestMesh kleinMesh(uint32_t m, uint32_t n);

using PlaceTest = std::function<bool(Vec3)>;
/// Without the faces whose middles are at such a place. Vertices stay, with their numbers.
TestMesh without(const TestMesh& mesh, const PlaceTest& isGone);
/// Whether a place is nearer to `centre` than `radius`; or farther than `inner` too.
PlaceTest isNear(Vec3 centre, double radius);
PlaceTest isBetween(Vec3 centre, double inner, double radius);
/// Only vertices that faces use.
TestMesh compact(const TestMesh& mesh);
/// Every face with vertices of its own.
TestMesh soup(const TestMesh& mesh);
TestMesh together(const TestMesh& a, const TestMesh& b);
TestMesh turnedOver(const TestMesh& mesh);
/// Points moved at random by up to `noise` in every coordinate.
TestMesh noisy(const TestMesh& mesh, double noise, Random& random);
TestMesh mapped(const TestMesh& mesh, const std::function<Vec3(Vec3)>& map);
/// Vertices and faces in another order; `from[v]` is the old number of vertex v.
TestMesh shuffled(const TestMesh& mesh, Random& random, std::vector<uint32_t>& from);

/// Edges of the input with one face only, as its half-edges run.
std::vector<std::pair<uint32_t, uint32_t>> openEdges(const TestMesh& mesh);

}  // namespace sftest
