// A surface by itself, smoothed between its boundary: a soap film, or a plate.
//
// Source: Pinkall, Polthier 1993, for films (`soap_film.h`); Botsch, Kobbelt 2004, for plates (`fair.h`).
#pragma once
#include <cstdint>
#include <vector>

#include "base/array_view.h"
#include "base/status.h"
#include "base/work.h"
#include "mesh/mesh.h"
#include "mesh/refine.h"

namespace sf {

enum class SurfaceKind : uint8_t { SoapFilm, ThinPlate, Curvature };

struct SmoothOptions {
  SurfaceKind kind = SurfaceKind::SoapFilm;
  RefineOptions refining;
  ArrayView<const uint32_t> fixed;  // further vertices that stay where they are
  /// Whether the surface leaves at its boundary as some normals say, for other kinds than films.
  bool isClamped = false;
  /// [3b] for the edges of the boundary, by loops in order of their least vertex, each loop from that on towards the
  /// lesser of its two neighbours there: the normal, of any length, of the surface wound along the loop in that
  /// direction, as in SpanOptions. A NaN triple: not known.
  ArrayView<const double> boundaryNormals;
};

struct SmoothSurface {
  std::vector<double> positions;    // [3n'] the vertices that stay as they were, then all others
  std::vector<uint32_t> triangles;  // [3m'] wound as in the input
  std::vector<uint32_t> boundary;   // [b] input numbers of the first b vertices
  std::vector<uint32_t> fixed;      // [f] those of the next f vertices, which are inside
  std::vector<uint32_t>
      collapsed;  // vertices where no film exists, and the surface has shrunk to a thread
  double area = 0;
  bool isMinimal = false;  // soap films: a further step would move nothing
};

/// Smooths a surface whose boundary stays where it is.
///   mesh  manifold, oriented, with a boundary; vertices of no triangle are left out
/// Errors: BadSurface for what is not such, with the face as `vertex`, and if an edge of it is at fault its ends as
/// `otherLoop` and `otherVertex`; BadOption for a fixed vertex that is not there; BadNormals for a normal that is zero,
/// infinite, NaN in part or along its edge, with the edge's place in the list as `vertex`, and its ends in the same way;
/// BadNormalCount, with b as `vertex`; OutOfMemory, Stopped.
Outcome smoothSurface(const MeshView& mesh, const SmoothOptions& options, Work& work,
                      SmoothSurface& result);

}  // namespace sf
