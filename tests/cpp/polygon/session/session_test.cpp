#include "polygon/session/session.h"

#include <doctest/doctest.h>

#include <limits>

#include "support/session_model.h"

using namespace sf;
using namespace sftest;

TEST_CASE("session: a start has the triangles of a polygon, whatever kind it is of") {
  constexpr uint32_t kSeed = 5000;
  CAPTURE(kSeed);
  Random random(kSeed);
  int valid = 0, refused = 0;
  for (int instance = 0; instance < 600; ++instance) {
    CAPTURE(instance);
    Polygon polygon;
    std::vector<Point> islands;
    switch (instance % 4) {
      case 0:
        polygon = smallPolygon(random);
        break;
      case 1:
        polygon = holeGrid(1 + random.below(3), 1 + random.below(3), instance % 8 == 1, random);
        break;
      case 2:
        polygon =
            garbage(1 + random.below(3), 3 + random.below(4), instance % 8 == 2 ? 6 : 0, random);
        break;
      default: {
        const GriddedBlob blob = blobWithGrid(5 + random.below(40), 2 + random.below(7), random);
        polygon = blob.polygon, islands = blob.inner;
      }
    }
    Model model;
    for (const Ring& ring : ringsOf(polygon)) {
      model.rings.push_back({});
      for (const Point p : ring) model.rings.back().push_back({0, p});
    }
    for (const Point p : islands) model.islands.push_back({0, p});
    PolygonSession session;
    if (acceptable(model)) {
      ++valid;
      REQUIRE(startBoth(session, model, polygon, islands));
      CHECK(faultOf(session, model) == "");
    } else {
      ++refused;
      Work work;
      const Outcome outcome = session.start({polygon.positions, polygon.starts, {}}, work);
      CHECK(!outcome.ok());
      CHECK(session.triangles().size() == 0);
    }
  }
  CHECK(valid > 300);
  CHECK(refused > 100);
}

TEST_CASE(
    "session: any sequence of edits leaves a certified polygon, and refuses what is not one") {
  constexpr uint32_t kSeed = 5001;
  CAPTURE(kSeed);
  uint32_t accepted = 0, edits = 0;
  for (uint32_t sequence = 0; sequence < 40; ++sequence) {
    CAPTURE(sequence);
    Random random(kSeed + sequence);
    PolygonSession session;
    Model model;
    const uint32_t lattice = sequence % 4 == 3 ? 8 : 0;
    if (sequence % 4 == 0) {
      const GriddedBlob blob = blobWithGrid(12 + random.below(20), 4, random);
      REQUIRE(startBoth(session, model, blob.polygon, blob.inner));
    } else if (sequence % 4 == 1) {
      REQUIRE(startBoth(session, model, holeGrid(2, 2, false, random), {}));
    } else if (sequence % 4 == 2) {
      REQUIRE(startBoth(session, model, polygonOf({partitionRing(20, random)}), {}));
    } else {
      REQUIRE(startBoth(
          session, model,
          polygonOf({{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0.25, 0.25}, {0.5, 0.25}, {0.25, 0.5}}}),
          {{0.75, 0.75}, {0.75, 0.5}}));
    }
    for (int step = 0; step < 120; ++step) {
      CAPTURE(step);
      const std::string fault = editBoth(session, model, 0.2, lattice, random, accepted);
      REQUIRE(fault == "");
      ++edits;
    }
  }
  MESSAGE(accepted, " of ", edits, " edits accepted");
  CHECK(accepted > edits / 4);
  CHECK(accepted < edits * 9 / 10);
}

TEST_CASE("session: small moves in a large polygon change few triangles") {
  constexpr uint32_t kSeed = 5002;
  Random random(kSeed);
  const GriddedBlob blob = blobWithGrid(100, 40, random);
  PolygonSession session;
  Model model;
  REQUIRE(startBoth(session, model, blob.polygon, blob.inner));
  size_t changed = 0;
  for (int step = 0; step < 200; ++step) {
    const uint32_t v = random.below(uint32_t(session.positions().size() / 2));
    const double* p = &session.positions()[2 * size_t(v)];
    Work work;
    session.moveVertex(v, {p[0] + random.range(-0.02, 0.02), p[1] + random.range(-0.02, 0.02)},
                       work);
    changed += session.changedTriangles().size();
  }
  CHECK(session.certify());
  CHECK(changed < 200 * 12);
}

