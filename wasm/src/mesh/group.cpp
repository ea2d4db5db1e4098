#include "mesh/group.h"

#include <algorithm>
#include <cmath>

#include "base/sort.h"
#include "base/union_find.h"
#include "mesh/body.h"
#include "mesh/joint_cost.h"
#include "mesh/vote.h"

namespace sf {
namespace {

/// Bodies rounder than this (Body::roundness) are no sheets: half a sphere has .59, a cap of
/// it as high as half its radius .29, one of .3 radii .17.
constexpr double kRoundBody = 0.2;
/// How often rims are looked for that a whole group joins.
constexpr int kMostRounds = 32;

class Grouper {
 public:
  Grouper(const MeshView& mesh, const Adjacency& adjacency, const Rims& rims, Work& work,
          Grouping& result)
      : mesh_(mesh),
        at_(mesh.positions),
        a_(adjacency),
        rims_(rims),
        work_(work),
        temporary_(work),
        g_(result) {}

  bool joinByVotes();
  bool group();

 private:
  bool reserveRims() {
    return temporary_.add(rims_.count() * (4 * sizeof(uint32_t) + 4 * sizeof(double)));
  }
  void findTurnings() {
    turnings_.clear();
    for (uint32_t r = 0; r < rims_.count(); ++r) turnings_.push_back(turningOf(r));
  }
  bool joinByGroups();
  bool joinIslands();
  bool isIsland(uint32_t rim) const { return turnings_[rim] < -kPi; }
  bool decideDoubts();
  /// Whether votes join two rims, or both face something.
  bool mayJoin(const RimVote& v) const {
    return v.isJoined || std::max(g_.openness[v.first], g_.openness[v.second]) <= kOpenFrom;
  }
  void sortByVote(std::vector<uint32_t>& votes) const;
  void join();
  void finish(uint32_t first, uint32_t root);
  double turningOf(uint32_t rim) const;
  bool closeBodies();

