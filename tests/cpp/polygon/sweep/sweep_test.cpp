// The plane sweep: what nodes see against every edge looked at, corners where rings touch, kinds,
// isolated points, culprits, limits.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/turn.h"
#include "polygon/sweep/sweep.h"
#include "support/exact.h"
#include "support/polygon_generators.h"
#include "support/polygon_oracle.h"
#include "support/visibility_oracle.h"

using namespace sftest;

namespace {

struct Swept {
  sf::Outcome outcome;
  sf::LinkedPolygon loops;
  sf::Visibility seen;
};

Swept sweepOf(const Polygon& polygon, bool sagsOnly = false, const std::vector<double>& points = {},
              bool mayTurn = false) {
  Swept swept;
  sf::PlaneSweep sweep;
  sf::Work work;
  swept.outcome = sweep.run({polygon.positions, polygon.starts, points}, sagsOnly, mayTurn, work,
                            swept.loops, swept.seen);
  CHECK(work.used() == 0);
  return swept;
}

std::map<sf::VertexKind, int> kindsOf(const Swept& swept) {
  std::map<sf::VertexKind, int> count;
  for (sf::VertexKind kind : swept.loops.kind) ++count[kind];
  return count;
}

/// Links lead back and forth, every kind fits the heights of the neighbours, loops close.
void checkLoops(const Swept& s) {
  const sf::LinkedPolygon& l = s.loops;
  for (uint32_t v = 0; v < l.at.size(); ++v) {
    if (l.kind[v] == sf::VertexKind::Unused || l.kind[v] == sf::VertexKind::Island) continue;
    REQUIRE(l.next[l.prev[v]] == v);
    REQUIRE(l.prev[l.next[v]] == v);
    const bool fromBelow = sf::below(l.at[l.prev[v]], l.at[v]);
    const bool toAbove = sf::below(l.at[v], l.at[l.next[v]]);
    const double turned = sf::turn(l.at[l.prev[v]], l.at[v], l.at[l.next[v]]);
    using Kind = sf::VertexKind;
    const Kind extreme = toAbove ? (turned > 0 ? Kind::Bottom : Kind::Sag)
                                 : (turned > 0 ? Kind::Ceiling : Kind::Top);
    const Kind kind = fromBelow != toAbove ? extreme : toAbove ? Kind::RightBank : Kind::LeftBank;
    CHECK(int(l.kind[v]) == int(kind));
  }
}

const Polygon kSquare = polygonOf({{{0, 0}, {8, 0}, {8, 8}, {0, 8}}});

}  // namespace

TEST_CASE("sweep: nodes see what a look at every edge finds") {
  int compared = 0;
  for (uint32_t seed = 1; seed <= 1500; ++seed) {
    Random random(seed);
    const Polygon polygon = rewritten(smallPolygon(random), random);
    if (hasTouches(polygon)) continue;
    const Swept swept = sweepOf(polygon);
    const Sight sight = lookAround(polygon);
    INFO("seed ", seed, " ", describe(polygon));
    REQUIRE(swept.outcome.ok());
    CHECK(swept.loops.next == sight.linked.next);
    CHECK(swept.seen.order == sight.seen.order);
    CHECK(swept.seen.left == sight.seen.left);
    CHECK(swept.seen.right == sight.seen.right);
    CHECK((swept.loops.kind == sight.linked.kind));
    checkLoops(swept);
    ++compared;
  }
  CHECK(compared > 500);
}

