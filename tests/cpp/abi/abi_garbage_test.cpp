// Random input through the C ABI: every call ends, with a status of the list, and harms nothing.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>

#include "base/status.h"
#include "soapfilm.h"
#include "support/cases.h"
#include "support/surface.h"

using namespace sftest;

namespace {

// What the host answers: it lets calls go on for so many reports, then stops them.
uint32_t reportsLeft = 0xFFFFFFFF;
uint32_t reportCount = 0;
bool reportsInOrder = true;
double lastFraction = 0;

void expectReports(uint32_t allowed) {
  reportsLeft = allowed;
  reportCount = 0;
  lastFraction = 0;
}

}  // namespace

extern "C" int32_t sf_host_progress(double fraction, double bestCost, double lowerBound) {
  ++reportCount;
  reportsInOrder &=
      fraction >= lastFraction && fraction <= 1 && !std::isnan(bestCost) && !std::isnan(lowerBound);
  lastFraction = fraction;
  if (reportsLeft == 0) return 0;
  --reportsLeft;
  return 1;
}

namespace {

/// One call's arrays, each in a block of exactly its size, so that a sanitizer sees any overrun.
struct Call {
  std::vector<double> positions, normals, triangleWeights;
  std::vector<uint32_t> starts{0}, triangles, start;
  SfSpanSettings settings{0, 0, 1, 0, 1, 1e9, 0};

  SfPlace where{};
  SfResult* result = nullptr;

  void add(const Curve& curve) {
    for (Vec3 p : curve) positions.insert(positions.end(), {p.x, p.y, p.z});
    starts.push_back(uint32_t(positions.size() / 3));
  }

