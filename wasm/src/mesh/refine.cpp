#include "mesh/refine.h"

#include <cmath>

#include "base/charge.h"
#include "base/vec.h"
#include "mesh/mesh.h"
#include "triangles/triangle_mesh.h"

namespace sf {
namespace {

// More rounds than ever needed: each divides triangles of the first length into such of half of it.
constexpr uint32_t kRounds = 64;
// Vertices that settle lie farther apart than those of Liepa, by about a fifth.
constexpr double kSettling = 1.2;
// Vertices in a patch to regular triangles with sides of the scale: measured.
constexpr double kPredicted = 0.25;
// How often a patch is refined whose prediction was too low, and to what share of it that is lowered, more each time.
constexpr int kAttempts = 5;
constexpr double kFewer = 0.9;

/// A set of edges between vertices: open addressing, linear probing.
class EdgeSet {
 public:
  explicit EdgeSet(Charge& charge) : charge_(charge) {}

  bool contains(uint32_t a, uint32_t b) const {
    return !slots_.empty() && slots_[find(key(a, b))] != kEmpty;
  }
  /// False beyond the memory limit.
  bool add(uint32_t a, uint32_t b) {
    if (2 * (count_ + 1) > slots_.size() && !grow()) return false;
    uint64_t& slot = slots_[find(key(a, b))];
    if (slot == kEmpty) slot = key(a, b), ++count_;
    return true;
  }
  void remove(uint32_t a, uint32_t b) {
    size_t hole = find(key(a, b));
    if (slots_[hole] == kEmpty) return;
    --count_;
    // What was pushed on by the one that goes moves back.
    const size_t mask = slots_.size() - 1;
    for (size_t i = (hole + 1) & mask; slots_[i] != kEmpty; i = (i + 1) & mask) {
      if (((i - home(slots_[i])) & mask) < ((i - hole) & mask)) continue;
      slots_[hole] = slots_[i], hole = i;
    }
    slots_[hole] = kEmpty;
  }

 private:
  static constexpr uint64_t kEmpty = ~uint64_t(0);
  static uint64_t key(uint32_t a, uint32_t b) {
    return a < b ? uint64_t(a) << 32 | b : uint64_t(b) << 32 | a;
  }
  size_t home(uint64_t k) const {
    return size_t((k * 0x9E3779B97F4A7C15u) >> 32) & (slots_.size() - 1);
  }
  size_t find(uint64_t k) const {
    size_t i = home(k);
    while (slots_[i] != kEmpty && slots_[i] != k) i = (i + 1) & (slots_.size() - 1);
    return i;
  }
  bool grow() {
    const size_t size = slots_.empty() ? 64 : 2 * slots_.size();
    if (!charge_.add(8 * uint64_t(size))) return false;
    std::vector<uint64_t> old(size, kEmpty);
    old.swap(slots_);
    for (const uint64_t k : old)
      if (k != kEmpty) slots_[find(k)] = k;
    return true;
  }

  Charge& charge_;
  std::vector<uint64_t> slots_;
  size_t count_ = 0;
};

/// A patch while it is refined.
class Refinement {
 public:
  Refinement(const LocalSurface& surface, Work& work)
      : surface_(surface), work_(work), charge_(work), edges_(charge_) {}

  bool begin();
  bool findScales(double density);
  /// How many vertices a patch of this shape has about, with these scales.
  double predicted() const;
  /// Makes edges longer until by that prediction there are at most so many.
  void coarsen(double most);
  /// False when the work ended. `isEnough`: whether `maxNewVertices` were enough.
  bool divide(uint32_t maxNewVertices, bool& isEnough);
  bool flipAll();
  bool settle(uint32_t times);
  void finish(LocalSurface& result);

 private:
  Vec3 normal(uint32_t a, uint32_t b, uint32_t c) const {
    return cross(at_[b] - at_[a], at_[c] - at_[a]);
  }
  Vec3 normal(uint32_t t) const {
    return normal(mesh_.corners[3 * t], mesh_.corners[3 * t + 1], mesh_.corners[3 * t + 2]);
  }
  bool wantsFlip(uint32_t h) const;
  bool flip(uint32_t h);
  bool flipPending();
  bool isDivisible(uint32_t t, Vec3& centre, double& scale) const;
  bool split(uint32_t t, Vec3 centre, double scale);
  bool spreadScales(ArrayView<const uint8_t> isKnown);

