#include "mesh/joint_cost.h"

#include <algorithm>
#include <cmath>

#include "loops/span.h"

namespace sf {
namespace {

/// Memory of one span.
constexpr uint64_t kMostBytes = 64 << 20;

/// A part of some work, that may end before it does.
struct PartOfWork {
  Work& whole;
  Work own;
  uint64_t most;
  uint64_t counted = 0;

  PartOfWork(Work& work, uint64_t units)
      : whole(work),
        own(
            size_t(std::min(kMostBytes, work.left())),
            [](void* user, double, double, double) {
              PartOfWork& part = *static_cast<PartOfWork*>(user);
              return part.count() && part.own.spent() < part.most;
            },
            this),
        most(units) {}
  PartOfWork(const PartOfWork&) = delete;
  PartOfWork& operator=(const PartOfWork&) = delete;

  bool count() {
    const uint64_t spent = own.spent(), more = spent - counted;
    counted = spent;
    return whole.tick(uint32_t(std::min<uint64_t>(more, 1u << 30)));
  }
};

}  // namespace

uint32_t edgesAlong(const LoopSet& loops, ArrayView<const uint32_t> triangles) {
  uint32_t along = 0;
  for (size_t t = 0; t < triangles.size(); t += 3)
    for (int k = 0; k < 3; ++k) along += loops.next(triangles[t + k]) == triangles[t + (k + 1) % 3];
  return along;
}

JointCost::JointCost(const MeshView& mesh, const Rims& rims, Work& work)
    : mesh_(mesh), rims_(rims), work_(work), alone_(rims.count(), std::nan("")) {}

bool JointCost::costOf(ArrayView<const uint32_t> rims, double& cost) {
  cost = std::numeric_limits<double>::infinity();
  if (spent_ >= kMostUnitsOfAll) return true;
  std::vector<Vec3> positions;
  std::vector<uint32_t> starts{0};
  std::vector<double> normals;
  for (const uint32_t r : rims) {
    for (uint32_t e = rims_.starts[r]; e < rims_.starts[r + 1]; ++e) {
      positions.push_back(pointAt(mesh_.positions, rims_.vertices[e]));
      appendBoundaryNormal(rims_.normals[e], normals);
    }
    starts.push_back(uint32_t(positions.size()));
  }
  SpanOptions options;
  options.boundaryNormals = normals;
  options.space = Space::Delaunay;
  const bool isShort = work_.left() < kMostBytes;
  PartOfWork part(work_, std::min(kMostUnits, kMostUnitsOfAll - spent_));
  Span span;
  const LoopSet loops(positions, starts);
  const Outcome outcome = spanLoops(loops, options, part.own, span);
  spent_ += part.own.spent();
  if (isShort && outcome.status == Status::OutOfMemory) work_.fail(Status::OutOfMemory);
  if (!part.count()) return false;
  // With vertices put on the rims the costs could not be compared.
  if (!outcome.ok() || !span.found || !span.inserted.empty()) return true;
  const uint32_t along = edgesAlong(loops, span.triangles);
  if (along == 0 || along == loops.vertexCount()) cost = span.cost;
  return true;
}

bool JointCost::compare(uint32_t first, uint32_t second, Verdict& verdict) {
  verdict = Verdict::Unknown;
  const auto size = [&](uint32_t r) { return rims_.starts[r + 1] - rims_.starts[r]; };
  if (size(first) + size(second) > kMostVertices) return true;
  double apart = 0;
  const uint32_t pair[] = {first, second};
  for (const uint32_t& r : pair) {
    if (std::isnan(alone_[r]) && !costOf({&r, 1}, alone_[r])) return false;
    apart += alone_[r];
  }
  if (!std::isfinite(apart)) return true;
  double joint;
  if (!costOf({pair, 2}, joint)) return false;
  if (std::isfinite(joint)) verdict = joint < apart ? Verdict::Together : Verdict::Apart;
  return true;
}

}  // namespace sf