TEST_CASE("session: strips stay long over many edits") {
  constexpr uint32_t kSeed = 5003;
  Random random(kSeed);
  const GriddedBlob blob = blobWithGrid(100, 30, random);
  PolygonSession session;
  Model model;
  REQUIRE(startBoth(session, model, blob.polygon, blob.inner));
  const uint32_t n = uint32_t(session.positions().size() / 2);
  for (int step = 0; step < 5000; ++step) {
    const uint32_t v = random.below(n);
    const double* p = &session.positions()[2 * size_t(v)];
    Work work;
    session.moveVertex(v, {p[0] + random.range(-0.05, 0.05), p[1] + random.range(-0.05, 0.05)},
                       work);
  }
  REQUIRE(session.certify());
  size_t indices;
  CHECK(drawn(session, indices) == sorted(session.triangles()));
  CHECK(double(indices) < 1.6 * double(session.triangles().size() / 3));
}

TEST_CASE("session: a start says which ring or vertex is wrong") {
  const Ring square = {{0, 0}, {9, 0}, {9, 9}, {0, 9}}, hole = {{1, 1}, {1, 6}, {6, 6}, {6, 1}};
  const Ring inner = {{2, 2}, {2, 3}, {3, 3}}, away = {{20, 2}, {20, 3}, {21, 3}};
  const auto outcomeOf = [](const std::vector<Ring>& rings, const std::vector<double>& points) {
    const Polygon polygon = polygonOf(rings);
    PolygonSession session;
    Work work;
    return session.start({polygon.positions, polygon.starts, points}, work);
  };
  CHECK(outcomeOf({square, hole}, {8, 8}).ok());
  Outcome o = outcomeOf({square, hole, inner}, {});
  CHECK(o.status == Status::NestedHole);
  CHECK(o.loop == 2);
  CHECK(o.otherLoop == 1);
  o = outcomeOf({square, hole, away}, {});
  CHECK(o.status == Status::HoleOutside);
  CHECK(o.loop == 2);
  o = outcomeOf({hole, square}, {});  // a hole around everything
  CHECK(o.status == Status::HoleOutside);
  CHECK(o.loop == 1);
  o = outcomeOf({square, hole}, {8, 8, 5, 5});  // the second island in the hole
  CHECK(o.status == Status::HoleOutside);
  CHECK(o.loop == 3);
  CHECK(o.vertex == 0);
  o = outcomeOf({{{0, 0}, {2, 2}, {2, 0}, {0, 2}}}, {});
  CHECK(o.status == Status::SelfIntersecting);
  CHECK(o.loop == 0);
  CHECK(o.otherLoop == 0);
  o = outcomeOf({square, {{1, 1}, {2, 1}, {2, 2}, {1, 1}}, {{4, 4}, {5, 5}}}, {});
  CHECK(o.status == Status::DegeneratePolygon);
  CHECK(o.loop == 2);
}

TEST_CASE(
    "session: numbers of no vertex are refused by every edit, those of the box's corners too") {
  const Polygon polygon = polygonOf({{{0, 0}, {8, 0}, {8, 8}, {0, 8}}});
  PolygonSession session;
  Model model;
  REQUIRE(startBoth(session, model, polygon, {{7, 7}}));
  Work work;
  const std::vector<uint32_t> triangles(session.triangles().begin(), session.triangles().end());
  std::vector<uint32_t> numbers = {5, 6, 77, 1u << 31};
  for (uint32_t i = 1; i <= 8; ++i) numbers.push_back(0u - i);  // kNone, and what comes before it
  for (const uint32_t v : numbers) {
    CAPTURE(v);
    uint32_t inserted = 0;
    CHECK(session.moveVertex(v, {1, 1}, work).status == Status::BadOption);
    CHECK(session.deleteVertex(v, work).status == Status::BadOption);
    CHECK(session.insertVertex(v, {1, 1}, work, inserted).status == Status::BadOption);
    CHECK(!session.isVertex(v));
    CHECK(session.certify());
  }
  uint32_t inserted = 0;
  // Vertex 4 is an island, which no ring goes on from.
  CHECK(session.insertVertex(4, {1, 1}, work, inserted).status == Status::BadOption);
  CHECK(triangles == std::vector<uint32_t>(session.triangles().begin(), session.triangles().end()));
  CHECK(faultOf(session, model) == "");
}

