// Tracing against all cells and all segments: whole cells are met by none and inside, islands too, and borders go round cells.
#include "surface/trace.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include <doctest/doctest.h>

using namespace sf;

namespace {

using Random = std::mt19937;

double between(Random& random, double a, double b) {
  return std::uniform_real_distribution<double>(a, b)(random);
}

struct Rings {
  std::vector<Point2> at;
  std::vector<uint32_t> starts = {0};

  /// A star around a point, counter-clockwise or not, with radii from `low` to `high`.
  void addStar(Random& random, Point2 middle, double low, double high, uint32_t count,
               bool isClockwise) {
    std::vector<Point2> ring;
    for (uint32_t k = 0; k < count; ++k) {
      const double angle = 2 * 3.14159265358979 * k / count, r = between(random, low, high);
      ring.push_back({middle.x + r * std::cos(angle), middle.y + r * std::sin(angle)});
    }
    add(ring, isClockwise);
  }
  void add(std::vector<Point2> ring, bool isClockwise) {
    if (isClockwise) std::reverse(ring.begin(), ring.end());
    at.insert(at.end(), ring.begin(), ring.end());
    starts.push_back(uint32_t(at.size()));
  }

  template <class F>
  void eachSegment(F&& visit) const {
    for (size_t r = 0; r + 1 < starts.size(); ++r)
      for (uint32_t i = starts[r]; i < starts[r + 1]; ++i)
        visit(at[i], at[i + 1 == starts[r + 1] ? starts[r] : i + 1]);
  }
  int winding(Point2 p) const {
    int sum = 0;
    eachSegment([&](Point2 a, Point2 b) {
      if ((a.y <= p.y) == (b.y <= p.y)) return;
      const double side = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
      if (b.y > a.y && side > 0) ++sum;
      if (b.y < a.y && side < 0) --sum;
    });
    return sum;
  }
};

std::vector<double> lines(Random& random, double from, double to, uint32_t count) {
  std::vector<double> at = {from, to};
  for (uint32_t i = 0; i < count; ++i) at.push_back(between(random, from, to));
  std::sort(at.begin(), at.end());
  at.erase(std::unique(at.begin(), at.end()), at.end());
  return at;
}

/// Whether a segment comes into a box, by cutting it off at each side.
bool meets(Point2 a, Point2 b, double u0, double u1, double v0, double v1) {
  double from = 0, to = 1;
  const auto cut = [&](double p, double d, double low, double high) {
    if (d == 0) return low <= p && p <= high;
    double x = (low - p) / d, y = (high - p) / d;
    if (x > y) std::swap(x, y);
    from = std::max(from, x), to = std::min(to, y);
    return from <= to;
  };
  return cut(a.x, b.x - a.x, u0, u1) && cut(a.y, b.y - a.y, v0, v1);
}

void check(const Rings& rings, const std::vector<double>& us, const std::vector<double>& vs) {
  Trace trace;
  trace.run(rings.at, rings.starts, us, vs);
  const uint32_t nu = uint32_t(us.size()) - 1, nv = uint32_t(vs.size()) - 1;
  std::vector<uint8_t> isWhole(size_t(nu) * nv, 0);
  for (const CellRun& run : trace.runs) {
    REQUIRE(run.first < run.end);
    REQUIRE(run.end <= nv);
    for (uint32_t j = run.first; j < run.end; ++j) isWhole[run.strip * nv + j]++;
  }
  for (uint32_t i = 0; i < nu; ++i)
    for (uint32_t j = 0; j < nv; ++j) {
      const double du = us[i + 1] - us[i], dv = vs[j + 1] - vs[j];
      bool isMet = false, isNear = false;
      rings.eachSegment([&](Point2 a, Point2 b) {
        isMet |= meets(a, b, us[i], us[i + 1], vs[j], vs[j + 1]);
        isNear |= meets(a, b, us[i] - 0.2 * du, us[i + 1] + 0.2 * du, vs[j] - 0.2 * dv,
                        vs[j + 1] + 0.2 * dv);
      });
      const bool isInside = rings.winding({us[i] + du / 2, vs[j] + dv / 2}) > 0;
      if (isWhole[i * nv + j]) {
        CHECK(isWhole[i * nv + j] == 1);
        CHECK_FALSE(isMet);
        CHECK(isInside);
      } else if (!isNear) {
        CHECK_FALSE(isInside);
      }
    }
  // Each edge of the border has a whole cell to its right, and none to its left; each such edge is there once.
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  const uint32_t width = nv + 1;
  const auto whole = [&](int64_t i, int64_t j) {
    return i >= 0 && j >= 0 && i < nu && j < nv && isWhole[size_t(i) * nv + size_t(j)];
  };
  for (size_t r = 0; r + 1 < trace.borderStarts.size(); ++r)
    for (uint32_t i = trace.borderStarts[r]; i < trace.borderStarts[r + 1]; ++i) {
      const uint32_t next = i + 1 == trace.borderStarts[r + 1] ? trace.borderStarts[r] : i + 1;
      ++edges[{trace.border[i], trace.border[next]}];
    }
  size_t expected = 0;
  const auto has = [&](uint32_t a, uint32_t b) {
    ++expected;
    CHECK(edges[{a, b}] == 1);
  };
  for (uint32_t i = 0; i < nu; ++i)
    for (uint32_t j = 0; j < nv; ++j) {
      if (!isWhole[i * nv + j]) continue;
      const uint32_t a = i * width + j, b = a + width, c = a + 1, d = b + 1;
      if (!whole(int64_t(i) - 1, j)) has(a, c);
      if (!whole(int64_t(i) + 1, j)) has(d, b);
      if (!whole(i, int64_t(j) - 1)) has(b, a);
      if (!whole(i, int64_t(j) + 1)) has(c, d);
    }
  CHECK(edges.size() == expected);
  for (const uint32_t name : trace.islands) {
    const int64_t i = name / width, j = name % width;
    CHECK(rings.winding({us[size_t(i)], vs[size_t(j)]}) == 1);
    for (const int64_t di : {-1, 0})
      for (const int64_t dj : {-1, 0}) CHECK_FALSE(whole(i + di, j + dj));
  }
}

}  // namespace

