// Tensor product surfaces, rational or not, in Bézier form.
//
// Source: Kumar, sec. 2. Piegl, Tiller 1997, "The NURBS book", sec. 4.5, for derivatives of rational surfaces.
// Differs: NURBS of any degree and knots; points of a grid by contracting rows of poles once for each u-line.
#pragma once
#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "surface/spline.h"

namespace sf {

struct NurbsSurfaceView {
  KnotVector u, v;
  ArrayView<const double>
      poles;  // [3 u.count() v.count()], index iu * v.count() + iv; not multiplied by weights
  ArrayView<const double> weights;  // [u.count() v.count()] positive, or empty: not rational
};

/// A point of a surface, and its derivatives there.
struct SurfacePoint {
  Vec3 at, u, v, uu, uv, vv;
  /// Su x Sv, which is zero where the parametrisation is degenerate.
  Vec3 normal() const { return cross(u, v); }
};

class NurbsSurface {
 public:
  /// For valid knots, finite poles and positive weights. Memory is that of the Bézier points: (p + 1)(q + 1) a patch.
  explicit NurbsSurface(const NurbsSurfaceView& view);

  const BezierSpans& u() const { return u_; }
  const BezierSpans& v() const { return v_; }

  /// At parameters of the domain. With derivatives from the right at breaks, but at the end of the domain.
  /// O(p q) time.
  SurfacePoint at(double u, double v) const;

  /// The unit normal. Where Su x Sv vanishes, such as at the pole of a sphere or on the tip of a cone, it is that of the
  /// surface nearby, on the side of the middle of the domain; zero only if the surface has none there either.
  Vec3 normalAt(double u, double v) const;

  /// Positions and unit normals at a grid: for each of `us` all of `vs`, both of the domain. About 4 (q + 1) products a point
  /// once the rows are contracted.
  ///   positions, normals  [3 us.size() vs.size()]
  void grid(ArrayView<const double> us, ArrayView<const double> vs, double* positions,
            double* normals) const;

 private:
  /// A span and a parameter within it, from 0 to 1.
  struct Local {
    uint32_t span;
    double x;
  };
  static Local localIn(const BezierSpans& spans, double t);
  const double* patch(uint32_t iu, uint32_t iv) const;
  Vec3 usualNormal(const SurfacePoint& p) const;
  Vec3 nearbyNormal(double u, double v) const;

  BezierSpans u_, v_;
  uint32_t channels_;           // 3, or 4 if it is rational: x w, y w, z w, w
  std::vector<double> points_;  // patch after patch, u by u: [(p + 1)(q + 1) channels]
};

}  // namespace sf
