// Which rims belong to one hole: outer rims with their islands, the two ends of a missing band.
//
// Source: Zou, Ju, Carr 2013, sec. 5 and 6: holes with islands, grouped by hand; "automatic grouping
// by the cost of the triangulation" is left as future work there.
// Differs: rims vote. Every edge of a rim looks away from its face for the edge that a fair surface
// would lead to at least cost. Where votes leave a pair open, the cost of the triangulation decides.
#pragma once
#include <cstdint>
#include <vector>

#include "base/charge.h"
#include "mesh/find.h"

namespace sf {

enum class GroupKind : uint8_t { Alone, Island, Band };

/// How two rims look at each other.
struct RimVote {
  uint32_t first, second;              // first < second
  double shareOfFirst, shareOfSecond;  // of each rim, by length, that looks at the other
  /// The larger share; or, if that joins the rims, the share of one rim at all rims of the other's
  /// group, or how much looks at an island for its length.
  double vote;
  bool isJoined;
};

struct Grouping {
  std::vector<double> openness;  // [k] share of each rim, by length, that faces nothing
  std::vector<RimVote> votes;    // all pairs with votes, by rims

  std::vector<uint32_t> starts;    // [g+1] in `rims`
  std::vector<uint32_t> rims;      // [k] outer rim first, then by number; groups by their least rim
  std::vector<GroupKind> kinds;    // [g]
  std::vector<double> scores;      // [g] the least vote that the group hangs by; 1 for a rim alone
  std::vector<uint8_t> isOpenRim;  // [g] meant to be open

  uint32_t count() const { return uint32_t(kinds.size()); }
};

constexpr double kJoinsFrom = 0.4;        // least vote that joins two rims
constexpr double kJoinsGroupFrom = 0.5;   // least share at a group that joins a rim to it
constexpr double kJoinsIslandFrom = 0.4;  // least length that looks at an island, over its own
constexpr double kOpenFrom = 0.5;         // an open rim has more openness
constexpr double kDoubtFrom = 0.15, kDoubtTo = 0.8;  // votes that the cost decides on

/// Groups rims by their votes. Pairs with votes from kDoubtFrom to kDoubtTo that stronger ones do not join are
/// joined if they cost less together than apart; by their votes, where that is Unknown (JointCost). Rims that face
/// nothing are joined by votes alone.
/// A group is open if more than kOpenFrom of its rims' length faces nothing. But the only open group of a
/// body, whose closing leaves it a body and no sheet, is a hole: of a bowl, or half a sphere.
/// About O(m + r log r) time for r edges of rims, and what JointCost takes for doubts. Memory of the result is charged to `charge`.
/// False once `work` has to end.
bool groupRims(const MeshView& mesh, const Adjacency& adjacency, const Rims& rims, Work& work,
               Charge& charge, Grouping& result);

}  // namespace sf
