#include "mesh/weld.h"

#include <cmath>

#include "base/hash.h"

namespace sf {
namespace {

/// Kept vertices in chains by the hash of their cells. Cells are as large as the radius; without
/// one, every position is its own cell.
class Welder {
 public:
  Welder(double radius, uint32_t buckets, const std::vector<double>& kept)
      : radius_(radius), mask_(buckets - 1), heads_(buckets, kNone), kept_(kept) {}

  /// The first kept vertex that p is welded to, or kNone.
  uint32_t find(Vec3 p) const {
    const Vec3 cell = cellOf(p);
    if (radius_ == 0) return findIn(cell, p, kNone);
    uint32_t first = kNone;
    for (int i = 0; i < 27; ++i)
      first = findIn(cell + Vec3{i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0}, p, first);
    return first;
  }

  /// Adds the last of the kept ones.
  void add(Vec3 p) {
    uint32_t& head = heads_[hashOf(cellOf(p)) & mask_];
    next_.push_back(head);
    head = uint32_t(next_.size()) - 1;
  }

 private:
  Vec3 cellOf(Vec3 p) const {
    if (radius_ == 0) return p;
    return {std::floor(p.x / radius_), std::floor(p.y / radius_), std::floor(p.z / radius_)};
  }
  uint32_t findIn(Vec3 cell, Vec3 p, uint32_t first) const {
    for (uint32_t i = heads_[hashOf(cell) & mask_]; i != kNone; i = next_[i]) {
      const double* q = &kept_[3 * size_t(i)];
      // Scaled, so that squares keep in range.
      const bool isNear = radius_ == 0 ? p == Vec3{q[0], q[1], q[2]}
                                       : length({(p.x - q[0]) / radius_, (p.y - q[1]) / radius_,
                                                 (p.z - q[2]) / radius_}) <= 1;
      if (isNear && i < first) first = i;
    }
    return first;
  }

  double radius_;
  uint32_t mask_;
  std::vector<uint32_t> heads_, next_;  // next_[i] is in the chain of kept vertex i
  const std::vector<double>& kept_;
};

}  // namespace

bool weldVertices(const MeshView& mesh, double radius, Work& work, Charge& charge,
                  WeldedMesh& result) {
  const uint32_t n = uint32_t(mesh.positions.size() / 3);
  uint32_t buckets = 16;
  while (buckets < n && buckets < (1u << 30)) buckets *= 2;
  Charge temporary(work);
  if (!charge.add(mesh.positions.size() * sizeof(double) +
                  (mesh.faces.size() + n) * sizeof(uint32_t)) ||
      !temporary.add((uint64_t(buckets) + 2 * uint64_t(n)) * sizeof(uint32_t)))
    return false;
  result = {};
  result.positions.reserve(mesh.positions.size());
  result.vertexMap.reserve(n);
  Welder welder(radius, buckets, result.positions);
  for (uint32_t v = 0; v < n; ++v) {
    if (v % 1024 == 0 && !work.tick(1024 * (radius == 0 ? 50 : 1000))) return false;
    const double* p = &mesh.positions[3 * size_t(v)];
    const Vec3 at{p[0], p[1], p[2]};
    uint32_t kept = welder.find(at);
    if (kept == kNone) {
      kept = uint32_t(result.positions.size() / 3);
      result.positions.insert(result.positions.end(), p, p + 3);
      welder.add(at);
    }
    result.vertexMap.push_back(kept);
  }
  result.faces.reserve(mesh.faces.size());
  for (const uint32_t v : mesh.faces) result.faces.push_back(result.vertexMap[v]);
  return work.tick(uint32_t(mesh.faces.size()));
}

}  // namespace sf
