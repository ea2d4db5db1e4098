#include "loops/one_loop/polygon_solver.h"

#include <algorithm>
#include <cmath>

#include "base/accurate_cross.h"
#include "base/atan2.h"
#include "base/charge.h"
#include "base/predicates.h"
#include "loops/one_loop/angular_transform.h"

namespace sf {
namespace {

/// What the passes over one polygon have in common: coordinates by axis, and triangle costs.
class Polygon {
 public:
  Polygon(const LoopSet& loops, const TriangleWeights& weights)
      : loops_(loops), weights_(weights), n_(loops.vertexCount()) {
    for (const Vec3& p : loops.positions()) {
      x_.push_back(p.x);
      y_.push_back(p.y);
      z_.push_back(p.z);
    }
  }
  uint32_t size() const { return n_; }
  const TriangleWeights& weights() const { return weights_; }

  /// cost[k - i - 1] = w(i, k, j) for all k between i and j; infinity if collinear.
  void triangleCosts(uint32_t i, uint32_t j, double* cost) const;
  /// The same for the largest angle to a face given across a loop edge.
  void faceAngles(uint32_t i, uint32_t j, double* angle) const;
  /// theta[k] of the triangle i, j, k around the edge from i to j, for all k; undefined for i, j.
  void anglesAround(uint32_t i, uint32_t j, double* theta) const;

 private:
  /// Calls f(k, angle) for each triangle i, k, j that has a face across one of its loop edges.
  template <class F>
  void forEachFace(uint32_t i, uint32_t j, F f) const;

  const LoopSet& loops_;
  const TriangleWeights& weights_;
  uint32_t n_;
  std::vector<double> x_, y_, z_;
};

template <class F>
void Polygon::forEachFace(uint32_t i, uint32_t j, F f) const {
  if (weights_.normals.empty()) return;
  double angle;
  const auto visit = [&](uint32_t a, uint32_t b, uint32_t apex, uint32_t k) {
    if (faceAngle(loops_, weights_.normals, a, b, apex, angle)) f(k, angle);
  };
  visit(i, i + 1, j, i + 1);
  visit(j - 1, j, i, j - 1);
  if (i == 0 && j == n_ - 1)
    for (uint32_t k = 1; k < j; ++k) visit(j, i, k, k);
}

void Polygon::triangleCosts(uint32_t i, uint32_t j, double* cost) const {
  const double px = x_[i], py = y_[i], pz = z_[i];
  const double ex = x_[j] - px, ey = y_[j] - py, ez = z_[j] - pz;
  const double area = 0.5 * weights_.area;
  const uint32_t count = j - i - 1;
  const double *x = &x_[i + 1], *y = &y_[i + 1], *z = &z_[i + 1];
  double smallest = kInfinity;
  for (uint32_t k = 0; k < count; ++k) {
    const double dx = x[k] - px, dy = y[k] - py, dz = z[k] - pz;
    const double cx = dy * ez - dz * ey, cy = dz * ex - dx * ez, cz = dx * ey - dy * ex;
    const double squared = cx * cx + cy * cy + cz * cz;
    smallest = squared < smallest ? squared : smallest;
    cost[k] = area * std::sqrt(squared);
  }
  if (weights_.perimeter > 0) {
    const double base = std::sqrt(ex * ex + ey * ey + ez * ez);
    for (uint32_t k = 0; k < count; ++k) {
      const double ax = x[k] - px, ay = y[k] - py, az = z[k] - pz;
      const double bx = ax - ex, by = ay - ey, bz = az - ez;
      cost[k] += weights_.perimeter * (base + std::sqrt(ax * ax + ay * ay + az * az) +
                                       std::sqrt(bx * bx + by * by + bz * bz));
    }
  }
  // Only triangles this thin, in units of the whole input, can be exactly collinear.
  if (smallest < 1e-28) {
    for (uint32_t k = i + 1; k < j; ++k)
      if (collinear(loops_.position(i), loops_.position(k), loops_.position(j)))
        cost[k - i - 1] = kInfinity;
  }
  forEachFace(i, j,
              [&](uint32_t k, double angle) { cost[k - i - 1] += weights_.dihedral * angle; });
}

void Polygon::faceAngles(uint32_t i, uint32_t j, double* angle) const {
  std::fill(angle, angle + (j - i - 1), 0.0);
  forEachFace(i, j,
              [&](uint32_t k, double a) { angle[k - i - 1] = std::max(angle[k - i - 1], a); });
}

void Polygon::anglesAround(uint32_t i, uint32_t j, double* theta) const {
  const Frame frame = frameAcross(loops_.position(j) - loops_.position(i));
  const Vec3 p = loops_.position(i), a = frame.x, b = frame.y;
  const double *x = x_.data(), *y = y_.data(), *z = z_.data();
  double thinnest = kInfinity;
  for (uint32_t k = 0; k < n_; ++k) {
    const double dx = x[k] - p.x, dy = y[k] - p.y, dz = z[k] - p.z;
    const double up = b.x * dx + b.y * dy + b.z * dz, across = a.x * dx + a.y * dy + a.z * dz;
    const double rest = across * across + up * up - 1e-8 * (dx * dx + dy * dy + dz * dz);
    thinnest = rest < thinnest && k != i && k != j ? rest : thinnest;
    theta[k] = fastAtan2(up, across);
  }
  if (thinnest >= 0) return;
  for (uint32_t k = 0; k < n_; ++k) {
    const Vec3 arm = loops_.position(k) - p;
    const double up = dot(arm, b), across = dot(arm, a);
    if (isThin(across * across + up * up, dot(arm, arm), 1))
      theta[k] = angleOfNormal(frame, accurateCross(p, loops_.position(j), loops_.position(k)));
  }
}

/// One pass that looks at angles. `Real` is the type that holds the cost of a triangle with all
/// behind it, rounded down.
template <class Real>
class AnglePass {
 public:
  AnglePass(const Polygon& polygon, Measure measure, Work& work)
      : polygon_(polygon), measure_(measure), work_(work), memory_(work), transform_(measure) {}

