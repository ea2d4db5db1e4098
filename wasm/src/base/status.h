// What a call of the core ends with, and where in its input the trouble lies.
#pragma once
#include <cstdint>

namespace sf {

/// The values cross the C ABI; wasm/ts/messages.ts maps each to the stable `code` of SoapfilmError.
enum class Status : int32_t {
  Ok = 0,
  NotFound = 1,        // no triangulation in the candidate space: an answer, not an error
  NoLoops = 2,         // zero loops
  BadStarts = 3,       // `starts` not increasing from 0 to n
  NotFinite = 4,       // a coordinate is NaN or beyond kLargestCoordinate
  TooFewVertices = 5,  // a loop of fewer than 3 vertices
  RepeatedVertex = 6,  // two vertices of the input have the same position
  LoopsIntersect = 7,  // two loop edges cross, touch or overlap
  BadNormals = 8,      // a boundary normal is zero or partly NaN
  BadWeights = 9,      // a weight is negative, not finite, or all are zero
  BadCandidates = 10,  // a candidate index out of range, repeated, or a degenerate triangle
  TooLarge = 11,       // the predicted size exceeds the memory limit
  OutOfMemory = 12,    // the memory limit was reached at work
  Stopped = 13,        // the progress callback asked to stop (cancel or time limit)
  BadOption = 14,      // an option out of its range
  // Polygons in the plane:
  SelfIntersecting = 15,   // two edges of one ring cross or overlap
  HoleOutside = 16,        // a hole is not inside the outer ring, or crosses it
  HolesOverlap = 17,       // two holes cross or have an edge in common
  NestedHole = 18,         // a hole lies inside another
  DegeneratePolygon = 19,  // a ring of fewer than 3 distinct points, or with a spike
};

constexpr uint32_t kNone = 0xFFFFFFFFu;
/// Of a coordinate: squares have to stay finite.
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
