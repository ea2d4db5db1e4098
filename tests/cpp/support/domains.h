// Domains to test bounds with.
#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "loops/domains/domain.h"
#include "loops/domains/pass.h"
#include "support/generators.h"

namespace sftest {

/// Goes down random splits many times, from the root, the edge from `root` to the next vertex.
/// Calls `visit` for every canonical shape on the way, with each slot at its access edge whose
/// triangle can be its access triangle.
void walkDomains(const sf::Pass& pass, uint32_t root, Random& random,
                 const std::function<void(sf::Shape shape, uint32_t slot)>& visit);

/// A domain of a surface, and the cost of what fills it, angles across its spanning edges included.
struct FilledDomain {
  std::vector<uint32_t> shape;  // canonical
  uint32_t accessSlot;          // of the surface's triangle outside
  double cost;
};

/// The domains that a surface over several loops splits into, except the root and those of one
/// segment without holes; empty if the triangles are no such surface. Costs are sums.
std::vector<FilledDomain> domainsOf(const sf::Pass& pass, uint32_t root,
                                    const std::vector<uint32_t>& triangles);

}  // namespace sftest