TEST_CASE("session: refusals name what is in the way") {
  const Polygon polygon = polygonOf({{{0, 0}, {8, 0}, {8, 8}, {0, 8}},
                                     {{2, 2}, {2, 4}, {4, 4}, {4, 2}},
                                     {{5, 5}, {5, 6}, {6, 6}, {6, 5}}});
  PolygonSession session;
  Model model;
  REQUIRE(startBoth(session, model, polygon, {{7, 7}}));
  Work work;
  Outcome o = session.moveVertex(0, {8, 0}, work);
  CHECK(o.status == Status::RepeatedVertex);
  CHECK(o.vertex == 0);
  CHECK(o.otherVertex == 1);
  o = session.moveVertex(6, {5.5, 5.5}, work);  // a corner of one hole into the other
  CHECK(o.status == Status::HolesOverlap);
  CHECK(o.vertex == 6);
  CHECK(o.otherLoop == 2);
  o = session.moveVertex(2, {1, 1}, work);  // the outer ring over both holes and the island
  CHECK(o.status == Status::HoleOutside);
  o = session.moveVertex(12, {3, 3}, work);  // the island into a hole
  CHECK(o.status == Status::HoleOutside);
  CHECK(o.vertex == 12);
  o = session.moveVertex(12, {100, 3}, work);
  CHECK(o.status == Status::HoleOutside);
  o = session.moveVertex(0, {std::numeric_limits<double>::quiet_NaN(), 0}, work);
  CHECK(o.status == Status::NotFinite);
  o = session.moveVertex(13, {1, 1}, work);
  CHECK(o.status == Status::BadOption);
  o = session.moveVertex(1, {-8, 7}, work);  // its edge would cross another of its ring
  CHECK(o.status == Status::SelfIntersecting);
  CHECK(faultOf(session, model) == "");
  o = session.deleteVertex(4, work);
  CHECK(o.ok());
  o = session.deleteVertex(5, work);
  CHECK(o.status == Status::DegeneratePolygon);
}

TEST_CASE("session: a ring may turn inside out, and a vertex may leave the first box by far") {
  const Polygon polygon = polygonOf({{{0, 0}, {4, 0}, {3, 1}, {1, 1}}});
  PolygonSession session;
  Model model;
  REQUIRE(startBoth(session, model, polygon, {}));
  Work work;
  uint32_t v;
  // An edge pulled over the rest of the ring: what was inside is outside now.
  REQUIRE(session.insertVertex(0, {2, 10}, work, v).ok());
  model.rings[0].insert(model.rings[0].begin() + 1, {v, {2, 10}});
  CHECK(faultOf(session, model) == "");
  for (const double far : {1e3, 1e80, 1e150, -1e150}) {
    CAPTURE(far);
    const Outcome o = session.moveVertex(v, {2, far}, work);
    model.rings[0][1].at = {2, far};
    CHECK(o.ok() == acceptable(model));
    if (!o.ok()) model.rings[0][1].at = {2, 1e150};
    CHECK(faultOf(session, model) == "");
  }
  const Outcome o = session.moveVertex(v, {2, -1e300}, work);
  CHECK(o.status == Status::NotFinite);
  CHECK(faultOf(session, model) == "");
}

TEST_CASE("session: a memory limit refuses edits and leaves the polygon") {
  PolygonSession session;
  Model model;
  Random random(5004);
  REQUIRE(startBoth(session, model, polygonOf({starRing(50, 0.5, random)}), {}));
  Work small(100, nullptr, nullptr);
  CHECK(session.moveVertex(0, {0.1, 0.1}, small).status == Status::OutOfMemory);
  CHECK(faultOf(session, model) == "");
  PolygonSession other;
  Work little(100, nullptr, nullptr);
  const Polygon polygon = model.polygon();
  CHECK(other.start({polygon.positions, polygon.starts, {}}, little).status == Status::OutOfMemory);
  CHECK(other.triangles().size() == 0);
}
