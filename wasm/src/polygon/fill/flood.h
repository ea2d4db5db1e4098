// Flooding: triangles in the order in which water would rise in the gorges of a polygon.
// Source: Ronfard, Rossignac 1994, sec. 3-6.
// Differs: the lowest sag in a gorge is not searched for in a list of all sags. It sees the gorge's
// left bank directly, so sags are kept under the edge to their left, as the sweep found it, and
// `inside` is not needed. A spill follows the bank down to the next local minimum only. If that is
// no waiting bottom, the next gorge is the last one that a bridge has cut off, or else that of the
// lowest waiting bottom, wherever it is. Both make the whole linear. Water may rise along x if a
// polygon has far fewer minima that way (link_rings.h), unless a trace is wanted. Isolated vertices
// are bridged as a sag and a top in one. PAPERS.md has the symbols.
#pragma once
#include <cstdint>
#include <vector>

#include "base/charge.h"
#include "base/work.h"
#include "polygon/input/options.h"
#include "polygon/input/polygon.h"
#include "polygon/sweep/sweep.h"
#include "triangles/triangle_mesh.h"

namespace sf {

class Flood {
 public:
  Flood() = default;
  Flood(const Flood&) = delete;
  Flood& operator=(const Flood&) = delete;

  /// Triangulates the loops.
  ///   loops, seen  as PlaneSweep::run leaves them; they are only read
  ///   kept         charged with the triangles and twins while these are in use
  ///   trace        if not null, gets the actions, with nodes for vertices
  ///   paired       whether twins are needed too
  /// False once `work` is to end; or after a forbidden state, which happens only with loops that no
  /// sweep has accepted. O(m) time and memory. The memory is kept for the next run; what `kept`
  /// does not cover is charged during the call.
  bool run(const LinkedPolygon& loops, const Visibility& seen, Work& work, Charge& kept,
           std::vector<FloodStep>* trace = nullptr, bool paired = false);

  /// [3t] The triangles of the last run, as nodes, counter-clockwise, strictly positive; the caller
  /// may change them. Each was made for its first corner v, over an edge cd of the active chain:
  /// - the triangle on the other side of cd, if there is one, comes earlier in the list;
  /// - of its other two neighbours, those that come earlier were made for the same v, or lie across
  ///   a bridge;
  /// - where it shares an edge vd with a triangle v d e made for the same v, the angle cde is at
  ///   least pi on the side of v, since no vertex of an active chain sees past its neighbours.
  ArrayView<uint32_t> triangles() { return {corners_.data(), size_t(out_ - corners_.data())}; }
  /// Swaps the triangles into `to`; the next run uses the memory that `to` had.
  void handOver(Buffer<uint32_t>& to) {
    corners_.resize(nextHalf());
    corners_.swap(to);
    out_ = corners_.data();
  }
  /// Their twins, if the run was `paired`; bridges are closed edges.
  ClosableTwins& twins() { return twins_; }

 private:
  /// A corner of the part not flooded yet. One record, since all of it is read together.
  struct Node {
    Point2 at;
    Node *next, *prev;
    uint32_t node;   // of `loops`, which copies share
    uint32_t below;  // the far side of the link to the next node, below it
    Node* sag;   // the lowest sag that waits under the edge that rises from here on the left bank
    Node* jump;  // of a top that one side has reached: the other end of that side's chain; of a
                 // sag that waits: the next one under the same edge
    VertexKind kind;
  };
  /// The ends of an active chain, and the highest vertex of it.
  struct Chain {
    Node *left, *right, *highest;
  };

  bool begin(const LinkedPolygon& loops, const Visibility& seen, Work& work);
  bool floodGorges(Work& work);
  bool start();
  enum class Step { On, Done, Forbidden };
  Step step();
  bool raiseLeft(Node* v);
  bool raiseRight(Node* v);
  void wedgeAhead(Node* v, Node* c, Node* end);
  void wedgeBehind(Node* v, Node* c, Node* end);
  void fill(Node* ceiling);
  bool bridge(Node* sag);
  void bridgeIsland(Node* sag);
  void spill(Node* top, bool left);
  Node* copyOf(const Node& v);
  static void link(Node* from, Node* to) { from->next = to, to->prev = from; }
  void emit(const Node* a, const Node* b, const Node* c) {
    out_[0] = a->node, out_[1] = b->node, out_[2] = c->node;
    out_ += 3;
  }
  /// The first half-edge of the next triangle.
  uint32_t nextHalf() const { return uint32_t(out_ - corners_.data()); }
  void note(FloodAction action) {
    if (trace_) append(action);
  }
  void append(FloodAction action);

  Buffer<Node> nodes_;
  std::vector<Node*> bottoms_;
  std::vector<Chain> pending_;
  Node* unused_ = nullptr;
  size_t nextBottom_ = 0, spilled_ = 0;
  Node* spilledTo_ = nullptr;
  Chain chain_{};
  Buffer<uint32_t> corners_;
  uint32_t* out_ = nullptr;
  std::vector<FloodStep>* trace_ = nullptr;
  ClosableTwins twins_;
  bool paired_ = false;
  double error_ = 0;  // of turns
};

}  // namespace sf
