// A spanning forest of the triangles' dual graph, and the index count of the best strips along it.
//
// Strips are paths in the forest. A triangle can have six relations to the strip of the triangle
// above it. For each of them the least cost of everything below the triangle is kept; it follows
// from the costs of the triangles below. Costs are kept relative to that of the first relation. So
// a change far below leaves them as they are, and few have to be found anew when an edge flips.
//
// Source: Arkin, Held, Mitchell, Skiena 1996, "Hamiltonian triangulations for fast rendering", for
// strips as paths in the dual graph. The dynamic programme is not from a paper.
#pragma once
#include <cstdint>
#include <vector>

#include "base/array_view.h"
#include "base/work.h"
#include "triangles/triangle_mesh.h"

namespace sf {

/// The relation of a triangle to the strip of the triangle above it: not in it, its end, or one of
/// the four numbers kStripTurns + 2 turn + starts. In these the strip goes on below, with that turn
/// in the triangle (seen from above; 0 if it leaves by the half-edge after the one it came by). Its
/// start lies down there if `starts` is 1, else its end.
constexpr int kStripApart = 0, kStripEnds = 1, kStripTurns = 2;

/// The turn of a path in a triangle that it enters by half-edge `in` and leaves by `out`: 0 if out
/// follows in, 1 otherwise. Travelled the other way, the turn is the other one.
inline uint32_t turnOf(uint32_t in, uint32_t out) { return out == nextInTriangle(in) ? 0 : 1; }

/// In sixteenths of an index; the one index that every triangle takes is not counted. Each strip
/// costs one sixteenth more, so that of equal index counts the one with fewer strips wins.
struct StripCosts {
  int16_t own = 0;           // of the triangle apart, without the sum of those below it apart
  int16_t ends = 0;          // this and all below: less the cost of the triangle apart
  int16_t turns[2][2] = {};  // [turn][starts]
};

/// How a strip leaves its uppermost triangle: by which half-edges it goes down.
struct StripTop {
  int cost = 0;           // like StripCosts::own
  int links = 0;          // how many of the half-edges are crossed
  int edge[2] = {0, 0};   // place in StripForest::Below
  int state[2] = {0, 0};  // of the triangles there
};

class StripForest {
 public:
  static constexpr int kIndex = 16;  // an index, in the unit of StripCosts

  /// The costs of the triangles below a triangle, by half-edge: first the two after the half-edge
  /// towards the triangle above, last that one itself (nothing is below it except at roots). Null
  /// where there is no triangle.
  struct Below {
    const StripCosts* costs[3] = {nullptr, nullptr, nullptr};
  };

  /// Grows the forest and finds all costs. False when the work ended. O(m) time.
  bool grow(ArrayView<const uint32_t> twins, Work& work);

  std::vector<uint32_t> order;  // triangles, each after the one above it
  std::vector<uint32_t> up;     // half-edge of each towards the triangle above; kNone at roots
  std::vector<StripCosts> costs;

  /// The triangle below across half-edge h, or kNone.
  uint32_t childAcross(ArrayView<const uint32_t> twins, uint32_t h) const {
    const uint32_t g = twins[h];
    return g != kNone && up[g / 3] == g ? g / 3 : kNone;
  }
  /// Half-edge number `place` of triangle t in the order of Below.
  uint32_t edgeOf(uint32_t t, int place) const {
    const uint32_t h = up[t] == kNone ? 3 * t : up[t];
    return place == 0 ? nextInTriangle(h) : place == 1 ? prevInTriangle(h) : h;
  }
  Below below(ArrayView<const uint32_t> twins, uint32_t t) const;
  /// The least costs of all strips.
  int64_t total() const;

  static StripCosts costsOf(const Below& below);
  static StripTop bestTop(const Below& below);
  /// The cost below a triangle of a strip that comes through it with that turn to the triangle of
  /// `below`. The strip ends down there, or starts there if `starts`. `state` becomes the state of
  /// the triangle below.
  static int tail(const StripCosts& below, int turn, int starts, int& state);

 private:
  bool growFrom(ArrayView<const uint32_t> twins, uint32_t seed, Work& work);
  void enter(ArrayView<const uint32_t> twins, uint32_t t);

  std::vector<bool> seen_;
  std::vector<uint32_t> stack_;
};

}  // namespace sf
