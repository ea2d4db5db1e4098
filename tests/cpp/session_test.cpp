#include "polygon/session.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "base/predicates.h"
#include "support/polygon_oracle.h"

using namespace sf;
using namespace sftest;

namespace {

using Triangle = std::array<uint32_t, 3>;

/// A polygon as a list of vertices with numbers, edited alongside the session.
struct Model {
  struct Vertex {
    uint32_t number;
    Point at;
  };
  std::vector<std::vector<Vertex>> rings;
  std::vector<Vertex> islands;

  Polygon polygon() const {
    std::vector<Ring> result;
    for (const auto& ring : rings) {
      result.push_back({});
      for (const Vertex& v : ring) result.back().push_back(v.at);
    }
    return polygonOf(result);
  }
  std::vector<uint32_t> numbers() const {
    std::vector<uint32_t> result;
    for (const auto& ring : rings)
      for (const Vertex& v : ring) result.push_back(v.number);
    for (const Vertex& v : islands) result.push_back(v.number);
    return result;
  }
};

/// Whether p lies strictly inside a valid polygon.
bool strictlyInside(const Polygon& polygon, Point p) {
  int winding = 0;
  for (uint32_t r = 0; r < polygon.ringCount(); ++r)
    for (uint32_t v = polygon.starts[r]; v < polygon.starts[r + 1]; ++v) {
      const uint32_t w = v + 1 == polygon.starts[r + 1] ? polygon.starts[r] : v + 1;
      const Point a = polygon.point(v), b = polygon.point(w);
      const int side = orient2d(a.x, a.y, b.x, b.y, p.x, p.y);
      if (side == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) &&
          std::min(a.y, b.y) <= p.y && p.y <= std::max(a.y, b.y))
        return false;
      if ((a.y > p.y) != (b.y > p.y) && (side > 0) == (b.y > a.y)) ++winding;
    }
  return winding % 2 == 1;
}

/// Whether a session has to accept it.
bool acceptable(const Model& model) {
  for (const auto& ring : model.rings)
    if (ring.size() < 3) return false;
  const Polygon polygon = model.polygon();
  if (faultsOf(polygon) != kValid || hasTouches(polygon)) return false;
  for (uint32_t v = 0; v < polygon.vertexCount(); ++v)  // not even repeated neighbours
    for (uint32_t w = 0; w < v; ++w)
      if (polygon.point(v) == polygon.point(w)) return false;
  for (size_t i = 0; i < model.islands.size(); ++i) {
    if (!strictlyInside(polygon, model.islands[i].at)) return false;
    for (size_t j = 0; j < i; ++j)
      if (model.islands[i].at == model.islands[j].at) return false;
  }
  return true;
}

Triangle canonical(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}
std::vector<Triangle> sorted(ArrayView<const uint32_t> corners) {
  std::vector<Triangle> result;
  for (size_t i = 0; i < corners.size(); i += 3)
    result.push_back(canonical({corners[i], corners[i + 1], corners[i + 2]}));
  std::sort(result.begin(), result.end());
  return result;
}

/// The triangles that OpenGL draws of the session's strips; sets how many indices there are.
std::vector<Triangle> drawn(const PolygonSession& session, size_t& indices) {
  std::vector<uint32_t> v, starts;
  Work work;
  REQUIRE(session.strips(work, v, starts));
  indices = v.size();
  std::vector<Triangle> result;
  for (size_t s = 0; s + 1 < starts.size(); ++s)
    for (uint32_t i = starts[s]; i + 2 < starts[s + 1]; ++i) {
      Triangle t = {v[i], v[i + 1], v[i + 2]};
      if ((i - starts[s]) % 2 == 1) std::swap(t[0], t[1]);
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) result.push_back(canonical(t));
    }
  std::sort(result.begin(), result.end());
  return result;
}

