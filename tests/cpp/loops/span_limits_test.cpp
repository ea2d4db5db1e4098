// Spans at the edges of what fits: hubs, loops that all but touch, memory, progress, magnitudes.
#include <doctest/doctest.h>

#include <cmath>

#include "loops/span.h"
#include "support/generators.h"

using namespace sf;
using namespace sftest;

namespace {

Span spanned(const LoopSet& loops, const SpanOptions& options, Status expected = Status::Ok,
             size_t maxBytes = size_t(1) << 30) {
  Work work(maxBytes, nullptr, nullptr);
  Span span;
  CHECK(spanLoops(loops, options, work, span).status == expected);
  CHECK(work.used() == 0);
  CHECK(work.peak() <= maxBytes + (maxBytes >> 1));
  return span;
}

SpanOptions optionsOf(Space space, double area, double dihedral) {
  SpanOptions options;
  options.space = space;
  options.areaWeight = area;
  options.dihedralWeight = dihedral;
  return options;
}

}  // namespace

TEST_CASE("span: a hub with thousands of edges takes memory in proportion to them") {
  // Every vertex of the ring sees the small triangle above its centre.
  const LoopSet loops = loopSet({circle(3000), circle(3, 1e-3, {0, 0, 0.3})});
  const Span span = spanned(loops, optionsOf(Space::Delaunay, 0, 1), Status::Ok, 60u << 20);
  CHECK(span.found);
  CHECK(span.optimal);
  CHECK(span.triangles.size() / 3 == 3003);
}

TEST_CASE("span: loops too close for edge protection have no Delaunay span, and say so") {
  // A vertex of the second loop is one rounding step off an edge of the first.
  const double off = 0.5 + 0x1p-53;
  const LoopSet loops =
      loopSet({{{0, 0, 0}, {1, 1, 0}, {1, -1, 0.3}}, {{0.5, off, 0}, {2, 3, 1}, {-1, 3, 1.5}}});
  const Span narrow = spanned(loops, optionsOf(Space::Delaunay, 0, 1));
  if (!narrow.found) CHECK(narrow.space == Space::Delaunay);
  CHECK(spanned(loops, optionsOf(Space::All, 0, 1)).found);
  CHECK(spanned(loops, optionsOf(Space::Auto, 0, 1)).found);
}

TEST_CASE("span: what does not fit is refused before memory is taken") {
  Random random(121);
  const LoopSet noisy = loopSet({noisyCircle(2000, 0.2, random)});
  spanned(noisy, optionsOf(Space::Near, 0, 1), Status::TooLarge, 4u << 20);
  spanned(noisy, optionsOf(Space::All, 0, 1), Status::TooLarge, 1u << 20);
  std::vector<uint32_t> triangles;
  for (uint32_t v = 0; v + 2 < 2000; ++v)
    for (uint32_t w = v + 2; w < std::min(v + 40, 2000u); ++w)
      triangles.insert(triangles.end(), {v, v + 1, w});
  SpanOptions given = optionsOf(Space::Given, 0, 1);
  given.triangles = triangles;
  spanned(noisy, given, Status::TooLarge, 1u << 20);
  CHECK(spanned(noisy, given, Status::Ok, 200u << 20).space == Space::Given);
}

TEST_CASE("span: progress never falls, and tells bounds of the objective itself") {
  struct Told {
    double fraction = 0, lower = 0, best = 1.0 / 0.0;
    int calls = 0;
    bool rising = true;
  };
  Random random(122);
  MESSAGE("seed 122");
  const LoopSet loops = loopSet(regularSaddles(4, 10, random));
  for (const Objective objective : {Objective::Sum, Objective::WorstDihedral}) {
    for (const Space space : {Space::Delaunay, Space::Auto}) {
      SpanOptions options = optionsOf(space, 0.1, 1);
      options.objective = objective;
      Told told;
      Work work(
          size_t(-1),
          [](void* user, double fraction, double best, double lower) {
            Told& t = *static_cast<Told*>(user);
            t.rising = t.rising && fraction >= t.fraction && fraction <= 1;
            t.fraction = fraction;
            t.lower = std::max(t.lower, lower);
            t.best = std::min(t.best, best);
            ++t.calls;
            return true;
          },
          &told);
      Span span;
      REQUIRE(spanLoops(loops, options, work, span).ok());
      REQUIRE(span.found);
      CHECK(told.calls > 3);
      CHECK(told.rising);
      CHECK(told.lower <= span.cost * (1 + 1e-12));
      CHECK(told.best >= span.cost * (1 - 1e-12));
    }
  }
}

TEST_CASE("span: very large and very small coordinates and weights give the same surface") {
  Random random(123);
  MESSAGE("seed 123");
  const Curves curves = randomLoops({6, 5}, 0.6, random);
  SpanOptions options = optionsOf(Space::All, 1, 0);
  options.perimeterWeight = 0.1;
  const Span plain = spanned(loopSet(curves), options);
  REQUIRE(plain.found);
  for (const int exponent : {-480, -40, 40, 480}) {
    Curves scaled = curves;
    for (Curve& curve : scaled)
      for (Vec3& p : curve)
        p = {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)};
    SpanOptions fitting = options;
    fitting.areaWeight = std::ldexp(options.areaWeight, -exponent);
    const Span span = spanned(loopSet(scaled), fitting);
    CAPTURE(exponent);
    REQUIRE(span.found);
    CHECK(span.triangles == plain.triangles);
    CHECK(span.cost == doctest::Approx(std::ldexp(plain.cost, exponent)).epsilon(1e-12));
  }
  // The weights' common scale alone.
  for (const int exponent : {-600, 600}) {
    SpanOptions fitting = options;
    fitting.areaWeight = std::ldexp(options.areaWeight, exponent);
    fitting.perimeterWeight = std::ldexp(options.perimeterWeight, exponent);
    const Span span = spanned(loopSet(curves), fitting);
    CHECK(span.triangles == plain.triangles);
    CHECK(span.cost == doctest::Approx(std::ldexp(plain.cost, exponent)).epsilon(1e-12));
  }
  Curves huge = curves;
  huge[1][2].y = 1e151;
  Work work;
  Span span;
  const Outcome outcome = spanLoops(loopSet(huge), options, work, span);
  CHECK(outcome.status == Status::NotFinite);
  CHECK(outcome.loop == 1);
  CHECK(outcome.vertex == 2);
}
