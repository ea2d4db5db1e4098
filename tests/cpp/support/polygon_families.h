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

/// A polygon of a family. Rings have random starts, some are reversed, holes come in any order.
/// Unless the polygon is to stay exactly as made, a random affine map of small integers and a power
/// of two is applied. None of this changes what is wrong.
Polygon instanceOf(const Family& family, Random& random);

constexpr uint32_t kInstancesPerFamily = 150;

}  // namespace sftest
