#include "mesh/fill.h"

#include <algorithm>
#include <cmath>

#include "base/sort.h"
#include "mesh/joint_cost.h"
#include "mesh/smooth_patch.h"
#include "mesh/stitch.h"
#include "mesh/touch.h"

namespace sf {
namespace {

/// Rings of faces around a hole: as many as the smoothest fairing looks at, and one more.
constexpr uint32_t kRings = 5;
/// Rims up to this long are spanned among all triangles: beyond that Delaunay triangles do.
constexpr uint32_t kMostForAll = 300;
/// Angles along the rim below this are none.
constexpr double kExact = 1e-3;
/// How far corners at one vertex are moved apart to be spanned, in lengths of the shorter edge there: too little to
/// change angles, and much more than rounding.
constexpr double kApart = 1e-6;
/// More pairs of intersecting faces are not listed.
constexpr size_t kMostPairs = 10000;

FillReason reasonOf(Status status) {
  switch (status) {
    case Status::RepeatedVertex:
      return FillReason::RepeatedVertex;
    case Status::LoopsIntersect:
      return FillReason::RimsIntersect;
    case Status::TooLarge:
      return FillReason::TooLarge;
    default:
      return FillReason::NoSurface;
  }
}

bool endsWork(Status status) { return status == Status::OutOfMemory || status == Status::Stopped; }

Vec3 normalOf(ArrayView<const double> positions, uint32_t a, uint32_t b, uint32_t c) {
  const Vec3 p = pointAt(positions, a);
  return cross(pointAt(positions, b) - p, pointAt(positions, c) - p);
}

}  // namespace

/// A corner of the loops around a patch, and the edge from it to the next one.
struct HoleFiller::Corner {
  uint32_t vertex;         // of the filled mesh
  uint32_t edge = kNone;   // the rim edge that begins there, or kNone
  bool isCrease = false;   // the face at that edge is across a crease, and does not count
  uint32_t local = kNone;  // the vertex in `Hole::vertices`: of several corners, where rims touch
  uint32_t next = kNone, before = kNone;  // corners of the same loop
  uint32_t other = kNone;                 // the corner before this one at the same vertex

  /// Whether the patch should go on the face at the edge.
  bool goesOn() const { return edge != kNone && !isCrease; }
};

struct HoleFiller::Hole {
  std::vector<Corner> corners;     // loop after loop, as faces that fill them run
  std::vector<uint32_t> starts;    // [k+1] in `corners`
  bool crossesSeam = false;        // one of its rims does
  bool isPart = false;             // between creases, which bound what is around it as well
  std::vector<uint32_t> vertices;  // of the filled mesh: the fixed vertices, those of corners first
  std::vector<uint32_t> lastCorners;  // [vertices of corners] the last one there
  LocalSurface surface;               // fixed vertices as in `vertices`