TEST_CASE(
    "sweep: events in order, however many, however close in height, with unused ones among them") {
  constexpr uint32_t kSeed = 4400;
  CAPTURE(kSeed);
  Random random(kSeed);
  int passed = 0;
  for (const uint32_t n : {3u, 4u, 15u, 16u, 17u, 31u, 33u, 64u, 126u, 127u, 128u, 129u, 130u})
    for (const double height : {1.0, 0x1p-24, 0x1p-30, 0x1p-60, 0x1p-980, 0x1p-1050})
      for (int variant = 0; variant < 6; ++variant) {
        Ring ring = starRing(n, 0.8, random);
        // Heights on a lattice, so that many are the same; or all within a small part of the whole.
        for (Point& p : ring) {
          if (variant % 3 == 1) p.y = std::round(p.y * 16) / 16;
          p.y *= height;
        }
        if (variant % 3 == 2) ring[random.below(n)].y += 3;
        // Repeated at either end, so that unused nodes come first and last.
        if (variant >= 3) ring.insert(ring.begin(), ring.front()), ring.push_back(ring.back());
        if (variant == 5) ring.push_back(ring.front());
        for (const bool reversed : {false, true}) {
          Polygon polygon = polygonOf({ring});
          if (reversed) std::reverse(ring.begin(), ring.end()), polygon = polygonOf({ring});
          const Swept swept = sweepOf(polygon);
          if (!swept.outcome.ok()) continue;
          std::vector<uint32_t> expected;
          for (uint32_t v = 0; v < swept.loops.at.size(); ++v)
            if (swept.loops.kind[v] != sf::VertexKind::Unused) expected.push_back(v);
          if (swept.loops.at.size() != polygon.vertexCount()) continue;  // rings touch
          std::sort(expected.begin(), expected.end(), [&](uint32_t a, uint32_t b) {
            return sf::below(swept.loops.at[a], swept.loops.at[b]);
          });
          INFO("n ", n, " height ", height, " variant ", variant);
          CHECK(swept.seen.order == expected);
          ++passed;
        }
      }
  CHECK(passed > 400);
}

TEST_CASE(
    "sweep: the box around all nodes, and the least magnitude but zero, turned and scaled too") {
  int turned = 0;
  for (uint32_t seed = 1; seed <= 300; ++seed) {
    Random random(seed);
    Polygon polygon = seed % 3 == 0 ? polygonOf({combRing(20, random)}) : smallPolygon(random);
    if (seed % 4 == 1) polygon = scaledBy(polygon, 0x1p-400);
    polygon.positions[random.below(uint32_t(polygon.positions.size()))] *= 0x1p-90;
    sf::PlaneSweep sweep;
    sf::LinkedPolygon loops;
    sf::Visibility seen;
    sf::Work work;
    const sf::PolygonView view{polygon.positions, polygon.starts, {}};
    const bool complement = seed % 2 == 0;
    const sf::Outcome outcome = complement ? sweep.runComplement(view, work, loops, seen)
                                           : sweep.run(view, true, true, work, loops, seen);
    if (!outcome.ok()) continue;
    sf::Point2 least = loops.at[0], greatest = least;
    double smallest = HUGE_VAL;
    for (const sf::Point2 p : loops.at) {
      least = {std::min(least.x, p.x), std::min(least.y, p.y)};
      greatest = {std::max(greatest.x, p.x), std::max(greatest.y, p.y)};
      for (const double x : {std::fabs(p.x), std::fabs(p.y)})
        if (x > 0) smallest = std::min(smallest, x);
    }
    INFO("seed ", seed, " ", describe(polygon));
    CHECK(loops.least == least);
    CHECK(loops.greatest == greatest);
    CHECK(loops.smallest == smallest);
    turned += loops.turned;
  }
  CHECK(turned > 20);
}

