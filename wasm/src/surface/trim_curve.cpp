#include "surface/trim_curve.h"

namespace sf {

TrimCurve::TrimCurve(Point2 from, Point2 to, double t0, double t1) {
  const double knots[] = {t0, t0, t1, t1}, poles[] = {from.x, from.y, to.x, to.y};
  curve_ = std::make_unique<NurbsCurve>(NurbsCurveView{{1, {knots, 4}}, 2, {poles, 4}, {}});
}

}  // namespace sf
