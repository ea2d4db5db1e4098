// Which rims belong to one hole: outer rims with their islands, the two ends of a missing band.
//
// Source: Zou, Ju, Carr 2013, sec. 5 and 6: holes with islands, grouped by hand; "automatic grouping
// by the cost of the triangulation" is left as future work there.
// Differs: rims vote. Every edge of a rim looks away from its face for the edge that a fair surface
// would lead to at least cost; where votes leave a pair open, it is handed out for the cost to decide.
#pragma once
#include <cstdint>
#include <vector>

#include "base/charge.h"
#include "mesh/find.h"

namespace sf {

enum class GroupKind : uint8_t { Alone, Island, Band };

/// Two rims, and the larger of the shares of either, by length, that looks at the other.
struct RimVote {
  uint32_t first, second;  // first < second
  double vote;
};

struct Grouping {
  std::vector<double> openness;     // [k] share of each rim, by length, that faces nothing
  std::vector<RimVote> votes;       // all pairs with votes, by rims
  std::vector<uint32_t> starts;     // [g+1] in `rims`
  std::vector<uint32_t> rims;       // [k] outer rim first, then by number; groups by their least rim
  std::vector<GroupKind> kinds;     // [g]
  std::vector<double> scores;       // [g] the least vote that the group hangs by; 1 for a rim alone
  std::vector<uint8_t> isOpenRim;   // [g] meant to be open
  /// [g] Along edges that have several faces, and not a hole either: where a sheet ends on others.
  std::vector<uint8_t> isSeam;

  uint32_t count() const { return uint32_t(kinds.size()); }
};

constexpr double kJoinsFrom = 0.4;                    // least vote that joins two rims
constexpr double kOpenFrom = 0.5;                     // an open rim has more openness
constexpr double kDoubtFrom = 0.3, kDoubtTo = 0.65;   // votes that the cost should confirm

/// Votes of all rims, and their openness.
/// About O(r log r) time for r edges of rims. Memory of the result is charged to `charge`.
/// False once `work` has to end.
bool castVotes(const MeshView& mesh, const Rims& rims, Work& work, Charge& charge,
               Grouping& result);

/// Groups of rims that are joined by pairs, directly or not.
///   result  with openness and votes; the rest is made anew
///   joined  [votes] whether each pair is joined
/// False once `work` has to end.
bool joinRims(const MeshView& mesh, const Rims& rims, ArrayView<const uint8_t> joined, Work& work,
              Charge& charge, Grouping& result);

/// castVotes, and joinRims with all pairs that have votes from kJoinsFrom on. To let the cost decide
/// those between kDoubtFrom and kDoubtTo, call joinRims again.
bool groupRims(const MeshView& mesh, const Rims& rims, Work& work, Charge& charge,
               Grouping& result);

}  // namespace sf
