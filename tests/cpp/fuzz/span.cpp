// Fuzzes sf_span_loops through the C ABI: small, degenerate and malformed input of every kind, and loops as hands
// draw them.
// Whatever comes back has to be a status or a surface with the right numbers of everything.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "fuzz/bytes.h"
#include "soapfilm.h"
#include "support/hand_loops.h"

using namespace sffuzz;

namespace {

/// Calls of the progress function, each after a million units of work, until an input ends.
constexpr uint32_t kMostCalls = 60;
uint32_t callsLeft;

/// Mostly a small grid, where coincidences are common; now and then any double at all.
double coordinate(Bytes& in) {
  const uint8_t b = in.byte();
  if (b == 255) return in.raw();
  if (b >= 240) return (b - 247) * 1e-9;
  return double(b % 16) - 7;
}

double weight(Bytes& in) {
  static const double kWeights[] = {0, 1, 1, 0.25, 1e-3, 1e12, -1, NAN, INFINITY};
  return kWeights[in.below(9)];
}

template <class T>
const T* array(const SfResult* result, uint32_t index, size_t& length) {
  length = sf_result_length(result, index);
  return static_cast<const T*>(sf_result_data(result, index));
}

/// Counts, index ranges, and the valence of every edge of a surface that was handed back.
void checkSurface(const SfResult* result, uint32_t loopCount) {
  size_t coordinates, indices, orders, startCount, loopLength;
  array<double>(result, SfSpan_positions, coordinates);
  const uint32_t* triangles = array<uint32_t>(result, SfSpan_triangles, indices);
  array<uint32_t>(result, SfSpan_order, orders);
  const uint32_t* starts = array<uint32_t>(result, SfSpan_starts, startCount);
  const uint32_t* loops = array<uint32_t>(result, SfSpan_loopVertices, loopLength);
  const size_t n = coordinates / 3;
  require(coordinates % 3 == 0 && indices % 3 == 0, "whole points and triangles");
  require(indices / 3 == n + 2 * loopCount - 4, "n + 2k - 4 triangles");
  require(orders == indices / 3, "an order of all triangles");
  require(startCount == loopCount + 1 && loopLength == n, "loops over all vertices");
  std::map<std::pair<uint32_t, uint32_t>, int> directed;
  for (size_t t = 0; t < indices; t += 3)
    for (size_t i = 0; i < 3; ++i) {
      uint32_t a = triangles[t + i], b = triangles[t + (i + 1) % 3];
      require(a < n && a != b, "triangles of three vertices");
      require(++directed[{a, b}] == 1, "no half-edge twice");
    }
  size_t boundary = 0;
  for (const auto& [edge, count] : directed)
    if (directed.count({edge.second, edge.first}) == 0) ++boundary;
  require(boundary == n, "as many boundary edges as vertices");
  for (uint32_t c = 0; c < loopCount; ++c)
    for (uint32_t i = starts[c]; i < starts[c + 1]; ++i) {
      uint32_t a = loops[i], b = loops[i + 1 == starts[c + 1] ? starts[c] : i + 1];
      require(directed.count({a, b}) + directed.count({b, a}) == 1, "loop edges on the boundary");
    }
}

}  // namespace

extern "C" int32_t sf_host_progress(double, double, double) {
  if (callsLeft == 0) return 0;
  --callsLeft;
  return 1;
}

extern "C" void sf_host_result(const SfResult* result) {
  require(sf_result_length(result, SfSpan_triangles) > 0, "a surface so far has triangles");
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  Bytes in(data, size);
  sftest::Curves drawn;
  if (in.below(3) == 2) {
    sftest::Random random(in.byte() | uint32_t(in.byte()) << 8);
    const auto kind = sftest::Hand(in.below(int(sftest::Hand::Count)));
    drawn = sftest::handLoops(kind, sftest::logUniform(3, 150, random), random);
  }
  const uint32_t loopCount = drawn.empty() ? in.below(6) : uint32_t(drawn.size());
  std::vector<uint32_t> starts{in.below(64) == 63 ? 1u : 0u};
  for (uint32_t c = 0; c < loopCount; ++c)
    starts.push_back(starts.back() + (drawn.empty() ? in.below(10) : uint32_t(drawn[c].size())));
  const uint32_t n = *std::max_element(starts.begin(), starts.end());
  // `starts` may fall: an offset past the end would be the caller's lie about the array's length.
  if (in.below(32) == 31 && loopCount > 1) std::swap(starts[1], starts[loopCount]);

  const bool hasNormals = in.below(4) == 0;
  const uint32_t space = in.below(6);
  SfSpanSettings settings;
  settings.areaWeight = weight(in);
  settings.perimeterWeight = weight(in);
  settings.dihedralWeight = weight(in);
  settings.objective = double(in.below(3));
  settings.space = double(space);
  settings.maxBytes = 16e6;
  settings.bestSoFar = double(in.below(2));
  double* const odd[] = {&settings.objective, &settings.space, &settings.maxBytes,
                         &settings.bestSoFar};
  if (in.below(64) == 63) *odd[in.below(4)] = in.raw();
  const uint32_t triangleCount = space == 4 ? in.below(40) : 0;
  const bool hasTriangleWeights = in.below(2) == 0;

  std::vector<double> positions(3 * size_t(n)), normals, triangleWeights;
  if (drawn.empty())
    for (double& x : positions) x = coordinate(in);
  size_t next = 3 * size_t(starts[0]);
  for (const sftest::Curve& curve : drawn)
    for (const sftest::Vec3& p : curve)
      for (const double x : {p.x, p.y, p.z})
        if (next < positions.size()) positions[next++] = x;
  if (hasNormals)
    for (uint32_t i = 0; i < 3 * n; ++i) normals.push_back(in.below(5) ? coordinate(in) : NAN);
  std::vector<uint32_t> triangles(3 * size_t(triangleCount)), start(3 * size_t(in.below(9)));
  for (uint32_t& v : triangles) v = in.below(n + 1);
  for (uint32_t& v : start) v = in.below(n + 3);
  for (uint32_t i = 0; i < triangleCount; ++i) triangleWeights.push_back(weight(in));

  callsLeft = in.below(kMostCalls);
  SfPlace where;
  SfResult* result = nullptr;
  const SfStatus status = sf_span_loops(
      positions.data(), starts.data(), loopCount, hasNormals ? normals.data() : nullptr,
      space == 4 ? triangles.data() : nullptr, triangleCount,
      hasTriangleWeights && space == 4 ? triangleWeights.data() : nullptr,
      start.empty() ? nullptr : start.data(), uint32_t(start.size() / 3), &settings, &where,
      &result);
  require((status <= 1) == (result != nullptr), "a result exactly for status 0 and 1");
  require(status >= 0 && status <= 14, "a status of the list");
  if (status == 0) checkSurface(result, loopCount);
  if (result) sf_result_free(result);
  return 0;
}
