#include "polygon/certificate.h"

#include "base/charge.h"
#include "polygon/turn.h"

namespace sf {
namespace {

/// Sums of directed edges, in which u -> v and v -> u cancel.
class EdgeSum {
 public:
  explicit EdgeSum(const Certificate& c) : c_(c), starts_(c.at.size() + 1, 0) {}

  /// Every edge is counted first, and then added in the same way.
  void count(uint32_t u, uint32_t v) {
    u = c_.same[u], v = c_.same[v];
    ++starts_[(u < v ? u : v) + 1];
  }
  void endCount() {
    for (size_t v = 0; v + 1 < starts_.size(); ++v) starts_[v + 1] += starts_[v];
    edges_.resize(starts_.back());
    fill_ = starts_;
  }
  void add(uint32_t u, uint32_t v) {
    u = c_.same[u], v = c_.same[v];
    edges_[fill_[u < v ? u : v]++] = u < v ? 2 * v : 2 * u + 1;
  }
  /// Whether everything cancels.
  bool isZero() {
    std::vector<int32_t> sum(c_.at.size(), 0);
    for (size_t u = 0; u + 1 < starts_.size(); ++u) {
      for (uint32_t i = starts_[u]; i < starts_[u + 1]; ++i)
        // Links between points at one place are no edges.
        sum[edges_[i] / 2] += edges_[i] / 2 == u ? 0 : edges_[i] % 2 ? -1 : 1;
      for (uint32_t i = starts_[u]; i < starts_[u + 1]; ++i)
        if (sum[edges_[i] / 2] != 0) return false;
    }
    return true;
  }

 private:
  const Certificate& c_;
  std::vector<uint32_t> starts_, fill_, edges_;
};

/// Whether the boundary of the triangles is that of the rings, or of the frame less the rings.
bool boundsRings(const Certificate& c, const std::vector<uint32_t>& triangles, bool frame) {
  EdgeSum sum(c);
  const auto forAll = [&](auto&& edge) {
    for (size_t i = 0; i < triangles.size(); i += 3) {
      edge(triangles[i], triangles[i + 1]);
      edge(triangles[i + 1], triangles[i + 2]);
      edge(triangles[i + 2], triangles[i]);
    }
    for (size_t i = 0; i < c.rings.size(); i += 2)
      frame ? edge(c.rings[i], c.rings[i + 1]) : edge(c.rings[i + 1], c.rings[i]);
    const uint32_t first = uint32_t(c.at.size()) - 4;
    for (uint32_t k = 0; frame && k < 4; ++k) edge(first + (k + 1) % 4, first + k);
  };
  forAll([&](uint32_t u, uint32_t v) { sum.count(u, v); });
  sum.endCount();
  forAll([&](uint32_t u, uint32_t v) { sum.add(u, v); });
  return sum.isZero();
}

bool noneTurnedOver(const Certificate& c, const std::vector<uint32_t>& triangles) {
  for (size_t i = 0; i < triangles.size(); i += 3)
    if (!(turn(c.at[triangles[i]], c.at[triangles[i + 1]], c.at[triangles[i + 2]]) >= 0))
      return false;
  return true;
}

}  // namespace

bool certify(const Certificate& c, Work& work) {
  Charge charge(work);
  const size_t most = c.inside.size() > c.complement.size() ? c.inside.size() : c.complement.size();
  if (!charge.add(4 * (3 * uint64_t(c.at.size()) + most + c.rings.size()))) return false;
  for (size_t v = 0; v < c.at.size(); ++v) {
    const Point2 p = c.at[v];
    if (!(std::fabs(p.x) <= 1e151 && std::fabs(p.y) <= 1e151)) return false;
    if (!(p == c.at[c.same[v]]) || c.same[c.same[v]] != c.same[v]) return false;
  }
  if (!noneTurnedOver(c, c.inside) || !noneTurnedOver(c, c.complement)) return false;
  if (!work.tick(uint32_t(c.at.size() < (1u << 24) ? c.at.size() * 60 : 1u << 30))) return false;
  return boundsRings(c, c.inside, false) && boundsRings(c, c.complement, true);
}

}  // namespace sf
