#include "support/cases.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "support/self_intersection.h"

namespace sftest {
namespace {

const double kNaN = std::nan("");
const double kPi = std::acos(-1.0);

double dyadic(double x, double step = 1.0 / 64) { return std::round(x / step) * step; }

Vec3 latticePoint(uint32_t side, Random& random) {
  double x = random.below(side), y = random.below(side);
  return {x, y, double(random.below(side))};
}

/// One of the 48 points with coordinates +-1, +-2, +-3 in some order: all on one sphere.
Vec3 spherePoint(Random& random) {
  double c[3] = {1, 2, 3};
  std::swap(c[0], c[random.below(3)]);
  std::swap(c[1], c[1 + random.below(2)]);
  for (double& x : c)
    if (random.chance(0.5)) x = -x;
  return {c[0], c[1], c[2]};
}

Curve starPolygon(uint32_t n, double inner, double outer, Vec3 centre, Random& random) {
  Curve curve;
  double turn = random.range(0, 2 * kPi);
  for (uint32_t i = 0; i < n; ++i) {
    double t = turn + 2 * kPi * (i + random.range(-0.3, 0.3)) / n, r = random.range(inner, outer);
    curve.push_back(
        {centre.x + dyadic(r * std::cos(t)), centre.y + dyadic(r * std::sin(t)), centre.z});
  }
  return curve;
}

/// Outer loop 0 with the others side by side in it, or all of them side by side.
Curves planarLoops(const std::vector<uint32_t>& sizes, Random& random) {
  bool nested = random.chance(0.5);
  Curves curves;
  for (uint32_t c = 0; c < sizes.size(); ++c) {
    if (nested && c == 0)
      curves.push_back(starPolygon(sizes[c], 8, 10, {0, 0, 0}, random));
    else
      curves.push_back(
          starPolygon(sizes[c], 0.3, 1, {nested ? 2.5 * c - 3.75 : 2.5 * c, 0, 0}, random));
  }
  return curves;
}

/// Regular rings along an axis or at the corners of a regular polygon: many tied surfaces.
Curves rings(const std::vector<uint32_t>& sizes, Random& random) {
  Curves curves;
  bool stacked = random.chance(0.5);
  double gap = random.range(0.5, 2);
  for (uint32_t c = 0; c < sizes.size(); ++c) {
    double t = 2 * kPi * c / double(std::max<size_t>(3, sizes.size()));
    Vec3 outward{std::cos(t), std::sin(t), 0};
    if (stacked)
      curves.push_back(circle(sizes[c], 1, {0, 0, gap * c}));
    else
      curves.push_back(circle(sizes[c], 0.5, (1 + gap) * outward, outward));
  }
  return curves;
}

/// Triangles whose sides carry the other vertices, evenly spread, in dyadic coordinates.
Curves collinearRuns(const std::vector<uint32_t>& sizes, Random& random) {
  Curves curves;
  for (uint32_t c = 0; c < sizes.size(); ++c) {
    Vec3 corner[3];
    for (Vec3& p : corner) p = 4.0 * latticePoint(4, random) + Vec3{0, 0, 3.0 * c};
    Curve curve;
    for (uint32_t side = 0; side < 3; ++side) {
      uint32_t parts = (sizes[c] + side) / 3;
      Vec3 a = corner[side], b = corner[(side + 1) % 3];
      for (uint32_t i = 0; i < parts; ++i) curve.push_back(a + (i / 4.0) * (b - a));
    }
    curves.push_back(curve);
  }
  return curves;
}

Curves tryLoops(Shape shape, const std::vector<uint32_t>& sizes, Random& random) {
  if (shape == Shape::Random) return randomLoops(sizes, random.range(0, 1.2), random);
  if (shape == Shape::Planar) return planarLoops(sizes, random);
  if (shape == Shape::Rings) return rings(sizes, random);
  if (shape == Shape::CollinearRuns) return collinearRuns(sizes, random);
  uint32_t side = 3 + random.below(3);
  Curves curves;
  for (uint32_t size : sizes) {
    Curve curve;
    for (uint32_t i = 0; i < size; ++i)
      curve.push_back(shape == Shape::Lattice ? latticePoint(side, random) : spherePoint(random));
    curves.push_back(curve);
  }
  return curves;
}

}  // namespace

sf::SpanOptions Problem::view() const {
  sf::SpanOptions viewed = options;
  viewed.boundaryNormals = normals;
  viewed.triangles = triangles;
  viewed.triangleWeights = triangleWeights;
  viewed.start = start;
  return viewed;
}

uint32_t Problem::vertexCount() const {
  size_t n = 0;
  for (const Curve& curve : curves) n += curve.size();
  return uint32_t(n);
}

std::string Problem::text() const {
  char head[200];
  std::snprintf(head, sizeof head,
                "area %.17g perimeter %.17g dihedral %.17g objective %d space %d\nloops ",
                options.areaWeight, options.perimeterWeight, options.dihedralWeight,
                int(options.objective), int(options.space));
  std::string result = head + describe(curves);
  auto list = [&](const char* name, const auto& values) {
    if (values.empty()) return;
    result += std::string("\n") + name;
    for (auto value : values) {
      std::snprintf(head, sizeof head, " %.17g", double(value));
      result += head;
    }
  };
  list("normals", normals);
  list("triangles", triangles);
  list("own weights", triangleWeights);
  return result;
}

Problem renumbered(const Problem& before, const Curves& curves, const std::vector<uint32_t>& origin,
                   const std::vector<char>& turned) {
  Problem after = before;
  after.curves = curves;
  sf::LoopSet loops = loopSet(before.curves);
  std::vector<uint32_t> now(origin.size());
  for (uint32_t i = 0; i < origin.size(); ++i) now[origin[i]] = i;
  for (uint32_t& v : after.triangles) v = now[v];
  if (before.normals.empty()) return after;
  for (uint32_t i = 0; i < origin.size(); ++i) {
    uint32_t edge = turned[i] ? loops.previous(origin[i]) : origin[i];
    for (int j = 0; j < 3; ++j)
      after.normals[3 * i + j] = (turned[i] ? -1 : 1) * before.normals[3 * edge + j];
  }
  return after;
}

Problem shuffled(const Problem& before, Random& random) {
  const sf::LoopSet loops = loopSet(before.curves);
  std::vector<uint32_t> loopOrder;
  for (uint32_t c = 0; c < loops.loopCount(); ++c)
    loopOrder.insert(loopOrder.begin() + random.below(c + 1), c);
  Curves curves;
  std::vector<uint32_t> origin;
  std::vector<char> turned;
  for (const uint32_t c : loopOrder) {
    const uint32_t n = loops.size(c), shift = random.below(n);
    const bool reversed = random.chance(0.5);
    curves.emplace_back();
    for (uint32_t i = 0; i < n; ++i) {
      const uint32_t at = (shift + (reversed ? n - i : i)) % n;
      curves.back().push_back(before.curves[c][at]);
      origin.push_back(loops.first(c) + at);
      turned.push_back(reversed);
    }
  }
  return renumbered(before, curves, origin, turned);
}

Answer solve(const Problem& problem) {
  Answer answer;
  sf::Work work;
  answer.outcome = sf::spanLoops(loopSet(problem.curves), problem.view(), work, answer.span);
  return answer;
}

bool loopsMeet(const Curves& curves) {
  std::vector<Vec3> from, to;
  for (const Curve& curve : curves)
    for (size_t i = 0; i < curve.size(); ++i) {
      from.push_back(curve[i]);
      to.push_back(curve[(i + 1) % curve.size()]);
    }
  for (size_t i = 0; i < from.size(); ++i)
    for (size_t j = 0; j < i; ++j) {
      if (from[i] == from[j]) return true;
      bool follows = from[i] == to[j], leads = from[j] == to[i];
      if (!follows && !leads) {
        if (segmentsMeet(from[i], to[i], from[j], to[j])) return true;
        continue;
      }
      // Neighbours meet in more than their common vertex only if they fold back on one line.
      Vec3 common = follows ? from[i] : from[j];
      Vec3 a = follows ? to[i] : from[i], b = follows ? from[j] : to[j];
      if (!(a == b) && collinear(a, common, b) && dot(a - common, b - common) > 0) return true;
    }
  return false;
}

const char* nameOf(Shape shape) {
  const char* names[] = {"random", "lattice", "planar", "spherical", "rings", "collinear runs"};
  return names[int(shape)];
}

Curves loopsOf(Shape shape, const std::vector<uint32_t>& sizes, Random& random) {
  for (;;) {
    Curves curves = tryLoops(shape, sizes, random);
    if (!loopsMeet(curves)) return curves;
  }
}

const char* setWeights(int which, const Curves& curves, sf::SpanOptions& options) {
  options.areaWeight = options.perimeterWeight = options.dihedralWeight = 0;
  options.objective = which >= 5 ? sf::Objective::WorstDihedral : sf::Objective::Sum;
  switch (which) {
    case 0:
      options.areaWeight = 1;
      return "area";
    case 1:
      options.perimeterWeight = 1;
      return "perimeter";
    case 2:
      options.dihedralWeight = 1;
      return "dihedral";
    case 3:
      options.areaWeight = 1, options.perimeterWeight = 0.25, options.dihedralWeight = 0.2;
      return "mixed";
    case 4: {
      Vec3 low = curves[0][0], high = low;
      for (const Curve& curve : curves)
        for (Vec3 p : curve) {
          low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
          high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
      options.dihedralWeight = 1;
      options.areaWeight = 1e-3 / dot(high - low, high - low);
      return "default";
    }
    case 5:
      options.dihedralWeight = 1;
      return "worst";
    default:
      options.areaWeight = 1, options.dihedralWeight = 0.1;
      return "worst mixed";
  }
}

std::vector<double> randomNormals(const Curves& curves, double share, Random& random) {
  std::vector<double> normals;
  for (const Curve& curve : curves)
    for (size_t i = 0; i < curve.size(); ++i) {
      Vec3 normal = random.range(0.1, 3) * random.direction();
      if (!random.chance(share)) normal = {kNaN, kNaN, kNaN};
      normals.insert(normals.end(), {normal.x, normal.y, normal.z});
    }
  return normals;
}

std::vector<uint32_t> randomTriples(const Curves& curves, double keep, Random& random) {
  Curve all;
  for (const Curve& curve : curves) all.insert(all.end(), curve.begin(), curve.end());
  std::vector<std::vector<uint32_t>> triples;
  for (uint32_t a = 0; a < all.size(); ++a)
    for (uint32_t b = 0; b < a; ++b)
      for (uint32_t c = 0; c < b; ++c) {
        if (!random.chance(keep) || collinear(all[a], all[b], all[c])) continue;
        std::vector<uint32_t> triple{a, b, c};
        std::swap(triple[0], triple[random.below(3)]);
        std::swap(triple[1], triple[1 + random.below(2)]);
        triples.push_back(triple);
        std::swap(triples.back(), triples[random.below(uint32_t(triples.size()))]);
      }
  std::vector<uint32_t> flat;
  for (const auto& triple : triples) flat.insert(flat.end(), triple.begin(), triple.end());
  return flat;
}

}  // namespace sftest
