#include "support/patches.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "loops/span.h"

namespace sftest {

using sf::Vec3;

namespace {

constexpr double kPi = 3.14159265358979323846;

void push(std::vector<double>& list, Vec3 p) { list.insert(list.end(), {p.x, p.y, p.z}); }
void addPoint(Sheet& sheet, Vec3 p) { push(sheet.positions, p); }
void addTriangle(Sheet& sheet, uint32_t a, uint32_t b, uint32_t c) {
  sheet.triangles.insert(sheet.triangles.end(), {a, b, c});
}

/// A grid of quadrilaterals, each with the diagonal that chance gives it.
void addGrid(Sheet& sheet, uint32_t columns, uint32_t rows, bool wrapsX, bool wrapsY,
             std::mt19937& random) {
  const uint32_t nx = wrapsX ? columns : columns - 1, ny = wrapsY ? rows : rows - 1;
  const auto id = [&](uint32_t i, uint32_t j) { return (j % rows) * columns + i % columns; };
  for (uint32_t j = 0; j < ny; ++j)
    for (uint32_t i = 0; i < nx; ++i) {
      const uint32_t a = id(i, j), b = id(i + 1, j), c = id(i + 1, j + 1), d = id(i, j + 1);
      if (random() % 2)
        addTriangle(sheet, a, b, c), addTriangle(sheet, a, c, d);
      else
        addTriangle(sheet, a, b, d), addTriangle(sheet, b, c, d);
    }
}

struct Shift {
  std::mt19937 random;
  double jitter;
  double operator()() { return jitter * (double(random()) / 4294967296.0 * 2 - 1); }
};

}  // namespace

Sheet sphereSheet(uint32_t level, double jitter, uint32_t seed) {
  Sheet sheet;
  const double g = (1 + std::sqrt(5)) / 2;
  for (const Vec3& p : {Vec3{-1, g, 0},
                        {1, g, 0},
                        {-1, -g, 0},
                        {1, -g, 0},
                        {0, -1, g},
                        {0, 1, g},
                        {0, -1, -g},
                        {0, 1, -g},
                        {g, 0, -1},
                        {g, 0, 1},
                        {-g, 0, -1},
                        {-g, 0, 1}})
    addPoint(sheet, (1 / length(p)) * p);
  sheet.triangles = {0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
                     4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
                     6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1};
  for (uint32_t l = 0; l < level; ++l) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
      const auto key = std::minmax(a, b);
      const auto found = middles.find(key);
      if (found != middles.end()) return found->second;
      const Vec3 p = sheet.at(a) + sheet.at(b);
      const uint32_t v = uint32_t(sheet.positions.size() / 3);
      addPoint(sheet, (1 / length(p)) * p);
      return middles[key] = v;
    };
    const std::vector<uint32_t> old = sheet.triangles;
    sheet.triangles.clear();
    for (size_t t = 0; t < old.size(); t += 3) {
      const uint32_t a = old[t], b = old[t + 1], c = old[t + 2], ab = middle(a, b),
                     bc = middle(b, c), ca = middle(c, a);
      addTriangle(sheet, a, ab, ca), addTriangle(sheet, ab, b, bc), addTriangle(sheet, ca, bc, c),
          addTriangle(sheet, ab, bc, ca);
    }
  }
  Shift shift{std::mt19937(seed), jitter * 1.1 / double(1u << level)};
  for (uint32_t v = 0; v < sheet.positions.size() / 3; ++v) {
    Vec3 p = sheet.at(v) + Vec3{shift(), shift(), shift()};
    p = (1 / length(p)) * p;
    sheet.positions[3 * v] = p.x, sheet.positions[3 * v + 1] = p.y,
                        sheet.positions[3 * v + 2] = p.z;
  }
  return sheet;
}

Sheet torusSheet(uint32_t around, uint32_t across, double radius, double tube, double jitter,
                 uint32_t seed) {
  Sheet sheet;
  Shift shift{std::mt19937(seed), jitter};
  for (uint32_t j = 0; j < across; ++j)
    for (uint32_t i = 0; i < around; ++i) {
      const double u = 2 * kPi * (i + shift()) / around, v = 2 * kPi * (j + shift()) / across;
      const double r = radius + tube * std::cos(v);
      addPoint(sheet, {r * std::cos(u), r * std::sin(u), tube * std::sin(v)});
    }
  addGrid(sheet, around, across, true, true, shift.random);
  return sheet;
}

Sheet cylinderSheet(uint32_t around, uint32_t along, double height, double jitter, uint32_t seed) {
  Sheet sheet;
  Shift shift{std::mt19937(seed), jitter};
  for (uint32_t j = 0; j < along; ++j)
    for (uint32_t i = 0; i < around; ++i) {
      const double u = 2 * kPi * (i + shift()) / around;
      addPoint(sheet, {std::cos(u), std::sin(u), height * ((j + shift()) / (along - 1) - 0.5)});
    }
  addGrid(sheet, around, along, true, false, shift.random);
  return sheet;
}

