// Sets of weak edges: the edges of a partial surface that the rest of it could use again.
// Source: Zou, Ju, Carr 2013, sec. 3.2.2 (weak edges, definition 3.1) and 3.2.3 (minimal sets).
// Differs: only *critical* edges are tracked, which the solver finds on its way. A set does not
// repeat the spanning edges of its domain, since the domain already has them. Fig. 6 keeps a
// superset of equal weight; the definition in sec. 3.2.3 drops it, so do we.
#pragma once
#include <algorithm>
#include <cstdint>
#include <iterator>
#include <vector>

#include "base/array_view.h"

namespace sf {

/// Edge numbers of a CandidateSet, increasing.
using WeakEdgeSet = ArrayView<const uint32_t>;

inline bool disjoint(WeakEdgeSet a, WeakEdgeSet b) {
  for (size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (a[i] == b[j]) return false;
    if (a[i] < b[j])
      ++i;
    else
      ++j;
  }
  return true;
}
inline bool isSubset(WeakEdgeSet a, WeakEdgeSet b) {
  return std::includes(b.begin(), b.end(), a.begin(), a.end());
}
inline bool contains(WeakEdgeSet a, uint32_t edge) {
  return std::binary_search(a.begin(), a.end(), edge);
}
/// The union of a and b, in `out`.
inline void unite(WeakEdgeSet a, WeakEdgeSet b, std::vector<uint32_t>& out) {
  out.clear();
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
}

}  // namespace sf
