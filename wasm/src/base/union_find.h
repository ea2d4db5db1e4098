// Which of some things belong together, as they are joined one by one.
//
// Source: Tarjan, van Leeuwen 1984: path halving.
#pragma once
#include <cstdint>
#include <numeric>
#include <vector>

namespace sf {

class UnionFind {
 public:
  UnionFind() = default;
  explicit UnionFind(uint32_t count) { reset(count); }

  /// Things 0 to count - 1, each by itself. 4 bytes each.
  void reset(uint32_t count) {
    parents_.resize(count);
    std::iota(parents_.begin(), parents_.end(), 0u);
  }
  /// The least of the things that i belongs to.
  uint32_t rootOf(uint32_t i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }
  /// Joins what two things belong to. Whether they were apart.
  bool unite(uint32_t i, uint32_t k) {
    i = rootOf(i), k = rootOf(k);
    if (i < k) parents_[k] = i;
    if (k < i) parents_[i] = k;
    return i != k;
  }

 private:
  std::vector<uint32_t> parents_;
};

}  // namespace sf
