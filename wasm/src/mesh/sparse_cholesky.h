// Sparse symmetric systems whose unknowns have places on a surface, by a direct method.
// Source: George 1973, "Nested dissection of a regular finite element mesh"; Duff, Reid 1983, "The multifrontal
// solution of indefinite sparse symmetric linear equations".
// Differs: a half of the unknowns is not found in the graph but by the longest axis of their places. What is
// left of them beside the other half separates the two; as every unknown of a triangulated surface knows only
// its neighbours, this is as good, and takes no time. Fronts are factored by dense kernels, so the matrices
// of fairing, with 37 entries a row, cost no more than a few times those with 7.
#pragma once
#include <cstdint>
#include <vector>

#include "base/array_view.h"
#include "base/buffer.h"
#include "base/charge.h"
#include "base/vec.h"
#include "base/work.h"

namespace sf {

/// A square matrix by rows.
struct SparseRows {
  std::vector<uint32_t> starts;   // [n+1] in columns
  std::vector<uint32_t> columns;  // [e] of each row, in any order
  std::vector<double> values;     // [e]

  uint32_t size() const { return starts.empty() ? 0 : uint32_t(starts.size()) - 1; }
};

/// The factor L of a symmetric positive definite matrix A = L L^T.
class SparseCholesky {
 public:
  explicit SparseCholesky(Work& work) : work_(work), charge_(work) {}

  /// Factors a matrix. O(n^1.5) time and O(n log n) memory for the unknowns of a surface. False when the work
  /// ended, or if the matrix is not positive definite by its rounded pivots: `isDefinite` tells which.
  ///   matrix  all entries of a symmetric matrix, the diagonal included, no column twice in a row
  ///   places  [n] where the unknowns are: good places make it fast, any are right
  bool factor(const SparseRows& matrix, ArrayView<const Vec3> places);
  bool isDefinite() const { return isDefinite_; }

  /// Solves A x = b for three right-hand sides at once.
  ///   x  [n] b, and then x
  void solve(ArrayView<Vec3> x);

 private:
  // Unknowns that are eliminated together.
  struct Node {
    uint32_t first, last;          // [first, last) in the new order
    uint32_t rowsFrom, rowsTo;     // in rows_: later unknowns that it changes, ascending
    uint32_t firstChild, sibling;  // nodes whose update it takes first
    size_t panel;  // in panels_: its columns of L, by rows of the node's own unknowns and of rows_
    uint32_t columns() const { return last - first; }
    uint32_t below() const { return rowsTo - rowsFrom; }
  };
  struct Place {
    double key;
    uint32_t unknown;
  };

  bool dissect(const SparseRows& matrix, ArrayView<const Vec3> places, ArrayView<Place> set);
  bool addNode(ArrayView<const Place> set);
  bool analyze(const SparseRows& matrix);
  bool eliminate(const SparseRows& matrix);

  Work& work_;
  Charge charge_;
  bool isDefinite_ = true;
  std::vector<uint32_t> order_;  // [n] unknowns in the order of elimination
  std::vector<uint32_t> rank_;   // [n] place of each unknown in it
  std::vector<uint32_t> side_;   // [n] stamp of the half that the unknown was put in last
  uint32_t stamp_ = 0;
  std::vector<Node> nodes_;  // children before parents
  std::vector<uint32_t> rows_;
  Buffer<double> panels_;
  std::vector<Vec3> permuted_;
};

}  // namespace sf
