#include "loops/spaces/plain_polygon.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "loops/problem/weight.h"

namespace sf {
namespace {

/// Vertices count as collinear if the sine of the angle at a corner is at most this.
constexpr double kThin = 1e-6;

}  // namespace

TripleWeights::TripleWeights(const LoopSet& loops, const TriangleWeights& weights)
    : n_(loops.vertexCount()), weight_(size_t(n_) * n_ * n_, kInfinity) {
  for (uint32_t u = 0; u < n_; ++u)
    for (uint32_t v = u + 1; v < n_; ++v) {
      const Vec3 p = loops.position(u), e = loops.position(v) - p;
      for (uint32_t w = v + 1; w < n_; ++w) {
        const Vec3 d = loops.position(w) - p;
        const double doubled = length(cross(e, d)), a = length(e), b = length(d);
        if (!(doubled > kThin * a * b)) continue;
        const double weight =
            0.5 * weights.area * doubled + weights.perimeter * (a + b + length(d - e));
        const uint32_t t[3] = {u, v, w};
        for (int i = 0; i < 3; ++i)
          for (const int j : {(i + 1) % 3, (i + 2) % 3})
            weight_[(size_t(t[i]) * n_ + t[j]) * n_ + t[3 - i - j]] = weight;
      }
    }
}

void PlainPolygon::compute(std::vector<uint32_t> vertices) {
  vertices_ = std::move(vertices);
  const uint32_t m = size();
  cost_.assign(size_t(m) * m, kInfinity);
  apex_.assign(size_t(m) * m, kNone);
  for (uint32_t i = 0; i < m; ++i) cost_[size_t(i) * m + (i + 1) % m] = 0;
  for (uint32_t steps = 2; steps < m; ++steps)
    for (uint32_t first = 0; first < m; ++first) {
      const uint32_t last = (first + steps) % m;
      const uint32_t u = vertices_[first], v = vertices_[last];
      // A segment over a loop edge would give this edge a second triangle.
      if (u == v || (steps < m - 1 && loops_.isLoopEdge(u, v))) continue;
      double best = kInfinity;
      uint32_t apex = kNone;
      for (uint32_t k = (first + 1) % m; k != last; k = k + 1 == m ? 0 : k + 1) {
        const double sum = cost_[size_t(first) * m + k] + cost_[size_t(k) * m + last] +
                           weights_(u, v, vertices_[k]);
        if (sum < best) best = sum, apex = k;
      }
      cost_[size_t(first) * m + last] = best;
      apex_[size_t(first) * m + last] = apex;
    }
}

void PlainPolygon::trace(uint32_t first, uint32_t last, std::vector<uint32_t>& triples) const {
  std::vector<std::pair<uint32_t, uint32_t>> open{{first, last}};
  while (!open.empty()) {
    const auto [a, b] = open.back();
    open.pop_back();
    if ((a + 1) % size() == b) continue;
    const uint32_t apex = apex_[size_t(a) * size() + b];
    triples.insert(triples.end(), {vertices_[a], vertices_[apex], vertices_[b]});
    open.push_back({a, apex});
    open.push_back({apex, b});
  }
}

void PlainPolygon::nearBest(double limit, size_t most, std::vector<uint32_t>& triples) const {
  struct Found {
    double cost;
    uint32_t corner[3];
  };
  std::vector<Found> found;
  for (uint32_t i = 0; i < size(); ++i)
    for (uint32_t j = i + 1; j < size(); ++j) {
      const double one = cost(i, j);
      if (!(one <= limit)) continue;
      for (uint32_t k = j + 1; k < size(); ++k) {
        const double sum = one + cost(j, k) + cost(k, i);
        if (!(sum <= limit)) continue;
        const double all = sum + weights_(vertices_[i], vertices_[j], vertices_[k]);
        if (all <= limit) found.push_back({all, {i, j, k}});
      }
    }
  if (found.size() > most) {
    const auto end = found.begin() + std::ptrdiff_t(most);
    std::nth_element(found.begin(), end, found.end(),
                     [](const Found& a, const Found& b) { return a.cost < b.cost; });
    found.erase(end, found.end());
  }
  for (const Found& f : found)
    for (const uint32_t c : f.corner) triples.push_back(vertices_[c]);
}

}  // namespace sf