  bool isCorner(uint32_t local) const { return local < lastCorners.size(); }
  /// Whether rims touch, so that the loops come to a vertex again.
  bool touches() const { return lastCorners.size() < corners.size(); }
  /// The corner whose edge runs between two local vertices, or kNone.
  uint32_t cornerBetween(uint32_t from, uint32_t to) const {
    if (!isCorner(from)) return kNone;
    for (uint32_t c = lastCorners[from]; c != kNone; c = corners[c].other)
      if (corners[corners[c].next].local == to) return c;
    return kNone;
  }
  /// Whether another part begins at a vertex of a part with one loop.
  bool isBetween(uint32_t local) const {
    const Corner& corner = corners[lastCorners[local]];
    return corner.edge == kNone || corners[corner.before].edge == kNone;
  }
};

bool survey(const MeshView& mesh, const Adjacency& adjacency, const Rims& rims, Work& work,
            Charge& charge, Surroundings& result) {
  const size_t n = mesh.positions.size() / 3, m = mesh.faces.size() / 3;
  std::vector<uint32_t>&starts = result.fanStarts, &fans = result.fans;
  if (!reserve(starts, n + 1, charge) || !reserve(fans, 3 * m, charge) ||
      !reserve(result.isOfTwoRims, n, charge))
    return false;
  starts.assign(n + 1, 0);
  const auto counts = [&](size_t f) { return adjacency.corners[3 * f] != kNone; };
  for (size_t f = 0; f < m; ++f)
    if (counts(f))
      for (int k = 0; k < 3; ++k) ++starts[mesh.faces[3 * f + k] + 1];
  for (size_t v = 0; v < n; ++v) starts[v + 1] += starts[v];
  fans.assign(starts[n], 0);
  std::vector<uint32_t> next(starts.begin(), starts.end() - 1);
  for (size_t f = 0; f < m; ++f)
    if (counts(f))
      for (int k = 0; k < 3; ++k) fans[next[mesh.faces[3 * f + k]]++] = uint32_t(f);
  // How many rims there are at each vertex, up to two.
  result.isOfTwoRims.assign(n, 0);
  for (const uint32_t v : rims.vertices)
    if (result.isOfTwoRims[v] < 2) ++result.isOfTwoRims[v];
  for (uint8_t& count : result.isOfTwoRims) count = count == 2;
  return work.tick(20 * (uint64_t(n) + m)) && result.tree.build(mesh, 0, uint32_t(m), work, charge);
}

HoleFiller::HoleFiller(const MeshView& mesh, const Adjacency& adjacency, const Rims& rims,
                       const Surroundings& around, Work& work)
    : mesh_(mesh),
      adjacency_(adjacency),
      rims_(rims),
      around_(around),
      work_(work),
      charge_(work) {}

bool HoleFiller::isInFace(uint32_t a, uint32_t b, uint32_t c) const {
  if (a >= mesh_.positions.size() / 3) return false;
  for (uint32_t i = around_.fanStarts[a]; i < around_.fanStarts[a + 1]; ++i) {
    const uint32_t* f = mesh_.faces.data() + 3 * size_t(around_.fans[i]);
    const auto has = [&](uint32_t v) { return f[0] == v || f[1] == v || f[2] == v; };
    if (has(b) && (c == kNone || has(c))) return true;
  }
  return false;
}

/// Spans the rims. The triangles of the patch are wound as the faces that fill the hole are.
Status HoleFiller::span(Hole& hole, const FillOptions& options, FilledHole& result) {
  std::vector<Vec3> positions;
  std::vector<double> normals;
  for (const Corner& corner : hole.corners) {
    positions.push_back(placeToSpan(hole, corner));
    appendBoundaryNormal(corner.goesOn() ? rims_.normals[corner.edge] : Vec3{0, 0, 0}, normals);
  }
  const std::vector<uint32_t>& starts = hole.starts;
  const LoopSet loops({positions.data(), positions.size()}, {starts.data(), starts.size()});
  SpanOptions span;
  span.areaWeight = options.areaWeight;
  span.perimeterWeight = options.perimeterWeight;
  span.dihedralWeight = options.dihedralWeight;
  span.boundaryNormals = normals;
  // Then there is something to keep when the time is over.
  span.bestSoFar = options.clock != nullptr;

  // Wider spaces only where narrower ones hold nothing, or only a surface with vertices on the rim.
  std::vector<Space> spaces{options.space};
  if (options.space == Space::Auto) {
    if (loops.loopCount() == 1 && loops.vertexCount() <= kMostForAll)
      spaces = {Space::All};
    else
      spaces = {Space::Delaunay, Space::Near, Space::Auto};
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
    if (found.found && found.inserted.size() <= options.refining.maxNewVertices)
      result.splits = splitsOf(hole, found);
    found.found = false;
  }
  if (!found.found) {
    result.reason = reason;
    return Status::Ok;
  }
  result.splits.clear();
  result.cost = found.cost, result.lowerBound = found.lowerBound, result.optimal = found.optimal;

  // The triangle at the first edge tells which way round the surface is.
  std::vector<uint32_t>& triangles = found.triangles;
  const uint32_t second = loops.next(0);
  for (size_t t = 0; t < triangles.size(); t += 3) {
    bool isBackwards = false;
    for (int k = 0; k < 3; ++k)
      isBackwards |= triangles[t + k] == second && triangles[t + (k + 1) % 3] == 0;
    if (!isBackwards) continue;
    for (size_t i = 0; i < triangles.size(); i += 3) std::swap(triangles[i + 1], triangles[i + 2]);
    break;
  }
  // Larger patches share no face with the mesh once chords are split.
  const auto& corners = hole.corners;
  if (corners.size() == 3 && isInFace(corners[0].vertex, corners[1].vertex, corners[2].vertex)) {
    result.reason = FillReason::DuplicateFace;
    return Status::Ok;
  }
  if (!hole.crossesSeam && edgesAlong(loops, triangles) != loops.vertexCount()) {
    result.reason = FillReason::OpposedRims;
    return Status::Ok;
  }
  for (uint32_t& v : triangles) v = corners[v].local;
  if (hole.touches() && !hasSimpleEdges(triangles)) {
    result.reason = FillReason::RepeatedVertex;
    return Status::Ok;
  }
  hole.surface.triangles.insert(hole.surface.triangles.end(), triangles.begin(), triangles.end());
  result.status = FillStatus::Filled;
  return Status::Ok;
}

/// Where rims touch, each corner at the vertex is moved a little into its own gap.
Vec3 HoleFiller::placeToSpan(const Hole& hole, const Corner& corner) const {
  const Vec3 at = point(corner.vertex);
  if (corner.other == kNone && &hole.corners[hole.lastCorners[corner.local]] == &corner) return at;
  const Corner &before = hole.corners[corner.before], &next = hole.corners[corner.next];
  const Vec3 in = at - point(before.vertex), out = point(next.vertex) - at;
  const double shorter = std::min(length(in), length(out));
  if (before.edge == kNone || corner.edge == kNone || !(shorter > 0)) return at;
  // Away from the faces at both edges; or along these, where the gap has no width.
  Vec3 inward = (1 / length(in)) * cross(rims_.normals[before.edge], in) +
                (1 / length(out)) * cross(rims_.normals[corner.edge], out);
  if (!(length(inward) > kExact)) inward = (1 / length(out)) * out - (1 / length(in)) * in;
  const double size = length(inward);
  return size > 0 ? at + (kApart * shorter / size) * inward : at;
}

/// Whether the faces around each vertex that rims touch at, with new ones from `firstFace` on, are one fan.
bool HoleFiller::areFans(const Hole& hole, uint32_t firstFace) const {
  const size_t from = 3 * (firstFace - mesh_.faces.size() / 3);
  for (const Corner& corner : hole.corners) {
    if (corner.other == kNone) continue;
    std::vector<uint32_t> triangles(newFaces_.begin() + ptrdiff_t(from), newFaces_.end());
    const uint32_t v = corner.vertex;
    for (uint32_t i = around_.fanStarts[v]; i < around_.fanStarts[v + 1]; ++i)
      appendFace(around_.fans[i], triangles);
    if (!isFan(triangles, v)) return false;
  }
  return true;
}

/// Appends a face, turned if the adjacency turns it.
void HoleFiller::appendFace(uint32_t face, std::vector<uint32_t>& triangles) const {
  const uint32_t* c = mesh_.faces.data() + 3 * size_t(face);
  const bool isTurned = adjacency_.turned[face] != 0;
  triangles.insert(triangles.end(), {c[0], c[isTurned ? 2 : 1], c[isTurned ? 1 : 2]});
}

/// Where a span has put vertices on the rims.
std::vector<RimSplit> HoleFiller::splitsOf(const Hole& hole, const Span& span) const {
  std::vector<RimSplit> splits;
  for (const InsertedVertex& v : span.inserted) {
    const uint32_t corner = hole.starts[v.loop] + v.edge, edge = hole.corners[corner].edge;
    if (edge == kNone || adjacency_.isCut(rims_.halves[edge])) return {};
    splits.push_back({rims_.halves[edge] / 3, hole.corners[corner].vertex,
                      hole.corners[hole.corners[corner].next].vertex, v.parameter});
  }
  return splits;
}

/// Whether an edge that is not of the rims is in the mesh already, or may be in another patch.
bool HoleFiller::isTaken(uint32_t a, uint32_t b) const {
  const uint32_t n = uint32_t(mesh_.positions.size() / 3);
  if (a >= n || b >= n) return false;
  return (around_.isOfTwoRims[a] && around_.isOfTwoRims[b]) || isInFace(a, b, kNone);
}

/// The same for the edges around a part of a hole, which cannot be split.
bool HoleFiller::isBorderTaken(const Hole& hole) const {
  const size_t n = hole.corners.size();
  for (size_t i = 0; i < n; ++i)
    if (hole.corners[i].edge == kNone &&
        isTaken(hole.corners[i].vertex, hole.corners[(i + 1) % n].vertex))
      return true;
  return false;
}

/// Whether an edge of the patch runs between two corners, and is in the mesh already or may be in another patch.
bool HoleFiller::isTakenChord(const Hole& hole, uint32_t a, uint32_t b) const {
  if (!hole.isCorner(a) || !hole.isCorner(b)) return false;
  if (hole.cornerBetween(a, b) != kNone || hole.cornerBetween(b, a) != kNone) return false;
  const bool isAlongBorder = hole.isPart && hole.isBetween(a) && hole.isBetween(b);
  return isAlongBorder || isTaken(hole.vertices[a], hole.vertices[b]);
}

uint32_t HoleFiller::countTakenChords(const Hole& hole) const {
  const LocalSurface& s = hole.surface;
  uint32_t halves = 0;
  for (size_t t = 3 * size_t(s.fixedTriangles); t < s.triangles.size(); t += 3)
    for (int k = 0; k < 3; ++k)
      halves += isTakenChord(hole, s.triangles[t + k], s.triangles[t + (k + 1) % 3]);
  return halves / 2;
}

/// Splits taken chords, so that no edge gets more than two faces. The shape stays as it is.
void HoleFiller::splitChords(Hole& hole, bool inFloats) {
  LocalSurface& s = hole.surface;
  // The triangles grow while they are looked at: halves are looked at again.
  for (size_t t = 3 * size_t(s.fixedTriangles); t < s.triangles.size(); t += 3)
    for (int k = 0; k < 3; ++k) {
      const uint32_t a = s.triangles[t + k], b = s.triangles[t + (k + 1) % 3];
      if (!isTakenChord(hole, a, b)) continue;
      const uint32_t middle = uint32_t(s.positions.size() / 3);
      const Vec3 m = 0.5 * (pointAt(s.positions, a) + pointAt(s.positions, b));
      for (const double x : {m.x, m.y, m.z}) s.positions.push_back(inFloats ? double(float(x)) : x);
      const size_t end = s.triangles.size();
      for (size_t u = t; u < end; u += 3)
        for (int j = 0; j < 3; ++j) {
          const uint32_t p = s.triangles[u + j], q = s.triangles[u + (j + 1) % 3],
                         r = s.triangles[u + (j + 2) % 3];
          if (!((p == a && q == b) || (p == b && q == a))) continue;
          s.triangles[u + (j + 1) % 3] = middle;
          s.triangles.insert(s.triangles.end(), {middle, q, r});
          break;
        }
    }
}

/// The faces in some rings of vertices around the rims; `local_` numbers the vertices.
void HoleFiller::takeRings(Hole& hole, std::vector<uint32_t>& faces) {
  std::vector<uint32_t>& vertices = hole.vertices;
  size_t ringStart = 0, seen = 0;
  for (uint32_t ring = 0; ring < kRings; ++ring) {
    const size_t ringEnd = vertices.size();
    for (size_t i = ringStart; i < ringEnd; ++i)
      for (uint32_t k = around_.fanStarts[vertices[i]]; k < around_.fanStarts[vertices[i] + 1]; ++k)
        faces.push_back(around_.fans[k]);
    for (; seen < faces.size(); ++seen)
      for (int k = 0; k < 3; ++k) {
        const uint32_t v = mesh_.faces[3 * size_t(faces[seen]) + k];
        if (local_[v] != kNone) continue;
        local_[v] = uint32_t(vertices.size());
        vertices.push_back(v);
      }
    ringStart = ringEnd;
  }
}

/// The faces beside the rim and some steps further, not across creases.
void HoleFiller::takeSide(Hole& hole, double crease, std::vector<uint32_t>& faces) {
  for (const Corner& corner : hole.corners)
    if (corner.goesOn()) faces.push_back(rims_.halves[corner.edge] / 3);
  const Creases creases(mesh_, adjacency_, around_.fanStarts, around_.fans, crease);
  std::vector<uint32_t> known(faces);
  sf::sort(known.begin(), known.end());
  size_t stepStart = 0;
  for (uint32_t step = 0; step < 2 * kRings; ++step) {
    const size_t stepEnd = faces.size();
    std::vector<uint32_t> next;
    for (size_t i = stepStart; i < stepEnd; ++i)
      for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t h = 3 * faces[i] + k, twin = adjacency_.twins[h];
        if (twin != kNone && !creases.isSharp(h) &&
            !std::binary_search(known.begin(), known.end(), twin / 3))
          next.push_back(twin / 3);
      }
    sf::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    faces.insert(faces.end(), next.begin(), next.end());
    known.insert(known.end(), next.begin(), next.end());
    sf::sort(known.begin(), known.end());
    stepStart = stepEnd;
  }
  for (const uint32_t f : faces)
    for (int k = 0; k < 3; ++k) {
      const uint32_t v = mesh_.faces[3 * size_t(f) + k];
      if (local_[v] != kNone) continue;
      local_[v] = uint32_t(hole.vertices.size());
      hole.vertices.push_back(v);
    }
}

