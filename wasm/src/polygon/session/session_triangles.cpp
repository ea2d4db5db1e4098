// What a session knows of its triangles: which lie inside, in what order they are handed out, and
// how they join to strips.
#include <algorithm>

#include "polygon/session/session.h"

namespace sf {
namespace {

// Flips after an edit: more than this are needed only where the triangles were bad before.
constexpr uint32_t kFlips = 1000;
constexpr uint8_t kUnknown = 2;

}  // namespace

/// Finds for each changed triangle whether it lies inside, from the triangles around it. False if
/// there is a contradiction, near vertex `culprit`.
bool PolygonSession::settleInside(uint32_t& culprit) {
  const TriangleMesh& mesh = mesh_.mesh;
  inside_.resize(mesh.triangleCount(), 0);
  for (const uint32_t t : mesh_.changed) inside_[t] = mesh.inUse(t) ? kUnknown : 0;
  const auto across = [&](uint32_t h) {
    return mesh.twins[h] == kNone ? uint8_t(0) : inside_[mesh.twins[h] / 3];
  };
  stack_.clear();
  for (const uint32_t t : mesh_.changed)
    for (uint32_t h = 3 * t; h < 3 * t + 3 && inside_[t] == kUnknown; ++h)
      if (across(h) != kUnknown) {
        inside_[t] = across(h) ^ uint8_t(mesh_.isFixed(h));
        stack_.push_back(t);
        while (!stack_.empty()) {
          const uint32_t s = stack_.back();
          stack_.pop_back();
          for (uint32_t g = 3 * s; g < 3 * s + 3; ++g)
            if (across(g) == kUnknown) {
              inside_[mesh.twins[g] / 3] = inside_[s] ^ uint8_t(mesh_.isFixed(g));
              stack_.push_back(mesh.twins[g] / 3);
            }
        }
      }
  for (const uint32_t t : mesh_.changed)
    for (uint32_t h = 3 * t; h < 3 * t + 3 && mesh.inUse(t); ++h) {
      const uint32_t a = mesh.from(h);
      const bool fixed = mesh_.isFixed(h), along = mesh_.next[a] == mesh.to(h);
      culprit = a;
      if ((inside_[t] ^ across(h)) != uint8_t(fixed)) return false;
      if (fixed && inside_[t] != uint8_t(along)) return false;
      if (ring_[a] == kIsland && inside_[t] == 0) return false;
    }
  return true;
}

/// The same for all triangles, from the box inwards. Checks how rings lie in each other, and turns
/// their links so that the polygon lies to the left.
Outcome PolygonSession::findInsideAnew() {
  const TriangleMesh& mesh = mesh_.mesh;
  // Of each triangle the innermost ring around it, kNone for none, and of each ring likewise.
  constexpr uint32_t kUnseen = kNone - 1;
  std::vector<uint32_t> around(mesh.triangleCount(), kUnseen), later;
  std::vector<uint32_t> parent(ringSizes_.size(), kUnseen);
  later.push_back(mesh.edgeFrom[0]);
  while (!later.empty()) {
    // One region at a time, so that rings are met from their outer sides first.
    const uint32_t entry = later.back();
    later.pop_back();
    if (around[entry / 3] != kUnseen) continue;
    const bool outermost = entry / 3 == mesh.edgeFrom[0] / 3;
    const uint32_t region = outermost ? kNone : ring_[mesh.from(entry)];
    around[entry / 3] = region;
    stack_.assign(1, entry / 3);
    while (!stack_.empty()) {
      const uint32_t t = stack_.back();
      stack_.pop_back();
      for (uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
        const uint32_t g = mesh.twins[h];
        if (g == kNone || around[g / 3] != kUnseen) continue;
        if (mesh_.isFixed(h)) {
          const uint32_t ring = ring_[mesh.from(h)];
          if (parent[ring] == kUnseen) parent[ring] = region;
          later.push_back(g);
        } else {
          around[g / 3] = region;
          stack_.push_back(g / 3);
        }
      }
    }
  }
  for (uint32_t r = 1; r < parent.size(); ++r) {
    Outcome outcome{Status::HoleOutside, r};
    if (parent[r] == kNone) return outcome;
    if (parent[r] == 0) continue;
    outcome.status = Status::NestedHole;
    outcome.otherLoop = parent[r];
    return outcome;
  }
  for (uint32_t v = kShift; v < ring_.size(); ++v)
    if (ring_[v] == kIsland && mesh_.contains(v) && around[mesh.edgeFrom[v] / 3] != 0)
      return about(Status::HoleOutside, v, kNone);

  inside_.resize(mesh.triangleCount(), 0);
  for (uint32_t t = 0; t < mesh.triangleCount(); ++t) {
    const uint8_t inside = mesh.inUse(t) && around[t] == 0;
    if (inside != inside_[t]) mesh_.touch(t);
    inside_[t] = inside;
  }
  orientRings();
  return {};
}

void PolygonSession::orientRings() {
  std::vector<bool> done(ringSizes_.size(), false);
  for (uint32_t v = kShift; v < ring_.size(); ++v) {
    if (mesh_.next[v] == kNone || done[ring_[v]]) continue;
    done[ring_[v]] = true;
    uint32_t h = mesh_.mesh.edgeFrom[v];
    while (mesh_.mesh.to(h) != mesh_.next[v]) h = mesh_.around(h);
    if (inside_[h / 3] == 1) continue;
    uint32_t u = v;
    do {
      std::swap(mesh_.next[u], mesh_.prev[u]);
      u = mesh_.next[u];
    } while (u != v);
  }
}

/// Ends an edit: flips, finds what is inside, and hands the changes on; or returns why it is
/// refused.
Outcome PolygonSession::finish(uint32_t edited) {
  mesh_.legalizeChanged(kFlips);
  uint32_t culprit;
  if (!settleInside(culprit)) {
    // All labels are found anew; settleInside may have left triangles without one.
    Outcome outcome = findInsideAnew();
    if (!outcome.ok()) {
      const Status status = outcome.status;
      outcome = about(status, edited, culprit);
      return outcome;
    }
  }
  slots_.resize(mesh_.mesh.triangleCount(), kNone);
  updateSlots();
  joinStrips();
  return {};
}

void PolygonSession::writeSlot(uint32_t slot) {
  for (uint32_t k = 0; k < 3; ++k)
    triangles_[3 * slot + k] = mesh_.mesh.corners[3 * triangleIn_[slot] + k] - kShift;
  changedSlots_.push_back(slot);
}

void PolygonSession::updateSlots() {
  changedSlots_.clear();
  std::vector<uint32_t>& freed = stack_;
  freed.clear();
  for (const uint32_t t : mesh_.changed)
    if (slots_[t] != kNone && inside_[t] == 0) {
      freed.push_back(slots_[t]);
      slots_[t] = kNone;
    }
  for (const uint32_t t : mesh_.changed) {
    if (inside_[t] == 0) continue;
    if (slots_[t] == kNone && !freed.empty()) {
      slots_[t] = freed.back();
      freed.pop_back();
    } else if (slots_[t] == kNone) {
      slots_[t] = uint32_t(triangleIn_.size());
      triangleIn_.push_back(t);
      triangles_.resize(triangles_.size() + 3);
    }
    triangleIn_[slots_[t]] = t;
    writeSlot(slots_[t]);
  }
  // The last triangles move to where some are missing.
  std::sort(freed.begin(), freed.end());
  while (!freed.empty()) {
    const uint32_t slot = freed.back(), last = uint32_t(triangleIn_.size()) - 1;
    freed.pop_back();
    if (slot != last) {
      triangleIn_[slot] = triangleIn_[last];
      slots_[triangleIn_[slot]] = slot;
      writeSlot(slot);
    }
    triangleIn_.pop_back();
    triangles_.resize(3 * triangleIn_.size());
  }
  std::sort(changedSlots_.begin(), changedSlots_.end());
  changedSlots_.erase(std::unique(changedSlots_.begin(), changedSlots_.end()), changedSlots_.end());
  while (!changedSlots_.empty() && changedSlots_.back() >= triangleIn_.size())
    changedSlots_.pop_back();
}

void PolygonSession::joinStrips() {
  mesh_.links.bits.resize(mesh_.mesh.triangleCount(), 0);
  among_.clear();
  for (const uint32_t t : mesh_.changed)
    if (inside_[t] != 0) among_.push_back(t);
  sf::joinStrips(mesh_.mesh.twins, among_, mesh_.links, [&](uint32_t h) {
    return inside_[mesh_.mesh.twins[h] / 3] != 0 && !mesh_.isFixed(h);
  });
}

bool PolygonSession::strips(Work& work, std::vector<uint32_t>& vertices,
                            std::vector<uint32_t>& starts) const {
  if (!writeStrips(mesh_.mesh.corners, mesh_.mesh.twins, mesh_.links, triangleIn_, work, vertices,
                   starts))
    return false;
  for (uint32_t& v : vertices) v -= kShift;
  return true;
}

bool PolygonSession::certify() const {
  const TriangleMesh& mesh = mesh_.mesh;
  uint32_t border = 0, inside = 0, fixed = 0, edges = 0;
  for (uint32_t t = 0; t < mesh.triangleCount(); ++t) {
    if (!mesh.inUse(t)) continue;
    if (mesh.orient(mesh.corners[3 * t], mesh.corners[3 * t + 1], mesh.corners[3 * t + 2]) <= 0)
      return false;
    inside += inside_[t];
    for (uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
      const uint32_t g = mesh.twins[h], a = mesh.from(h), b = mesh.to(h);
      border += g == kNone;
      if (g == kNone ? a >= kShift || b >= kShift || inside_[t] != 0
                     : mesh.twins[g] != h || mesh.from(g) != b || mesh.to(g) != a)
        return false;
      if (ring_[a] == kIsland && inside_[t] == 0) return false;
      if (mesh_.next[a] == b) {
        ++fixed;
        if (inside_[t] != 1 || g == kNone || inside_[g / 3] != 0) return false;
      } else if (mesh_.prev[a] != b && g != kNone && inside_[t] != inside_[g / 3]) {
        return false;
      }
    }
  }
  for (uint32_t v = kShift; v < ring_.size(); ++v) {
    edges += mesh_.next[v] != kNone;
    if ((ring_[v] != kNone) != mesh_.contains(v)) return false;
    if (mesh_.next[v] != kNone && mesh_.prev[mesh_.next[v]] != v) return false;
  }
  // A map of the box onto itself that is the identity on its border and nowhere folded is one to
  // one.
  if (border != 4 || fixed != edges || inside != triangleIn_.size()) return false;
  for (uint32_t s = 0; s < triangleIn_.size(); ++s)
    for (uint32_t k = 0; k < 3; ++k)
      if (triangles_[3 * s + k] + kShift != mesh.corners[3 * triangleIn_[s] + k]) return false;
  return true;
}

}  // namespace sf