/// Everything a session promises, judged from outside.
std::string faultOf(const PolygonSession& session, const Model& model) {
  if (!session.certify()) return "not certified";
  const std::vector<uint32_t> numbers = model.numbers();
  std::vector<uint32_t> place(session.positions().size() / 2, kNone);
  for (uint32_t i = 0; i < numbers.size(); ++i) {
    if (!session.isVertex(numbers[i])) return "a vertex is missing";
    place[numbers[i]] = i;
  }
  for (uint32_t v = 0; v < place.size(); ++v)
    if (session.isVertex(v) != (place[v] != kNone)) return "a vertex too many";
  const Polygon polygon = model.polygon();
  for (uint32_t i = 0; i < numbers.size(); ++i) {
    const Point p =
        i < polygon.vertexCount() ? polygon.point(i) : model.islands[i - polygon.vertexCount()].at;
    const double* q = &session.positions()[2 * size_t(numbers[i])];
    if (!(p == Point{q[0], q[1]})) return "a vertex elsewhere";
  }
  std::vector<uint32_t> triangles;
  for (const uint32_t v : session.triangles()) {
    if (place[v] == kNone) return "a triangle of no vertex";
    triangles.push_back(place[v]);
  }
  if (triangles.size() / 3 !=
      polygon.vertexCount() + 2 * polygon.ringCount() - 4 + 2 * model.islands.size())
    return "a wrong number of triangles";
  if (model.islands.empty()) {
    const std::string fault = faultOfTriangulation(polygon, triangles);
    if (!fault.empty()) return fault;
  }
  size_t indices;
  if (drawn(session, indices) != sorted(session.triangles())) return "strips of other triangles";
  return "";
}

void start(PolygonSession& session, Model& model, const Polygon& polygon,
           const std::vector<Point>& islands) {
  std::vector<double> points;
  for (const Point p : islands) points.insert(points.end(), {p.x, p.y});
  Work work;
  const Outcome outcome = session.start({polygon.positions, polygon.starts, points}, work);
  REQUIRE(outcome.status == Status::Ok);
  CHECK(work.used() == 0);
  model = {};
  for (uint32_t r = 0; r < polygon.ringCount(); ++r) {
    model.rings.push_back({});
    for (uint32_t v = polygon.starts[r]; v < polygon.starts[r + 1]; ++v)
      model.rings.back().push_back({v, polygon.point(v)});
  }
  for (uint32_t i = 0; i < islands.size(); ++i)
    model.islands.push_back({polygon.vertexCount() + i, islands[i]});
}