  static double bytes(double n) { return n * (n - 1) * (n - 2) / 6 * sizeof(Real) + 64 * n; }

  /// The least cost, infinity if there is no surface; false when the work ended.
  bool solve(double& cost);
  void trace(std::vector<uint32_t>& triangles);

 private:
  static Real roundedDown(double v) {
    const Real r = Real(v);
    return double(r) > v ? std::nextafter(r, -std::numeric_limits<Real>::infinity()) : r;
  }
  /// Costs of the triangles i, k, j, for all k between, one after the other.
  Real* row(uint32_t i, uint32_t j) {
    const size_t l = j - i - 1;
    return &base_[firstRow_[i] + l * (l - 1) / 2];
  }
  bool finish(uint32_t i, uint32_t j);
  uint32_t bestApex(uint32_t i, uint32_t j, uint32_t outer);

  const Polygon& polygon_;
  Measure measure_;
  Work& work_;
  Charge memory_;
  AngularTransform transform_;
  std::vector<Real> base_;        // by least vertex, then greatest, then the one between
  std::vector<size_t> firstRow_;  // [n]
  std::vector<double> theta_, cost_, inner_, outerTheta_, best_;
};

template <class Real>
bool AnglePass<Real>::finish(uint32_t i, uint32_t j) {
  const uint32_t n = polygon_.size(), count = j - i - 1;
  Real* base = row(i, j);
  // The row already has the cost of what lies behind the triangles; now their own is added.
  if (measure_.isWorst())
    polygon_.faceAngles(i, j, cost_.data());
  else
    polygon_.triangleCosts(i, j, cost_.data());
  if (measure_.isWorst() || measure_.cap() < kPi) {
    // Collinear triples, and those with too large an angle to a face, are not allowed.
    std::vector<double>& other = best_;
    if (measure_.isWorst())
      polygon_.triangleCosts(i, j, other.data());
    else
      polygon_.faceAngles(i, j, other.data());
    const double limit = measure_.isWorst() ? std::numeric_limits<double>::max() : measure_.cap();
    for (uint32_t k = 0; k < count; ++k)
      if (other[k] > limit) cost_[k] = kInfinity;
  }
  for (uint32_t k = 0; k < count; ++k) {
    inner_[k] = measure_.join(double(base[k]), cost_[k]);
    base[k] = roundedDown(inner_[k]);
  }
  if (i == 0 && j == n - 1) return work_.going();

  polygon_.anglesAround(i, j, theta_.data());
  std::copy(&theta_[0], &theta_[i], outerTheta_.begin());
  std::copy(theta_.begin() + j + 1, theta_.end(), outerTheta_.begin() + i);
  const uint32_t outer = n - count - 2;
  transform_.apply(&theta_[i + 1], inner_.data(), count, outerTheta_.data(), outer, best_.data());
  for (uint32_t l = 0; l < i; ++l) {
    Real& at = row(l, j)[i - l - 1];
    at = roundedDown(measure_.join(double(at), best_[l]));
  }
  for (uint32_t l = j + 1; l < n; ++l) {
    Real& at = row(i, l)[j - i - 1];
    at = roundedDown(measure_.join(double(at), best_[i + l - j - 1]));
  }
  return work_.tick(20 * n + 10 * count);
}

template <class Real>
bool AnglePass<Real>::solve(double& cost) {
  const uint32_t n = polygon_.size();
  if (!memory_.add(size_t(bytes(n)))) return false;
  firstRow_.resize(n);
  size_t rows = 0;
  for (uint32_t i = 0; i < n; ++i) {
    firstRow_[i] = rows;
    const size_t longest = n - i - 1;
    if (longest > 1) rows += longest * (longest - 1) / 2;
  }
  base_.assign(rows, Real(0));
  for (std::vector<double>* v : {&theta_, &cost_, &inner_, &outerTheta_, &best_}) v->resize(n);
  double done = 0;
  const double all = double(n) * n / 2;
  for (uint32_t length = 2; length < n; ++length) {
    for (uint32_t i = 0; i + length < n; ++i)
      if (!finish(i, i + length)) return false;
    work_.setFraction((done += n - length) / all);
  }
  const Real* root = row(0, n - 1);
  cost = double(*std::min_element(root, root + (n - 2)));
  return true;
}

template <class Real>
uint32_t AnglePass<Real>::bestApex(uint32_t i, uint32_t j, uint32_t outer) {
  const Real* base = row(i, j);
  const bool root = outer == kNone;
  if (!root) polygon_.anglesAround(i, j, theta_.data());
  uint32_t apex = i + 1;
  double best = kInfinity;
  for (uint32_t k = i + 1; k < j; ++k) {
    const double pair = root ? 0 : measure_.pair(theta_[k], theta_[outer]);
    const double w = measure_.join(double(base[k - i - 1]), pair);
    if (w < best) best = w, apex = k;
  }
  return apex;
}

template <class Real>
void AnglePass<Real>::trace(std::vector<uint32_t>& triangles) {
  struct Open {
    uint32_t i, j, outer;
  };
  std::vector<Open> queue{{0, polygon_.size() - 1, kNone}};
  for (size_t at = 0; at < queue.size(); ++at) {
    const auto [i, j, outer] = queue[at];
    if (j - i < 2) continue;
    const uint32_t k = bestApex(i, j, outer);
    triangles.insert(triangles.end(), {i, k, j});
    queue.push_back({i, k, j});
    queue.push_back({k, j, i});
  }
}

/// The pass where no weight couples neighbours: eq. 1, one number for each segment.
class PlainPass {
 public:
  PlainPass(const Polygon& polygon, Work& work) : polygon_(polygon), work_(work), memory_(work) {}

