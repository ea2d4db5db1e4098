#include "loops/one_loop/segment_table.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "support/generators.h"

using namespace sf;
using namespace sftest;

namespace {

struct Fixture {
  LoopSet loops;
  Work work;
  CandidateSet set;
  std::vector<double> cost;

  Fixture(const Curves& curves, double keep, Measure measure, Random& random)
      : loops(loopSet(curves)) {
    std::vector<uint32_t> triples, kept;
    REQUIRE(allTriples(loops, work, triples));
    for (size_t t = 0; t < triples.size(); t += 3)
      if (random.chance(keep)) kept.insert(kept.end(), &triples[t], &triples[t] + 3);
    TriangleWeights weights;
    weights.area = 1;
    REQUIRE(buildCandidateSet(loops, weights, kept, work, set));
    cost = measure.isWorst() ? std::vector<double>(set.size(), 0) : set.weight;
    // Forbidden ones, as under a cap on the angles to given faces.
    for (double& c : cost)
      if (random.chance(0.05)) c = kInfinity;
  }

  uint32_t triangle(uint32_t a, uint32_t b, uint32_t c) const {
    uint32_t v[3] = {a, b, c};
    std::sort(v, v + 3);
    for (uint32_t t = 0; t < set.size(); ++t)
      if (std::equal(v, v + 3, &set.triangles[3 * size_t(t)])) return t;
    return kNone;
  }

  double theta(uint32_t t, uint32_t apex) const { return set.slotTheta[set.slotOpposite(t, apex)]; }

  /// Eq. 2 as it stands: W of the run of `length` edges from `start` on, closed by a triangle that
  /// has the third vertex `outer`.
  double plain(Measure measure, uint32_t start, uint32_t length, uint32_t outer) const {
    if (length == 1) return 0;
    uint32_t end = start;
    for (uint32_t i = 0; i < length; ++i) end = loops.next(end);
    if (loops.isLoopEdge(start, end)) return kInfinity;
    double best = kInfinity;
    uint32_t apex = start;
    for (uint32_t i = 1; i < length; ++i) {
      apex = loops.next(apex);
      const uint32_t t = triangle(start, apex, end);
      if (t == kNone || cost[t] == kInfinity) continue;
      const double parts =
          measure.join(plain(measure, start, i, end), plain(measure, apex, length - i, start));
      const double pair = measure.pair(theta(t, apex), theta(triangle(start, end, outer), outer));
      best = std::min(best, measure.join(measure.join(cost[t], parts), pair));
    }
    return best;
  }
};

const Measure kMeasures[] = {Measure::sum(1), Measure::sum(0), Measure::sum(0.4, 2.1),
                             Measure::worst()};

}  // namespace

TEST_CASE(
    "segment table: every value is that of the plain recursion, for one loop and for several") {
  Random random(121);
  MESSAGE("seed 121");
  int finite = 0, none = 0;
  for (int i = 0; i < 48; ++i) {
    const Measure measure = kMeasures[i % 4];
    const Curves curves =
        i % 3 == 0 ? randomLoops({5, 4}, 0.5, random) : randomLoops({4u + i % 4}, 0, random);
    const Fixture f(curves, i % 2 ? 0.8 : 1, measure, random);
    Work work;
    SegmentTable table;
    REQUIRE(table.compute(f.loops, f.set, f.cost, measure, work));
    for (uint32_t e = 0; e < f.set.edgeCount(); ++e) {
      const uint32_t* v = &f.set.edgeVertices[2 * size_t(e)];
      if (f.loops.loopOf(v[0]) != f.loops.loopOf(v[1])) continue;
      for (const uint32_t start : {v[0], v[1]}) {
        uint32_t length = 0, at = start;
        std::vector<uint32_t> inside;
        for (; at != v[0] + v[1] - start; at = f.loops.next(at), ++length) inside.push_back(at);
        for (uint32_t s = f.set.edgeSlots[e]; s < f.set.edgeSlots[e + 1]; ++s) {
          const uint32_t apex = f.set.slotApex[s];
          if (std::find(inside.begin(), inside.end(), apex) != inside.end()) continue;
          const double expected = f.plain(measure, start, length, apex);
          const double got = table.value(s, table.sideFrom(e, start));
          CAPTURE(i);
          if (expected == kInfinity)
            CHECK(got == kInfinity);
          else
            CHECK(got == doctest::Approx(expected).epsilon(1e-12));
          ++(expected == kInfinity ? none : finite);
        }
      }
    }
  }
  CHECK(finite > 1000);
  CHECK(none > 100);
}