  SfStatus run() {
    auto exact = [](const auto& values) {
      using T = std::decay_t<decltype(values[0])>;
      std::unique_ptr<T[]> copy(new T[values.size()]);
      std::copy(values.begin(), values.end(), copy.get());
      return copy;
    };
    auto p = exact(positions), n = exact(normals), w = exact(triangleWeights);
    auto s = exact(starts), t = exact(triangles), b = exact(start);
    return sf_span_loops(
        p.get(), s.get(), uint32_t(starts.size() - 1), normals.empty() ? nullptr : n.get(),
        triangles.empty() ? nullptr : t.get(), uint32_t(triangles.size() / 3),
        triangleWeights.empty() ? nullptr : w.get(), start.empty() ? nullptr : b.get(),
        uint32_t(start.size() / 3), &settings, &where, &result);
  }
};

template <class T>
std::vector<T> array(const SfResult* result, uint32_t which) {
  const T* data = static_cast<const T*>(sf_result_data(result, which));
  size_t length = sf_result_length(result, which);
  return std::vector<T>(data, data + length);
}

SfSpanNumbers numbersOf(const SfResult* result) {
  SfSpanNumbers numbers;
  std::memcpy(&numbers, sf_result_data(result, SfSpan_numbers), sizeof numbers);
  return numbers;
}

double wildNumber(Random& random) {
  switch (random.below(12)) {
    case 0:
      return std::numeric_limits<double>::quiet_NaN();
    case 1:
      return std::numeric_limits<double>::infinity();
    case 2:
      return -std::numeric_limits<double>::infinity();
    case 3:
      return 1e300 * random.range(-1, 1);
    case 4:
      return 1e-300 * random.range(-1, 1);
    case 5:
      return std::numeric_limits<double>::denorm_min();
    case 6:
      return -0.0;
    case 7:
      return std::numeric_limits<double>::max();
    default:
      return random.range(-10, 10);
  }
}

/// Loops that may be anything: mostly well formed, often degenerate, sometimes nonsense.
Call wildCall(Random& random) {
  Call call;
  uint32_t loops = random.below(12) == 0 ? 0 : 1 + random.below(random.chance(0.1) ? 6 : 3);
  uint32_t style = random.below(7);
  for (uint32_t c = 0; c < loops; ++c) {
    uint32_t size = random.chance(0.05) ? random.below(3) : 3 + random.below(loops > 2 ? 3 : 7);
    call.starts.push_back(call.starts.back() + size);
  }
  uint32_t n = call.starts.back();
  for (uint32_t i = 0; i < n; ++i) {
    double offset = style == 5 ? 1e8 : 0, size = style == 4 ? 1e-150 : style == 6 ? 1e140 : 1;
    Vec3 p = random.inCube(1);
    if (style == 1) p = {double(random.below(4)), double(random.below(4)), double(random.below(4))};
    if (style == 2) p = {double(random.below(9)), double(random.below(9)), 0};
    if (style == 3) p = {double(i), 0, 0};
    for (double x : {p.x, p.y, p.z}) call.positions.push_back(offset + size * x);
  }
  if (n > 0 && random.chance(0.15))
    call.positions[random.below(uint32_t(call.positions.size()))] = wildNumber(random);
  if (n > 0 && random.chance(0.1)) {
    // A vertex repeated somewhere.
    uint32_t from = random.below(n), to = random.below(n);
    for (int i = 0; i < 3; ++i) call.positions[3 * to + i] = call.positions[3 * from + i];
  }
  if (loops > 0 && random.chance(0.05))
    call.starts[random.below(loops)] = random.chance(0.5) ? random.below(20) : random.bits();

  SfSpanSettings& settings = call.settings;
  for (double* weight :
       {&settings.areaWeight, &settings.perimeterWeight, &settings.dihedralWeight}) {
    *weight = random.chance(0.5) ? random.unit() : 0;
    if (weight == &settings.areaWeight && random.chance(0.1)) *weight = std::nan("");
    if (random.chance(0.03)) *weight = wildNumber(random);
  }
  settings.objective = random.chance(0.3);
  settings.space = random.below(5);
  settings.maxBytes = random.chance(0.2) ? std::exp2(random.range(0, 22)) : 1e9;
  settings.bestSoFar = random.chance(0.3);
  if (random.chance(0.2))
    for (uint32_t i = 0; i < 3 * n; ++i) call.start.push_back(random.below(n + 2));
  for (double* setting :
       {&settings.objective, &settings.space, &settings.maxBytes, &settings.bestSoFar})
    if (random.chance(0.02)) *setting = wildNumber(random);

  if (n > 0 && random.chance(0.2))
    for (uint32_t i = 0; i < 3 * n; ++i)
      call.normals.push_back(random.chance(0.02) ? wildNumber(random) : random.range(-1, 1));
  if (n > 0 && random.chance(0.3)) {
    uint32_t count = random.below(3 * n + 1);
    for (uint32_t i = 0; i < 3 * count; ++i)
      call.triangles.push_back(random.chance(0.002) ? random.bits() : random.below(n));
    if (random.chance(0.5))
      for (uint32_t i = 0; i < count; ++i)
        call.triangleWeights.push_back(random.chance(0.01) ? wildNumber(random) : random.unit());
  }
  return call;
}

Call goodCall() {
  Call call;
  call.add(circle(7));
  call.add(circle(6, 1, {0, 0, 1}));
  return call;
}

/// Reads a result back and judges it like any other answer.
std::string resultFault(const Call& call) {
  sf::Span span;
  if (array<double>(call.result, SfSpan_numbers).size() * sizeof(double) != sizeof(SfSpanNumbers))
    return "not all numbers";
  const SfSpanNumbers numbers = numbersOf(call.result);
  span.found = numbers.found != 0;
  if (!span.found) return "";
  auto positions = array<double>(call.result, SfSpan_positions);
  for (size_t i = 0; i + 2 < positions.size(); i += 3)
    span.positions.push_back({positions[i], positions[i + 1], positions[i + 2]});
  span.triangles = array<uint32_t>(call.result, SfSpan_triangles);
  span.order = array<uint32_t>(call.result, SfSpan_order);
  span.starts = array<uint32_t>(call.result, SfSpan_starts);
  span.loopVertices = array<uint32_t>(call.result, SfSpan_loopVertices);
  auto places = array<uint32_t>(call.result, SfSpan_insertedPlaces);
  auto parameters = array<double>(call.result, SfSpan_insertedParameters);
  if (places.size() != 2 * parameters.size()) return "inserted vertices without a place";
  for (size_t i = 0; i < parameters.size(); ++i)
    span.inserted.push_back({places[2 * i], places[2 * i + 1], parameters[i]});
  span.cost = numbers.cost, span.lowerBound = numbers.lowerBound;
  span.optimal = numbers.optimal != 0;
  span.terms = {numbers.area, numbers.perimeter, numbers.dihedral, numbers.worstDihedral,
                numbers.own};
  sf::SpanOptions options;
  options.areaWeight = call.settings.areaWeight;
  options.perimeterWeight = call.settings.perimeterWeight;
  options.dihedralWeight = call.settings.dihedralWeight;
  options.objective = sf::Objective(int(call.settings.objective));
  options.space = sf::Space(int(call.settings.space));
  options.boundaryNormals = call.normals;
  options.triangles = call.triangles;
  options.triangleWeights = call.triangleWeights;
  std::vector<Vec3> input;
  for (size_t i = 0; i + 2 < call.positions.size(); i += 3)
    input.push_back({call.positions[i], call.positions[i + 1], call.positions[i + 2]});
  if (std::isnan(options.areaWeight)) {
    // The default: 1e-3 over the squared diagonal of the bounding box.
    double squared = 0;
    for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
      auto [low, high] = std::minmax_element(input.begin(), input.end(),
                                             [&](Vec3 a, Vec3 b) { return a.*axis < b.*axis; });
      squared += ((*high).*axis - (*low).*axis) * ((*high).*axis - (*low).*axis);
    }
    options.areaWeight = 1e-3 / squared;
  }
  return spanFault(sf::LoopSet(input, call.starts), options, span);
}

