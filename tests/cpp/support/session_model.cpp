#include "support/session_model.h"

#include <algorithm>
#include <cmath>

#include "base/predicates.h"

namespace sftest {

using namespace sf;

Polygon Model::polygon() const {
  std::vector<Ring> result;
  for (const auto& ring : rings) {
    result.push_back({});
    for (const Vertex& v : ring) result.back().push_back(v.at);
  }
  return polygonOf(result);
}

std::vector<uint32_t> Model::numbers() const {
  std::vector<uint32_t> result;
  for (const auto& ring : rings)
    for (const Vertex& v : ring) result.push_back(v.number);
  for (const Vertex& v : islands) result.push_back(v.number);
  return result;
}

namespace {

// Whether p lies strictly inside a valid polygon.
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

Triangle canonical(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

}  // namespace

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

std::vector<Triangle> sorted(ArrayView<const uint32_t> corners) {
  std::vector<Triangle> result;
  for (size_t i = 0; i < corners.size(); i += 3)
    result.push_back(canonical({corners[i], corners[i + 1], corners[i + 2]}));
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<Triangle> drawn(const PolygonSession& session, size_t& indices) {
  std::vector<uint32_t> v, starts;
  Work work;
  session.strips(work, v, starts);
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

bool startBoth(PolygonSession& session, Model& model, const Polygon& polygon,
               const std::vector<Point>& islands) {
  std::vector<double> points;
  for (const Point p : islands) points.insert(points.end(), {p.x, p.y});
  Work work;
  const Outcome outcome = session.start({polygon.positions, polygon.starts, points}, work);
  if (!outcome.ok() || work.used() != 0) return false;
  model = {};
  for (uint32_t r = 0; r < polygon.ringCount(); ++r) {
    model.rings.push_back({});
    for (uint32_t v = polygon.starts[r]; v < polygon.starts[r + 1]; ++v)
      model.rings.back().push_back({v, polygon.point(v)});
  }
  for (uint32_t i = 0; i < islands.size(); ++i)
    model.islands.push_back({polygon.vertexCount() + i, islands[i]});
  return true;
}

std::string editBoth(PolygonSession& session, Model& model, double reach, uint32_t lattice,
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

}  // namespace sftest
