// Fuzzes sequences of edits of a session: it stays certified, with triangles and strips of a polygon
// that flooding accepts as well, and a refused edit leaves the polygon as it was.
#include "polygon/session/session.h"
#include "fuzz/polygon_input.h"

using namespace sffuzz;

namespace {

/// The session's polygon, its rings by their first vertices in numbers of vertices.
struct Rings {
  std::vector<std::vector<uint32_t>> rings;
  std::vector<double> positions;
  std::vector<uint32_t> islands;

  bool operator==(const Rings& o) const {
    return rings == o.rings && islands == o.islands && positions == o.positions;
  }
};

Rings ringsOf(const sf::PolygonSession& session) {
  Rings result;
  const uint32_t n = uint32_t(session.positions().size() / 2);
  std::vector<bool> seen(n, false);
  for (uint32_t v = 0; v < n; ++v) {
    if (!session.isVertex(v) || seen[v]) continue;
    if (session.nextInRing(v) == sf::kNone) {
      result.islands.push_back(v);
      continue;
    }
    result.rings.push_back({});
    for (uint32_t u = v; !seen[u]; u = session.nextInRing(u)) {
      seen[u] = true;
      result.rings.back().push_back(u);
    }
  }
  const auto add = [&](uint32_t v) {
    result.positions.push_back(session.positions()[2 * v]);
    result.positions.push_back(session.positions()[2 * v + 1]);
  };
  for (const std::vector<uint32_t>& ring : result.rings)
    for (const uint32_t v : ring) add(v);
  for (const uint32_t v : result.islands) add(v);
  return result;
}

double twiceArea(const Rings& all, size_t ring, size_t first) {
  double sum = 0;
  const size_t n = all.rings[ring].size();
  const double* xy = &all.positions[2 * first];
  for (size_t i = 0, j = n - 1; i < n; j = i++)
    sum += xy[2 * j] * xy[2 * i + 1] - xy[2 * i] * xy[2 * j + 1];
  return sum;
}

/// What flooding makes of it has to be as many triangles. The outer ring is the one that runs
/// counter-clockwise; where rounding hides which that is, there is nothing to compare.
void compareWithFlooding(const sf::PolygonSession& session, const Rings& all) {
  size_t outer = all.rings.size(), first = 0, count = 0, outerFirst = 0;
  for (size_t r = 0; r < all.rings.size(); first += all.rings[r++].size())
    if (twiceArea(all, r, first) > 0) outer = r, outerFirst = first, ++count;
  if (count != 1) return;
  PolygonInput polygon;
  polygon.starts = {0};
  const auto add = [&](size_t r, size_t from) {
    const size_t n = all.rings[r].size();
    polygon.positions.insert(polygon.positions.end(), &all.positions[2 * from],
                             &all.positions[2 * from] + 2 * n);
    polygon.starts.push_back(polygon.starts.back() + uint32_t(n));
  };
  add(outer, outerFirst);
  first = 0;
  for (size_t r = 0; r < all.rings.size(); first += all.rings[r++].size())
    if (r != outer) add(r, first);
  polygon.points.assign(all.positions.begin() + ptrdiff_t(2 * first), all.positions.end());
  sf::PolygonTriangulation result;
  sf::Work work;
  const sf::Outcome outcome = sf::triangulatePolygon(polygon.view(), {}, work, result);
  require(outcome.ok(), "flooding accepts what a session accepts");
  require(result.triangles.size() == session.triangles().size(), "as many triangles as flooding");
}

void check(const sf::PolygonSession& session, const Rings& rings) {
  require(session.certify(), "a session stays certified");
  checkTriangles(session.triangles(), session.positions().size() / 2);
  std::vector<uint32_t> strips, starts;
  sf::Work work;
  require(session.strips(work, strips, starts), "strips");
  checkStrips(strips, starts, session.triangles());
  compareWithFlooding(session, rings);
}

}  // namespace

extern "C" int32_t sf_host_progress(double, double, double) { return 1; }

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  Bytes in(data, size);
  PolygonInput polygon = readPolygon(in);
  sf::PolygonSession session;
  sf::Work work;
  const sf::Outcome started = session.start(polygon.view(), work);
  if (!started.ok()) {
    if (started.status != sf::Status::BadStarts) checkPlace(started, polygon.view());
    // Otherwise any polygon that is refused would be as good as any other.
    polygon.positions = {0, 0, 8, 0, 8, 8, 0, 8, 2, 2, 2, 5, 5, 2};
    polygon.starts = {0, 4, 7};
    polygon.points = {6, 6};
    require(session.start(polygon.view(), work).ok(), "a square with a hole is valid");
  }
  Rings before = ringsOf(session);
  check(session, before);
  for (int edits = 0; edits < 40 && in.any(); ++edits) {
    const uint32_t action = in.below(8), numbers = uint32_t(session.positions().size() / 2) + 1;
    const uint32_t v = in.below(numbers);
    const sf::Point2 p = action < 2 ? sf::Point2{0, 0} : sf::Point2{coordinate(in), coordinate(in)};
    uint32_t given = 0;
    sf::Outcome outcome;
    if (action < 2)
      outcome = session.deleteVertex(v, work);
    else if (action < 4)
      outcome = session.insertVertex(v, p, work, given);
    else if (action < 5)
      outcome = session.insertIsland(p, work, given);
    else
      outcome = session.moveVertex(v, p, work);
    require(work.used() == 0, "memory charged is given back");
    const Rings after = ringsOf(session);
    if (!outcome.ok()) require(after == before, "a refused edit leaves the polygon as it was");
    check(session, after);
    before = after;
  }
  return 0;
}
