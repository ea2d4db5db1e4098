#include "polygon/session/session.h"

#include <algorithm>
#include <cmath>

#include "base/charge.h"
#include "base/turn.h"

namespace sf {

void PolygonSession::clear() {
  mesh_ = {};
  ring_.clear(), ringSizes_.clear(), unused_.clear(), inside_.clear(), slots_.clear();
  triangleIn_.clear(), triangles_.clear(), changedSlots_.clear();
}

/// What is wrong, with the vertices concerned.
Outcome PolygonSession::about(Status status, uint32_t v, uint32_t w) const {
  Outcome outcome;
  outcome.status = status;
  const auto name = [&](uint32_t u, uint32_t& loop, uint32_t& vertex) {
    if (u == kNone) return;
    vertex = u - kShift;
    if (ring_[u] != kIsland) loop = ring_[u];
  };
  name(v, outcome.loop, outcome.vertex);
  name(w, outcome.otherLoop, outcome.otherVertex);
  return outcome;
}

Outcome PolygonSession::refusal(uint32_t edited, const Obstacle& obstacle) const {
  const uint32_t other = obstacle.vertex != kNone ? obstacle.vertex : obstacle.edge;
  if (obstacle.vertex != kNone && mesh_.at[edited] == mesh_.at[other])
    return about(Status::RepeatedVertex, edited, other);
  const uint32_t r = ring_[edited], q = ring_[other];
  Status status = Status::HolesOverlap;
  if (r == kIsland || q == kIsland || (r != q && (r == 0 || q == 0)))
    status = Status::HoleOutside;
  else if (r == q)
    status = Status::SelfIntersecting;
  return about(status, edited, other);
}

bool PolygonSession::withinBox(Point2 p) const {
  return std::fabs(p.x) < side_ && std::fabs(p.y) < side_;
}

/// Whether an edit of vertex v may begin: v is a vertex, and `admit` allows it. Here kNone is a
/// number like any other: if it stood for "no vertex", callers could edit corners of the box.
Outcome PolygonSession::admitVertex(uint32_t v, Point2 p, Work& work) const {
  if (!isVertex(v)) return Outcome{Status::BadOption};
  return admit(v + kShift, p, work);
}

/// Whether an edit may begin: p is a position, and the memory in use is within the limit. If not,
/// the culprit is v, a number of the mesh or kNone.
Outcome PolygonSession::admit(uint32_t v, Point2 p, Work& work) const {
  if (!isAccepted(p)) return about(Status::NotFinite, v, kNone);
  Charge charge(work);
  if (!charge.add(300 * uint64_t(mesh_.at.size()))) return Outcome{work.status()};
  return {};
}

uint32_t PolygonSession::numberFor(uint32_t ring) {
  uint32_t v = uint32_t(ring_.size());
  if (unused_.empty())
    ring_.push_back(ring);
  else
    v = unused_.back(), unused_.pop_back();
  ring_[v] = ring;
  return v;
}

void PolygonSession::giveUp(uint32_t v) {
  ring_[v] = kNone;
  unused_.push_back(v);
}

/// Makes v a vertex at p, between a and b unless these are kNone. If that fails,
/// everything is as before.
bool PolygonSession::place(uint32_t v, Point2 p, uint32_t a, uint32_t b, Obstacle& obstacle) {
  mesh_.setPosition(v, p);
  if (a != kNone) near_ = a;
  if (!mesh_.insertPoint(v, near_, obstacle)) return false;
  if (a == kNone) near_ = v;
  if (a == kNone) return true;
  bool done = mesh_.insertEdge(a, v, obstacle);
  if (done) {
    link(a, v);
    done = mesh_.insertEdge(v, b, obstacle);
    if (done)
      link(v, b);
    else
      unlink(a, v);
  }
  if (!done) mesh_.removePoint(v);
  return done;
}

void PolygonSession::takeOut(uint32_t v) {
  if (mesh_.next[v] != kNone) {
    unlink(mesh_.prev[v], v);
    unlink(v, mesh_.next[v]);
  }
  near_ = mesh_.mesh.to(mesh_.mesh.edgeFrom[v]);
  mesh_.removePoint(v);
}

/// For an edit that leaves the box: v, already linked to its ring, goes to p, and all is built
/// anew.
Outcome PolygonSession::rebuildWith(uint32_t v, Point2 p, Work& work) {
  mesh_.setPosition(v, p);
  const Outcome outcome = build(work);
  if (outcome.ok()) {
    changedSlots_.resize(triangles_.size() / 3);
    for (uint32_t s = 0; s < changedSlots_.size(); ++s) changedSlots_[s] = s;
  }
  return outcome;
}

/// Builds anew what was valid before.
void PolygonSession::restore() {
  Work unlimited;
  const Outcome outcome = build(unlimited);
  SF_ASSERT(outcome.ok());
  (void)outcome;
}

Outcome PolygonSession::insertVertex(uint32_t before, Point2 p, Work& work, uint32_t& v) {
  Outcome outcome = admitVertex(before, p, work);
  if (!outcome.ok()) return outcome;
  const uint32_t a = before + kShift, b = mesh_.next[a];
  if (b == kNone) return Outcome{Status::BadOption};
  const uint32_t u = numberFor(ring_[a]);
  const uint32_t size = ++ringSizes_[ring_[a]];
  SF_ASSERT(size > 3);
  (void)size;
  unlink(a, b);
  if (!withinBox(p)) {
    std::vector<uint32_t> next = mesh_.next, prev = mesh_.prev;
    mesh_.setPosition(u, p);
    link(a, u), link(u, b);
    outcome = rebuildWith(u, p, work);
    if (!outcome.ok()) {
      mesh_.next = next, mesh_.prev = prev;
      mesh_.next.resize(mesh_.at.size(), kNone), mesh_.prev.resize(mesh_.at.size(), kNone);
      link(a, b);
      --ringSizes_[ring_[a]];
      giveUp(u);
      restore();
    }
    v = u - kShift;
    return outcome;
  }
  Obstacle obstacle;
  mesh_.forgetChanges();
  bool placed = place(u, p, a, b, obstacle);
  outcome = placed ? finish(a) : refusal(a, obstacle);
  if (obstacle.vertex != kNone && mesh_.at[u] == mesh_.at[obstacle.vertex])
    outcome.status = Status::RepeatedVertex;
  if (!outcome.ok()) {
    if (placed) takeOut(u);
    const bool restored = mesh_.insertEdge(a, b, obstacle);
    SF_ASSERT(restored);
    (void)restored;
    link(a, b);
    --ringSizes_[ring_[a]];
    giveUp(u);
    finish(a);
  }
  v = u - kShift;
  return outcome;
}

Outcome PolygonSession::insertIsland(Point2 p, Work& work, uint32_t& v) {
  Outcome outcome = admit(kNone, p, work);
  if (!outcome.ok()) return outcome;
  if (!withinBox(p) || ringSizes_.empty()) return Outcome{Status::HoleOutside};
  const uint32_t u = numberFor(kIsland);
  Obstacle obstacle;
  mesh_.forgetChanges();
  const bool placed = place(u, p, kNone, kNone, obstacle);
  outcome = placed ? finish(u) : refusal(u, obstacle);
  outcome.vertex = kNone;
  if (!outcome.ok()) {
    if (placed) takeOut(u);
    giveUp(u);
    finish(u);
  }
  v = u - kShift;
  return outcome;
}

Outcome PolygonSession::deleteVertex(uint32_t vertex, Work& work) {
  Outcome outcome = admitVertex(vertex, {0, 0}, work);
  if (!outcome.ok()) return outcome;
  const uint32_t v = vertex + kShift, a = mesh_.prev[v], b = mesh_.next[v];
  const bool island = ring_[v] == kIsland;
  if (!island && ringSizes_[ring_[v]] <= 3) return about(Status::DegeneratePolygon, v, kNone);
  Obstacle obstacle;
  mesh_.forgetChanges();
  const Point2 p = mesh_.at[v];
  takeOut(v);
  const bool joined = island || mesh_.insertEdge(a, b, obstacle);
  if (joined && !island) link(a, b);
  outcome = joined ? finish(v) : refusal(v, obstacle);
  if (outcome.ok()) {
    if (!island) --ringSizes_[ring_[v]];
    giveUp(v);
    return outcome;
  }
  if (joined && !island) unlink(a, b);
  const bool restored = place(v, p, a, b, obstacle);
  SF_ASSERT(restored);
  (void)restored;
  finish(v);
  return outcome;
}

Outcome PolygonSession::moveVertex(uint32_t vertex, Point2 p, Work& work) {
  Outcome outcome = admitVertex(vertex, p, work);
  if (!outcome.ok()) return outcome;
  const uint32_t v = vertex + kShift, a = mesh_.prev[v], b = mesh_.next[v];
  const Point2 old = mesh_.at[v];
  mesh_.forgetChanges();
  if (mesh_.shiftPoint(v, p)) return finish(v);
  if (!withinBox(p)) {
    if (ring_[v] == kIsland) return about(Status::HoleOutside, v, kNone);
    const std::vector<uint32_t> next = mesh_.next, prev = mesh_.prev;
    outcome = rebuildWith(v, p, work);
    if (!outcome.ok()) {
      mesh_.next = next, mesh_.prev = prev;
      mesh_.setPosition(v, old);
      restore();
    }
    return outcome;
  }
  Obstacle obstacle;
  takeOut(v);
  const bool placed = place(v, p, a, b, obstacle);
  outcome = placed ? finish(v) : refusal(v, obstacle);
  if (outcome.ok()) return outcome;
  if (placed) takeOut(v);
  const bool restored = place(v, old, a, b, obstacle);
  SF_ASSERT(restored);
  (void)restored;
  finish(v);
  return outcome;
}

ArrayView<const double> PolygonSession::positions() const {
  if (mesh_.at.size() <= kShift) return {};
  return {&mesh_.at[kShift].x, 2 * (mesh_.at.size() - kShift)};
}

bool PolygonSession::isVertex(uint32_t v) const {
  return v < ring_.size() && v + kShift < ring_.size() && ring_[v + kShift] != kNone;
}

uint32_t PolygonSession::nextInRing(uint32_t v) const {
  const uint32_t next = mesh_.next[v + kShift];
  return next == kNone ? kNone : next - kShift;
}

}  // namespace sf
