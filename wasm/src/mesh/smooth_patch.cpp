#include "mesh/smooth_patch.h"

#include <utility>

#include "base/charge.h"

namespace sf {
namespace {

// The coarse patch has edges of twice the length, and so about a quarter of the vertices.
constexpr double kCoarse = 0.5;
constexpr uint32_t kCoarseShare = 4;
// Shares of the way that are tried: 1, 1/2, ..., and then none.
constexpr int kHalvings = 5;
// Pairs that are counted: more are as bad.
constexpr size_t kMostPairs = 1000;

uint32_t newVertices(const LocalSurface& surface) {
  return uint32_t(surface.positions.size() / 3) - surface.fixedVertices;
}

void roundToFloats(LocalSurface& surface) {
  for (size_t i = 3 * size_t(surface.fixedVertices); i < surface.positions.size(); ++i)
    surface.positions[i] = double(float(surface.positions[i]));
}

bool countPairs(const LocalSurface& surface, MeshView mesh, const TriangleTree& tree, Work& work,
                uint32_t& count) {
  PatchPairs pairs;
  if (!findPatchPairs(surface, mesh, tree, kMostPairs, work, pairs)) return false;
  count = uint32_t(pairs.count());
  return true;
}

}  // namespace

bool findFairOrder(const LocalSurface& surface, Work& work, uint32_t& order) {
  double rough;
  if (!roughness(surface, work, rough)) return false;
  order = rough > kRough ? 2 : 3;
  return true;
}

bool findPatchPairs(const LocalSurface& surface, MeshView mesh, const TriangleTree& tree,
                    size_t most, Work& work, PatchPairs& pairs) {
  pairs = {};
  const MeshView own{surface.positions, surface.triangles};
  const uint32_t from = surface.fixedTriangles, to = uint32_t(surface.triangles.size() / 3);
  return findSelfIntersections(own, from, to, most, work, pairs.own) &&
         findIntersections(own, from, to, mesh, tree, most, work, pairs.others);
}

Status smoothPatch(LocalSurface& surface, const RefineOptions& refining, const FairOptions& fairing,
                   Work& work, Fairness& result) {
  result = {};
  FairOptions finish = fairing;
  if (fairing.order > 1 && refining.density > 0) {
    RefineOptions coarse = refining;
    coarse.density *= kCoarse;
    coarse.maxNewVertices = refining.maxNewVertices / kCoarseShare;
    const uint32_t before = newVertices(surface);
    Status status = refine(surface, coarse, work);
    if (status == Status::Ok) status = fair(surface, fairing, work, result);
    if (status != Status::Ok) return status;
    RefineOptions fine = refining;
    fine.maxNewVertices -= newVertices(surface) - before;
    status = refine(surface, fine, work);
    if (status != Status::Ok) return status;
    if (result.order > 0) finish.order = result.order;
    // Steps to the least variation begin from any surface, those to the least bending from a smooth one.
    const uint32_t most = fairing.stepsOf(result.order) == 0 ? 2 : result.order == 2 ? 1 : 0;
    if (result.order > 0 && fairing.rounds > most) finish.rounds = most;
  } else {
    const Status status = refine(surface, refining, work);
    if (status != Status::Ok) return status;
  }
  if (fairing.order == 0) return work.status();
  const double moved = result.moved;
  const Status status = fair(surface, finish, work, result);
  result.moved += moved;
  return status;
}

Status smoothPatchApart(LocalSurface& surface, const RefineOptions& refining,
                        const FairOptions& fairing, MeshView mesh, const TriangleTree& tree,
                        bool inFloats, Work& work, Smoothed& result) {
  result = {};
  Charge charge(work);
  if (!charge.add(surface.positions.size() * 8 + surface.triangles.size() * 4))
    return work.status();
  LocalSurface first = surface;
  Status status = smoothPatch(surface, refining, fairing, work, result.fairness);
  if (status != Status::Ok) return status;
  if (inFloats) roundToFloats(surface);
  if (!countPairs(surface, mesh, tree, work, result.pairs)) return work.status();
  if (result.pairs == 0 || fairing.order == 0) return work.status();

  // From the beginning, with one and the same vertices before and after.
  surface = std::move(first);
  status = refine(surface, refining, work);
  if (status != Status::Ok) return status;
  const std::vector<double> before = surface.positions;
  status = fair(surface, fairing, work, result.fairness);
  if (status != Status::Ok) return status;
  const std::vector<double> after = surface.positions;
  result.share = 1;
  for (int i = 0; i <= kHalvings; ++i) {
    for (size_t p = 3 * size_t(surface.fixedVertices); p < after.size(); ++p)
      surface.positions[p] = before[p] + result.share * (after[p] - before[p]);
    if (inFloats) roundToFloats(surface);
    if (!countPairs(surface, mesh, tree, work, result.pairs)) return work.status();
    if (result.pairs == 0) break;
    result.share = i + 1 < kHalvings ? result.share / 2 : 0;
  }
  result.fairness.moved *= result.share;
  return work.status();
}

}  // namespace sf
