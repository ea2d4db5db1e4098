// The state of one plane sweep; private to sweep.cpp and touch.cpp.
#pragma once
#include <vector>

#include "base/turn.h"
#include "polygon/sweep/edge_order.h"
#include "polygon/sweep/sweep.h"

namespace sf {

struct SweepState {
  /// A node that the sweep line will pass.
  struct Event {
    Point2 at;
    uint32_t node;
    uint32_t edge;    // the record of a chain (`chains`) that the node is on
    uint32_t near;    // of a local minimum: the record of an edge not far from it, or kNone;
                      // on a bank: the node to which the link up leads
    VertexKind kind;  // by the two edges alone
  };
  /// One of the edges at a point where loops touch: `other` is the node at its other end, `node`
  /// the one at the point. `down`: it leads from the upper to the lower end.
  struct HalfEdge {
    uint32_t node, other;
    Point2 to;
    uint32_t edge;
    uint32_t input;
    bool down;
  };

  /// One of the layers of equal height by which events are sorted: the number of events below it
  /// and in it.
  struct Layer {
    double below, count;
  };

  // Kept from polygon to polygon.
  EdgeOrder edges;
  Buffer<Event> events, unsorted;
  std::vector<Layer> layers;
  Buffer<uint32_t> buckets, places;
  // [m] The record of an edge at each node. The edges of a ring from a local minimum up to a local
  // maximum share one record, 2i or 2i + 1 for minimum i. A node between two such chains has the
  // one along which its ring runs up.
  Buffer<uint32_t> chains;
  std::vector<uint8_t> reversed;
  std::vector<HalfEdge> lower, upper;
  std::vector<uint32_t> strands;

  uint64_t touched = 0;  // sum of what touchAhead read, so that the reads are not dropped

  // Of this polygon.
  const PolygonView* view = nullptr;
  LinkedPolygon* loops = nullptr;
  Visibility* seen = nullptr;
  bool sagsOnly = false;
  double error = 0;       // of turns
  size_t inputNodes = 0;  // those that are vertices of the input
  bool isPlain = true;    // no two vertices at one place so far, and none on an edge
  Outcome outcome;        // the first crossing
  Outcome misplaced;  // the first sign of a hole in the wrong place, which a crossing may explain

  void findSpike();
  bool begin(const PolygonView& polygon, LinkedPolygon& linked, Visibility& visibility, Work& work);
  uint32_t numberChains();
  uint32_t edgeNear(uint32_t v) const;
  uint32_t numberRing(uint32_t first, uint32_t end, bool backwards, uint32_t record);
  Event eventOf(uint32_t v, bool hints) const;
  size_t makeEvents(bool hints);
  void rankEvents(bool hints, double toKey);
  void sortEvents();
  void sortNearby();
  void sweep(Work& work);
  void touchAhead(size_t i, size_t end);
  /// Handles event i, with those after it that are at the same point; returns how many, 0 after a
  /// crossing.
  size_t step(size_t i);
  bool passMonotone(const Event& event, bool down);
  bool passMinimum(const Event& event);
  bool passMaximum(const Event& event);
  bool passIsland(const Event& event);

  // touch.cpp: points with several nodes, or on an edge.
  bool passTouch(size_t i, size_t count);
  bool findBlock(size_t i, size_t count, uint32_t& first, uint32_t& last, uint32_t& left);
  void divide(uint32_t e, uint32_t vertex, Point2 at);
  bool collect(size_t i, size_t count, uint32_t first, uint32_t last, Point2 at);
  bool strandsPart();
  bool alternates(uint32_t left);
  void relink(uint32_t left, uint32_t right);
  void corner(VertexKind kind, const HalfEdge& in, HalfEdge& out, uint32_t left, uint32_t right);
  void replaceBlock(uint32_t left);
  bool reportDisorder(Point2 at);

  /// Where p is: positive to the left of edge e, negative to the right, 0 on it.
  double side(uint32_t e, Point2 p) const { return turn(edges[e].lo, edges[e].hi, p, error); }
  void set(uint32_t e, uint32_t lower, uint32_t upper, uint32_t input, bool down);
  bool isInside(uint32_t left) const { return left != kNone && edges[left].down; }
  uint32_t lowerNode(uint32_t e) const { return e == kNone ? kNone : edges[e].lower; }
  void see(uint32_t v, uint32_t left, uint32_t right);
  uint32_t newNode(uint32_t vertex, Point2 at);

  uint32_t ringOf(uint32_t vertex) const;
  uint32_t inputOf(uint32_t e) const { return e == kNone ? kNone : uint32_t(edges[e].input); }
  uint32_t step(uint32_t v, bool backwards) const;
  uint32_t inputEdge(uint32_t input) const;
  bool crossing(uint32_t inputA, uint32_t inputB);
  void misplace(uint32_t input, uint32_t besideInput);
};

}  // namespace sf
