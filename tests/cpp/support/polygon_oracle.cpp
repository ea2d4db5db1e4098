#include "support/polygon_oracle.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "support/exact.h"

namespace sftest {
namespace {

/// A point in integers: 2^shift times the doubles.
template <int N>
struct IntPoint {
  exact::Int<N> x, y;
};

template <int N>
int orient(const IntPoint<N>& a, const IntPoint<N>& b, const IntPoint<N>& c) {
  return ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)).sign();
}

bool isFinite(const Polygon& polygon) {
  for (const double x : polygon.positions)
    if (!(std::fabs(x) <= 1e150)) return false;
  return true;
}

/// The bits from the highest of any coordinate down to the lowest, and the shift that makes all of
/// them even integers.
struct Range {
  int bits = 0, shift = 0;
};
Range rangeOf(std::initializer_list<const Polygon*> polygons) {
  int high = -2000, low = 2000;
  for (const Polygon* polygon : polygons)
    for (const double x : polygon->positions) {
      if (x == 0) continue;
      int exponent;
      int64_t mantissa = int64_t(std::ldexp(std::frexp(std::fabs(x), &exponent), 53));
      int lowest = exponent - 53;
      while (mantissa % 2 == 0) mantissa /= 2, ++lowest;
      high = std::max(high, exponent), low = std::min(low, lowest);
    }
  if (high < low) return {};
  return {high - low + 1, 1 - low};
}

/// Calls f with an integer type that holds sums of products of two coordinate differences.
template <class F>
auto withRange(Range range, F&& f) {
  if (range.bits <= 80) return f(exact::Int<3>());
  if (range.bits <= 220) return f(exact::Int<8>());
  return f(exact::Int<36>());
}

template <int N>
std::vector<IntPoint<N>> integers(const Polygon& polygon, int shift) {
  std::vector<IntPoint<N>> points(polygon.vertexCount());
  for (uint32_t v = 0; v < polygon.vertexCount(); ++v) {
    const Point p = polygon.point(v);
    points[v] = {exact::Int<N>::fromDouble(p.x, shift), exact::Int<N>::fromDouble(p.y, shift)};
  }
  return points;
}

