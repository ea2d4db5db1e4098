#include "support/polygon_generators.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "base/predicates.h"

namespace sftest {
namespace {

const double kPi = std::acos(-1.0);

Point polar(double radius, double angle) {
  return {radius * std::cos(angle), radius * std::sin(angle)};
}
double areaOf(const Ring& ring) {
  double sum = 0;
  for (size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i], b = ring[(i + 1) % ring.size()];
    sum += a.x * b.y - a.y * b.x;
  }
  return sum / 2;
}

template <class F>
Polygon mapped(const Polygon& polygon, F&& move) {
  Polygon result = polygon;
  for (uint32_t v = 0; v < polygon.vertexCount(); ++v) {
    const Point p = move(polygon.point(v));
    result.positions[2 * v] = p.x, result.positions[2 * v + 1] = p.y;
  }
  return result;
}

}  // namespace

Polygon polygonOf(const std::vector<Ring>& rings) {
  Polygon polygon;
  polygon.starts.push_back(0);
  for (const Ring& ring : rings) {
    for (const Point p : ring) polygon.positions.insert(polygon.positions.end(), {p.x, p.y});
    polygon.starts.push_back(polygon.vertexCount());
  }
  return polygon;
}

std::vector<Ring> ringsOf(const Polygon& polygon) {
  std::vector<Ring> rings(polygon.ringCount());
  for (uint32_t r = 0; r < polygon.ringCount(); ++r)
    for (uint32_t v = polygon.starts[r]; v < polygon.starts[r + 1]; ++v)
      rings[r].push_back(polygon.point(v));
  return rings;
}

std::string describe(const Polygon& polygon) {
  std::string text = "[";
  char number[80];
  for (uint32_t r = 0; r < polygon.ringCount(); ++r) {
    text += r ? ",[" : "[";
    for (uint32_t v = polygon.starts[r]; v < polygon.starts[r + 1]; ++v) {
      const Point p = polygon.point(v);
      std::snprintf(number, sizeof number, "%s[%.17g,%.17g]", v > polygon.starts[r] ? "," : "", p.x,
                    p.y);
      text += number;
    }
    text += "]";
  }
  return text + "]";
}

Ring regularRing(uint32_t n, double radius, Point centre, double turn) {
  Ring ring;
  for (uint32_t i = 0; i < n; ++i) {
    const Point p = polar(radius, turn + 2 * kPi * i / n);
    ring.push_back({centre.x + p.x, centre.y + p.y});
  }
  return ring;
}

Ring starRing(uint32_t n, double roughness, Random& random, double radius, Point centre) {
  // Angles a third to one step apart: never a half-turn between neighbours from n = 5 on.
  Ring ring;
  for (uint32_t i = 0; i < n; ++i) {
    const double angle = 2 * kPi * (i + 0.6 * random.unit()) / n;
    const Point p = polar(radius * (1 - roughness * 0.95 * random.unit()), angle);
    ring.push_back({centre.x + p.x, centre.y + p.y});
  }
  return ring;
}

Ring blobRing(uint32_t n, Random& random) {
  double amplitude[4], phase[4];
  for (int k = 0; k < 4; ++k) {
    amplitude[k] = random.range(0, 0.35 / (k + 1));
    phase[k] = random.range(0, 2 * kPi);
  }
  Ring ring;
  for (uint32_t i = 0; i < n; ++i) {
    const double angle = 2 * kPi * i / n;
    double radius = 1;
    for (int k = 0; k < 4; ++k) radius += amplitude[k] * std::cos((k + 1) * angle + phase[k]);
    ring.push_back(polar(radius, angle));
  }
  return ring;
}

