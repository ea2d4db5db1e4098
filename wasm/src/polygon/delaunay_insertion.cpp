#include "polygon/delaunay_insertion.h"

#include <cmath>

#include "base/charge.h"
#include "polygon/constrained_mesh.h"

namespace sf {
namespace {

// Writes the triangles to the left of fixed edges, and what is connected with them.
void collectInside(const ConstrainedMesh& constrained, std::vector<uint32_t>& triangles) {
  const TriangleMesh& mesh = constrained.mesh;
  std::vector<bool> inside(mesh.triangleCount(), false);
  std::vector<uint32_t> stack;
  triangles.clear();
  const auto enter = [&](uint32_t t) {
    if (inside[t]) return;
    inside[t] = true;
    stack.push_back(t);
    for (uint32_t h = 3 * t; h < 3 * t + 3; ++h)
      triangles.push_back(mesh.corners[h] - ConstrainedMesh::kCorners);
  };
  for (uint32_t h = 0; h < mesh.corners.size(); ++h) {
    if (!mesh.inUse(h / 3) || constrained.next[mesh.from(h)] != mesh.to(h)) continue;
    enter(h / 3);
    while (!stack.empty()) {
      const uint32_t t = stack.back();
      stack.pop_back();
      for (uint32_t g = 3 * t; g < 3 * t + 3; ++g)
        if (mesh.twins[g] != kNone && !constrained.isFixed(g)) enter(mesh.twins[g] / 3);
    }
  }
}

}  // namespace

bool delaunayByInsertion(const LinkedPolygon& linked, Work& work,
                         std::vector<uint32_t>& triangles) {
  constexpr uint32_t kShift = ConstrainedMesh::kCorners;
  const uint32_t nodes = uint32_t(linked.at.size());
  Charge charge(work);
  if (!charge.add(250 * uint64_t(nodes))) return false;
  double largest = 0;
  std::vector<uint32_t> vertices, next(kShift + nodes, kNone);
  for (uint32_t v = 0; v < nodes; ++v) {
    if (linked.kind[v] == VertexKind::Unused) continue;
    vertices.push_back(v + kShift);
    if (linked.kind[v] != VertexKind::Island) next[v + kShift] = linked.next[v] + kShift;
    largest = std::fmax(largest, std::fmax(std::fabs(linked.at[v].x), std::fabs(linked.at[v].y)));
  }
  int exponent = 0;
  if (largest > 0) std::frexp(largest, &exponent);
  ConstrainedMesh constrained;
  constrained.reset(std::ldexp(4, exponent), exponent, nodes);
  for (const uint32_t v : vertices) constrained.setPosition(v, linked.at[v - kShift]);
  uint32_t refused;
  ConstrainedMesh::Obstacle obstacle;
  if (!constrained.insertAll(vertices, next, work, refused, obstacle)) return false;
  collectInside(constrained, triangles);
  return true;
}

}  // namespace sf
