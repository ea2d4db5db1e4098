#include "loops/domains/domain.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>

#include "support/generators.h"

using namespace sf;
using namespace sftest;

namespace {

struct Counts {
  int splits = 0, parts = 0;
  std::map<PartKind, int> kinds;
};

Counts countSplits(Domains& domains, const std::vector<uint32_t>& shape, uint32_t apex) {
  Counts counts;
  domains.forEachSplit(shape, apex, [&](const Split& split) {
    ++counts.splits;
    for (uint32_t i = 0; i < split.partCount; ++i) {
      ++counts.parts;
      ++counts.kinds[split.part[i].kind];
    }
    return true;
  });
  return counts;
}

}  // namespace

TEST_CASE("domain: the root is one loop but for its access edge, the others are holes") {
  const LoopSet loops = loopSet({circle(5), circle(4, 1, {0, 0, 1}), circle(3, 1, {0, 0, 2})});
  Domains domains(loops);
  const std::vector<uint32_t> root = domains.root(6);  // of loop 1
  CHECK(domains.segmentCount(root) == 1);
  CHECK(domains.hasHole(root, 0));
  CHECK_FALSE(domains.hasHole(root, 1));
  CHECK(domains.hasHole(root, 2));
  const uint32_t ends[2] = {domains.spanStart(root, 0), domains.spanEnd(root, 0)};
  CHECK(std::min(ends[0], ends[1]) == 6);
  CHECK(std::max(ends[0], ends[1]) == 7);
}

TEST_CASE("domain: case I enters a hole in both directions, its vertex twice on the boundary") {
  const LoopSet loops = loopSet({circle(5), circle(4, 1, {0, 0, 1})});
  Domains domains(loops);
  std::vector<uint32_t> shapes[2];
  int count = 0;
  domains.forEachSplit(domains.root(0), 7, [&](const Split& split) {
    REQUIRE(split.partCount == 1);
    REQUIRE(count < 2);
    shapes[count++] = split.part[0].shape;
    CHECK(split.part[0].kind == PartKind::Domain);
    return true;
  });
  REQUIRE(count == 2);
  CHECK(shapes[0] != shapes[1]);
  for (const auto& shape : shapes) {
    CHECK(domains.segmentCount(shape) == 2);
    CHECK_FALSE(domains.hasHoles(shape));
    const Segment s = domains.segment(shape, 1);
    CHECK(s.whole);
    CHECK(s.start == 7);
    CHECK(s.end == 7);
    CHECK(domains.isEnd(shape, 7));
    CHECK(domains.isEnd(shape, 0));
    CHECK_FALSE(domains.isEnd(shape, 3));
  }
}

TEST_CASE("domain: case II gives each hole to either part, but none to an empty one") {
  const LoopSet loops = loopSet({circle(6), circle(3, 1, {0, 0, 1}), circle(3, 1, {0, 0, 2})});
  Domains domains(loops);
  const std::vector<uint32_t> root = domains.root(0);
  // Apex 3 leaves two long parts: 2^2 distributions. Apex 2 leaves the loop edge 1-2, which takes
  // no hole; so does apex 5 with the loop edge 5-0.
  CHECK(countSplits(domains, root, 3).splits == 4);
  Counts beside = countSplits(domains, root, 2);
  CHECK(beside.splits == 1);
  CHECK(beside.kinds[PartKind::EmptyEdge] == 1);
  CHECK(countSplits(domains, root, 5).splits == 1);
  // The ends of the access edge are no third vertex.
  CHECK(countSplits(domains, root, 0).splits == 0);
  CHECK(countSplits(domains, root, 1).splits == 0);
}

TEST_CASE("domain: enumeration ends when the visitor says so") {
  const LoopSet loops = loopSet({circle(6), circle(3, 1, {0, 0, 1}), circle(3, 1, {0, 0, 2})});
  Domains domains(loops);
  int calls = 0;
  domains.forEachSplit(domains.root(0), 3, [&](const Split&) { return ++calls < 2; });
  CHECK(calls == 2);
}

TEST_CASE("domain: splits are smaller, and shape and mirror image are kept alike") {
  const LoopSet loops = loopSet({circle(4), circle(3, 1, {0, 0, 1}), circle(5, 1, {0, 0, 2})});
  Domains domains(loops);
  Random random(51);
  MESSAGE("seed 51");
  int domainsSeen = 0;
  for (int walk = 0; walk < 300; ++walk) {
    std::vector<uint32_t> shape = domains.root(random.below(loops.vertexCount()));
    for (int depth = 0; depth < 40; ++depth) {
      std::vector<std::vector<uint32_t>> parts;
      for (uint32_t apex = 0; apex < loops.vertexCount(); ++apex)
        domains.forEachSplit(shape, apex, [&](const Split& split) {
          for (uint32_t i = 0; i < split.partCount; ++i)
            if (split.part[i].kind == PartKind::Domain) parts.push_back(split.part[i].shape);
          return true;
        });
      if (parts.empty()) break;
      shape = parts[random.below(uint32_t(parts.size()))];
      ++domainsSeen;
      // A loop is on the boundary at most once, and not a hole at the same time.
      std::vector<int> seen(loops.loopCount(), 0);
      for (uint32_t i = 0; i < domains.segmentCount(shape); ++i) {
        const Segment s = domains.segment(shape, i);
        CHECK(loops.loopOf(s.start) == loops.loopOf(s.end));
        ++seen[loops.loopOf(s.start)];
      }
      for (uint32_t c = 0; c < loops.loopCount(); ++c)
        CHECK(seen[c] + int(domains.hasHole(shape, c)) <= 1);
      // Canonical shapes are canonical, and the mirror image leads to the same one.
      domains.makeCanonical(shape);
      std::vector<uint32_t> again = shape;
      CHECK_FALSE(domains.makeCanonical(again));
      CHECK(again == shape);
    }
  }
  CHECK(domainsSeen > 1000);
}
