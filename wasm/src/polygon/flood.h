// Flooding: triangles in the order in which water would rise in the gorges of a polygon.
// Source: Ronfard, Rossignac 1994, sec. 3-6.
// Differs: the lowest sag in a gorge is not searched for in a list of all sags. It sees the gorge's
// left bank directly, so sags are kept under the edge to their left, as the sweep found it, and
// `inside` is not needed. A spill follows the bank down to the next local minimum alone; if that
// is no bottom that waits, the lowest waiting one is next, wherever it is. Both make the whole
// linear. Water may rise along x, where a polygon has far fewer minima that way (link_rings.h), unless
// a trace is wanted. Isolated vertices are bridged as a sag and a top in one. PAPERS.md has the symbols.
#pragma once
#include <cstdint>
#include <vector>

#include "base/work.h"
#include "polygon/polygon.h"
#include "polygon/sweep.h"
#include "polygon/triangulate.h"

namespace sf {

/// The transitions of the automaton; sec. 4. `Start` begins with a bottom that waits.
enum class FloodAction : uint32_t { Start, Raise, Fill, Bridge, Spill, Jump };

class Flood {
 public:
  /// Appends the triangles of the loops to `triangles`, as nodes, counter-clockwise; all are strictly
  /// positive.
  ///   loops, seen  as PlaneSweep::run leaves them; they are read only
  ///   trace        if not null, gets the actions, with nodes for vertices
  ///   twins        if not null, is set to what findTwins (triangle_mesh.h) finds of the triangles
  ///                appended, as if there were no others
  /// False, after a forbidden state, only for loops that no sweep has passed; or once `work` is to
  /// end. O(m) time and memory; the memory is kept, and charged during the call.
  bool run(const LinkedPolygon& loops, const Visibility& seen, Work& work,
           std::vector<uint32_t>& triangles, std::vector<FloodStep>* trace,
           std::vector<uint32_t>* twins = nullptr);

 private:
  /// A corner of what is not flooded yet. 40 bytes, read together.
  struct Node {
    Point2 at;
    uint32_t next, prev;
    uint32_t node;  // of `loops`, which copies share
    uint32_t sag;  // the lowest sag that waits under the edge that rises from here on the left bank
    uint32_t jump;  // of a top that one side has reached: the other end of that side's chain; of a
                    // sag that waits: the next one under the same edge
    VertexKind kind;
  };
  /// The ends of an active chain, and the highest vertex of it.
  struct Chain {
    uint32_t left, right, highest;
  };

  bool begin(const LinkedPolygon& loops, const Visibility& seen, Work& work);
  bool floodGorges(Work& work);
  bool start();
  enum class Step { On, Done, Forbidden };
  Step step();
  bool raiseLeft(uint32_t v);
  bool raiseRight(uint32_t v);
  void wedgeAhead(uint32_t v, uint32_t c, uint32_t end);
  void wedgeBehind(uint32_t v, uint32_t c, uint32_t end);
  void fill(uint32_t ceiling);
  bool bridge(uint32_t sag);
  void bridgeIsland(uint32_t sag);
  void spill(uint32_t top, bool left);
  uint32_t copyOf(uint32_t v);
  uint32_t newBridge();
  void link(uint32_t from, uint32_t to) { nodes_[from].next = to, nodes_[to].prev = from; }
  void emit(const Node& a, const Node& b, const Node& c) {
    out_[0] = a.node, out_[1] = b.node, out_[2] = c.node;
    out_ += 3;
  }
  void pair(uint32_t h, uint32_t below);
  /// The first half-edge of the next triangle.
  uint32_t nextHalf() const { return uint32_t(out_ - outBegin_); }
  void note(FloodAction action);

  std::vector<Node> nodes_;
  std::vector<uint32_t> bottoms_;
  std::vector<Chain> pending_;
  size_t used_ = 0, nextBottom_ = 0, spilled_ = 0;
  uint32_t spilledTo_ = kNone;
  Chain chain_{};
  uint32_t *out_ = nullptr, *outBegin_ = nullptr;
  std::vector<FloodStep>* trace_ = nullptr;

  // For twins, if they are wanted.
  uint32_t* twins_ = nullptr;
  // For each node what lies below the link to the next one: the half-edge of a triangle, kNone at the
  // loops, or kBridge + i for a bridge, of which bridges_[i] is the half-edge on the side that was
  // flooded first.
  static constexpr uint32_t kBridge = 1u << 31;
  std::vector<uint32_t> below_, bridges_;
};

}  // namespace sf
