// A trimming curve in the domain of a surface, by the parameter of its edge.
//
// Source: Kumar, sec. 2.
// Differs: where a file has none, it is found by inversion: the nearest point of the surface to each point of the edge, found
// from the one next to it, so that it runs on over seams and is then brought back into the domain.
#pragma once
#include <memory>
#include <vector>

#include "base/point2.h"
#include "surface/nurbs_curve.h"
#include "surface/nurbs_surface.h"

namespace sf {

class TrimCurve {
 public:
  TrimCurve() = default;
  explicit TrimCurve(const NurbsCurveView& view);
  /// The curve of the surface nearest to a curve of space, over the parameters from `from` to `to`; isFound() tells whether
  /// there is one within `tolerance`.
  ///   wanted  if not null, a point of the domain that the curve should begin at if it may: on which side of a seam
  TrimCurve(const NurbsSurface& surface, const NurbsCurve& edge, double from, double to,
            double tolerance);

  bool isFound() const;
  /// At a parameter of the edge. O(degree), or a few evaluations of the surface if it was found by inversion.
  Point2 at(double t) const;
  /// Appends parameters strictly inside the range where the curve is not smooth or its spans meet: corners and breaks.
  void appendBreaks(double from, double to, std::vector<double>& parameters) const;
};

}  // namespace sf
