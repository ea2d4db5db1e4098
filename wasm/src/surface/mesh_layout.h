// The flat arrays of a model's mesh, in which each face has a block of its own.
//
// Source: Kumar, sec. 5, keeps the strips of each patch between frames.
// Differs: what an update has changed is told as ranges, so that no more than these goes to the graphics card.
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
  std::vector<uint32_t> vertexStarts;  // [f+1] where the vertices of each face begin
  // Pairs of ends of what the last call has written: of vertices, of `triangles`, of `strips`.
  std::vector<uint32_t> vertexRanges, indexRanges, stripRanges;

  /// Lays out all faces.
  ///   isReversed  [f] faces whose normals are turned round
  ///   slack       room that blocks have beyond what they need, as a share of that. Room is filled with triangles and strips
  ///               of a single vertex, which are not drawn
  void layOut(const std::vector<FaceMesh>& meshes, const std::vector<uint8_t>& isReversed,
              Vec3 origin, double slack);
  /// Writes faces that have changed into their blocks. False if one does not fit: all has to be laid out again.
  bool rewrite(const std::vector<FaceMesh>& meshes, const std::vector<uint8_t>& isReversed,
               const std::vector<uint32_t>& faces);

 private:
  void writeVertices(uint32_t face, const FaceMesh& mesh, bool isReversed);
  void writeIndices(uint32_t face, const FaceMesh& mesh);
  void writeStripStarts(const std::vector<FaceMesh>& meshes);

  std::vector<uint32_t> stripBlocks_;  // [f+1] in `strips`
  Vec3 origin_{};
};

}  // namespace sf
