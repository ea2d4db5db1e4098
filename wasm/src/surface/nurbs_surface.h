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

/// The bytes that a surface takes.
uint64_t bytesOf(const NurbsSurfaceView& view);

/// A point of a surface, and its first derivatives there.
struct TangentPoint {
  Vec3 at, u, v;
  /// Su x Sv, which is zero where the parametrisation is degenerate.
  Vec3 normal() const { return cross(u, v); }
};

/// The same with second derivatives.
struct SurfacePoint : TangentPoint {
  Vec3 uu, uv, vv;
};

class NurbsSurface {
 public:
  /// For valid knots, finite poles and positive weights. Memory is that of the Bézier points: (p + 1)(q + 1) a patch.
  explicit NurbsSurface(const NurbsSurfaceView& view);

  const BezierSpans& u() const { return u_; }
  const BezierSpans& v() const { return v_; }

  /// At parameters, of which those outside of the domain count as the nearest of it. With derivatives from the right at breaks, but at the end of the domain.
  /// O(p q) time.
  SurfacePoint at(double u, double v) const;
  /// The same without second derivatives, in half the time.
  TangentPoint tangentsAt(double u, double v) const;

  /// The unit normal. Where Su x Sv vanishes, such as at the pole of a sphere or on the tip of a cone, it is that of the
  /// surface nearby, on the side of the middle of the domain; zero only if the surface has none there either.
  Vec3 normalAt(double u, double v) const { return normalOf(tangentsAt(u, v), u, v); }
  /// The same for the point at these parameters.
  Vec3 normalOf(const TangentPoint& p, double u, double v) const;

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
  Vec3 usualNormal(const TangentPoint& p) const;
  Vec3 nearbyNormal(double u, double v) const;
  TangentPoint tangentsOf(const double (&s)[4], const double (&su)[4], const double (&sv)[4],
                          uint32_t iu, uint32_t iv) const;

  BezierSpans u_, v_;
  bool isRational_;
  std::vector<double> points_;  // patch after patch, u by u: [(p + 1)(q + 1) 4] x w, y w, z w, w
};

}  // namespace sf