  static double bytes(double n) { return 2 * n * n * sizeof(double) + 8 * n; }

  bool solve(double& cost) {
    const uint32_t n = polygon_.size();
    if (!memory_.add(size_t(bytes(n)))) return false;
    forward_.assign(size_t(n) * n, 0);
    backward_.assign(size_t(n) * n, 0);
    triangle_.resize(n);
    double done = 0;
    for (uint32_t length = 2; length < n; ++length) {
      for (uint32_t i = 0; i + length < n; ++i) {
        const uint32_t j = i + length;
        polygon_.triangleCosts(i, j, triangle_.data());
        const double w = least(&forward_[size_t(i) * n + i + 1], &backward_[size_t(j) * n + i + 1],
                               triangle_.data(), length - 1);
        forward_[size_t(i) * n + j] = w;
        backward_[size_t(j) * n + i] = w;
        if (!work_.tick(20 + 3 * length)) return false;
      }
      work_.setFraction((done += n - length) / (double(n) * n / 2));
    }
    cost = forward_[n - 1];
    return true;
  }

  void trace(std::vector<uint32_t>& triangles) {
    const uint32_t n = polygon_.size();
    std::vector<std::pair<uint32_t, uint32_t>> queue{{0, n - 1}};
    for (size_t at = 0; at < queue.size(); ++at) {
      const auto [i, j] = queue[at];
      if (j - i < 2) continue;
      polygon_.triangleCosts(i, j, triangle_.data());
      uint32_t apex = i + 1;
      double best = kInfinity;
      for (uint32_t k = i + 1; k < j; ++k) {
        const double w =
            triangle_[k - i - 1] + forward_[size_t(i) * n + k] + forward_[size_t(k) * n + j];
        if (w < best) best = w, apex = k;
      }
      triangles.insert(triangles.end(), {i, apex, j});
      queue.push_back({i, apex});
      queue.push_back({apex, j});
    }
  }

