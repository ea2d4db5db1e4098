// Curves of space found on a surface: for each point of the curve the parameters of the nearest point of the surface.
//
// Source: Piegl, Tiller 1997, "The NURBS book", sec. 6.1, for points by Newton's method; Kumar has all curves given.
// Differs: a point is found from the one next to it on the curve, so that the way runs on over seams. At a degenerate side,
// such as a pole, the free parameter is that with which the curve arrives there.
#pragma once
#include <cstdint>
#include <vector>

#include "base/point2.h"
#include "base/vec.h"
#include "base/work.h"
#include "surface/nurbs_curve.h"
#include "surface/nurbs_surface.h"

namespace sf {

/// Cubic pieces by the parameter of a curve of space. Where that has no corner, they have none.
struct FoundCurve {
  std::vector<double> breaks;  // [n + 1]
  std::vector<Point2>
      points;  // [3n + 1] Bézier points; beyond the domain where the way runs over a seam
};

class Inversion {
 public:
  /// The surface is kept by reference.
  ///   slack  points nearer than this are one; a little less counts as closed or degenerate
  Inversion(const NurbsSurface& surface, double slack);

  /// Finds a curve, which the surface must come within `slack` of everywhere. False if it is not found, or the work has ended.
  /// O(pieces) time, after a search among the points of a grid.
  bool find(const NurbsCurve& curve, double from, double to, double slack, Work& work,
            FoundCurve& found) const;

  /// The size of the domain in u, or in v, if the surface closes in it; else 0.
  Point2 period() const { return period_; }
  Point2 least() const { return least_; }
  Point2 greatest() const { return greatest_; }
  Point2 size() const { return {greatest_.x - least_.x, greatest_.y - least_.y}; }
  /// The surface's point at parameters that may lie beyond a seam. Elsewhere the domain's border stands for what is outside.
  Vec3 placeAt(Point2 p) const;

 private:
  /// A side of the domain that is one point.
  struct Apex {
    bool isAlongU;  // the side runs along u, which is free then
    double fixed;   // the other parameter
    Vec3 at;
  };
  /// A point of the way, with derivatives by the curve's parameter before and after it.
  struct Sample {
    double t;
    Point2 at, before, after;
    const Apex* apex;  // at which it lies, or null
  };
  struct Trace;  // one curve under way

  TangentPoint tangentsAt(Point2 p) const;
  Point2 step(const TangentPoint& s, Point2 p, Vec3 way) const;
  Point2 clamp(Point2 p) const;
  double project(Vec3 target, Point2& p, Work& work) const;
  void layGrid();
  void findSeams();
  void findApexes();

  bool findStart(Trace& trace, double t, Point2& start) const;
  bool walk(Trace& trace, double t, Point2& at, double to) const;
  Sample sampleAt(const Trace& trace, double t, Point2 at) const;
  void arrive(const Sample& inside, Sample& end) const;
  bool fits(const Trace& trace, Sample& a, Sample& b, int levels) const;
  bool refine(Trace& trace, Sample a, Sample b, int levels) const;

  const NurbsSurface& surface_;
  double slack_;
  Point2 least_{}, greatest_{}, period_{0, 0};
  std::vector<Apex> apexes_;
  std::vector<double> us_, vs_, grid_;  // [3 us vs] points of the surface
  double diagonal_ = 0;                 // of the grid's box
};

}  // namespace sf
