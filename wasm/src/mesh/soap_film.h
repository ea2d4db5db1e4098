// Soap films: from a triangulation to the minimal surface on its loops.
// Source: Pinkall, Polthier 1993, "Computing discrete minimal surfaces and their conjugates": harmonic maps from the
// present surface, one after the other.
// Differs: flips and settling between the steps; at the end Newton's steps along the normals, which double the digits
// each time, where the film is stable.
#pragma once
#include <cstdint>
#include <vector>

#include "base/status.h"
#include "base/work.h"
#include "mesh/local_surface.h"
#include "mesh/refine.h"

namespace sf {

struct FilmOptions {
  RefineOptions refining;   // before the first step; density 0: none
  uint32_t steps = 60;      // at most
  double tolerance = 1e-7;  // of the extent: a step that moves nothing farther is the last one
};

struct Film {
  double area = 0;
  uint32_t steps = 0;
  bool isMinimal = false;  // the last step was within the tolerance
  /// Free vertices where the surface has shrunk to a thread: a neck for which there is no film.
  std::vector<uint32_t> collapsed;
};

/// Lets the patch of a surface take the shape of a soap film: vertices from `fixedVertices` on move.
/// Errors: OutOfMemory, Stopped; the surface is then as after some step.
Status relaxToFilm(LocalSurface& surface, const FilmOptions& options, Work& work, Film& result);

}  // namespace sf
