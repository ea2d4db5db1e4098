#include "loops/problem/candidate_set.h"

#include <algorithm>

#include "base/accurate_cross.h"
#include "base/charge.h"
#include "base/predicates.h"
#include "base/sort.h"
#include "loops/problem/weight.h"

namespace sf {
namespace {

struct Triple {
  uint32_t v[3];
  bool operator<(const Triple& o) const {
    return std::lexicographical_compare(v, v + 3, o.v, o.v + 3);
  }
  bool operator==(const Triple& o) const { return std::equal(v, v + 3, o.v); }
};

Triple sorted(uint32_t a, uint32_t b, uint32_t c) {
  Triple t{{a, b, c}};
  sf::sort(t.v, t.v + 3);
  return t;
}

bool isTriangle(const LoopSet& loops, const Triple& t) {
  return !collinear(loops.position(t.v[0]), loops.position(t.v[1]), loops.position(t.v[2]));
}

/// Appends the distinct, non-collinear triples, in increasing order.
void appendDistinct(const LoopSet& loops, std::vector<Triple>& triples,
                    std::vector<uint32_t>& out) {
  sf::sort(triples.begin(), triples.end());
  triples.erase(std::unique(triples.begin(), triples.end()), triples.end());
  for (const Triple& t : triples)
    if (isTriangle(loops, t)) out.insert(out.end(), t.v, t.v + 3);
}

/// Neighbours of each vertex along the edges of the facets, as offsets and one list.
void facetNeighbours(uint32_t n, ArrayView<const uint32_t> facets, std::vector<uint32_t>& start,
                     std::vector<uint32_t>& neighbours) {
  start.assign(n + 1, 0);
  for (const uint32_t v : facets) start[v + 1] += 2;
  for (uint32_t v = 0; v < n; ++v) start[v + 1] += start[v];
  neighbours.resize(2 * facets.size());
  std::vector<uint32_t> cursor(start.begin(), start.end() - 1);
  for (size_t f = 0; f < facets.size(); f += 3)
    for (int i = 0; i < 3; ++i)
      for (int j = 1; j < 3; ++j) neighbours[cursor[facets[f + i]]++] = facets[f + (i + j) % 3];
}

/// The `reach` nearest of the vertices within two Delaunay edges of v, nearest first.
void nearestVertices(const LoopSet& loops, const std::vector<uint32_t>& start,
                     const std::vector<uint32_t>& neighbours, uint32_t v, uint32_t reach,
                     std::vector<uint32_t>& near) {
  near.assign(neighbours.begin() + start[v], neighbours.begin() + start[v + 1]);
  for (uint32_t i = start[v]; i < start[v + 1]; ++i) {
    const uint32_t w = neighbours[i];
    near.insert(near.end(), neighbours.begin() + start[w], neighbours.begin() + start[w + 1]);
  }
  sf::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  near.erase(std::remove(near.begin(), near.end(), v), near.end());
  const Vec3 p = loops.position(v);
  sf::sort(near.begin(), near.end(), [&](uint32_t a, uint32_t b) {
    const double da = distance(p, loops.position(a)), db = distance(p, loops.position(b));
    return da < db || (da == db && a < b);
  });
  if (near.size() > reach) near.resize(reach);
}

bool weighTriangles(const LoopSet& loops, const TriangleWeights& w, Work& work, CandidateSet& set) {
  const size_t c = set.size();
  set.weight.assign(c, 0);
  if (!w.normals.empty()) set.boundaryAngle.assign(c, 0);
  for (size_t t = 0; t < c; ++t) {
    if (!work.tick(60)) return false;
    const uint32_t* v = &set.triangles[3 * t];
    const Vec3 p[3] = {loops.position(v[0]), loops.position(v[1]), loops.position(v[2])};
    const Vec3 normal = accurateCross(p[0], p[1], p[2]);
    double sum = w.own.empty() ? 0 : w.own[t];
    if (w.area > 0) sum += w.area * 0.5 * length(normal);
    if (w.perimeter > 0)
      sum += w.perimeter * (distance(p[0], p[1]) + distance(p[1], p[2]) + distance(p[2], p[0]));
    for (int i = 0; i < 3 && !w.normals.empty(); ++i) {
      double angle;
      if (!faceAngle(loops, w.normals, v[i], v[(i + 1) % 3], v[(i + 2) % 3], angle)) continue;
      sum += w.dihedral * angle;
      set.boundaryAngle[t] = std::max(set.boundaryAngle[t], angle);
    }
    set.weight[t] = sum;
  }
  return true;
}

/// Fills all edge and slot arrays from `triangles`: two stable counting sorts put the 3c corners
/// in the order of their opposite edges.
bool buildIncidence(const LoopSet& loops, Work& work, CandidateSet& set) {
  const uint32_t n = loops.vertexCount();
  const size_t corners = set.triangles.size();
  auto low = [&](uint32_t corner) {
    const uint32_t i = corner % 3;
    return set.triangles[corner - i + (i == 0 ? 1 : 0)];
  };
  auto high = [&](uint32_t corner) {
    const uint32_t i = corner % 3;
    return set.triangles[corner - i + (i == 2 ? 1 : 2)];
  };
  std::vector<uint32_t> byHigh(corners), sortedCorners(corners), count(size_t(n) + 1, 0);
  for (uint32_t i = 0; i < corners; ++i) ++count[high(i) + 1];
  for (uint32_t v = 0; v < n; ++v) count[v + 1] += count[v];
  for (uint32_t i = 0; i < corners; ++i) byHigh[count[high(i)]++] = i;
  count.assign(size_t(n) + 1, 0);
  for (uint32_t i = 0; i < corners; ++i) ++count[low(i) + 1];
  for (uint32_t v = 0; v < n; ++v) count[v + 1] += count[v];
  for (const uint32_t i : byHigh) sortedCorners[count[low(i)]++] = i;

  set.triangleEdges.resize(corners);
  set.triangleSlots.resize(corners);
  set.slotTriangle.resize(corners);
  set.slotApex.resize(corners);
  set.slotTheta.resize(corners);
  set.edgeVertices.clear();
  set.edgeSlots.clear();
  Frame frame{};
  for (uint32_t slot = 0; slot < corners; ++slot) {
    if (!work.tick(80)) return false;
    const uint32_t corner = sortedCorners[slot];
    const uint32_t u = low(corner), v = high(corner);
    if (slot == 0 || set.edgeVertices[set.edgeVertices.size() - 2] != u ||
        set.edgeVertices.back() != v) {
      set.edgeSlots.push_back(slot);
      set.edgeVertices.push_back(u);
      set.edgeVertices.push_back(v);
      frame = frameAcross(loops.position(v) - loops.position(u));
    }
    const Vec3 apex = loops.position(set.triangles[corner]);
    // Measured from the nearer end, the projection of a sliver loses little to cancellation.
    const Vec3 toU = apex - loops.position(u), toV = apex - loops.position(v);
    const Vec3 arm = dot(toU, toU) <= dot(toV, toV) ? toU : toV;
    const double y = dot(arm, frame.y), x = dot(arm, frame.x);
    set.slotTheta[slot] =
        isThin(x * x + y * y, dot(arm, arm), 1)
            ? angleOfNormal(frame, accurateCross(loops.position(u), loops.position(v), apex))
            : std::atan2(y, x);
    set.slotTriangle[slot] = corner / 3;
    set.slotApex[slot] = set.triangles[corner];
    set.triangleEdges[corner] = uint32_t(set.edgeSlots.size()) - 1;
    set.triangleSlots[corner] = slot;
  }
  set.edgeSlots.push_back(uint32_t(corners));
  set.firstEdge.assign(size_t(n) + 1, 0);
  for (uint32_t e = 0; e < set.edgeCount(); ++e)
    ++set.firstEdge[set.edgeVertices[2 * size_t(e)] + 1];
  for (uint32_t v = 0; v < n; ++v) set.firstEdge[v + 1] += set.firstEdge[v];

  set.loopEdges.assign(n, kNone);
  set.isLoopEdge.assign(set.edgeCount(), 0);
  for (uint32_t e = 0; e < set.edgeCount(); ++e) {
    const uint32_t u = set.edgeVertices[2 * size_t(e)], v = set.edgeVertices[2 * size_t(e) + 1];
    if (!loops.isLoopEdge(u, v)) continue;
    set.isLoopEdge[e] = 1;
    set.loopEdges[loops.next(u) == v ? u : v] = e;
  }
  return true;
}

}  // namespace

uint32_t CandidateSet::edgeBetween(uint32_t u, uint32_t v) const {
  if (u > v) std::swap(u, v);
  uint32_t low = firstEdge[u], high = firstEdge[u + 1];
  while (low < high) {
    const uint32_t middle = low + (high - low) / 2;
    if (edgeVertices[2 * size_t(middle) + 1] < v)
      low = middle + 1;
    else
      high = middle;
  }
  return low < firstEdge[u + 1] && edgeVertices[2 * size_t(low) + 1] == v ? low : kNone;
}

bool faceAngle(const LoopSet& loops, ArrayView<const double> normals, uint32_t a, uint32_t b,
               uint32_t apex, double& angle) {
  if (normals.empty()) return false;
  if (loops.next(a) != b) {
    if (loops.next(b) != a) return false;
    std::swap(a, b);
  }
  Vec3 face = {normals[3 * size_t(a)], normals[3 * size_t(a) + 1], normals[3 * size_t(a) + 2]};
  if (std::isnan(face.x)) return false;
  // Squares of very long and very short normals overflow or vanish.
  const double largest = std::max({std::fabs(face.x), std::fabs(face.y), std::fabs(face.z)});
  face = {face.x / largest, face.y / largest, face.z / largest};
  const Vec3 p = loops.position(a);
  angle = angleBetween(accurateCross(p, loops.position(b), loops.position(apex)), face);
  return true;
}

bool allTriples(const LoopSet& loops, Work& work, std::vector<uint32_t>& triples) {
  const uint32_t n = loops.vertexCount();
  triples.clear();
  for (uint32_t a = 0; a + 2 < n; ++a) {
    for (uint32_t b = a + 1; b + 1 < n; ++b) {
      if (!work.tick(30 * (n - b))) return false;
      for (uint32_t c = b + 1; c < n; ++c)
        if (isTriangle(loops, {{a, b, c}})) triples.insert(triples.end(), {a, b, c});
    }
  }
  return true;
}

bool facetTriples(const LoopSet& loops, ArrayView<const uint32_t> facets, Work& work,
                  std::vector<uint32_t>& triples) {
  std::vector<Triple> all;
  all.reserve(facets.size() / 3);
  for (size_t f = 0; f < facets.size(); f += 3)
    all.push_back(sorted(facets[f], facets[f + 1], facets[f + 2]));
  triples.clear();
  appendDistinct(loops, all, triples);
  return work.tick(uint32_t(std::min<size_t>(100 * all.size(), 1u << 30)));
}

double predictedNearTriples(const LoopSet& loops, uint32_t reach) {
  const double near = std::min(double(reach) + 2, double(loops.vertexCount()));
  return double(loops.vertexCount()) * (near * (near - 1) / 2 + 2 * near);
}

bool nearTriples(const LoopSet& loops, ArrayView<const uint32_t> facets, uint32_t reach, Work& work,
                 std::vector<uint32_t>& triples) {
  const uint32_t n = loops.vertexCount();
  const double most = predictedNearTriples(loops, reach) + double(facets.size() / 3);
  Charge memory(work);
  if (!memory.add(uint64_t(most * (sizeof(Triple) + 12)))) return false;
  std::vector<uint32_t> start, neighbours, near, nearNext;
  facetNeighbours(n, facets, start, neighbours);
  std::vector<Triple> all;
  for (size_t f = 0; f < facets.size(); f += 3)
    all.push_back(sorted(facets[f], facets[f + 1], facets[f + 2]));
  for (uint32_t v = 0; v < n; ++v) {
    if (!work.tick(200 * reach * reach)) return false;
    nearestVertices(loops, start, neighbours, v, reach, near);
    // Loop neighbours are included even where they are far: the surface has to pass there.
    for (const uint32_t w : {loops.previous(v), loops.next(v)})
      if (std::find(near.begin(), near.end(), w) == near.end()) near.push_back(w);
    for (size_t i = 0; i < near.size(); ++i)
      for (size_t j = i + 1; j < near.size(); ++j) all.push_back(sorted(v, near[i], near[j]));
    const uint32_t w = loops.next(v);
    nearestVertices(loops, start, neighbours, w, reach, nearNext);
    for (const uint32_t apex : near)
      if (apex != w) all.push_back(sorted(v, w, apex));
    for (const uint32_t apex : nearNext)
      if (apex != v) all.push_back(sorted(v, w, apex));
  }
  triples.clear();
  appendDistinct(loops, all, triples);
  return work.going();
}

Outcome givenTriples(const LoopSet& loops, ArrayView<const uint32_t> triangles, Work& work,
                     std::vector<uint32_t>& triples, std::vector<uint32_t>& order) {
  struct Numbered {
    Triple triple;
    uint32_t index;
  };
  const uint32_t n = loops.vertexCount();
  std::vector<Numbered> all;
  auto bad = [](uint32_t index) { return Outcome{Status::BadCandidates, kNone, index}; };
  for (size_t f = 0; f < triangles.size(); f += 3) {
    const Triple t = sorted(triangles[f], triangles[f + 1], triangles[f + 2]);
    if (t.v[2] >= n || t.v[0] == t.v[1] || t.v[1] == t.v[2] || !isTriangle(loops, t))
      return bad(uint32_t(f / 3));
    all.push_back({t, uint32_t(f / 3)});
  }
  sf::sort(all.begin(), all.end(), [](const Numbered& a, const Numbered& b) {
    return a.triple < b.triple || (a.triple == b.triple && a.index < b.index);
  });
  uint32_t firstRepeated = kNone;
  triples.clear();
  order.clear();
  for (size_t i = 0; i < all.size(); ++i) {
    if (i > 0 && all[i].triple == all[i - 1].triple)
      firstRepeated = std::min(firstRepeated, all[i].index);
    triples.insert(triples.end(), all[i].triple.v, all[i].triple.v + 3);
    order.push_back(all[i].index);
  }
  if (firstRepeated != kNone) return bad(firstRepeated);
  work.tick(uint32_t(std::min<size_t>(100 * all.size(), 1u << 30)));
  return {work.status()};
}

bool buildCandidateSet(const LoopSet& loops, const TriangleWeights& weights,
                       std::vector<uint32_t> triples, Work& work, CandidateSet& set) {
  set.triangles = std::move(triples);
  const size_t c = set.size();
  if (!work.charge(uint64_t(CandidateSet::bytesFor(double(c))))) return false;
  return weighTriangles(loops, weights, work, set) && buildIncidence(loops, work, set);
}

bool buildSubset(const LoopSet& loops, const CandidateSet& set, ArrayView<const uint32_t> kept,
                 Work& work, CandidateSet& subset) {
  if (!work.charge(uint64_t(CandidateSet::bytesFor(double(kept.size()))))) return false;
  subset = {};
  for (const uint32_t t : kept) {
    const uint32_t* v = &set.triangles[3 * size_t(t)];
    subset.triangles.insert(subset.triangles.end(), v, v + 3);
    subset.weight.push_back(set.weight[t]);
    if (!set.boundaryAngle.empty()) subset.boundaryAngle.push_back(set.boundaryAngle[t]);
  }
  return buildIncidence(loops, work, subset);
}

}  // namespace sf
