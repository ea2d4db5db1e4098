#include "triangles/insertion_order.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "support/polygon_generators.h"

using namespace sf;
using namespace sftest;

namespace {

constexpr uint32_t kCount = 20'000;

std::vector<Point2> randomPoints(uint32_t count, double size, Random& random) {
  std::vector<Point2> at(count);
  for (Point2& p : at) p = {size * random.unit(), size * random.unit()};
  return at;
}

double distance(Point2 a, Point2 b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// The sum of the distances from each point of a range to the next.
double lengthOf(const std::vector<Point2>& at, const std::vector<uint32_t>& order, size_t first,
                size_t end) {
  double sum = 0;
  for (size_t i = first + 1; i < end; ++i) sum += distance(at[order[i - 1]], at[order[i]]);
  return sum;
}

}  // namespace

TEST_CASE("insertion order: the indices given, each once, whatever else there is") {
  constexpr uint32_t kSeed = 4400;
  CAPTURE(kSeed);
  Random random(kSeed);
  const std::vector<Point2> at = randomPoints(kCount, 1, random);
  std::vector<uint32_t> some;
  for (uint32_t i = 5; i < kCount; i += 1 + random.below(4)) some.push_back(i);
  std::vector<uint32_t> order = some;
  sortForInsertion(at, order);
  CHECK(order != some);
  std::vector<uint32_t> again = some;
  std::reverse(again.begin(), again.end());
  sortForInsertion(at, again);
  CHECK(again == order);  // the order they come in does not matter
  std::sort(order.begin(), order.end());
  CHECK(order == some);
}

TEST_CASE("insertion order: each round about doubles the points, near ones follow each other") {
  constexpr uint32_t kSeed = 4401;
  CAPTURE(kSeed);
  Random random(kSeed);
  const double size = 0x1p-300;
  const std::vector<Point2> at = randomPoints(kCount, size, random);
  std::vector<uint32_t> order(kCount);
  std::iota(order.begin(), order.end(), 0);
  sortForInsertion(at, order);
  // A curve through k cells of a square has length sqrt(k): the last round, of about half of all.
  const size_t half = kCount / 2 + kCount / 50;
  CHECK(lengthOf(at, order, half, kCount) < 1.5 * size * std::sqrt(double(kCount / 2)));
  // The first half is spread all over the square, not over one part of it.
  double left = 0, low = 0;
  for (size_t i = 0; i < kCount / 2; ++i) {
    left += at[order[i]].x < size / 2;
    low += at[order[i]].y < size / 2;
  }
  CHECK(std::fabs(left / (kCount / 2.0) - 0.5) < 0.02);
  CHECK(std::fabs(low / (kCount / 2.0) - 0.5) < 0.02);
  // So is each round: the first thousand points come by several curves, each through the square.
  CHECK(lengthOf(at, order, 0, 1000) > size * std::sqrt(1000.0) / 2);
}

TEST_CASE("insertion order: points at one place, on a line, one or none") {
  for (const uint32_t count : {0u, 1u, 2u, 500u})
    for (const Point2 step : {Point2{0, 0}, Point2{1, 0}, Point2{0, -1e150}}) {
      CAPTURE(count);
      std::vector<Point2> at(count);
      for (uint32_t i = 0; i < count; ++i) at[i] = {3 + step.x * i, step.y * (i / 500.0)};
      std::vector<uint32_t> order(count);
      std::iota(order.begin(), order.end(), 0);
      sortForInsertion(at, order);
      std::sort(order.begin(), order.end());
      for (uint32_t i = 0; i < count; ++i) REQUIRE(order[i] == i);
    }
}