Sheet graphSheet(uint32_t n, const std::function<double(double, double)>& height, double jitter,
                 uint32_t seed) {
  Sheet sheet;
  Shift shift{std::mt19937(seed), jitter};
  for (uint32_t j = 0; j < n; ++j)
    for (uint32_t i = 0; i < n; ++i) {
      const double x = 2 * (i + shift()) / (n - 1) - 1, y = 2 * (j + shift()) / (n - 1) - 1;
      addPoint(sheet, {x, y, height(x, y)});
    }
  addGrid(sheet, n, n, false, false, shift.random);
  return sheet;
}

namespace {

using Edges = std::map<std::pair<uint32_t, uint32_t>, size_t>;
size_t nextCorner(size_t h) { return h % 3 == 2 ? h - 2 : h + 1; }

/// The triangle of each directed edge.
Edges edgesOf(const std::vector<uint32_t>& triangles) {
  Edges edges;
  for (size_t h = 0; h < triangles.size(); ++h)
    edges[{triangles[h], triangles[nextCorner(h)]}] = h / 3;
  return edges;
}

}  // namespace

Hole fillLoops(const Sheet& mesh, const std::vector<std::vector<uint32_t>>& loops, uint32_t rings) {
  Hole hole;
  const std::vector<uint32_t>& kept = mesh.triangles;
  const Edges edges = edgesOf(kept);
  std::vector<Vec3> positions;
  std::vector<double> boundaryNormals;
  std::vector<uint32_t> starts{0}, loopVertices;
  std::set<std::pair<uint32_t, uint32_t>> rimEdges;
  for (const std::vector<uint32_t>& loop : loops) {
    for (size_t i = 0; i < loop.size(); ++i) {
      const uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
      const auto beside = edges.find({b, a});
      Vec3 n{std::nan(""), std::nan(""), std::nan("")};
      if (beside != edges.end()) {
        const uint32_t* v = &kept[3 * beside->second];
        n = cross(mesh.at(v[1]) - mesh.at(v[0]), mesh.at(v[2]) - mesh.at(v[0]));
      }
      positions.push_back(mesh.at(a)), loopVertices.push_back(a), rimEdges.insert({a, b});
      push(boundaryNormals, n);
    }
    starts.push_back(uint32_t(positions.size()));
  }
  hole.rim = uint32_t(positions.size());
  sf::LoopSet set(positions, starts);
  sf::SpanOptions options;
  options.areaWeight = std::nan("");
  options.boundaryNormals = boundaryNormals;
  options.bestSoFar = true;
  sf::Span span;
  sf::Work work;
  REQUIRE(sf::spanLoops(set, options, work, span).ok());
  if (!span.inserted.empty()) {
    options.space = sf::Space::Near;
    REQUIRE(sf::spanLoops(set, options, work, span).ok());
  }
  REQUIRE(span.found);
  REQUIRE(span.inserted.empty());

  // Rings of triangles around the rim, and a numbering of their vertices.
  std::set<uint32_t> near(loopVertices.begin(), loopVertices.end());
  for (uint32_t r = 0; r < rings; ++r) {
    const std::set<uint32_t> before = near;
    for (size_t t = 0; t < kept.size(); t += 3)
      if (before.count(kept[t]) || before.count(kept[t + 1]) || before.count(kept[t + 2]))
        near.insert(kept.begin() + long(t), kept.begin() + long(t) + 3);
  }
  std::map<uint32_t, uint32_t> number;
  const auto numberOf = [&](uint32_t v) {
    const auto [at, isNew] = number.insert({v, uint32_t(hole.vertices.size())});
    if (isNew) hole.vertices.push_back(v), push(hole.surface.positions, mesh.at(v));
    return at->second;
  };
  for (const uint32_t v : loopVertices) numberOf(v);
  double sum = 0;
  for (size_t t = 0; t < kept.size() && rings > 0; t += 3) {
    if (!near.count(kept[t]) || !near.count(kept[t + 1]) || !near.count(kept[t + 2])) continue;
    for (size_t k = 0; k < 3; ++k) {
      hole.surface.triangles.push_back(numberOf(kept[t + k]));
      sum += distance(mesh.at(kept[t + k]), mesh.at(kept[t + (k + 1) % 3]));
    }
  }
  hole.surface.fixedVertices = uint32_t(hole.vertices.size());
  hole.surface.fixedTriangles = uint32_t(hole.surface.triangles.size() / 3);
  if (hole.surface.fixedTriangles > 0) hole.meanEdge = sum / double(hole.surface.triangles.size());
  // The span is wound consistently, one way or the other.
  bool runsAlong = false;
  for (size_t h = 0; h < span.triangles.size(); ++h)
    runsAlong = runsAlong || rimEdges.count({loopVertices[span.triangles[h]],
                                             loopVertices[span.triangles[nextCorner(h)]]});
  for (size_t t = 0; t < span.triangles.size(); t += 3)
    for (const size_t k : {size_t(0), size_t(runsAlong ? 1 : 2), size_t(runsAlong ? 2 : 1)})
      hole.surface.triangles.push_back(number.at(loopVertices[span.triangles[t + k]]));
  return hole;
}

