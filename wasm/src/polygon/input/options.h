// Options for the triangulation of polygons.
#pragma once
#include <cstdint>

namespace sf {

enum class PolygonMethod : int32_t { Flooding = 0, Trapezoids = 1 };
enum class Repair : int32_t { None = 0, EvenOdd = 1, NonZero = 2 };

struct PolygonOptions {
  PolygonMethod method = PolygonMethod::Flooding;
  Repair repair = Repair::None;  // what an invalid polygon gives: an error, or the points
                                 // of odd, or of non-zero, winding number
  bool delaunay = false;         // constrained Delaunay triangles
  bool strips = false;           // also as triangle strips
  bool verify = false;           // certify the result (polygon/fill/certificate.h)
  bool trace = false;            // record the actions of flooding; water then rises along
                                 // y, so the triangles may differ from those without
};

/// The transitions of flooding's automaton; Ronfard, Rossignac 1994, sec. 4. `Start` begins with a
/// waiting bottom.
enum class FloodAction : uint32_t { Start, Raise, Fill, Bridge, Spill, Jump };

/// One action of flooding, for teaching; see polygon/fill/flood.h.
struct FloodStep {
  uint32_t action;       // FloodAction
  uint32_t left, right;  // the vertices at the ends of the active chain after it
  uint32_t triangles;    // how many triangles there are after it
};

}  // namespace sf