bool isBefore(Point a, Point b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

/// The rings as lists of vertices, repeated consecutive points once.
std::vector<std::vector<uint32_t>> distinctRings(const Polygon& polygon) {
  std::vector<std::vector<uint32_t>> rings(polygon.ringCount());
  for (uint32_t r = 0; r < polygon.ringCount(); ++r) {
    auto& ring = rings[r];
    for (uint32_t v = polygon.starts[r]; v < polygon.starts[r + 1]; ++v)
      if (ring.empty() || !(polygon.point(ring.back()) == polygon.point(v))) ring.push_back(v);
    while (ring.size() > 1 && polygon.point(ring.front()) == polygon.point(ring.back()))
      ring.pop_back();
  }
  return rings;
}

enum class Meeting { None, Touch, Cross, Overlap };

template <int N>
class Judge {
 public:
  Judge(const Polygon& polygon, int shift)
      : polygon_(polygon), points_(integers<N>(polygon, shift)), rings_(distinctRings(polygon)) {
    for (uint32_t r = 0; r < rings_.size(); ++r) {
      const auto& ring = rings_[r];
      if (isFlat(ring)) {
        faults_ |= kDegenerate;
        rings_[r].clear();
        continue;
      }
      for (uint32_t i = 0; i < ring.size(); ++i)
        edges_.push_back({ring[i], ring[(i + 1) % ring.size()], r, i, {}});
    }
    clash_.assign(rings_.size() * rings_.size(), false);
  }

  uint32_t faults() {
    meetAll();
    for (uint32_t r = 0; r < rings_.size(); ++r) areaSign_.push_back(areaSign(r));
    for (Edge& e : edges_) judgePieces(e);
    compareHoles();
    return faults_;
  }
  bool touches() {
    meetAll();
    std::set<std::pair<double, double>> places;
    for (uint32_t v = 0; v < polygon_.vertexCount(); ++v)
      if (!places.insert({polygon_.point(v).x + 0.0, polygon_.point(v).y + 0.0}).second)
        return true;
    for (const Edge& e : edges_)
      if (!e.touches.empty()) return true;
    return false;
  }

 private:
  struct Edge {
    uint32_t a, b, ring, place;
    std::vector<uint32_t> touches;  // vertices in its interior
  };
  int side(uint32_t a, uint32_t b, uint32_t c) const {
    return orient(points_[a], points_[b], points_[c]);
  }
  Point at(uint32_t v) const { return polygon_.point(v); }

  void meetAll() {
    for (size_t i = 0; i < edges_.size(); ++i)
      for (size_t j = 0; j < i; ++j) {
        Edge &e = edges_[i], &f = edges_[j];
        const Meeting meeting = meet(e, f);
        if (meeting == Meeting::Cross || meeting == Meeting::Overlap) blame(e, f, meeting);
      }
  }
  Meeting meet(Edge& e, Edge& f) const {
    const Point a = at(e.a), b = at(e.b), c = at(f.a), d = at(f.b);
    if (std::max(a.x, b.x) < std::min(c.x, d.x) || std::max(c.x, d.x) < std::min(a.x, b.x) ||
        std::max(a.y, b.y) < std::min(c.y, d.y) || std::max(c.y, d.y) < std::min(a.y, b.y))
      return Meeting::None;
    const int c1 = side(e.a, e.b, f.a), d1 = side(e.a, e.b, f.b);
    const int a1 = side(f.a, f.b, e.a), b1 = side(f.a, f.b, e.b);
    if (c1 == 0 && d1 == 0) {
      const Point low = std::max(std::min(a, b, isBefore), std::min(c, d, isBefore), isBefore);
      const Point high = std::min(std::max(a, b, isBefore), std::max(c, d, isBefore), isBefore);
      return isBefore(low, high) ? Meeting::Overlap : Meeting::None;
    }
    if (c1 * d1 < 0 && a1 * b1 < 0) return Meeting::Cross;
    const auto lies = [](Point p, Point q, Point v) {  // of collinear points
      return isBefore(std::min(p, q, isBefore), v) && isBefore(v, std::max(p, q, isBefore));
    };
    if (c1 == 0 && lies(a, b, c)) e.touches.push_back(f.a);
    if (d1 == 0 && lies(a, b, d)) e.touches.push_back(f.b);
    if (a1 == 0 && lies(c, d, a)) f.touches.push_back(e.a);
    if (b1 == 0 && lies(c, d, b)) f.touches.push_back(e.b);
    return Meeting::None;
  }
  void blame(const Edge& e, const Edge& f, Meeting meeting) {
    clash_[e.ring * rings_.size() + f.ring] = clash_[f.ring * rings_.size() + e.ring] = true;
    if (e.ring != f.ring) {
      faults_ |= e.ring == 0 || f.ring == 0 ? kHoleOutside : kHolesOverlap;
      return;
    }
    const size_t n = rings_[e.ring].size();
    const bool next = (e.place + 1) % n == f.place || (f.place + 1) % n == e.place;
    faults_ |= next && meeting == Meeting::Overlap ? kDegenerate : kSelfIntersecting;
  }

  /// Whether all of a ring is on one line: then no more needs to be said of it.
  bool isFlat(const std::vector<uint32_t>& ring) const {
    for (size_t i = 2; i < ring.size(); ++i)
      if (side(ring[0], ring[1], ring[i]) != 0) return false;
    return true;
  }
  int areaSign(uint32_t r) const {
    exact::Int<N> sum;
    const auto& ring = rings_[r];
    for (size_t i = 0; i < ring.size(); ++i) {
      const auto &p = points_[ring[i]], &q = points_[ring[(i + 1) % ring.size()]];
      sum = sum + (p.x * q.y - p.y * q.x);
    }
    return sum.sign();
  }

  /// Winding number of a ring about the point 1/2 (p + q), edge `skipped` left out. At equal height
  /// with a vertex, the number a little above it.
  int winding(uint32_t r, uint32_t p, uint32_t q, const Edge* skipped) const {
    const IntPoint<N> twice = {points_[p].x + points_[q].x, points_[p].y + points_[q].y};
    int w = 0;
    const auto& ring = rings_[r];
    for (uint32_t i = 0; i < ring.size(); ++i) {
      if (skipped && skipped->ring == r && skipped->place == i) continue;
      const auto &a = points_[ring[i]], &b = points_[ring[(i + 1) % ring.size()]];
      const bool aBelow = (a.y + a.y - twice.y).sign() <= 0;
      if (aBelow == ((b.y + b.y - twice.y).sign() <= 0)) continue;
      // The ray to the right crosses a-b if the point is on its left, seen upward.
      const exact::Int<N> cross =
          (b.x - a.x) * (twice.y - a.y - a.y) - (b.y - a.y) * (twice.x - a.x - a.x);
      const int s = cross.sign();
      if (aBelow && s > 0) ++w;
      if (!aBelow && s < 0) --w;
    }
    return w;
  }

  void judgePieces(Edge& e) {
    std::vector<uint32_t> cuts = {e.a, e.b};
    cuts.insert(cuts.end(), e.touches.begin(), e.touches.end());
    std::sort(cuts.begin(), cuts.end(),
              [&](uint32_t u, uint32_t v) { return isBefore(at(u), at(v)); });
    for (size_t i = 0; i + 1 < cuts.size(); ++i)
      if (!(at(cuts[i]) == at(cuts[i + 1]))) judgePiece(e, cuts[i], cuts[i + 1]);
  }
  void judgePiece(const Edge& e, uint32_t p, uint32_t q) {
    const uint32_t k = uint32_t(rings_.size());
    for (uint32_t r = 0; r < k; ++r) {
      if (clash_[e.ring * k + r] || rings_[r].empty()) continue;
      if (r == e.ring) {
        // The ray sees what is to the right of an edge that goes up, above one that is level.
        const double dx = at(e.b).x - at(e.a).x, dy = at(e.b).y - at(e.a).y;
        const bool rightSeen = dy > 0 || (dy == 0 && dx < 0);
        const int left = winding(r, p, q, &e) + (rightSeen ? 1 : 0);
        if (areaSign_[r] == 0 || left != (areaSign_[r] > 0 ? 1 : 0)) faults_ |= kSelfIntersecting;
        continue;
      }
      const bool inside = winding(r, p, q, nullptr) != 0;
      if (r == 0 && !inside) faults_ |= kHoleOutside;
      if (r > 0 && e.ring == 0 && inside) faults_ |= kHoleOutside;
      if (r > 0 && e.ring > 0) (inside ? inPieces_ : outPieces_).insert({e.ring, r});
    }
  }
  void compareHoles() {
    for (const auto& [a, b] : inPieces_) {
      const bool whole = !outPieces_.count({a, b}) && !inPieces_.count({b, a});
      faults_ |= whole ? kNestedHole : kHolesOverlap;
    }
  }

  const Polygon& polygon_;
  std::vector<IntPoint<N>> points_;
  std::vector<std::vector<uint32_t>> rings_;
  std::vector<Edge> edges_;
  std::vector<bool> clash_;  // [r r] pairs of rings that cross or overlap
  std::vector<int> areaSign_;
  std::set<std::pair<uint32_t, uint32_t>> inPieces_, outPieces_;  // (hole, hole it is in or out of)
  uint32_t faults_ = 0;
};

/// What a triangulation adds up to, in exact numbers.
template <int N>
class TriangulationJudge {
 public:
  TriangulationJudge(const Polygon& polygon, const std::vector<uint32_t>& triangles, int shift)
      : polygon_(polygon), triangles_(triangles), points_(integers<N>(polygon, shift)) {
    std::map<std::pair<double, double>, uint32_t> firstAt;
    for (uint32_t v = 0; v < polygon.vertexCount(); ++v) {
      const Point p = polygon.point(v);
      placeOf_.push_back(firstAt.insert({{p.x + 0.0, p.y + 0.0}, v}).first->second);
      if (placeOf_.back() != v) distinct_ = false;
    }
    for (uint32_t r = 0; r < polygon.ringCount(); ++r) addRing(r);
  }

  std::string fault(bool touches) {
    const uint32_t m = uint32_t(triangles_.size() / 3), n = polygon_.vertexCount();
    if (triangles_.size() % 3) return "not a whole number of triangles";
    std::vector<bool> used(n);
    exact::Int<N> sum;
    for (uint32_t t = 0; t < m; ++t) {
      const uint32_t* v = &triangles_[3 * t];
      for (int i = 0; i < 3; ++i) {
        if (v[i] >= n) return "an index out of range";
        used[v[i]] = used[placeOf_[v[i]]] = true;
      }
      const exact::Int<N> area = doubleArea(v[0], v[1], v[2]);
      if (area.sign() < 0) return "triangle " + std::to_string(t) + " is turned over";
      if (area.sign() == 0 && !touches) return "triangle " + std::to_string(t) + " has no area";
      sum = sum + area;
      for (int i = 0; i < 3; ++i) count(v[i], v[(i + 1) % 3], 1);
    }
    if (!(sum == area_)) return "the areas do not sum to the polygon's";
    for (uint32_t v = 0; v < n; ++v)
      if (!used[placeOf_[v]]) return "vertex " + std::to_string(v) + " is not used";
    for (const auto& [edge, uses] : uses_) {
      if (uses.net != 0) return "edge " + name(edge) + " does not cancel";
      if (distinct_ && uses.total > 2) return "edge " + name(edge) + " is used more than twice";
    }
    if (!touches && m != n + 2 * (polygon_.ringCount() - 1) - 2) return "not n + 2h - 2 triangles";
    return "";
  }

 private:
  struct Uses {
    int net = 0;    // triangles less ring edges, by direction
    int total = 0;  // both
  };
  exact::Int<N> doubleArea(uint32_t a, uint32_t b, uint32_t c) const {
    const auto &p = points_[a], &q = points_[b], &r = points_[c];
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
  }
  void addRing(uint32_t r) {
    const uint32_t first = polygon_.starts[r], last = polygon_.starts[r + 1];
    const auto next = [&](uint32_t v) { return v + 1 < last ? v + 1 : first; };
    exact::Int<N> area;
    for (uint32_t v = first; v < last; ++v) {
      const auto &p = points_[v], &q = points_[next(v)];
      area = area + (p.x * q.y - p.y * q.x);
    }
    const bool turned = (area.sign() > 0) != (r == 0);
    area_ = turned ? area_ - area : area_ + area;
    // The other way round: ring edges and triangles together have no boundary.
    for (uint32_t v = first; v < last; ++v) turned ? count(v, next(v), 1) : count(next(v), v, 1);
  }
  void count(uint32_t u, uint32_t v, int by) {
    u = placeOf_[u], v = placeOf_[v];
    if (u == v) return;
    Uses& uses = uses_[{std::min(u, v), std::max(u, v)}];
    uses.net += u < v ? by : -by;
    ++uses.total;
  }
  static std::string name(std::pair<uint32_t, uint32_t> edge) {
    return std::to_string(edge.first) + "-" + std::to_string(edge.second);
  }

  const Polygon& polygon_;
  const std::vector<uint32_t>& triangles_;
  std::vector<IntPoint<N>> points_;
  std::vector<uint32_t> placeOf_;  // the first vertex with the same position
  bool distinct_ = true;
  exact::Int<N> area_;
  std::map<std::pair<uint32_t, uint32_t>, Uses> uses_;
};

template <int N>
exact::Int<N> doubleAreaOf(const Polygon& polygon, int shift) {
  const auto points = integers<N>(polygon, shift);
  exact::Int<N> sum;
  for (uint32_t r = 0; r < polygon.ringCount(); ++r)
    for (uint32_t v = polygon.starts[r]; v < polygon.starts[r + 1]; ++v) {
      const auto& p = points[v];
      const auto& q = points[v + 1 < polygon.starts[r + 1] ? v + 1 : polygon.starts[r]];
      sum = sum + (p.x * q.y - p.y * q.x);
    }
  return sum;
}

}  // namespace