  const LocalSurface& surface_;
  Work& work_;
  Charge charge_;
  TriangleMesh mesh_;              // the patch alone
  EdgeSet edges_;                  // of the patch and its surroundings
  std::vector<Vec3> at_;           // [n]
  std::vector<double> scale_;      // [n] how long edges should be, times 1 / density
  std::vector<uint32_t> pending_;  // half-edges to look at
};

bool Refinement::begin() {
  const size_t n = surface_.positions.size() / 3,
               corners = surface_.triangles.size() - 3 * size_t(surface_.fixedTriangles);
  if (!reserve(at_, n, charge_) || !charge_.add(8 * uint64_t(corners))) return false;
  for (size_t v = 0; v < n; ++v) at_.push_back(pointAt(surface_.positions, v));
  mesh_.corners.assign(surface_.triangles.begin() + ptrdiff_t(3 * size_t(surface_.fixedTriangles)),
                       surface_.triangles.end());
  // Flips join vertices of the patch: other edges around it are not in the way.
  std::vector<uint8_t> isPatch(n, 0);
  for (const uint32_t v : mesh_.corners) isPatch[v] = 1;
  for (uint32_t h = 0; h < surface_.triangles.size(); ++h) {
    const uint32_t a = surface_.triangles[h], b = surface_.triangles[nextInTriangle(h)];
    if (isPatch[a] && isPatch[b] && !edges_.add(a, b)) return false;
  }
  return findTwins(mesh_.corners, uint32_t(n), work_, mesh_.twins);
}

/// Whether the angles opposite an inner edge sum to more than pi, and its flip does no harm.
bool Refinement::wantsFlip(uint32_t h) const {
  const uint32_t g = mesh_.twins[h];
  if (g == kNone) return false;
  const uint32_t a = mesh_.from(h), b = mesh_.to(h), c = mesh_.apex(h), d = mesh_.apex(g);
  if (a == b || c == d) return false;
  const Vec3 n1 = normal(a, b, c), n2 = normal(b, a, d);
  const double sin1 = length(n1), sin2 = length(n2);
  const double cos1 = dot(at_[a] - at_[c], at_[b] - at_[c]),
               cos2 = dot(at_[a] - at_[d], at_[b] - at_[d]);
  // The sine of the sum. A part of it has to be left, or four points on a circle would turn for ever.
  const double sum = cos1 * sin2 + cos2 * sin1;
  if (!(sum < -1e-9 * (std::fabs(cos1) * sin2 + std::fabs(cos2) * sin1))) return false;
  const Vec3 both = n1 + n2, n3 = normal(a, d, c), n4 = normal(b, c, d);
  return dot(n3, both) > 0 && dot(n4, both) > 0 && dot(n3, n4) > 0 && !edges_.contains(c, d);
}

bool Refinement::flip(uint32_t h) {
  const uint32_t g = mesh_.twins[h];
  edges_.remove(mesh_.from(h), mesh_.to(h));
  if (!edges_.add(mesh_.apex(h), mesh_.apex(g))) return false;
  mesh_.flip(h);
  for (const uint32_t side : {h, prevInTriangle(h), g, prevInTriangle(g)})
    if (!push(pending_, side, charge_)) return false;
  return true;
}

bool Refinement::flipPending() {
  // In space flips need not end by themselves.
  size_t budget = 4 * pending_.size() + 64;
  while (!pending_.empty()) {
    const uint32_t h = pending_.back();
    pending_.pop_back();
    if (!work_.tick(60)) return false;
    if (budget == 0 || !wantsFlip(h)) continue;
    --budget;
    if (!flip(h)) return false;
  }
  return true;
}

bool Refinement::flipAll() {
  for (uint32_t h = 0; h < mesh_.corners.size(); ++h)
    if (mesh_.twins[h] != kNone && mesh_.twins[h] > h && !push(pending_, h, charge_)) return false;
  return flipPending();
}

/// Scales of the rim from the edges of the surroundings, those inside from the rim.
bool Refinement::findScales(double density) {
  const size_t n = at_.size();
  if (!reserve(scale_, n, charge_) || !charge_.add(uint64_t(n) * 9)) return false;
  scale_.assign(n, 0);
  std::vector<double> count(n, 0);
  const size_t fixed = 3 * size_t(surface_.fixedTriangles);
  const auto measure = [&](size_t h) {
    const uint32_t a = surface_.triangles[h], b = surface_.triangles[nextInTriangle(uint32_t(h))];
    const double l = distance(at_[a], at_[b]);
    scale_[a] += l, scale_[b] += l, ++count[a], ++count[b];
  };
  for (size_t h = 0; h < fixed; ++h) measure(h);
  // A rim without surroundings is all that there is to measure.
  std::vector<uint8_t> isKnown(n, 0);
  for (size_t v = 0; v < n; ++v) isKnown[v] = count[v] > 0;
  for (size_t h = fixed; h < surface_.triangles.size(); ++h) {
    const uint32_t a = surface_.triangles[h], b = surface_.triangles[nextInTriangle(uint32_t(h))];
    if (mesh_.twins[h - fixed] == kNone && !isKnown[a] && !isKnown[b]) measure(h);
  }
  for (size_t v = 0; v < n; ++v) {
    isKnown[v] = v < surface_.fixedVertices && count[v] > 0;
    scale_[v] = isKnown[v] ? scale_[v] / (count[v] * density * kSettling) : 0;
  }
  return spreadScales(isKnown);
}

double Refinement::predicted() const {
  double sum = 0;
  for (uint32_t t = 0; t < mesh_.triangleCount(); ++t) {
    double s = 0;
    for (int k = 0; k < 3; ++k) s += scale_[mesh_.corners[3 * t + k]] / 3;
    if (s > 0) sum += kPredicted * 0.5 * length(normal(t)) / (std::sqrt(3.0) / 4 * s * s);
  }
  return sum;
}

void Refinement::coarsen(double most) {
  const double factor = std::sqrt(predicted() / most);
  if (factor > 1)
    for (double& s : scale_) s *= factor;
}

/// Scales of vertices inside the patch: the mean of their neighbours', from the rim inwards and then evened out.
bool Refinement::spreadScales(ArrayView<const uint8_t> isKnown) {
  const size_t n = at_.size();
  std::vector<double> sum(n), count(n);
  if (!charge_.add(16 * uint64_t(n))) return false;
  bool isOpen = true;
  for (uint32_t round = 0, extra = 0; extra < 16 && round < 10000; ++round) {
    sum.assign(n, 0), count.assign(n, 0);
    for (uint32_t h = 0; h < mesh_.corners.size(); ++h) {
      const uint32_t a = mesh_.from(h), b = mesh_.to(h);
      if (scale_[a] > 0) sum[b] += scale_[a], ++count[b];
      if (scale_[b] > 0) sum[a] += scale_[b], ++count[a];
    }
    const bool wasOpen = isOpen;
    isOpen = false;
    bool isNew = false;
    for (const uint32_t v : mesh_.corners) {
      if (isKnown[v]) continue;
      if (count[v] > 0) isNew = isNew || scale_[v] == 0, scale_[v] = sum[v] / count[v];
      isOpen = isOpen || scale_[v] == 0;
    }
    // Whole parts may have no rim: they stay as they are.
    if (isOpen && !isNew) break;
    if (!wasOpen) ++extra;
    if (!work_.tick(uint64_t(mesh_.corners.size()) * 8)) return false;
  }
  return true;
}

/// Liepa's criterion: the centroid lies farther from each corner than the scales of both ask for.
bool Refinement::isDivisible(uint32_t t, Vec3& centre, double& scale) const {
  const uint32_t* v = &mesh_.corners[3 * t];
  centre = (1.0 / 3) * (at_[v[0]] + at_[v[1]] + at_[v[2]]);
  scale = (scale_[v[0]] + scale_[v[1]] + scale_[v[2]]) / 3;
  for (int k = 0; k < 3; ++k) {
    const double d = distance(centre, at_[v[k]]);
    if (!(d > scale && d > scale_[v[k]] && scale_[v[k]] > 0)) return false;
  }
  return true;
}

bool Refinement::split(uint32_t t, Vec3 centre, double scale) {
  const uint32_t v = uint32_t(at_.size());
  if (!push(at_, centre, charge_) || !push(scale_, scale, charge_) || !charge_.add(6 * 8))
    return false;
  for (int k = 0; k < 3; ++k)
    if (!edges_.add(v, mesh_.corners[3 * t + k])) return false;
  mesh_.splitTriangle(3 * t, v);
  const uint32_t first = 3 * t;
  // The three sides of the triangle that was: those of the triangles around v that do not touch it.
  for (const uint32_t h : {first, mesh_.triangleCount() * 3 - 6, mesh_.triangleCount() * 3 - 3})
    if (!push(pending_, h, charge_)) return false;
  return true;
}

bool Refinement::divide(uint32_t maxNewVertices, bool& isEnough) {
  uint32_t left = maxNewVertices;
  isEnough = true;
  for (uint32_t round = 0; round < kRounds; ++round) {
    const uint32_t count = mesh_.triangleCount();
    bool isDone = true;
    for (uint32_t t = 0; t < count && isEnough; ++t) {
      Vec3 centre;
      double scale;
      if (!work_.tick(40)) return false;
      if (!isDivisible(t, centre, scale)) continue;
      if (left == 0) {
        isEnough = false;
        break;
      }
      if (!split(t, centre, scale)) return false;
      isDone = false, --left;
    }
    if (!flipPending() || !flipAll()) return false;
    if (isDone) break;
  }
  return true;
}

/// Moves inner vertices, in the plane that touches the surface there, to the middle of their triangles.
bool Refinement::settle(uint32_t times) {
  const size_t n = at_.size(), first = surface_.fixedVertices;
  if (!charge_.add(uint64_t(n - first) * (8 + 2 * sizeof(Vec3)))) return false;
  std::vector<double> weight(n - first);
  std::vector<Vec3> sum(n - first), across(n - first);
  for (uint32_t i = 0; i < times; ++i) {
    weight.assign(n - first, 0), sum.assign(n - first, Vec3{0, 0, 0}),
        across.assign(n - first, Vec3{0, 0, 0});
    for (uint32_t t = 0; t < mesh_.triangleCount(); ++t) {
      const uint32_t* v = &mesh_.corners[3 * t];
      const Vec3 across3 = normal(t), centre = (1.0 / 3) * (at_[v[0]] + at_[v[1]] + at_[v[2]]);
      const double s = (scale_[v[0]] + scale_[v[1]] + scale_[v[2]]) / 3;
      // Triangles count by their area in units of what it should be, so that a graded density stays.
      const double w = length(across3) / (s > 0 ? s * s : 1);
      for (int k = 0; k < 3; ++k) {
        if (v[k] < first) continue;
        weight[v[k] - first] += w, sum[v[k] - first] = sum[v[k] - first] + w * centre;
        across[v[k] - first] = across[v[k] - first] + across3;
      }
    }
    for (size_t v = 0; v < n - first; ++v) {
      const double square = dot(across[v], across[v]);
      if (!(weight[v] > 0) || !(square > 0)) {
        sum[v] = at_[v + first];
        continue;
      }
      const Vec3 step = (1 / weight[v]) * sum[v] - at_[v + first];
      sum[v] = at_[v + first] + 0.7 * (step - (dot(step, across[v]) / square) * across[v]);
    }
    // All at once; then those of triangles that would turn over go back.
    std::vector<uint8_t> goesBack(n - first, 0);
    for (uint32_t t = 0; t < mesh_.triangleCount(); ++t) {
      const uint32_t* v = &mesh_.corners[3 * t];
      const auto moved = [&](uint32_t u) { return u < first ? at_[u] : sum[u - first]; };
      const Vec3 a = moved(v[0]), old = normal(t), now = cross(moved(v[1]) - a, moved(v[2]) - a);
      if (dot(old, now) > 0.1 * dot(old, old)) continue;
      for (int k = 0; k < 3; ++k)
        if (v[k] >= first) goesBack[v[k] - first] = 1;
    }
    for (size_t v = 0; v < n - first; ++v)
      if (!goesBack[v]) at_[v + first] = sum[v];
    if (!work_.tick(uint64_t(mesh_.triangleCount()) * 100) || !flipAll()) return false;
  }
  return true;
}

void Refinement::finish(LocalSurface& result) {
  result.positions.resize(3 * at_.size());
  for (size_t v = surface_.fixedVertices; v < at_.size(); ++v)
    result.positions[3 * v] = at_[v].x, result.positions[3 * v + 1] = at_[v].y,
                         result.positions[3 * v + 2] = at_[v].z;
  result.triangles.resize(3 * size_t(surface_.fixedTriangles));
  result.triangles.insert(result.triangles.end(), mesh_.corners.begin(), mesh_.corners.end());
}

}  // namespace

Status refine(LocalSurface& surface, const RefineOptions& options, Work& work) {
  if (!(options.density > 0)) return work.status();
  // Where the prediction was too low, the last parts of the patch would stay coarse: again, with fewer vertices.
  double most = options.maxNewVertices;
  for (int attempt = 1;; ++attempt) {
    Refinement refinement(surface, work);
    bool isEnough;
    if (!refinement.begin() || !refinement.findScales(options.density)) return work.status();
    most = std::fmin(most, refinement.predicted());
    if (most > 0) refinement.coarsen(most);
    if (!refinement.flipAll() || !refinement.divide(options.maxNewVertices, isEnough))
      return work.status();
    if (isEnough || attempt == kAttempts || options.maxNewVertices == 0) {
      if (refinement.settle(options.settlings)) refinement.finish(surface);
      return work.status();
    }
    most *= std::pow(kFewer, attempt);
  }
}

Status relax(LocalSurface& surface, uint32_t settlings, Work& work) {
  Refinement refinement(surface, work);
  if (refinement.begin() && refinement.findScales(RefineOptions{}.density) &&
      refinement.flipAll() && refinement.settle(settlings))
    refinement.finish(surface);
  return work.status();
}

}  // namespace sf
