#include "surface/inversion.h"

#include <algorithm>
#include <cmath>

namespace sf {
namespace {

/// How far the way found may be off along the surface, in the surface's diagonal.
constexpr double kAlong = 1e-7;
/// Sides closer than this share of the surface's diagonal are one.
constexpr double kClosed = 1e-4;
/// A parameter this near to the border of the domain, in its size, lies on it.
constexpr double kBorder = 1e-9;
/// How far the way found may leave the domain, in its size.
constexpr double kOutside = 1e-7;
/// Most points of the grid.
constexpr double kMostGrid = 40000;
/// How many points of the grid are tried as a start.
constexpr size_t kStarts = 8;
/// Steps of Newton's method for one point.
constexpr int kMostSteps = 30;
/// Most halvings of a step along the way, and of a piece; and most pieces.
constexpr int kMostLevels = 24;
constexpr size_t kMostPieces = 20000;
/// A piece that is still off after so many halvings crosses a crease of the surface, or its curve is not smooth: from there
/// on each one may be off this much more, up to that share of what the edge allows.
constexpr int kUsualLevels = 8;
constexpr double kRelaxation = 4, kMostAlong = 0.1;
/// A break of the curve this near to its ends, in its range, is none.
constexpr double kShortest = 1e-9;
/// A step is short enough if half of it leads this near to the curve, in its chord.
constexpr double kDetour = 0.25;
/// Where the derivatives are so nearly parallel, or one so short, there is but one direction.
constexpr double kParallel = 1e-10;
/// Nanoseconds of a point with its derivatives, nearly.
constexpr uint64_t kPointCost = 150;

Point2 operator+(Point2 a, Point2 b) { return {a.x + b.x, a.y + b.y}; }
Point2 operator-(Point2 a, Point2 b) { return {a.x - b.x, a.y - b.y}; }
Point2 operator*(double s, Point2 a) { return {s * a.x, s * a.y}; }

/// Parameters at which a grid cuts a direction: its breaks, and `pieces` for each span.
std::vector<double> cuts(const BezierSpans& spans, uint32_t pieces) {
  std::vector<double> at;
  for (uint32_t s = 0; s < spans.count(); ++s) {
    const double a = spans.breaks()[s], b = spans.breaks()[s + 1];
    for (uint32_t k = 0; k < pieces; ++k) at.push_back(a + (b - a) * k / pieces);
  }
  at.push_back(spans.breaks()[spans.count()]);
  return at;
}

}  // namespace

struct Inversion::Trace {
  const NurbsCurve& curve;
  double from, to, slack;
  Work& work;
  FoundCurve& found;
  std::vector<std::pair<double, Point2>> way;  // a first guess, by the parameter

