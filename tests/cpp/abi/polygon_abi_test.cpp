// Polygons through the C ABI: the arrays that tests/unit sees in WebAssembly, by checksum; polygons in
// space; sessions; and calls that make no sense.
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "base/status.h"
#include "soapfilm.h"
#include "support/polygon_generators.h"

using namespace sftest;
using sf::Status;

namespace {

/// One call's arguments, and what it hands back.
struct PolygonCall {
  std::vector<double> positions, points;
  std::vector<uint32_t> ringStarts{0}, polygonStarts{0};
  SfPolygonSettings settings{2, 0, 0, 0, 0, 0, 0, 1e9};

  SfPlace where{};
  SfResult* result = nullptr;

  PolygonCall() = default;
  PolygonCall(const PolygonCall&) = delete;
  PolygonCall& operator=(const PolygonCall&) = delete;
  ~PolygonCall() { sf_result_free(result); }

  void add(const Polygon& polygon) {
    const uint32_t first = ringStarts.back();
    positions.insert(positions.end(), polygon.positions.begin(), polygon.positions.end());
    for (size_t r = 1; r < polygon.starts.size(); ++r)
      ringStarts.push_back(first + polygon.starts[r]);
    polygonStarts.push_back(uint32_t(ringStarts.size()) - 1);
  }
  Status run() {
    sf_result_free(result);
    const size_t dimension = positions.size() == 3 * size_t(ringStarts.back()) ? 3 : 2;
    return Status(sf_triangulate_polygons(
        positions.data(), ringStarts.data(), uint32_t(ringStarts.size()) - 1, polygonStarts.data(),
        uint32_t(polygonStarts.size()) - 1, points.data(), uint32_t(points.size() / dimension),
        &settings, &where, &result));
  }
  template <class T>
  std::vector<T> array(uint32_t i) const {
    const T* data = static_cast<const T*>(sf_result_data(result, i));
    return {data, data + sf_result_length(result, i)};
  }
};

/// FNV-1a over bytes.
uint32_t hashOf(const void* data, size_t bytes, uint32_t hash = 2166136261u) {
  for (size_t i = 0; i < bytes; ++i)
    hash = (hash ^ static_cast<const uint8_t*>(data)[i]) * 16777619u;
  return hash;
}

/// Over triangles to added edges.
uint32_t hashOf(const PolygonCall& call) {
  uint32_t hash = 2166136261u;
  for (const auto i :
       {SfPolygon_triangles, SfPolygon_triangleStarts, SfPolygon_strips, SfPolygon_stripStarts,
        SfPolygon_polygonStrips, SfPolygon_added, SfPolygon_addedOn})
    hash = hashOf(sf_result_data(call.result, i),
                  (i == SfPolygon_added ? 8 : 4) * sf_result_length(call.result, i), hash);
  return hash;
}

/// Generators that do without sines and cosines, and so give the same coordinates in TypeScript.
Polygon polygonNamed(const std::string& family, uint32_t n, Random& random) {
  if (family == "partition") return polygonOf({partitionRing(n, random)});
  if (family == "comb") return polygonOf({combRing(n, random)});
  if (family == "double comb") return polygonOf({doubleCombRing(n, random)});
  if (family == "interleaved comb") return polygonOf({interleavedCombRing(n, random)});
  if (family == "staircase") return polygonOf({staircaseRing(n)});
  if (family == "zigzag") return polygonOf({zigzagRing(n, random)});
  if (family == "garbage") return garbage(3, n, 0, random);
  REQUIRE(family == "lattice garbage");
  return garbage(2, n, 6, random);
}

std::string hex(uint32_t value) {
  char text[16];
  std::snprintf(text, sizeof text, "%08x", value);
  return text;
}

/// The columns after the family, n and seed: the input, then the results by method and quality, of
/// strips, and of repair by either rule.
std::string checksums(const std::string& family, uint32_t n, uint32_t seed) {
  Random random(seed);
  const Polygon polygon = polygonNamed(family, n, random);
  const bool broken = family.find("garbage") != std::string::npos;
  std::string row = hex(hashOf(polygon.positions.data(), 8 * polygon.positions.size()));
  using Settings = SfPolygonSettings;
  const auto append = [&](std::initializer_list<std::pair<double Settings::*, double>> choices) {
    PolygonCall call;
    call.add(polygon);
    call.settings.repair = broken ? 1 : 0;
    for (const auto& [setting, value] : choices) call.settings.*setting = value;
    REQUIRE(call.run() == Status::Ok);
    REQUIRE(call.array<uint32_t>(SfPolygon_faults).empty());
    row += "," + hex(hashOf(call));
  };
  append({{&Settings::method, 0}});
  append({{&Settings::method, 0}, {&Settings::delaunay, 1}, {&Settings::verify, 1}});
  append({{&Settings::method, 1}});
  append({{&Settings::method, 1}, {&Settings::delaunay, 1}});
  append({{&Settings::method, 1}, {&Settings::strips, 1}});
  append({{&Settings::repair, 2}});
  return row;
}

}  // namespace