/// One random edit of both. Adds to `accepted` if the session took it; describes a disagreement.
std::string edit(PolygonSession& session, Model& model, double reach, uint32_t lattice,
                 Random& random, uint32_t& accepted) {
  const auto snapped = [&](Point p) {
    if (lattice == 0) return p;
    return Point{std::round(p.x * lattice) / lattice, std::round(p.y * lattice) / lattice};
  };
  const auto near = [&](Point p) {
    const double far = random.chance(0.1) ? 10 * reach : reach;
    return snapped({p.x + random.range(-far, far), p.y + random.range(-far, far)});
  };
  Model wanted = model;
  Work work;
  Outcome outcome;
  const std::vector<Triangle> before = sorted(session.triangles());
  const uint32_t r = random.below(uint32_t(model.rings.size()));
  auto& ring = wanted.rings[r];
  const uint32_t i = random.below(uint32_t(ring.size()));
  const uint32_t kind = random.below(10);
  uint32_t number = kNone;
  std::vector<Model::Vertex>* grown = nullptr;
  size_t at = 0;
  if (kind < 3) {
    ring[i].at = near(ring[i].at);
    outcome = session.moveVertex(ring[i].number, {ring[i].at.x, ring[i].at.y}, work);
  } else if (kind < 5) {
    // The session's rings may run the other way.
    const uint32_t n = uint32_t(ring.size()), v = ring[i].number, next = session.nextInRing(v);
    const bool along = ring[(i + 1) % n].number == next;
    const Point b = along ? ring[(i + 1) % n].at : ring[(i + n - 1) % n].at;
    const Point middle = {(ring[i].at.x + b.x) / 2, (ring[i].at.y + b.y) / 2};
    const Point p = random.chance(0.3) ? snapped(middle) : near(middle);
    outcome = session.insertVertex(v, {p.x, p.y}, work, number);
    grown = &ring;
    at = along ? i + 1 : i;
    ring.insert(ring.begin() + std::ptrdiff_t(at), {kNone, p});
  } else if (kind < 7) {
    outcome = session.deleteVertex(ring[i].number, work);
    ring.erase(ring.begin() + i);
  } else if (kind < 8 || wanted.islands.empty()) {
    const Point p = near(ring[i].at);
    outcome = session.insertIsland({p.x, p.y}, work, number);
    grown = &wanted.islands;
    at = wanted.islands.size();
    wanted.islands.push_back({kNone, p});
  } else {
    const uint32_t j = random.below(uint32_t(wanted.islands.size()));
    Model::Vertex& island = wanted.islands[j];
    if (kind == 8) {
      island.at = near(island.at);
      outcome = session.moveVertex(island.number, {island.at.x, island.at.y}, work);
    } else {
      outcome = session.deleteVertex(island.number, work);
      wanted.islands.erase(wanted.islands.begin() + j);
    }
  }
  if (outcome.ok() != acceptable(wanted))
    return "kind " + std::to_string(kind) + (outcome.ok() ? ": accepted " : ": refused ") +
           describe(wanted.polygon()) + " before: " + describe(model.polygon());
  if (outcome.ok()) {
    if (grown) (*grown)[at].number = number;
    model = wanted;
    ++accepted;
    // What is not said to have changed has not.
    const std::vector<Triangle> after = sorted(session.triangles());
    std::vector<Triangle> fresh, told;
    std::set_difference(after.begin(), after.end(), before.begin(), before.end(),
                        std::back_inserter(fresh));
    for (const uint32_t t : session.changedTriangles()) {
      if (3 * size_t(t) >= session.triangles().size()) return "a changed triangle that is gone";
      const uint32_t* c = &session.triangles()[3 * size_t(t)];
      told.push_back(canonical({c[0], c[1], c[2]}));
    }
    std::sort(told.begin(), told.end());
    if (!std::includes(told.begin(), told.end(), fresh.begin(), fresh.end()))
      return "a change untold";
  } else if (outcome.status == Status::Ok || outcome.status == Status::BadOption) {
    return "a refusal without a reason";
  }
  if (work.used() != 0) return "memory still charged";
  const std::string fault = faultOf(session, model);
  return fault.empty() ? "" : fault + " " + describe(model.polygon());
}

}  // namespace

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
      start(session, model, polygon, islands);
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
      start(session, model, blob.polygon, blob.inner);
    } else if (sequence % 4 == 1) {
      start(session, model, holeGrid(2, 2, false, random), {});
    } else if (sequence % 4 == 2) {
      start(session, model, polygonOf({partitionRing(20, random)}), {});
    } else {
      start(session, model,
            polygonOf({{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0.25, 0.25}, {0.5, 0.25}, {0.25, 0.5}}}),
            {{0.75, 0.75}, {0.75, 0.5}});
    }
    for (int step = 0; step < 120; ++step) {
      CAPTURE(step);
      const std::string fault = edit(session, model, 0.2, lattice, random, accepted);
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
  start(session, model, blob.polygon, blob.inner);
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
  start(session, model, blob.polygon, blob.inner);
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

TEST_CASE("session: refusals name what is in the way") {
  const Polygon polygon = polygonOf({{{0, 0}, {8, 0}, {8, 8}, {0, 8}},
                                     {{2, 2}, {2, 4}, {4, 4}, {4, 2}},
                                     {{5, 5}, {5, 6}, {6, 6}, {6, 5}}});
  PolygonSession session;
  Model model;
  start(session, model, polygon, {{7, 7}});
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
  start(session, model, polygon, {});
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
  start(session, model, polygonOf({starRing(50, 0.5, random)}), {});
  Work small(100, nullptr, nullptr);
  CHECK(session.moveVertex(0, {0.1, 0.1}, small).status == Status::OutOfMemory);
  CHECK(faultOf(session, model) == "");
  PolygonSession other;
  Work little(100, nullptr, nullptr);
  const Polygon polygon = model.polygon();
  CHECK(other.start({polygon.positions, polygon.starts, {}}, little).status == Status::OutOfMemory);
  CHECK(other.triangles().size() == 0);
}
