#include "support/surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>
#include <set>

namespace sftest {
namespace {

using sf::Vec3;
using Edge = std::pair<uint32_t, uint32_t>;
using Triple = std::array<uint32_t, 3>;

template <class... Values>
std::string say(const char* format, Values... values) {
  char text[200];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

Triple sorted(uint32_t a, uint32_t b, uint32_t c) {
  Triple t{a, b, c};
  std::sort(t.begin(), t.end());
  return t;
}

/// Thin triangles, as along aligned loops, have no right digit left in doubles.
Vec3 normalOf(Vec3 a, Vec3 b, Vec3 c) {
  __extension__ using Wide = __float128;
  const Wide u[3] = {Wide(b.x) - a.x, Wide(b.y) - a.y, Wide(b.z) - a.z};
  const Wide w[3] = {Wide(c.x) - a.x, Wide(c.y) - a.y, Wide(c.z) - a.z};
  return {double(u[1] * w[2] - u[2] * w[1]), double(u[2] * w[0] - u[0] * w[2]),
          double(u[0] * w[1] - u[1] * w[0])};
}

/// Scaled so that its products neither overflow nor vanish.
Vec3 scaled(Vec3 v) {
  double size = std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
  return size > 0 ? Vec3{v.x / size, v.y / size, v.z / size} : v;
}

double angle(Vec3 a, Vec3 b) {
  a = scaled(a), b = scaled(b);
  return std::atan2(length(cross(a, b)), dot(a, b));
}

/// Loop neighbours of every vertex.
struct Neighbours {
  std::vector<uint32_t> next, previous;
  explicit Neighbours(const Boundary& boundary)
      : next(boundary.vertices.size()), previous(boundary.vertices.size()) {
    for (size_t c = 0; c + 1 < boundary.starts.size(); ++c)
      for (uint32_t i = boundary.starts[c]; i < boundary.starts[c + 1]; ++i) {
        uint32_t j = i + 1 == boundary.starts[c + 1] ? boundary.starts[c] : i + 1;
        next[boundary.vertices[i]] = boundary.vertices[j];
        previous[boundary.vertices[j]] = boundary.vertices[i];
      }
  }
  bool isLoopEdge(uint32_t a, uint32_t b) const { return next[a] == b || next[b] == a; }
};

std::string boundaryFault(const Boundary& boundary) {
  const auto& starts = boundary.starts;
  if (starts.size() < 2 || starts.front() != 0 || starts.back() != boundary.vertices.size())
    return "the loops' starts do not run from 0 to n'";
  for (size_t c = 0; c + 1 < starts.size(); ++c)
    if (starts[c] + 3 > starts[c + 1]) return say("loop %zu has fewer than 3 vertices", c);
  std::vector<uint32_t> order = boundary.vertices;
  std::sort(order.begin(), order.end());
  for (uint32_t i = 0; i < order.size(); ++i)
    if (order[i] != i) return "the loops do not visit every vertex once";
  return "";
}

/// For each directed edge a -> b the apex of the triangle wound a, b, apex.
using Apexes = std::map<Edge, uint32_t>;

std::string fanFault(const Neighbours& loops, const Apexes& apexes, uint32_t v, size_t triangles) {
  // One of the two loop edges leaves v in the direction of its triangle: there the fan begins.
  uint32_t first = apexes.count({v, loops.next[v]}) ? loops.next[v] : loops.previous[v];
  uint32_t last = first == loops.next[v] ? loops.previous[v] : loops.next[v];
  size_t steps = 0;
  uint32_t at = first;
  for (auto it = apexes.find({v, at}); it != apexes.end() && steps <= triangles; ++steps) {
    at = it->second;
    it = apexes.find({v, at});
  }
  if (at != last) return say("the fan around vertex %u does not end at a loop edge", v);
  if (steps != triangles)
    return say("%zu of %zu triangles at vertex %u in one fan", steps, triangles, v);
  return "";
}

size_t countComponents(const std::vector<uint32_t>& triangles, const Apexes& apexes,
                       const std::map<Triple, uint32_t>& indexOf) {
  std::vector<char> seen(triangles.size() / 3, 0);
  size_t components = 0;
  for (uint32_t start = 0; start < seen.size(); ++start) {
    if (seen[start]) continue;
    ++components;
    std::vector<uint32_t> stack{start};
    seen[start] = 1;
    while (!stack.empty()) {
      const uint32_t* t = &triangles[3 * stack.back()];
      stack.pop_back();
      for (int i = 0; i < 3; ++i) {
        uint32_t a = t[i], b = t[(i + 1) % 3];
        auto across = apexes.find({b, a});
        if (across == apexes.end()) continue;
        uint32_t other = indexOf.at(sorted(a, b, across->second));
        if (!seen[other]) seen[other] = 1, stack.push_back(other);
      }
    }
  }
  return components;
}

bool close(double a, double b, double tolerance = 1e-9) {
  return std::fabs(a - b) <= tolerance * std::max({1e-300, std::fabs(a), std::fabs(b)});
}

/// Angles carry rounding of their own, so they are compared to an absolute 1e-9 a piece too.
bool closeAngles(double a, double b, size_t count) {
  return std::fabs(a - b) <= 1e-9 * (1 + std::fabs(b)) + 1e-12 * double(count);
}

std::string insertedFault(const sf::LoopSet& loops, const sf::Span& span) {
  uint32_t n = loops.vertexCount();
  if (span.positions.size() != n + span.inserted.size())
    return "positions are not the input's and the inserted ones";
  for (uint32_t v = 0; v < n; ++v)
    if (!(span.positions[v] == loops.position(v))) return say("input vertex %u was moved", v);
  if (span.starts.size() != loops.loopCount() + 1) return "a different number of loops";
  for (uint32_t c = 0; c < loops.loopCount(); ++c) {
    uint32_t expected = 0, edge = loops.size(c) - 1;
    double parameter = 1;
    for (uint32_t i = span.starts[c]; i < span.starts[c + 1]; ++i) {
      uint32_t v = span.loopVertices[i];
      if (v < n) {
        if (v != loops.first(c) + expected) return say("loop %u is out of order at %u", c, v);
        edge = expected++;
        parameter = 0;
        continue;
      }
      const sf::InsertedVertex& record = span.inserted[v - n];
      if (record.loop != c || record.edge != edge)
        return say("inserted vertex %u does not lie where its record says", v);
      if (!(record.parameter > parameter && record.parameter < 1))
        return say("inserted vertex %u has a parameter out of order", v);
      parameter = record.parameter;
      Vec3 a = loops.position(loops.first(c) + edge);
      Vec3 b = loops.position(loops.next(loops.first(c) + edge));
      if (distance(span.positions[v], a + parameter * (b - a)) >
          1e-12 * distance(a, b) + 1e-15 * length(a))
        return say("inserted vertex %u lies off its edge", v);
    }
    if (expected != loops.size(c)) return say("loop %u misses input vertices", c);
  }
  return "";
}

std::string orderFault(const sf::Span& span) {
  size_t m = span.triangles.size() / 3;
  if (span.order.size() != m) return "the order does not have one entry a triangle";
  std::vector<char> seen(m, 0);
  std::set<Edge> edges;
  for (size_t i = 0; i < m; ++i) {
    uint32_t t = span.order[i];
    if (t >= m || seen[t]) return "the order is not a permutation";
    seen[t] = 1;
    bool touches = false;
    for (int j = 0; j < 3; ++j) {
      uint32_t a = span.triangles[3 * t + j], b = span.triangles[3 * t + (j + 1) % 3];
      touches |= !edges.insert({std::min(a, b), std::max(a, b)}).second;
    }
    if (i > 0 && !touches) return say("triangle %u comes before its neighbours", t);
  }
  return "";
}

/// Sum of the own weights of the span's triangles; complains about a triangle not in the list.
std::string ownWeights(const sf::SpanOptions& options, const sf::Span& span, double& sum) {
  sum = 0;
  if (options.space != sf::Space::Given) return "";
  std::map<Triple, size_t> list;
  for (size_t i = 0; i < options.triangles.size() / 3; ++i)
    list[sorted(options.triangles[3 * i], options.triangles[3 * i + 1],
                options.triangles[3 * i + 2])] = i;
  for (size_t i = 0; i < span.triangles.size(); i += 3) {
    auto it = list.find(sorted(span.triangles[i], span.triangles[i + 1], span.triangles[i + 2]));
    if (it == list.end()) return say("triangle %zu is no candidate", i / 3);
    if (!options.triangleWeights.empty()) sum += options.triangleWeights[it->second];
  }
  return "";
}

/// Turns each triangle to agree with an earlier one that it shares an edge with.
void windAlike(std::vector<uint32_t>& triangles) {
  std::set<Edge> passed;
  for (size_t i = 0; i < triangles.size(); i += 3) {
    uint32_t* t = &triangles[i];
    for (int j = 0; j < 3; ++j)
      if (passed.count({t[j], t[(j + 1) % 3]})) {
        std::swap(t[1], t[2]);
        break;
      }
    for (int j = 0; j < 3; ++j) passed.insert({t[j], t[(j + 1) % 3]});
  }
}

}  // namespace

std::string surfaceFault(const Boundary& boundary, const std::vector<uint32_t>& triangles) {
  if (std::string fault = boundaryFault(boundary); !fault.empty()) return fault;
  size_t n = boundary.vertices.size(), k = boundary.starts.size() - 1, m = triangles.size() / 3;
  if (triangles.size() % 3 != 0) return "the triangle list is not made of triples";
  if (m + 4 != n + 2 * k) return say("%zu triangles, not n' + 2k - 4 = %zu", m, n + 2 * k - 4);
  Neighbours loops(boundary);

  Apexes apexes;
  std::map<Triple, uint32_t> indexOf;
  std::vector<size_t> valence(n, 0);
  for (uint32_t t = 0; t < m; ++t) {
    const uint32_t* v = &triangles[3 * t];
    if (v[0] >= n || v[1] >= n || v[2] >= n) return say("triangle %u has an index over n'", t);
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) return say("triangle %u is folded up", t);
    if (!indexOf.insert({sorted(v[0], v[1], v[2]), t}).second)
      return say("triangle %u occurs twice", t);
    for (int i = 0; i < 3; ++i) {
      ++valence[v[i]];
      if (!apexes.insert({{v[i], v[(i + 1) % 3]}, v[(i + 2) % 3]}).second)
        return say("edge %u-%u is used twice in one direction", v[i], v[(i + 1) % 3]);
    }
  }
  size_t edges = 0;
  for (const auto& [edge, apex] : apexes) {
    auto [a, b] = edge;
    bool twice = apexes.count({b, a}) > 0;
    if (loops.isLoopEdge(a, b) && twice) return say("loop edge %u-%u is in two triangles", a, b);
    if (!loops.isLoopEdge(a, b) && !twice) return say("edge %u-%u is in one triangle", a, b);
    if (!twice || a < b) ++edges;
  }
  for (uint32_t v = 0; v < n; ++v) {
    uint32_t w = loops.next[v];
    if (!apexes.count({v, w}) && !apexes.count({w, v}))
      return say("loop edge %u-%u is in no triangle", v, w);
  }
  for (uint32_t v = 0; v < n; ++v)
    if (std::string fault = fanFault(loops, apexes, v, valence[v]); !fault.empty()) return fault;
  if (size_t count = countComponents(triangles, apexes, indexOf); count != 1)
    return say("%zu components", count);
  long euler = long(n) - long(edges) + long(m);
  if (euler != 2 - long(k)) return say("Euler number %ld, not %ld", euler, 2 - long(k));
  return "";
}

sf::SpanTerms measureSurface(const std::vector<Vec3>& positions, const Boundary& boundary,
                             const std::vector<uint32_t>& triangles,
                             const std::vector<double>& normals) {
  sf::SpanTerms terms;
  Apexes apexes;
  for (size_t i = 0; i < triangles.size(); i += 3) {
    Vec3 p[3] = {positions[triangles[i]], positions[triangles[i + 1]], positions[triangles[i + 2]]};
    terms.area += length(normalOf(p[0], p[1], p[2])) / 2;
    for (int j = 0; j < 3; ++j) {
      terms.perimeter += distance(p[j], p[(j + 1) % 3]);
      apexes[{triangles[i + j], triangles[i + (j + 1) % 3]}] = triangles[i + (j + 2) % 3];
    }
  }
  auto addAngle = [&](double a) {
    terms.dihedral += a;
    terms.worstDihedral = std::max(terms.worstDihedral, a);
  };
  for (const auto& [edge, apex] : apexes) {
    auto [a, b] = edge;
    auto across = apexes.find({b, a});
    if (a > b || across == apexes.end()) continue;
    addAngle(angle(normalOf(positions[a], positions[b], positions[apex]),
                   normalOf(positions[b], positions[a], positions[across->second])));
  }
  if (normals.empty()) return terms;
  for (size_t c = 0; c + 1 < boundary.starts.size(); ++c)
    for (uint32_t i = boundary.starts[c]; i < boundary.starts[c + 1]; ++i) {
      if (std::isnan(normals[3 * i])) continue;
      uint32_t j = i + 1 == boundary.starts[c + 1] ? boundary.starts[c] : i + 1;
      uint32_t a = boundary.vertices[i], b = boundary.vertices[j];
      auto it = apexes.find({a, b});
      uint32_t apex = it != apexes.end() ? it->second : apexes.at({b, a});
      addAngle(angle({normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]},
                     normalOf(positions[a], positions[b], positions[apex])));
    }
  return terms;
}

