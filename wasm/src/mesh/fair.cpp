#include "mesh/fair.h"

#include <cmath>

#include "base/charge.h"
#include "base/vec.h"
#include "mesh/laplacian.h"

namespace sf {
namespace {

// A solution that leaves more of the forces than this is none: the system was singular but for rounding.
constexpr double kLargestRest = 1e-2;
// Forces below this share of the stiffness mean nothing, in a box of unit size.
constexpr double kRounding = 1e-11;

/// The system (L M^-1)^(k-1) L x = 0 for the free vertices of a surface.
class FairSystem {
 public:
  FairSystem(const LocalSurface& surface, ArrayView<const Vec3> at, const Laplacian& laplacian,
             uint32_t order)
      : laplacian_(laplacian), order_(order), first_(surface.fixedVertices), at_(at) {}

  /// Moves the free vertices of x to the solution. False if there is none, or when the work ended.
  bool solve(ArrayView<Vec3> x, Work& work);

 private:
  bool assemble(SparseRows& matrix, Work& work, Charge& charge);
  void forces(ArrayView<const Vec3> x);
  double inverseMass(uint32_t v) const {
    return laplacian_.isBoundary[v] ? 0 : 1 / laplacian_.mass[v];
  }

  const Laplacian& laplacian_;
  uint32_t order_;
  uint32_t first_;
  ArrayView<const Vec3> at_;
  std::vector<uint32_t> unknowns_;  // [u] free vertices that are in triangles
  std::vector<uint32_t> numberOf_;  // [n] and the way back; kNone for all others
  std::vector<Vec3> flow_, next_;   // [n]
};

void multiply(const SparseRows& rows, ArrayView<const Vec3> x, ArrayView<Vec3> y) {
  for (uint32_t v = 0; v < rows.size(); ++v) {
    // As differences: of coordinates themselves, digits would be lost.
    Vec3 sum{0, 0, 0};
    for (uint32_t e = rows.starts[v]; e < rows.starts[v + 1]; ++e)
      sum = sum + rows.values[e] * (x[rows.columns[e]] - x[v]);
    y[v] = sum;
  }
}

/// The left side of the system at x, for all vertices, into flow_.
void FairSystem::forces(ArrayView<const Vec3> x) {
  multiply(laplacian_.whole, x, flow_);
  for (uint32_t k = 1; k < order_; ++k) {
    for (uint32_t v = 0; v < flow_.size(); ++v) flow_[v] = inverseMass(v) * flow_[v];
    const bool isLast = k + 1 == order_;
    multiply(isLast ? laplacian_.whole : laplacian_.inner, flow_, next_);
    flow_.swap(next_);
  }
}

/// A sum of rows.
struct RowSum {
  std::vector<double> values;  // [n] 0 where not in columns
  std::vector<uint32_t> columns;
  std::vector<uint8_t> isIn;  // [n]

