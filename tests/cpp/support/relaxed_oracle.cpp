#include "support/relaxed_oracle.h"

#include <algorithm>

#include "loops/domains/lower_bound.h"

namespace sftest {

using sf::kInfinity;

RelaxedOracle::RelaxedOracle(const sf::Pass& pass)
    : pass_(pass), domains_(pass.loops), leastPair_(sf::leastPairs(pass.set, pass.measure)) {}

std::vector<double> RelaxedOracle::insideOf(const std::vector<uint32_t>& shape) {
  const sf::CandidateSet& set = pass_.set;
  struct Ending {
    size_t at;
    double cost;
    std::vector<std::pair<std::vector<uint32_t>, uint32_t>>
        parts;  // shapes, and the triangle's slots
  };
  const uint32_t edge = sf::accessEdge(set, domains_, shape), begin = set.edgeSlots[edge];
  std::vector<double> best(set.degree(edge), kInfinity);
  std::vector<Ending> endings;
  for (uint32_t slot = begin; slot < set.edgeSlots[edge + 1]; ++slot) {
    const uint32_t t = set.slotTriangle[slot];
    domains_.forEachSplit(shape, set.slotApex[slot], [&](const sf::Split& split) {
      Ending ending{slot - begin, pass_.triangleCost[t], {}};
      for (uint32_t i = 0; i < split.partCount; ++i) {
        const sf::SplitPart& part = split.part[i];
        ending.cost =
            pass_.measure.join(ending.cost, sf::leafCost(pass_, domains_, leastPair_, part, t));
        if (part.kind != sf::PartKind::Domain) continue;
        std::vector<uint32_t> key = part.shape;
        domains_.makeCanonical(key);
        ending.parts.push_back({key, set.slotOpposite(t, part.apexOpposite)});
      }
      if (ending.cost < kInfinity) endings.push_back(std::move(ending));
      return true;
    });
  }
  for (Ending& ending : endings) {
    for (const auto& [key, slot] : ending.parts)
      ending.cost = pass_.measure.join(ending.cost, value(key, slot));
    best[ending.at] = std::min(best[ending.at], ending.cost);
  }
  return best;
}

const std::vector<double>& RelaxedOracle::valuesOf(const std::vector<uint32_t>& shape) {
  const auto known = known_.find(shape);
  if (known != known_.end()) return known->second;
  const sf::CandidateSet& set = pass_.set;
  const double* theta = &set.slotTheta[set.edgeSlots[sf::accessEdge(set, domains_, shape)]];
  const std::vector<double> inside = insideOf(shape);
  std::vector<double> values(inside.size(), kInfinity);
  for (size_t j = 0; j < values.size(); ++j)
    for (size_t i = 0; i < inside.size(); ++i)
      if (inside[i] < kInfinity)
        values[j] = std::min(values[j],
                             pass_.measure.join(inside[i], pass_.measure.pair(theta[i], theta[j])));
  return known_[shape] = values;
}

double RelaxedOracle::value(sf::Shape shape, uint32_t slot) {
  const std::vector<uint32_t> key(shape.begin(), shape.end());
  return valuesOf(key)[slot - pass_.set.edgeSlots[sf::accessEdge(pass_.set, domains_, shape)]];
}

double RelaxedOracle::bound(uint32_t rootVertex) {
  known_.clear();
  const std::vector<double> inside = insideOf(domains_.root(rootVertex));
  reached_ = known_;
  return *std::min_element(inside.begin(), inside.end());
}

}  // namespace sftest
