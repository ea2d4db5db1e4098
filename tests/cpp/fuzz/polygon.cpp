// Fuzzes the triangulation of polygons by both methods: small, degenerate and malformed rings of every
// kind. Accepted polygons have to be certified by the complement; what is refused by one method
// has to be refused by the other, in the same words; repair has to make something of everything finite.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <utility>
#include <vector>

#include "polygon/triangulate.h"

namespace {

/// Takes decisions from the fuzzer's bytes; zeros once they are used up.
class Bytes {
 public:
  Bytes(const uint8_t* data, size_t size) : data_(data), size_(size) {}
  uint8_t byte() {
    if (size_ == 0) return 0;
    --size_;
    return *data_++;
  }
  uint32_t below(uint32_t count) { return byte() % count; }
  double raw() {
    uint8_t bytes[8];
    for (uint8_t& b : bytes) b = byte();
    double value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
  }
  /// Mostly a small grid, where coincidences are common; also what is a unit in the last place or
  /// hundreds of orders of magnitude off it, and now and then any double at all.
  double coordinate() {
    const uint8_t b = byte();
    const double onGrid = double(b % 16) - 7;
    if (b == 255) return raw();
    if (b >= 248) return std::ldexp(onGrid, int(byte()) * 4 - 512);
    if (b >= 240) return std::nextafter(double(b % 4), byte() % 2 ? 100 : -100);
    return onGrid;
  }

 private:
  const uint8_t* data_;
  size_t size_;
};

void require(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "broken promise: %s\n", what);
  std::abort();
}

bool equal(const sf::Outcome& a, const sf::Outcome& b) {
  return a.status == b.status && a.loop == b.loop && a.vertex == b.vertex &&
         a.otherLoop == b.otherLoop && a.otherVertex == b.otherVertex;
}

/// Culprits have to be vertices of the polygon.
void checkPlace(const sf::Outcome& o, const sf::PolygonView& view) {
  const size_t rings = view.starts.size() - 1, points = view.points.size() / 2;
  const auto isPlace = [&](uint32_t loop, uint32_t vertex) {
    if (loop == sf::kNone) return vertex == sf::kNone;
    if (loop >= rings) return loop < rings + points && (vertex == sf::kNone || vertex == 0);
    return vertex == sf::kNone || vertex < view.starts[loop + 1] - view.starts[loop];
  };
  require(isPlace(o.loop, o.vertex) && isPlace(o.otherLoop, o.otherVertex), "culprits that exist");
}

void checkTriangles(const std::vector<uint32_t>& triangles, size_t n) {
  require(triangles.size() % 3 == 0, "whole triangles");
  for (size_t i = 0; i < triangles.size(); i += 3) {
    const uint32_t a = triangles[i], b = triangles[i + 1], c = triangles[i + 2];
    require(a < n && b < n && c < n, "indices in range");
    require(a != b && b != c && c != a, "three vertices");
  }
}

/// Triangles with the least corner first, in order.
std::vector<std::vector<uint32_t>> sorted(const std::vector<uint32_t>& list) {
  std::vector<std::vector<uint32_t>> result;
  for (size_t i = 0; i < list.size(); i += 3) {
    std::vector<uint32_t> t(list.begin() + ptrdiff_t(i), list.begin() + ptrdiff_t(i) + 3);
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    result.push_back(t);
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// Strips have the triangles, wound alike.
void checkStrips(const sf::PolygonTriangulation& r) {
  std::vector<uint32_t> list;
  require(!r.stripStarts.empty() && r.stripStarts.back() == r.strips.size(), "strips have starts");
  for (size_t s = 0; s + 1 < r.stripStarts.size(); ++s)
    for (uint32_t i = r.stripStarts[s]; i + 2 < r.stripStarts[s + 1]; ++i) {
      const bool odd = (i - r.stripStarts[s]) % 2;
      const uint32_t a = r.strips[i + odd], b = r.strips[i + !odd], c = r.strips[i + 2];
      if (a != b && b != c && c != a) list.insert(list.end(), {a, b, c});
    }
  require(sorted(list) == sorted(r.triangles), "strips have the triangles");
}

}  // namespace

extern "C" int32_t sf_host_progress(double, double, double) { return 1; }

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  Bytes in(data, size);
  std::vector<uint32_t> starts{in.below(64) == 63 ? 1u : 0u};
  const uint32_t rings = in.below(5);
  for (uint32_t c = 0; c < rings; ++c) starts.push_back(starts.back() + in.below(14));
  const uint32_t n = *std::max_element(starts.begin(), starts.end());
  if (in.below(32) == 31 && rings > 1) std::swap(starts[1], starts[rings]);
  const uint32_t pointCount = in.below(4) == 0 ? in.below(5) : 0;
  const bool delaunay = in.below(2), strips = in.below(4) == 0;
  std::vector<double> positions, points;
  for (uint32_t i = 0; i < 2 * n; ++i) positions.push_back(in.coordinate());
  for (uint32_t i = 0; i < 2 * pointCount; ++i) points.push_back(in.coordinate());
  const sf::PolygonView view{positions, starts, points};

  static sf::PolygonTriangulator triangulator;  // its memory goes from input to input
  sf::Outcome outcomes[2];
  for (const auto method : {sf::PolygonMethod::Flooding, sf::PolygonMethod::Trapezoids}) {
    sf::PolygonOptions options;
    options.method = method, options.verify = true, options.delaunay = delaunay;
    options.strips = strips, options.trace = true;
    sf::PolygonTriangulation result;
    sf::Work work;
    // A certificate that fails would abort here: SF_ASSERT is armed.
    const sf::Outcome outcome = triangulator.triangulate(view, options, work, result);
    require(work.used() == 0, "memory charged is given back");
    outcomes[int(method)] = outcome;
    checkTriangles(result.triangles, n + pointCount);
    require(outcome.ok() != result.triangles.empty(), "triangles exactly if all is well");
    if (outcome.status != sf::Status::BadStarts) checkPlace(outcome, view);
    if (outcome.ok() && strips) checkStrips(result);
  }
  require(equal(outcomes[0], outcomes[1]), "methods agree on what is wrong");

  sf::PolygonOptions repairing;
  repairing.repair = in.below(2) ? sf::Repair::EvenOdd : sf::Repair::NonZero;
  sf::PolygonTriangulation repaired;
  sf::Work work(64u << 20, nullptr, nullptr);
  const sf::Outcome outcome =
      triangulator.triangulate({positions, starts, {}}, repairing, work, repaired);
  require(outcome.ok() || outcome.status == sf::Status::BadStarts ||
              outcome.status == sf::Status::NotFinite,
          "repair makes something of everything finite");
  checkTriangles(repaired.triangles, n + repaired.added.size() / 2);
  return 0;
}