sf::Span spanOf(const sf::LoopSet& loops, const sf::SpanOptions& options,
                const std::vector<uint32_t>& triangles) {
  sf::Span span;
  span.found = true;
  span.space = options.space;
  span.positions.assign(loops.positions().begin(), loops.positions().end());
  span.starts.assign(loops.starts().begin(), loops.starts().end());
  span.loopVertices.resize(loops.vertexCount());
  std::iota(span.loopVertices.begin(), span.loopVertices.end(), 0u);
  span.triangles = triangles;
  windAlike(span.triangles);
  span.order.resize(triangles.size() / 3);
  std::iota(span.order.begin(), span.order.end(), 0u);
  const Boundary boundary{span.starts, span.loopVertices};
  if (!surfaceFault(boundary, span.triangles).empty()) return span;
  span.terms = measureSurface(span.positions, boundary, span.triangles,
                              {options.boundaryNormals.begin(), options.boundaryNormals.end()});
  ownWeights(options, span, span.terms.own);
  span.cost = options.objective == sf::Objective::WorstDihedral ? span.terms.worstDihedral
                                                                : weightedSum(options, span.terms);
  span.lowerBound = span.cost;
  return span;
}

double weightedSum(const sf::SpanOptions& options, const sf::SpanTerms& terms) {
  return options.areaWeight * terms.area + options.perimeterWeight * terms.perimeter +
         options.dihedralWeight * terms.dihedral + terms.own;
}

