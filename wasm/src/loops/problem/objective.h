// What a span minimises over its surfaces.
#pragma once
#include <cstdint>

namespace sf {

enum class Objective : int32_t {
  Sum = 0,            // the weighted sum
  WorstDihedral = 1,  // the largest angle, ties settled by the weighted sum
};

}  // namespace sf
