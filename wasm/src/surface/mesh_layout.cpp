#include "surface/mesh_layout.h"

#include <algorithm>
#include <cmath>

namespace sf {
namespace {

/// Ranges nearer to each other than this are one: a call to the graphics card costs more than what lies between.
constexpr uint32_t kNearRange = 32;
/// Room for faces to grow, as a share of what they have.
constexpr double kSlack = 0.5;
/// Where neighbours make room for each other, they keep at least this share of what they have.
constexpr double kLeastSlack = 0.15;

/// Room for so much. A face of nothing has none either: nothing could fill it.
uint32_t roomFor(size_t size, double slack) {
  const double more = slack * double(size) + (slack > 0 && size > 0 ? 16 : 0);
  return uint32_t(size + size_t(std::ceil(more)));
}

void addRange(std::vector<uint32_t>& ranges, uint32_t from, uint32_t to) {
  if (from == to) return;
  if (!ranges.empty() && from <= ranges.back() + kNearRange && from >= ranges[ranges.size() - 2])
    ranges.back() = std::max(ranges.back(), to);
  else
    ranges.push_back(from), ranges.push_back(to);
}

}  // namespace

void MeshLayout::writeVertices(uint32_t face, const FaceMesh& mesh, bool isReversed) {
  const uint32_t base = vertexStarts[face];
  // Whether that writes other values.
  const auto put = [](float* to, const float* from, size_t count) {
    if (std::equal(from, from + count, to)) return false;
    std::copy(from, from + count, to);
    return true;
  };
  for (uint32_t v = 0; v < mesh.positions.size(); ++v) {
    if (mesh.roles[v] == FaceMesh::Role::None) continue;
    const Vec3 p = mesh.positions[v] - origin_, n = isReversed ? -mesh.normals[v] : mesh.normals[v];
    const float at[] = {float(p.x), float(p.y), float(p.z)},
                normal[] = {float(n.x), float(n.y), float(n.z)},
                uv[] = {float(mesh.uvs[v].x), float(mesh.uvs[v].y)};
    const size_t i = size_t(base) + v;
    bool isNew = put(&positions[3 * i], at, 3);
    isNew |= put(&normals[3 * i], normal, 3);
    isNew |= put(&uvs[2 * i], uv, 2);
    if (isNew) addRange(vertexRanges, uint32_t(i), uint32_t(i) + 1);
  }
}

void MeshLayout::writeIndices(uint32_t face, const FaceMesh& mesh) {
  const uint32_t base = vertexStarts[face];
  const auto write = [&](const std::vector<uint32_t>& from, std::vector<uint32_t>& to,
                         uint32_t first, uint32_t end, std::vector<uint32_t>& ranges) {
    for (uint32_t i = first; i < end; ++i) {
      const uint32_t k = i - first, value = base + (k < from.size() ? from[k] : 0);
      if (to[i] == value) continue;
      to[i] = value;
      addRange(ranges, i, i + 1);
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
                        Vec3 origin) {
  origin_ = origin;
  layOut(meshes, isReversed, 0.0);
}

void MeshLayout::layOut(const std::vector<FaceMesh>& meshes, const std::vector<uint8_t>& isReversed,
                        double slack) {
  isRoomy_ = slack > 0;
  vertexStarts.clear(), vertexRooms_.clear(), vertexEnd_ = 0;
  faceStarts.assign(1, 0), stripBlocks_.assign(1, 0);
  for (const FaceMesh& mesh : meshes) {
    vertexStarts.push_back(vertexEnd_);
    vertexRooms_.push_back(roomFor(mesh.positions.size(), slack));
    vertexEnd_ += vertexRooms_.back();
    faceStarts.push_back(faceStarts.back() + roomFor(mesh.triangles.size() / 3, slack));
    stripBlocks_.push_back(stripBlocks_.back() + roomFor(mesh.strips.size(), slack));
  }
  const size_t n = vertexEnd_;
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

/// Gives vertices that outgrow their block another one behind all others. False if more than half of the places would then be
/// of no use.
bool MeshLayout::moveVertices(const std::vector<FaceMesh>& meshes,
                              const std::vector<uint32_t>& faces) {
  uint32_t end = vertexEnd_;
  for (const uint32_t f : faces) {
    const size_t size = meshes[f].positions.size();
    if (size <= vertexRooms_[f]) continue;
    vertexStarts[f] = end, vertexRooms_[f] = roomFor(size, kSlack);
    end += vertexRooms_[f];
  }
  if (end == vertexEnd_) return true;
  size_t used = 0;
  for (const uint32_t room : vertexRooms_) used += room;
  if (end > 2 * used) return false;
  vertexEnd_ = end;
  if (end > vertices()) {
    // Not for each face that grows a little.
    const size_t n = end + end / 4;
    positions.resize(3 * n, 0), normals.resize(3 * n, 0), uvs.resize(2 * n, 0);
  }
  return true;
}

/// Moves the blocks around a face, as few as have enough room together, so that each has some again. Where all have too little
/// there is more room at the end.
///   starts  [f+1] blocks
///   sizeOf  what each face needs
template <class Size>
void MeshLayout::makeRoom(std::vector<uint32_t>& starts, uint32_t face, Size&& sizeOf) {
  const uint32_t count = uint32_t(starts.size()) - 1;
  if (sizeOf(face) <= starts[face + 1] - starts[face]) return;
  uint32_t first = face, end = face + 1;
  size_t needed = sizeOf(face);
  for (;;) {
    if (double(starts[end] - starts[first]) >= (1 + kLeastSlack) * double(needed)) break;
    if (first == 0 && end == count) {
      starts[count] = roomFor(needed, kSlack);
      break;
    }
    const uint32_t more = end - first;
    for (uint32_t k = 0; k < more && first > 0; ++k) needed += sizeOf(--first);
    for (uint32_t k = 0; k < more && end < count; ++k) needed += sizeOf(end++);
  }
  const uint32_t room = starts[end] - starts[first];
  const double slack = (double(room) - double(needed)) / double(needed);
  // Of all that is left over the last face that has anything has the rest.
  uint32_t at = starts[first];
  for (uint32_t f = first; f < end; ++f) {
    starts[f] = at, isMoved_[f] = 1;
    at += uint32_t(double(sizeOf(f)) * (1 + slack));
  }
  for (uint32_t f = end; f-- > first && sizeOf(f) == 0;) starts[f] = starts[end];
}

bool MeshLayout::rewrite(const std::vector<FaceMesh>& meshes,
                         const std::vector<uint8_t>& isReversed,
                         const std::vector<uint32_t>& faces) {
  vertexRanges.clear(), indexRanges.clear(), stripRanges.clear();
  if (faces.empty()) return true;
  if (!isRoomy_ || !moveVertices(meshes, faces)) {
    layOut(meshes, isReversed, kSlack);
    return false;
  }
  isMoved_.assign(meshes.size(), 0);
  for (const uint32_t f : faces) {
    isMoved_[f] = 1;
    makeRoom(faceStarts, f, [&](uint32_t g) { return meshes[g].triangles.size() / 3; });
    makeRoom(stripBlocks_, f, [&](uint32_t g) { return meshes[g].strips.size(); });
  }
  if (triangles.size() < 3 * size_t(faceStarts.back()))
    triangles.resize(3 * size_t(faceStarts.back()), kNone);
  if (strips.size() < stripBlocks_.back()) strips.resize(stripBlocks_.back(), kNone);
  for (const uint32_t f : faces) writeVertices(f, meshes[f], isReversed[f] != 0);
  for (uint32_t f = 0; f < meshes.size(); ++f)
    if (isMoved_[f]) writeIndices(f, meshes[f]);
  writeStripStarts(meshes);
  return true;
}

}  // namespace sf
