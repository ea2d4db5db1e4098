#include "mesh/group.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/sort.h"
#include "mesh/rim_tree.h"

namespace sf {
namespace {

constexpr double kPi = 3.14159265358979323846;
/// Radians that the way to the best partner turns if there is nothing in front of an edge.
constexpr double kTurnOfOpen = 2.8;
/// An edge looks for partners on rims not farther than this many radii of its own.
constexpr double kReach = 3;

/// Rims as voters.
struct Voters {
  std::vector<RimSide> sides;   // [e]
  std::vector<double> lengths;  // [e]
  std::vector<RimBall> balls;   // [k]
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
    double radius = 0;
    for (uint32_t i = 0; i < n; ++i) {
      RimSide& side = voters.sides[first + i];
      radius = std::max(radius, distance(centre, side.at));
      Vec3 ahead = out[first + i];
      if (n > 3) ahead = ahead + out[first + (i + 1) % n] + out[first + (i + n - 1) % n];
      const double size = length(ahead);
      side.ahead = size > 0 ? (1 / size) * ahead : Vec3{0, 0, 0};
      side.along = cross(side.ahead, side.normal);
    }
    voters.balls[r] = {centre, radius};
  }
}

class Grouper {
 public:
  Grouper(const MeshView& mesh, const Rims& rims, Grouping& result)
      : at_(mesh.positions), rims_(rims), g_(result), parents_(rims.count()) {
    std::iota(parents_.begin(), parents_.end(), 0u);
  }

  /// Joins from the strongest vote on, so that the last one that joins a group is its score.
  void join(ArrayView<const uint8_t> joined) {
    std::vector<uint32_t> order;
    for (uint32_t i = 0; i < g_.votes.size(); ++i)
      if (joined[i]) order.push_back(i);
    sf::sort(order.begin(), order.end(), [&](uint32_t i, uint32_t j) {
      return g_.votes[i].vote != g_.votes[j].vote ? g_.votes[i].vote > g_.votes[j].vote : i < j;
    });
    scores_.assign(rims_.count(), 1);
    for (const uint32_t i : order) {
      const uint32_t p = rootOf(g_.votes[i].first), q = rootOf(g_.votes[i].second);
      if (p == q) continue;
      parents_[std::max(p, q)] = std::min(p, q);
      scores_[std::min(p, q)] = std::min({scores_[p], scores_[q], g_.votes[i].vote});
    }
  }

  void list() {
    struct Member {
      uint32_t root, rim;
    };
    std::vector<Member> members;
    for (uint32_t r = 0; r < rims_.count(); ++r) members.push_back({rootOf(r), r});
    sf::sort(members.begin(), members.end(), [](const Member& a, const Member& b) {
      return a.root != b.root ? a.root < b.root : a.rim < b.rim;
    });
    g_.starts.assign(1, 0);
    g_.rims.clear(), g_.kinds.clear(), g_.scores.clear(), g_.isOpenRim.clear(), g_.isSeam.clear();
    for (size_t i = 0, j; i < members.size(); i = j) {
      for (j = i; j < members.size() && members[j].root == members[i].root; ++j)
        g_.rims.push_back(members[j].rim);
      finish(uint32_t(i), members[i].root);
      g_.starts.push_back(uint32_t(j));
    }
  }

 private:
  uint32_t rootOf(uint32_t r) {
    while (parents_[r] != r) r = parents_[r] = parents_[parents_[r]];
    return r;
  }
  double turningOf(uint32_t rim) const;
  void finish(uint32_t first, uint32_t root);

  UnitScale at_;
  const Rims& rims_;
  Grouping& g_;
  std::vector<uint32_t> parents_;
  std::vector<double> scores_;  // of groups, at their roots
};

/// How far a rim turns to the left on the surface in all, seen with the normals up: about 2 pi around a hole,
/// -2 pi around an island, 0 around a tube.
double Grouper::turningOf(uint32_t rim) const {
  double sum = 0;
  for (uint32_t e = rims_.starts[rim]; e < rims_.starts[rim + 1]; ++e) {
    const uint32_t f = rims_.nextEdge(rim, e), g = rims_.nextEdge(rim, f);
    const Vec3 a = at_(rims_.vertices[e]), b = at_(rims_.vertices[f]), c = at_(rims_.vertices[g]);
    Vec3 up = rims_.normals[e] + rims_.normals[f];
    const double size = length(up);
    if (!(size > 1e-6)) continue;
    up = (1 / size) * up;
    const Vec3 in = (b - a) - dot(b - a, up) * up, on = (c - b) - dot(c - b, up) * up;
    sum += std::atan2(dot(up, cross(in, on)), dot(in, on));
  }
  return sum;
}

/// Puts the outer rim first, and says what the group is.
void Grouper::finish(uint32_t first, uint32_t root) {
  const auto begin = g_.rims.begin() + first;
  double leastTurning = std::numeric_limits<double>::infinity(), whole = 0, open = 0;
  bool isSeam = true;
  size_t outer = first;
  double mostTurning = -std::numeric_limits<double>::infinity();
  for (size_t i = first; i < g_.rims.size(); ++i) {
    const uint32_t r = g_.rims[i];
    const double turning = turningOf(r), length = rims_.rims[r].length;
    leastTurning = std::min(leastTurning, turning);
    (void)mostTurning;
    if (length > rims_.rims[g_.rims[outer]].length) outer = i;
    whole += length, open += length * g_.openness[r];
    isSeam &= rims_.rims[r].cutEdges > 0;
  }
  std::rotate(begin, g_.rims.begin() + ptrdiff_t(outer), g_.rims.begin() + ptrdiff_t(outer) + 1);
  const bool isAlone = g_.rims.size() - first == 1;
  const bool isOpen = open > kOpenFrom * whole;
  g_.kinds.push_back(isAlone ? GroupKind::Alone
                             : leastTurning < -kPi ? GroupKind::Island : GroupKind::Band);
  g_.scores.push_back(scores_[root]);
  g_.isOpenRim.push_back(isOpen);
  g_.isSeam.push_back(isSeam && isOpen);
}

}  // namespace