Vec3 HoleFiller::point(uint32_t vertex) const {
  const size_t n = mesh_.positions.size() / 3;
  return vertex < n ? pointAt(mesh_.positions, vertex)
                    : pointAt(newPositions_, vertex - uint32_t(n));
}

/// Numbers the corners and the vertices around them, and lists the faces between.
void HoleFiller::surround(Hole& hole, double crease) {
  const uint32_t n = uint32_t(mesh_.positions.size() / 3);
  std::vector<uint32_t>& vertices = hole.vertices;
  for (size_t l = 0; l + 1 < hole.starts.size(); ++l)
    for (uint32_t i = hole.starts[l]; i < hole.starts[l + 1]; ++i) {
      Corner& corner = hole.corners[i];
      corner.next = i + 1 < hole.starts[l + 1] ? i + 1 : hole.starts[l];
      corner.before = i > hole.starts[l] ? i - 1 : hole.starts[l + 1] - 1;
      const bool isOld = corner.vertex < n;
      if (isOld && local_[corner.vertex] != kNone) {
        corner.local = local_[corner.vertex];
        corner.other = hole.lastCorners[corner.local];
        hole.lastCorners[corner.local] = i;
        continue;
      }
      corner.local = uint32_t(vertices.size());
      if (isOld) local_[corner.vertex] = corner.local;
      vertices.push_back(corner.vertex);
      hole.lastCorners.push_back(i);
    }
  std::vector<uint32_t> faces;
  if (hole.isPart)
    takeSide(hole, crease, faces);
  else
    takeRings(hole, faces);
  sf::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  LocalSurface& surface = hole.surface;
  for (const uint32_t v : vertices) {
    const Vec3 p = point(v);
    surface.positions.insert(surface.positions.end(), {p.x, p.y, p.z});
  }
  for (const uint32_t f : faces) appendFace(f, surface.triangles);
  for (uint32_t& v : surface.triangles) v = local_[v];
  surface.fixedVertices = uint32_t(vertices.size());
  surface.fixedTriangles = uint32_t(surface.triangles.size() / 3);
  for (const uint32_t v : vertices)
    if (v < n) local_[v] = kNone;
}

