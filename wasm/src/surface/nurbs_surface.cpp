#include "surface/nurbs_surface.h"

#include <algorithm>
#include <cmath>

namespace sf {
namespace {

/// A normal shorter than this share of the product of the derivatives' usual lengths is none.
constexpr double kFlat = 1e-9;

using Homogeneous = double[4];

/// Value and derivatives of a point from homogeneous ones: w = 1 and constant where the surface is not rational.
SurfacePoint project(const Homogeneous (&a)[6]) {
  const auto part = [&](int i) { return Vec3{a[i][0], a[i][1], a[i][2]}; };
  const double w = a[0][3], wu = a[1][3], wv = a[2][3];
  SurfacePoint p;
  const double s = 1 / w;
  p.at = s * part(0);
  p.u = s * (part(1) - wu * p.at);
  p.v = s * (part(2) - wv * p.at);
  p.uu = s * (part(3) - 2 * wu * p.u - a[3][3] * p.at);
  p.uv = s * (part(4) - wu * p.v - wv * p.u - a[4][3] * p.at);
  p.vv = s * (part(5) - 2 * wv * p.v - a[5][3] * p.at);
  return p;
}

}  // namespace

NurbsSurface::NurbsSurface(const NurbsSurfaceView& s)
    : u_(s.u), v_(s.v), channels_(s.weights.empty() ? 3 : 4) {
  const uint32_t p = u_.degree() + 1, q = v_.degree() + 1, columns = s.v.count(), c = channels_;
  points_.assign(size_t(u_.count()) * v_.count() * p * q * c, 0);
  std::vector<double> rows(size_t(p) * columns * c);
  double* out = points_.data();
  for (uint32_t iu = 0; iu < u_.count(); ++iu) {
    // Along u first: [p] rows of Bézier points for all columns of poles.
    const ArrayView<const double> fu = u_.factors(iu);
    std::fill(rows.begin(), rows.end(), 0);
    for (uint32_t j = 0; j < p; ++j)
      for (uint32_t k = 0; k < p; ++k) {
        const double f = fu[size_t(j) * p + k];
        if (f == 0) continue;
        const size_t pole = size_t(u_.firstPole(iu) + k) * columns;
        double* row = &rows[size_t(j) * columns * c];
        for (uint32_t i = 0; i < columns; ++i) {
          const double w = c == 4 ? f * s.weights[pole + i] : f;
          for (uint32_t axis = 0; axis < 3; ++axis)
            row[i * c + axis] += w * s.poles[3 * (pole + i) + axis];
          if (c == 4) row[i * c + 3] += w;
        }
      }
    for (uint32_t iv = 0; iv < v_.count(); ++iv) {
      const ArrayView<const double> fv = v_.factors(iv);
      for (uint32_t j = 0; j < p; ++j) {
        const double* row = &rows[(size_t(j) * columns + v_.firstPole(iv)) * c];
        for (uint32_t l = 0; l < q; ++l, out += c)
          for (uint32_t k = 0; k < q; ++k)
            for (uint32_t channel = 0; channel < c; ++channel)
              out[channel] += fv[size_t(l) * q + k] * row[k * c + channel];
      }
    }
  }
}

NurbsSurface::Local NurbsSurface::localIn(const BezierSpans& spans, double t) {
  const uint32_t span = spans.spanAt(t);
  const double a = spans.breaks()[span], b = spans.breaks()[span + 1];
  return {span, (t - a) / (b - a)};
}

const double* NurbsSurface::patch(uint32_t iu, uint32_t iv) const {
  const size_t size = size_t(u_.degree() + 1) * (v_.degree() + 1) * channels_;
  return points_.data() + (size_t(iu) * v_.count() + iv) * size;
}

SurfacePoint NurbsSurface::at(double u, double v) const {
  const Local lu = localIn(u_, u), lv = localIn(v_, v);
  const uint32_t p = u_.degree() + 1, q = v_.degree() + 1, c = channels_;
  Bernstein bu, bv;
  bu.at(p - 1, lu.x), bv.at(q - 1, lv.x);
  // At, u, v, uu, uv, vv.
  Homogeneous sums[6] = {};
  const double* point = patch(lu.span, lv.span);
  for (uint32_t j = 0; j < p; ++j) {
    Homogeneous rows[3] = {};
    for (uint32_t l = 0; l < q; ++l, point += c)
      for (uint32_t channel = 0; channel < c; ++channel) {
        rows[0][channel] += bv.value[l] * point[channel];
        rows[1][channel] += bv.first[l] * point[channel];
        rows[2][channel] += bv.second[l] * point[channel];
      }
    for (uint32_t channel = 0; channel < c; ++channel) {
      sums[0][channel] += bu.value[j] * rows[0][channel];
      sums[1][channel] += bu.first[j] * rows[0][channel];
      sums[2][channel] += bu.value[j] * rows[1][channel];
      sums[3][channel] += bu.second[j] * rows[0][channel];
      sums[4][channel] += bu.first[j] * rows[1][channel];
      sums[5][channel] += bu.value[j] * rows[2][channel];
    }
  }
  if (c == 3) sums[0][3] = 1;
  // From parameters of the patch to those of the surface.
  const double su = 1 / (u_.breaks()[lu.span + 1] - u_.breaks()[lu.span]),
               sv = 1 / (v_.breaks()[lv.span + 1] - v_.breaks()[lv.span]);
  const double scales[6] = {1, su, sv, su * su, su * sv, sv * sv};
  for (int i = 1; i < 6; ++i)
    for (double& x : sums[i]) x *= scales[i];
  return project(sums);
}

/// Su x Sv as a unit vector, or zero if it is not clear.
Vec3 NurbsSurface::usualNormal(const SurfacePoint& p) const {
  const Vec3 n = p.normal();
  const double size = length(n), usual = length(p.u) * length(p.v);
  // Lengths of a degenerate side are not zero exactly: what the surface has across the domain is the measure.
  const double du = u_.breaks()[u_.count()] - u_.breaks()[0],
               dv = v_.breaks()[v_.count()] - v_.breaks()[0];
  const double across = std::fmax(length(p.u) * du, length(p.v) * dv);
  const bool isClear = size > kFlat * usual && size * du * dv > kFlat * across * across;
  return isClear ? (1 / size) * n : Vec3{0, 0, 0};
}

Vec3 NurbsSurface::nearbyNormal(double u, double v) const {
  const double middleU = 0.5 * (u_.breaks()[0] + u_.breaks()[u_.count()]),
               middleV = 0.5 * (v_.breaks()[0] + v_.breaks()[v_.count()]);
  for (const double share : {1e-6, 1e-4, 1e-2}) {
    const Vec3 n = usualNormal(at(u + share * (middleU - u), v + share * (middleV - v)));
    if (dot(n, n) > 0) return n;
  }
  return {0, 0, 0};
}

Vec3 NurbsSurface::normalAt(double u, double v) const {
  const Vec3 n = usualNormal(at(u, v));
  return dot(n, n) > 0 ? n : nearbyNormal(u, v);
}

void NurbsSurface::grid(ArrayView<const double> us, ArrayView<const double> vs, double* positions,
                        double* normals) const {
  const uint32_t p = u_.degree() + 1, q = v_.degree() + 1, c = channels_, width = v_.count() * q;
  std::vector<Bernstein> bv(vs.size());
  std::vector<Local> lv;
  for (size_t k = 0; k < vs.size(); ++k) {
    lv.push_back(localIn(v_, vs[k]));
    bv[k].at(q - 1, lv[k].x);
  }
  // Of one u-line: Bézier points along it, and of the derivative by u.
  std::vector<double> line(size_t(width) * c), across(size_t(width) * c);
  Bernstein bu;
  for (const double u : us) {
    const Local lu = localIn(u_, u);
    bu.at(p - 1, lu.x);
    std::fill(line.begin(), line.end(), 0), std::fill(across.begin(), across.end(), 0);
    for (uint32_t iv = 0; iv < v_.count(); ++iv) {
      const double* point = patch(lu.span, iv);
      double *l = &line[size_t(iv) * q * c], *a = &across[size_t(iv) * q * c];
      for (uint32_t j = 0; j < p; ++j)
        for (uint32_t i = 0; i < q * c; ++i, ++point)
          l[i] += bu.value[j] * *point, a[i] += bu.first[j] * *point;
    }
    for (size_t k = 0; k < vs.size(); ++k, positions += 3, normals += 3) {
      const size_t first = size_t(lv[k].span) * q * c;
      Homogeneous s = {}, su = {}, sv = {};
      for (uint32_t l = 0; l < q; ++l)
        for (uint32_t channel = 0; channel < c; ++channel) {
          const double x = line[first + l * c + channel];
          s[channel] += bv[k].value[l] * x;
          su[channel] += bv[k].value[l] * across[first + l * c + channel];
          sv[channel] += bv[k].first[l] * x;
        }
      SurfacePoint point;
      const double w = c == 4 ? 1 / s[3] : 1;
      point.at = w * Vec3{s[0], s[1], s[2]};
      point.u = w * (Vec3{su[0], su[1], su[2]} - su[3] * point.at);
      point.v = w * (Vec3{sv[0], sv[1], sv[2]} - sv[3] * point.at);
      // As lengths along the surface's parameters: the same test as elsewhere.
      const double hu = u_.breaks()[lu.span + 1] - u_.breaks()[lu.span],
                   hv = v_.breaks()[lv[k].span + 1] - v_.breaks()[lv[k].span];
      point.u = (1 / hu) * point.u, point.v = (1 / hv) * point.v;
      Vec3 n = usualNormal(point);
      if (dot(n, n) == 0) n = nearbyNormal(u, vs[k]);
      positions[0] = point.at.x, positions[1] = point.at.y, positions[2] = point.at.z;
      normals[0] = n.x, normals[1] = n.y, normals[2] = n.z;
    }
  }
}

}  // namespace sf
