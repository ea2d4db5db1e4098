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
#include "polygon/strips/strips.h"
#include "surface/density.h"
#include "surface/edge_tree.h"
#include "surface/model.h"

namespace sf {

/// Vertices have numbers that last: in an update each vertex that is still there keeps its own, and those of others are given
/// to new ones.
struct FaceMesh {
  enum class Role : uint8_t { None, Edge, Grid, Added };
  std::vector<Vec3> positions, normals;  // unit normals, on the surface's side
  std::vector<Point2> uvs;
  std::vector<Role> roles;          // None: a number that no vertex has now
  std::vector<uint32_t> unused;     // these numbers
  std::vector<uint32_t> triangles;  // [3m] counter-clockwise seen from where normals point
  std::vector<uint32_t> strips, stripStarts;
  // For each use, vertices from where the loop enters it to where it leaves it.
  std::vector<uint32_t> useVertices, useStarts;
  // The same vertices before those at poles were made one, and the parameters of the edges there.
  std::vector<uint32_t> usePlaces;
  std::vector<double> useTs;
  double deviation = 0;  // largest measured
  double excess = 0;     // largest as a share of what is allowed

  // What the next update begins with.
  std::vector<double> us, vs;
  std::vector<uint32_t> gridVertices;  // [us vs] or kNone
  struct Strip {
    bool rises;  // which diagonal its quads have: from the lower left, or from the upper left
    double off;  // their largest deviation
  };
  std::vector<Strip> gridStrips;
  // Corners of the polygon that are one vertex in space, at a pole, are several here; `pole` names the vertex.
  std::vector<uint32_t> poles;      // [vertices] itself, or that vertex
  std::vector<uint32_t> band;       // [3b] triangles between grid and trimming curves
  std::vector<double> bandOff;      // [b] their largest deviation
  std::vector<uint32_t> bandTwins;  // [3b]
  StripLinks bandLinks;
  std::vector<uint32_t> border;  // vertices that are on the band's border or islands in it

  /// Empties it; its memory stays for the next run.
  void clear();
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
  // EdgeOff: the surface is off an edge, as where it has a bend that was not seen; it needs more samples.
  enum class Kind { None, Crossing, EdgeOff, Ended } kind = Kind::None;
  // The uses, counted in the model, and the sample in each where the interval at fault begins.
  SurfaceFault fault = SurfaceFault::Degenerate;
  uint32_t use = kNone, sample = kNone, otherUse = kNone, otherSample = kNone;
  uint32_t loop = kNone, otherLoop = kNone;  // counted in the face
  // Of EdgeOff: all such intervals.
  struct Interval {
    uint32_t use, sample;
  };
  std::vector<Interval> off;
};

class FaceMesher {
 public:
  explicit FaceMesher(const Model& model);
  ~FaceMesher();

  /// Meshes a face. `lines` may be refined where the grid is measured to be off.
  ///   allowance  most distance of mesh and surface
  ///   acceptsEdges  edges are not told to be off: no more samples are to be had
  ///   mesh       with `updates` that of an earlier run, of which whatever still fits stays; after a problem it is empty
  FaceProblem run(uint32_t face, const EdgeSamples& samples, Density& density,
                  Density::Lines& lines, const Allowance& allowance, bool updates,
                  bool acceptsEdges, Work& work, FaceMesh& mesh);

  /// Forgets the places of a use in the domain, when its curve or its edge has become another one.
  void forget(uint32_t use);

  /// Only whether the rings of a face are those of a polygon.
  FaceProblem check(uint32_t face, const EdgeSamples& samples, Work& work);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sf