/// The mean angle between the patch and the faces along the rim.
double HoleFiller::rimAngle(const Hole& hole, double* largest) const {
  const LocalSurface& s = hole.surface;
  double sum = 0;
  uint32_t count = 0;
  for (size_t t = 3 * size_t(s.fixedTriangles); t < s.triangles.size(); t += 3)
    for (int k = 0; k < 3; ++k) {
      const uint32_t corner = hole.cornerBetween(s.triangles[t + k], s.triangles[t + (k + 1) % 3]);
      if (corner == kNone || !hole.corners[corner].goesOn()) continue;
      const Vec3 n = rims_.normals[hole.corners[corner].edge];
      if (dot(n, n) == 0) continue;
      const double angle = angleBetween(
          n, normalOf(s.positions, s.triangles[t], s.triangles[t + 1], s.triangles[t + 2]));
      if (largest) *largest = std::max(*largest, angle);
      sum += angle, ++count;
    }
  return count ? sum / count : 0;
}

/// Pairs of a face of the patch and another, both numbered as in the filled mesh.
bool HoleFiller::findPairs(const Hole& hole, std::vector<FacePair>& pairs) {
  PatchPairs found;
  if (!findPatchPairs(hole.surface, mesh_, around_.tree, kMostPairs, work_, found)) return false;
  pairs.clear();
  const uint32_t shift = faceCount() - hole.surface.fixedTriangles;
  for (const FacePair p : found.others) pairs.push_back({p.first + shift, p.second});
  for (const FacePair p : found.own) pairs.push_back({p.first + shift, p.second + shift});
  return true;
}