Hole cutHole(const Sheet& sheet, const std::function<bool(Vec3)>& region, uint32_t rings) {
  Sheet rest;
  rest.positions = sheet.positions;
  std::vector<uint32_t> cutAway;
  for (size_t t = 0; t < sheet.triangles.size(); t += 3) {
    const uint32_t* v = &sheet.triangles[t];
    const bool isCut = region((1.0 / 3) * (sheet.at(v[0]) + sheet.at(v[1]) + sheet.at(v[2])));
    std::vector<uint32_t>& to = isCut ? cutAway : rest.triangles;
    to.insert(to.end(), v, v + 3);
  }
  // Rim edges are edges of both; the patch runs along them as what was cut away did.
  std::map<uint32_t, uint32_t> next;
  const Edges edges = edgesOf(rest.triangles);
  for (size_t h = 0; h < cutAway.size(); ++h) {
    const uint32_t a = cutAway[h], b = cutAway[nextCorner(h)];
    if (!edges.count({b, a})) continue;
    REQUIRE(next.count(a) == 0);
    next[a] = b;
  }
  std::vector<std::vector<uint32_t>> loops;
  std::set<uint32_t> seen;
  for (const auto& [first, second] : next) {
    if (seen.count(first) || second == first) continue;
    loops.emplace_back();
    for (uint32_t v = first; seen.insert(v).second; v = next.at(v)) loops.back().push_back(v);
  }
  Hole hole = fillLoops(rest, loops, rings);
  hole.cutAway = cutAway;
  return hole;
}

namespace {
Vec3 vertexOf(const sf::LocalSurface& s, size_t h) {
  const uint32_t v = s.triangles[h];
  return {s.positions[3 * v], s.positions[3 * v + 1], s.positions[3 * v + 2]};
}
}  // namespace

std::function<bool(Vec3)> cap(double degrees) {
  return [c = std::cos(degrees * kPi / 180)](Vec3 p) { return p.z / length(p) > c; };
}

double patchError(const sf::LocalSurface& surface, const std::function<double(Vec3)>& distance) {
  double sum = 0, area = 0;
  for (size_t t = 3 * size_t(surface.fixedTriangles); t < surface.triangles.size(); t += 3) {
    const Vec3 a = vertexOf(surface, t), b = vertexOf(surface, t + 1), c = vertexOf(surface, t + 2);
    const double w = length(cross(b - a, c - a)) / 2;
    for (const Vec3& p : {(1.0 / 3) * (a + b + c), a, b, c})
      sum += w / 4 * distance(p) * distance(p);
    area += w;
  }
  return std::sqrt(sum / area);
}

PatchShape shapeOf(const sf::LocalSurface& surface) {
  PatchShape shape;
  std::map<std::pair<uint32_t, uint32_t>, size_t> edges;
  std::map<std::pair<uint32_t, uint32_t>, int> undirected;
  const size_t fixed = 3 * size_t(surface.fixedTriangles);
  const auto normal = [&](size_t t) {
    const Vec3 a = vertexOf(surface, 3 * t);
    return cross(vertexOf(surface, 3 * t + 1) - a, vertexOf(surface, 3 * t + 2) - a);
  };
  for (size_t h = 0; h < surface.triangles.size(); ++h) {
    const uint32_t a = surface.triangles[h], b = surface.triangles[h % 3 == 2 ? h - 2 : h + 1];
    if (!edges.insert({{a, b}, h / 3}).second || ++undirected[std::minmax(a, b)] > 2)
      shape.isManifold = false;
  }
  uint32_t rim = 0;
  shape.leastAngle = 180;
  for (size_t t = fixed; t < surface.triangles.size(); t += 3) {
    double least = 180;
    for (size_t k = 0; k < 3; ++k) {
      const Vec3 a = vertexOf(surface, t + k), b = vertexOf(surface, t + (k + 1) % 3),
                 c = vertexOf(surface, t + (k + 2) % 3);
      least = std::min(least, sf::angleBetween(b - a, c - a) * 180 / kPi);
      const auto other = edges.find({surface.triangles[t + (k + 1) % 3], surface.triangles[t + k]});
      if (other == edges.end() || 3 * other->second >= fixed) continue;
      shape.rimAngle += sf::angleBetween(normal(t / 3), normal(other->second)) * 180 / kPi, ++rim;
    }
    shape.leastAngle = std::min(shape.leastAngle, least), shape.meanLeastAngle += least;
    shape.area += length(normal(t / 3)) / 2, ++shape.triangles;
  }
  if (shape.triangles) shape.meanLeastAngle /= shape.triangles;
  if (rim) shape.rimAngle /= rim;
  return shape;
}

}  // namespace sftest
