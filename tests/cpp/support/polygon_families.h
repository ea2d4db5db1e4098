// Degenerate and faulty polygons by family, each with the outcome it has to have and the reason.
#pragma once
#include <cstdint>
#include <vector>

#include "support/polygon_generators.h"
#include "support/polygon_oracle.h"

namespace sftest {

struct Family {
  const char* name;
  uint32_t faults;     // what is wrong with each of its polygons, as a set; kValid if nothing is
  const char* reason;  // why that is the right outcome
  bool exactlyAsMade;  // coordinates at the edges of what doubles can hold: not to be moved
  Polygon (*make)(Random&);
};

/// The table of families.
const std::vector<Family>& polygonFamilies();

/// A polygon of a family: unless it is to stay as made, under a random affine map of small
/// integers and a power of two, neither of which changes what is wrong; rings from random starts,
/// some reversed, holes in any order.
Polygon instanceOf(const Family& family, Random& random);

constexpr uint32_t kInstancesPerFamily = 150;

}  // namespace sftest