/// Appends pairs among new faces of the filled mesh.
bool HoleFiller::findOwnPairs(uint32_t from, uint32_t to, std::vector<FacePair>& pairs) {
  const uint32_t old = uint32_t(mesh_.faces.size() / 3);
  std::vector<double> positions;
  std::vector<uint32_t> faces;
  for (size_t i = 3 * size_t(from - old); i < 3 * size_t(to - old); ++i) {
    const Vec3 p = point(newFaces_[i]);
    faces.push_back(uint32_t(positions.size() / 3));
    positions.insert(positions.end(), {p.x, p.y, p.z});
  }
  std::vector<FacePair> own;
  if (!findSelfIntersections({positions, faces}, 0, to - from, kMostPairs, work_, own))
    return false;
  for (const FacePair p : own) pairs.push_back({p.first + from, p.second + from});
  return true;
}

bool HoleFiller::append(const Hole& hole) {
  const LocalSurface& s = hole.surface;
  const uint32_t firstNew = vertexCount(), fixed = s.fixedVertices;
  const size_t coordinates = s.positions.size() - 3 * size_t(fixed),
               corners = s.triangles.size() - 3 * size_t(s.fixedTriangles);
  if (!charge_.add(8 * coordinates + 4 * corners)) return false;
  newPositions_.insert(newPositions_.end(), s.positions.begin() + 3 * size_t(fixed),
                       s.positions.end());
  for (size_t i = 3 * size_t(s.fixedTriangles); i < s.triangles.size(); ++i) {
    const uint32_t v = s.triangles[i];
    newFaces_.push_back(v < fixed ? hole.vertices[v] : firstNew + v - fixed);
  }
  return true;
}

