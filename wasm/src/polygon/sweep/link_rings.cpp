#include "polygon/sweep/link_rings.h"

#include <cmath>
#include <limits>

#include "base/double2.h"
#include "base/turn.h"

namespace sf {
namespace {

/// Range and shape of a list of points.
struct Extent {
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Double2 least = {kInfinity, kInfinity}, greatest = {-kInfinity, -kInfinity};
  Double2 smallest = {kInfinity, kInfinity};  // least magnitude that is not 0
  Int2 accepted = {-1, -1};
  // The number of local minima and maxima along x and along y, of the points as one chain.
  Int2 extrema = {0, 0}, rises = {0, 0};
  Double2 last = {kInfinity, kInfinity};

  void add(Point2 p) {
    const Double2 xy = {p.x, p.y}, size = magnitudes(xy), infinite = {kInfinity, kInfinity};
    const Int2 risesNow = last < xy;
    extrema -= rises ^ risesNow;
    rises = risesNow, last = xy;
    accepted &= size <= kLargestCoordinate;  // false for NaN
    least = lesser(xy, least), greatest = greater(xy, greatest);
    smallest = lesser(size > 0 ? size : infinite, smallest);
  }
  bool isAccepted() const { return (accepted[0] & accepted[1]) != 0; }
  /// The power of two by which to scale, so that tiny polygons stay clear of underflows.
  double scale() const {
    const Double2 sizes = greater(magnitudes(least), magnitudes(greatest));
    const double largest = sizes[0] > sizes[1] ? sizes[0] : sizes[1];
    if (largest == 0 || largest > 0x1p-200) return 1;
    int exponent;
    std::frexp(largest, &exponent);
    return std::ldexp(1.0, exponent < -1000 ? 1000 : -exponent);
  }
};

Outcome checkStarts(const PolygonView& polygon) {
  const ArrayView<const uint32_t> starts = polygon.starts;
  Outcome bad;
  bad.status = Status::BadStarts;
  if (starts.size() < 2 || starts[0] != 0) return bad;
  for (uint32_t c = 0; c + 1 < starts.size(); ++c) {
    bad.loop = c;
    if (starts[c] > starts[c + 1]) return bad;
  }
  bad.loop = kNone;
  if (starts[starts.size() - 1] != polygon.positions.size() / 2) return bad;
  return {};
}

Outcome firstNotFinite(const PolygonView& polygon) {
  Outcome bad;
  bad.status = Status::NotFinite;
  const auto isBad = [](ArrayView<const double> xy, size_t i) {
    return !isAccepted({xy[2 * i], xy[2 * i + 1]});
  };
  const uint32_t rings = uint32_t(polygon.starts.size()) - 1;
  for (bad.loop = 0; bad.loop < rings; ++bad.loop)
    for (uint32_t i = polygon.starts[bad.loop]; i < polygon.starts[bad.loop + 1]; ++i) {
      bad.vertex = i - polygon.starts[bad.loop];
      if (isBad(polygon.positions, i)) return bad;
    }
  for (bad.vertex = 0;; ++bad.loop)
    if (isBad(polygon.points, bad.loop - rings)) return bad;
}

/// Copies positions, and isolated points or the frame, to `linked`. Scales them, and turns them if
/// `mayTurn` and the turn pays. False if one is not finite.
bool copyScaled(const PolygonView& polygon, bool mayTurn, bool complement, LinkedPolygon& linked) {
  Buffer<Point2>& at = linked.at;
  const size_t n = polygon.positions.size() / 2;
  at.resize(n + (complement ? 4 : polygon.points.size() / 2));
  Extent extent;
  const auto copy = [&](ArrayView<const double> xy, Point2* to) {
    for (size_t i = 0; i < xy.size() / 2; ++i) {
      to[i] = {xy[2 * i], xy[2 * i + 1]};
      extent.add(to[i]);
    }
  };
  copy(polygon.positions, at.data());
  // Decided for the rings alone: from here on other points are counted as well.
  const bool turns = mayTurn && 4 * extent.extrema[0] < 3 * extent.extrema[1];
  if (!complement) copy(polygon.points, at.data() + n);
  if (!extent.isAccepted()) return false;
  if (complement) frameAround(polygon, at.data() + n);
  for (size_t i = n; i < at.size() && complement; ++i) extent.add(at[i]);
  const double scale = extent.scale();
  if (scale != 1)
    for (Point2& q : at) q = {q.x * scale, q.y * scale};
  const Point2 least = {extent.least[0] * scale, extent.least[1] * scale};
  const Point2 greatest = {extent.greatest[0] * scale, extent.greatest[1] * scale};
  linked.least = least, linked.greatest = greatest;
  linked.smallest = lesser(extent.smallest, swapped(extent.smallest))[0] * scale;
  linked.turned = turns;
  if (!turns) return true;
  for (Point2& q : at) q = {-q.y, q.x};
  linked.least = {-greatest.y, least.x}, linked.greatest = {-least.y, greatest.x};
  return true;
}

/// Makes a node unused: linked to itself alone.
void setAside(LinkedPolygon& linked, uint32_t v) {
  linked.kind[v] = VertexKind::Unused;
  linked.next[v] = linked.prev[v] = v;
}

/// One ring on its way into loops.
class RingLinker {
 public:
  RingLinker(LinkedPolygon& linked, uint32_t first, uint32_t last)
      : p_(linked), at_(linked.at.data()), first_(first), last_(last) {
    look();
  }