  double apexRadius() const { return 0.25 * slack; }
  Point2 guess(double t) const {
    const auto after = std::lower_bound(way.begin() + 1, way.end() - 1, t,
                                        [](const auto& w, double x) { return w.first < x; });
    const auto& [t0, p0] = *(after - 1);
    const auto& [t1, p1] = *after;
    return p0 + ((t - t0) / (t1 - t0)) * (p1 - p0);
  }
};

Inversion::Inversion(const NurbsSurface& surface, double slack) : surface_(surface), slack_(slack) {
  const BezierSpans &u = surface.u(), &v = surface.v();
  least_ = {u.breaks()[0], v.breaks()[0]};
  greatest_ = {u.breaks()[u.count()], v.breaks()[v.count()]};
  layGrid();
  findSeams();
  findApexes();
}

void Inversion::layGrid() {
  const BezierSpans &u = surface_.u(), &v = surface_.v();
  const uint32_t most = uint32_t(std::sqrt(kMostGrid / (double(u.count()) * double(v.count()))));
  us_ = cuts(u, std::clamp(most, 1u, u.degree() + 1));
  vs_ = cuts(v, std::clamp(most, 1u, v.degree() + 1));
  grid_.resize(3 * us_.size() * vs_.size());
  std::vector<double> normals(grid_.size());
  surface_.grid(us_, vs_, grid_.data(), normals.data());
  Vec3 low{grid_[0], grid_[1], grid_[2]}, high = low;
  for (size_t i = 0; i < grid_.size(); i += 3) {
    const Vec3 p{grid_[i], grid_[i + 1], grid_[i + 2]};
    low = lowest(low, p), high = highest(high, p);
  }
  diagonal_ = distance(low, high);
}

void Inversion::findSeams() {
  const double same = std::min(slack_, kClosed * diagonal_);
  const auto closes = [&](bool inU) {
    double between = 0;
    for (const double x : cuts(inU ? surface_.v() : surface_.u(), 5)) {
      const auto at = [&](double y) {
        return (inU ? surface_.tangentsAt(y, x) : surface_.tangentsAt(x, y)).at;
      };
      const double a = inU ? least_.x : least_.y, b = inU ? greatest_.x : greatest_.y;
      if (distance(at(a), at(b)) > same) return false;
      between = std::max(between, distance(at(a), at(a + 0.45 * (b - a))));
    }
    return between > 10 * same;
  };
  if (closes(true)) period_.x = size().x;
  if (closes(false)) period_.y = size().y;
}

void Inversion::findApexes() {
  const double same = std::min(0.1 * slack_, kClosed * diagonal_);
  for (const bool isAlongU : {true, false})
    for (const bool isLast : {false, true}) {
      const Point2 end = isLast ? greatest_ : least_;
      const double fixed = isAlongU ? end.y : end.x;
      const auto at = [&](double x) {
        return (isAlongU ? surface_.tangentsAt(x, fixed) : surface_.tangentsAt(fixed, x)).at;
      };
      const std::vector<double> along = cuts(isAlongU ? surface_.u() : surface_.v(), 5);
      const Vec3 first = at(along[0]);
      if (std::all_of(along.begin(), along.end(),
                      [&](double x) { return distance(at(x), first) <= same; }))
        apexes_.push_back({isAlongU, fixed, first});
    }
}

Point2 Inversion::clamp(Point2 p) const {
  if (period_.x == 0) p.x = std::clamp(p.x, least_.x, greatest_.x);
  if (period_.y == 0) p.y = std::clamp(p.y, least_.y, greatest_.y);
  return p;
}

TangentPoint Inversion::tangentsAt(Point2 p) const {
  const auto reduce = [](double x, double from, double to, double period) {
    if (period > 0 && (x < from || x > to)) x -= period * std::floor((x - from) / period);
    return std::clamp(x, from, to);
  };
  return surface_.tangentsAt(reduce(p.x, least_.x, greatest_.x, period_.x),
                             reduce(p.y, least_.y, greatest_.y, period_.y));
}

Vec3 Inversion::placeAt(Point2 p) const { return tangentsAt(p).at; }

/// The change of parameters that leads as near as can be, by first derivatives, without leaving the domain where it does not
/// close.
Point2 Inversion::step(const TangentPoint& s, Point2 p, Vec3 way) const {
  const Point2 size = this->size();
  const Vec3 a = size.x * s.u, b = size.y * s.v;
  const double aa = dot(a, a), bb = dot(b, b), scale = kParallel * diagonal_;
  const auto alone = [&](const Vec3& d, double dd) {
    return dd > scale * scale ? dot(d, way) / dd : 0;
  };
  const auto leaves = [&](double x, double from, double to, double period, double change) {
    return period == 0 && ((x <= from && change < 0) || (x >= to && change > 0));
  };
  double du = 0, dv = 0;
  // The shorter one without its part along the longer one: squares would lose half of the digits.
  const bool isAShort = aa < bb;
  const Vec3 &longer = isAShort ? b : a, &shorter = isAShort ? a : b;
  const double square = std::max(aa, bb);
  if (!(square > scale * scale)) return {0, 0};
  const double along = dot(longer, shorter) / square;
  const Vec3 rest = shorter - along * longer;
  const double restSquare = dot(rest, rest);
  const double small =
      restSquare > kParallel * kParallel * square ? dot(rest, way) / restSquare : 0;
  const double large = dot(longer, way) / square - along * small;
  (isAShort ? du : dv) = small, (isAShort ? dv : du) = large;
  const bool outU = leaves(p.x, least_.x, greatest_.x, period_.x, du),
             outV = leaves(p.y, least_.y, greatest_.y, period_.y, dv);
  if (outU || outV) {
    // Along that side alone.
    du = outU ? 0 : alone(a, aa), dv = outV ? 0 : alone(b, bb);
    if (leaves(p.x, least_.x, greatest_.x, period_.x, du)) du = 0;
    if (leaves(p.y, least_.y, greatest_.y, period_.y, dv)) dv = 0;
  }
  return {size.x * du, size.y * dv};
}

/// Moves parameters to the nearest point, from where they are. Returns the distance left.
double Inversion::project(Vec3 target, Point2& p, Work& work) const {
  const Point2 size = this->size();
  p = clamp(p);
  TangentPoint s = tangentsAt(p);
  double left = distance(s.at, target);
  uint64_t points = 1;
  for (int i = 0; i < kMostSteps; ++i) {
    Point2 d = step(s, p, target - s.at);
    const double share = std::max(std::fabs(d.x) / size.x, std::fabs(d.y) / size.y);
    if (!(share > 1e-15)) break;
    if (share > 0.25) d = (0.25 / share) * d;
    bool isNearer = false;
    for (int half = 0; half < 8 && !isNearer; ++half, d = 0.5 * d) {
      const Point2 q = clamp(p + d);
      const TangentPoint next = tangentsAt(q);
      const double rest = distance(next.at, target);
      ++points;
      if (!(rest < left)) continue;
      isNearer = true;
      p = q, s = next, left = rest;
    }
    if (!isNearer) break;
  }
  work.tick(points * kPointCost);
  const auto settle = [](double x, double from, double size, double period) {
    const double sides = (x - from) / size, nearest = std::round(sides);
    const bool isSide = period > 0 || nearest == 0 || nearest == 1;
    return isSide && std::fabs(sides - nearest) < kBorder ? from + nearest * size : x;
  };
  p.x = settle(p.x, least_.x, size.x, period_.x);
  p.y = settle(p.y, least_.y, size.y, period_.y);
  return left;
}

/// Among all of the surface, from the best points of the grid.
bool Inversion::findStart(Trace& trace, double t, Point2& start) const {
  const Vec3 target = trace.curve.placeAt(t);
  const size_t columns = vs_.size(), rows = us_.size();
  const auto square = [&](size_t i, size_t k) {
    const double* g = &grid_[3 * (i * columns + k)];
    const Vec3 way = target - Vec3{g[0], g[1], g[2]};
    return dot(way, way);
  };
  std::vector<std::pair<double, Point2>> best;
  for (size_t i = 0; i < rows; ++i)
    for (size_t k = 0; k < columns; ++k) {
      const double d = square(i, k);
      if (best.size() == kStarts && d >= best.back().first) continue;
      // Only the best one of its neighbourhood.
      if ((i > 0 && square(i - 1, k) < d) || (i + 1 < rows && square(i + 1, k) < d) ||
          (k > 0 && square(i, k - 1) < d) || (k + 1 < columns && square(i, k + 1) < d))
        continue;
      const std::pair<double, Point2> entry{d, {us_[i], vs_[k]}};
      best.insert(std::upper_bound(best.begin(), best.end(), entry,
                                   [](const auto& a, const auto& b) { return a.first < b.first; }),
                  entry);
      if (best.size() > kStarts) best.pop_back();
    }
  trace.work.tick(rows * columns * 4);
  double least = trace.slack;
  bool isFound = false;
  for (const auto& [d, at] : best) {
    Point2 p = at;
    const double left = project(target, p, trace.work);
    if (!(left <= least)) continue;
    isFound = true;
    least = left, start = p;
    if (left <= 1e-9 * diagonal_) break;
  }
  return isFound;
}

/// Goes on from one parameter of the curve to another, in steps short enough to be sure of.
bool Inversion::walk(Trace& trace, double t, Point2& at, double to) const {
  std::vector<std::pair<double, int>> open{{to, 0}};
  while (!open.empty()) {
    if (!trace.work.going()) return false;
    const auto [next, level] = open.back();
    const Vec3 here = trace.curve.placeAt(t), target = trace.curve.placeAt(next);
    Point2 p = at;
    double left = project(target, p, trace.work);
    const bool isEnd = next == trace.from || next == trace.to;
    for (const Apex& apex : apexes_) {
      if (!isEnd || distance(apex.at, target) > trace.apexRadius()) continue;
      p = at;
      (apex.isAlongU ? p.y : p.x) = apex.fixed;
      left = distance(apex.at, target);
    }
    const Vec3 half = trace.curve.placeAt(0.5 * (t + next));
    const bool isNear = left <= trace.slack && distance(placeAt(0.5 * (at + p)), half) <=
                                                   kDetour * distance(here, target) + trace.slack;
    if (!isNear && level < kMostLevels) {
      open.push_back({0.5 * (t + next), level + 1});
      if (open.back().first == t || open.back().first == next) return false;
      open[open.size() - 2].second = level + 1;
      continue;
    }
    if (!(left <= trace.slack)) return false;
    open.pop_back();
    t = next, at = p;
    trace.way.push_back({t, at});
    if (trace.way.size() > kMostPieces) return false;
  }
  return true;
}

Inversion::Sample Inversion::sampleAt(const Trace& trace, double t, Point2 at) const {
  const ArrayView<const double> breaks = trace.curve.spans().breaks();
  Sample s{t, at, {}, {}, nullptr};
  const CurvePoint c = trace.curve.at(t);
  if (t == trace.from || t == trace.to)
    for (const Apex& apex : apexes_)
      if (distance(apex.at, c.at) <= trace.apexRadius()) s.apex = &apex;
  if (s.apex) (s.apex->isAlongU ? s.at.y : s.at.x) = s.apex->fixed;
  const TangentPoint tangents = tangentsAt(s.at);
  // The ends of the curve do not bound its direction: steps are those of a point inside.
  const Point2 middle = 0.5 * (least_ + greatest_);
  s.after = s.before = step(tangents, middle, c.first);
  const auto found = std::lower_bound(breaks.begin(), breaks.end(), t);
  if (found != breaks.begin() && found != breaks.end() && *found == t) {
    const Vec3 before = trace.curve.derivativeAtEnd(uint32_t(found - breaks.begin()) - 1);
    if (length(before - c.first) > 1e-6 * length(c.first))
      s.before = step(tangents, middle, before);
  }
  return s;
}

/// At an apex the free parameter is that with which the way arrives.
void Inversion::arrive(const Sample& inside, Sample& end) const {
  const double h = end.t - inside.t;
  const Point2 slope = h > 0 ? inside.after : inside.before;
  Point2& atEnd = h > 0 ? end.before : end.after;
  if (end.apex->isAlongU)
    end.at.x = inside.at.x + h * slope.x, atEnd.x = slope.x;
  else
    end.at.y = inside.at.y + h * slope.y, atEnd.y = slope.y;
}

/// Whether a cubic between two samples follows the curve.
bool Inversion::fits(const Trace& trace, Sample& a, Sample& b, int levels) const {
  if (a.apex && b.apex) return false;
  if (a.apex) arrive(b, a);
  if (b.apex) arrive(a, b);
  const double usual = kAlong * diagonal_, most = std::max(usual, kMostAlong * trace.slack);
  const double allowed =
      std::min(most, usual * std::pow(kRelaxation, std::max(0, levels - kUsualLevels)));
  const double h = b.t - a.t;
  const Point2 p1 = a.at + (h / 3) * a.after, p2 = b.at - (h / 3) * b.before;
  for (int i = 1; i < 6; ++i) {
    const double x = i / 6.0, y = 1 - x;
    const Vec3 target = trace.curve.placeAt(a.t + x * h);
    const Point2 p =
        y * y * y * a.at + 3 * x * y * y * p1 + (3 * x * x * y * p2 + x * x * x * b.at);
    const Point2 within = clamp(p);
    if (std::fabs(p.x - within.x) > kOutside * size().x ||
        std::fabs(p.y - within.y) > kOutside * size().y)
      return false;
    const TangentPoint s = tangentsAt(within);
    const Point2 d = step(s, within, target - s.at);
    const bool isAtApex = (a.apex && distance(a.apex->at, target) <= 2 * trace.apexRadius()) ||
                          (b.apex && distance(b.apex->at, target) <= 2 * trace.apexRadius());
    const double along = length(d.x * s.u + d.y * s.v);
    if (!(along <= (isAtApex ? trace.apexRadius() : allowed))) return false;
  }
  trace.work.tick(8 * kPointCost);
  return true;
}

/// Appends cubic pieces between two samples.
bool Inversion::refine(Trace& trace, Sample a, Sample b, int levels) const {
  if (!trace.work.going()) return false;
  FoundCurve& found = trace.found;
  const double middle = 0.5 * (a.t + b.t);
  const bool isLast =
      levels >= kMostLevels || found.breaks.size() > kMostPieces || !(a.t < middle && middle < b.t);
  if (fits(trace, a, b, levels) || isLast) {
    const double h = (b.t - a.t) / 3;
    if (found.breaks.empty()) found.breaks.push_back(a.t), found.points.push_back(a.at);
    found.breaks.push_back(b.t);
    found.points.push_back(a.at + h * a.after);
    found.points.push_back(b.at - h * b.before);
    found.points.push_back(b.at);
    return true;
  }
  Point2 p = trace.guess(middle);
  if (!(project(trace.curve.placeAt(middle), p, trace.work) <= trace.slack)) return false;
  const Sample m = sampleAt(trace, middle, p);
  return refine(trace, a, m, levels + 1) && refine(trace, m, b, levels + 1);
}

bool Inversion::find(const NurbsCurve& curve, double from, double to, double slack, Work& work,
                     FoundCurve& found) const {
  Trace trace{curve, from, to, slack, work, found, {}};
  // The curve's own breaks, and on the way there at least a few stops.
  std::vector<double> breaks{from};
  for (const double t : curve.spans().breaks())
    if (t - from > kShortest * (to - from) && to - t > kShortest * (to - from)) breaks.push_back(t);
  breaks.push_back(to);
  const uint32_t stops = breaks.size() < 100 ? 8 : 2;
  std::vector<double> at;
  for (size_t i = 0; i + 1 < breaks.size(); ++i)
    for (uint32_t k = 0; k < stops; ++k)
      at.push_back(breaks[i] + (breaks[i + 1] - breaks[i]) * k / stops);
  at.push_back(to);
  // Where two parts of the surface touch, another start may lie on the right one.
  for (const double share : {0.5, 0.3, 0.7, 0.15, 0.85}) {
    const size_t first = std::clamp<size_t>(size_t(share * double(at.size())), 1, at.size() - 2);
    Point2 start;
    if (!work.going()) return false;
    if (!findStart(trace, at[first], start)) continue;
    trace.way.clear();
    Point2 p = start;
    bool isWhole = true;
    for (size_t i = first; i-- > 0 && isWhole;) isWhole = walk(trace, at[i + 1], p, at[i]);
    if (!isWhole) continue;
    std::reverse(trace.way.begin(), trace.way.end());
    trace.way.push_back({at[first], start});
    p = start;
    for (size_t i = first + 1; i < at.size() && isWhole; ++i)
      isWhole = walk(trace, at[i - 1], p, at[i]);
    if (!isWhole) continue;
    found.breaks.clear(), found.points.clear();
    const auto sample = [&](double t) {
      const auto w = std::lower_bound(trace.way.begin(), trace.way.end(), t,
                                      [](const auto& e, double x) { return e.first < x; });
      return sampleAt(trace, t, w->second);
    };
    for (size_t i = 0; i + 1 < breaks.size() && isWhole; ++i)
      isWhole = refine(trace, sample(breaks[i]), sample(breaks[i + 1]), 0);
    if (isWhole) return true;
  }
  return false;
}

}  // namespace sf
