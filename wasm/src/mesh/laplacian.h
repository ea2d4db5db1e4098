// The Laplacian of a triangulated surface by cotangents, over its intrinsic Delaunay triangulation.
// Source: Pinkall, Polthier 1993, "Computing discrete minimal surfaces and their conjugates", for the weights;
// Bobenko, Springborn 2007, "A discrete Laplace-Beltrami operator for simplicial surfaces", and Fisher, Springborn,
// Bobenko, Schroeder 2006, "An algorithm for the construction of intrinsic Delaunay triangulations", for the flips;
// Sharp, Crane 2020, "A Laplacian for nonmanifold triangle meshes", sec. 4.5, for mollification.
// Differs: edges with no triangle, or more than one, on the other side are boundary edges. Where it is known which way
// the surface leaves at them, the Laplacian of their vertices is known too: what the co-normals pull is taken away.
#pragma once
#include <cstdint>
#include <vector>

#include "base/array_view.h"
#include "base/work.h"
#include "mesh/local_surface.h"
#include "mesh/sparse_cholesky.h"
#include "triangles/triangle_mesh.h"

namespace sf {

struct Laplacian {
  /// Positive semidefinite, symmetric, every row with its diagonal: (L x)_i = sum of w_ij (x_i - x_j), which is
  /// the gradient of the area at vertex i. All w_ij >= 0, but for rounding. A row may have a column several times.
  SparseRows whole;
  /// The same over triangles with no vertex on the boundary, if asked for.
  SparseRows inner;
  std::vector<double> mass;  // [n] area about each vertex, > 0, in units
  double unit = 1;           // the mean area about a vertex
  /// [n] Vertices whose triangles do not go all around them, or that have none; clamped ones are none.
  std::vector<uint8_t> isBoundary;
  std::vector<Clamp> clamps;  // at their vertices, the Laplacian of places is `whole` less the pull
};

/// Builds it. O(m) time but for flips, of which there are few on meshes that are nearly Delaunay.
///   positions  [3n]
///   mesh    corners, consistently wound, and twins; degenerate triangles do no harm
///   clamps  all triangles of their vertices are in the mesh
///   withInner  whether the inner matrix is needed
/// False when the work ended.
bool buildLaplacian(ArrayView<const double> positions, const TriangleMesh& mesh,
                    ArrayView<const Clamp> clamps, bool withInner, Work& work, Laplacian& result);

}  // namespace sf
