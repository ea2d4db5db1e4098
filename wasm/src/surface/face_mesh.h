// The mesh of one face for given samples of its edges and given grid lines.
//
// Source: Kumar, sec. 3, 4: quads of the grid, in strips, and triangles between them and the trimming curves.
// Differs: triangles between are those of flooding, made constrained Delaunay, in the domain scaled to lengths in space; how
// far they are off the surface is measured, and points are added inside where it is too far, never on trimming curves.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "base/work.h"
#include "surface/density.h"
#include "surface/edge_tree.h"
#include "surface/model.h"

namespace sf {

struct FaceMesh {
  std::vector<Vec3> positions, normals;  // unit normals, on the face's side
  std::vector<Point2> uvs;
  uint32_t edgeVertices = 0;        // the first vertices, which are samples of edges
  std::vector<uint32_t> triangles;  // [3m] counter-clockwise seen from where normals point
  std::vector<uint32_t> strips, stripStarts;
  // For each use, vertices from where the loop enters it to where it leaves it.
  std::vector<uint32_t> useVertices, useStarts;
  double deviation = 0;  // largest measured
};

/// The samples of all edges of a model.
struct EdgeSamples {
  std::vector<std::vector<EdgeSample>> of;  // [edges]
  std::vector<uint32_t>
      firstPlace;  // [edges] the number of the sample after the first; ends have those of vertices
  uint32_t places = 0;
};

/// What keeps a face from being meshed.
struct FaceProblem {
  enum class Kind { None, Crossing, Ended } kind = Kind::None;
  // Of a crossing: the uses, counted in the model, and the sample in each where the interval at fault begins.
  SurfaceFault fault = SurfaceFault::Degenerate;
  uint32_t use = kNone, sample = kNone, otherUse = kNone, otherSample = kNone;
  uint32_t loop = kNone, otherLoop = kNone;  // counted in the face
};

class FaceMesher {
 public:
  FaceMesher(const Model& model, Work& work);
  ~FaceMesher();

  /// Meshes a face. `lines` may be refined where the grid is measured to be off.
  ///   tolerance  most distance of mesh and surface
  FaceProblem run(uint32_t face, const EdgeSamples& samples, Density& density,
                  Density::Lines& lines, double tolerance, FaceMesh& mesh);

  /// Only whether the rings of a face are those of a polygon.
  FaceProblem check(uint32_t face, const EdgeSamples& samples);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sf
