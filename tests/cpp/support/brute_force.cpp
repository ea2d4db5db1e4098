#include "support/brute_force.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/self_intersection.h"

namespace sftest {
namespace {

using sf::Vec3;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kEqualAngles = 1e-9;

/// Tables of everything that a surface over n vertices can cost.
struct Prices {
  uint32_t n = 0;
  std::vector<char> candidate;   // [n^3] by corners in any order
  std::vector<double> triangle;  // [n^3] weight of one triangle
  std::vector<double> fold;      // [n^4] angle over edge a-b between (a, b, c) and (b, a, d)
  std::vector<double> rim;       // [n^2] angle of (v, next(v), c) to the face across, by v and c
  double dihedralWeight = 0;
  bool worst = false;

  size_t at(uint32_t a, uint32_t b, uint32_t c) const { return (size_t(a) * n + b) * n + c; }
};

void setAllOrders(std::vector<double>& table, const Prices& p, uint32_t a, uint32_t b, uint32_t c,
                  double value) {
  table[p.at(a, b, c)] = table[p.at(b, c, a)] = table[p.at(c, a, b)] = value;
  table[p.at(a, c, b)] = table[p.at(c, b, a)] = table[p.at(b, a, c)] = value;
}

Prices freePrices(uint32_t n) {
  Prices p;
  p.n = n;
  p.candidate.assign(size_t(n) * n * n, 1);
  p.triangle.assign(p.candidate.size(), 0);
  p.fold.assign(p.candidate.size() * n, 0);
  p.rim.assign(size_t(n) * n, 0);
  return p;
}

Prices pricesOf(const sf::LoopSet& loops, const sf::SpanOptions& options) {
  uint32_t n = loops.vertexCount();
  Prices p = freePrices(n);
  p.dihedralWeight = options.dihedralWeight;
  p.worst = options.objective == sf::Objective::WorstDihedral;
  std::vector<double> own(p.triangle.size(), 0), listed(p.triangle.size(), 0);
  for (size_t i = 0; 3 * i < options.triangles.size(); ++i) {
    uint32_t a = options.triangles[3 * i], b = options.triangles[3 * i + 1],
             c = options.triangles[3 * i + 2];
    setAllOrders(listed, p, a, b, c, 1);
    if (!options.triangleWeights.empty()) setAllOrders(own, p, a, b, c, options.triangleWeights[i]);
  }
  auto normal = [&](uint32_t a, uint32_t b, uint32_t c) {
    Vec3 u = loops.position(b) - loops.position(a), v = loops.position(c) - loops.position(a);
    return Vec3{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
  };
  auto angle = [](Vec3 a, Vec3 b) {
    Vec3 c{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    return std::atan2(std::sqrt(c.x * c.x + c.y * c.y + c.z * c.z),
                      a.x * b.x + a.y * b.y + a.z * b.z);
  };
  for (uint32_t a = 0; a < n; ++a)
    for (uint32_t b = 0; b < n; ++b)
      for (uint32_t c = 0; c < n; ++c) {
        size_t abc = p.at(a, b, c);
        if (a == b || b == c || c == a) {
          p.candidate[abc] = 0;
          continue;
        }
        Vec3 pa = loops.position(a), pb = loops.position(b), pc = loops.position(c);
        p.candidate[abc] =
            !collinear(pa, pb, pc) && (options.space != sf::Space::Given || listed[abc] != 0);
        p.triangle[abc] =
            options.areaWeight * length(normal(a, b, c)) / 2 +
            options.perimeterWeight * (distance(pa, pb) + distance(pb, pc) + distance(pc, pa)) +
            own[abc];
        for (uint32_t d = 0; d < n; ++d)
          if (d != a && d != b) p.fold[abc * n + d] = angle(normal(a, b, c), normal(b, a, d));
        if (loops.next(a) == b && !options.boundaryNormals.empty()) {
          const double* face = &options.boundaryNormals[3 * a];
          if (!std::isnan(face[0]))
            p.rim[size_t(a) * n + c] = angle({face[0], face[1], face[2]}, normal(a, b, c));
        }
      }
  return p;
}

class Enumerator {
 public:
  Enumerator(const std::vector<uint32_t>& next, uint32_t loopCount, const Prices& prices)
      : n_(uint32_t(next.size())),
        size_(n_ + 2 * loopCount - 4),
        next_(next),
        previous_(next.size()),
        prices_(prices),
        apex_(size_t(n_) * n_, kNoApex),
        valence_(n_, 0),
        done_(n_, 0) {
    for (uint32_t v = 0; v < n_; ++v) previous_[next_[v]] = v;
    cheapest_ = kInfinity;
    for (size_t i = 0; i < prices.triangle.size(); ++i)
      if (prices.candidate[i]) cheapest_ = std::min(cheapest_, prices.triangle[i]);
  }

  /// Visits every surface, or with `prune` only those that may be better than the best so far.
  void run(bool prune) {
    prune_ = prune;
    // Loop edge 0 lies in exactly one triangle, and turning the surface over changes nothing.
    for (uint32_t c = 0; c < n_; ++c) tryTriangle(0, next_[0], c, 0);
  }

  uint64_t count = 0;
  double bestCost = kInfinity, bestSum = kInfinity;
  std::vector<uint32_t> best;

 private:
  static constexpr uint32_t kNoApex = 0xFFFFFFFF;
  struct Price {
    double sum = 0, worst = 0;
  };
  struct HalfEdge {
    uint32_t from, to;
  };

  uint32_t& apex(uint32_t a, uint32_t b) { return apex_[size_t(a) * n_ + b]; }
  bool isLoopEdge(uint32_t a, uint32_t b) const { return next_[a] == b || next_[b] == a; }

  /// Whether a triangle wound a, b, c fits: no edge is used twice in a direction, no loop edge
  /// twice at all, no vertex is closed already.
  bool fits(uint32_t a, uint32_t b, uint32_t c) {
    if (!prices_.candidate[prices_.at(a, b, c)] || done_[a] || done_[b] || done_[c]) return false;
    const uint32_t v[3] = {a, b, c};
    for (int i = 0; i < 3; ++i) {
      uint32_t from = v[i], to = v[(i + 1) % 3];
      if (apex(from, to) != kNoApex) return false;
      if (isLoopEdge(from, to) && apex(to, from) != kNoApex) return false;
    }
    return true;
  }

  /// Whether the fan at v that holds the half-edge v -> w may stay; sets done_[v] once it is whole.
  bool fanFits(uint32_t v, uint32_t w) {
    uint32_t last = w, first = w, length = 0;
    for (; apex(v, last) != kNoApex; last = apex(v, last))
      if (++length > valence_[v]) return false;  // a closed fan: v would be an interior vertex
    for (; apex(first, v) != kNoApex; first = apex(first, v)) ++length;
    bool whole = isLoopEdge(v, first) && isLoopEdge(v, last);
    if (whole && length != valence_[v]) return false;  // a pinch
    done_[v] = whole;
    return true;
  }

  double foldAngle(uint32_t a, uint32_t b, uint32_t c) {
    uint32_t d = apex(b, a);
    if (d != kNoApex) return prices_.fold[prices_.at(a, b, c) * n_ + d];
    if (next_[a] == b) return prices_.rim[size_t(a) * n_ + c];
    if (next_[b] == a) return prices_.rim[size_t(b) * n_ + c];
    return 0;
  }

  bool better(const Price& p, double tolerance) const {
    if (!prices_.worst) return p.sum < bestSum;
    if (p.worst < bestCost - tolerance) return true;
    return p.worst <= bestCost + tolerance && p.sum < bestSum;
  }

  void tryTriangle(uint32_t a, uint32_t b, uint32_t c, size_t head) {
    if (!fits(a, b, c)) return;
    Price before = price_;
    price_.sum += prices_.triangle[prices_.at(a, b, c)];
    for (double angle : {foldAngle(a, b, c), foldAngle(b, c, a), foldAngle(c, a, b)}) {
      price_.sum += prices_.dihedralWeight * angle;
      price_.worst = std::max(price_.worst, angle);
    }
    const uint32_t v[3] = {a, b, c};
    chosen_.insert(chosen_.end(), v, v + 3);
    size_t queued = open_.size();
    for (int i = 0; i < 3; ++i) {
      uint32_t from = v[i], to = v[(i + 1) % 3];
      apex(from, to) = v[(i + 2) % 3];
      ++valence_[from];
      if (!isLoopEdge(from, to) && apex(to, from) == kNoApex) open_.push_back({to, from});
    }
    size_t left = size_ - chosen_.size() / 3;
    Price bound{price_.sum + double(left) * cheapest_, price_.worst};
    if ((!prune_ || better(bound, kEqualAngles)) && fanFits(a, b) && fanFits(b, c) && fanFits(c, a))
      grow(head);
    for (int i = 0; i < 3; ++i) {
      apex(v[i], v[(i + 1) % 3]) = kNoApex;
      --valence_[v[i]];
      done_[v[i]] = 0;
    }
    open_.resize(queued);
    chosen_.resize(chosen_.size() - 3);
    price_ = before;
  }

  void grow(size_t head) {
    while (head < open_.size() && apex(open_[head].from, open_[head].to) != kNoApex) ++head;
    if (head == open_.size()) {
      // Nothing is open: with every vertex's only fan whole and this many triangles, it is a
      // sphere with k holes.
      if (chosen_.size() != 3 * size_ || std::count(done_.begin(), done_.end(), 1) != n_) return;
      ++count;
      if (!better(price_, kEqualAngles)) return;
      bestCost = prices_.worst ? price_.worst : price_.sum;
      bestSum = price_.sum;
      best = chosen_;
      return;
    }
    if (chosen_.size() == 3 * size_) return;
    HalfEdge edge = open_[head];
    for (uint32_t c = 0; c < n_; ++c) tryTriangle(edge.from, edge.to, c, head + 1);
  }

  uint32_t n_;
  size_t size_;  // triangles of a whole surface
  std::vector<uint32_t> next_, previous_;
  const Prices& prices_;
  std::vector<uint32_t> apex_;     // [n^2] apex of the triangle on the half-edge a -> b
  std::vector<uint32_t> valence_;  // [n] triangles at each vertex
  std::vector<char> done_;         // [n] whether the fan of a vertex is whole
  std::vector<HalfEdge> open_;     // half-edges that await a triangle, oldest first
  std::vector<uint32_t> chosen_;
  Price price_;
  double cheapest_;
  bool prune_ = false;
};

}  // namespace

BruteForceAnswer bruteForceOptimum(const sf::LoopSet& loops, const sf::SpanOptions& options) {
  std::vector<uint32_t> next(loops.vertexCount());
  for (uint32_t v = 0; v < next.size(); ++v) next[v] = loops.next(v);
  Prices prices = pricesOf(loops, options);
  Enumerator enumerator(next, loops.loopCount(), prices);
  enumerator.run(true);
  return {enumerator.count > 0, enumerator.bestCost, enumerator.bestSum, enumerator.best};
}

uint64_t countSurfaces(const std::vector<uint32_t>& sizes) {
  std::vector<uint32_t> next;
  for (uint32_t size : sizes) {
    uint32_t first = uint32_t(next.size());
    for (uint32_t i = 0; i < size; ++i) next.push_back(first + (i + 1) % size);
  }
  Prices prices = freePrices(uint32_t(next.size()));
  for (uint32_t a = 0; a < next.size(); ++a)
    for (uint32_t b = 0; b < next.size(); ++b)
      for (uint32_t c : {a, b})
        prices.candidate[prices.at(a, b, c)] = prices.candidate[prices.at(a, c, b)] =
            prices.candidate[prices.at(c, a, b)] = 0;
  Enumerator enumerator(next, uint32_t(sizes.size()), prices);
  enumerator.run(false);
  return enumerator.count;
}

}  // namespace sftest
