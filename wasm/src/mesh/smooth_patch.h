// A patch refined and faired so that it cannot be told from the surface, and meets nothing on the way.
// Source: Zou, Ju, Carr 2013, sec. 5; Liepa 2003.
// Differs: first with few vertices, then with all: the coarse patch finds the shape, from which the density is right
// everywhere, and one or two more steps do for the fine one. If the result meets the mesh or itself, the patch is
// refined and faired at once, and goes only so far from where it was that it does not.
#pragma once
#include <cstdint>

#include "base/status.h"
#include "base/work.h"
#include "mesh/bvh.h"
#include "mesh/fair.h"
#include "mesh/intersect.h"
#include "mesh/local_surface.h"
#include "mesh/refine.h"

namespace sf {

/// The order of fairing that fits the surroundings: 2 where they are rough, else 3. False when the work ended.
bool findFairOrder(const LocalSurface& surface, Work& work, uint32_t& order);

/// Triangles of a patch, and what they intersect.
struct PatchPairs {
  std::vector<FacePair> own;     // two of the surface's triangles
  std::vector<FacePair> others;  // one of the surface's, and a face of the mesh around
  size_t count() const { return own.size() + others.size(); }
};

/// Finds them: of each kind `most` or a few more, and then no more. False when the work ended.
bool findPatchPairs(const LocalSurface& surface, MeshView mesh, const TriangleTree& tree,
                    size_t most, Work& work, PatchPairs& pairs);

/// Refines and fairs. `fairing.order` 0 only refines, `refining.density` 0 only fairs.
/// Errors: OutOfMemory, Stopped; the surface is then in between.
Status smoothPatch(LocalSurface& surface, const RefineOptions& refining, const FairOptions& fairing,
                   Work& work, Fairness& result);

struct Smoothed {
  Fairness fairness;
  double share = 1;    // how far the vertices went of the way that fairing asked for
  uint32_t pairs = 0;  // of triangles that still intersect: those of the patch before fairing
};

/// The same, without intersections of the patch with itself and with a mesh where the patch had none before.
///   mesh, tree  all of the mesh around, in the places of the surface's fixed vertices; the surroundings are in it
///   inFloats    whether coordinates of new vertices are rounded to single precision first
Status smoothPatchApart(LocalSurface& surface, const RefineOptions& refining,
                        const FairOptions& fairing, MeshView mesh, const TriangleTree& tree,
                        bool inFloats, Work& work, Smoothed& result);

}  // namespace sf
