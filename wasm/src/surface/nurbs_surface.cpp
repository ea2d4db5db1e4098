#include "surface/nurbs_surface.h"

#include <algorithm>
#include <cmath>

namespace sf {
namespace {

/// A normal shorter than this share of the product of the derivatives' usual lengths is none.
constexpr double kFlat = 1e-9;

constexpr uint32_t kChannels = 4;
using Homogeneous = double[kChannels];

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

uint64_t bytesOf(const NurbsSurfaceView& view) {
  const uint64_t p = view.u.degree + 1, q = view.v.degree + 1, u = spanCount(view.u),
                 v = spanCount(view.v);
  return sizeof(NurbsSurface) + 8 * (u * v * p * q * kChannels + u * (p * p + 2) + v * (q * q + 2));
}

NurbsSurface::NurbsSurface(const NurbsSurfaceView& s)
    : u_(s.u), v_(s.v), isRational_(!s.weights.empty()) {
  const uint32_t p = u_.degree() + 1, q = v_.degree() + 1, columns = s.v.count(), c = kChannels;
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
          const double w = isRational_ ? f * s.weights[pole + i] : f;
          for (uint32_t axis = 0; axis < 3; ++axis)
            row[i * c + axis] += w * s.poles[3 * (pole + i) + axis];
          row[i * c + 3] += w;
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
  return {span, std::clamp((t - a) / (b - a), 0.0, 1.0)};
}

const double* NurbsSurface::patch(uint32_t iu, uint32_t iv) const {
  const size_t size = size_t(u_.degree() + 1) * (v_.degree() + 1) * kChannels;
  return points_.data() + (size_t(iu) * v_.count() + iv) * size;
}

SurfacePoint NurbsSurface::at(double u, double v) const {
  const Local lu = localIn(u_, u), lv = localIn(v_, v);
  const uint32_t p = u_.degree() + 1, q = v_.degree() + 1, c = kChannels;
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
  // Without weights it is that but for rounding.
  if (!isRational_)
    sums[0][3] = 1, sums[1][3] = sums[2][3] = sums[3][3] = sums[4][3] = sums[5][3] = 0;
  // From parameters of the patch to those of the surface.
  const double su = 1 / (u_.breaks()[lu.span + 1] - u_.breaks()[lu.span]),
               sv = 1 / (v_.breaks()[lv.span + 1] - v_.breaks()[lv.span]);
  const double scales[6] = {1, su, sv, su * su, su * sv, sv * sv};
  for (int i = 1; i < 6; ++i)
    for (double& x : sums[i]) x *= scales[i];
  return project(sums);
}

TangentPoint NurbsSurface::tangentsAt(double u, double v) const {
  const Local lu = localIn(u_, u), lv = localIn(v_, v);
  const uint32_t p = u_.degree() + 1, q = v_.degree() + 1;
  Bernstein bu, bv;
  bu.firstAt(p - 1, lu.x), bv.firstAt(q - 1, lv.x);
  Homogeneous s = {}, su = {}, sv = {};
  const double* point = patch(lu.span, lv.span);
  for (uint32_t j = 0; j < p; ++j) {
    Homogeneous row = {}, across = {};
    for (uint32_t l = 0; l < q; ++l, point += kChannels)
      for (uint32_t k = 0; k < kChannels; ++k)
        row[k] += bv.value[l] * point[k], across[k] += bv.first[l] * point[k];
    for (uint32_t k = 0; k < kChannels; ++k)
      s[k] += bu.value[j] * row[k], su[k] += bu.first[j] * row[k], sv[k] += bu.value[j] * across[k];
  }
  return tangentsOf(s, su, sv, lu.span, lv.span);
}

/// From homogeneous sums of a patch to the surface's parameters.
TangentPoint NurbsSurface::tangentsOf(const double (&s)[4], const double (&su)[4],
                                      const double (&sv)[4], uint32_t iu, uint32_t iv) const {
  const double hu = u_.breaks()[iu + 1] - u_.breaks()[iu],
               hv = v_.breaks()[iv + 1] - v_.breaks()[iv];
  const auto part = [](const double(&a)[4]) { return Vec3{a[0], a[1], a[2]}; };
  if (!isRational_) return {part(s), (1 / hu) * part(su), (1 / hv) * part(sv)};
  const double w = 1 / s[3];
  const Vec3 at = w * part(s);
  return {at, (w / hu) * (part(su) - su[3] * at), (w / hv) * (part(sv) - sv[3] * at)};
}

/// Su x Sv as a unit vector, or zero if it is not clear.
Vec3 NurbsSurface::usualNormal(const TangentPoint& p) const {
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
    const Vec3 n = usualNormal(tangentsAt(u + share * (middleU - u), v + share * (middleV - v)));
    if (dot(n, n) > 0) return n;
  }
  return {0, 0, 0};
}

Vec3 NurbsSurface::normalOf(const TangentPoint& p, double u, double v) const {
  const Vec3 n = usualNormal(p);
  return dot(n, n) > 0 ? n : nearbyNormal(u, v);
}

void NurbsSurface::grid(ArrayView<const double> us, ArrayView<const double> vs, double* positions,
                        double* normals) const {
  const uint32_t p = u_.degree() + 1, q = v_.degree() + 1, c = kChannels, width = v_.count() * q;
  std::vector<Bernstein> bv(vs.size());
  std::vector<Local> lv;
  for (size_t k = 0; k < vs.size(); ++k) {
    lv.push_back(localIn(v_, vs[k]));
    bv[k].firstAt(q - 1, lv[k].x);
  }
  // Of one u-line: Bézier points along it, and of the derivative by u.
  std::vector<double> line(size_t(width) * c), across(size_t(width) * c);
  Bernstein bu;
  for (const double u : us) {
    const Local lu = localIn(u_, u);
    bu.firstAt(p - 1, lu.x);
    std::fill(line.begin(), line.end(), 0), std::fill(across.begin(), across.end(), 0);
    for (uint32_t iv = 0; iv < v_.count(); ++iv) {
      const double* point = patch(lu.span, iv);
      double *l = &line[size_t(iv) * q * c], *a = &across[size_t(iv) * q * c];
      for (uint32_t j = 0; j < p; ++j)
        for (uint32_t i = 0; i < q * c; ++i, ++point)
          l[i] += bu.value[j] * *point, a[i] += bu.first[j] * *point;
    }
    for (size_t k = 0; k < vs.size(); ++k, positions += 3, normals += 3) {
      const double *l = &line[size_t(lv[k].span) * q * c], *a = &across[size_t(lv[k].span) * q * c];
      Homogeneous s = {}, su = {}, sv = {};
      for (uint32_t i = 0; i < q; ++i, l += kChannels, a += kChannels)
        for (uint32_t channel = 0; channel < kChannels; ++channel) {
          s[channel] += bv[k].value[i] * l[channel];
          su[channel] += bv[k].value[i] * a[channel];
          sv[channel] += bv[k].first[i] * l[channel];
        }
      const TangentPoint point = tangentsOf(s, su, sv, lu.span, lv[k].span);
      const Vec3 n = normalOf(point, u, vs[k]);
      positions[0] = point.at.x, positions[1] = point.at.y, positions[2] = point.at.z;
      normals[0] = n.x, normals[1] = n.y, normals[2] = n.z;
    }
  }
}

}  // namespace sf