Status HoleFiller::fill(ArrayView<const uint32_t> rims, const FillOptions& options,
                        FilledHole& result) {
  const size_t n = mesh_.positions.size() / 3;
  if (local_.size() < n) {
    if (!reserve(local_, n, charge_)) return work_.status();
    local_.assign(n, kNone);
  }
  const size_t positions = newPositions_.size(), faces = newFaces_.size();
  if (options.clock) work_.limitStage(options.maxSeconds, options.clock);
  Status status = fillWhole(rims, options, result);
  if (work_.endStage() && status == Status::Stopped) {
    newPositions_.resize(positions), newFaces_.resize(faces);
    result = {};
    result.reason = FillReason::TimeLimit;
    result.firstFace = result.endFace = faceCount();
    status = Status::Ok;
  }
  return status;
}

Status HoleFiller::fillWhole(ArrayView<const uint32_t> rims, const FillOptions& options,
                             FilledHole& result) {
  result = {};
  if (rims.size() == 1) {
    HoleParts parts = stitchRim(mesh_, rims_, rims[0]);
    if (parts.triangles.empty() && options.crease > 0) {
      const Creases creases(mesh_, adjacency_, around_.fanStarts, around_.fans, options.crease);
      parts = partHole(mesh_, rims_, rims[0], creases);
    }
    const size_t positions = newPositions_.size(), faces = newFaces_.size();
    bool isDone = false;
    const Status status = fillParts(parts, options, result, isDone);
    if (status != Status::Ok) return status;
    if (isDone && (parts.triangles.empty() || isStitchedWell(rims[0], result.firstFace)))
      return Status::Ok;
    newPositions_.resize(positions), newFaces_.resize(faces);
    result = {};
  }
  Hole hole;
  for (const uint32_t r : rims) hole.crossesSeam |= rims_.rims[r].crossesSeam;
  RimLoops loops = loopsAround(rims_, rims);
  for (const uint32_t e : loops.edges) hole.corners.push_back({rims_.vertices[e], e});
  hole.starts = std::move(loops.starts);
  const size_t positions = newPositions_.size(), faces = newFaces_.size();
  result.firstFace = faceCount();
  const Status status = fillPart(hole, options, result);
  result.endFace = faceCount();
  if (status != Status::Ok || !hole.touches()) return status;
  if (result.status != FillStatus::Failed && areFans(hole, result.firstFace)) return status;
  newPositions_.resize(positions), newFaces_.resize(faces);
  return fillApart(hole, rims, options, result);
}

