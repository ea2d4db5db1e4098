#include "polygon/u_tree.h"

#include <cmath>

#include "base/predicates.h"

namespace sf {

/// The tree of the vertices 1 .. n-2 of the chain, each no nearer to the base than its parent and of
/// equally near ones the lower the parent; its root is left in stack_[0].
void UTree::build(const double* positions, ArrayView<const uint32_t> chain, bool left) {
  const uint32_t last = uint32_t(chain.size()) - 1;
  const double* a = positions + 2 * size_t(chain[0]);
  const double* b = positions + 2 * size_t(chain[last]);
  const double dx = b[0] - a[0], dy = b[1] - a[1];
  distance_.resize(chain.size());
  above_.assign(chain.size(), 0);
  below_.assign(chain.size(), 0);
  stack_.clear();
  double widest = std::fabs(dx), highest = std::fabs(dy);
  for (uint32_t i = 1; i < last; ++i) {
    const double* p = positions + 2 * size_t(chain[i]);
    const double x = p[0] - a[0], y = p[1] - a[1], d = dx * y - dy * x;
    distance_[i] = left ? d : -d;
    widest = std::fmax(widest, std::fabs(x));
    highest = std::fmax(highest, std::fabs(y));
  }
  // Four rounding errors and two differences in each of two products, twice over, and underflows.
  const double bound = 16 * 0x1p-53 * widest * highest + 1e-290;
  const auto nearer = [&](uint32_t i, uint32_t j) {
    if (std::fabs(distance_[i] - distance_[j]) > bound) return distance_[i] < distance_[j];
    const double* p = positions + 2 * size_t(chain[i]);
    const double* q = positions + 2 * size_t(chain[j]);
    return turn2d(a[0], a[1], b[0], b[1], p[0], p[1], q[0], q[1]) == (left ? 1 : -1);
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

uint32_t* UTree::triangulate(const double* positions, ArrayView<const uint32_t> chain, bool left,
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
  build(positions, chain, left);
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
