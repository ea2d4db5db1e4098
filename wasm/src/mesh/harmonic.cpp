#include "mesh/harmonic.h"

#include "base/charge.h"
#include "mesh/sparse_cholesky.h"
#include "triangles/triangle_mesh.h"

namespace sf {
namespace {

/// The free vertices of a mesh, numbered from 0, and the parts that they make.
class FreeVertices {
 public:
  FreeVertices(const MeshView& mesh, uint32_t fixedCount, Work& work)
      : mesh_(mesh), fixed_(fixedCount), work_(work), charge_(work) {}

  bool link();
  bool solve(uint32_t size, const double* fixedValues, double* freeValues);

 private:
  bool collect(uint32_t seed);
  bool number(uint32_t i);
  void sumFixed(uint32_t size, const double* values, uint32_t channels);

  const MeshView& mesh_;
  const uint32_t fixed_;
  Work& work_;
  Charge charge_;
  std::vector<uint32_t> starts_;      // [n + 1] in neighbours_
  std::vector<uint32_t> neighbours_;  // vertices of the mesh, once for each face
  std::vector<uint32_t> numberOf_;    // [n] in its part; kNone before it is found
  std::vector<uint32_t> entryOf_;     // [n] where the matrix had it last
  // One part:
  std::vector<uint32_t> part_;
  std::vector<Vec3> places_, x_;
  SparseRows matrix_;
  bool isHeld_ = false;  // whether it has a fixed neighbour
};

/// Lists the neighbours of all.
bool FreeVertices::link() {
  const ArrayView<const uint32_t> corners = mesh_.faces;
  const size_t n = mesh_.positions.size() / 3 - fixed_;
  if (!charge_.add(uint64_t(corners.size()) * 8 + uint64_t(n) * 12)) return false;
  numberOf_.assign(n, kNone), entryOf_.assign(n, 0);
  // One further on until the lists are full: each start is then where its list ends.
  starts_.assign(n + 2, 0);
  for (const uint32_t v : corners)
    if (v >= fixed_) starts_[v - fixed_ + 2] += 2;
  for (size_t i = 2; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  neighbours_.resize(starts_.back());
  for (uint32_t h = 0; h < corners.size(); ++h) {
    if (corners[h] < fixed_) continue;
    uint32_t& next = starts_[corners[h] - fixed_ + 1];
    neighbours_[next++] = corners[nextInTriangle(h)];
    neighbours_[next++] = corners[prevInTriangle(h)];
  }
  return work_.tick(20 * uint64_t(corners.size()));
}

bool FreeVertices::number(uint32_t i) {
  if (numberOf_[i] != kNone) return true;
  numberOf_[i] = uint32_t(part_.size());
  return push(part_, i, charge_) && push(places_, pointAt(mesh_.positions, fixed_ + i), charge_);
}

/// Finds the part of a vertex, and its matrix: how often each vertex has which neighbours.
bool FreeVertices::collect(uint32_t seed) {
  part_.clear(), places_.clear(), isHeld_ = false;
  matrix_.starts.clear(), matrix_.columns.clear(), matrix_.values.clear();
  const auto add = [&](uint32_t column, double value) {
    return push(matrix_.columns, column, charge_) && push(matrix_.values, value, charge_);
  };
  if (!number(seed)) return false;
  for (uint32_t u = 0; u < part_.size(); ++u) {
    const uint32_t i = part_[u], row = uint32_t(matrix_.columns.size());
    if (!push(matrix_.starts, row, charge_) || !add(u, 0)) return false;
    for (uint32_t e = starts_[i]; e < starts_[i + 1]; ++e) {
      const uint32_t v = neighbours_[e], k = v - fixed_;
      // A face may have a vertex twice, which says nothing.
      if (v >= fixed_ && k == i) continue;
      matrix_.values[row] += 1;
      if (v < fixed_) {
        isHeld_ = true;
      } else if (entryOf_[k] > row) {
        matrix_.values[entryOf_[k]] -= 1;
      } else {
        entryOf_[k] = uint32_t(matrix_.columns.size());
        if (!number(k) || !add(numberOf_[k], -1)) return false;
      }
    }
    if (!work_.tick(100)) return false;
  }
  return push(matrix_.starts, uint32_t(matrix_.columns.size()), charge_);
}

/// For each vertex of the part the sums of up to three values of its fixed neighbours, into x_.
void FreeVertices::sumFixed(uint32_t size, const double* values, uint32_t channels) {
  for (uint32_t u = 0; u < part_.size(); ++u) {
    double sums[3] = {0, 0, 0};
    for (uint32_t e = starts_[part_[u]]; e < starts_[part_[u] + 1]; ++e)
      for (uint32_t k = 0; k < channels && neighbours_[e] < fixed_; ++k)
        sums[k] += values[size_t(neighbours_[e]) * size + k];
    x_[u] = {sums[0], sums[1], sums[2]};
  }
}

bool FreeVertices::solve(uint32_t size, const double* fixedValues, double* freeValues) {
  for (uint32_t seed = 0; seed < numberOf_.size(); ++seed) {
    if (numberOf_[seed] != kNone) continue;
    if (!collect(seed)) return false;
    if (!isHeld_) continue;
    if (!reserve(x_, part_.size(), charge_)) return false;
    x_.resize(part_.size());
    SparseCholesky cholesky(work_);
    if (!cholesky.factor(matrix_, places_)) {
      if (!work_.going()) return false;
      continue;
    }
    for (uint32_t c = 0; c < size; c += 3) {
      const uint32_t channels = size - c < 3 ? size - c : 3;
      sumFixed(size, fixedValues + c, channels);
      cholesky.solve(x_);
      for (uint32_t u = 0; u < part_.size(); ++u) {
        const double found[3] = {x_[u].x, x_[u].y, x_[u].z};
        for (uint32_t k = 0; k < channels; ++k)
          freeValues[size_t(part_[u]) * size + c + k] = found[k];
      }
      if (!work_.tick(500 * uint64_t(part_.size()))) return false;
    }
  }
  return true;
}

}  // namespace

bool carryOn(const MeshView& mesh, uint32_t fixedCount, uint32_t size,
             ArrayView<const double> fixedValues, Work& work, std::vector<double>& freeValues) {
  Charge charge(work);
  const size_t n = mesh.positions.size() / 3 - fixedCount;
  if (!charge.add(uint64_t(n) * size * sizeof(double))) return false;
  freeValues.assign(n * size, 0);
  FreeVertices vertices(mesh, fixedCount, work);
  return vertices.link() && vertices.solve(size, fixedValues.data(), freeValues.data());
}

}  // namespace sf
