// Every way through the solver by name, so that tests can force each of them onto one problem.
//
// The product chooses its way by size. Here a path names the problems that it is for, and then
// takes them however small they are.
#pragma once
#include <string>
#include <vector>

#include "support/cases.h"

namespace sftest {

/// The answer of one path to a problem.
struct PathAnswer {
  bool found = false;
  double cost = 0;                  // the objective as the path adds it up
  double lowerBound = 0;            // claimed: no surface costs less
  bool optimal = false;             // claimed
  std::vector<uint32_t> triangles;  // [3m] wound anyhow, each but the first beside an earlier one
  std::string fault;                // trouble besides the answer, or ""
};

struct Path {
  const char* name;
  bool transform;         // whether angles go through the transform, else all pairs are tried
  double tolerance;       // of costs, relative: 1e-9 but in single precision
  uint32_t mostVertices;  // it takes too long with more
  uint32_t every;         // of the problems it is for, takes one in this many: 1, more if slow
  bool (*isFor)(const Problem& problem);
  PathAnswer (*solve)(const Problem& problem, Random& random);

  /// solve(), with the transform or without. What must not matter is drawn at random: the root.
  PathAnswer answer(const Problem& problem, Random& random) const;
};

/// All paths. Problems have space All or Given, coordinates of magnitude at most 1 and explicit
/// weights; their loops may meet.
const std::vector<Path>& solverPaths();

}  // namespace sftest
