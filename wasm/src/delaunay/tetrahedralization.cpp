#include "delaunay/tetrahedralization.h"

#include <algorithm>

#include "base/predicates.h"
#include "base/sort.h"
#include "delaunay/insertion_order.h"

namespace sf {

constexpr uint8_t Tetrahedralization::kFace[4][3];

Tetrahedralization::~Tetrahedralization() { work_.release(charged_); }

// Room for `size` elements, charged before it is taken.
template <class T>
bool Tetrahedralization::reserve(std::vector<T>& v, size_t size) {
  if (size <= v.capacity()) return true;
  const uint64_t before = uint64_t(v.capacity()) * sizeof(T);
  const size_t wanted = std::max(size, v.capacity() + v.capacity() / 2);
  charged_ += uint64_t(wanted) * sizeof(T);
  if (!work_.charge(uint64_t(wanted) * sizeof(T))) return false;
  v.reserve(wanted);
  work_.release(before), charged_ -= before;
  return true;
}

bool Tetrahedralization::add(ArrayView<const Vec3> points, ArrayView<const uint32_t> ranks) {
  if (points.empty()) return work_.going();
  uint32_t first = pointCount(), n = first + uint32_t(points.size());
  if (!reserve(points_, n + 1) || !reserve(rank_, n + 1) || !reserve(firstEqual_, n)) return false;
  if (points_.empty()) points_.push_back({0, 0, 0}), rank_.push_back(kNone - 1);
  points_.insert(points_.end(), points.begin(), points.end());
  for (uint32_t i = first; i < n; ++i) rank_.push_back(ranks.empty() ? i : ranks[i - first]);
  ArrayView<const Vec3> all(points_.data() + 1, points_.size() - 1);
  if (!findEqualPoints(all, work_, firstEqual_)) return false;

  bool staysInHull = dimension_ == 3;
  if (dimension_ == 2) {
    staysInHull = true;
    for (const Vec3& p : points)
      if (orient3d(points_[base_[0]], points_[base_[1]], points_[base_[2]], p) != 0)
        staysInHull = false;
  }
  if (!staysInHull) return rebuild();
  std::vector<uint32_t> order;
  return insertionOrder(first, order) && insertAll(order);
}

bool Tetrahedralization::rebuild() {
  cells_.clear(), free_.clear(), line_.clear(), base_.clear();
  std::vector<uint32_t> order;
  if (!insertionOrder(0, order) || !startFrom(order)) return false;
  return dimension_ < 2 || insertAll(order);
}

bool Tetrahedralization::insertionOrder(uint32_t first, std::vector<uint32_t>& order) {
  for (uint32_t i = first; i < firstEqual_.size(); ++i)
    if (firstEqual_[i] == i) order.push_back(i + 1);
  return sortForInsertion(points_, work_, order);
}

// Finds the dimension, makes the first tetrahedron and takes its vertices out of `order`.
bool Tetrahedralization::startFrom(std::vector<uint32_t>& order) {
  auto p = [&](uint32_t i) -> const Vec3& { return points_[order[i]]; };
  uint32_t n = uint32_t(order.size()), third = 2, fourth;
  while (third < n && collinear(p(0), p(1), p(third))) ++third;
  if (third >= n) {
    dimension_ = n == 1 ? 0 : 1;
    if (!reserve(line_, n)) return false;
    line_ = order;
    sf::sort(line_.begin(), line_.end(), [&](uint32_t a, uint32_t b) {
      const Vec3 &u = points_[a], &v = points_[b];
      return u.x != v.x ? u.x < v.x : u.y != v.y ? u.y < v.y : u.z < v.z;
    });
    return work_.going();
  }
  fourth = third + 1;
  while (fourth < n && orient3d(p(0), p(1), p(third), p(fourth)) == 0) ++fourth;
  base_ = {order[0], order[1], order[third]};
  if (fourth < n) {
    dimension_ = 3;
    base_.push_back(order[fourth]);
    order.erase(order.begin() + fourth);
  } else {
    dimension_ = 2;
    base_.push_back(kApex);
    for (Vec3 corner : {Vec3{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}) {
      points_[kApex] = corner;  // no plane holds all four
      if (orient3d(p(0), p(1), p(third), corner) != 0) break;
    }
  }
  order.erase(order.begin() + third);
  order.erase(order.begin(), order.begin() + 2);
  // About 6.8 cells a vertex on random points, and some hull.
  if (!reserve(cells_, 7 * size_t(n) + 64)) return false;

  std::vector<uint32_t> b = base_;
  if (orient3d(points_[b[0]], points_[b[1]], points_[b[2]], points_[b[3]]) < 0)
    std::swap(b[0], b[1]);
  cells_.push_back({{b[0], b[1], b[2], b[3]}, {}, 0});
  for (int i = 0; i < 4; ++i) {
    const uint8_t* f = kFace[i];
    cells_.push_back({{kGhost, b[f[0]], b[f[1]], b[f[2]]}, {}, 0});
    link(0, i, uint32_t(i) + 1, 0);
  }
  for (uint32_t s = 1; s <= 4; ++s)
    for (int i = 1; i < 4; ++i)
      for (uint32_t t = 1; t <= 4; ++t)
        for (int j = 1; j < 4; ++j)
          // Ghosts over the faces opposite of two vertices meet in the face without these two.
          if (s != t && cells_[s].v[i] == b[t - 1] && cells_[t].v[j] == b[s - 1]) link(s, i, t, j);
  last_ = 0;
  return work_.going();
}

bool Tetrahedralization::insertAll(ArrayView<const uint32_t> order) {
  for (size_t i = 0; i < order.size(); ++i) {
    if (!insert(order[i])) return false;
    if ((i & 63) == 0) work_.setFraction(double(i) / double(order.size()));
  }
  return true;
}

bool Tetrahedralization::insert(uint32_t v) {
  return findCavity(locate(points_[v]), v) && fillCavity(v);
}

// A cell that the point is in: a finite one with the point inside or on its boundary, or a ghost
// whose hull facet the point lies beyond. The walk ends, since each step lowers the power of the
// point with respect to the (perturbed) circumsphere.
uint32_t Tetrahedralization::locate(const Vec3& p) const {
  uint32_t t = last_, from = kNowhere;
  if (cells_[t].v[0] == kGhost) t = cells_[t].n[0] / 4;
  for (;;) {
    const Cell& cell = cells_[t];
    if (!cell.isFinite()) return t;
    int i = 0;
    for (; i < 4; ++i) {
      if (cell.n[i] / 4 == from) continue;
      const uint8_t* f = kFace[i];
      if (orient3d(points_[cell.v[f[0]]], points_[cell.v[f[1]]], points_[cell.v[f[2]]], p) < 0)
        break;
    }
    if (i == 4) return t;
    from = t;
    t = cell.n[i] / 4;
  }
}

bool Tetrahedralization::conflicts(const Cell& t, uint32_t v) const {
  if (t.v[0] == kGhost) {
    int side = orient3d(points_[t.v[1]], points_[t.v[3]], points_[t.v[2]], points_[v]);
    if (side != 0) return side > 0;
    // In the hull facet's plane the circumsphere of the cell behind cuts out the facet's circle.
    const Cell& behind = cells_[t.n[0] / 4];
    if (behind.mark / 2 == step_) return (behind.mark & 1) == 0;
    return conflicts(behind, v);
  }
  const Vec3 &a = points_[t.v[0]], &b = points_[t.v[1]], &c = points_[t.v[2]], &d = points_[t.v[3]];
  int side = insphere(a, b, c, d, points_[v]);
  if (side != 0) return side > 0;
  hadTies_ = true;
  const Vec3* const p[5] = {&a, &b, &c, &d, &points_[v]};
  const uint32_t rank[5] = {rank_[t.v[0]], rank_[t.v[1]], rank_[t.v[2]], rank_[t.v[3]], rank_[v]};
  return insphereByRank(p, rank) > 0;
}

// Marks the cells in conflict with the vertex and lists them, and the faces around them.
bool Tetrahedralization::findCavity(uint32_t start, uint32_t v) {
  ++step_;
  cavity_.clear(), rim_.clear();
  cavity_.push_back(start);
  cells_[start].mark = 2 * step_;
  SF_ASSERT(conflicts(cells_[start], v));
  for (size_t k = 0; k < cavity_.size(); ++k) {
    uint32_t t = cavity_[k];
    if (!reserve(cavity_, cavity_.size() + 4) || !reserve(rim_, rim_.size() + 4)) return false;
    for (uint32_t i = 0; i < 4; ++i) {
      uint32_t other = cells_[t].n[i] / 4;
      Cell& cell = cells_[other];
      if (cell.mark / 2 != step_) {
        bool inside = conflicts(cell, v);
        cell.mark = 2 * step_ + !inside;
        if (inside) cavity_.push_back(other);
      }
      if (cell.mark & 1) rim_.push_back(4 * t + i);
    }
  }
  return work_.tick(uint32_t(std::min<size_t>(100 * cavity_.size(), 1u << 30)));
}

uint32_t Tetrahedralization::newCell() {
  if (!free_.empty()) {
    uint32_t t = free_.back();
    free_.pop_back();
    return t;
  }
  cells_.emplace_back();
  return uint32_t(cells_.size()) - 1;
}

// Finds the neighbour of a new cell across the face opposite of its corner k. Turns around the edge
// that this face has in common with the rim facet (face `i` of cavity cell `t`), until the rim.
void Tetrahedralization::linkAroundEdge(uint32_t t, uint32_t i, uint32_t created, int k) {
  uint32_t leave = cells_[t].find(cells_[created].v[k]), enter = i;
  for (;;) {
    uint32_t across = cells_[t].n[leave], apex = cells_[t].v[enter];
    if (cells_[across / 4].mark != 2 * step_) {
      link(created, k, across / 4, int(cells_[across / 4].find(apex)));
      return;
    }
    t = across / 4, enter = across % 4, leave = cells_[t].find(apex);
  }
}

// Replaces the cavity by cells from its rim to the vertex.
bool Tetrahedralization::fillCavity(uint32_t v) {
  size_t fromFree = std::min(free_.size(), rim_.size());
  if (!reserve(cells_, cells_.size() + rim_.size() - fromFree) ||
      !reserve(free_, free_.size() + cavity_.size()))
    return false;
  for (uint32_t face : rim_) {
    uint32_t t = face / 4, i = face % 4, created = newCell();
    const Cell& old = cells_[t];
    uint32_t a = old.v[kFace[i][0]], b = old.v[kFace[i][1]], c = old.v[kFace[i][2]];
    while (b == kGhost || c == kGhost) {  // turned until the ghost is in front
      uint32_t first = a;
      a = b, b = c, c = first;
    }
    Cell& cell = cells_[created];
    cell.v[0] = a, cell.v[1] = b, cell.v[2] = c, cell.v[3] = v;
    cell.n[0] = cell.n[1] = cell.n[2] = kNowhere;
    cell.mark = 0;
    uint32_t outside = old.n[i];
    link(created, 3, outside / 4, int(outside % 4));
    cells_[t].n[i] = 4 * created;  // from now on the rim leads to the new cells
  }
  for (uint32_t face : rim_) {
    uint32_t t = face / 4, i = face % 4, created = cells_[t].n[i] / 4;
    for (int k = 0; k < 3; ++k)
      if (cells_[created].n[k] == kNowhere) linkAroundEdge(t, i, created, k);
  }
  for (uint32_t t : cavity_) {
    cells_[t].v[0] = kFree;
    free_.push_back(t);
  }
  last_ = cells_[rim_[0] / 4].n[rim_[0] % 4] / 4;
  return true;
}

}  // namespace sf
