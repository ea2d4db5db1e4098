#include "base/sort.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "support/generators.h"

using namespace sf;
using namespace sftest;

namespace {

/// An item that is more than its key, so that a lost or doubled one shows.
struct Item {
  uint32_t key, id;
  std::string text;
};

std::vector<Item> items(const std::vector<uint32_t>& keys) {
  std::vector<Item> result;
  for (uint32_t i = 0; i < keys.size(); ++i) result.push_back({keys[i], i, std::to_string(i)});
  return result;
}

/// The keys that `sort` compares most for: each is fixed only when it is compared as a pivot.
/// Source: McIlroy 1999, "A killer adversary for quicksort".
struct Adversary {
  std::vector<uint32_t> value;
  uint32_t gas, solid = 0, candidate = 0;
  size_t comparisons = 0;

  explicit Adversary(uint32_t count) : value(count, count), gas(count) {}

  bool less(uint32_t a, uint32_t b) {
    ++comparisons;
    if (value[a] == gas && value[b] == gas) value[a == candidate ? a : b] = solid++;
    if (value[a] == gas)
      candidate = a;
    else if (value[b] == gas)
      candidate = b;
    return value[a] < value[b];
  }
};

}  // namespace

TEST_CASE("sort: as std::sort on keys of any shape, and nothing lost") {
  Random random(7101);
  for (uint32_t count : {0u, 1u, 2u, 3u, 15u, 16u, 17u, 18u, 33u, 100u, 1000u, 20000u}) {
    for (int shape = 0; shape < 6; ++shape) {
      CAPTURE(count);
      CAPTURE(shape);
      std::vector<uint32_t> keys(count);
      for (uint32_t i = 0; i < count; ++i) {
        const uint32_t any = random.bits();
        const uint32_t forms[] = {any, i, count - i, 5, any % 3, std::min(i, count - i)};
        keys[i] = forms[shape];
      }
      std::vector<uint32_t> expected = keys, plain = keys;
      std::sort(expected.begin(), expected.end());
      sf::sort(plain.begin(), plain.end());
      CHECK(plain == expected);

      std::vector<Item> sorted = items(keys);
      sf::sort(sorted.begin(), sorted.end(),
               [](const Item& a, const Item& b) { return a.key < b.key; });
      std::vector<uint32_t> seen;
      bool isWhole = true;
      for (size_t i = 0; i < sorted.size(); ++i) {
        const Item& item = sorted[i];
        isWhole = isWhole && item.key == expected[i] && keys[item.id] == item.key &&
                  item.text == std::to_string(item.id);
        seen.push_back(item.id);
      }
      CHECK(isWhole);
      std::sort(seen.begin(), seen.end());
      CHECK(std::adjacent_find(seen.begin(), seen.end()) == seen.end());
    }
  }
}

TEST_CASE("sort: a range within an array leaves the rest alone") {
  std::vector<int> values{9, 8, 7, 6, 5, 4};
  sf::sort(values.begin() + 1, values.begin() + 5);
  CHECK(values == std::vector<int>{9, 5, 6, 7, 8, 4});
  sf::sort(values.data(), values.data() + 3, [](int a, int b) { return a > b; });
  CHECK(values == std::vector<int>{9, 6, 5, 7, 8, 4});
}

TEST_CASE("sort: n log n comparisons against an adversary of quicksort") {
  for (uint32_t count : {1000u, 30000u}) {
    Adversary adversary(count);
    std::vector<uint32_t> order(count);
    for (uint32_t i = 0; i < count; ++i) order[i] = i;
    sf::sort(order.begin(), order.end(),
             [&](uint32_t a, uint32_t b) { return adversary.less(a, b); });
    bool isSorted = true;
    for (uint32_t i = 1; i < count; ++i)
      isSorted = isSorted && adversary.value[order[i - 1]] <= adversary.value[order[i]];
    CHECK(isSorted);
    // Quicksort alone would take count^2 / 16 or more.
    CHECK(double(adversary.comparisons) < 8 * count * std::log2(count));
  }
}

TEST_CASE("select: the right item in its place, the less before it, nothing lost") {
  MESSAGE("seed 7103");
  Random random(7103);
  for (const uint32_t count : {1u, 2u, 16u, 17u, 40u, 1000u}) {
    for (int shape = 0; shape < 4; ++shape) {
      CAPTURE(count);
      CAPTURE(shape);
      std::vector<uint32_t> keys(count);
      for (uint32_t i = 0; i < count; ++i) {
        const uint32_t forms[] = {random.bits(), i, 5, random.bits() % 3};
        keys[i] = forms[shape];
      }
      std::vector<uint32_t> expected = keys;
      std::sort(expected.begin(), expected.end());
      for (const uint32_t at : {0u, count / 2, count - 1}) {
        std::vector<uint32_t> values = keys;
        sf::select(values.begin(), values.begin() + at, values.end());
        CHECK(values[at] == expected[at]);
        for (uint32_t i = 0; i < count; ++i)
          CHECK((i < at ? values[i] <= values[at] : values[i] >= values[at]));
        std::sort(values.begin(), values.end());
        CHECK(values == expected);
      }
    }
  }
  // Nothing to be found leaves everything alone.
  std::vector<int> none, two{2, 1};
  sf::select(none.begin(), none.end(), none.end());
  sf::select(two.begin(), two.end(), two.end());
  CHECK(two == std::vector<int>{2, 1});
}

TEST_CASE("select: n log n comparisons against an adversary of quicksort") {
  const uint32_t count = 30000;
  Adversary adversary(count);
  std::vector<uint32_t> order(count);
  for (uint32_t i = 0; i < count; ++i) order[i] = i;
  sf::select(order.begin(), order.begin() + count / 2, order.end(),
             [&](uint32_t a, uint32_t b) { return adversary.less(a, b); });
  CHECK(double(adversary.comparisons) < 8 * count * std::log2(count));
}