TEST_CASE("Trace: stars with holes over grids of any kind") {
  for (uint32_t seed = 1; seed <= 300; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    Rings rings;
    const uint32_t count = 3 + uint32_t(random() % 60);
    rings.addStar(random, {0, 0}, between(random, 0.4, 0.9), 1, count, false);
    if (seed % 3) rings.addStar(random, {0.1, -0.05}, 0.05, 0.2, 3 + uint32_t(random() % 20), true);
    check(rings, lines(random, -1, 1, uint32_t(random() % 40)),
          lines(random, -1, 1, uint32_t(random() % 40)));
  }
}

TEST_CASE("Trace: rings along lines of the grid, and within one cell") {
  const std::vector<double> at = {0, 1, 2, 3, 4, 5, 6, 7, 8};
  const auto square = [](double a, double b) {
    return std::vector<Point2>{{a, a}, {b, a}, {b, b}, {a, b}};
  };
  Rings whole, inner, tiny, framed;
  whole.add(square(0, 8), false);
  inner.add(square(2, 6), false);
  tiny.add(square(3.2, 3.7), false);
  framed.add(square(0, 8), false), framed.add(square(3, 5), true);
  for (const Rings* rings : {&whole, &inner, &tiny, &framed}) check(*rings, at, at);
  Trace trace;
  trace.run(whole.at, whole.starts, at, at);
  CHECK(trace.runs.size() == 6);
  trace.run(tiny.at, tiny.starts, at, at);
  CHECK(trace.runs.empty());
  CHECK(trace.islands.empty());
}

TEST_CASE("Trace: combs that cross strips many times") {
  for (uint32_t teeth = 1; teeth < 12; ++teeth) {
    CAPTURE(teeth);
    std::vector<Point2> comb = {{-1, -1}, {1, -1}};
    for (uint32_t k = 0; k < teeth; ++k) {
      const double x = 1 - 2.0 * k / teeth, w = 0.5 / teeth;
      comb.push_back({x, 1}), comb.push_back({x - w, 1}), comb.push_back({x - w, -0.8}),
          comb.push_back({x - 2 * w, -0.8});
    }
    Rings rings;
    rings.add(comb, false);
    Random random(teeth);
    check(rings, lines(random, -1, 1, 50), lines(random, -1, 1, 50));
    Rings turned;
    for (Point2& p : comb) p = {-p.y, p.x};
    turned.add(comb, false);
    check(turned, lines(random, -1, 1, 50), lines(random, -1, 1, 50));
  }
}
