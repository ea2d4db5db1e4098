#include "loops/answer/surface_terms.h"

#include <algorithm>

#include "base/accurate_cross.h"
#include "base/assert.h"
#include "base/sort.h"
#include "loops/problem/weight.h"

namespace sf {

void windConsistently(const LoopSet& loops, const CandidateSet& set,
                      const std::vector<uint32_t>& triangles, std::vector<uint32_t>& wound) {
  struct Use {
    uint32_t edge, triangle;
  };
  std::vector<Use> uses;
  for (uint32_t i = 0; i < triangles.size(); ++i)
    for (int j = 0; j < 3; ++j)
      uses.push_back({set.triangleEdges[3 * size_t(triangles[i]) + j], i});
  sf::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
    return a.edge < b.edge || (a.edge == b.edge && a.triangle < b.triangle);
  });
  // Whether an increasing triple passes its edge from the lower to the higher end.
  auto passesForward = [&](uint32_t t, uint32_t edge) {
    return set.triangleEdges[3 * size_t(t) + 1] != edge;
  };
  auto usesOf = [&](uint32_t edge) {
    return std::lower_bound(uses.begin(), uses.end(), edge,
                            [](const Use& u, uint32_t e) { return u.edge < e; });
  };
  const uint32_t first = usesOf(set.loopEdges[0])->triangle;
  const bool lowToHigh = set.edgeVertices[2 * size_t(set.loopEdges[0])] == 0 && loops.next(0) != 0;
  enum : uint8_t { Unseen, Kept, Flipped };
  std::vector<uint8_t> state(triangles.size(), Unseen);
  state[first] = passesForward(triangles[first], set.loopEdges[0]) == lowToHigh ? Kept : Flipped;
  std::vector<uint32_t> queue{first};
  for (size_t i = 0; i < queue.size(); ++i) {
    const uint32_t at = queue[i];
    for (int j = 0; j < 3; ++j) {
      const uint32_t edge = set.triangleEdges[3 * size_t(triangles[at]) + j];
      for (auto u = usesOf(edge); u != uses.end() && u->edge == edge; ++u) {
        if (state[u->triangle] != Unseen) continue;
        const bool same =
            passesForward(triangles[at], edge) == passesForward(triangles[u->triangle], edge);
        state[u->triangle] = same == (state[at] == Kept) ? Flipped : Kept;
        queue.push_back(u->triangle);
      }
    }
  }
  SF_ASSERT(queue.size() == triangles.size());
  wound.clear();
  for (uint32_t i = 0; i < triangles.size(); ++i) {
    const uint32_t* v = &set.triangles[3 * size_t(triangles[i])];
    const bool flip = state[i] == Flipped;
    wound.insert(wound.end(), {v[0], v[flip ? 2 : 1], v[flip ? 1 : 2]});
  }
}

SpanTerms measureTerms(const LoopSet& loops, const CandidateSet& set,
                       const std::vector<uint32_t>& triangles, ArrayView<const double> normals,
                       ArrayView<const double> own) {
  SpanTerms terms;
  const auto addAngle = [&](double angle) {
    terms.dihedral += angle;
    terms.worstDihedral = std::max(terms.worstDihedral, angle);
  };
  std::vector<uint32_t> slots;
  for (const uint32_t t : triangles) {
    const uint32_t* v = &set.triangles[3 * size_t(t)];
    const Vec3 p[3] = {loops.position(v[0]), loops.position(v[1]), loops.position(v[2])};
    terms.area += 0.5 * length(accurateCross(p[0], p[1], p[2]));
    terms.perimeter += distance(p[0], p[1]) + distance(p[1], p[2]) + distance(p[2], p[0]);
    if (!own.empty()) terms.own += own[t];
    slots.insert(slots.end(), &set.triangleSlots[3 * size_t(t)],
                 &set.triangleSlots[3 * size_t(t)] + 3);
    for (int i = 0; i < 3; ++i) {
      double angle;
      if (faceAngle(loops, normals, v[i], v[(i + 1) % 3], v[(i + 2) % 3], angle)) addAngle(angle);
    }
  }
  // Slots of one edge are consecutive, so that the two triangles at an inner edge come together.
  sf::sort(slots.begin(), slots.end());
  const auto edgeOf = [&](uint32_t slot) {
    return set.edgeOpposite(set.slotTriangle[slot], set.slotApex[slot]);
  };
  for (size_t i = 0; i + 1 < slots.size(); ++i)
    if (edgeOf(slots[i]) == edgeOf(slots[i + 1]))
      addAngle(dihedralAngle(set.slotTheta[slots[i]], set.slotTheta[slots[i + 1]]));
  return terms;
}

}  // namespace sf
