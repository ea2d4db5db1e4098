// incircle with its filter inline.
// Source: Cline, Renka 1984, "A storage-efficient method for construction of a Thiessen
// triangulation", for the determinant by the angles at c and d over the chord from a to b: it is
// -sin(C + D) times lengths. Differs: computed two numbers at a time.
#pragma once
#include <cmath>

#include "base/double2.h"
#include "base/point2.h"
#include "base/predicates.h"

namespace sf {

namespace circles {

/// The two terms of the sine that the filter computes, and their sizes.
struct Terms {
  Double2 dotX, dotY, crossX, crossY;

  Terms(Point2 a, Point2 b, Point2 c, Point2 d) {
    const Double2 a2 = {a.x, a.y}, b2 = {b.x, b.y}, c2 = {c.x, c.y}, d2 = {d.x, d.y};
    const Double2 ca = a2 - c2, cb = b2 - c2, da = a2 - d2, db = b2 - d2;
    const Double2 dotC = ca * cb, dotD = db * da;
    const Double2 crossC = ca * swapped(cb), crossD = db * swapped(da);
    dotX = __builtin_shufflevector(dotC, dotD, 0, 2);
    dotY = __builtin_shufflevector(dotC, dotD, 1, 3);
    crossX = __builtin_shufflevector(crossC, crossD, 0, 2);
    crossY = __builtin_shufflevector(crossC, crossD, 1, 3);
  }
  double sine() const {
    const Double2 terms = (dotX + dotY) * swapped(crossX - crossY);
    return terms[0] + terms[1];
  }
  double size() const {
    const Double2 sizes =
        (magnitudes(dotX) + magnitudes(dotY)) * swapped(magnitudes(crossX) + magnitudes(crossY));
    return sizes[0] + sizes[1];
  }
};

/// The sign of a sine larger than this is right: each of its terms has at most ten roundings, and
/// so has its size. The last number exceeds all underflows.
inline double errorOf(double size) { return 0x1p-49 * size + 1e-290; }

}  // namespace circles

/// Whether d lies inside the circle through a, b, c, which turn left. Exact in the range of
/// base/predicates.h.
inline bool inCircle(Point2 a, Point2 b, Point2 c, Point2 d) {
  const circles::Terms terms(a, b, c, d);
  const double sine = terms.sine();
  if (std::fabs(sine) > circles::errorOf(terms.size())) return sine < 0;
  return incircle(a.x, a.y, b.x, b.y, c.x, c.y, d.x, d.y) > 0;
}

/// The error of the sine, for all points of a box.
inline double errorOfCircles(Point2 least, Point2 greatest) {
  const double width = greatest.x - least.x, height = greatest.y - least.y;
  return circles::errorOf(4.01 * width * height * (width * width + height * height));
}

/// The same, but faster: `error` is errorOfCircles of a box that holds the points.
inline bool inCircle(Point2 a, Point2 b, Point2 c, Point2 d, double error) {
  const double sine = circles::Terms(a, b, c, d).sine();
  if (std::fabs(sine) > error) return sine < 0;
  return inCircle(a, b, c, d);
}

}  // namespace sf
