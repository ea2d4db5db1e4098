#include "loops/lower_bound.h"

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
        // Skips the triangle itself, which can be next only if there is nothing nearer.
        size_t i = (at + (step == 0 ? 0 : around.size() - 1)) % around.size();
        if (around[i].second == slot) i = (i + (step == 0 ? 1 : around.size() - 1)) % around.size();
        least[slot] = std::min(least[slot], measure.pair(theta, around[i].first));
      }
    }
  }
  return least;
}

}  // namespace sf
