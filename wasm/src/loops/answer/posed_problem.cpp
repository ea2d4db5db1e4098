#include "loops/answer/posed_problem.h"

#include <utility>

namespace sf {

LoopTriangles PosedProblem::fromResult(ArrayView<const uint32_t> triangles) const {
  std::vector<uint32_t> number(resultIndex.size(), kNone), numbered;
  for (uint32_t v = 0; v < resultIndex.size(); ++v) number[resultIndex[v]] = v;
  numbered.reserve(triangles.size());
  for (const uint32_t v : triangles) numbered.push_back(v < number.size() ? number[v] : kNone);
  return {loops, numbered};
}

LoopTriangles PosedProblem::ontoInput(ArrayView<const uint32_t> triangles,
                                      const LoopSet& input) const {
  const uint32_t n = input.vertexCount();
  std::vector<uint32_t> moved;
  moved.reserve(triangles.size());
  for (uint32_t v : triangles) {
    if (v >= n && v - n < inserted.size()) {
      const InsertedVertex& on = inserted[v - n];
      const uint32_t from = input.first(on.loop) + on.edge;
      v = on.parameter < 0.5 ? from : input.next(from);
    }
    moved.push_back(v);
  }
  return {input, moved};
}

PosedProblem posedAsGiven(const LoopSet& unit, ArrayView<const double> normals) {
  PosedProblem problem;
  problem.loops = unit;
  problem.resultIndex.resize(unit.vertexCount());
  for (uint32_t v = 0; v < unit.vertexCount(); ++v) problem.resultIndex[v] = v;
  problem.normals.assign(normals.begin(), normals.end());
  return problem;
}

PosedProblem posedProtected(const LoopSet& unit, ArrayView<const double> normals,
                            const ScaledWeights& weights, ProtectedLoops safe) {
  PosedProblem problem;
  problem.loops = std::move(safe.loops);
  problem.resultIndex = std::move(safe.origin);
  problem.inserted = std::move(safe.inserted);
  problem.insertedPositions.resize(problem.inserted.size());
  const uint32_t n = unit.vertexCount();
  for (uint32_t v = 0; v < problem.loops.vertexCount(); ++v) {
    uint32_t edge = problem.resultIndex[v];
    if (edge >= n) {
      const uint32_t i = edge - n;
      const Vec3 p = problem.loops.position(v);
      problem.insertedPositions[i] = {weights.length(p.x), weights.length(p.y),
                                      weights.length(p.z)};
      edge = unit.first(problem.inserted[i].loop) + problem.inserted[i].edge;
    }
    if (normals.empty()) continue;
    const double* normal = &normals[3 * size_t(edge)];
    problem.normals.insert(problem.normals.end(), normal, normal + 3);
  }
  return problem;
}

}  // namespace sf
