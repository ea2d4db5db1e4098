// What the calls of the C ABI share: checks of settings, budgets, and the place of a fault.
#pragma once
#include <cmath>

#include "base/status.h"
#include "base/work.h"
#include "soapfilm.h"

namespace sf {

/// Whether `value` is one of 0, 1, ..., count - 1.
inline bool isChoice(double value, int count) {
  return value >= 0 && value < count && value == std::floor(value);
}

/// Whether starts [count + 1] rise from 0.
inline bool isRising(const uint32_t* starts, uint32_t count) {
  for (uint32_t i = 0; i < count; ++i)
    if (starts[i + 1] < starts[i]) return false;
  return starts[0] == 0;
}

/// A budget of at most `maxBytes` (not NaN) that reports to the host.
inline Work hostWork(double maxBytes) {
  const auto report = [](void*, double fraction, double bestCost, double lowerBound) {
    return sf_host_progress(fraction, bestCost, lowerBound) != 0;
  };
  const double most = double(size_t(-1));
  return Work(maxBytes < most ? size_t(maxBytes) : size_t(-1), report, nullptr);
}

/// The status to end a call with. Writes the place it is about to `where`.
inline SfStatus endWith(const Outcome& outcome, SfPlace* where) {
  where->loop = outcome.loop, where->vertex = outcome.vertex;
  where->otherLoop = outcome.otherLoop, where->otherVertex = outcome.otherVertex;
  return SfStatus(outcome.status);
}

}  // namespace sf