namespace {

// Orders points[low..high], whose first and last stay, as a chain whose pieces have hulls that meet
// in the joints alone.
void partition(Ring& points, size_t low, size_t high, Random& random) {
  std::vector<std::pair<size_t, size_t>> todo = {{low, high}};
  while (!todo.empty()) {
    const auto [first, last] = todo.back();
    todo.pop_back();
    if (last - first < 2) continue;
    const Point a = points[first], b = points[last];
    const size_t chosen = first + 1 + random.below(uint32_t(last - first - 1));
    std::swap(points[first + 1], points[chosen]);
    const Point s = points[first + 1];
    // A line through s that has a and b on either side.
    const double t = random.range(0.05, 0.95);
    const Point q = {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
    const auto side = [&](Point p) { return sf::orient2d(s.x, s.y, q.x, q.y, p.x, p.y); };
    const int sideOfA = side(a);
    if (sideOfA == 0 || side(b) != -sideOfA) {
      todo.push_back({first, last});
      continue;
    }
    const auto middle =
        std::partition(points.begin() + long(first) + 2, points.begin() + long(last),
                       [&](Point p) { return side(p) == sideOfA; });
    const size_t at = size_t(middle - points.begin()) - 1;
    std::swap(points[first + 1], points[at]);
    todo.push_back({first, at});
    todo.push_back({at, last});
  }
}

}  // namespace

Ring partitionRing(uint32_t n, Random& random) {
  Ring points;
  for (uint32_t i = 0; i < n; ++i) {
    const double x = random.unit();
    points.push_back({x, random.unit()});
  }
  if (n < 4) return points;
  // The line through the first two points divides the others.
  const Point a = points[0], b = points[1];
  const auto middle = std::partition(points.begin() + 2, points.end(), [&](Point p) {
    return sf::orient2d(a.x, a.y, b.x, b.y, p.x, p.y) < 0;
  });
  std::rotate(points.begin() + 1, points.begin() + 2, middle);
  const size_t at = size_t(middle - points.begin()) - 1;  // b; right of a-b before it, left after
  points.push_back(a);
  partition(points, 0, at, random);
  partition(points, at, n, random);
  points.pop_back();
  if (areaOf(points) < 0) std::reverse(points.begin(), points.end());
  return points;
}

Ring combRing(uint32_t teeth, Random& random) {
  Ring ring = {{0, -0.5}, {double(teeth), -0.5}};
  for (uint32_t i = teeth; i-- > 0;) {
    ring.push_back({i + 0.95, random.range(-0.1, 0.1)});
    ring.push_back({i + random.range(0.3, 0.7), random.range(3, 5)});
    ring.push_back({i + 0.05, random.range(-0.1, 0.1)});
  }
  return ring;
}

Ring doubleCombRing(uint32_t teeth, Random& random) {
  Ring ring;
  for (uint32_t i = 0; i < teeth; ++i) {
    ring.push_back({i + 0.05, -0.5 + random.range(-0.1, 0.1)});
    ring.push_back({i + random.range(0.3, 0.7), random.range(-5, -3)});
    ring.push_back({i + 0.95, -0.5 + random.range(-0.1, 0.1)});
  }
  for (uint32_t i = teeth; i-- > 0;) {
    ring.push_back({i + 0.95, 0.5 + random.range(-0.1, 0.1)});
    ring.push_back({i + random.range(0.3, 0.7), random.range(3, 5)});
    ring.push_back({i + 0.05, 0.5 + random.range(-0.1, 0.1)});
  }
  return ring;
}

Ring interleavedCombRing(uint32_t teeth, Random& random) {
  Ring ring = {{-1, 0}};
  for (uint32_t i = 0; i < teeth; ++i) {
    ring.push_back({i - 0.1, random.range(-0.01, 0.01)});
    ring.push_back({i + random.range(-0.05, 0.05), random.range(8.5, 9.5)});
    ring.push_back({i + 0.1, random.range(-0.01, 0.01)});
  }
  ring.push_back({double(teeth), 0});
  ring.push_back({double(teeth), 10});
  for (uint32_t i = teeth; i-- > 0;) {
    ring.push_back({i + 0.6, 10 + random.range(-0.01, 0.01)});
    ring.push_back({i + random.range(0.45, 0.55), random.range(0.5, 1.5)});
    ring.push_back({i + 0.4, 10 + random.range(-0.01, 0.01)});
  }
  ring.push_back({-1, 10});
  return ring;
}

Ring spiralRing(uint32_t n, double turns) {
  // Both arms have their vertices at the same angles in every turn, so that no chord cuts another.
  const uint32_t perTurn = std::max(3u, uint32_t(n / 2 / turns));
  const uint32_t samples = std::max(2u, uint32_t(perTurn * turns));
  Ring ring;
  const auto at = [&](uint32_t i, double offset) {
    return polar(1 + double(i) / perTurn + offset, 2 * kPi * (i % perTurn) / perTurn);
  };
  for (uint32_t i = 0; i < samples; ++i) ring.push_back(at(i, 0.5));
  for (uint32_t i = samples; i-- > 0;) ring.push_back(at(i, 0));
  return ring;
}

Ring kochRing(uint32_t levels) {
  Ring ring = regularRing(3, 1, {0, 0}, 0.3);
  for (; levels > 0; --levels) {
    Ring finer;
    for (size_t i = 0; i < ring.size(); ++i) {
      const Point a = ring[i], b = ring[(i + 1) % ring.size()];
      const double dx = (b.x - a.x) / 3, dy = (b.y - a.y) / 3;
      const double h = std::sqrt(3.0) / 2;  // the tip lies to the right, outside
      finer.push_back(a);
      finer.push_back({a.x + dx, a.y + dy});
      finer.push_back({a.x + 1.5 * dx + h * dy, a.y + 1.5 * dy - h * dx});
      finer.push_back({a.x + 2 * dx, a.y + 2 * dy});
    }
    ring = finer;
  }
  return ring;
}

Ring staircaseRing(uint32_t steps) {
  Ring ring;
  for (uint32_t i = 0; i < steps; ++i) {
    ring.push_back({double(i) + 2, double(i)});
    ring.push_back({double(i) + 2, double(i) + 1});
  }
  for (uint32_t i = steps; i-- > 0;) {
    ring.push_back({double(i), double(i) + 1});
    ring.push_back({double(i), double(i)});
  }
  return ring;
}

Ring zigzagRing(uint32_t n, Random& random) {
  const uint32_t half = std::max(2u, n / 2);
  std::vector<double> height(half);
  for (double& h : height) h = random.range(-2, 2);
  Ring ring;
  for (uint32_t i = 0; i < half; ++i) ring.push_back({double(i), height[i] - 0.3});
  for (uint32_t i = half; i-- > 0;) ring.push_back({double(i), height[i] + 0.3});
  return ring;
}

Ring fanRing(uint32_t n, Random& random) {
  Ring ring;
  for (uint32_t i = 0; i < n; ++i) {
    const double radius = i % 2 ? random.range(1e-7, 2e-7) : random.range(0.5, 1);
    ring.push_back(polar(radius, 2 * kPi * (i + 0.4 * random.unit()) / n));
  }
  return ring;
}

Polygon holeGrid(uint32_t columns, uint32_t rows, bool aligned, Random& random) {
  std::vector<Ring> rings = {
      {{0, 0}, {double(columns), 0}, {double(columns), double(rows)}, {0, double(rows)}}};
  for (uint32_t j = 0; j < rows; ++j)
    for (uint32_t i = 0; i < columns; ++i)
      rings.push_back(
          regularRing(4, 0.45, {i + 0.5, j + 0.5}, aligned ? kPi / 4 : random.range(0, 2 * kPi)));
  return polygonOf(rings);
}

Polygon starsInHoles(uint32_t columns, uint32_t rows, uint32_t corners, Random& random) {
  Polygon grid = holeGrid(columns, rows, true, random);
  std::vector<Ring> rings = {ringsOf(grid)[0]};
  for (uint32_t j = 0; j < rows; ++j)
    for (uint32_t i = 0; i < columns; ++i)
      rings.push_back(starRing(corners, 0.9, random, 0.48, {i + 0.5, j + 0.5}));
  return polygonOf(rings);
}

GriddedBlob blobWithGrid(uint32_t samples, uint32_t columns, Random& random) {
  GriddedBlob blob;
  const Ring ring = blobRing(samples, random);
  blob.polygon = polygonOf({ring});
  const auto isInside = [&](Point p) {
    bool inside = false;
    for (size_t i = 0; i < ring.size(); ++i) {
      const Point a = ring[i], b = ring[(i + 1) % ring.size()];
      const double length = std::hypot(b.x - a.x, b.y - a.y);
      const double cross = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
      if (std::fabs(cross) < 1e-6 * length) return false;  // near the line of an edge: leave it out
      if ((a.y > p.y) != (b.y > p.y) && (cross > 0) == (b.y > a.y)) inside = !inside;
    }
    return inside;
  };
  for (uint32_t j = 0; j < columns; ++j)
    for (uint32_t i = 0; i < columns; ++i) {
      const Point p = {-2 + 4 * (i + 0.5) / columns, -2 + 4 * (j + 0.5) / columns};
      if (isInside(p)) blob.inner.push_back(p);
    }
  return blob;
}

namespace {

using Arc = std::pair<uint32_t, uint32_t>;

// Closed walks along directed edges that have the interior to the left. At every point a walk turns
// into the first edge clockwise (about the interior) or counter-clockwise (about the exterior).
std::vector<std::vector<uint32_t>> walksAlong(const std::vector<Arc>& arcs,
                                              const std::vector<Point>& points,
                                              const std::vector<bool>& aboutInterior) {
  std::multimap<uint32_t, uint32_t> out;
  for (const Arc& a : arcs) out.insert(a);
  std::vector<std::vector<uint32_t>> walks;
  while (!out.empty()) {
    const uint32_t start = out.begin()->first;
    uint32_t u = start, v = out.begin()->second;
    out.erase(out.begin());
    std::vector<uint32_t> walk = {u};
    for (;;) {
      // The walk ends once no edge of the first point fits better than the one it began with, which
      // is just when it comes back to that one; on erasing that is the only one left to take.
      const Point p = points[v];
      const double back = std::atan2(points[u].y - p.y, points[u].x - p.x);
      auto best = out.end();
      double least = 0;
      const auto turnTo = [&](uint32_t w) {
        double turn = back - std::atan2(points[w].y - p.y, points[w].x - p.x);
        while (turn <= 0) turn += 2 * kPi;
        while (turn > 2 * kPi) turn -= 2 * kPi;
        return aboutInterior[v] ? turn : 2 * kPi - turn;
      };
      const auto range = out.equal_range(v);
      for (auto it = range.first; it != range.second; ++it)
        if (best == out.end() || turnTo(it->second) < least) best = it, least = turnTo(it->second);
      const bool closes =
          v == start && (best == out.end() || turnTo(walk[1 % walk.size()]) < least);
      if (closes && walk.size() > 1) break;
      walk.push_back(v);
      u = v, v = best->second;
      out.erase(best);
    }
    walks.push_back(walk);
  }
  return walks;
}

// Simple rings out of closed walks: a loop is cut off wherever a point comes again.
std::vector<std::vector<uint32_t>> simpleRings(const std::vector<std::vector<uint32_t>>& walks) {
  std::vector<std::vector<uint32_t>> rings;
  for (const auto& walk : walks) {
    std::vector<uint32_t> stack;
    for (const uint32_t v : walk) {
      const auto at = std::find(stack.begin(), stack.end(), v);
      if (at != stack.end()) {
        rings.emplace_back(at, stack.end());
        stack.erase(at, stack.end());
      }
      stack.push_back(v);
    }
    rings.push_back(stack);
  }
  return rings;
}

}  // namespace

Polygon latticeRegion(uint32_t columns, uint32_t count, bool moved, bool selfTouching,
                      Random& random) {
  std::vector<Point> points;
  for (uint32_t j = 0; j < columns; ++j)
    for (uint32_t i = 0; i < columns; ++i) {
      const double dx = moved ? random.range(-0.2, 0.2) : 0,
                   dy = moved ? random.range(-0.2, 0.2) : 0;
      points.push_back({i + dx, j + dy});
    }
  std::vector<uint32_t> triangles;
  for (uint32_t j = 0; j + 1 < columns; ++j)
    for (uint32_t i = 0; i + 1 < columns; ++i) {
      const uint32_t a = j * columns + i, b = a + 1, c = b + columns, d = a + columns;
      if (random.chance(0.5))
        triangles.insert(triangles.end(), {a, b, c, a, c, d});
      else
        triangles.insert(triangles.end(), {a, b, d, b, c, d});
    }
  std::map<Arc, uint32_t> faceOf;
  const uint32_t m = uint32_t(triangles.size() / 3);
  for (uint32_t t = 0; t < m; ++t)
    for (uint32_t e = 0; e < 3; ++e)
      faceOf[{triangles[3 * t + e], triangles[3 * t + (e + 1) % 3]}] = t;
  // The region grows by random faces across its edges.
  std::vector<bool> chosen(m);
  std::vector<uint32_t> rim = {random.below(m)};
  for (uint32_t size = 0; size < count && !rim.empty();) {
    const uint32_t at = random.below(uint32_t(rim.size())), t = rim[at];
    rim[at] = rim.back(), rim.pop_back();
    if (chosen[t]) continue;
    chosen[t] = true, ++size;
    for (uint32_t e = 0; e < 3; ++e) {
      const auto it = faceOf.find({triangles[3 * t + (e + 1) % 3], triangles[3 * t + e]});
      if (it != faceOf.end() && !chosen[it->second]) rim.push_back(it->second);
    }
  }
  std::vector<Arc> boundary;
  for (const auto& [arc, t] : faceOf) {
    const auto twin = faceOf.find({arc.second, arc.first});
    if (chosen[t] && (twin == faceOf.end() || !chosen[twin->second])) boundary.push_back(arc);
  }
  std::vector<bool> aboutInterior(points.size(), true);
  if (selfTouching)
    for (size_t v = 0; v < points.size(); ++v) aboutInterior[v] = random.chance(0.5);
  auto walks = walksAlong(boundary, points, aboutInterior);
  if (!selfTouching) walks = simpleRings(walks);
  std::vector<Ring> rings;
  for (const auto& walk : walks) {
    Ring ring;
    for (const uint32_t v : walk) ring.push_back(points[v]);
    rings.push_back(ring);
    if (areaOf(ring) > 0) std::swap(rings.front(), rings.back());
  }
  return polygonOf(rings);
}

Polygon smallPolygon(Random& random) {
  const uint32_t n = 5 + random.below(random.chance(0.2) ? 96 : 30);
  switch (random.below(14)) {
    case 0:
      return polygonOf({starRing(n, random.unit(), random)});
    case 1:
      return polygonOf({blobRing(n, random)});
    case 2:
      return polygonOf({combRing(1 + n / 4, random)});
    case 3:
      return polygonOf({doubleCombRing(1 + n / 6, random)});
    case 4:
      return polygonOf({interleavedCombRing(1 + n / 6, random)});
    case 5:
      return polygonOf({spiralRing(n, 1 + random.below(3))});
    case 6:
      return polygonOf({staircaseRing(2 + n / 4)});
    case 7:
      return polygonOf({zigzagRing(n, random)});
    case 8:
      return holeGrid(1 + random.below(3), 1 + random.below(3), random.chance(0.3), random);
    case 9:
      return starsInHoles(1 + random.below(2), 1 + random.below(2), 5 + n / 5, random);
    case 10:
    case 11:
      return latticeRegion(3 + n / 10, 2 + n, random.chance(0.5), random.chance(0.5), random);
    default:
      return polygonOf({partitionRing(n, random)});
  }
}

Polygon garbage(uint32_t rings, uint32_t pointsEach, uint32_t lattice, Random& random) {
  std::vector<Ring> all(rings);
  for (Ring& ring : all)
    for (uint32_t i = 0; i < pointsEach; ++i) {
      if (lattice) {
        const double x = random.below(lattice);
        ring.push_back({x, double(random.below(lattice))});
      } else {
        const double x = random.unit();
        ring.push_back({x, random.unit()});
      }
    }
  return polygonOf(all);
}

Polygon quarterTurned(const Polygon& polygon) {
  return mapped(polygon, [](Point p) { return Point{-p.y, p.x}; });
}
Polygon mirrored(const Polygon& polygon) {
  return mapped(polygon, [](Point p) { return Point{-p.x, p.y}; });
}
Polygon scaledBy(const Polygon& polygon, double powerOfTwo) {
  return mapped(polygon, [&](Point p) { return Point{powerOfTwo * p.x, powerOfTwo * p.y}; });
}
Polygon placed(const Polygon& polygon, double angle, double scale, Point shift) {
  const double c = scale * std::cos(angle), s = scale * std::sin(angle);
  return mapped(polygon, [&](Point p) {
    return Point{c * p.x - s * p.y + shift.x, s * p.x + c * p.y + shift.y};
  });
}

Polygon rewritten(const Polygon& polygon, Random& random) {
  std::vector<Ring> rings = ringsOf(polygon);
  for (Ring& ring : rings) {
    if (ring.empty()) continue;
    std::rotate(ring.begin(), ring.begin() + random.below(uint32_t(ring.size())), ring.end());
    if (random.chance(0.5)) std::reverse(ring.begin(), ring.end());
  }
  for (size_t i = rings.size(); i > 2; --i)
    std::swap(rings[i - 1], rings[1 + random.below(uint32_t(i - 1))]);
  return polygonOf(rings);
}

}  // namespace sftest
