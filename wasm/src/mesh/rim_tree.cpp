#include "mesh/rim_tree.h"

#include <algorithm>

namespace sf {
namespace {

constexpr uint32_t kLeaf = 8;

}  // namespace

bool RimTree::build(ArrayView<const RimSide> sides) {
  sides_ = sides;
  const uint64_t n = sides.size();
  if (!charge_.add(n * (sizeof(uint32_t) + sizeof(Node)) + 64 * sizeof(Pending))) return false;
  order_.resize(n);
  for (uint32_t i = 0; i < n; ++i) order_[i] = i;
  nodes_.clear();
  nodes_.reserve(n / 2 + 1);
  stack_.reserve(64);
  if (n > 0) split(0, uint32_t(n));
  return work_.tick(uint32_t(std::min<uint64_t>(n * 200, 1u << 30)));
}

/// Makes the node of some sides, and those below it; returns its number.
uint32_t RimTree::split(uint32_t first, uint32_t count) {
  Vec3 low = sides_[order_[first]].at, high = low;
  for (uint32_t i = first; i < first + count; ++i) {
    const Vec3 p = sides_[order_[i]].at;
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  Node node{0.5 * (low + high), 0, first, count};
  for (uint32_t i = first; i < first + count; ++i)
    node.radius = std::max(node.radius, distance(node.centre, sides_[order_[i]].at));
  const uint32_t number = uint32_t(nodes_.size());
  nodes_.push_back(node);
  if (count <= kLeaf) return number;
  const Vec3 size = high - low;
  double Vec3::* const axis = size.x >= size.y && size.x >= size.z ? &Vec3::x
                              : size.y >= size.z                  ? &Vec3::y
                                                                  : &Vec3::z;
  const auto middle = order_.begin() + first + count / 2;
  std::nth_element(order_.begin() + first, middle, order_.begin() + first + count,
                   [&](uint32_t i, uint32_t j) {
                     const double a = sides_[i].at.*axis, b = sides_[j].at.*axis;
                     return a != b ? a < b : i < j;
                   });
  split(first, count / 2);
  const uint32_t second = split(first + count / 2, count - count / 2);
  nodes_[number].first = second, nodes_[number].count = 0;
  return number;
}

}  // namespace sf