/// Whether the faces from `firstFace` on repeat no face of the mesh, and no edge gets more than two faces by them. Triangles that
/// join vertices in one place may: these are joined as the rim runs, not as the mesh allows.
bool HoleFiller::isStitchedWell(uint32_t rim, uint32_t firstFace) const {
  using Edge = std::pair<uint32_t, uint32_t>;
  const auto edgeOf = [](uint32_t a, uint32_t b) { return a < b ? Edge{a, b} : Edge{b, a}; };
  std::vector<Edge> ofRim, ofFaces;
  for (uint32_t e = rims_.starts[rim]; e < rims_.starts[rim + 1]; ++e)
    ofRim.push_back(edgeOf(rims_.vertices[e], rims_.vertices[rims_.nextEdge(rim, e)]));
  for (size_t i = 3 * (size_t(firstFace) - mesh_.faces.size() / 3); i < newFaces_.size(); i += 3) {
    const uint32_t *f = &newFaces_[i], n = uint32_t(mesh_.positions.size() / 3);
    if (f[1] < n && f[2] < n && isInFace(f[0], f[1], f[2])) return false;
    for (int k = 0; k < 3; ++k) ofFaces.push_back(edgeOf(f[k], f[(k + 1) % 3]));
  }
  sf::sort(ofRim.begin(), ofRim.end(), std::less<Edge>());
  sf::sort(ofFaces.begin(), ofFaces.end(), std::less<Edge>());
  for (size_t i = 0, next; i < ofFaces.size(); i = next) {
    for (next = i + 1; next < ofFaces.size() && ofFaces[next] == ofFaces[i];) ++next;
    const auto [a, b] = ofFaces[i];
    const bool isOfRim = std::binary_search(ofRim.begin(), ofRim.end(), ofFaces[i]);
    if (next - i > (isOfRim ? 1 : 2) || (!isOfRim && isInFace(a, b, kNone))) return false;
  }
  return true;
}

/// Fills two rims that touch, but do not bound one surface there, each by itself.
Status HoleFiller::fillApart(const Hole& hole, ArrayView<const uint32_t> rims,
                             const FillOptions& options, FilledHole& result) {
  const size_t positions = newPositions_.size(), faces = newFaces_.size();
  HoleParts parts;
  for (const uint32_t r : rims) {
    parts.parts.emplace_back();
    for (uint32_t e = rims_.starts[r]; e < rims_.starts[r + 1]; ++e)
      parts.parts.back().push_back({e, rims_.vertices[e], kNone});
  }
  bool isDone = false;
  result = {};
  if (rims.size() == 2) {
    const Status status = fillParts(parts, options, result, isDone);
    if (status != Status::Ok) return status;
    if (isDone && areFans(hole, result.firstFace)) return Status::Ok;
  }
  newPositions_.resize(positions), newFaces_.resize(faces);
  result = {};
  result.reason = FillReason::RepeatedVertex;
  result.firstFace = result.endFace = faceCount();
  return Status::Ok;
}

/// Fills the parts of a hole apart. `isDone`: there are such, and all are filled well.
Status HoleFiller::fillParts(const HoleParts& parts, const FillOptions& options, FilledHole& result,
                             bool& isDone) {
  const std::vector<uint32_t>& between = parts.triangles;
  const bool isStitched = !between.empty();
  if (parts.parts.empty() && !isStitched) return Status::Ok;
  FillOptions left = options;
  if (parts.points.size() > left.refining.maxNewVertices) return Status::Ok;
  left.refining.maxNewVertices -= uint32_t(parts.points.size());
  const size_t positions = newPositions_.size(), faces = newFaces_.size();
  const uint32_t firstPoint = vertexCount();
  result.firstFace = faceCount();
  if (!charge_.add(sizeof(Vec3) * parts.points.size() + sizeof(uint32_t) * between.size()))
    return work_.status();
  for (const Vec3 p : parts.points)
    for (const double x : {p.x, p.y, p.z})
      newPositions_.push_back(options.inFloats ? double(float(x)) : x);
  newFaces_.insert(newFaces_.end(), between.begin(), between.end());
  Status status = Status::Ok;
  bool isGood = true, areOptimal = true;
  double angleBefore = 0, angleAfter = 0, cost = 0, bound = 0;
  for (const auto& part : parts.parts) {
    Hole hole;
    hole.isPart = parts.areBetweenCreases;
    for (const PartCorner& c : part)
      hole.corners.push_back(
          {c.vertex != kNone ? c.vertex : firstPoint + c.added, c.edge, c.isCrease});
    hole.starts = {0, uint32_t(hole.corners.size())};
    if (isBorderTaken(hole)) {
      isGood = false;
      break;
    }
    FilledHole filled;
    const uint32_t before = vertexCount();
    status = fillPart(hole, left, filled);
    left.refining.maxNewVertices -= vertexCount() - before;
    if (status != Status::Ok || filled.status != FillStatus::Filled) {
      isGood = false;
      break;
    }
    angleBefore += filled.rimAngleBefore / double(parts.parts.size()),
        angleAfter += filled.rimAngleAfter / double(parts.parts.size());
    cost += filled.cost, bound += filled.lowerBound, areOptimal &= filled.optimal;
    result.fairnessUsed = std::max(result.fairnessUsed, filled.fairnessUsed);
    result.movedLess = std::max(result.movedLess, filled.movedLess);
  }
  result.endFace = faceCount();
  // Parts may be clean each by itself and still meet. What is stitched touches itself, as the rim does.
  if (isGood && !isStitched &&
      !findOwnPairs(result.firstFace, result.endFace, result.intersections))
    status = work_.status();
  isDone = status == Status::Ok && isGood && result.intersections.empty();
  if (!isDone) {
    newPositions_.resize(positions), newFaces_.resize(faces);
    return status;
  }
  result.status = FillStatus::Filled;
  if (isStitched) result.reason = FillReason::Stitched;
  result.rimAngleBefore = angleBefore, result.rimAngleAfter = angleAfter;
  result.cost = cost, result.lowerBound = bound, result.optimal = areOptimal;
  return Status::Ok;
}