  explicit RowSum(size_t n) : values(n, 0.0), isIn(n, 0) {}
  void add(const SparseRows& rows, uint32_t row, double factor) {
    for (uint32_t e = rows.starts[row]; e < rows.starts[row + 1]; ++e) {
      const uint32_t c = rows.columns[e];
      if (!isIn[c]) isIn[c] = 1, columns.push_back(c);
      values[c] += factor * rows.values[e];
    }
  }
  void clear() {
    for (const uint32_t c : columns) values[c] = 0, isIn[c] = 0;
    columns.clear();
  }
};

bool FairSystem::assemble(SparseRows& matrix, Work& work, Charge& charge) {
  const size_t n = laplacian_.whole.size();
  if (!charge.add(n * 2 * 9)) return false;
  RowSum sum(n), product(n);
  matrix.starts.assign(1, 0);
  for (const uint32_t v : unknowns_) {
    sum.clear();
    sum.add(laplacian_.whole, v, 1);
    for (uint32_t k = 1; k < order_; ++k) {
      product.clear();
      const SparseRows& rows = k + 1 == order_ ? laplacian_.whole : laplacian_.inner;
      for (const uint32_t c : sum.columns) {
        const double factor = sum.values[c] * inverseMass(c);
        if (factor != 0) product.add(rows, c, factor);
      }
      std::swap(sum, product);
    }
    for (const uint32_t c : sum.columns) {
      if (numberOf_[c] == kNone) continue;
      if (!push(matrix.columns, numberOf_[c], charge) ||
          !push(matrix.values, sum.values[c], charge))
        return false;
    }
    matrix.starts.push_back(uint32_t(matrix.columns.size()));
    if (!work.tick(order_ * order_ * 200)) return false;
  }
  return true;
}

bool FairSystem::solve(ArrayView<Vec3> x, Work& work) {
  const uint32_t n = laplacian_.whole.size();
  Charge charge(work);
  if (!charge.add(uint64_t(n) * (4 + 4 + 4 * sizeof(Vec3)))) return false;
  numberOf_.assign(n, kNone);
  for (uint32_t v = first_; v < n; ++v)
    if (laplacian_.whole.values[laplacian_.whole.starts[v]] > 0)
      numberOf_[v] = uint32_t(unknowns_.size()), unknowns_.push_back(v);
  if (unknowns_.empty()) return true;
  SparseRows matrix;
  if (!assemble(matrix, work, charge)) return false;
  std::vector<Vec3> places, step(unknowns_.size());
  for (const uint32_t v : unknowns_) places.push_back(at_[v]);
  SparseCholesky cholesky(work);
  if (!cholesky.factor(matrix, places)) return false;

  flow_.resize(n), next_.resize(n);
  const auto largest = [&] {
    double most = 0;
    for (const uint32_t v : unknowns_) most = std::fmax(most, dot(flow_[v], flow_[v]));
    return std::sqrt(most);
  };
  // The second time takes away what rounding left of the forces.
  forces(x);
  const double before = largest();
  double stiffest = 0;
  for (size_t u = 0; u < unknowns_.size(); ++u)
    for (uint32_t e = matrix.starts[u]; e < matrix.starts[u + 1]; ++e)
      stiffest = std::fmax(stiffest, std::fabs(matrix.values[e]));
  const double bearable = std::fmax(kLargestRest * before, kRounding * stiffest);
  for (int i = 0; i < 2; ++i) {
    for (size_t u = 0; u < unknowns_.size(); ++u) step[u] = -flow_[unknowns_[u]];
    cholesky.solve(step);
    for (size_t u = 0; u < unknowns_.size(); ++u) x[unknowns_[u]] = x[unknowns_[u]] + step[u];
    forces(x);
    if (!work.tick(n * 100)) return false;
  }
  return largest() <= bearable;
}

}  // namespace

Status fair(LocalSurface& surface, const FairOptions& options, Work& work, Fairness& result) {
  result = {};
  const size_t n = surface.positions.size() / 3;
  if (n <= surface.fixedVertices || options.order == 0) return work.status();
  Charge charge(work);
  if (!charge.add(n * (3 * sizeof(Vec3) + sizeof(double) * 3))) return work.status();
  // In a box of unit size: neither large nor small coordinates, nor a place far from the origin, change anything.
  std::vector<double>& p = surface.positions;
  double low[3], high[3], extent = 0;
  for (int a = 0; a < 3; ++a) {
    low[a] = high[a] = p[size_t(a)];
    for (size_t v = 1; v < n; ++v)
      low[a] = std::fmin(low[a], p[3 * v + a]), high[a] = std::fmax(high[a], p[3 * v + a]);
    extent = std::fmax(extent, high[a] - low[a]);
  }
  if (!(extent > 0) || !std::isfinite(extent)) return work.status();
  std::vector<double> unit(3 * n);
  std::vector<Vec3> at(n), solved(n);
  const auto scaled = [&](size_t v, int a) { return (p[3 * v + a] - low[a]) / extent - 0.5; };
  for (size_t v = 0; v < n; ++v) at[v] = {scaled(v, 0), scaled(v, 1), scaled(v, 2)};

  Laplacian laplacian;
  uint32_t order = options.order < 3 ? options.order : 3;
  for (uint32_t round = 0; round < options.rounds && order > 0;) {
    for (size_t v = 0; v < n; ++v)
      unit[3 * v] = at[v].x, unit[3 * v + 1] = at[v].y, unit[3 * v + 2] = at[v].z;
    if (!buildLaplacian(unit, surface.triangles, work, laplacian)) return work.status();
    solved = at;
    FairSystem system(surface, at, laplacian, order);
    bool isGood = system.solve(solved, work);
    if (!work.going()) return work.status();
    for (const Vec3& q : solved)
      isGood = isGood && std::fabs(q.x) < 1e3 && std::fabs(q.y) < 1e3 && std::fabs(q.z) < 1e3;
    if (!isGood) {
      // From the beginning: what a system without a good solution gave is no better than the patch.
      --order, round = 0;
      for (size_t v = surface.fixedVertices; v < n; ++v)
        at[v] = {scaled(v, 0), scaled(v, 1), scaled(v, 2)};
      continue;
    }
    at.swap(solved), result.order = order;
    ++round;
  }
  for (size_t v = surface.fixedVertices; v < n && order > 0; ++v) {
    const Vec3 before{p[3 * v], p[3 * v + 1], p[3 * v + 2]};
    const double moved[3] = {at[v].x, at[v].y, at[v].z};
    for (int a = 0; a < 3; ++a) p[3 * v + a] = low[a] + extent * (moved[a] + 0.5);
    result.moved =
        std::fmax(result.moved, distance(before, {p[3 * v], p[3 * v + 1], p[3 * v + 2]}));
  }
  if (order == 0) result.order = 0;
  return work.status();
}

}  // namespace sf
