#include "polygon/fill/u_tree.h"

#include <cmath>

#include "base/turn.h"

namespace sf {

/// The tree of the vertices 1 .. n-2 of the chain. No vertex is nearer to the base than its parent;
/// of equally near ones the lower is the parent. The root is left in stack_[0].
void UTree::build(ArrayView<const Point2> at, ArrayView<const uint32_t> chain, bool left) {
  const uint32_t last = uint32_t(chain.size()) - 1;
  const Point2 a = at[chain[0]], b = at[chain[last]];
  const double dx = b.x - a.x, dy = b.y - a.y;
  distance_.resize(chain.size());
  above_.assign(chain.size(), 0);
  below_.assign(chain.size(), 0);
  stack_.clear();
  double widest = std::fabs(dx), highest = std::fabs(dy);
  for (uint32_t i = 1; i < last; ++i) {
    const Point2 p = at[chain[i]];
    const double x = p.x - a.x, y = p.y - a.y, d = dx * y - dy * x;
    distance_[i] = left ? d : -d;
    widest = std::fmax(widest, std::fabs(x));
    highest = std::fmax(highest, std::fabs(y));
  }
  // Four rounding errors and two differences in each of two products, twice over, and underflows.
  const double bound = 16 * 0x1p-53 * widest * highest + 1e-290;
  const auto nearer = [&](uint32_t i, uint32_t j) {
    if (std::fabs(distance_[i] - distance_[j]) > bound) return distance_[i] < distance_[j];
    return turnBetween(a, b, at[chain[i]], at[chain[j]]) == (left ? 1 : -1);
  };
  for (uint32_t i = 1; i < last; ++i) {
    uint32_t under = 0;
    while (!stack_.empty() && nearer(i, stack_.back())) {
      under = stack_.back();
      stack_.pop_back();
    }
    below_[i] = under;
    if (!stack_.empty()) above_[stack_.back()] = i;
    stack_.push_back(i);
  }
}

uint32_t* UTree::triangulate(ArrayView<const Point2> at, ArrayView<const uint32_t> chain, bool left,
                             uint32_t* out) {
  const uint32_t last = uint32_t(chain.size()) - 1;
  const auto write = [&](uint32_t bottom, uint32_t middle, uint32_t top) {
    *out++ = chain[bottom];
    *out++ = chain[left ? top : middle];
    *out++ = chain[left ? middle : top];
  };
  if (last < 2) return out;
  if (last == 2) {
    write(0, 1, 2);
    return out;
  }
  build(at, chain, left);
  parts_.assign(1, {0, last, stack_[0]});
  while (!parts_.empty()) {
    const Part p = parts_.back();
    parts_.pop_back();
    write(p.bottom, p.root, p.top);
    // The part above waits; a strip has one part only and goes on at once.
    if (above_[p.root] != 0) parts_.push_back({p.root, p.top, above_[p.root]});
    if (below_[p.root] != 0) parts_.push_back({p.bottom, p.root, below_[p.root]});
  }
  return out;
}

}  // namespace sf