TEST_CASE("polygons, C ABI: the results whose checksums WebAssembly has to reach") {
  std::ifstream file(std::string(SF_FIXTURES) + "/polygon_checksums.csv");
  std::vector<std::string> wanted;
  int rows = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#' || line.rfind("family,", 0) == 0) continue;
    std::stringstream stream(line);
    std::string family, n, seed;
    std::getline(stream, family, ','), std::getline(stream, n, ','),
        std::getline(stream, seed, ',');
    const std::string facts = family + "," + n + "," + seed + ",";
    const std::string now =
        facts + checksums(family, uint32_t(std::stoul(n)), uint32_t(std::stoul(seed)));
    CHECK(now == line);
    wanted.push_back(now);
    ++rows;
  }
  CHECK(rows > 30);
  // After a change of the triangulators that is meant: these lines are for the file.
  std::string all;
  for (const std::string& line : wanted) all += line + "\n";
  INFO(all);
}

TEST_CASE("polygons, C ABI: planes of any tilt give the triangles of the plane") {
  constexpr uint32_t kSeed = 7;
  CAPTURE(kSeed);
  Random random(kSeed);
  const auto place = [](const Polygon& polygon, const double(&m)[3][3]) {
    std::vector<double> at;
    for (uint32_t v = 0; v < polygon.vertexCount(); ++v)
      for (const auto& row : m)
        at.push_back(row[0] * polygon.point(v).x + row[1] * polygon.point(v).y + row[2]);
    return at;
  };
  const double tilts[][3][3] = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 5}},
                                {{0, 0, 3}, {1, 0, 0}, {0, 1, 0}},
                                {{0, 1, 0}, {0, 0, 2}, {1, 0, 0}},
                                {{1, 0, 0}, {0, 1, 0}, {0.5, 0.25, 0}}};
  for (int i = 0; i < 200; ++i) {
    CAPTURE(i);
    const Polygon polygon = latticeRegion(6, 20, false, true, random);
    PolygonCall flat;
    flat.add(polygon);
    const Status status = flat.run();
    REQUIRE(status == Status::Ok);
    for (const auto& tilt : tilts) {
      PolygonCall call;
      call.add(polygon);
      call.positions = place(polygon, tilt);
      call.settings.dimension = 3;
      REQUIRE(call.run() == Status::Ok);
      CHECK(call.array<uint32_t>(SfPolygon_faults).empty());
      CHECK(call.array<uint32_t>(SfPolygon_triangles).size() ==
            flat.array<uint32_t>(SfPolygon_triangles).size());
    }
  }
}

TEST_CASE(
    "polygons, C ABI: a fault is named with its polygon and place, the others are triangulated") {
  for (const double dimension : {2.0, 3.0}) {
    PolygonCall call;
    call.settings.dimension = dimension;
    const Polygon square = polygonOf({{{0, 0}, {4, 0}, {4, 4}, {0, 4}}});
    const Polygon bowTie = polygonOf({{{0, 0}, {2, 2}, {2, 0}, {0, 2}}});
    for (const Polygon& polygon : {square, bowTie, square}) call.add(polygon);
    if (dimension == 3) {
      std::vector<double> in3;
      for (size_t i = 0; i < call.positions.size(); i += 2)
        in3.insert(in3.end(), {7, call.positions[i], call.positions[i + 1]});
      call.positions = in3;
    }
    REQUIRE(call.run() == Status::Ok);
    CHECK(call.array<uint32_t>(SfPolygon_triangleStarts) == std::vector<uint32_t>{0, 2, 2, 4});
    CHECK(call.array<uint32_t>(SfPolygon_faults) ==
          std::vector<uint32_t>{1, uint32_t(Status::SelfIntersecting), 0, 0, 0, 2});
    const std::vector<double> place = call.array<double>(SfPolygon_faultPoints);
    CHECK(place == (dimension == 2 ? std::vector<double>{1, 1} : std::vector<double>{7, 1, 1}));
  }
}