  /// Whether the ring runs counter-clockwise. At its lowest point all edges leave upwards, and the
  /// leftmost of them bounds the inside from the left: it has to lead down.
  bool isCounterClockwise() const;
  bool repeatsItself() const { return repeats_; }
  /// Whether all vertices are at two places, of which neighbours do not share one.
  bool goesToAndFro() const;
  void link(bool reversed);
  /// The same for rings with repeated vertices; false for fewer than 3 distinct points in a row.
  bool linkDistinct(bool reversed);

 private:
  void look();
  uint32_t after(uint32_t i) const { return i == last_ ? first_ : i + 1; }
  uint32_t before(uint32_t i) const { return i == first_ ? last_ : i - 1; }

  LinkedPolygon& p_;
  const Point2* at_;
  const uint32_t first_, last_;
  uint32_t lowest_ = 0;      // the first of the lowest vertices
  bool comesAgain_ = false;  // there are others at its place
  bool repeats_ = false;
};

constexpr VertexKind kKinds[4] = {VertexKind::LeftBank, VertexKind::Bottom, VertexKind::Ceiling,
                                  VertexKind::RightBank};

/// `below` as 0 or 1, without a branch, which could not be predicted.
uint32_t rises(Point2 a, Point2 b) {
  return uint32_t(a.y < b.y) | (uint32_t(a.y == b.y) & uint32_t(a.x < b.x));
}

/// Finds the lowest vertex, whether vertices are repeated, and the kinds as the ring comes.
void RingLinker::look() {
  VertexKind* kind = p_.kind.data();
  Point2 from = at_[last_], low = at_[first_];
  uint32_t up = rises(from, low), lowest = first_;
  bool repeats = from == low, again = false;
  from = low;
  for (uint32_t i = first_; i < last_; ++i) {
    const Point2 to = at_[i + 1];
    const uint32_t upNext = rises(from, to);
    repeats |= (from.x == to.x) & (from.y == to.y);
    if (to.y <= low.y) {
      if (below(to, low))
        low = to, lowest = i + 1, again = false;
      else
        again |= to == low;
    }
    kind[i] = kKinds[2 * up + upNext];
    up = upNext, from = to;
  }
  kind[last_] = kKinds[2 * up + rises(from, at_[first_])];
  lowest_ = lowest, repeats_ = repeats, comesAgain_ = again;
}

bool RingLinker::isCounterClockwise() const {
  const Point2 p = at_[lowest_];
  Point2 leftmost = p;
  bool down = false;
  const auto consider = [&](Point2 q, bool leadsDown) {
    if (q == p) return;
    if (leftmost == p || turn(p, leftmost, q) > 0) leftmost = q, down = leadsDown;
  };
  const auto considerBoth = [&](uint32_t i) {
    consider(at_[before(i)], true);
    consider(at_[after(i)], false);
  };
  considerBoth(lowest_);
  for (uint32_t i = lowest_ + 1; comesAgain_ && i <= last_; ++i)
    if (at_[i] == p) considerBoth(i);
  return down;
}

bool RingLinker::goesToAndFro() const {
  for (uint32_t i = first_; i + 2 <= last_; ++i)
    if (!(at_[i] == at_[i + 2])) return false;
  return true;
}

void RingLinker::link(bool reversed) {
  uint32_t* before = (reversed ? p_.next : p_.prev).data();
  uint32_t* after = (reversed ? p_.prev : p_.next).data();
  VertexKind* kind = p_.kind.data();
  for (uint32_t i = first_; i <= last_; ++i) before[i] = i - 1;
  for (uint32_t i = first_; i <= last_; ++i) after[i] = i + 1;
  before[first_] = last_, after[last_] = first_;
  if (!reversed) return;
  // Banks turn round with the ring, minima and maxima do not.
  static_assert(int(VertexKind::LeftBank) == 0 && int(VertexKind::RightBank) == 1,
                "told by numbers");
  for (uint32_t i = first_; i <= last_; ++i)
    kind[i] = VertexKind(uint8_t(kind[i]) ^ uint8_t(uint8_t(kind[i]) < 2));
}

bool RingLinker::linkDistinct(bool reversed) {
  const auto step = [&](uint32_t i) { return reversed ? before(i) : after(i); };
  const auto back = [&](uint32_t i) { return reversed ? after(i) : before(i); };
  uint32_t begin = first_;
  while (at_[begin] == at_[back(begin)]) {
    begin = step(begin);
    if (begin == first_) return false;  // one point only
  }
  uint32_t count = 0, v = begin;
  do {
    uint32_t w = step(v);
    while (at_[w] == at_[v]) setAside(p_, w), w = step(w);
    for (uint32_t d = v; step(d) != w; d = step(d)) p_.flat.insert(p_.flat.end(), {d, step(d), w});
    p_.next[v] = w, p_.prev[w] = v;
    ++count;
    v = w;
  } while (v != begin);
  if (count < 3) return false;
  do {
    const uint32_t up = below(at_[p_.prev[v]], at_[v]), upNext = below(at_[v], at_[p_.next[v]]);
    p_.kind[v] = kKinds[2 * up + upNext];
    v = p_.next[v];
  } while (v != begin);
  return true;
}

}  // namespace

void frameAround(const PolygonView& polygon, Point2 corners[4]) {
  double m = 0;
  for (const double x : polygon.positions) m = std::fabs(x) > m ? std::fabs(x) : m;
  m *= 2;
  corners[0] = {-m, -m}, corners[1] = {m, -m}, corners[2] = {m, m}, corners[3] = {-m, m};
}

Outcome linkRings(const PolygonView& polygon, bool mayTurn, bool complement, LinkedPolygon& linked,
                  std::vector<uint8_t>& reversed) {
  linked.turned = false;
  if (Outcome bad = checkStarts(polygon); !bad.ok()) return bad;
  if (!copyScaled(polygon, mayTurn, complement, linked)) return firstNotFinite(polygon);
  const uint32_t n = uint32_t(polygon.positions.size() / 2), m = uint32_t(linked.at.size());
  const uint32_t rings = uint32_t(polygon.starts.size()) - 1;
  linked.vertex.resize(m), linked.next.resize(m), linked.prev.resize(m), linked.kind.resize(m);
  linked.flat.clear();
  reversed.resize(rings);
  for (uint32_t i = 0; i < m; ++i) linked.vertex[i] = i;
  for (uint32_t c = 0; c < rings; ++c) {
    const uint32_t first = polygon.starts[c];
    uint32_t size = polygon.starts[c + 1] - first;
    if (size > 1 && linked.at[first] == linked.at[first + size - 1])
      setAside(linked, first + --size);
    Outcome bad;
    bad.status = Status::DegeneratePolygon, bad.loop = c;
    if (size < 3) return bad;
    RingLinker ring(linked, first, first + size - 1);
    const bool isOuter = polygon.isOriented ? ring.isCounterClockwise() : c == 0;
    reversed[c] = ring.isCounterClockwise() != (isOuter != complement);
    if (ring.goesToAndFro()) return bad;
    if (!ring.repeatsItself())
      ring.link(reversed[c]);
    else if (!ring.linkDistinct(reversed[c]))
      return bad;
  }
  if (complement) {
    RingLinker(linked, n, n + 3).link(false);
    return {};
  }
  for (uint32_t i = n; i < m; ++i)
    linked.kind[i] = VertexKind::Island, linked.next[i] = linked.prev[i] = i;
  return {};
}

}  // namespace sf
