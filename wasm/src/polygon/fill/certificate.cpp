#include "polygon/fill/certificate.h"

#include "base/charge.h"
#include "base/turn.h"
#include "triangles/triangle_mesh.h"

namespace sf {
namespace {

/// A sum of directed edges that have to cancel: a table of those that still wait for their
/// opposites. Triangles mostly come next to each other, so few wait at a time, often none; the
/// table is then not made.
class OpenEdges {
 public:
  explicit OpenEdges(Charge& charge) : charge_(charge) {}

  __attribute__((noinline)) void add(uint32_t u, uint32_t v) {
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
  /// Edges between the same two groups of eight vertices are kept together: they are looked up
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
  /// Empties slot i, and moves up those behind it that would be lost otherwise.
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

/// Whether no triangle is turned over, and the boundary of all is that of the rings; or with
/// `frame`, of the frame less the rings.
///   wanted  [m] for each point an edge from it that has to be left over; further ones are
///           subtracted in the table. All kNone before, and after if true is returned
///   same    of the certificate; a function, so that nothing is looked up if all points differ
template <class Same>
bool boundsRings(const Certificate& c, bool frame, Same same, std::vector<uint32_t>& wanted,
                 Work& work) {
  const ArrayView<const uint32_t> triangles = frame ? c.complement : c.inside;
  const uint32_t* const corners = triangles.data();
  const uint32_t* const twins = (frame ? c.complementTwins : c.insideTwins).data();
  const uint32_t paired = uint32_t(frame ? c.complementPaired : c.insidePaired);
  uint32_t* const left = wanted.data();
  Charge charge(work);
  OpenEdges open(charge);
  const auto want = [&](uint32_t u, uint32_t v) {
    u = same(u), v = same(v);
    if (u == v) return;  // points at one place have no edge between them
    if (left[u] == kNone)
      left[u] = v;
    else
      open.add(v, u);
  };
  for (size_t i = 0; i < c.rings.size(); i += 2)
    frame ? want(c.rings[i + 1], c.rings[i]) : want(c.rings[i], c.rings[i + 1]);
  const uint32_t corner = uint32_t(c.at.size()) - 4;
  for (uint32_t k = 0; frame && k < 4; ++k) want(corner + k, corner + (k + 1) % 4);

  bool agree = true;
  // The edge from u to v, opposite corner h.
  const auto take = [&](uint32_t h, uint32_t u, uint32_t v) {
    const uint32_t g = h < paired ? twins[h] : kNone;
    if (g < paired) {
      // At g it is checked that g ends where h begins.
      agree &= (twins[g] == h) & (corners[nextInTriangle(g)] == v);
      return;
    }
    u = same(u), v = same(v);
    if (left[u] == v)
      left[u] = kNone;
    else if (u != v)
      open.add(u, v);
  };
  for (uint32_t t = 0; t < triangles.size(); t += 3) {
    const uint32_t a = corners[t], b = corners[t + 1], d = corners[t + 2];
    agree &= turn(c.at[a], c.at[b], c.at[d]) >= 0;
    take(t, b, d), take(t + 1, d, a), take(t + 2, a, b);
  }
  for (const uint32_t v : wanted) agree &= v == kNone;
  return agree && open.isZero() && work.going();
}

}  // namespace

bool certify(const Certificate& c, Work& work) {
  for (size_t v = 0; v < c.at.size(); ++v) {
    const Point2 p = c.at[v];
    if (!(std::fabs(p.x) <= 1e151 && std::fabs(p.y) <= 1e151)) return false;
    if (c.same.empty()) continue;
    if (!(p == c.at[c.same[v]]) || c.same[c.same[v]] != c.same[v]) return false;
  }
  if (!work.tick(uint32_t(c.at.size() < (1u << 24) ? c.at.size() * 60 : 1u << 30))) return false;
  Charge charge(work);
  if (!charge.add(sizeof(uint32_t) * uint64_t(c.at.size()))) return false;
  std::vector<uint32_t> wanted(c.at.size(), kNone);
  const auto bound = [&](auto same) {
    return boundsRings(c, false, same, wanted, work) && boundsRings(c, true, same, wanted, work);
  };
  if (c.same.empty()) return bound([](uint32_t v) { return v; });
  return bound([&c](uint32_t v) { return c.same[v]; });
}

}  // namespace sf