std::string faultNames(uint32_t faults) {
  if (faults == kValid) return "valid";
  const char* const names[] = {"not-finite",   "degenerate",    "self-intersecting",
                               "hole-outside", "holes-overlap", "nested-hole"};
  std::string text;
  for (int i = 0; i < 6; ++i)
    if (faults >> i & 1) text += (text.empty() ? "" : " ") + std::string(names[i]);
  return text;
}

uint32_t faultsOf(const Polygon& polygon) {
  if (!isFinite(polygon)) return kNotFinite;
  const Range range = rangeOf({&polygon});
  return withRange(
      range, [&](auto zero) { return Judge<int(sizeof zero / 8)>(polygon, range.shift).faults(); });
}

bool hasTouches(const Polygon& polygon) {
  const Range range = rangeOf({&polygon});
  return withRange(range, [&](auto zero) {
    return Judge<int(sizeof zero / 8)>(polygon, range.shift).touches();
  });
}

bool edgesMeet(const Polygon& polygon, uint32_t first, uint32_t second) {
  const auto next = [&](uint32_t v) {
    const auto end = std::upper_bound(polygon.starts.begin(), polygon.starts.end(), v);
    return v + 1 < *end ? v + 1 : *(end - 1);
  };
  const uint32_t a = first, b = next(first), c = second, d = next(second);
  const Range range = rangeOf({&polygon});
  return withRange(range, [&](auto zero) {
    const auto p = integers<int(sizeof zero / 8)>(polygon, range.shift);
    const auto lies = [&](uint32_t v, uint32_t s, uint32_t e) {  // on the closed edge s-e
      const auto within = [](double x, double y, double z) {
        return std::min(x, y) <= z && z <= std::max(x, y);
      };
      const Point u = polygon.point(s), w = polygon.point(e), q = polygon.point(v);
      return orient(p[s], p[e], p[v]) == 0 && within(u.x, w.x, q.x) && within(u.y, w.y, q.y);
    };
    if (a == c || a == d || b == c || b == d) {  // neighbours: do they fold back?
      if (b == c || a == d)
        return b == c ? lies(d, a, b) || lies(a, c, d) : lies(c, a, b) || lies(b, c, d);
      return true;
    }
    if (lies(c, a, b) || lies(d, a, b) || lies(a, c, d) || lies(b, c, d)) return true;
    return orient(p[a], p[b], p[c]) * orient(p[a], p[b], p[d]) < 0 &&
           orient(p[c], p[d], p[a]) * orient(p[c], p[d], p[b]) < 0;
  });
}