TEST_CASE("polygons, C ABI: random arguments end with a status, and arrays that fit each other") {
  constexpr uint32_t kSeed = 4242;
  CAPTURE(kSeed);
  Random random(kSeed);
  const double odd[] = {std::numeric_limits<double>::quiet_NaN(),
                        std::numeric_limits<double>::infinity(),
                        1e300,
                        -1e-320,
                        0,
                        1e150};
  for (int i = 0; i < 3000; ++i) {
    CAPTURE(i);
    PolygonCall call;
    call.settings.dimension = 2 + random.below(2);
    const uint32_t dimension = uint32_t(call.settings.dimension);
    for (uint32_t p = random.below(4); p > 0; --p) {
      const bool valid = random.chance(0.6);
      call.add(valid ? smallPolygon(random) : garbage(random.below(3), random.below(9), 4, random));
    }
    call.positions.resize(dimension * size_t(call.ringStarts.back()));
    if (dimension == 3)
      for (double& x : call.positions)
        if (random.chance(0.3)) x = random.below(5);
    if (random.chance(0.1) && !call.positions.empty())
      call.positions[random.below(uint32_t(call.positions.size()))] = odd[random.below(6)];
    if (random.chance(0.1)) call.points.assign(dimension * size_t(random.below(4)), 0.5);
    SfPolygonSettings& settings = call.settings;
    settings.method = random.below(2), settings.repair = random.below(3);
    for (double* yesOrNo :
         {&settings.delaunay, &settings.strips, &settings.verify, &settings.trace})
      *yesOrNo = random.below(2);
    double* const all[] = {&settings.dimension, &settings.method,  &settings.repair,
                           &settings.delaunay,  &settings.strips,  &settings.verify,
                           &settings.trace,     &settings.maxBytes};
    if (random.chance(0.05)) *all[random.below(8)] = odd[random.below(6)];
    if (random.chance(0.05) && call.ringStarts.size() > 2)
      std::swap(call.ringStarts[1], call.ringStarts[2]);
    if (random.chance(0.1)) settings.maxBytes = random.below(20000);
    const Status status = call.run();
    CHECK((status == Status::Ok) == (call.result != nullptr));
    if (status != Status::Ok) {
      const bool known = status == Status::BadOption || status == Status::BadStarts ||
                         status == Status::OutOfMemory || status == Status::TooLarge;
      CHECK(known);
      continue;
    }
    const size_t p = call.polygonStarts.size() - 1;
    const std::vector<uint32_t> triangles = call.array<uint32_t>(SfPolygon_triangles),
                                starts = call.array<uint32_t>(SfPolygon_triangleStarts);
    REQUIRE(starts.size() == p + 1);
    CHECK(3 * starts[p] == triangles.size());
    const size_t n = call.ringStarts.back() + call.points.size() / dimension +
                     call.array<double>(SfPolygon_added).size() / dimension;
    for (const uint32_t v : triangles) CHECK(v < n);
    for (const uint32_t v : call.array<uint32_t>(SfPolygon_strips)) CHECK(v < n);
    CHECK(call.array<uint32_t>(SfPolygon_polygonStrips).size() == p + 1);
    CHECK(call.array<uint32_t>(SfPolygon_addedOn).size() * dimension ==
          2 * call.array<double>(SfPolygon_added).size());
    CHECK(call.array<uint32_t>(SfPolygon_faults).size() * dimension ==
          6 * call.array<double>(SfPolygon_faultPoints).size());
  }
}

TEST_CASE("polygon sessions, C ABI: numbers are given again, and those of none are refused") {
  const Polygon square = polygonOf({{{0, 0}, {4, 0}, {4, 4}, {0, 4}}});
  SfPlace where;
  SfResult* result = nullptr;
  const auto open = [&] {
    REQUIRE(sf_session_open(square.positions.data(), square.starts.data(), 1, nullptr, 0, 1e9,
                            &where, &result) == 0);
    const uint32_t number = *static_cast<const uint32_t*>(sf_result_data(result, SfOpened_session));
    CHECK(sf_result_length(result, SfOpened_triangles) == 6);
    sf_result_free(result);
    return number;
  };
  const auto edit = [&](uint32_t session, uint32_t action, uint32_t vertex, double x, double y) {
    const SfStatus status = sf_session_edit(session, action, vertex, x, y, &where, &result);
    const void* edited = sf_result_data(result, SfEdit_edit);
    const Status found =
        Status(status == 0 ? int32_t(static_cast<const SfEditFacts*>(edited)->status) : status);
    sf_result_free(result);
    return found;
  };
  const uint32_t a = open(), b = open();
  CHECK(a != b);
  CHECK(edit(a, 1, 0, 1, 2) == Status::Ok);
  CHECK(edit(b, 3, 0, 2, 9) == Status::SelfIntersecting);
  CHECK(edit(b, 4, 0, 1, 1) == Status::BadOption);
  CHECK(edit(77, 1, 0, 1, 1) == Status::BadOption);
  // Vertices that the polygon has not; the numbers before 2^32 are those of the box around it.
  for (const uint32_t vertex : {4u, 0xFFFFFFFCu, 0xFFFFFFFEu, 0xFFFFFFFFu})
    for (const uint32_t action : {0u, 2u, 3u})
      CHECK(edit(b, action, vertex, 1, 1) == Status::BadOption);
  CHECK(sf_session_close(a) == 0);
  CHECK(edit(a, 1, 0, 1, 2) == Status::BadOption);
  CHECK(Status(sf_session_read(a, &where, &result)) == Status::BadOption);
  CHECK(open() == a);
  REQUIRE(sf_session_read(b, &where, &result) == 0);
  CHECK(sf_result_length(result, SfState_positions) == 8);
  CHECK(*static_cast<const uint32_t*>(sf_result_data(result, SfState_certified)) == 1);
  sf_result_free(result);
  for (const uint32_t session : {a, b, b, 12345u}) CHECK(sf_session_close(session) == 0);
}
