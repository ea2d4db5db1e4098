// A hundred thousand edits of polygons.
#include <doctest/doctest.h>

#include <cstdlib>

#include "support/session_model.h"

using namespace sf;
using namespace sftest;

namespace {

/// SF_SEED starts elsewhere, SF_COUNT sets how many edits.
uint32_t numberFrom(const char* name, uint32_t otherwise) {
  const char* text = std::getenv(name);
  return text ? uint32_t(std::strtoul(text, nullptr, 10)) : otherwise;
}

}  // namespace

TEST_CASE("session: any long sequence of edits leaves a certified polygon") {
  const uint32_t seed = numberFrom("SF_SEED", 51), count = numberFrom("SF_COUNT", 100000);
  MESSAGE("seed ", seed, ", ", count, " edits");
  uint32_t accepted = 0, edits = 0;
  for (uint32_t sequence = 0; edits < count; ++sequence) {
    CAPTURE(sequence);
    Random random(seed + 1000003 * sequence);
    Polygon polygon = random.chance(0.3)
                          ? holeGrid(1 + random.below(3), 1 + random.below(3), false, random)
                          : smallPolygon(random);
    const uint32_t lattice = random.chance(0.3) ? 4 + random.below(12) : 0;
    if (lattice > 0) polygon = polygonOf({{{0, 0}, {1, 0}, {1, 1}, {0, 1}}});
    PolygonSession session;
    Model model;
    if (!startBoth(session, model, polygon, {})) continue;  // touches
    const double reach = random.chance(0.5) ? 0.3 : 0.03;
    for (int step = 0; step < 500; ++step, ++edits) {
      CAPTURE(step);
      const std::string fault = editBoth(session, model, reach, lattice, random, accepted);
      REQUIRE(fault == "");
    }
  }
  CHECK(accepted > edits / 4);
}
