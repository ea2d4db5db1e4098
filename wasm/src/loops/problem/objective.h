// What a span minimises over its surfaces, and which triangles these may have.
#pragma once
#include <cstdint>

namespace sf {

enum class Objective : int32_t {
  Sum = 0,            // the weighted sum
  WorstDihedral = 1,  // the largest angle, ties settled by the weighted sum
};

/// Candidate spaces.
enum class Space : int32_t { Auto = 0, All = 1, Delaunay = 2, Near = 3, Given = 4 };

}  // namespace sf
