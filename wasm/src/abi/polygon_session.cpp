// sf_session_*: polygons that stay in the core while they are edited.
#include <cstring>
#include <vector>

#include "abi/host_work.h"
#include "abi/kept.h"
#include "abi/result.h"
#include "polygon/session/session.h"

namespace {

struct OpenSession {
  sf::PolygonSession session;
  double maxBytes;
};

sf::Kept<OpenSession>& sessions() {
  static sf::Kept<OpenSession> all;
  return all;
}

template <class T>
std::vector<T> copyOf(sf::ArrayView<const T> view) {
  return {view.begin(), view.end()};
}

enum class EditAction : uint32_t {
#define SF_ACTION(name, value, meaning) name = (value),
  SF_EDIT_ACTION_CHOICES(SF_ACTION)
#undef SF_ACTION
};

}  // namespace

extern "C" {

SfStatus sf_session_open(const double* positions, const uint32_t* ringStarts, uint32_t ringCount,
                         const double* points, uint32_t pointCount, double maxBytes, SfPlace* where,
                         SfResult** result) {
  *result = nullptr;
  if (!(maxBytes >= 0)) return sf::endWith({sf::Status::BadOption}, where);
  if (ringCount == 0 || !sf::isRising(ringStarts, ringCount))
    return sf::endWith({sf::Status::BadStarts}, where);
  const size_t n = ringStarts[ringCount];
  if (uint64_t(n) + pointCount >= 1u << 29) return sf::endWith({sf::Status::TooLarge}, where);
  const sf::PolygonView polygon{
      {positions, 2 * n}, {ringStarts, size_t(ringCount) + 1}, {points, 2 * size_t(pointCount)}};
  auto opened = std::make_unique<OpenSession>();
  opened->maxBytes = maxBytes;
  sf::Work work = sf::hostWork(maxBytes);
  const sf::Outcome outcome = opened->session.start(polygon, work);
  if (outcome.ok()) {
    std::vector<uint32_t> triangles = copyOf(opened->session.triangles());
    *result = new SfResult(SfOpenedArrayCount);
    (*result)->put<SfOpened_session>(std::vector<uint32_t>{sessions().keep(std::move(opened))});
    (*result)->put<SfOpened_triangles>(std::move(triangles));
  }
  return sf::endWith(outcome, where);
}

SfStatus sf_session_edit(uint32_t session, uint32_t action, uint32_t vertex, double x, double y,
                         SfPlace* where, SfResult** result) {
  *result = nullptr;
  OpenSession* opened = sessions().find(session);
  if (!opened || action >= SF_COUNT(SF_EDIT_ACTION_CHOICES))
    return sf::endWith({sf::Status::BadOption}, where);
  sf::PolygonSession& edited = opened->session;
  sf::Work work = sf::hostWork(opened->maxBytes);
  sf::Outcome outcome;
  switch (EditAction(action)) {
    case EditAction::InsertVertex:
      outcome = edited.insertVertex(vertex, {x, y}, work, vertex);
      break;
    case EditAction::InsertIsolated:
      outcome = edited.insertIsland({x, y}, work, vertex);
      break;
    case EditAction::Delete:
      outcome = edited.deleteVertex(vertex, work);
      break;
    case EditAction::Move:
      outcome = edited.moveVertex(vertex, {x, y}, work);
  }
  const sf::ArrayView<const uint32_t> triangles = edited.triangles();
  const uint32_t count = uint32_t(triangles.size() / 3);
  SfEditFacts facts{};
  facts.vertex = vertex;
  facts.triangleCount = count;
  facts.status = uint32_t(outcome.status);
  facts.loop = outcome.loop;
  facts.atVertex = outcome.vertex;
  facts.otherLoop = outcome.otherLoop;
  facts.otherVertex = outcome.otherVertex;
  const sf::ArrayView<const uint32_t> changed = edited.changedTriangles();
  constexpr size_t kFacts = sizeof facts / sizeof(uint32_t);
  std::vector<uint32_t> edit;
  edit.reserve(kFacts + 4 * changed.size());
  edit.resize(kFacts);
  std::memcpy(edit.data(), &facts, sizeof facts);
  for (const uint32_t t : changed)
    if (t < count) edit.push_back(t);
  for (const uint32_t t : changed)
    if (t < count)
      edit.insert(edit.end(), &triangles[3 * size_t(t)], &triangles[3 * size_t(t)] + 3);
  *result = new SfResult(SfEditArrayCount);
  (*result)->put<SfEdit_edit>(std::move(edit));
  return sf::endWith({}, where);
}

SfStatus sf_session_read(uint32_t session, SfPlace* where, SfResult** result) {
  *result = nullptr;
  const OpenSession* opened = sessions().find(session);
  if (!opened) return sf::endWith({sf::Status::BadOption}, where);
  sf::Work work = sf::hostWork(opened->maxBytes);
  std::vector<uint32_t> strips, starts, next;
  if (!opened->session.strips(work, strips, starts)) return sf::endWith({work.status()}, where);
  const uint32_t n = uint32_t(opened->session.positions().size() / 2);
  for (uint32_t v = 0; v < n; ++v)
    next.push_back(opened->session.isVertex(v) ? opened->session.nextInRing(v) : v);
  *result = new SfResult(SfStateArrayCount);
  (*result)->put<SfState_positions>(copyOf(opened->session.positions()));
  (*result)->put<SfState_next>(std::move(next));
  (*result)->put<SfState_strips>(std::move(strips));
  (*result)->put<SfState_stripStarts>(std::move(starts));
  (*result)->put<SfState_certified>(std::vector<uint32_t>{opened->session.certify()});
  return sf::endWith({}, where);
}

SfStatus sf_session_close(uint32_t session) {
  sessions().drop(session);
  return SfStatus(sf::Status::Ok);
}

}  // extern "C"