TEST_CASE(
    "sweep: turned where that leaves far fewer minima, it is the sweep of the polygon turned") {
  int turned = 0, compared = 0;
  for (uint32_t seed = 1; seed <= 600; ++seed) {
    Random random(seed);
    const Polygon polygon = rewritten(smallPolygon(random), random);
    const Swept either = sweepOf(polygon, true, {}, true);
    Polygon quarter = polygon;
    for (size_t i = 0; i < quarter.positions.size(); i += 2)
      quarter.positions[i] = -polygon.positions[i + 1],
      quarter.positions[i + 1] = polygon.positions[i];
    const Swept fixed = sweepOf(either.loops.turned ? quarter : polygon, true);
    INFO("seed ", seed, " ", describe(polygon));
    REQUIRE(either.outcome.ok());
    REQUIRE(fixed.outcome.ok());
    CHECK(!fixed.loops.turned);
    CHECK(either.loops.at == fixed.loops.at);
    CHECK((either.loops.kind == fixed.loops.kind));
    CHECK(either.loops.next == fixed.loops.next);
    CHECK(either.seen.order == fixed.seen.order);
    turned += either.loops.turned, ++compared;
  }
  MESSAGE(turned, " of ", compared, " turned");
  CHECK(turned > 60);
  CHECK(turned < compared - 60);

  Random random(1);
  const Polygon comb = polygonOf({combRing(50, random)});
  CHECK(sweepOf(comb, true, {}, true).loops.turned);
  CHECK(!sweepOf(kSquare, true, {}, true).loops.turned);

  // Of several faults the same one is told.
  int faulty = 0;
  for (int instance = 0; instance < 200; ++instance) {
    Polygon bent = polygonOf({combRing(20, random)});
    for (int i = 0; i < 3; ++i) {
      double* const xy = bent.positions.data() + 2 * random.below(bent.vertexCount());
      xy[0] += random.range(-3, 3), xy[1] = random.range(-3, 5);
    }
    const sf::Outcome fixed = sweepOf(bent, true).outcome,
                      told = sweepOf(bent, true, {}, true).outcome;
    INFO("instance ", instance, " ", describe(bent));
    CHECK(int(told.status) == int(fixed.status));
    CHECK(told.vertex == fixed.vertex);
    CHECK(told.otherVertex == fixed.otherVertex);
    faulty += !fixed.ok();
  }
  CHECK(faulty > 100);
}

TEST_CASE("sweep: thousands of edges side by side, where the tree of edges is used") {
  for (uint32_t seed = 1; seed <= 6; ++seed) {
    Random random(seed);
    const Polygon polygon = seed % 3 == 0   ? holeGrid(12, 12, false, random)
                            : seed % 3 == 1 ? polygonOf({starRing(700, 0.9, random)})
                                            : polygonOf({combRing(250, random)});
    const Swept swept = sweepOf(polygon);
    const Sight sight = lookAround(polygon);
    INFO("seed ", seed);
    REQUIRE(swept.outcome.ok());
    CHECK(swept.seen.order == sight.seen.order);
    CHECK(swept.seen.left == sight.seen.left);
    CHECK(swept.seen.right == sight.seen.right);
  }
}

TEST_CASE("sweep: sags alone are told the same as all nodes") {
  for (uint32_t seed = 1; seed <= 300; ++seed) {
    Random random(seed);
    const Polygon polygon = latticeRegion(4 + seed % 7, 5 + seed % 50, false, true, random);
    const Swept all = sweepOf(polygon), sags = sweepOf(polygon, true);
    INFO("seed ", seed, " ", describe(polygon));
    REQUIRE(all.outcome.ok());
    REQUIRE(sags.outcome.ok());
    std::vector<uint32_t> expected;
    for (const uint32_t v : all.seen.order) {
      const sf::VertexKind kind = all.loops.kind[v];
      if (kind == sf::VertexKind::Sag || kind == sf::VertexKind::Bottom) expected.push_back(v);
      if (kind == sf::VertexKind::Sag) CHECK(sags.seen.left[v] == all.seen.left[v]);
    }
    CHECK(sags.seen.order == expected);
  }
}

