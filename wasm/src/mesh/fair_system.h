// The equations of fairing: one linear solve for given weights.
// Source: as fair.h; Moreton, Sequin 1992, "Functional optimization for fair surface design", for the variation of
// curvature; Max 1999, "Weights for computing vertex normals from facet normals".
#pragma once
#include <cstdint>
#include <vector>

#include "base/array_view.h"
#include "base/charge.h"
#include "base/vec.h"
#include "base/work.h"
#include "mesh/laplacian.h"
#include "mesh/sparse_cholesky.h"

namespace sf {

class FairSystem {
 public:
  /// For the vertices of a surface from `firstFree` on; those in no triangle stay where they are.
  ///   laplacian  of the surface; must outlive this
  FairSystem(const Laplacian& laplacian, uint32_t firstFree, Work& work);

  /// Moves the free vertices to where (L M^-1)^(k-1) L x = 0, k = `order`. False if that has no good solution, or
  /// when the work ended; x is then spoilt.
  bool solve(uint32_t order, ArrayView<Vec3> x);

  /// Finds the mean curvature and the normals at all vertices, for what follows.
  ///   triangles  [3m] of the surface
  void measure(ArrayView<const Vec3> x, ArrayView<const uint32_t> triangles);
  /// The mean curvature at a vertex, times two; 0 on the boundary. After measure().
  double curvature(uint32_t v) const { return curvature_[v]; }
  /// How much the mean curvature varies over the surface: the integral of its squared gradient. After measure().
  double variation() const;
  /// One step along the normals, of the kind of Newton's: for `order` 1 to a minimal surface, for 2 to the least
  /// bending, the integral of the squared mean curvature, for 3 to its least variation. After measure(x). False as
  /// solve, and for films that are not stable: the second variation of their area has a negative direction.
  ///   x     [n] moved
  ///   most  out: the largest distance moved
  bool step(uint32_t order, ArrayView<Vec3> x, double& most);

 private:
  SparseRows bentLaplacian() const;
  bool shiftAlongNormals(const SparseRows& matrix, std::vector<Vec3>& step, ArrayView<Vec3> x,
                         double& most);
  void laplacianOfPlaces(ArrayView<const Vec3> x);
  bool assemble(uint32_t order, const SparseRows& outer, SparseRows& matrix, Charge& charge);
  void forces(uint32_t order, ArrayView<const Vec3> x);

  const Laplacian& laplacian_;
  uint32_t first_;
  Work& work_;
  std::vector<uint32_t> unknowns_;   // [u] free vertices that are in triangles
  std::vector<uint32_t> numberOf_;   // [n] and the way back; kNone for all others
  std::vector<double> inverseMass_;  // [n] 0 where the Laplacian is not known
  std::vector<Vec3> flow_, next_;    // [n]
  std::vector<Vec3> normals_;        // [n] of unit length
  std::vector<double> curvature_;    // [n]
};

}  // namespace sf