 private:
  static double least(const double* a, const double* b, const double* c, uint32_t count) {
    // Four at a time: a single minimum would wait for itself at every step.
    double best[4] = {kInfinity, kInfinity, kInfinity, kInfinity};
    uint32_t k = 0;
    for (; k + 4 <= count; k += 4)
      for (uint32_t lane = 0; lane < 4; ++lane) {
        const double w = a[k + lane] + b[k + lane] + c[k + lane];
        best[lane] = w < best[lane] ? w : best[lane];
      }
    for (; k < count; ++k) best[0] = std::min(best[0], a[k] + b[k] + c[k]);
    return std::min(std::min(best[0], best[1]), std::min(best[2], best[3]));
  }

  const Polygon& polygon_;
  Work& work_;
  Charge memory_;
  std::vector<double> forward_, backward_, triangle_;  // W(i, j) at [i][j], and at [j][i]
};

/// Solves and traces one pass.
template <class Pass>
bool run(Pass&& pass, double& cost, std::vector<uint32_t>& triangles) {
  if (!pass.solve(cost)) return false;
  triangles.clear();
  if (cost < kInfinity) pass.trace(triangles);
  return true;
}

bool runAngles(const Polygon& polygon, Measure measure, Work& work, double& cost,
               PolygonSurface& surface) {
  const double n = polygon.size();
  surface.optimal = surface.optimal && work.fits(AnglePass<double>::bytes(n));
  if (surface.optimal)
    return run(AnglePass<double>(polygon, measure, work), cost, surface.triangles);
  return run(AnglePass<float>(polygon, measure, work), cost, surface.triangles);
}

}  // namespace

double bytesForPolygon(double n, bool looksAtAngles) {
  return looksAtAngles ? AnglePass<float>::bytes(n) : PlainPass::bytes(n);
}

bool solvePolygon(const LoopSet& loops, const TriangleWeights& weights, Objective objective,
                  Work& work, PolygonSurface& surface) {
  surface = {};
  surface.optimal = true;
  const bool looksAtAngles = weights.dihedral > 0 || objective == Objective::WorstDihedral;
  if (!work.fits(bytesForPolygon(loops.vertexCount(), looksAtAngles))) {
    work.fail(Status::TooLarge);
    return false;
  }
  const Polygon polygon(loops, weights);
  double cost = kInfinity;
  if (objective == Objective::Sum) {
    work.phase(0, 1);
    if (looksAtAngles) {
      if (!runAngles(polygon, Measure::sum(weights.dihedral), work, cost, surface)) return false;
    } else if (!run(PlainPass(polygon, work), cost, surface.triangles)) {
      return false;
    }
    surface.lowerBound = cost;
  } else {
    work.phase(0, 0.5);
    if (!runAngles(polygon, Measure::worst(), work, cost, surface)) return false;
    surface.lowerBound = cost;
    if (cost < kInfinity) {
      work.phase(0.5, 1);
      // Bases in single precision are low by up to 2^-23 of their value.
      const double cap = (surface.optimal ? cost : cost * (1 + 2e-7)) + kAngleTie;
      const Measure capped = Measure::sum(weights.dihedral, cap);
      if (!runAngles(polygon, capped, work, cost, surface)) return false;
    }
  }
  surface.found = cost < kInfinity;
  return true;
}

}  // namespace sf
