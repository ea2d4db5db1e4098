// The relaxed bound in the plainest way: splits of shapes, a map of known values,
// all pairs at an edge.
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

  /// The value that RelaxedBound should have for the root, or for any canonical shape and slot.
  double bound(uint32_t rootVertex);
  double value(sf::Shape shape, uint32_t slot);
  /// Whether the last root splits into that shape, with other parts that can all be filled.
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