bool castVotes(const MeshView& mesh, const Rims& rims, Work& work, Charge& charge,
               Grouping& result) {
  const UnitScale at(mesh.positions);
  const size_t edges = rims.vertices.size();
  Charge temporary(work);
  if (!temporary.add(edges * (sizeof(RimSide) + sizeof(double) + sizeof(Vec3)) +
                     rims.count() * sizeof(RimBall)) ||
      !charge.add(rims.count() * sizeof(double)))
    return false;
  Voters voters{std::vector<RimSide>(edges), std::vector<double>(edges),
                std::vector<RimBall>(rims.count())};
  placeVoters(rims, at, voters);
  RimTree tree(work);
  if (!tree.build(voters.sides, rims.starts, voters.balls)) return false;

  struct Ballot {
    uint32_t first, second;
    double shareOfFirst, shareOfSecond;
  };
  std::vector<Ballot> ballots;
  result = {};
  result.openness.assign(rims.count(), 0);
  for (uint32_t r = 0; r < rims.count(); ++r) {
    const uint32_t first = rims.starts[r], n = rims.starts[r + 1] - first;
    const double whole = std::accumulate(voters.lengths.begin() + first,
                                         voters.lengths.begin() + first + n, 0.0);
    for (uint32_t e = first; e < first + n; ++e) {
      const RimPartner best = tree.best(e, kReach * voters.balls[r].radius);
      if (!work.going()) return false;
      const double share = whole > 0 ? voters.lengths[e] / whole : 1.0 / n;
      if (best.edge == kNone || best.turn > kTurnOfOpen) result.openness[r] += share;
      if (best.edge == kNone) continue;
      const uint32_t other = voters.sides[best.edge].rim;
      if (other == r) continue;
      const Ballot ballot = r < other ? Ballot{r, other, share, 0} : Ballot{other, r, 0, share};
      if (!push(ballots, ballot, temporary)) return false;
    }
  }
  sf::sort(ballots.begin(), ballots.end(), [](const Ballot& a, const Ballot& b) {
    if (a.first != b.first) return a.first < b.first;
    if (a.second != b.second) return a.second < b.second;
    return a.shareOfFirst != b.shareOfFirst ? a.shareOfFirst < b.shareOfFirst
                                            : a.shareOfSecond < b.shareOfSecond;
  });
  for (size_t i = 0, j; i < ballots.size(); i = j) {
    double ofFirst = 0, ofSecond = 0;
    for (j = i; j < ballots.size() && ballots[j].first == ballots[i].first &&
                ballots[j].second == ballots[i].second;
         ++j)
      ofFirst += ballots[j].shareOfFirst, ofSecond += ballots[j].shareOfSecond;
    const RimVote vote{ballots[i].first, ballots[i].second, std::min(1.0, std::max(ofFirst, ofSecond))};
    if (!push(result.votes, vote, charge)) return false;
  }
  return true;
}

bool joinRims(const MeshView& mesh, const Rims& rims, ArrayView<const uint8_t> joined, Work& work,
              Charge& charge, Grouping& result) {
  SF_ASSERT(joined.size() == result.votes.size());
  Charge temporary(work);
  if (!charge.add(rims.count() * (2 * sizeof(uint32_t) + sizeof(double) + 3)) ||
      !temporary.add(rims.count() * (3 * sizeof(uint32_t) + sizeof(double)) +
                     result.votes.size() * sizeof(uint32_t)) ||
      !work.tick(uint32_t(std::min<size_t>(rims.vertices.size() * 100, 1u << 30))))
    return false;
  Grouper grouper(mesh, rims, result);
  grouper.join(joined);
  grouper.list();
  return true;
}

bool groupRims(const MeshView& mesh, const Rims& rims, Work& work, Charge& charge,
               Grouping& result) {
  if (!castVotes(mesh, rims, work, charge, result)) return false;
  Charge temporary(work);
  if (!temporary.add(result.votes.size())) return false;
  std::vector<uint8_t> joined;
  for (const RimVote& v : result.votes) joined.push_back(v.vote >= kJoinsFrom);
  return joinRims(mesh, rims, joined, work, charge, result);
}

}  // namespace sf
