// The relaxed bound in the plainest way: splits of shapes, a map of what is known, all pairs at an edge.
#pragma once
#include <cstdint>
#include <map>
#include <vector>

#include "loops/domains/domain.h"
#include "loops/domains/pass.h"

namespace sftest {

class RelaxedOracle {
 public:
  explicit RelaxedOracle(const sf::Pass& pass);

  /// What relaxed_bound.h says of the root, and of any canonical shape and slot.
  double bound(uint32_t rootVertex);
  double value(sf::Shape shape, uint32_t slot);
  /// Whether splits of the last root lead to that shape, all of whose other parts can be filled.
  bool holds(sf::Shape shape) const {
    return reached_.count(std::vector<uint32_t>(shape.begin(), shape.end())) > 0;
  }
  size_t domainCount() const { return reached_.size(); }

 private:
  const std::vector<double>& valuesOf(const std::vector<uint32_t>& shape);
  /// The least cost with each triangle at the access edge inside, without the angle across it.
  std::vector<double> insideOf(const std::vector<uint32_t>& shape);

  const sf::Pass& pass_;
  sf::Domains domains_;
  std::vector<double> leastPair_;
  std::map<std::vector<uint32_t>, std::vector<double>> known_, reached_;
};

}  // namespace sftest
