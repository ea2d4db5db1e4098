#include "mesh/fair_system.h"

#include <cmath>
#include <utility>

#include "triangles/triangle_mesh.h"

namespace sf {
namespace {

// A solution that leaves more of the forces than this is none: the system was singular but for rounding.
constexpr double kLargestRest = 1e-2;
// Forces below this share of the stiffness mean nothing, in a box of unit size.
constexpr double kRounding = 1e-11;

void multiply(const SparseRows& rows, ArrayView<const Vec3> x, ArrayView<Vec3> y) {
  for (uint32_t v = 0; v < rows.size(); ++v) {
    // As differences: of coordinates themselves, digits would be lost.
    Vec3 sum{0, 0, 0};
    for (uint32_t e = rows.starts[v]; e < rows.starts[v + 1]; ++e)
      sum = sum + rows.values[e] * (x[rows.columns[e]] - x[v]);
    y[v] = sum;
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

}  // namespace

FairSystem::FairSystem(const Laplacian& laplacian, uint32_t firstFree, Work& work)
    : laplacian_(laplacian), first_(firstFree), work_(work) {
  const uint32_t n = laplacian.whole.size();
  numberOf_.assign(n, kNone), inverseMass_.assign(n, 0);
  for (uint32_t v = 0; v < n; ++v) {
    if (!laplacian.isBoundary[v]) inverseMass_[v] = 1 / laplacian.mass[v];
    if (v < first_ || !(laplacian.whole.values[laplacian.whole.starts[v]] > 0)) continue;
    numberOf_[v] = uint32_t(unknowns_.size()), unknowns_.push_back(v);
  }
  flow_.resize(n), next_.resize(n);
}

/// The Laplacian of places, into flow_.
void FairSystem::laplacianOfPlaces(ArrayView<const Vec3> x) {
  multiply(laplacian_.whole, x, flow_);
  for (const Clamp& clamp : laplacian_.clamps)
    flow_[clamp.vertex] = flow_[clamp.vertex] - clamp.pull;
}

/// The left side of the system at x, for all vertices, into flow_.
void FairSystem::forces(uint32_t order, ArrayView<const Vec3> x) {
  laplacianOfPlaces(x);
  for (uint32_t k = 1; k < order; ++k) {
    for (uint32_t v = 0; v < flow_.size(); ++v) flow_[v] = inverseMass_[v] * flow_[v];
    const bool isLast = k + 1 == order;
    multiply(isLast ? laplacian_.whole : laplacian_.inner, flow_, next_);
    flow_.swap(next_);
  }
}

/// The matrix of the unknowns: the outer one at both ends, the inner Laplacian between.
bool FairSystem::assemble(uint32_t order, const SparseRows& outer, SparseRows& matrix,
                          Charge& charge) {
  const size_t n = outer.size();
  if (!charge.add(n * 2 * 9)) return false;
  RowSum sum(n), product(n);
  matrix.starts.assign(1, 0);
  for (const uint32_t v : unknowns_) {
    sum.clear();
    sum.add(outer, v, 1);
    for (uint32_t k = 1; k < order; ++k) {
      product.clear();
      const SparseRows& rows = k + 1 == order ? outer : laplacian_.inner;
      for (const uint32_t c : sum.columns) {
        const double factor = sum.values[c] * inverseMass_[c];
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
    if (!work_.tick(order * order * 200)) return false;
  }
  return true;
}

bool FairSystem::solve(uint32_t order, ArrayView<Vec3> x) {
  if (unknowns_.empty()) return true;
  Charge charge(work_);
  SparseRows matrix;
  if (!charge.add(uint64_t(unknowns_.size()) * 2 * sizeof(Vec3)) ||
      !assemble(order, laplacian_.whole, matrix, charge))
    return false;
  std::vector<Vec3> places, step(unknowns_.size());
  for (const uint32_t v : unknowns_) places.push_back(x[v]);
  SparseCholesky cholesky(work_);
  if (!cholesky.factor(matrix, places)) return false;

  const auto largest = [&] {
    double most = 0;
    for (const uint32_t v : unknowns_) most = std::fmax(most, dot(flow_[v], flow_[v]));
    return std::sqrt(most);
  };
  double stiffest = 0;
  for (const double value : matrix.values) stiffest = std::fmax(stiffest, std::fabs(value));
  forces(order, x);
  const double bearable = std::fmax(kLargestRest * largest(), kRounding * stiffest);
  // The second time takes away what rounding left of the forces.
  for (int i = 0; i < 2; ++i) {
    for (size_t u = 0; u < unknowns_.size(); ++u) step[u] = -flow_[unknowns_[u]];
    cholesky.solve(step);
    for (size_t u = 0; u < unknowns_.size(); ++u) x[unknowns_[u]] = x[unknowns_[u]] + step[u];
    forces(order, x);
    if (!work_.tick(uint64_t(flow_.size()) * 100)) return false;
  }
  return largest() <= bearable;
}

void FairSystem::measure(ArrayView<const Vec3> x, ArrayView<const uint32_t> triangles) {
  const uint32_t n = uint32_t(x.size());
  normals_.assign(n, Vec3{0, 0, 0}), curvature_.assign(n, 0);
  for (uint32_t h = 0; h < triangles.size(); ++h) {
    const uint32_t v = triangles[h];
    const Vec3 a = x[triangles[nextInTriangle(h)]] - x[v],
               b = x[triangles[prevInTriangle(h)]] - x[v];
    // Max's weights, which give the normals of spheres.
    const double square = dot(a, a) * dot(b, b);
    if (square > 0) normals_[v] = normals_[v] + (1 / square) * cross(a, b);
  }
  for (const Clamp& clamp : laplacian_.clamps) normals_[clamp.vertex] = clamp.normal;
  laplacianOfPlaces(x);
  for (uint32_t v = 0; v < n; ++v) {
    const double l = length(normals_[v]);
    if (l > 0) normals_[v] = (1 / l) * normals_[v];
    curvature_[v] = inverseMass_[v] * dot(normals_[v], flow_[v]);
  }
}

double FairSystem::variation() const {
  double sum = 0;
  for (uint32_t v = 0; v < curvature_.size(); ++v)
    for (uint32_t e = laplacian_.inner.starts[v]; e < laplacian_.inner.starts[v + 1]; ++e)
      sum += curvature_[v] * laplacian_.inner.values[e] *
             (curvature_[laplacian_.inner.columns[e]] - curvature_[v]);
  return sum;
}

/// The Laplacian less M |A|^2, where |A|^2 is the sum of the squared principal curvatures, by weights also the square
/// of the gradient of the normals. A shift f along the normals changes M times the curvature by this times f.
SparseRows FairSystem::bentLaplacian() const {
  SparseRows rows = laplacian_.whole;
  for (uint32_t v = 0; v < rows.size(); ++v) {
    double bent = 0;
    for (uint32_t e = rows.starts[v] + 1; e < rows.starts[v + 1]; ++e)
      bent -= rows.values[e] * (1 - dot(normals_[v], normals_[rows.columns[e]]));
    rows.values[rows.starts[v]] -= bent;
  }
  return rows;
}

/// Solves for a shift along the normals, and moves by it.
///   step  [u] the right-hand side, in x
bool FairSystem::shiftAlongNormals(const SparseRows& matrix, std::vector<Vec3>& step,
                                   ArrayView<Vec3> x, double& most) {
  std::vector<Vec3> places;
  for (const uint32_t v : unknowns_) places.push_back(x[v]);
  SparseCholesky cholesky(work_);
  if (!cholesky.factor(matrix, places)) return false;
  cholesky.solve(step);
  for (size_t u = 0; u < unknowns_.size(); ++u) {
    const uint32_t v = unknowns_[u];
    x[v] = x[v] + step[u].x * normals_[v];
    most = std::fmax(most, std::fabs(step[u].x));
  }
  return work_.tick(uint64_t(x.size()) * 100);
}

bool FairSystem::step(uint32_t order, ArrayView<Vec3> x, double& most) {
  most = 0;
  if (unknowns_.empty()) return true;
  const uint32_t n = uint32_t(x.size());
  Charge charge(work_);
  if (!charge.add(uint64_t(laplacian_.whole.columns.size()) * 12 + uint64_t(n) * 12 +
                  unknowns_.size() * 2 * sizeof(Vec3)))
    return false;
  const SparseRows outer = bentLaplacian();
  SparseRows matrix;
  if (!assemble(order, order == 2 ? laplacian_.whole : outer, matrix, charge)) return false;
  for (uint32_t v = 0; v < n; ++v) flow_[v] = {curvature_[v], 0, 0};
  if (order == 3) {
    multiply(laplacian_.inner, flow_, next_);
    for (uint32_t v = 0; v < n; ++v) flow_[v] = inverseMass_[v] * next_[v];
  }
  std::vector<Vec3> step(unknowns_.size());
  for (size_t u = 0; u < unknowns_.size(); ++u) {
    const uint32_t v = unknowns_[u];
    // How the energy changes when the vertex moves: of bending also since the area does.
    const double h = curvature_[v];
    double sum = 0;
    if (order == 1) sum = laplacian_.mass[v] * h;
    if (order == 2) sum = 0.5 * laplacian_.mass[v] * h * h * h / laplacian_.unit;
    for (uint32_t e = outer.starts[v]; order > 1 && e < outer.starts[v + 1]; ++e)
      sum += outer.values[e] * flow_[outer.columns[e]].x;
    step[u] = {-sum, 0, 0};
  }
  return shiftAlongNormals(matrix, step, x, most);
}

}  // namespace sf
