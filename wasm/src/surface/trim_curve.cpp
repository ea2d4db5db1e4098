#include "surface/trim_curve.h"

namespace sf {

TrimCurve::TrimCurve(Point2 from, Point2 to, double t0, double t1) {
  const double knots[] = {t0, t0, t1, t1}, poles[] = {from.x, from.y, to.x, to.y};
  curve_ = std::make_unique<NurbsCurve>(NurbsCurveView{{1, {knots, 4}}, 2, {poles, 4}, {}});
}

TrimCurve::TrimCurve(const std::vector<double>& breaks, const std::vector<Point2>& points) {
  std::vector<double> knots, poles;
  knots.push_back(breaks.front());
  for (const double t : breaks) knots.insert(knots.end(), 3, t);
  knots.push_back(breaks.back());
  for (const Point2 p : points) poles.push_back(p.x), poles.push_back(p.y);
  curve_ = std::make_unique<NurbsCurve>(NurbsCurveView{{3, knots}, 2, poles, {}});
}

}  // namespace sf
