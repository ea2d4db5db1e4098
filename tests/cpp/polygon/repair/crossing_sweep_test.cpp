#include "polygon/repair/crossing_sweep.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <string>

#include "polygon/repair/crossing_point.h"
#include "support/exact.h"
#include "support/generators.h"

using sf::Charge;
using sf::CrossingPoint;
using sf::Crossings;
using sf::EdgeCut;
using sf::Line;
using sf::Point2;
using sf::WeightedEdge;
using sf::Work;
using sftest::Random;

namespace {

/// A point with rational coordinates x / w, y / w in lowest terms, w > 0; of small integers.
struct Rational {
  int64_t x, y, w;
  Rational(int64_t px, int64_t py, int64_t pw) {
    const int64_t g = std::gcd(std::gcd(px, py), pw) * (pw < 0 ? -1 : 1);
    x = px / g, y = py / g, w = pw / g;
  }
  /// `below` order.
  bool operator<(const Rational& o) const {
    return y * o.w != o.y * w ? y * o.w < o.y * w : x * o.w < o.x * w;
  }
  bool operator==(const Rational& o) const { return x == o.x && y == o.y && w == o.w; }
};

struct Case {
  std::vector<Point2> at;  // integers
  std::vector<WeightedEdge> edges;
};

Case latticeCase(uint32_t points, uint32_t edges, uint32_t size, Random& random) {
  std::set<std::pair<int, int>> places;
  for (uint32_t i = 0; i < points; ++i) {
    const int y = int(random.below(size));
    places.insert({y, int(random.below(size))});
  }
  Case c;
  for (const auto& [y, x] : places) c.at.push_back({double(x), double(y)});
  std::set<std::pair<uint32_t, uint32_t>> pairs;
  const uint32_t m = uint32_t(c.at.size());
  for (uint32_t i = 0; i < edges; ++i) {
    const uint32_t a = random.below(m), b = random.below(m);
    if (a != b) pairs.insert({std::min(a, b), std::max(a, b)});
  }
  for (const auto& [a, b] : pairs) c.edges.push_back({a, b, random.chance(0.5) ? 1 : -1, 0});
  return c;
}

struct Whole {
  int64_t x, y;
};
int64_t cross(Whole o, Whole a, Whole b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

/// All points inside each edge, by comparing all pairs.
std::vector<std::set<Rational>> cutsByBrute(const Case& c) {
  std::vector<std::set<Rational>> cuts(c.edges.size());
  const auto whole = [&](uint32_t v) { return Whole{int64_t(c.at[v].x), int64_t(c.at[v].y)}; };
  for (size_t e = 0; e < c.edges.size(); ++e) {
    const Whole a = whole(c.edges[e].low), b = whole(c.edges[e].high);
    for (uint32_t i = 0; i < c.at.size(); ++i) {
      const Whole v = whole(i);
      const int64_t along = (v.x - a.x) * (b.x - a.x) + (v.y - a.y) * (b.y - a.y);
      const int64_t length = (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y);
      if (cross(a, b, v) == 0 && along > 0 && along < length) cuts[e].insert({v.x, v.y, 1});
    }
    for (const WeightedEdge& other : c.edges) {
      const Whole p = whole(other.low), q = whole(other.high);
      const int64_t pa = cross(p, q, a), pb = cross(p, q, b);
      if ((cross(a, b, p) > 0) == (cross(a, b, q) > 0) || cross(a, b, p) * cross(a, b, q) == 0)
        continue;
      if ((pa > 0) == (pb > 0) || pa * pb == 0) continue;
      // a + pa / (pa - pb) (b - a)
      const int64_t w = pa - pb;
      cuts[e].insert({a.x * w + pa * (b.x - a.x), a.y * w + pa * (b.y - a.y), w});
    }
  }
  return cuts;
}

Point2 shrunk(Point2 p) { return {p.x / 1024, p.y / 1024}; }

}  // namespace

TEST_CASE("findCrossings: the points inside every edge are those that comparing all pairs finds") {
  MESSAGE("seed 71");
  Random random(71);
  size_t total = 0, crossings = 0;
  for (int i = 0; i < 3000; ++i) {
    const uint32_t size = 2 + random.below(random.chance(0.5) ? 8 : 1000);
    const Case c = latticeCase(3 + random.below(20), 2 + random.below(30), size, random);
    std::vector<Point2> at;
    for (const Point2 p : c.at) at.push_back(shrunk(p));
    Crossings found;
    Work work;
    {
      Charge charge(work);
      REQUIRE(sf::findCrossings(at, c.edges, size_t(-1), work, charge, found));
    }
    CHECK(work.used() == 0);
    const auto wanted = cutsByBrute(c);
    std::set<Rational> points;  // that are no vertices
    std::map<uint32_t, Rational> placeOf;
    std::vector<std::vector<uint32_t>> cuts(c.edges.size());
    for (const EdgeCut& cut : found.cuts) cuts[cut.edge].push_back(cut.point);
    for (size_t e = 0; e < c.edges.size(); ++e) {
      REQUIRE(cuts[e].size() == wanted[e].size());
      auto place = wanted[e].begin();  // from below upward, as cuts are
      for (const uint32_t point : cuts[e]) {
        const Rational& p = *place++;
        const Point2 is = point < at.size() ? at[point] : found.crossings[point - at.size()].at;
        CHECK(is.x == doctest::Approx(double(p.x) / double(p.w) / 1024).epsilon(1e-15));
        CHECK(is.y == doctest::Approx(double(p.y) / double(p.w) / 1024).epsilon(1e-15));
        const auto [known, isNew] = placeOf.insert({point, p});
        CHECK((isNew || known->second == p));  // one number for one point
        if (point >= at.size()) points.insert(p);
        ++total;
      }
    }
    CHECK(points.size() == found.crossings.size());
    crossings += points.size();
  }
  CHECK(total > 20000);
  CHECK(crossings > 5000);
}

TEST_CASE("findCrossings: winding numbers and neighbours of edges that do not cross") {
  // Two squares, one in the other, both counter-clockwise, and a bar to their right.
  const std::vector<Point2> at = {{0, 0},     {.5, 0},    {.125, .125}, {.25, .125}, {.125, .25},
                                  {.25, .25}, {.75, .25}, {0, .5},      {.5, .5},    {.75, .5}};
  const std::vector<WeightedEdge> edges = {{0, 1, 1, 0},  {0, 7, -1, 0}, {1, 8, 1, 0},
                                           {2, 3, 1, 0},  {2, 4, -1, 0}, {3, 5, 1, 0},
                                           {4, 5, -1, 0}, {6, 9, 3, 0},  {7, 8, -1, 0}};
  Crossings found;
  Work work;
  Charge charge(work);
  REQUIRE(sf::findCrossings(at, edges, 0, work, charge, found));
  CHECK(found.cuts.empty());
  CHECK(found.winding == std::vector<int32_t>{1, 0, 1, 2, 1, 2, 1, 0, 0});
  CHECK(found.left == std::vector<uint32_t>{1, sf::kNone, 1, 4, 1, 4, 1, 2, sf::kNone});
}

TEST_CASE("CrossingPoint: comparisons and sides are right where doubles cannot tell") {
  MESSAGE("seed 72");
  Random random(72);
  using Int = exact::Int<8>;
  const auto whole = [](double x) { return Int::fromDouble(x, 64); };
  // Lines through all but the same point: rounding alone would call all of them concurrent.
  uint32_t close = 0;
  for (int i = 0; i < 3000; ++i) {
    const double cx = random.range(0.3, 0.6), cy = random.range(0.3, 0.6);
    const auto line = [&] {
      const double dx = random.range(-0.2, 0.2), dy = random.range(0.05, 0.2);
      const auto off = [&] { return 0x1p-53 * random.below(4); };
      return Line{{cx - dx + off(), cy - dy + off()}, {cx + dx + off(), cy + dy + off()}};
    };
    const Line s = line(), t = line(), u = line();
    const auto quotient = [&](const Line& a, const Line& b, Int& x, Int& y, Int& w) {
      const Int ax = whole(a.high.x) - whole(a.low.x), ay = whole(a.high.y) - whole(a.low.y);
      const Int bx = whole(b.high.x) - whole(b.low.x), by = whole(b.high.y) - whole(b.low.y);
      w = ax * by - ay * bx;
      Int n = (whole(b.low.x) - whole(a.low.x)) * by - (whole(b.low.y) - whole(a.low.y)) * bx;
      if (w.sign() < 0) w = -w, n = -n;
      x = whole(a.low.x) * w + n * ax, y = whole(a.low.y) * w + n * ay;
    };
    Int px, py, pw, qx, qy, qw;
    quotient(s, t, px, py, pw), quotient(s, u, qx, qy, qw);
    if (pw.sign() == 0 || qw.sign() == 0) continue;
    const CrossingPoint p = sf::crossingPoint(s, t), q = sf::crossingPoint(s, u);
    const int byY = (py * qw - qy * pw).sign(), byX = (px * qw - qx * pw).sign();
    CHECK(sf::compare(p, q) == (byY ? byY : byX));
    CHECK(sf::compare(q, p) == -(byY ? byY : byX));
    const Point2 v = q.at;
    const int vy = (py - whole(v.y) * pw).sign(), vx = (px - whole(v.x) * pw).sign();
    CHECK(sf::compare(p, v) == (vy ? vy : vx));
    const Int dx = whole(u.high.x) - whole(u.low.x), dy = whole(u.high.y) - whole(u.low.y);
    const int side = (dx * (py - whole(u.low.y) * pw) - dy * (px - whole(u.low.x) * pw)).sign();
    CHECK(sf::sideOf(u, p) == side);
    CHECK(sf::sideOf(s, p) == 0);
    if (std::fabs(p.at.x - q.at.x) < 1e-15) ++close;
  }
  CHECK(close > 500);
}

TEST_CASE("areaSign: exact for slivers, 0 for lobes that cancel") {
  const std::vector<Point2> sliver = {{0.1, 0.1}, {0.9, 0.3}, {0.5, 0.2}};
  const double area = (0.9 - 0.1) * (0.2 - 0.1) - (0.3 - 0.1) * (0.5 - 0.1);
  CHECK(std::fabs(area) < 1e-16);  // no more than rounding
  using Int = exact::Int<4>;
  Int sum;
  for (int i = 0; i < 3; ++i) {
    const Point2 a = sliver[size_t(i)], b = sliver[size_t((i + 1) % 3)];
    sum = sum + (Int::fromDouble(a.x, 60) * Int::fromDouble(b.y, 60) -
                 Int::fromDouble(a.y, 60) * Int::fromDouble(b.x, 60));
  }
  CHECK(sum.sign() != 0);
  CHECK(sf::areaSign(sliver) == sum.sign());
  const std::vector<Point2> bowTie = {{0, 0}, {.5, .5}, {.5, 0}, {0, .5}};
  CHECK(sf::areaSign(bowTie) == 0);
  CHECK(sf::areaSign(std::vector<Point2>{}) == 0);
}
