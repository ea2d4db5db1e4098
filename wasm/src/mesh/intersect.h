// Where surfaces intersect themselves and each other: exact, by tests of the side of a plane alone.
// Source: Guigue, Devillers 2003, "Fast and robust triangle-triangle overlap test using orientation predicates", for
// the idea; the tests here are those of segments with triangles, which need fewer cases.
#pragma once
#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "base/work.h"
#include "mesh/bvh.h"
#include "mesh/mesh.h"

namespace sf {

/// Whether two triangles have a point in common besides the vertices and sides that they share. Vertices at the same
/// place are the same, whatever their numbers. Two triangles on the same three vertices intersect; so do coplanar
/// ones that overlap, and those where a vertex of one touches the other. Triangles whose vertices lie on a line are
/// no surface, and intersect nothing.
/// Exact in the range of base/predicates.h.
bool trianglesIntersect(const Vec3 (&a)[3], const Vec3 (&b)[3]);

struct FacePair {
  uint32_t first, second;
};
inline bool operator==(FacePair a, FacePair b) {
  return a.first == b.first && a.second == b.second;
}
inline bool operator<(FacePair a, FacePair b) {
  return a.first != b.first ? a.first < b.first : a.second < b.second;
}

/// Appends the pairs of a face in [from, to) of `mesh` and a face in the tree that intersect.
///   other  the mesh that the tree was made for
///   most   pairs to find: it ends early with more
/// Exact for coordinates within 2^-200 of the largest. O(log m) time a face and pair. False when the work ended.
bool findIntersections(MeshView mesh, uint32_t from, uint32_t to, MeshView other,
                       const TriangleTree& tree, size_t most, Work& work,
                       std::vector<FacePair>& pairs);

/// Appends the pairs of faces in [from, to) that intersect each other, first < second.
bool findSelfIntersections(MeshView mesh, uint32_t from, uint32_t to, size_t most, Work& work,
                           std::vector<FacePair>& pairs);

}  // namespace sf
