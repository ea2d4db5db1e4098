// A surface by itself, smoothed between its boundary: a soap film, or a plate.
//
// Source: Pinkall, Polthier 1993, for films (`soap_film.h`); Botsch, Kobbelt 2004, for plates (`fair.h`).
#pragma once
#include <cstdint>
#include <vector>

#include "base/status.h"
#include "base/work.h"
#include "mesh/mesh.h"

namespace sf {

enum class SurfaceKind : uint8_t { SoapFilm, ThinPlate, Curvature };

struct SmoothOptions {
  SurfaceKind kind = SurfaceKind::SoapFilm;
  double density = 1.4142135623730951;  // as in RefineOptions
  uint32_t maxNewVertices = 0xFFFFFFFFu;
};

struct SmoothSurface {
  std::vector<double> positions;    // [3n'] the boundary's vertices as they were, then those inside
  std::vector<uint32_t> triangles;  // [3m'] wound as in the input
  std::vector<uint32_t> boundary;   // [b] input numbers of the first b vertices
  std::vector<uint32_t>
      collapsed;  // vertices where no film exists, and the surface has shrunk to a thread
  double area = 0;
  bool isMinimal = false;  // soap films: a further step would move nothing
};

/// Smooths a surface whose boundary stays where it is.
///   mesh  manifold, oriented, with a boundary; vertices of no triangle are left out
/// Errors: BadSurface for what is not such, with the face as `vertex`; OutOfMemory, Stopped.
Outcome smoothSurface(const MeshView& mesh, const SmoothOptions& options, Work& work,
                      SmoothSurface& result);

}  // namespace sf