TEST_CASE(
    "segment table: the best split with what is behind it is the value, and its parts are apart") {
  Random random(122);
  MESSAGE("seed 122");
  int splits = 0;
  for (int i = 0; i < 24; ++i) {
    const Measure measure = kMeasures[i % 4];
    const Fixture f(randomLoops({9}, 0, random), 0.8, measure, random);
    Work work;
    SegmentTable table;
    REQUIRE(table.compute(f.loops, f.set, f.cost, measure, work));
    for (uint32_t s = 0; s < f.set.slotTriangle.size(); ++s) {
      const uint32_t edge = f.set.edgeOpposite(f.set.slotTriangle[s], f.set.slotApex[s]);
      // The side away from the slot's own triangle.
      const uint32_t* v = &f.set.edgeVertices[2 * size_t(edge)];
      const bool between = v[0] < f.set.slotApex[s] && f.set.slotApex[s] < v[1];
      const ClosedSegment segment{edge, between ? 1u : 0u};
      const uint32_t best = table.bestSplit(segment, s);
      if (best == kNone) {
        CHECK((f.set.isLoopEdge[edge] || table.value(s, segment.side) == kInfinity));
        continue;
      }
      ++splits;
      CHECK(measure.join(table.splitValue(segment, best),
                         measure.pair(f.set.slotTheta[best], f.set.slotTheta[s])) ==
            doctest::Approx(table.value(s, segment.side)).epsilon(1e-12));
      ClosedSegment part[2];
      table.parts(segment, best, part);
      const uint32_t start = v[segment.side], end = v[1 - segment.side];
      CHECK(part[0].edge == f.set.edgeBetween(start, f.set.slotApex[best]));
      CHECK(part[1].edge == f.set.edgeBetween(f.set.slotApex[best], end));
      CHECK(part[0].side == table.sideFrom(part[0].edge, start));
      CHECK(part[1].side == table.sideFrom(part[1].edge, f.set.slotApex[best]));
    }
  }
  CHECK(splits > 1000);
}

TEST_CASE("segment table: what it charges it gives back, and it ends with the work") {
  Random random(123);
  const Fixture f(randomLoops({40}, 0, random), 1, Measure::sum(1), random);
  const size_t bytes = 16 * f.set.slotTriangle.size();
  Work enough(bytes, nullptr, nullptr);
  {
    SegmentTable table;
    CHECK(table.compute(f.loops, f.set, f.cost, Measure::sum(1), enough));
    CHECK(enough.used() == bytes);
  }
  CHECK(enough.used() == 0);
  Work little(bytes - 1, nullptr, nullptr);
  {
    SegmentTable table;
    CHECK_FALSE(table.compute(f.loops, f.set, f.cost, Measure::sum(1), little));
    CHECK(little.status() == Status::OutOfMemory);
  }
  CHECK(little.used() == 0);
  Work stopped(
      size_t(-1), [](void*, double, double, double) { return false; }, nullptr);
  {
    SegmentTable table;
    CHECK_FALSE(table.compute(f.loops, f.set, f.cost, Measure::sum(1), stopped));
    CHECK(stopped.status() == Status::Stopped);
  }
  CHECK(stopped.used() == 0);
}
