// Which faces of a mesh lie beside each other, whatever is wrong with it.
//
// The mesh is repaired in this adjacency alone, and never changed: faces that cannot count are left
// out, faces that are wound against their neighbours are turned, edges of more than two faces are
// cut, and a vertex where several fans of faces meet is split. Every repair is told as a defect.
//
// Source: Gueziec, Taubin, Lazarus, Horn 2001, "Cutting and stitching: converting sets of polygons
// to manifold surfaces", sec. 3, for working vertices, one for every fan of corners.
// Differs: faces at an edge of several are paired by their angles first, where that is clear.
#pragma once
#include <cstdint>
#include <vector>

#include "base/charge.h"
#include "base/vec.h"
#include "mesh/mesh.h"
#include "triangles/triangle_mesh.h"

namespace sf {

enum class DefectKind : uint8_t {
  NonManifoldEdge,  // edges [2e]: of three faces or more; faces: those left without a neighbour there
  NonManifoldVertex,  // vertices: of several fans of faces, other than the ends of `NonManifoldEdge`s
  Flipped,            // faces: turned, in the adjacency
  DuplicateFace,      // faces: on the vertices of an earlier one, in any order; left out
  DegenerateFace,     // faces: with a vertex twice; left out
  NotOrientable,      // edges [2e]: where components were cut; faces: beside them
  UnusedVertex,       // vertices: of no face, or only of faces left out
};

/// All places of one kind, each list by increasing number.
struct Defect {
  DefectKind kind;
  std::vector<uint32_t> faces, edges, vertices;  // of the input; an edge as two vertices
};

/// Half-edge 3f + i is of face f. It runs from `corners` of it to that of the next half-edge of f.
/// A turned face lists its corners as a, c, b in place of a, b, c.
struct Adjacency {
  std::vector<uint32_t> corners;  // [3m] working vertices; kNone in faces left out
  std::vector<uint32_t> twins;    // [3m] or kNone: of the rim, cut, or of a face left out
  std::vector<uint8_t> turned;    // [m] 1 if the face is used the other way round
  std::vector<uint32_t>
      component;  // [m] connected by edges, cut ones of `seams` too; kNone if left out
  uint32_t components = 0;
  uint32_t vertices = 0;          // n, those of the input, which are working vertices too
  std::vector<uint32_t> splitOf;  // [w - n] input vertices of the further working vertices
  std::vector<uint32_t> cut;      // half-edges left open at non-manifold edges, by number
  std::vector<uint32_t> seams;    // [2s] half-edge, and the one across that runs the *same* way,
                                  // each pair in both orders, by the first
  std::vector<Defect> defects;    // one of a kind at most, in the order of DefectKind

  uint32_t inputVertex(uint32_t v) const { return v < vertices ? v : splitOf[v - vertices]; }
  /// Input vertices at the two ends of a half-edge.
  uint32_t tail(uint32_t h) const { return inputVertex(corners[h]); }
  uint32_t head(uint32_t h) const { return inputVertex(corners[nextInTriangle(h)]); }
  bool isCut(uint32_t h) const;
  /// The half-edge across a seam, or kNone.
  uint32_t acrossSeam(uint32_t h) const;
};

/// Errors: NotFinite with the first vertex that is not finite, or beyond kLargestCoordinate; else BadMesh
/// with the first face that names a vertex that is not there, as `vertex`. O(n + m).
Outcome checkMesh(const MeshView& mesh);

/// Powers of two bring positions to about unit size, so that products neither over- nor underflow.
class UnitScale {
 public:
  explicit UnitScale(ArrayView<const double> positions);
  /// Vertex v of the positions, times `factor`.
  Vec3 operator()(uint32_t v) const {
    const double* p = positions_ + 3 * size_t(v);
    return {factor * p[0], factor * p[1], factor * p[2]};
  }
  double factor = 1;

 private:
  const double* positions_;
};

/// Finds twins, and lists what had to be repaired for them.
///   mesh  finite, faces in range (checkMesh); fewer than 2^32 / 3 faces
/// Where windings disagree, the faces of more area in the component keep theirs; of equal area, the first
/// face does. O(n + m) time but for sorting around vertices of very many faces. Memory of the result
/// is charged to `charge`. False once `work` has to end.
bool buildAdjacency(const MeshView& mesh, Work& work, Charge& charge, Adjacency& result);

}  // namespace sf
