#include "loops/domains/weak_edge_set.h"

#include <doctest/doctest.h>

#include <set>

#include "support/generators.h"

using namespace sf;

TEST_CASE("weak edge sets: disjoint, subset, contains and union agree with std::set") {
  sftest::Random random(61);
  MESSAGE("seed 61");
  for (int i = 0; i < 500; ++i) {
    std::set<uint32_t> a, b;
    for (uint32_t j = random.below(6); j > 0; --j) a.insert(random.below(9));
    for (uint32_t j = random.below(6); j > 0; --j) b.insert(random.below(9));
    const std::vector<uint32_t> va(a.begin(), a.end()), vb(b.begin(), b.end());
    bool common = false, subset = true;
    for (const uint32_t e : a) {
      common = common || b.count(e);
      subset = subset && b.count(e);
    }
    CHECK(disjoint(va, vb) == !common);
    CHECK(isSubset(va, vb) == subset);
    for (uint32_t e = 0; e < 9; ++e) CHECK(contains(va, e) == (a.count(e) == 1));
    std::set<uint32_t> both = a;
    both.insert(b.begin(), b.end());
    std::vector<uint32_t> joint;
    unite(va, vb, joint);
    CHECK(joint == std::vector<uint32_t>(both.begin(), both.end()));
  }
}
