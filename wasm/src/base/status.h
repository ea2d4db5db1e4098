// How a call of the core ended, and which part of its input is at fault.
#pragma once
#include <cstdint>

#include "soapfilm_tables.h"

namespace sf {

/// The values cross the C ABI, whose table says what each means.
enum class Status : int32_t {
#define SF_STATUS(name, value, meaning) name = (value),
  SF_STATUSES(SF_STATUS)
#undef SF_STATUS
};

constexpr uint32_t kNone = 0xFFFFFFFFu;
/// The largest magnitude of a coordinate: squares have to stay finite.
constexpr double kLargestCoordinate = 1e150;

/// A status with the place it is about; kNone where a place does not apply.
struct Outcome {
  Status status = Status::Ok;
  uint32_t loop = kNone;         // loop of the first culprit
  uint32_t vertex = kNone;       // its vertex, counted in that loop (or the candidate's index)
  uint32_t otherLoop = kNone;    // loop of the second culprit, for pairs
  uint32_t otherVertex = kNone;  // its vertex, counted in that loop

  bool ok() const { return status == Status::Ok; }
};

}  // namespace sf
