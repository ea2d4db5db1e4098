// The flat arrays of a model's mesh, in which each face has a block of its own.
//
// Source: Kumar, sec. 5, keeps the strips of each patch between frames.
// Differs: what an update has changed is told as ranges, so that no more than these goes to the graphics card. A face that
// outgrows its block gets vertices elsewhere, and room for triangles from its neighbours.
#pragma once
#include <cstdint>
#include <vector>

#include "surface/face_mesh.h"

namespace sf {

class MeshLayout {
 public:
  std::vector<float> positions, normals, uvs;
  std::vector<uint32_t> triangles, strips;
  std::vector<uint32_t> faceStarts;    // [f+1] in triangles
  std::vector<uint32_t> stripStarts;   // [s+1]
  std::vector<uint32_t> vertexStarts;  // [f] where the vertices of each face begin
  // Pairs of ends of what the last call has written: of vertices, of `triangles`, of `strips`.
  std::vector<uint32_t> vertexRanges, indexRanges, stripRanges;

  /// Lays out all faces without room to grow.
  ///   isReversed  [f] faces whose normals are turned round
  void layOut(const std::vector<FaceMesh>& meshes, const std::vector<uint8_t>& isReversed,
              Vec3 origin);
  /// Writes the faces that have changed. Arrays only grow. False if all was laid out again, with room for faces to grow: at the
  /// first call after layOut, and where vertices have left more behind than there are. Room is filled with triangles and
  /// strips of a single vertex, which are not drawn.
  ///   faces  rising
  bool rewrite(const std::vector<FaceMesh>& meshes, const std::vector<uint8_t>& isReversed,
               const std::vector<uint32_t>& faces);

  uint32_t vertices() const { return uint32_t(positions.size() / 3); }

 private:
  void layOut(const std::vector<FaceMesh>& meshes, const std::vector<uint8_t>& isReversed,
              double slack);
  bool moveVertices(const std::vector<FaceMesh>& meshes, const std::vector<uint32_t>& faces);
  template <class Size>
  void makeRoom(std::vector<uint32_t>& starts, uint32_t face, Size&& sizeOf);
  void writeVertices(uint32_t face, const FaceMesh& mesh, bool isReversed);
  void writeIndices(uint32_t face, const FaceMesh& mesh);
  void writeStripStarts(const std::vector<FaceMesh>& meshes);

  std::vector<uint32_t> vertexRooms_;  // [f]
  std::vector<uint32_t> stripBlocks_;  // [f+1] in `strips`
  uint32_t vertexEnd_ = 0;             // of all blocks of vertices
  std::vector<uint8_t> isMoved_;       // [f] whether indices have another place in this call
  bool isRoomy_ = false;
  Vec3 origin_{};
};

}  // namespace sf
