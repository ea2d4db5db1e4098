#include "loops/polygon_chart.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "loops/weight.h"

namespace sf {
namespace {

/// Cost of what is not to be had.
constexpr float kNever = std::numeric_limits<float>::infinity();
constexpr float kMost = std::numeric_limits<float>::max();
/// Corners up to which every segment is kept.
constexpr uint32_t kAllSegments = 500;
/// Beyond: all segments up to this length, and of longer ones so many at each corner and octave.
constexpr uint32_t kShortSegment = 64;
constexpr double kKeptPerOctave = 60;
/// Corners beyond which fewer are kept, so that the time grows with their square.
constexpr double kManyCorners = 700;
/// Segments that are split for each one that is kept.
constexpr size_t kSplitPerKept = 2;
/// How far above the least bound, in mean costs of a triangle, splits are still tried.
constexpr float kSlack = 0.25f;
/// Of segments up to this length all of these are tried.
constexpr uint32_t kTryAll = 8;
/// Of the mean by which costs exceed the least bound: how far above it splits are tried first.
constexpr float kGap = 0.6f;

double keptPerOctave(double n) { return kKeptPerOctave * std::min(1.0, kManyCorners / n); }

constexpr float kHalfPi = 1.5707288f;

using Float4 = float __attribute__((vector_size(16)));
using Int4 = int32_t __attribute__((vector_size(16)));

inline Float4 load(const float* p) {
  Float4 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
inline void store(float* p, Float4 v) { std::memcpy(p, &v, sizeof v); }
inline bool any(Int4 mask) {
  uint64_t half[2];
  std::memcpy(half, &mask, sizeof half);
  return (half[0] | half[1]) != 0;
}

/// 1 / sqrt(x) to six digits: the well-known first guess and two steps of Newton.
inline Float4 reciprocalRoot(Float4 x) {
  const Float4 half = 0.5f * x;
  Float4 r = (Float4)(0x5f3759df - ((Int4)x >> 1));
  r = r * (1.5f - half * r * r);
  return r * (1.5f - half * r * r);
}

/// The angles whose cosines are given, within 1e-4 rad.
inline Float4 anglesOfCosines(Float4 x) {
  const Float4 a = x < 0 ? -x : x;
  const Float4 rest = 1 - a > 1e-12f ? 1 - a : Float4{1e-12f, 1e-12f, 1e-12f, 1e-12f};
  const Float4 angle = rest * reciprocalRoot(rest) *
                       (kHalfPi + a * (-0.2121144f + a * (0.0742610f - 0.0187293f * a)));
  return x < 0 ? 2 * kHalfPi - angle : angle;
}

}  // namespace

PolygonChart::PolygonChart(const LoopSet& loops, const TriangleWeights& weights, Work& work)
    : loops_(loops),
      areaWeight_(float(0.5 * weights.area)),
      perimeterWeight_(float(weights.perimeter)),
      angleWeight_(float(weights.dihedral)),
      work_(work),
      memory_(work) {}

double PolygonChart::bytesFor(double n) {
  const double kept =
      n <= kAllSegments ? n * n / 2
                        : n * (kShortSegment + keptPerOctave(n) * std::log(n / kShortSegment) + 8);
  return 6 * n * n + kept * (2 * sizeof(Splits) + 2 * sizeof(Segment)) + 64 * n;
}

inline PolygonChart::Splits PolygonChart::noSplits() {
  const Float4 zero = {};
  return {zero + kNever, zero, zero, zero};
}

/// Weighted angles between a triangle and those of the splits.
inline Float4 PolygonChart::anglesTo(const Splits& s, Normal n) const {
  return angleWeight_ * anglesOfCosines(n.x * s.x + n.y * s.y + n.z * s.z);
}

/// The least cost of a segment as seen from a triangle across it.
inline float PolygonChart::reach(const Splits& s, Normal n) const {
  const Float4 w = s.cost + anglesTo(s, n);
  const float a = w[0] < w[1] ? w[0] : w[1], b = w[2] < w[3] ? w[2] : w[3];
  return a < b ? a : b;
}

/// Adds a split unless another makes it needless, and drops those that it makes needless.
inline void PolygonChart::insert(Splits& s, Segment& segment, float cost, Normal n,
                                 uint32_t apex) const {
  if (!(cost < s.cost[kSplits - 1])) return;
  const Float4 angle = anglesTo(s, n);
  uint32_t count = 0;
  for (uint32_t q = 0; q < kSplits && s.cost[q] < kNever; ++q) {
    if (cost >= s.cost[q] + angle[q]) return;
    if (s.cost[q] >= cost + angle[q]) continue;
    s.cost[count] = s.cost[q], s.x[count] = s.x[q], s.y[count] = s.y[q], s.z[count] = s.z[q];
    segment.apex[count++] = segment.apex[q];
  }
  for (uint32_t q = count; q < kSplits; ++q) s.cost[q] = kNever;
  uint32_t at = std::min(count, kSplits - 1);
  for (; at > 0 && s.cost[at - 1] > cost; --at) {
    s.cost[at] = s.cost[at - 1], s.x[at] = s.x[at - 1], s.y[at] = s.y[at - 1];
    s.z[at] = s.z[at - 1], segment.apex[at] = segment.apex[at - 1];
  }
  s.cost[at] = cost, s.x[at] = n.x, s.y[at] = n.y, s.z[at] = n.z;
  segment.apex[at] = apex;
}

/// Costs of four splits of a segment at once, for those apexes that make a triangle thick enough to
/// tell its normal; infinity for the others.
inline void PolygonChart::weigh(uint32_t first, uint32_t last, const uint32_t apex[4], Float4& cost,
                                Normal normal[4]) const {
  const Vec3 p = positions_[first], r = positions_[last];
  const float ex = float(r.x - p.x), ey = float(r.y - p.y), ez = float(r.z - p.z);
  Float4 dx, dy, dz;
  for (uint32_t a = 0; a < 4; ++a) {
    const Vec3 d = positions_[apex[a]] - p;
    dx[a] = float(d.x), dy[a] = float(d.y), dz[a] = float(d.z);
  }
  const Float4 cx = dy * ez - dz * ey, cy = dz * ex - dx * ez, cz = dx * ey - dy * ex;
  const Float4 squared = cx * cx + cy * cy + cz * cz, dd = dx * dx + dy * dy + dz * dz;
  const float ee = ex * ex + ey * ey + ez * ez;
  const Float4 zero = {};
  const Float4 inverse = reciprocalRoot(squared);
  const Float4 nx = cx * inverse, ny = cy * inverse, nz = cz * inverse;
  Float4 own = areaWeight_ * (squared * inverse);
  if (perimeterWeight_ > 0) {
    const Float4 gx = ex - dx, gy = ey - dy, gz = ez - dz, gg = gx * gx + gy * gy + gz * gz;
    own += perimeterWeight_ * (dd * reciprocalRoot(dd) + gg * reciprocalRoot(gg) + std::sqrt(ee));
  }
  cost = squared > 1e-12f * ee * dd && squared > 1e-30f ? own : zero + kNever;
  for (uint32_t a = 0; a < 4; ++a) {
    normal[a] = {nx[a], ny[a], nz[a]};
    cost[a] += reach(splits_[number_[at(first, apex[a])]], normal[a]) +
               reach(splits_[number_[at(apex[a], last)]], normal[a]);
  }
}

/// Bounds of all apexes of a segment, the cost of what lies behind their triangles; the least of them.
float PolygonChart::boundApexes(uint32_t first, uint32_t last) {
  const float* left = &cost_[size_t(first) * n_ + first + 1];
  const float* right = &cost_[size_t(last) * n_ + first + 1];
  const uint32_t count = last - first - 1, whole = count & ~3u;
  Float4 least4 = Float4{} + kNever;
  for (uint32_t x = 0; x < whole; x += 4) {
    const Float4 b = load(left + x) + load(right + x);
    least4 = b < least4 ? b : least4;
    store(&bound_[x], b);
  }
  float least = std::min(std::min(least4[0], least4[1]), std::min(least4[2], least4[3]));
  for (uint32_t x = whole; x < count; ++x) {
    bound_[x] = left[x] + right[x];
    least = std::min(least, bound_[x]);
  }
  return least;
}

/// Tries the splits whose bound is above `more` and at most `most`, as long as they may be among the
/// cheap ones.
void PolygonChart::trySplits(float more, float most, float slack, Splits& s, Segment& segment) {
  const uint32_t first = segment.first, last = segment.last;
  const uint32_t count = last - first - 1, whole = count & ~3u;
  apexes_.clear();
  const auto choose = [&](uint32_t begin, uint32_t end) {
    for (uint32_t x = begin; x < end; ++x)
      if (bound_[x] > more && bound_[x] <= most) apexes_.push_back(first + 1 + x);
  };
  for (uint32_t x = 0; x < whole; x += 4)
    if (any(load(&bound_[x]) <= most)) choose(x, x + 4);
  choose(whole, count);
  for (size_t q = 0; q < apexes_.size();) {
    uint32_t four[4], chosen = 0;
    for (; q < apexes_.size() && chosen < 4; ++q)
      if (bound_[apexes_[q] - first - 1] < s.cost[0] + slack) four[chosen++] = apexes_[q];
    if (chosen == 0) break;
    for (uint32_t a = chosen; a < 4; ++a) four[a] = four[0];
    Float4 cost;
    Normal normal[4];
    weigh(first, last, four, cost, normal);
    for (uint32_t a = 0; a < chosen; ++a) insert(s, segment, cost[a], normal[a], four[a]);
  }
}

/// The cheap splits of a segment; false if it has none. The cheapest is the least over all apexes of
/// what the chart knows; of the others some may be missed.
bool PolygonChart::split(uint32_t first, uint32_t last, Splits& s, Segment& segment) {
  segment = {first, last, {kNone, kNone, kNone, kNone}};
  s = noSplits();
  const float least = boundApexes(first, last);
  if (least == kNever) return false;
  const uint32_t length = last - first;
  if (length <= kTryAll) {
    trySplits(-kNever, kMost, kMost, s, segment);
  } else {
    // First those that are cheap as a rule, so that few of the others have to be tried.
    const float slack = kSlack * least / float(length), usual = least + gap_;
    trySplits(-kNever, usual, slack, s, segment);
    if (s.cost[0] + slack > usual)
      trySplits(usual, std::min(kMost, s.cost[0] + slack), slack, s, segment);
  }
  if (!(s.cost[0] < kNever)) return false;
  gapSum_ += s.cost[0] - least;
  return true;
}

void PolygonChart::keep(const Splits& splits, const Segment& segment) {
  const uint32_t number = uint32_t(splits_.size());
  const float cost = segment.last - segment.first == 1 ? 0 : splits.cost[0];
  splits_.push_back(splits);
  segments_.push_back(segment);
  cost_[size_t(segment.first) * n_ + segment.last] = cost;
  cost_[size_t(segment.last) * n_ + segment.first] = cost;
  number_[at(segment.first, segment.last)] = number;
}

/// Segments of one edge: free, or seen by the face across it.
void PolygonChart::addEdges() {
  for (uint32_t i = 0; i + 1 < n_; ++i) {
    Splits s = noSplits();
    // No normal is at a right angle to all: that is taken back.
    s.cost[0] = -angleWeight_ * kHalfPi;
    if (corners_[i].hasFace) {
      const Vec3 face = corners_[i].normal;
      s.cost[0] = 0, s.x[0] = float(face.x), s.y[0] = float(face.y), s.z[0] = float(face.z);
    }
    keep(s, {i, i + 1, {kNone, kNone, kNone, kNone}});
  }
}

/// Of the segments of one length, those with the least bounds are split, and of these the cheapest
/// are kept: all of them while there are few.
bool PolygonChart::computeLength(uint32_t length) {
  const bool keepAll = n_ <= kAllSegments || length <= kShortSegment || length == n_ - 1;
  const size_t most = keepAll ? n_ : size_t(std::ceil(keptPerOctave(n_) * n_ / length)) + 4;
  const auto keepLeast = [](std::vector<Ranked>& ranked, size_t count) {
    if (ranked.size() <= count) return;
    const auto end = ranked.begin() + std::ptrdiff_t(count);
    std::nth_element(ranked.begin(), end, ranked.end());
    ranked.erase(end, ranked.end());
  };
  ranked_.clear();
  for (uint32_t i = 0; i + length < n_; ++i) {
    if (!work_.tick(20 + length / 2)) return false;
    const float bound = keepAll ? 0 : boundApexes(i, i + length);
    if (bound < kNever) ranked_.push_back({bound, i});
  }
  keepLeast(ranked_, kSplitPerKept * most);
  gapSum_ = 0;
  std::vector<Splits> splits;
  std::vector<Segment> segments;
  std::vector<Ranked> kept;
  Splits s;
  Segment segment;
  for (const Ranked& r : ranked_) {
    if (!work_.tick(500 + length / 2)) return false;
    if (!split(r.second, r.second + length, s, segment)) continue;
    if (keepAll) {
      keep(s, segment);
      continue;
    }
    kept.push_back({float(s.cost[0]), uint32_t(splits.size())});
    splits.push_back(s);
    segments.push_back(segment);
  }
  if (!ranked_.empty()) gap_ = kGap * gapSum_ / float(ranked_.size());
  keepLeast(kept, most);
  for (const Ranked& r : kept) keep(splits[r.second], segments[r.second]);
  return true;
}

/// The face across the edge that closes the polygon.
void PolygonChart::weighRoot() {
  const Corner& corner = corners_[n_ - 1];
  if (!corner.hasFace || cost_[n_ - 1] == kNever) return;
  Splits& s = splits_[number_[at(0, n_ - 1)]];
  const Vec3 f = corner.normal;
  s.cost = s.cost + anglesTo(s, {float(f.x), float(f.y), float(f.z)});
}

bool PolygonChart::compute(std::vector<Corner> corners) {
  corners_ = std::move(corners);
  n_ = uint32_t(corners_.size());
  const uint64_t bytes = uint64_t(bytesFor(n_));
  if (bytes > charged_ && !memory_.add(bytes - charged_)) return false;
  charged_ = std::max(charged_, bytes);
  positions_.clear();
  for (const Corner& c : corners_) positions_.push_back(loops_.position(c.vertex));
  splits_.clear();
  segments_.clear();
  gap_ = 0;
  cost_.assign(size_t(n_) * n_, kNever);
  number_.resize(size_t(n_) * (n_ - 1) / 2);
  bound_.resize(n_);
  addEdges();
  for (uint32_t length = 2; length < n_; ++length)
    if (!computeLength(length)) return false;
  best_ = kInfinity;
  if (cost_[n_ - 1] == kNever) return true;
  weighRoot();
  const Splits& root = splits_[number_[at(0, n_ - 1)]];
  for (uint32_t q = 0; q < kSplits; ++q) best_ = std::min(best_, double(root.cost[q]));
  return true;
}

void PolygonChart::trace(std::vector<Triangle>& triangles) const {
  struct Open {
    uint32_t first, last;
    Normal across;
  };
  std::vector<Open> queue{{0, n_ - 1, {0, 0, 0}}};
  for (size_t at = 0; at < queue.size(); ++at) {
    const Open open = queue[at];
    if (open.last - open.first < 2) continue;
    const uint32_t number = number_[this->at(open.first, open.last)];
    const Splits& s = splits_[number];
    // At the root no normal is across: the angle is the same for all then.
    const Float4 cost = s.cost + anglesTo(s, open.across);
    uint32_t best = 0;
    for (uint32_t q = 1; q < kSplits; ++q)
      if (cost[q] < cost[best]) best = q;
    const uint32_t apex = segments_[number].apex[best];
    const Normal normal{s.x[best], s.y[best], s.z[best]};
    triangles.push_back({0, {open.first, apex, open.last}});
    queue.push_back({open.first, apex, normal});
    queue.push_back({apex, open.last, normal});
  }
}

void PolygonChart::nearBest(double mostExcess, size_t most, std::vector<Triangle>& triangles) {
  triangles.clear();
  if (best_ == kInfinity) return;
  const float limit = float(mostExcess);
  // From the root inwards: the excess of a split is that of the triangle across, and what it costs
  // there more than the best one.
  std::vector<float> excess(kSplits * splits_.size(), kNever);
  std::vector<std::vector<uint32_t>> byLength(n_);
  std::vector<uint8_t> isReached(splits_.size(), 0);
  const uint32_t root = number_[at(0, n_ - 1)];
  for (uint32_t q = 0; q < kSplits; ++q)
    excess[kSplits * root + q] = splits_[root].cost[q] - float(best_);
  byLength[n_ - 1].push_back(root);
  for (uint32_t length = n_ - 1; length > 1; --length) {
    for (const uint32_t number : byLength[length]) {
      const Segment& segment = segments_[number];
      const Splits& s = splits_[number];
      for (uint32_t q = 0; q < kSplits; ++q) {
        const float e = excess[kSplits * size_t(number) + q];
        if (!(e <= limit)) continue;
        const uint32_t apex = segment.apex[q];
        triangles.push_back({e, {segment.first, apex, segment.last}});
        const Normal n{s.x[q], s.y[q], s.z[q]};
        for (const uint32_t part :
             {number_[at(segment.first, apex)], number_[at(apex, segment.last)]}) {
          const Segment& inner = segments_[part];
          if (inner.last - inner.first == 1) continue;
          const Splits& c = splits_[part];
          const Float4 angles = anglesTo(c, n);
          const float least = reach(c, n);
          bool any = false;
          for (uint32_t r = 0; r < kSplits && c.cost[r] < kNever; ++r) {
            const float x = e + c.cost[r] + angles[r] - least;
            float& old = excess[kSplits * size_t(part) + r];
            old = std::min(old, x);
            any = any || x <= limit;
          }
          if (!any || isReached[part]) continue;
          isReached[part] = 1;
          byLength[inner.last - inner.first].push_back(part);
        }
      }
    }
  }
  if (triangles.size() <= most) return;
  std::nth_element(triangles.begin(), triangles.begin() + std::ptrdiff_t(most), triangles.end(),
                   [](const Triangle& a, const Triangle& b) { return a.excess < b.excess; });
  triangles.resize(most);
}

}  // namespace sf
