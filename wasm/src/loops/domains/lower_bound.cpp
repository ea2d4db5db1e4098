#include "loops/domains/lower_bound.h"

#include <algorithm>
#include <utility>

#include "base/sort.h"

namespace sf {

std::vector<double> leastPairs(const CandidateSet& set, Measure measure) {
  std::vector<double> least(set.slotTriangle.size(), kInfinity);
  std::vector<std::pair<double, uint32_t>> around;
  for (uint32_t e = 0; e < set.edgeCount(); ++e) {
    around.clear();
    for (uint32_t s = set.edgeSlots[e]; s < set.edgeSlots[e + 1]; ++s)
      around.push_back({set.slotTheta[s], s});
    if (around.size() < 2) continue;
    sf::sort(around.begin(), around.end());
    // The flattest partner stands nearest to the opposite direction, on one side or the other.
    for (const auto& [theta, slot] : around) {
      const double opposite = theta > 0 ? theta - kPi : theta + kPi;
      const size_t at =
          size_t(std::lower_bound(around.begin(), around.end(), std::make_pair(opposite, 0u)) -
                 around.begin());
      for (size_t step = 0; step < 2; ++step) {
        // Skips the triangle itself, which can come next only if nothing is nearer.
        size_t i = (at + (step == 0 ? 0 : around.size() - 1)) % around.size();
        if (around[i].second == slot) i = (i + (step == 0 ? 1 : around.size() - 1)) % around.size();
        least[slot] = std::min(least[slot], measure.pair(theta, around[i].first));
      }
    }
  }
  return least;
}

double leafCost(const Pass& pass, const Domains& domains, const std::vector<double>& leastPair,
                const SplitPart& part, uint32_t t) {
  if (part.kind != PartKind::EmptyPair && part.kind != PartKind::Segment) return 0;
  const uint32_t slot = pass.set.slotOpposite(t, part.apexOpposite);
  if (part.kind == PartKind::EmptyPair) return leastPair[slot];
  const Segment s = domains.segment(part.shape, 0);
  const ClosedSegment closed =
      pass.closedSegment(pass.set.edgeOpposite(t, part.apexOpposite), s.reversed, s.start, s.end);
  return pass.segments.value(slot, closed.side);
}

uint32_t accessEdge(const CandidateSet& set, const Domains& domains, Shape shape) {
  const uint32_t m = domains.segmentCount(shape);
  return set.edgeBetween(domains.spanStart(shape, m - 1), domains.spanEnd(shape, m - 1));
}

}  // namespace sf
