// sf_session_*: polygons that stay in the core while they are edited.
#include <memory>
#include <vector>

#include "abi/host_work.h"
#include "abi/result.h"
#include "polygon/session/session.h"

namespace {

struct OpenSession {
  sf::PolygonSession session;
  double maxBytes;
};

/// By number; null where a session has been closed.
std::vector<std::unique_ptr<OpenSession>>& openSessions() {
  static std::vector<std::unique_ptr<OpenSession>> all;
  return all;
}

OpenSession* find(uint32_t number) {
  auto& all = openSessions();
  return number < all.size() ? all[number].get() : nullptr;
}

uint32_t keep(std::unique_ptr<OpenSession> session) {
  auto& all = openSessions();
  for (uint32_t i = 0; i < all.size(); ++i)
    if (!all[i]) return all[i] = std::move(session), i;
  all.push_back(std::move(session));
  return uint32_t(all.size()) - 1;
}

template <class T>
std::vector<T> copyOf(sf::ArrayView<const T> view) {
  return {view.begin(), view.end()};
}

SfStatus end(const sf::Outcome& outcome, uint32_t* where) {
  sf::tellWhere(outcome, where);
  return SfStatus(outcome.status);
}

}  // namespace

extern "C" {

SfStatus sf_session_open(const double* positions, const uint32_t* ringStarts, uint32_t ringCount,
                         const double* points, uint32_t pointCount, double maxBytes,
                         uint32_t* where, SfResult** result) {
  *result = nullptr;
  if (!(maxBytes >= 0)) return end({sf::Status::BadOption}, where);
  if (ringCount == 0 || !sf::isRising(ringStarts, ringCount))
    return end({sf::Status::BadStarts}, where);
  const size_t n = ringStarts[ringCount];
  if (n + pointCount >= 1u << 29) return end({sf::Status::TooLarge}, where);
  const sf::PolygonView polygon{
      {positions, 2 * n}, {ringStarts, size_t(ringCount) + 1}, {points, 2 * size_t(pointCount)}};
  auto opened = std::make_unique<OpenSession>();
  opened->maxBytes = maxBytes;
  sf::Work work = sf::hostWork(maxBytes);
  const sf::Outcome outcome = opened->session.start(polygon, work);
  if (outcome.ok()) {
    std::vector<uint32_t> triangles = copyOf(opened->session.triangles());
    *result = new SfResult;
    (*result)->add(std::vector<uint32_t>{keep(std::move(opened))});
    (*result)->add(std::move(triangles));
  }
  return end(outcome, where);
}

SfStatus sf_session_edit(uint32_t session, uint32_t action, uint32_t vertex, double x, double y,
                         uint32_t* where, SfResult** result) {
  *result = nullptr;
  OpenSession* opened = find(session);
  if (!opened || action > 3) return end({sf::Status::BadOption}, where);
  sf::PolygonSession& edited = opened->session;
  sf::Work work = sf::hostWork(opened->maxBytes);
  sf::Outcome outcome;
  switch (action) {
    case 0:
      outcome = edited.insertVertex(vertex, {x, y}, work, vertex);
      break;
    case 1:
      outcome = edited.insertIsland({x, y}, work, vertex);
      break;
    case 2:
      outcome = edited.deleteVertex(vertex, work);
      break;
    default:
      outcome = edited.moveVertex(vertex, {x, y}, work);
  }
  // All in one array: an edit takes less than to hand over many.
  const sf::ArrayView<const uint32_t> triangles = edited.triangles();
  const uint32_t count = uint32_t(triangles.size() / 3);
  std::vector<uint32_t> told = {vertex,
                                count,
                                uint32_t(outcome.status),
                                outcome.loop,
                                outcome.vertex,
                                outcome.otherLoop,
                                outcome.otherVertex};
  const sf::ArrayView<const uint32_t> changed = edited.changedTriangles();
  told.reserve(told.size() + 4 * changed.size());
  for (const uint32_t t : changed)
    if (t < count) told.push_back(t);
  for (const uint32_t t : changed)
    if (t < count)
      told.insert(told.end(), &triangles[3 * size_t(t)], &triangles[3 * size_t(t)] + 3);
  *result = new SfResult;
  (*result)->add(std::move(told));
  return end({}, where);
}

SfStatus sf_session_read(uint32_t session, uint32_t* where, SfResult** result) {
  *result = nullptr;
  const OpenSession* opened = find(session);
  if (!opened) return end({sf::Status::BadOption}, where);
  sf::Work work = sf::hostWork(opened->maxBytes);
  std::vector<uint32_t> strips, starts, next;
  if (!opened->session.strips(work, strips, starts)) return end({work.status()}, where);
  const uint32_t n = uint32_t(opened->session.positions().size() / 2);
  for (uint32_t v = 0; v < n; ++v)
    next.push_back(opened->session.isVertex(v) ? opened->session.nextInRing(v) : v);
  *result = new SfResult;
  (*result)->add(copyOf(opened->session.positions()));
  (*result)->add(std::move(next));
  (*result)->add(std::move(strips));
  (*result)->add(std::move(starts));
  (*result)->add(std::vector<uint32_t>{opened->session.certify()});
  return end({}, where);
}

SfStatus sf_session_close(uint32_t session) {
  if (find(session)) openSessions()[session] = nullptr;
  return SfStatus(sf::Status::Ok);
}

}  // extern "C"