void expectGoodCallWorks() {
  expectReports(0xFFFFFFFF);
  Call call = goodCall();
  REQUIRE(call.run() == 0);
  CHECK(resultFault(call) == "");
  sf_result_free(call.result);
}

bool isPlace(uint32_t loop, uint32_t vertex, const Call& call) {
  if (loop == sf::kNone) return true;
  if (loop + 1 >= call.starts.size()) return false;
  return vertex == sf::kNone || vertex < call.starts[loop + 1] - call.starts[loop] ||
         vertex < call.triangles.size() / 3;
}

}  // namespace

TEST_CASE("abi: ten thousand random inputs end with a known status, and a good call still works") {
  uint32_t statuses[15] = {};
  for (uint32_t seed = 1; seed <= 10000; ++seed) {
    Random random(seed);
    Call call = wildCall(random);
    // Enough for most of them; the others are stopped, at different moments.
    expectReports(random.below(4));
    INFO("seed ", seed);
    SfStatus status = call.run();
    REQUIRE(status >= 0);
    REQUIRE(status <= 14);
    ++statuses[status];
    // An answer has arrays, anything else has none.
    REQUIRE((call.result != nullptr) == (status <= 1));
    if (status > 1) {
      CHECK(isPlace(call.where.loop, call.where.vertex, call));
      CHECK(isPlace(call.where.otherLoop, call.where.otherVertex, call));
    }
    // Sizes near the ends of double's range have areas that no longer mean anything.
    double size = 0;
    for (double x : call.positions) size = std::max(size, std::fabs(x));
    if (status == 0 && size > 1e-50 && size < 1e5) CHECK(resultFault(call) == "");
    if (call.result) sf_result_free(call.result);
    if (seed % 500 == 0) expectGoodCallWorks();
  }
  for (int i = 0; i < 15; ++i) MESSAGE("status " << i << ": " << statuses[i]);
  // The garbage is varied enough to meet nearly every status.
  for (int status : {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 14}) CHECK(statuses[status] > 0);
  CHECK(statuses[11] + statuses[12] > 0);
  CHECK(reportsInOrder);
}

TEST_CASE("abi: a call that is stopped at any moment leaves the next one unharmed") {
  Call whole;
  whole.settings.space = 1;
  for (const Curve& curve : {circle(5), circle(4, 1, {0, 0, 1}), circle(4, 1, {0.1, 0.2, 2.5})})
    whole.add(curve);
  expectReports(0xFFFFFFFF);
  REQUIRE(whole.run() == 0);
  sf_result_free(whole.result);
  uint32_t reports = reportCount;
  MESSAGE(reports << " reports");
  CHECK(reports > 10);
  for (uint32_t allowed = 0; allowed < 12; ++allowed) {
    Call call = whole;
    call.result = nullptr;
    expectReports(allowed * (reports - 1) / 12);
    SfStatus status = call.run();
    CHECK(status == int32_t(sf::Status::Stopped));
    CHECK(call.result == nullptr);
    expectGoodCallWorks();
  }
}

TEST_CASE("abi: every memory limit is kept to, with a status that says so") {
  Call unlimited = goodCall();
  expectReports(0xFFFFFFFF);
  REQUIRE(unlimited.run() == 0);
  double peak = numbersOf(unlimited.result).peakBytes;
  sf_result_free(unlimited.result);
  CHECK(peak > 0);
  int refused = 0, solved = 0;
  for (double limit = 1; limit < 4 * peak; limit *= 1.5) {
    Call call = goodCall();
    call.settings.maxBytes = limit;
    SfStatus status = call.run();
    bool out =
        status == int32_t(sf::Status::TooLarge) || status == int32_t(sf::Status::OutOfMemory);
    INFO("limit ", limit, ", status ", status);
    CHECK((out || status == 0));
    refused += out;
    if (status != 0) continue;
    ++solved;
    CHECK(resultFault(call) == "");
    CHECK(numbersOf(call.result).peakBytes <= limit);
    sf_result_free(call.result);
  }
  CHECK(refused > 3);
  CHECK(solved > 0);
  expectGoodCallWorks();
}
