#include "mesh/vote.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/sort.h"
#include "mesh/rim_tree.h"

namespace sf {
namespace {

/// Radians that the way to the best partner turns if there is nothing in front of an edge.
constexpr double kTurnOfOpen = 2.8;
/// But the two sides of a slit, a rim of less area over its squared length, face each other even if
/// the way from middle to middle runs along it: it turns less than this, and the frames fit.
constexpr double kAreaOfSlit = 1e-5, kTurnAcrossSlit = 3.5, kRotationAcrossSlit = 1;
/// The logarithm of how many times cheaper the partner's own best may be. An edge that has something better
/// is no partner: the holes of one thing are of no use to the rim of another beside it.
constexpr double kUnrequited = 1.5;
/// An edge looks for partners on rims not farther than this many radii of its own.
constexpr double kReach = 3;

/// Rims as voters.
struct Voters {
  std::vector<RimSide> sides;   // [e]
  std::vector<double> lengths;  // [e]
  std::vector<RimBall> balls;   // [k]
  std::vector<uint8_t> isSlit;  // [k] rims without area
};

/// Unit vectors from the middles of edges into the hole, smoothed over three edges.
void placeVoters(const Rims& rims, const UnitScale& at, Voters& voters) {
  std::vector<Vec3> out(rims.vertices.size());
  for (uint32_t r = 0; r < rims.count(); ++r) {
    const uint32_t first = rims.starts[r], end = rims.starts[r + 1], n = end - first;
    Vec3 centre{0, 0, 0};
    for (uint32_t e = first; e < end; ++e) {
      const Vec3 a = at(rims.vertices[e]), b = at(rims.vertices[rims.nextEdge(r, e)]);
      out[e] = cross(rims.normals[e], b - a);  // as long as the edge, which is its weight
      voters.lengths[e] = distance(a, b);
      voters.sides[e].at = 0.5 * (a + b);
      voters.sides[e].normal = rims.normals[e];
      voters.sides[e].rim = r;
      centre = centre + (1.0 / n) * voters.sides[e].at;
    }
    double radius = 0, length = 0;
    Vec3 area{0, 0, 0};
    for (uint32_t i = 0; i < n; ++i) {
      RimSide& side = voters.sides[first + i];
      radius = std::max(radius, distance(centre, side.at));
      const Vec3 a = at(rims.vertices[first + i]),
                 b = at(rims.vertices[rims.nextEdge(r, first + i)]);
      area = area + 0.5 * cross(a - centre, b - centre);
      length += voters.lengths[first + i];
      Vec3 ahead = out[first + i];
      if (n > 3) ahead = ahead + out[first + (i + 1) % n] + out[first + (i + n - 1) % n];
      const double size = sf::length(ahead);
      side.ahead = size > 0 ? (1 / size) * ahead : Vec3{0, 0, 0};
      side.along = cross(side.ahead, side.normal);
    }
    voters.balls[r] = {centre, radius};
    voters.isSlit[r] = !(sf::length(area) > kAreaOfSlit * length * length);
  }
}

bool facesNothing(const RimPartner& best, bool isOfOwnRim, bool isOfSlit) {
  if (best.edge == kNone) return true;
  if (!(best.turn > kTurnOfOpen)) return false;
  // At the same place lies the other side of a slit, or an edge that should have been welded.
  if (std::isinf(best.cost)) return !isOfOwnRim;
  const bool isAcrossSlit = best.turn < kTurnAcrossSlit && best.rotation < kRotationAcrossSlit;
  return !isOfSlit || !isAcrossSlit;
}

}  // namespace

bool castVotes(const MeshView& mesh, const Rims& rims, Work& work, Charge& charge,
               Grouping& result) {
  const UnitScale at(mesh.positions);
  const size_t edges = rims.vertices.size();
  Charge temporary(work);
  if (!temporary.add(
          edges * (sizeof(RimSide) + 2 * sizeof(RimPartner) + sizeof(double) + sizeof(Vec3)) +
          rims.count() * (sizeof(RimBall) + 1)) ||
      !charge.add(rims.count() * sizeof(double)))
    return false;
  Voters voters{std::vector<RimSide>(edges), std::vector<double>(edges),
                std::vector<RimBall>(rims.count()), std::vector<uint8_t>(rims.count())};
  placeVoters(rims, at, voters);
  RimTree tree(work);
  if (!tree.build(voters.sides, rims.starts, voters.balls)) return false;

  std::vector<RimPartner> partners(edges), own(edges);
  for (uint32_t e = 0; e < edges; ++e) {
    partners[e] = tree.best(e, kReach * voters.balls[voters.sides[e].rim].radius, own[e]);
    if (!work.going()) return false;
  }
  std::vector<RimVote> ballots;
  result = {};
  result.openness.assign(rims.count(), 0);
  for (uint32_t r = 0; r < rims.count(); ++r) {
    const uint32_t first = rims.starts[r], n = rims.starts[r + 1] - first;
    const double whole =
        std::accumulate(voters.lengths.begin() + first, voters.lengths.begin() + first + n, 0.0);
    for (uint32_t e = first; e < first + n; ++e) {
      const RimPartner& best = partners[e];
      const double share = whole > 0 ? voters.lengths[e] / whole : 1.0 / n;
      const uint32_t other = best.edge == kNone ? r : voters.sides[best.edge].rim;
      // An edge without a partner elsewhere is judged as if there were only its own rim.
      const bool isUnrequited = other != r && best.cost > partners[best.edge].cost + kUnrequited;
      const bool isOfOwnRim = isUnrequited || other == r;
      if (facesNothing(isUnrequited ? own[e] : best, isOfOwnRim, voters.isSlit[r] != 0)) {
        result.openness[r] += share;
        continue;
      }
      if (isUnrequited) continue;
      if (other == r || !(share > 0)) continue;
      RimVote ballot{r, other, share, 0, 0, false};
      if (r > other) ballot = {other, r, 0, share, 0, false};
      if (!push(ballots, ballot, temporary)) return false;
    }
  }
  sf::sort(ballots.begin(), ballots.end(), [](const RimVote& a, const RimVote& b) {
    if (a.first != b.first) return a.first < b.first;
    if (a.second != b.second) return a.second < b.second;
    return a.shareOfFirst != b.shareOfFirst ? a.shareOfFirst < b.shareOfFirst
                                            : a.shareOfSecond < b.shareOfSecond;
  });
  for (size_t i = 0, j; i < ballots.size(); i = j) {
    RimVote sum = ballots[i];
    for (j = i + 1;
         j < ballots.size() && ballots[j].first == sum.first && ballots[j].second == sum.second;
         ++j) {
      sum.shareOfFirst += ballots[j].shareOfFirst;
      sum.shareOfSecond += ballots[j].shareOfSecond;
    }
    sum.vote = std::min(1.0, std::max(sum.shareOfFirst, sum.shareOfSecond));
    if (!push(result.votes, sum, charge)) return false;
  }
  return true;
}

}  // namespace sf