std::string faultOfTriangulation(const Polygon& polygon, const std::vector<uint32_t>& triangles) {
  const bool touches = hasTouches(polygon);
  const Range range = rangeOf({&polygon});
  return withRange(range, [&](auto zero) {
    return TriangulationJudge<int(sizeof zero / 8)>(polygon, triangles, range.shift).fault(touches);
  });
}

int compareAreas(const Polygon& a, const Polygon& b) {
  const Range range = rangeOf({&a, &b});
  return withRange(range, [&](auto zero) {
    constexpr int N = int(sizeof zero / 8);
    return (doubleAreaOf<N>(a, range.shift) - doubleAreaOf<N>(b, range.shift)).sign();
  });
}

double filledArea(const Polygon& polygon, FillRule rule) {
  struct Side {
    Point low, high;
    int weight;
    double xAt(double y) const {
      return low.x + (high.x - low.x) * ((y - low.y) / (high.y - low.y));
    }
  };
  std::vector<Side> sides;
  std::vector<double> heights;
  for (uint32_t r = 0; r < polygon.ringCount(); ++r) {
    const Ring ring = ringsOf(polygon)[r];
    const bool isNegative = compareAreas(polygonOf({ring}), polygonOf({Ring{}})) < 0;
    const int weight = isNegative == (r == 0) ? -1 : 1;
    for (size_t i = 0; i < ring.size(); ++i) {
      const Point a = ring[i], b = ring[(i + 1) % ring.size()];
      heights.push_back(a.y);
      if (a.y < b.y) sides.push_back({a, b, -weight});
      if (a.y > b.y) sides.push_back({b, a, weight});
    }
  }
  for (const Side& s : sides)
    for (const Side& t : sides) {
      const double low = std::max(s.low.y, t.low.y), high = std::min(s.high.y, t.high.y);
      if (low >= high || &s >= &t) continue;
      const double d0 = s.xAt(low) - t.xAt(low), d1 = s.xAt(high) - t.xAt(high);
      if ((d0 < 0) != (d1 < 0)) heights.push_back(low + (high - low) * (d0 / (d0 - d1)));
    }
  std::sort(heights.begin(), heights.end());
  double sum = 0;
  for (size_t i = 0; i + 1 < heights.size(); ++i) {
    const double y0 = heights[i], y1 = heights[i + 1], middle = (y0 + y1) / 2;
    if (!(y0 < middle && middle < y1)) continue;
    std::vector<std::pair<double, int>> cut;
    for (const Side& s : sides)
      if (s.low.y <= y0 && y1 <= s.high.y) cut.push_back({s.xAt(middle), s.weight});
    std::sort(cut.begin(), cut.end());
    int winding = 0;
    for (size_t j = 0; j + 1 < cut.size(); ++j) {
      winding -= cut[j].second;
      const bool filled = rule == FillRule::EvenOdd ? winding % 2 != 0 : winding != 0;
      if (filled) sum += (cut[j + 1].first - cut[j].first) * (y1 - y0);
    }
  }
  return sum;
}

}  // namespace sftest