  MeshView mesh_;
  UnitScale at_;
  const Adjacency& a_;
  const Rims& rims_;
  Work& work_;
  Charge temporary_;
  Grouping& g_;
  UnionFind joined_;
  std::vector<double> turnings_;  // [k]
  std::vector<double> scores_;    // of groups, at their roots
};

bool Grouper::joinByVotes() {
  if (!reserveRims()) return false;
  joined_.reset(rims_.count());
  findTurnings();
  for (RimVote& v : g_.votes) {
    v.isJoined = v.vote >= kJoinsFrom;
    if (v.isJoined) joined_.unite(v.first, v.second);
  }
  return joinByGroups() && joinIslands() && decideDoubts();
}

/// An island in the midst of others looks at all of them, and at the outer rim, a little each.
bool Grouper::joinByGroups() {
  struct Look {
    uint32_t rim, vote;
  };
  std::vector<Look> looks;
  if (!reserve(looks, 2 * g_.votes.size(), temporary_)) return false;
  for (uint32_t i = 0; i < g_.votes.size(); ++i) {
    looks.push_back({g_.votes[i].first, i});
    looks.push_back({g_.votes[i].second, i});
  }
  sf::sort(looks.begin(), looks.end(), [](const Look& a, const Look& b) {
    return a.rim != b.rim ? a.rim < b.rim : a.vote < b.vote;
  });
  struct Sum {
    uint32_t root, strongest;  // a vote
    double share;
  };
  std::vector<Sum> sums;
  bool goesOn = true;
  for (int round = 0; round < kMostRounds && goesOn; ++round) {
    goesOn = false;
    if (!work_.tick(uint32_t(std::min<size_t>(looks.size() * 20, 1u << 30)))) return false;
    for (size_t i = 0, j; i < looks.size(); i = j) {
      const uint32_t rim = looks[i].rim;
      sums.clear();
      for (j = i; j < looks.size() && looks[j].rim == rim; ++j) {
        const RimVote& v = g_.votes[looks[j].vote];
        const uint32_t root = joined_.rootOf(v.first == rim ? v.second : v.first);
        if (root == joined_.rootOf(rim)) continue;
        const double share = v.first == rim ? v.shareOfFirst : v.shareOfSecond;
        const auto same =
            std::find_if(sums.begin(), sums.end(), [&](const Sum& s) { return s.root == root; });
        if (same == sums.end()) {
          if (!push(sums, {root, looks[j].vote, share}, temporary_)) return false;
          continue;
        }
        same->share += share;
        if (v.vote > g_.votes[same->strongest].vote) same->strongest = looks[j].vote;
      }
      for (const Sum& s : sums) {
        if (s.share < kJoinsGroupFrom) continue;
        RimVote& v = g_.votes[s.strongest];
        v.vote = std::min(1.0, std::max(v.vote, s.share));
        v.isJoined = true;
        goesOn |= joined_.unite(rim, s.root);
      }
    }
  }
  return true;
}

/// Joins what can be nothing but islands to the hole around them, if that looks at them: it may be so
/// large that this is a small share of it, while they see others behind it.
bool Grouper::joinIslands() {
  struct Look {
    uint32_t island, hole;  // roots
    uint32_t vote;
    double length;
  };
  std::vector<Look> looks;
  std::vector<double> lengths(rims_.count());
  std::vector<uint8_t> isAllIslands(rims_.count());
  bool goesOn = true;
  for (int round = 0; round < kMostRounds && goesOn; ++round) {
    goesOn = false;
    looks.clear();
    std::fill(lengths.begin(), lengths.end(), 0.0);
    std::fill(isAllIslands.begin(), isAllIslands.end(), uint8_t(1));
    if (!work_.tick(uint32_t(std::min<size_t>(g_.votes.size() * 50, 1u << 30)))) return false;
    for (uint32_t r = 0; r < rims_.count(); ++r) {
      lengths[joined_.rootOf(r)] += rims_.rims[r].length;
      if (!isIsland(r)) isAllIslands[joined_.rootOf(r)] = 0;
    }
    for (uint32_t i = 0; i < g_.votes.size(); ++i) {
      const RimVote& v = g_.votes[i];
      const uint32_t p = joined_.rootOf(v.first), q = joined_.rootOf(v.second);
      if (p == q || isAllIslands[p] == isAllIslands[q]) continue;
      const double length = v.shareOfFirst * rims_.rims[v.first].length +
                            v.shareOfSecond * rims_.rims[v.second].length;
      const Look look{isAllIslands[p] ? p : q, isAllIslands[p] ? q : p, i, length};
      if (!push(looks, look, temporary_)) return false;
    }
    sf::sort(looks.begin(), looks.end(), [](const Look& a, const Look& b) {
      if (a.island != b.island) return a.island < b.island;
      return a.hole != b.hole ? a.hole < b.hole : a.vote < b.vote;
    });
    for (size_t i = 0, j; i < looks.size(); i = j) {
      const uint32_t island = looks[i].island;
      double sum = 0;
      uint32_t strongest = looks[i].vote;
      for (j = i; j < looks.size() && looks[j].island == island && looks[j].hole == looks[i].hole;
           ++j) {
        sum += looks[j].length;
        if (g_.votes[looks[j].vote].vote > g_.votes[strongest].vote) strongest = looks[j].vote;
      }
      if (!(sum >= kJoinsIslandFrom * lengths[island]) || !(sum > 0)) continue;
      RimVote& v = g_.votes[strongest];
      if (!joined_.unite(v.first, v.second)) continue;
      v.isJoined = true;
      v.vote = std::min(1.0, std::max(v.vote, sum / lengths[island]));
      goesOn = true;
    }
  }
  return true;
}

/// Lets the cost decide on what is in doubt, from the strongest vote on: what is joined by then is no doubt.
bool Grouper::decideDoubts() {
  joined_.reset(rims_.count());
  std::vector<uint32_t> doubts;
  for (uint32_t i = 0; i < g_.votes.size(); ++i) {
    const RimVote& v = g_.votes[i];
    if (v.vote > kDoubtTo)
      joined_.unite(v.first, v.second);
    else if (v.vote >= kDoubtFrom && mayJoin(v) && !push(doubts, i, temporary_))
      return false;
  }
  sortByVote(doubts);
  JointCost cost(mesh_, rims_, work_);
  for (const uint32_t i : doubts) {
    RimVote& v = g_.votes[i];
    if (joined_.rootOf(v.first) == joined_.rootOf(v.second)) continue;
    Verdict verdict;
    if (!cost.compare(v.first, v.second, verdict)) return false;
    if (verdict != Verdict::Unknown) v.isJoined = verdict == Verdict::Together;
    if (v.isJoined) joined_.unite(v.first, v.second);
  }
  return true;
}

void Grouper::sortByVote(std::vector<uint32_t>& votes) const {
  sf::sort(votes.begin(), votes.end(), [&](uint32_t i, uint32_t j) {
    return g_.votes[i].vote != g_.votes[j].vote ? g_.votes[i].vote > g_.votes[j].vote : i < j;
  });
}

/// From the strongest vote on, so that the last one that joins a group is its score.
void Grouper::join() {
  std::vector<uint32_t> order;
  order.reserve(g_.votes.size());
  for (uint32_t i = 0; i < g_.votes.size(); ++i)
    if (g_.votes[i].isJoined) order.push_back(i);
  sortByVote(order);
  scores_.assign(rims_.count(), 1);
  for (const uint32_t i : order) {
    const RimVote& v = g_.votes[i];
    if (joined_.unite(v.first, v.second)) scores_[joined_.rootOf(v.first)] = v.vote;
  }
}

bool Grouper::group() {
  if (!temporary_.add(g_.votes.size() * sizeof(uint32_t)) ||
      !work_.tick(uint32_t(std::min<size_t>(rims_.vertices.size() * 100, 1u << 30))))
    return false;
  joined_.reset(rims_.count());
  join();
  struct Member {
    uint32_t root, rim;
  };
  std::vector<Member> members;
  members.reserve(rims_.count());
  for (uint32_t r = 0; r < rims_.count(); ++r) members.push_back({joined_.rootOf(r), r});
  sf::sort(members.begin(), members.end(), [](const Member& a, const Member& b) {
    return a.root != b.root ? a.root < b.root : a.rim < b.rim;
  });
  g_.starts.assign(1, 0);
  g_.rims.clear(), g_.kinds.clear(), g_.scores.clear(), g_.isOpenRim.clear();
  for (size_t i = 0, j; i < members.size(); i = j) {
    for (j = i; j < members.size() && members[j].root == members[i].root; ++j)
      g_.rims.push_back(members[j].rim);
    finish(uint32_t(i), members[i].root);
    g_.starts.push_back(uint32_t(j));
  }
  return closeBodies();
}

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
  double whole = 0, open = 0;
  bool hasIsland = false, crossesSeam = false;
  size_t outer = first;
  for (size_t i = first; i < g_.rims.size(); ++i) {
    const uint32_t r = g_.rims[i];
    const Rim& rim = rims_.rims[r];
    hasIsland |= isIsland(r);
    // The longest that is no island: a ragged island can be longer than the rim around it.
    const uint32_t best = g_.rims[outer];
    const bool isLonger = rim.length > rims_.rims[best].length;
    if (isIsland(r) == isIsland(best) ? isLonger : isIsland(best)) outer = i;
    whole += rim.length, open += rim.length * g_.openness[r];
    crossesSeam |= rim.crossesSeam;
  }
  std::rotate(begin, g_.rims.begin() + ptrdiff_t(outer), g_.rims.begin() + ptrdiff_t(outer) + 1);
  const bool isAlone = g_.rims.size() - first == 1;
  const bool isOpen = open > kOpenFrom * whole || crossesSeam;
  g_.kinds.push_back(isAlone ? GroupKind::Alone : hasIsland ? GroupKind::Island : GroupKind::Band);
  g_.scores.push_back(scores_[root]);
  g_.isOpenRim.push_back(isOpen);
}

/// The only open group of a body that closing does not make a sheet is a hole.
bool Grouper::closeBodies() {
  std::vector<Body> bodies;
  if (!findBodies(mesh_, a_, rims_, g_, work_, temporary_, bodies)) return false;
  for (const Body& b : bodies) {
    if (b.openGroups != 1 || !b.isOrientable || !(b.roundness() > kRoundBody)) continue;
    g_.isOpenRim[b.openGroup] = 0;
  }
  return true;
}

}  // namespace

bool groupRims(const MeshView& mesh, const Adjacency& adjacency, const Rims& rims, Work& work,
               Charge& charge, Grouping& result) {
  if (!castVotes(mesh, rims, work, charge, result)) return false;
  // starts, rims, kinds, scores, flags: no more groups than rims, now and later.
  if (!charge.add(rims.count() * (2 * sizeof(uint32_t) + sizeof(double) + 2))) return false;
  Grouper grouper(mesh, adjacency, rims, work, result);
  return grouper.joinByVotes() && grouper.group();
}

}  // namespace sf