TEST_CASE("sweep: corners where rings touch are loops of their own") {
  for (uint32_t seed = 1; seed <= 1000; ++seed) {
    Random random(seed);
    const Polygon polygon = latticeRegion(3 + seed % 5, 4 + seed % 30, seed % 4 == 0, true, random);
    if (faultsOf(polygon) != kValid) continue;
    const Swept swept = sweepOf(polygon);
    INFO("seed ", seed, " ", describe(polygon));
    REQUIRE(swept.outcome.ok());
    checkLoops(swept);
  }
  // Two triangles that meet in a point, and a ring whose corner lies on an edge of its own.
  const Swept bow = sweepOf(polygonOf({{{0, 0}, {2, 0}, {1, 1}, {2, 2}, {0, 2}, {1, 1}}}));
  REQUIRE(bow.outcome.ok());
  CHECK(kindsOf(bow)[sf::VertexKind::Ceiling] == 2);
  CHECK(kindsOf(bow)[sf::VertexKind::Bottom] == 2);
  CHECK(bow.loops.at.size() == 6);
  const Swept onEdge =
      sweepOf(polygonOf({{{0, 0}, {8, 0}, {8, 8}, {0, 8}}, {{0, 4}, {3, 3}, {3, 5}}}));
  REQUIRE(onEdge.outcome.ok());
  checkLoops(onEdge);
  CHECK(onEdge.loops.at.size() == 8);
  CHECK(onEdge.loops.vertex[7] == 4);
  CHECK(onEdge.loops.flat.size() == 3);
}

TEST_CASE("sweep: consecutive equal vertices are visited once, a closing vertex not at all") {
  const Swept swept =
      sweepOf(polygonOf({{{0, 0}, {4, 0}, {4, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 4}, {0, 0}}}));
  REQUIRE(swept.outcome.ok());
  CHECK(kindsOf(swept)[sf::VertexKind::Unused] == 4);
  // Two after the second vertex, one after the last but one; the closing one has none.
  CHECK(swept.loops.flat == std::vector<uint32_t>{1, 2, 4, 2, 3, 4, 5, 6, 0});
}

TEST_CASE("sweep: isolated points see both sides, and have to be strictly inside") {
  const Swept inside = sweepOf(kSquare, false, {4, 4, 2, 4});
  REQUIRE(inside.outcome.ok());
  CHECK(kindsOf(inside)[sf::VertexKind::Island] == 2);
  CHECK(inside.seen.left[4] == 0);
  CHECK(inside.seen.right[4] == 1);
  CHECK(inside.seen.order == std::vector<uint32_t>{0, 1, 5, 4, 3, 2});
  const std::vector<std::vector<double>> wrong = {{9, 4}, {-1, 4}, {4, -1},     {4, 9},
                                                  {0, 0}, {8, 4},  {4, 8},      {4, 0},
                                                  {0, 5}, {8, 8},  {4, 4, 4, 4}};
  for (const std::vector<double>& points : wrong) {
    const Swept swept = sweepOf(kSquare, true, points);
    INFO(points[0], " ", points[1]);
    CHECK(int(swept.outcome.status) == int(sf::Status::HoleOutside));
    CHECK(swept.outcome.loop >= 1);
  }
  const Swept inHole =
      sweepOf(polygonOf({{{0, 0}, {8, 0}, {8, 8}, {0, 8}}, {{2, 2}, {2, 6}, {6, 6}, {6, 2}}}), true,
              {1, 1, 4, 4});
  CHECK(int(inHole.outcome.status) == int(sf::Status::HoleOutside));
  CHECK(inHole.outcome.loop == 3);
}

TEST_CASE("sweep: culprits are named by ring and first vertex, however rings run") {
  // The second hole crosses the first between its vertices 1 and 2.
  const Ring outer = {{0, 0}, {20, 0}, {20, 20}, {0, 20}};
  const Ring first = {{2, 2}, {8, 2}, {8, 8}, {2, 8}}, second = {{6, 5}, {14, 4}, {14, 6}};
  for (int flips = 0; flips < 8; ++flips) {
    std::vector<Ring> rings = {outer, first, second};
    for (int c = 0; c < 3; ++c)
      if (flips >> c & 1) std::reverse(rings[size_t(c)].begin(), rings[size_t(c)].end());
    const Polygon polygon = polygonOf(rings);
    const sf::Outcome outcome = sweepOf(polygon).outcome;
    INFO("flips ", flips);
    REQUIRE(int(outcome.status) == int(sf::Status::HolesOverlap));
    CHECK(outcome.loop == 1);
    CHECK(outcome.otherLoop == 2);
    CHECK(edgesMeet(polygon, polygon.starts[1] + outcome.vertex,
                    polygon.starts[2] + outcome.otherVertex));
  }
}