std::string spanFault(const sf::LoopSet& loops, const sf::SpanOptions& options,
                      const sf::Span& span) {
  if (!span.found) return "";
  if (std::string fault = insertedFault(loops, span); !fault.empty()) return fault;
  Boundary boundary{span.starts, span.loopVertices};
  if (std::string fault = surfaceFault(boundary, span.triangles); !fault.empty()) return fault;
  if (std::string fault = orderFault(span); !fault.empty()) return fault;

  std::vector<double> normals;
  if (!options.boundaryNormals.empty()) {
    uint32_t edge = 0;
    for (uint32_t v : span.loopVertices) {
      if (v < loops.vertexCount()) edge = v;
      for (int i = 0; i < 3; ++i) normals.push_back(options.boundaryNormals[3 * edge + i]);
    }
  }
  sf::SpanTerms terms = measureSurface(span.positions, boundary, span.triangles, normals);
  if (std::string fault = ownWeights(options, span, terms.own); !fault.empty()) return fault;
  size_t m = span.triangles.size() / 3;
  if (!close(terms.area, span.terms.area))
    return say("area %.17g, not %.17g", span.terms.area, terms.area);
  if (!close(terms.perimeter, span.terms.perimeter))
    return say("perimeter %.17g, not %.17g", span.terms.perimeter, terms.perimeter);
  if (!closeAngles(terms.dihedral, span.terms.dihedral, m))
    return say("dihedral %.17g, not %.17g", span.terms.dihedral, terms.dihedral);
  if (!closeAngles(terms.worstDihedral, span.terms.worstDihedral, 1))
    return say("worst dihedral %.17g, not %.17g", span.terms.worstDihedral, terms.worstDihedral);
  if (std::fabs(terms.own - span.terms.own) > 1e-9 * (1 + std::fabs(terms.own)))
    return say("own weights %.17g, not %.17g", span.terms.own, terms.own);
  double cost = options.objective == sf::Objective::WorstDihedral ? terms.worstDihedral
                                                                  : weightedSum(options, terms);
  if (std::fabs(cost - span.cost) > 1e-9 * std::fabs(cost) + 1e-9 * options.dihedralWeight)
    return say("cost %.17g, not %.17g", span.cost, cost);
  if (!(span.lowerBound <= span.cost + 1e-12 * std::fabs(span.cost)))
    return say("lower bound %.17g over the cost %.17g", span.lowerBound, span.cost);
  if (span.optimal && !(span.lowerBound >= span.cost - 1e-9 * (1e-3 + std::fabs(span.cost))))
    return say("optimal, yet the lower bound is %.17g and the cost %.17g", span.lowerBound,
               span.cost);
  return "";
}

}  // namespace sftest
