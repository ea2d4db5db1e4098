#include "mesh/fill.h"

#include <algorithm>
#include <cmath>

#include "mesh/fair.h"
#include "mesh/refine.h"

namespace sf {
namespace {

/// Rings of faces around a hole: as many as the smoothest fairing looks at, and one more.
constexpr uint32_t kRings = 5;
/// Rims up to this long are spanned among all triangles: beyond that Delaunay triangles do.
constexpr uint32_t kMostForAll = 300;
/// How often the way of fairing is halved before all of it is given up.
constexpr int kHalvings = 4;
/// More pairs of intersecting faces are not listed.
constexpr size_t kMostPairs = 10000;

FillReason reasonOf(Status status) {
  switch (status) {
    case Status::RepeatedVertex: return FillReason::RepeatedVertex;
    case Status::LoopsIntersect: return FillReason::RimsIntersect;
    case Status::TooLarge: return FillReason::TooLarge;
    default: return FillReason::NoSurface;
  }
}

bool endsWork(Status status) { return status == Status::OutOfMemory || status == Status::Stopped; }

Vec3 normalOf(ArrayView<const double> positions, uint32_t a, uint32_t b, uint32_t c) {
  const Vec3 p = pointAt(positions, a);
  return cross(pointAt(positions, b) - p, pointAt(positions, c) - p);
}

}  // namespace

struct HoleFiller::Hole {
  std::vector<uint32_t> edges;     // of the rims, in their order: numbers in Rims
  std::vector<uint32_t> vertices;  // input numbers of the fixed vertices: those of the rims first
  LocalSurface surface;            // fixed vertices as in `vertices`, rims first
  std::vector<double> spanned;     // positions before fairing
  uint32_t rimVertices = 0;
};

HoleFiller::HoleFiller(const MeshView& mesh, const Adjacency& adjacency, const Rims& rims, Work& work)
    : mesh_(mesh), adjacency_(adjacency), rims_(rims), work_(work), charge_(work), tree_(work) {}

bool HoleFiller::prepare() {
  const size_t n = mesh_.positions.size() / 3, m = mesh_.faces.size() / 3;
  if (!reserve(fanStarts_, n + 1, charge_) || !reserve(fans_, 3 * m, charge_) || !reserve(local_, n, charge_)) return false;
  fanStarts_.assign(n + 1, 0);
  const auto counts = [&](size_t f) { return adjacency_.corners[3 * f] != kNone; };
  for (size_t f = 0; f < m; ++f)
    if (counts(f))
      for (int k = 0; k < 3; ++k) ++fanStarts_[mesh_.faces[3 * f + k] + 1];
  for (size_t v = 0; v < n; ++v) fanStarts_[v + 1] += fanStarts_[v];
  fans_.assign(fanStarts_[n], 0);
  std::vector<uint32_t> next(fanStarts_.begin(), fanStarts_.end() - 1);
  for (size_t f = 0; f < m; ++f)
    if (counts(f))
      for (int k = 0; k < 3; ++k) fans_[next[mesh_.faces[3 * f + k]]++] = uint32_t(f);
  local_.assign(n, kNone);
  return work_.tick(uint32_t(std::min<size_t>(20 * (n + m), 1u << 30))) && tree_.build(mesh_, 0, uint32_t(m));
}

bool HoleFiller::isFaceOfMesh(uint32_t a, uint32_t b, uint32_t c) const {
  for (uint32_t i = fanStarts_[a]; i < fanStarts_[a + 1]; ++i) {
    const uint32_t* f = mesh_.faces.data() + 3 * size_t(fans_[i]);
    const auto has = [&](uint32_t v) { return f[0] == v || f[1] == v || f[2] == v; };
    if (has(b) && has(c)) return true;
  }
  return false;
}

/// Spans the rims. The triangles of the patch are wound as the faces that fill the hole are.
Status HoleFiller::span(Hole& hole, const FillOptions& options, FilledHole& result) {
  std::vector<Vec3> positions;
  std::vector<uint32_t> starts{0};
  std::vector<double> normals;
  for (size_t i = 0; i < hole.edges.size(); ++i) {
    const uint32_t e = hole.edges[i];
    positions.push_back(pointAt(mesh_.positions, rims_.vertices[e]));
    const Vec3 n = rims_.normals[e];
    const bool isKnown = dot(n, n) > 0;
    for (const double x : {n.x, n.y, n.z}) normals.push_back(isKnown ? x : std::nan(""));
    const bool endsRim = std::binary_search(rims_.starts.begin(), rims_.starts.end(), e + 1);
    if (endsRim) starts.push_back(uint32_t(i + 1));
  }
  const LoopSet loops({positions.data(), positions.size()}, {starts.data(), starts.size()});
  SpanOptions span;
  span.areaWeight = options.areaWeight;
  span.perimeterWeight = options.perimeterWeight;
  span.dihedralWeight = options.dihedralWeight;
  span.boundaryNormals = normals;

  // Wider spaces only where narrower ones hold nothing, or only a surface with vertices on the rim.
  std::vector<Space> spaces{options.space};
  if (options.space == Space::Auto) {
    if (loops.loopCount() == 1 && loops.vertexCount() <= kMostForAll) spaces = {Space::All};
    else spaces = {Space::Delaunay, Space::Near, Space::Auto};
  }
  Span found;
  FillReason reason = FillReason::NoSurface;
  for (const Space space : spaces) {
    span.space = space;
    const Outcome outcome = spanLoops(loops, span, work_, found);
    if (endsWork(outcome.status)) return outcome.status;
    if (outcome.status != Status::Ok) {
      reason = reasonOf(outcome.status);
      if (outcome.status != Status::TooLarge) break;
      continue;
    }
    if (found.found && found.inserted.empty()) break;
    reason = found.found ? FillReason::InsertedVertices : FillReason::NoSurface;
    found.found = false;
  }
  if (!found.found) {
    result.reason = reason;
    return Status::Ok;
  }
  result.cost = found.cost, result.lowerBound = found.lowerBound, result.optimal = found.optimal;

  // The triangle at the first edge tells which way round the surface is.
  std::vector<uint32_t>& triangles = found.triangles;
  const uint32_t second = loops.next(0);
  for (size_t t = 0; t < triangles.size(); t += 3) {
    bool isBackwards = false;
    for (int k = 0; k < 3; ++k) isBackwards |= triangles[t + k] == second && triangles[t + (k + 1) % 3] == 0;
    if (!isBackwards) continue;
    for (size_t i = 0; i < triangles.size(); i += 3) std::swap(triangles[i + 1], triangles[i + 2]);
    break;
  }
  for (size_t t = 0; t < triangles.size(); t += 3) {
    const auto at = [&](size_t k) { return rims_.vertices[hole.edges[triangles[t + k]]]; };
    if (isFaceOfMesh(at(0), at(1), at(2))) {
      result.reason = FillReason::DuplicateFace;
      return Status::Ok;
    }
  }
  hole.surface.triangles.insert(hole.surface.triangles.end(), triangles.begin(), triangles.end());
  result.status = FillStatus::Filled;
  return Status::Ok;
}

/// Numbers the vertices of the rims and of some rings around them, and lists the faces between.
void HoleFiller::surround(Hole& hole) {
  std::vector<uint32_t>& vertices = hole.vertices;
  for (const uint32_t e : hole.edges) vertices.push_back(rims_.vertices[e]);
  hole.rimVertices = uint32_t(vertices.size());
  // A vertex of two rims, where they touch, has two numbers; the mesh knows the first.
  for (uint32_t i = hole.rimVertices; i-- > 0;) local_[vertices[i]] = i;
  std::vector<uint32_t> faces;
  size_t ringStart = 0;
  for (uint32_t ring = 0; ring < kRings; ++ring) {
    const size_t ringEnd = vertices.size();
    for (size_t i = ringStart; i < ringEnd; ++i)
      for (uint32_t k = fanStarts_[vertices[i]]; k < fanStarts_[vertices[i] + 1]; ++k) faces.push_back(fans_[k]);
    for (size_t i = 0; i < faces.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        const uint32_t v = mesh_.faces[3 * size_t(faces[i]) + k];
        if (local_[v] != kNone) continue;
        local_[v] = uint32_t(vertices.size());
        vertices.push_back(v);
      }
    ringStart = ringEnd;
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  LocalSurface& surface = hole.surface;
  for (const uint32_t v : vertices) {
    const double* p = mesh_.positions.data() + 3 * size_t(v);
    surface.positions.insert(surface.positions.end(), p, p + 3);
  }
  for (const uint32_t f : faces) {
    const uint32_t* c = mesh_.faces.data() + 3 * size_t(f);
    const bool isTurned = adjacency_.turned[f] != 0;
    for (const uint32_t v : {c[0], c[isTurned ? 2 : 1], c[isTurned ? 1 : 2]}) surface.triangles.push_back(local_[v]);
  }
  surface.fixedVertices = uint32_t(vertices.size());
  surface.fixedTriangles = uint32_t(surface.triangles.size() / 3);
  for (const uint32_t v : vertices) local_[v] = kNone;
}

/// Whether one rim edge follows another.
bool HoleFiller::isNext(uint32_t e, uint32_t next) const {
  if (next == e + 1) return !std::binary_search(rims_.starts.begin(), rims_.starts.end(), next);
  // The last of a rim is followed by its first.
  const auto end = std::upper_bound(rims_.starts.begin(), rims_.starts.end(), e);
  return *end == e + 1 && *(end - 1) == next;
}

/// The mean angle between the patch and the faces along the rim.
double HoleFiller::rimAngle(const Hole& hole) const {
  const LocalSurface& s = hole.surface;
  double sum = 0;
  uint32_t count = 0;
  for (size_t t = 3 * size_t(s.fixedTriangles); t < s.triangles.size(); t += 3)
    for (int k = 0; k < 3; ++k) {
      const uint32_t a = s.triangles[t + k], b = s.triangles[t + (k + 1) % 3];
      if (a >= hole.rimVertices || b >= hole.rimVertices) continue;
      const uint32_t e = hole.edges[a];
      // Edges of the rim only: from a vertex to the next one of its rim.
      const bool isRimEdge = isNext(e, hole.edges[b]);
      if (!isRimEdge) continue;
      const Vec3 n = rims_.normals[e];
      if (dot(n, n) == 0) continue;
      sum += angleBetween(n, normalOf(s.positions, s.triangles[t], s.triangles[t + 1], s.triangles[t + 2]));
      ++count;
    }
  return count ? sum / count : 0;
}

/// Pairs of a face of the patch and another, both numbered as in the filled mesh.
bool HoleFiller::findPairs(const Hole& hole, size_t most, std::vector<FacePair>& pairs) {
  pairs.clear();
  const LocalSurface& s = hole.surface;
  const MeshView patch{s.positions, s.triangles};
  const uint32_t from = s.fixedTriangles, to = uint32_t(s.triangles.size() / 3);
  const uint32_t first = uint32_t((mesh_.faces.size() + newFaces_.size()) / 3);
  std::vector<FacePair> own;
  if (!findIntersections(patch, from, to, mesh_, tree_, most, work_, pairs)) return false;
  if (!findSelfIntersections(patch, from, to, most, work_, own)) return false;
  for (FacePair& p : pairs) p.first += first - from;
  for (const FacePair p : own) pairs.push_back({p.first + first - from, p.second + first - from});
  return true;
}

bool HoleFiller::append(const Hole& hole, FilledHole& result) {
  const LocalSurface& s = hole.surface;
  const uint32_t n = uint32_t(mesh_.positions.size() / 3), fixed = s.fixedVertices;
  const uint32_t firstNew = n + uint32_t(newPositions_.size() / 3);
  result.firstFace = uint32_t((mesh_.faces.size() + newFaces_.size()) / 3);
  const size_t coordinates = s.positions.size() - 3 * size_t(fixed), corners = s.triangles.size() - 3 * size_t(s.fixedTriangles);
  if (!charge_.add(8 * coordinates + 4 * corners)) return false;
  newPositions_.insert(newPositions_.end(), s.positions.begin() + 3 * size_t(fixed), s.positions.end());
  for (size_t i = 3 * size_t(s.fixedTriangles); i < s.triangles.size(); ++i) {
    const uint32_t v = s.triangles[i];
    newFaces_.push_back(v < fixed ? hole.vertices[v] : firstNew + v - fixed);
  }
  result.endFace = result.firstFace + uint32_t(corners / 3);
  return true;
}

Status HoleFiller::fill(ArrayView<const uint32_t> rims, const FillOptions& options, FilledHole& result) {
  result = {};
  Hole hole;
  for (const uint32_t r : rims)
    for (uint32_t e = rims_.starts[r]; e < rims_.starts[r + 1]; ++e) hole.edges.push_back(e);
  surround(hole);
  Status status = span(hole, options, result);
  if (status != Status::Ok || result.status == FillStatus::Failed) return status;
  result.rimAngleBefore = rimAngle(hole);

  LocalSurface& surface = hole.surface;
  const bool isExact = isFlat(surface);
  if (options.density > 0 && !isExact) {
    RefineOptions refining;
    refining.density = options.density;
    refining.maxNewVertices = options.maxNewVertices;
    status = refine(surface, refining, work_);
    if (status != Status::Ok) return status;
  }
  hole.spanned = surface.positions;
  if (options.fairing != Fairing::None && !isExact && surface.positions.size() > 3 * size_t(surface.fixedVertices)) {
    FairOptions fairing;
    double rough = 0;
    if (options.fairing == Fairing::Auto && !roughness(surface, work_, rough)) return work_.status();
    const bool isRough = rough > kRough;
    fairing.order = options.fairing == Fairing::Bending || isRough ? 2 : 3;
    Fairness fairness;
    status = fair(surface, fairing, work_, fairness);
    if (status != Status::Ok) return status;
    result.fairnessUsed = fairness.order;
  }

  // As much of the fairing as goes without intersections.
  const std::vector<double> faired = surface.positions;
  double share = 1;
  for (int halving = 0;; ++halving) {
    if (!findPairs(hole, kMostPairs, result.intersections)) return work_.status();
    if (result.intersections.empty() || result.fairnessUsed == 0 || share == 0) break;
    share = halving < kHalvings ? share / 2 : 0;
    for (size_t i = 3 * size_t(surface.fixedVertices); i < faired.size(); ++i)
      surface.positions[i] = hole.spanned[i] + share * (faired[i] - hole.spanned[i]);
  }
  result.movedLess = 1 - share;
  if (!result.intersections.empty()) result.status = FillStatus::SelfIntersecting;
  result.rimAngleAfter = rimAngle(hole);
  return append(hole, result) ? Status::Ok : work_.status();
}

}  // namespace sf
