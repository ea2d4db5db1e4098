#include "mesh/body.h"

#include "base/union_find.h"

namespace sf {
namespace {

/// Adds a triangle of the closed surface, seen from `origin`.
void addTriangle(Body& body, Vec3 origin, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 normal = cross(b - a, c - a);
  body.area += length(normal) / 2;
  body.volume += dot(normal, a - origin) / 6;
}

}  // namespace

bool findBodies(const MeshView& mesh, const Adjacency& adjacency, const Rims& rims,
                const Grouping& groups, Work& work, Charge& charge, std::vector<Body>& result) {
  const Adjacency& a = adjacency;
  const UnitScale at(mesh.positions);
  if (!charge.add(a.components * (sizeof(uint32_t) + sizeof(Vec3) + sizeof(Body)))) return false;
  UnionFind bodies(a.components);
  for (uint32_t g = 0; g < groups.count(); ++g) {
    const uint32_t first = rims.rims[groups.rims[groups.starts[g]]].component;
    for (uint32_t i = groups.starts[g]; i < groups.starts[g + 1]; ++i) {
      const uint32_t r = groups.rims[i];
      for (uint32_t e = rims.starts[r]; e < rims.starts[r + 1]; ++e)
        bodies.unite(a.component[rims.halves[e] / 3], first);
    }
  }
  result.assign(a.components, {});
  for (size_t i = 0; i < a.seams.size(); i += 2)
    result[bodies.rootOf(a.component[a.seams[i] / 3])].isOrientable = false;
  // Any place near the body keeps its volume exact.
  std::vector<Vec3> origins(a.components, Vec3{0, 0, 0});
  bool hasOpen = false;
  for (uint32_t g = 0; g < groups.count(); ++g) {
    if (!groups.isOpenRim[g]) continue;
    const uint32_t rim = groups.rims[groups.starts[g]], b = bodies.rootOf(rims.rims[rim].component);
    ++result[b].openGroups, result[b].openGroup = g;
    origins[b] = at(rims.vertices[rims.starts[rim]]);
    hasOpen = true;
  }
  if (!hasOpen) return true;
  for (uint32_t f = 0; f < a.component.size(); ++f) {
    if (f % 4096 == 0 && !work.tick(4096 * 10)) return false;
    if (a.component[f] == kNone) continue;
    const uint32_t b = bodies.rootOf(a.component[f]);
    if (result[b].openGroups != 1) continue;
    addTriangle(result[b], origins[b], at(a.tail(3 * f)), at(a.tail(3 * f + 1)),
                at(a.tail(3 * f + 2)));
  }
  for (uint32_t r = 0; r < rims.count(); ++r) {
    const uint32_t b = bodies.rootOf(rims.rims[r].component),
                   n = rims.starts[r + 1] - rims.starts[r];
    if (result[b].openGroups != 1) continue;
    Vec3 middle{0, 0, 0};
    for (uint32_t e = rims.starts[r]; e < rims.starts[r + 1]; ++e)
      middle = middle + (1.0 / n) * at(rims.vertices[e]);
    for (uint32_t e = rims.starts[r]; e < rims.starts[r + 1]; ++e)
      addTriangle(result[b], origins[b], at(rims.vertices[e]),
                  at(rims.vertices[rims.nextEdge(r, e)]), middle);
  }
  return work.tick(100);
}

}  // namespace sf