TEST_CASE("sweep: what is wrong with starts and numbers, and spikes before crossings") {
  const auto statusOf = [](const Polygon& polygon) { return int(sweepOf(polygon).outcome.status); };
  Polygon polygon = kSquare;
  polygon.starts = {0, 5};
  CHECK(statusOf(polygon) == int(sf::Status::BadStarts));
  polygon.starts = {1, 4};
  CHECK(statusOf(polygon) == int(sf::Status::BadStarts));
  polygon.starts = {0, 4, 3, 4};
  CHECK(statusOf(polygon) == int(sf::Status::BadStarts));
  polygon.starts = {0};
  CHECK(statusOf(polygon) == int(sf::Status::BadStarts));
  polygon = kSquare;
  polygon.positions[5] = std::numeric_limits<double>::quiet_NaN();
  const sf::Outcome notFinite = sweepOf(polygon).outcome;
  CHECK(int(notFinite.status) == int(sf::Status::NotFinite));
  CHECK(notFinite.vertex == 2);
  polygon.positions[5] = 1.1e150;
  CHECK(statusOf(polygon) == int(sf::Status::NotFinite));
  const sf::Outcome spike =
      sweepOf(polygonOf({{{0, 0}, {8, 0}, {8, 8}, {4, 8}, {4, -4}, {4, 8}, {0, 8}}})).outcome;
  CHECK(int(spike.status) == int(sf::Status::DegeneratePolygon));
  CHECK(spike.vertex == 4);
}

TEST_CASE("sweep: a memory limit ends it, and all that was charged is given back") {
  Random random(3);
  const Polygon polygon = polygonOf({starRing(5000, 0.8, random)});
  sf::PlaneSweep sweep;
  sf::Work work(50000, nullptr, nullptr);
  Swept swept;
  const sf::Outcome outcome = sweep.run({polygon.positions, polygon.starts, {}}, true, false, work,
                                        swept.loops, swept.seen);
  CHECK(int(outcome.status) == int(sf::Status::OutOfMemory));
  CHECK(work.used() == 0);
}

TEST_CASE("turn: right for all magnitudes and for all but collinear points") {
  using Wide = exact::Int<72>;
  const auto exactTurn = [](sf::Point2 a, sf::Point2 b, sf::Point2 c) {
    const auto of = [](double x) { return Wide::fromDouble(x, 1074); };
    return ((of(a.x) - of(c.x)) * (of(b.y) - of(c.y)) - (of(a.y) - of(c.y)) * (of(b.x) - of(c.x)))
        .sign();
  };
  const auto signOf = [](double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; };
  int zeros = 0;
  for (uint32_t seed = 1; seed <= 3000; ++seed) {
    Random random(seed);
    sf::Point2 p[3];
    for (sf::Point2& q : p) {
      const auto coordinate = [&] {
        const int exponent = random.chance(0.3) ? int(random.below(990)) - 495 : 0;
        return std::ldexp(double(random.below(7)) - 3 + (random.chance(0.2) ? 0x1p-40 : 0),
                          exponent);
      };
      q = {coordinate(), coordinate()};
    }
    if (random.chance(0.5)) p[2] = {p[0].x + 2 * (p[1].x - p[0].x), p[0].y + 2 * (p[1].y - p[0].y)};
    const int sign = exactTurn(p[0], p[1], p[2]);
    INFO("seed ", seed);
    CHECK(signOf(sf::turn(p[0], p[1], p[2])) == sign);
    zeros += sign == 0;
  }
  CHECK(zeros > 300);
}
