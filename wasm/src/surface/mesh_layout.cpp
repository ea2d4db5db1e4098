#include "surface/mesh_layout.h"

#include <algorithm>
#include <cmath>

namespace sf {
namespace {

/// Ranges nearer to each other than this are one: a call to the graphics card costs more than what lies between.
constexpr uint32_t kNearRange = 32;

void addRange(std::vector<uint32_t>& ranges, uint32_t from, uint32_t to) {
  if (from == to) return;
  if (!ranges.empty() && from <= ranges.back() + kNearRange && from >= ranges[ranges.size() - 2])
    ranges.back() = std::max(ranges.back(), to);
  else
    ranges.push_back(from), ranges.push_back(to);
}

/// Writes a value, and whether it was another one.
template <class T>
bool put(T& to, T value) {
  if (to == value) return false;
  to = value;
  return true;
}

}  // namespace

void MeshLayout::writeVertices(uint32_t face, const FaceMesh& mesh, bool isReversed) {
  const uint32_t base = vertexStarts[face];
  for (uint32_t v = 0; v < mesh.positions.size(); ++v) {
    if (mesh.roles[v] == FaceMesh::Role::None) continue;
    const Vec3 p = mesh.positions[v] - origin_, n = isReversed ? -mesh.normals[v] : mesh.normals[v];
    const size_t i = size_t(base) + v;
    bool isNew = put(positions[3 * i], float(p.x));
    isNew |= put(positions[3 * i + 1], float(p.y));
    isNew |= put(positions[3 * i + 2], float(p.z));
    isNew |= put(normals[3 * i], float(n.x));
    isNew |= put(normals[3 * i + 1], float(n.y));
    isNew |= put(normals[3 * i + 2], float(n.z));
    isNew |= put(uvs[2 * i], float(mesh.uvs[v].x));
    isNew |= put(uvs[2 * i + 1], float(mesh.uvs[v].y));
    if (isNew) addRange(vertexRanges, uint32_t(i), uint32_t(i) + 1);
  }
}

void MeshLayout::writeIndices(uint32_t face, const FaceMesh& mesh) {
  const uint32_t base = vertexStarts[face];
  const auto write = [&](const std::vector<uint32_t>& from, std::vector<uint32_t>& to,
                         uint32_t first, uint32_t end, std::vector<uint32_t>& ranges) {
    for (uint32_t i = first; i < end; ++i) {
      const uint32_t k = i - first;
      if (put(to[i], base + (k < from.size() ? from[k] : 0))) addRange(ranges, i, i + 1);
    }
  };
  write(mesh.triangles, triangles, 3 * faceStarts[face], 3 * faceStarts[face + 1], indexRanges);
  write(mesh.strips, strips, stripBlocks_[face], stripBlocks_[face + 1], stripRanges);
}

void MeshLayout::writeStripStarts(const std::vector<FaceMesh>& meshes) {
  stripStarts.assign(1, 0);
  for (size_t f = 0; f < meshes.size(); ++f) {
    for (size_t s = 1; s < meshes[f].stripStarts.size(); ++s)
      stripStarts.push_back(stripBlocks_[f] + meshes[f].stripStarts[s]);
    if (stripStarts.back() < stripBlocks_[f + 1]) stripStarts.push_back(stripBlocks_[f + 1]);
  }
}

void MeshLayout::layOut(const std::vector<FaceMesh>& meshes, const std::vector<uint8_t>& isReversed,
                        Vec3 origin, double slack) {
  origin_ = origin;
  vertexStarts.assign(1, 0), faceStarts.assign(1, 0), stripBlocks_.assign(1, 0);
  // A face of nothing has no room either: nothing could fill it.
  const auto block = [&](size_t size) {
    return uint32_t(size + size_t(std::ceil(slack * double(size))) +
                    (slack > 0 && size > 0 ? 16 : 0));
  };
  for (const FaceMesh& mesh : meshes) {
    vertexStarts.push_back(vertexStarts.back() + block(mesh.positions.size()));
    faceStarts.push_back(faceStarts.back() + block(mesh.triangles.size() / 3));
    stripBlocks_.push_back(stripBlocks_.back() + block(mesh.strips.size()));
  }
  const size_t n = vertexStarts.back();
  positions.assign(3 * n, 0), normals.assign(3 * n, 0), uvs.assign(2 * n, 0);
  triangles.assign(3 * size_t(faceStarts.back()), kNone), strips.assign(stripBlocks_.back(), kNone);
  for (uint32_t f = 0; f < meshes.size(); ++f) {
    writeVertices(f, meshes[f], isReversed[f] != 0);
    writeIndices(f, meshes[f]);
  }
  writeStripStarts(meshes);
  const auto all = [](std::vector<uint32_t>& ranges, size_t size) {
    ranges.clear();
    if (size > 0) ranges = {0, uint32_t(size)};
  };
  all(vertexRanges, n), all(indexRanges, triangles.size()), all(stripRanges, strips.size());
}

bool MeshLayout::rewrite(const std::vector<FaceMesh>& meshes,
                         const std::vector<uint8_t>& isReversed,
                         const std::vector<uint32_t>& faces) {
  vertexRanges.clear(), indexRanges.clear(), stripRanges.clear();
  for (const uint32_t f : faces)
    if (meshes[f].positions.size() > vertexStarts[f + 1] - vertexStarts[f] ||
        meshes[f].triangles.size() / 3 > faceStarts[f + 1] - faceStarts[f] ||
        meshes[f].strips.size() > stripBlocks_[f + 1] - stripBlocks_[f])
      return false;
  for (const uint32_t f : faces) {
    writeVertices(f, meshes[f], isReversed[f] != 0);
    writeIndices(f, meshes[f]);
  }
  if (!faces.empty()) writeStripStarts(meshes);
  return true;
}

}  // namespace sf
