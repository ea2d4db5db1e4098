#include "loops/spaces/polygon_chart.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "loops/problem/weight.h"

namespace sf {
namespace {

/// The cost of what does not exist.
constexpr float kNever = std::numeric_limits<float>::infinity();
constexpr float kMost = std::numeric_limits<float>::max();
/// Corners up to which every segment is kept.
constexpr uint32_t kAllSegments = 150;
/// With more corners, all segments up to this length are kept, and of longer ones this many at each
/// corner and octave.
constexpr uint32_t kShortSegment = 24;
constexpr double kKeptPerOctave = 40;
/// Corners beyond which fewer are kept, so that the number kept grows with n log n.
constexpr double kManyCorners = 1000;
/// Segments that are split for each one that is kept.
constexpr double kSplitPerKept = 1.15;
/// Of segments up to this length all apexes are tried.
constexpr uint32_t kTryAll = 8;
/// Of longer ones those whose bound is above the least one by at most a gap: this share of the mean
/// excess of earlier costs over that bound, and of the excess that then turns out.
constexpr float kUsualGap = 0.9f, kOwnGap = 0.6f;
/// The second gap is used if it is wider than the first by this factor.
constexpr float kWider = 1.5f;
/// If more apexes than this are within the usual gap, it is narrowed by a factor,
/// at most this often.
constexpr uint32_t kManyApexes = 20;
constexpr int kMostNarrowings = 4;
constexpr float kNarrower = 0.6f;

/// How many segments of a length are kept, at most, in a polygon of n corners.
uint32_t mostKept(uint32_t n, uint32_t length) {
  const uint32_t all = n - length;
  if (n <= kAllSegments || length <= kShortSegment) return all;
  const double perOctave = kKeptPerOctave * std::min(1.0, kManyCorners / n);
  return std::min(all, uint32_t(std::ceil(perOctave * n / length)) + 4);
}

uint64_t mostKept(uint32_t n) {
  uint64_t sum = 0;
  for (uint32_t length = 1; length < n; ++length) sum += mostKept(n, length);
  return sum;
}

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
inline Float4 squareRoot(Float4 v) {
#if defined(__wasm_simd128__)
  return __builtin_wasm_sqrt_f32x4(v);
#elif defined(__SSE2__)
  return __builtin_ia32_sqrtps(v);
#else
  return Float4{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
#endif
}
inline Float4 smaller(Float4 a, Float4 b) { return b < a ? b : a; }
/// The least of the lanes of each of four vectors.
inline Float4 leastOfLanes(Float4 a, Float4 b, Float4 c, Float4 d) {
  const Float4 ab =
      smaller(__builtin_shufflevector(a, b, 0, 4, 1, 5), __builtin_shufflevector(a, b, 2, 6, 3, 7));
  const Float4 cd =
      smaller(__builtin_shufflevector(c, d, 0, 4, 1, 5), __builtin_shufflevector(c, d, 2, 6, 3, 7));
  return smaller(__builtin_shufflevector(ab, cd, 0, 1, 4, 5),
                 __builtin_shufflevector(ab, cd, 2, 3, 6, 7));
}

/// The angle between unit vectors is about root(u) (c0 + c1 u + c2 u^2 + c3 u^3), where u is 1 less
/// their product. The fit is within .011 rad up to 2.6 rad; beyond that it is too small by up to
/// .28. Another term makes the surfaces found no better.
constexpr float kAngle[4] = {1.3535858f, 0.4321578f, -0.3861121f, 0.1696036f};
/// A little more than 1, so that roots are of positive numbers.
constexpr float kOne = 1.000002f;

}  // namespace

PolygonChart::PolygonChart(const LoopSet& loops, const TriangleWeights& weights, Work& work)
    : loops_(loops),
      areaWeight_(float(0.5 * weights.area)),
      perimeterWeight_(float(weights.perimeter)),
      work_(work),
      memory_(work) {
  for (int i = 0; i < 4; ++i) angle_[i] = float(weights.dihedral) * kAngle[i];
}

double PolygonChart::bytesFor(uint32_t n) {
  return 8 * double(n) * n + double(mostKept(n) * (sizeof(Splits) + sizeof(Segment))) + 64 * n;
}

inline PolygonChart::Splits PolygonChart::noSplits() {
  const Float4 zero = {};
  return {zero + kNever, zero, zero, zero};
}

/// Weighted angles between unit vectors.
inline Float4 PolygonChart::angles(Float4 ax, Float4 ay, Float4 az, Float4 bx, Float4 by,
                                   Float4 bz) const {
  const Float4 u = kOne - ax * bx - ay * by - az * bz;
  return squareRoot(u) * (angle_[0] + u * (angle_[1] + u * (angle_[2] + u * angle_[3])));
}

/// The cost of a segment's splits as seen from a triangle across it.
inline Float4 PolygonChart::costsFrom(const Splits& s, Normal n) const {
  const Float4 zero = {};
  return s.cost + angles(zero + n.x, zero + n.y, zero + n.z, s.x, s.y, s.z);
}

/// Costs of splits of a segment, four at once, with the normals of their triangles. Infinity for
/// triangles too thin to have a normal.
void PolygonChart::weigh(uint32_t first, uint32_t last, Tried& t) const {
  const Normal p = positions_[first], r = positions_[last];
  const float ex = r.x - p.x, ey = r.y - p.y, ez = r.z - p.z;
  const float ee = ex * ex + ey * ey + ez * ez, side = perimeterWeight_ * std::sqrt(ee);
  const uint32_t* fromFirst = &number_[size_t(first) * n_];
  const uint32_t* fromLast = &number_[size_t(last) * n_];
  for (uint32_t q = 0; q < t.count; q += 4) {
    const uint32_t* apex = &t.apex[q];
    const Normal &a = positions_[apex[0]], &b = positions_[apex[1]], &c = positions_[apex[2]],
                 &d = positions_[apex[3]];
    const Float4 dx = Float4{a.x, b.x, c.x, d.x} - p.x, dy = Float4{a.y, b.y, c.y, d.y} - p.y,
                 dz = Float4{a.z, b.z, c.z, d.z} - p.z;
    const Float4 cx = dy * ez - dz * ey, cy = dz * ex - dx * ez, cz = dx * ey - dy * ex;
    const Float4 squared = cx * cx + cy * cy + cz * cz, dd = dx * dx + dy * dy + dz * dz;
    const Float4 size = squareRoot(squared), inverse = 1 / size;
    const Float4 nx = cx * inverse, ny = cy * inverse, nz = cz * inverse;
    Float4 cost = areaWeight_ * size;
    if (perimeterWeight_ > 0) {
      const Float4 gx = ex - dx, gy = ey - dy, gz = ez - dz;
      cost += perimeterWeight_ * (squareRoot(dd) + squareRoot(gx * gx + gy * gy + gz * gz)) + side;
    }
    Float4 left[4], right[4];
    for (uint32_t i = 0; i < 4; ++i) {
      const Normal n{nx[i], ny[i], nz[i]};
      left[i] = costsFrom(splits_[fromFirst[apex[i]]], n);
      right[i] = costsFrom(splits_[fromLast[apex[i]]], n);
    }
    cost += leastOfLanes(left[0], left[1], left[2], left[3]) +
            leastOfLanes(right[0], right[1], right[2], right[3]);
    const Float4 never = Float4{} + kNever;
    store(&t.cost[q], squared > 1e-12f * ee * dd && squared > 1e-30f ? cost : never);
    store(&t.x[q], nx), store(&t.y[q], ny), store(&t.z[q], nz);
  }
  for (uint32_t q = t.count; q % 4 != 0; ++q) t.cost[q] = kNever;
}

/// The cheapest of the tried splits, without those that another makes needless.
inline void PolygonChart::choose(Tried& t, Splits& s, Segment& segment) const {
  for (uint32_t k = 0; k < kSplits; ++k) {
    Float4 least = load(&t.cost[0]);
    Int4 at = {0, 1, 2, 3}, here = at;
    for (uint32_t q = 4; q < t.count; q += 4) {
      here += 4;
      const Float4 cost = load(&t.cost[q]);
      at = cost < least ? here : at;
      least = smaller(least, cost);
    }
    float cost = least[0];
    uint32_t best = uint32_t(at[0]);
    for (uint32_t i = 1; i < 4; ++i) {
      const bool isLess = least[i] < cost;
      best = isLess ? uint32_t(at[i]) : best;
      cost = isLess ? least[i] : cost;
    }
    if (!(cost < kNever)) return;
    s.cost[k] = cost, s.x[k] = t.x[best], s.y[k] = t.y[best], s.z[k] = t.z[best];
    segment.apex[k] = t.apex[best];
    if (k + 1 == kSplits) return;
    const Float4 zero = {}, x = zero + t.x[best], y = zero + t.y[best], z = zero + t.z[best];
    t.cost[best] = kNever;
    for (uint32_t q = 0; q < t.count; q += 4) {
      const Float4 c = load(&t.cost[q]);
      const Float4 through = cost + angles(x, y, z, load(&t.x[q]), load(&t.y[q]), load(&t.z[q]));
      store(&t.cost[q], c < through ? c : zero + kNever);
    }
  }
}

/// The least bound of the apexes of a segment: the cost of what lies behind their triangles. If
/// `wanted`, keeps all bounds, up to a multiple of four.
template <bool wanted>
inline float PolygonChart::boundApexes(uint32_t first, uint32_t last) {
  const float* left = &cost_[size_t(first) * n_ + first + 1];
  const float* right = &cost_[size_t(last) * n_ + first + 1];
  const uint32_t count = last - first - 1, whole = count & ~3u;
  const Float4 never = Float4{} + kNever;
  Float4 least = never;
  for (uint32_t x = 0; x < whole; x += 4) {
    const Float4 b = load(left + x) + load(right + x);
    least = smaller(least, b);
    if (wanted) store(&bound_[x], b);
  }
  if (whole < count) {
    Float4 rest = never;
    for (uint32_t x = whole; x < count; ++x) rest[x - whole] = left[x] + right[x];
    least = smaller(least, rest);
    if (wanted) store(&bound_[whole], rest);
  }
  return std::min(std::min(least[0], least[1]), std::min(least[2], least[3]));
}

/// Takes the apexes whose bound is at most `most` into apexes_.
inline void PolygonChart::selectApexes(uint32_t first, uint32_t last, float most) {
  const uint32_t count = last - first - 1;
  uint32_t chosen = 0;
  for (uint32_t x = 0; x < count; x += 4) {
    if (!any(load(&bound_[x]) <= most)) continue;
    for (uint32_t i = x; i < x + 4; ++i) {
      apexes_[chosen] = first + 1 + i;
      chosen += bound_[i] <= most;
    }
  }
  apexCount_ = chosen;
}

/// Drops from apexes_ those whose bound is above `most`.
inline void PolygonChart::narrowApexes(uint32_t first, float most) {
  uint32_t chosen = 0;
  for (uint32_t q = 0; q < apexCount_; ++q) {
    const uint32_t apex = apexes_[q];
    apexes_[chosen] = apex;
    chosen += bound_[apex - first - 1] <= most;
  }
  apexCount_ = chosen;
}

/// Chooses the cheap ones among the splits at apexes_.
void PolygonChart::tryApexes(uint32_t first, uint32_t last, Splits& s, Segment& segment) {
  Tried& t = tried_;
  t.count = 0;
  for (uint32_t q = 0; q < apexCount_;) {
    // The best of the apexes tried before stay in.
    while (t.count < kRoom && q < apexCount_) t.apex[t.count++] = apexes_[q++];
    for (uint32_t i = t.count; i % 4 != 0; ++i) t.apex[i] = t.apex[0];
    weigh(first, last, t);
    s = noSplits();
    segment = {first, last, {kNone, kNone, kNone, kNone}};
    choose(t, s, segment);
    t.count = 0;
    for (uint32_t k = 0; k < kSplits && s.cost[k] < kNever; ++k)
      t.apex[t.count++] = segment.apex[k];
  }
}

/// The cheap splits of a segment; false if it has none. Some may be missed.
bool PolygonChart::split(uint32_t first, uint32_t last, Splits& s, Segment& segment) {
  const float least = boundApexes<true>(first, last);
  if (least == kNever) return false;
  s = noSplits();
  if (last - first > kTryAll) {
    float gap = gap_;
    selectApexes(first, last, least + gap);
    for (int n = 0; n < kMostNarrowings && apexCount_ > kManyApexes; ++n)
      narrowApexes(first, least + (gap *= kNarrower));
    tryApexes(first, last, s, segment);
    const float own = kOwnGap * (s.cost[0] - least);
    if (own < kNever && own > kWider * gap) {
      selectApexes(first, last, least + own);
      tryApexes(first, last, s, segment);
    }
  }
  if (!(s.cost[0] < kNever)) {
    selectApexes(first, last, kMost);
    tryApexes(first, last, s, segment);
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
  number_[size_t(segment.first) * n_ + segment.last] = number;
  number_[size_t(segment.last) * n_ + segment.first] = number;
}

/// Segments of one edge: free, or seen by the face across it.
void PolygonChart::addEdges() {
  for (uint32_t i = 0; i + 1 < n_; ++i) {
    Splits s = noSplits();
    // A zero normal is at a right angle to all; the cost of that angle is subtracted here.
    const Splits none = {};
    s.cost[0] = -costsFrom(none, {0, 0, 0})[0];
    if (corners_[i].hasFace) {
      const Vec3 face = corners_[i].normal;
      s.cost[0] = 0, s.x[0] = float(face.x), s.y[0] = float(face.y), s.z[0] = float(face.z);
    }
    keep(s, {i, i + 1, {kNone, kNone, kNone, kNone}});
  }
}

/// What segments of the short length cost on average, shared out among the edges they span.
void PolygonChart::findPrices() {
  std::vector<double> change(n_ + 1, 0), count(n_ + 1, 0);
  for (uint32_t i = 0; i + kShortSegment < n_; ++i) {
    const float cost = cost_[size_t(i) * n_ + i + kShortSegment];
    if (!(cost < kNever)) continue;
    change[i] += cost / kShortSegment, change[i + kShortSegment] -= cost / kShortSegment;
    count[i] += 1, count[i + kShortSegment] -= 1;
  }
  price_.assign(n_, 0);
  double sum = 0, segments = 0;
  for (uint32_t i = 0; i + 1 < n_; ++i) {
    sum += change[i], segments += count[i];
    price_[i + 1] = price_[i] + (segments > 0 ? float(sum / segments) : 0);
  }
}

/// Keeps the `count` least of the ranked segments.
void PolygonChart::keepLeast(std::vector<Ranked>& ranked, size_t count) {
  if (ranked.size() <= count) return;
  const auto end = ranked.begin() + std::ptrdiff_t(count);
  std::nth_element(ranked.begin(), end, ranked.end());
  ranked.erase(end, ranked.end());
}

/// Of the segments of one length, those with the least bounds are split, and of these the cheapest
/// are kept: all of them while there are few. Both are compared with what such a stretch of the
/// polygon costs on average. Otherwise segments where it is smooth would drive out all others.
bool PolygonChart::computeLength(uint32_t length) {
  const uint32_t count = n_ - length;
  const size_t most = mostKept(n_, length);
  const bool keepAll = most == count;
  if (!keepAll && price_.empty()) findPrices();
  ranked_.clear();
  for (uint32_t i = 0; i < count; ++i) {
    if (!work_.tick(20 + length / 2)) return false;
    const float bound = keepAll ? 0 : boundApexes<false>(i, i + length) - price(i, i + length);
    if (bound < kNever) ranked_.push_back({bound, i});
  }
  keepLeast(ranked_, size_t(kSplitPerKept * double(most)));
  gapSum_ = 0;
  std::vector<Splits> splits;
  std::vector<Segment> segments;
  std::vector<Ranked> kept;
  Splits s;
  Segment segment;
  for (const Ranked& r : ranked_) {
    if (!work_.tick(200 + length / 2)) return false;
    const uint32_t first = r.second, last = first + length;
    if (!split(first, last, s, segment)) continue;
    if (keepAll) {
      keep(s, segment);
      continue;
    }
    kept.push_back({s.cost[0] - price(first, last), uint32_t(splits.size())});
    splits.push_back(s);
    segments.push_back(segment);
  }
  if (!ranked_.empty()) gap_ = kUsualGap * gapSum_ / float(ranked_.size());
  keepLeast(kept, most);
  for (const Ranked& r : kept) keep(splits[r.second], segments[r.second]);
  return true;
}

/// The face across the edge that closes the polygon.
void PolygonChart::weighRoot() {
  const Corner& corner = corners_[n_ - 1];
  if (!corner.hasFace || cost_[n_ - 1] == kNever) return;
  Splits& s = splits_[number_[n_ - 1]];
  const Vec3 f = corner.normal;
  s.cost = costsFrom(s, {float(f.x), float(f.y), float(f.z)});
}

bool PolygonChart::compute(std::vector<Corner> corners) {
  corners_ = std::move(corners);
  n_ = uint32_t(corners_.size());
  const uint64_t bytes = uint64_t(bytesFor(n_));
  if (bytes > charged_ && !memory_.add(bytes - charged_)) return false;
  charged_ = std::max(charged_, bytes);
  positions_.clear();
  const Vec3 origin = loops_.position(corners_[0].vertex);
  for (const Corner& c : corners_) {
    const Vec3 p = loops_.position(c.vertex) - origin;
    positions_.push_back({float(p.x), float(p.y), float(p.z)});
  }
  splits_.clear(), splits_.reserve(size_t(mostKept(n_)));
  segments_.clear(), segments_.reserve(size_t(mostKept(n_)));
  gap_ = 0;
  price_.clear();
  cost_.assign(size_t(n_) * n_, kNever);
  number_.resize(size_t(n_) * n_);
  bound_.resize(n_ + 4);
  apexes_.resize(n_ + 4);
  addEdges();
  for (uint32_t length = 2; length < n_; ++length)
    if (!computeLength(length)) return false;
  best_ = kInfinity;
  if (cost_[n_ - 1] == kNever) return true;
  weighRoot();
  const Splits& root = splits_[number_[n_ - 1]];
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
    const uint32_t number = number_[size_t(open.first) * n_ + open.last];
    const Splits& s = splits_[number];
    // At the root no normal is across, so the angle is the same for all.
    const Float4 cost = costsFrom(s, open.across);
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
  // From the root inwards: the excess of a split is that of the triangle across, plus what it costs
  // there beyond the best split.
  std::vector<float> excess(kSplits * splits_.size(), kNever);
  std::vector<std::vector<uint32_t>> byLength(n_);
  std::vector<uint8_t> isReached(splits_.size(), 0);
  const uint32_t root = number_[n_ - 1];
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
        for (const uint32_t part : {number_[size_t(segment.first) * n_ + apex],
                                    number_[size_t(segment.last) * n_ + apex]}) {
          const Segment& inner = segments_[part];
          if (inner.last - inner.first == 1) continue;
          const Splits& c = splits_[part];
          const Float4 costs = costsFrom(c, n);
          const float least = std::min(std::min(costs[0], costs[1]), std::min(costs[2], costs[3]));
          bool any = false;
          for (uint32_t r = 0; r < kSplits && c.cost[r] < kNever; ++r) {
            const float x = e + costs[r] - least;
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