/// Fills what is within some loops, and appends it.
Status HoleFiller::fillPart(Hole& hole, const FillOptions& options, FilledHole& result) {
  surround(hole, options.crease);
  Status status = span(hole, options, result);
  if (status != Status::Ok || result.status == FillStatus::Failed) return status;
  // The parts of a hole are of use only together.
  bool isLate = work_.isStageOver();
  if (isLate && hole.isPart) return Status::Stopped;
  if (isLate) work_.endStage();
  double largest = 0;
  result.rimAngleBefore = rimAngle(hole, &largest);

  LocalSurface& surface = hole.surface;
  const auto added = [&] { return surface.positions.size() / 3 - surface.fixedVertices; };
  const uint32_t chords = countTakenChords(hole), most = options.refining.maxNewVertices;
  if (chords > most) {
    result.status = FillStatus::Failed, result.reason = FillReason::DuplicateFace;
    return Status::Ok;
  }
  // What goes on everything around it as it was spanned, nothing should bend.
  const bool isExact = largest < kExact || isFlat(surface);
  bool isClean = false;
  if (!isExact && !isLate) {
    FairOptions fairing;
    fairing.order = 0;
    // Late here, smoothing says so at once.
    if (options.fairing == Fairing::Auto && !findFairOrder(surface, work_, fairing.order) &&
        !work_.isStageOver())
      return work_.status();
    if (options.fairing == Fairing::Bending) fairing.order = 2;
    if (options.fairing == Fairing::Curvature) fairing.order = 3;
    RefineOptions refining = options.refining;
    refining.maxNewVertices = most == kNone ? kNone : most - chords;
    LocalSurface spanned;
    if (most != kNone || options.clock) spanned = surface;
    Smoothed smoothed;
    status = smoothPatchApart(surface, refining, fairing, mesh_, around_.tree, options.inFloats,
                              work_, smoothed);
    isLate = status == Status::Stopped && work_.isStageOver() && !hole.isPart;
    if (isLate) work_.endStage();
    if (status != Status::Ok && !isLate) return status;
    if (isLate || (most != kNone && added() + countTakenChords(hole) > most)) {
      // Refining has flipped more edges to where they have to be split: as it was spanned, there are few enough.
      surface = std::move(spanned);
    } else {
      result.fairnessUsed = smoothed.fairness.order;
      result.movedLess = 1 - smoothed.share;
      isClean = smoothed.pairs == 0;
    }
  }
  const size_t before = added();
  splitChords(hole, options.inFloats);
  // Looked at already, unless vertices were put on chords, and rounded.
  isClean = isClean && added() == before;
  if (!isClean && !findPairs(hole, result.intersections)) return work_.status();
  if (!result.intersections.empty()) result.status = FillStatus::SelfIntersecting;
  if (isLate) result.reason = FillReason::TimeLimit;
  result.rimAngleAfter = rimAngle(hole, nullptr);
  return append(hole) ? Status::Ok : work_.status();
}

}  // namespace sf
