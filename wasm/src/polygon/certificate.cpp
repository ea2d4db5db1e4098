#include "polygon/certificate.h"

#include "base/charge.h"
#include "polygon/turn.h"

namespace sf {
namespace {

/// A sum of directed edges that are to cancel: a table of those that still wait for their opposites.
/// Triangles mostly come next to each other, so few wait at a time; often none, hence no table.
class OpenEdges {
 public:
  explicit OpenEdges(Charge& charge) : charge_(charge) {}

  void add(uint32_t u, uint32_t v) {
    if (slots_.empty()) slots_.assign(kSmallest, kFree);
    const uint64_t opposite = key(v, u);
    for (size_t i = home(opposite);; i = (i + 1) & mask()) {
      if (slots_[i] == opposite) return takeOut(i);
      if (slots_[i] == kFree) break;
    }
    if (2 * ++count_ > slots_.size() && !grow()) return;
    insert(key(u, v));
  }
  bool isZero() const { return count_ == 0; }

 private:
  static constexpr uint64_t kFree = ~uint64_t(0);
  static constexpr size_t kSmallest = 256;

  /// Both directions of an edge have one home.
  static uint64_t key(uint32_t u, uint32_t v) { return uint64_t(u) << 32 | v; }
  size_t mask() const { return slots_.size() - 1; }
  /// Edges between the same two groups of eight vertices are kept together: neighbours are wanted
  /// one after the other.
  size_t home(uint64_t k) const {
    const uint32_t u = uint32_t(k >> 32), v = uint32_t(k);
    const uint32_t least = u < v ? u : v, greatest = u < v ? v : u;
    uint64_t group = (uint64_t(least >> 3) << 32 | greatest >> 3) * 0x9E3779B97F4A7C15u;
    group ^= group >> 32;
    return size_t((group << 4) + ((least + 3 * greatest) & 15)) & mask();
  }
  void insert(uint64_t k) {
    size_t i = home(k);
    while (slots_[i] != kFree) i = (i + 1) & mask();
    slots_[i] = k;
  }
  /// Empties slot i, and moves up those behind it that would not be found any more.
  void takeOut(size_t i) {
    --count_;
    for (size_t j = i;;) {
      slots_[i] = kFree;
      do {
        j = (j + 1) & mask();
        if (slots_[j] == kFree) return;
      } while (((j - home(slots_[j])) & mask()) < ((j - i) & mask()));
      slots_[i] = slots_[j];
      i = j;
    }
  }
  /// False if memory is short: work ends, and with it certify.
  bool grow() {
    if (!charge_.add(sizeof(uint64_t) * slots_.size())) return false;
    std::vector<uint64_t> old(2 * slots_.size(), kFree);
    old.swap(slots_);
    for (const uint64_t k : old)
      if (k != kFree) insert(k);
    return true;
  }

  Charge& charge_;
  std::vector<uint64_t> slots_;
  size_t count_ = 0;
};

/// Whether the boundary of the triangles is that of the rings, or of the frame less the rings.
///   wanted  [m] the edge that has to be left over at each point; where there are more, the others are
///           taken away. kNone, and again kNone if true is returned
bool boundsRings(const Certificate& c, bool frame, std::vector<uint32_t>& wanted, Work& work) {
  const std::vector<uint32_t>& triangles = frame ? c.complement : c.inside;
  const std::vector<uint32_t>& twins = frame ? c.complementTwins : c.insideTwins;
  const size_t m = c.at.size();
  Charge charge(work);
  OpenEdges open(charge);
  const auto want = [&](uint32_t u, uint32_t v) {
    u = c.same[u], v = c.same[v];
    if (u == v) return;  // points at one place have no edge between them
    if (wanted[u] == kNone)
      wanted[u] = v;
    else
      open.add(v, u);
  };
  const auto add = [&](uint32_t u, uint32_t v) {
    if (u == v) return;
    if (wanted[u] == v)
      wanted[u] = kNone;
    else
      open.add(u, v);
  };
  for (size_t i = 0; i < c.rings.size(); i += 2)
    frame ? want(c.rings[i + 1], c.rings[i]) : want(c.rings[i], c.rings[i + 1]);
  const uint32_t corner = uint32_t(m) - 4;
  for (uint32_t k = 0; frame && k < 4; ++k) want(corner + k, corner + (k + 1) % 4);
  const size_t paired = twins.size() < triangles.size() ? twins.size() : triangles.size();
  for (uint32_t first = 0; first < triangles.size(); first += 3)
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t h = first + k, v = triangles[first + (k + 1) % 3];
      const uint32_t g = h < paired ? twins[h] : kNone;
      if (g == kNone) {
        add(c.same[triangles[h]], c.same[v]);
        continue;
      }
      // That g ends where h begins is seen from g.
      if (g >= paired || twins[g] != h || triangles[g] != v) return false;
    }
  for (const uint32_t v : wanted)
    if (v != kNone) return false;
  return open.isZero() && work.going();
}

bool noneTurnedOver(const Certificate& c, const std::vector<uint32_t>& triangles) {
  for (size_t i = 0; i < triangles.size(); i += 3)
    if (!(turn(c.at[triangles[i]], c.at[triangles[i + 1]], c.at[triangles[i + 2]]) >= 0))
      return false;
  return true;
}

}  // namespace

bool certify(const Certificate& c, Work& work) {
  for (size_t v = 0; v < c.at.size(); ++v) {
    const Point2 p = c.at[v];
    if (!(std::fabs(p.x) <= 1e151 && std::fabs(p.y) <= 1e151)) return false;
    if (!(p == c.at[c.same[v]]) || c.same[c.same[v]] != c.same[v]) return false;
  }
  if (!noneTurnedOver(c, c.inside) || !noneTurnedOver(c, c.complement)) return false;
  if (!work.tick(uint32_t(c.at.size() < (1u << 24) ? c.at.size() * 60 : 1u << 30))) return false;
  Charge charge(work);
  if (!charge.add(sizeof(uint32_t) * uint64_t(c.at.size()))) return false;
  std::vector<uint32_t> wanted(c.at.size(), kNone);
  return boundsRings(c, false, wanted, work) && boundsRings(c, true, wanted, work);
}

}  // namespace sf
