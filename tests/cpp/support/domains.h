// Domains to ask bounds about.
#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "loops/domains/domain.h"
#include "loops/domains/pass.h"
#include "support/generators.h"

namespace sftest {

/// Goes down random splits from the root, the edge from `root` to the next vertex, many times, and calls
/// `visit` for every canonical shape on the way, with the slot of each triangle at its access edge that can
/// be its access triangle.
void walkDomains(const sf::Pass& pass, uint32_t root, Random& random,
                 const std::function<void(sf::Shape shape, uint32_t slot)>& visit);

/// A domain of a surface: what is inside costs that much, angles across its spanning edges included.
struct FilledDomain {
  std::vector<uint32_t> shape;  // canonical
  uint32_t accessSlot;          // of the surface's triangle outside
  double cost;
};

/// The domains that a surface over several loops splits into, but for the root and those without holes on
/// one segment; empty if the triangles are no such surface. Costs are of sums.
std::vector<FilledDomain> domainsOf(const sf::Pass& pass, uint32_t root,
                                    const std::vector<uint32_t>& triangles);

}  // namespace sftest
