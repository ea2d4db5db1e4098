#include "mesh/sparse_cholesky.h"

#include <cmath>
#include <cstring>

#include "base/sort.h"

namespace sf {
namespace {

// Sets of fewer unknowns are not divided: a small dense front costs less than the way through the tree.
constexpr size_t kLeaf = 40;
// Columns of a front that are factored together.
constexpr uint32_t kBlock = 24;
// A pivot that has lost all its digits but this share is no longer known to be positive.
constexpr double kLeastPivot = 1e-15;

// Two doubles at once, in SSE2 and in WebAssembly's SIMD alike.
using Two = double __attribute__((vector_size(16)));
inline Two load(const double* p) {
  Two v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

/// c[i][j] -= a[i] . b[j] for four rows a and two rows b of length k.
inline void subtractTile(double* c, size_t strideC, const double* a, size_t strideA,
                         const double* b, size_t strideB, size_t k) {
  Two s00{}, s01{}, s10{}, s11{}, s20{}, s21{}, s30{}, s31{};
  const double *a0 = a, *a1 = a + strideA, *a2 = a1 + strideA, *a3 = a2 + strideA, *b0 = b,
               *b1 = b + strideB;
  size_t p = 0;
  for (; p + 2 <= k; p += 2) {
    const Two x = load(b0 + p), y = load(b1 + p);
    Two v = load(a0 + p);
    s00 += v * x, s01 += v * y;
    v = load(a1 + p);
    s10 += v * x, s11 += v * y;
    v = load(a2 + p);
    s20 += v * x, s21 += v * y;
    v = load(a3 + p);
    s30 += v * x, s31 += v * y;
  }
  double* rows[4] = {c, c + strideC, c + 2 * strideC, c + 3 * strideC};
  const Two sums[4][2] = {{s00, s01}, {s10, s11}, {s20, s21}, {s30, s31}};
  const double* lines[4] = {a0, a1, a2, a3};
  for (int i = 0; i < 4; ++i) {
    double u = sums[i][0][0] + sums[i][0][1], v = sums[i][1][0] + sums[i][1][1];
    if (p < k) u += lines[i][p] * b0[p], v += lines[i][p] * b1[p];
    rows[i][0] -= u, rows[i][1] -= v;
  }
}

inline double product(const double* a, const double* b, size_t k) {
  double s = 0;
  for (size_t p = 0; p < k; ++p) s += a[p] * b[p];
  return s;
}

/// c[i][j] -= a[i] . b[j] for rows i of [0, m) and columns j of [0, min(n, i + ahead)), and perhaps some more
/// columns below n. For triangles of c, `ahead` is 1; it is n for all of c.
void subtractProducts(double* c, size_t strideC, const double* a, size_t strideA, size_t m,
                      const double* b, size_t strideB, size_t n, size_t k, size_t ahead) {
  if (k == 0) return;
  size_t i = 0;
  for (; i + 4 <= m; i += 4) {
    const size_t end = i + 3 + ahead < n ? i + 3 + ahead : n;
    size_t j = 0;
    for (; j + 2 <= end; j += 2)
      subtractTile(c + i * strideC + j, strideC, a + i * strideA, strideA, b + j * strideB, strideB,
                   k);
    if (j < end)
      for (size_t q = i; q < i + 4; ++q)
        c[q * strideC + j] -= product(a + q * strideA, b + j * strideB, k);
  }
  for (; i < m; ++i)
    for (size_t j = 0; j < n && j < i + ahead; ++j)
      c[i * strideC + j] -= product(a + i * strideA, b + j * strideB, k);
}

/// Factors the first c columns of a front in place: m rows of length c. False if a pivot is lost.
///   diagonal  [c] of the matrix before any elimination
bool factorPanel(double* panel, size_t m, size_t c, const double* diagonal) {
  for (size_t from = 0; from < c; from += kBlock) {
    const size_t to = from + kBlock < c ? from + kBlock : c, width = to - from;
    double* at = panel + from * c;
    subtractProducts(at + from, c, at, c, m - from, at, c, width, from, 1);
    for (size_t j = 0; j < width; ++j) {
      double* row = at + j * c + from;
      for (size_t q = 0; q < j; ++q)
        row[q] = (row[q] - product(row, at + q * c + from, q)) / at[q * c + from + q];
      const double pivot = row[j] - product(row, row, j);
      if (!(pivot > kLeastPivot * diagonal[from + j])) return false;
      row[j] = std::sqrt(pivot);
    }
    for (size_t i = to; i < m; ++i) {
      double* row = panel + i * c + from;
      for (size_t q = 0; q < width; ++q)
        row[q] = (row[q] - product(row, at + q * c + from, q)) / at[q * c + from + q];
    }
  }
  return true;
}

}  // namespace

bool SparseCholesky::factor(const SparseRows& matrix, ArrayView<const Vec3> places) {
  const uint32_t n = matrix.size();
  SF_ASSERT(places.size() == n);
  isDefinite_ = true;
  nodes_.clear(), order_.clear(), rows_.clear(), stamp_ = 0;
  if (!charge_.add(uint64_t(n) * (12 + sizeof(Place) + sizeof(Vec3)))) return false;
  side_.assign(n, 0), order_.reserve(n), rank_.resize(n), permuted_.resize(n);
  std::vector<Place> set(n);
  for (uint32_t v = 0; v < n; ++v) set[v] = {0, v};
  return dissect(matrix, places, set) && analyze(matrix) && eliminate(matrix);
}

bool SparseCholesky::addNode(ArrayView<const Place> set) {
  if (set.empty()) return true;
  const uint32_t first = uint32_t(order_.size());
  for (const Place& p : set)
    rank_[p.unknown] = uint32_t(order_.size()), order_.push_back(p.unknown);
  return push(nodes_, Node{first, uint32_t(order_.size()), 0, 0, kNone, kNone, 0}, charge_);
}

/// Divides a set into two halves and what separates them, which comes last. At most log2(n) calls deep.
bool SparseCholesky::dissect(const SparseRows& matrix, ArrayView<const Vec3> places,
                             ArrayView<Place> set) {
  if (set.size() <= kLeaf) return addNode(set);
  Vec3 low = places[set[0].unknown], high = low;
  for (const Place& p : set) {
    const Vec3 q = places[p.unknown];
    low = lowest(low, q), high = highest(high, q);
  }
  const Vec3 extent = high - low;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  for (Place& p : set) {
    const Vec3 q = places[p.unknown];
    p.key = axis == 0 ? q.x : axis == 1 ? q.y : q.z;
  }
  const auto before = [](const Place& a, const Place& b) {
    return a.key < b.key || (a.key == b.key && a.unknown < b.unknown);
  };
  sf::sort(set.begin(), set.end(), before);
  const size_t half = set.size() / 2;
  const uint32_t left = ++stamp_, right = ++stamp_;
  for (size_t i = 0; i < set.size(); ++i) side_[set[i].unknown] = i < half ? left : right;
  // Those of either half that have a neighbour in the other: the fewer will do.
  const auto sees = [&](uint32_t v, uint32_t side) {
    for (uint32_t e = matrix.starts[v]; e < matrix.starts[v + 1]; ++e)
      if (side_[matrix.columns[e]] == side) return true;
    return false;
  };
  size_t seen[2] = {0, 0};
  for (size_t i = 0; i < set.size(); ++i) {
    set[i].key = sees(set[i].unknown, i < half ? right : left) ? 1 : 0;
    seen[i < half ? 0 : 1] += size_t(set[i].key);
  }
  if (!work_.tick(uint64_t(set.size()) * 64)) return false;
  // Moved to the inner end of their half, and then all three sets are next to each other.
  const bool takesLeft = seen[0] <= seen[1];
  const size_t from = takesLeft ? 0 : half, to = takesLeft ? half : set.size();
  std::vector<Place> separator;
  separator.reserve(seen[takesLeft ? 0 : 1]);
  size_t kept = from;
  for (size_t i = from; i < to; ++i) {
    if (set[i].key != 0)
      separator.push_back(set[i]);
    else
      set[kept++] = set[i];
  }
  const ArrayView<Place> first = takesLeft ? set.slice(0, kept) : set.slice(0, half);
  const ArrayView<Place> second =
      takesLeft ? set.slice(half, set.size() - half) : set.slice(half, kept - half);
  return dissect(matrix, places, first) && dissect(matrix, places, second) && addNode(separator);
}

/// Finds which later unknowns each node changes, and how much memory the factor takes.
bool SparseCholesky::analyze(const SparseRows& matrix) {
  const uint32_t n = matrix.size();
  if (!charge_.add(8 * uint64_t(n))) return false;
  std::vector<uint32_t> mark(n, kNone), nodeOf(n);
  uint64_t size = 0;
  for (uint32_t k = 0; k < nodes_.size(); ++k) {
    for (uint32_t i = nodes_[k].first; i < nodes_[k].last; ++i) nodeOf[i] = k;
  }
  for (uint32_t k = 0; k < nodes_.size(); ++k) {
    Node& node = nodes_[k];
    node.rowsFrom = uint32_t(rows_.size());
    const auto add = [&](uint32_t row) {
      if (row < node.last || mark[row] == k) return true;
      mark[row] = k;
      return push(rows_, row, charge_);
    };
    for (uint32_t i = node.first; i < node.last; ++i) {
      const uint32_t v = order_[i];
      for (uint32_t e = matrix.starts[v]; e < matrix.starts[v + 1]; ++e)
        if (!add(rank_[matrix.columns[e]])) return false;
    }
    for (uint32_t child = node.firstChild; child != kNone; child = nodes_[child].sibling)
      for (uint32_t i = nodes_[child].rowsFrom; i < nodes_[child].rowsTo; ++i)
        if (!add(rows_[i])) return false;
    node.rowsTo = uint32_t(rows_.size());
    sf::sort(rows_.begin() + node.rowsFrom, rows_.end());
    node.panel = size_t(size);
    size += uint64_t(node.columns()) * (node.columns() + node.below());
    if (node.rowsFrom < node.rowsTo) {
      Node& parent = nodes_[nodeOf[rows_[node.rowsFrom]]];
      node.sibling = parent.firstChild, parent.firstChild = k;
    }
    if (!work_.tick(64 * (uint64_t(node.columns()) + node.below()))) return false;
  }
  if (!charge_.add(size * sizeof(double))) return false;
  panels_.resize(size_t(size));
  return true;
}

bool SparseCholesky::eliminate(const SparseRows& matrix) {
  std::vector<uint32_t> local(matrix.size());          // of unknowns in the order: row in the front
  std::vector<Buffer<double>> updates(nodes_.size());  // what children hand up, until it is taken
  std::vector<double> diagonal;
  Charge fronts(work_);
  if (!fronts.add(4 * uint64_t(matrix.size()) + sizeof(Buffer<double>) * nodes_.size()))
    return false;
  const auto release = [&] {
    for (const Buffer<double>& update : updates) work_.release(sizeof(double) * update.size());
  };
  for (uint32_t k = 0; k < nodes_.size(); ++k) {
    const Node& node = nodes_[k];
    const uint32_t c = node.columns(), r = node.below();
    double* panel = panels_.data() + node.panel;
    std::memset(panel, 0, sizeof(double) * c * (c + r));
    const uint64_t bytes = sizeof(double) * uint64_t(r) * r;
    if (!work_.charge(bytes)) return work_.release(bytes), release(), false;
    Buffer<double> update(size_t(r) * r);
    if (r > 0) std::memset(update.data(), 0, sizeof(double) * update.size());
    for (uint32_t i = 0; i < c; ++i) local[node.first + i] = i;
    for (uint32_t i = 0; i < r; ++i) local[rows_[node.rowsFrom + i]] = c + i;
    diagonal.assign(c, 0);
    for (uint32_t i = 0; i < c; ++i) {
      const uint32_t v = order_[node.first + i];
      for (uint32_t e = matrix.starts[v]; e < matrix.starts[v + 1]; ++e) {
        const uint32_t row = rank_[matrix.columns[e]];
        if (row >= node.first + i) panel[size_t(local[row]) * c + i] = matrix.values[e];
        if (row == node.first + i) diagonal[i] = matrix.values[e];
      }
    }
    for (uint32_t child = node.firstChild; child != kNone; child = nodes_[child].sibling) {
      const Node& from = nodes_[child];
      const uint32_t s = from.below();
      Buffer<double>& given = updates[child];
      for (uint32_t i = 0; i < s; ++i) {
        const uint32_t row = local[rows_[from.rowsFrom + i]];
        const double* line = given.data() + size_t(i) * s;
        for (uint32_t j = 0; j <= i; ++j) {
          const uint32_t column = local[rows_[from.rowsFrom + j]];
          if (column < c)
            panel[size_t(row) * c + column] += line[j];
          else
            update[size_t(row - c) * r + (column - c)] += line[j];
        }
      }
      Buffer<double>().swap(given);
      work_.release(sizeof(double) * uint64_t(s) * s);
    }
    isDefinite_ = factorPanel(panel, c + r, c, diagonal.data());
    if (isDefinite_) {
      const double* below = panel + size_t(c) * c;
      subtractProducts(update.data(), r, below, c, r, below, c, r, c, 1);
    }
    updates[k].swap(update);
    if (!isDefinite_ || !work_.tick(uint64_t(c) * (c + r) / 16 * (c + r) + 100)) {
      release();
      return false;
    }
  }
  return true;
}

void SparseCholesky::solve(ArrayView<Vec3> x) {
  std::vector<Vec3>& y = permuted_;
  for (size_t i = 0; i < order_.size(); ++i) y[i] = x[order_[i]];
  for (const Node& node : nodes_) {
    const uint32_t c = node.columns(), m = c + node.below();
    const double* row = panels_.data() + node.panel;
    Vec3* own = y.data() + node.first;
    for (uint32_t i = 0; i < m; ++i, row += c) {
      const uint32_t known = i < c ? i : c;
      Vec3 sum{0, 0, 0};
      for (uint32_t j = 0; j < known; ++j) sum = sum + row[j] * own[j];
      Vec3& at = i < c ? own[i] : y[rows_[node.rowsFrom + i - c]];
      at = at - sum;
      if (i < c) at = (1 / row[i]) * at;
    }
  }
  for (size_t k = nodes_.size(); k-- > 0;) {
    const Node& node = nodes_[k];
    const uint32_t c = node.columns(), m = c + node.below();
    Vec3* own = y.data() + node.first;
    for (uint32_t i = m; i-- > 0;) {
      const double* row = panels_.data() + node.panel + size_t(i) * c;
      if (i < c) own[i] = (1 / row[i]) * own[i];
      const Vec3 at = i < c ? own[i] : y[rows_[node.rowsFrom + i - c]];
      const uint32_t known = i < c ? i : c;
      for (uint32_t j = 0; j < known; ++j) own[j] = own[j] - row[j] * at;
    }
  }
  for (size_t i = 0; i < order_.size(); ++i) x[order_[i]] = y[i];
}

}  // namespace sf
