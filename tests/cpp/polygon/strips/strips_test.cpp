#include "polygon/strips/strips.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "polygon/fill/trapezoidation.h"
#include "support/visibility_oracle.h"

using namespace sf;
using namespace sftest;

namespace {

using Triangle = std::array<uint32_t, 3>;

struct Strips {
  std::vector<uint32_t> vertices, starts;
  size_t count() const { return starts.size() - 1; }
};

/// What OpenGL draws of a strip, each triangle from its least index on.
std::vector<Triangle> drawn(const Strips& strips) {
  std::vector<Triangle> result;
  for (size_t s = 0; s + 1 < strips.starts.size(); ++s) {
    const uint32_t* v = &strips.vertices[strips.starts[s]];
    const uint32_t size = strips.starts[s + 1] - strips.starts[s];
    for (uint32_t i = 0; i + 2 < size; ++i) {
      Triangle t = {v[i], v[i + 1], v[i + 2]};
      if (i % 2 == 1) std::swap(t[0], t[1]);
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      result.push_back(t);
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}
std::vector<Triangle> listed(const std::vector<uint32_t>& corners) {
  std::vector<Triangle> result;
  for (size_t h = 0; h < corners.size(); h += 3) {
    Triangle t = {corners[h], corners[h + 1], corners[h + 2]};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    result.push_back(t);
  }
  std::sort(result.begin(), result.end());
  return result;
}

Strips stripsOf(const std::vector<uint32_t>& corners) {
  const uint32_t n = corners.empty() ? 0 : *std::max_element(corners.begin(), corners.end()) + 1;
  Work work;
  std::vector<uint32_t> twins;
  REQUIRE(findTwins(corners, n, work, twins));
  Strips strips;
  REQUIRE(makeStrips(corners, twins, work, strips.vertices, strips.starts));
  CHECK(work.used() == 0);
  return strips;
}

std::vector<uint32_t> trianglesOf(const Polygon& polygon, const std::vector<Point>& islands = {}) {
  const Sight sight = lookAround(polygon, islands);
  TrapezoidTriangulator triangulator;
  Work work;
  std::vector<uint32_t> triangles;
  REQUIRE(triangulator.triangulate(sight.linked, sight.seen, true, true, work, triangles));
  return triangles;
}

/// A random triangulation of a convex polygon: its dual graph is a random tree.
std::vector<uint32_t> randomFan(uint32_t n, Random& random) {
  std::vector<uint32_t> result;
  std::vector<std::pair<uint32_t, uint32_t>> parts = {{0, n - 1}};
  while (!parts.empty()) {
    const auto [a, b] = parts.back();
    parts.pop_back();
    if (b - a < 2) continue;
    const uint32_t m = a + 1 + random.below(b - a - 1);
    result.insert(result.end(), {a, m, b});
    parts.push_back({a, m});
    parts.push_back({m, b});
  }
  return result;
}

/// Indices of the cheapest strips over a tree of triangles, by trying every set of crossed edges.
/// A strip of k triangles has k + 2 indices and one more for each turn like the one before, where a
/// strip begins as if after a turn 0; it may be written from either end.
size_t leastIndices(const std::vector<uint32_t>& corners) {
  std::vector<uint32_t> twins, inner;
  Work work;
  findTwins(corners, uint32_t(corners.size()), work, twins);
  for (uint32_t h = 0; h < twins.size(); ++h)
    if (twins[h] != kNone && h < twins[h]) inner.push_back(h);
  const uint32_t count = uint32_t(corners.size() / 3);
  size_t best = 3 * count;
  for (uint32_t set = 0; set < 1u << inner.size(); ++set) {
    std::vector<std::vector<uint32_t>> crossed(
        count);  // half-edges by which strips leave a triangle
    for (size_t i = 0; i < inner.size(); ++i)
      if (set >> i & 1) {
        crossed[inner[i] / 3].push_back(inner[i]);
        crossed[twins[inner[i]] / 3].push_back(twins[inner[i]]);
      }
    bool paths = true;
    for (const auto& c : crossed) paths &= c.size() <= 2;
    if (!paths) continue;
    size_t indices = 0;
    std::map<std::pair<uint32_t, uint32_t>, size_t> cost;  // by ends, from the first end
    for (uint32_t t = 0; t < count; ++t) {
      if (crossed[t].size() > 1) continue;
      size_t swaps = 0, size = 1;
      int last = 0;
      uint32_t at = t;
      for (uint32_t out = crossed[t].empty() ? kNone : crossed[t][0]; out != kNone;) {
        const uint32_t in = twins[out];
        at = in / 3, ++size;
        out = kNone;
        for (const uint32_t h : crossed[at])
          if (h != in) out = h;
        if (out == kNone) break;
        const int turn = out == nextInTriangle(in) ? 0 : 1;
        swaps += turn == last;
        last = turn;
      }
      cost[{t, at}] = size + 2 + swaps;
    }
    for (const auto& [ends, c] : cost)
      if (ends.first <= ends.second) indices += std::min(c, cost[{ends.second, ends.first}]);
    best = std::min(best, indices);
  }
  return best;
}

/// How many strips the usual greedy way makes: from a triangle with the fewest free neighbours, in
/// both directions as far as turns alternate, the longest of the six.
size_t greedyStrips(const std::vector<uint32_t>& corners) {
  std::vector<uint32_t> twins;
  Work work;
  findTwins(corners, *std::max_element(corners.begin(), corners.end()) + 1, work, twins);
  const uint32_t count = uint32_t(corners.size() / 3);
  std::vector<bool> used(count, false);
  std::set<std::pair<int, uint32_t>> queue;
  const auto freeNeighbours = [&](uint32_t t) {
    int free = 0;
    for (uint32_t h = 3 * t; h < 3 * t + 3; ++h) free += twins[h] != kNone && !used[twins[h] / 3];
    return free;
  };
  std::vector<int> degree(count);
  for (uint32_t t = 0; t < count; ++t) queue.insert({degree[t] = freeNeighbours(t), t});
  size_t strips = 0;
  while (!queue.empty()) {
    const uint32_t seed = queue.begin()->second;
    std::vector<uint32_t> best;
    for (uint32_t k = 0; k < 3; ++k)
      for (int parity = 0; parity < 2; ++parity) {
        std::vector<uint32_t> strip = {seed};
        const auto walk = [&](uint32_t h, int turn) {
          for (uint32_t g = twins[h]; g != kNone; g = twins[h], turn = 1 - turn) {
            if (used[g / 3] || std::find(strip.begin(), strip.end(), g / 3) != strip.end()) return;
            strip.push_back(g / 3);
            h = turn == 0 ? nextInTriangle(g) : prevInTriangle(g);
          }
        };
        walk(3 * seed + k, parity);
        const uint32_t h = 3 * seed + k;  // the turn in the seed continues the alternation
        walk(parity == 0 ? nextInTriangle(h) : prevInTriangle(h), 1 - parity);
        if (strip.size() > best.size()) best = strip;
      }
    ++strips;
    for (const uint32_t t : best) used[t] = true, queue.erase({degree[t], t});
    for (const uint32_t t : best)
      for (uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
        const uint32_t o = twins[h] == kNone ? kNone : twins[h] / 3;
        if (o == kNone || used[o]) continue;
        queue.erase({degree[o], o});
        queue.insert({degree[o] = freeNeighbours(o), o});
      }
  }
  return strips;
}

}  // namespace

TEST_CASE("strips: OpenGL draws each triangle once, counter-clockwise") {
  constexpr uint32_t kSeed = 4200;
  CAPTURE(kSeed);
  Random random(kSeed);
  for (int instance = 0; instance < 300; ++instance) {
    CAPTURE(instance);
    std::vector<uint32_t> corners;
    if (instance % 3 == 0) {
      corners = randomFan(3 + random.below(100), random);
    } else if (instance % 3 == 1) {
      const GriddedBlob blob = blobWithGrid(5 + random.below(30), 2 + random.below(8), random);
      corners = trianglesOf(blob.polygon, blob.inner);
    } else {
      corners = trianglesOf(holeGrid(1 + random.below(4), 1 + random.below(4), false, random));
    }
    const Strips strips = stripsOf(corners);
    CHECK(strips.starts.front() == 0);
    CHECK(strips.starts.back() == strips.vertices.size());
    CHECK(drawn(strips) == listed(corners));
  }
}

TEST_CASE("strips: none for no triangles, one of three indices for one") {
  CHECK(stripsOf({}).count() == 0);
  const Strips one = stripsOf({4, 1, 2});
  CHECK(one.vertices == std::vector<uint32_t>{4, 1, 2});
  CHECK(one.starts == std::vector<uint32_t>{0, 3});
}

TEST_CASE("strips: over a tree of triangles, no others have fewer indices") {
  constexpr uint32_t kSeed = 4201;
  CAPTURE(kSeed);
  Random random(kSeed);
  for (int instance = 0; instance < 300; ++instance) {
    CAPTURE(instance);
    const std::vector<uint32_t> corners = randomFan(4 + random.below(9), random);
    CHECK(stripsOf(corners).vertices.size() == leastIndices(corners));
  }
}

TEST_CASE("strips: at most 1.5 indices a triangle, and 1.3 times as long as greedy ones") {
  constexpr uint32_t kSeed = 4202;
  CAPTURE(kSeed);
  Random random(kSeed);
  const auto check = [&](const char* name, const std::vector<uint32_t>& corners) {
    CAPTURE(name);
    const Strips strips = stripsOf(corners);
    CHECK(double(strips.vertices.size()) <= 1.5 * double(corners.size() / 3));
    CHECK(double(greedyStrips(corners)) >= 1.3 * double(strips.count()));
  };
  check("simple", trianglesOf(polygonOf({partitionRing(1000, random)})));
  const GriddedBlob blob = blobWithGrid(100, 20, random);
  check("blob with grid", trianglesOf(blob.polygon, blob.inner));
  check("turned holes", trianglesOf(holeGrid(8, 8, false, random)));
  check("stars in holes", trianglesOf(starsInHoles(5, 5, 20, random)));
  const std::pair<const char*, Ring> rings[] = {
      {"star", starRing(1000, 1, random)},
      {"blob", blobRing(300, random)},
      {"comb", combRing(333, random)},
      {"double comb", doubleCombRing(166, random)},
      {"interleaved combs", interleavedCombRing(166, random)},
      {"zigzag", zigzagRing(1000, random)},
      {"Koch", kochRing(4)},
  };
  for (const auto& [name, ring] : rings) check(name, trianglesOf(polygonOf({ring})));
  // One strip, whoever makes it.
  for (const Ring& ring : {spiralRing(600, 3), staircaseRing(300)}) {
    const std::vector<uint32_t> corners = trianglesOf(polygonOf({ring}));
    CHECK(double(stripsOf(corners).vertices.size()) <= 1.5 * double(corners.size() / 3));
  }
}

TEST_CASE("strips: many triangles around one vertex, and a long band") {
  constexpr uint32_t kCount = 100000;
  std::vector<uint32_t> fan, band;
  for (uint32_t i = 0; i < kCount; ++i) {
    fan.insert(fan.end(), {kCount + 1, i, i + 1});
    if (i % 2 == 0)
      band.insert(band.end(), {i, i + 1, i + 2});
    else
      band.insert(band.end(), {i + 1, i, i + 2});
  }
  CHECK(drawn(stripsOf(fan)) == listed(fan));
  const Strips strips = stripsOf(band);
  CHECK(strips.count() == 1);
  CHECK(strips.vertices.size() == kCount + 2);
}
