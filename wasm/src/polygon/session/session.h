// A polygon whose vertices are inserted, deleted and moved. Its triangles and strips are kept up to
// date by changes around the edit alone.
//
// The session triangulates a box around the polygon, outside and holes included, with the rings'
// edges fixed in it. That is the certificate (polygon/fill/certificate.h: the polygon and its
// complement), and it is local: all triangles are of positive area and every ring edge is one of
// theirs, so edges meet in common vertices alone. An edit changes triangles around the old and the
// new place of one vertex and tests those. Which of them lie inside follows from the triangles next
// to them: a ring edge separates inside and outside, no other edge does. If that is contradictory,
// as when a hole would be left outside, everything is checked again, and the edit is refused or, if
// valid after all, accepted.
//
// Source: Kumar, sec. 5.
// Differs:
// - Vertices can be moved as well, and the outside is triangulated too. That makes edits safe: an
//   edge that crosses another meets it on the way, wherever that is.
// - Strips are cut where triangles change, and the remaining pieces are joined again at their ends
//   (otherwise "strips tend to become fragmented after a while"). No complete re-triangulation is
//   needed.
#pragma once
#include <cstdint>
#include <vector>

#include "base/status.h"
#include "base/work.h"
#include "polygon/input/polygon.h"
#include "polygon/session/constrained_mesh.h"

namespace sf {

class PolygonSession {
 public:
  /// Begins with a polygon. Vertices are numbered as in the input, islands after them; a repeated
  /// first vertex at a ring's end has a number but is no vertex.
  /// Stricter than PlaneSweep::run, since all triangles are to be of positive area: rings may not
  /// touch. Errors: BadStarts, NotFinite, DegeneratePolygon, RepeatedVertex (two vertices of one
  /// position), SelfIntersecting, HolesOverlap, HoleOutside, NestedHole, OutOfMemory, Stopped;
  /// `loop` and `vertex` as there. The session is empty after an error.
  /// O(n log n) time for all but unnatural inputs, about 300 bytes a vertex.
  Outcome start(const PolygonView& polygon, Work& work);

  // Edits. On errors the polygon is as before. In their outcomes `vertex` is the edited vertex (or
  // the one after which a vertex was to be inserted). `otherVertex` is the culprit: a vertex that
  // the place or a new edge meets, or the first vertex of an edge that they meet. Both are in the
  // session's numbers, with their rings. Statuses are those of start, and BadOption for a vertex
  // that does not exist. Cost: the triangles that the edit meets. Edits that turn a ring inside out
  // or leave the box around the polygon cost as much as start.

  /// Inserts a vertex at p between ring vertex `before` and the next one; v becomes its number.
  Outcome insertVertex(uint32_t before, Point2 p, Work& work, uint32_t& v);
  /// Inserts an isolated vertex strictly inside.
  Outcome insertIsland(Point2 p, Work& work, uint32_t& v);
  /// Deletes an island, or a vertex of a ring, whose neighbours are then joined. A ring keeps 3
  /// vertices. The number may be given to a vertex inserted later.
  Outcome deleteVertex(uint32_t v, Work& work);
  Outcome moveVertex(uint32_t v, Point2 p, Work& work);

  /// The vertices' positions, xy by number; the positions of unused numbers mean nothing.
  ArrayView<const double> positions() const;
  /// Whether v is the number of a vertex.
  bool isVertex(uint32_t v) const;
  /// The next vertex of v's ring, with the polygon to the left; kNone for islands.
  uint32_t nextInRing(uint32_t v) const;

  /// [3m] the triangles inside, counter-clockwise. Edits keep their order, except for the triangles
  /// that they change.
  ArrayView<const uint32_t> triangles() const { return triangles_; }
  /// Which triangles the last edit changed or added, by increasing number; those from m on are
  /// gone.
  ArrayView<const uint32_t> changedTriangles() const { return changedSlots_; }
  /// Writes the strips as writeStrips does, in numbers of vertices. O(m) time,
  /// with hardly any tests.
  bool strips(Work& work, std::vector<uint32_t>& vertices, std::vector<uint32_t>& starts) const;

  /// Whether everything said above holds, tested from scratch in O(m) time.
  bool certify() const;

 private:
  static constexpr uint32_t kIsland = kNone - 1;
  static constexpr uint32_t kShift = ConstrainedMesh::kCorners;
  using Obstacle = ConstrainedMesh::Obstacle;

  Outcome readRings(const PolygonView& polygon);
  Outcome build(Work& work);
  bool flood(ArrayView<const uint32_t> ringNext, Work& work);
  bool withinBox(Point2 p) const;
  Outcome rebuildWith(uint32_t v, Point2 p, Work& work);
  void restore();
  void clear();

  void link(uint32_t a, uint32_t b) { mesh_.next[a] = b, mesh_.prev[b] = a; }
  void unlink(uint32_t a, uint32_t b) { mesh_.next[a] = mesh_.prev[b] = kNone; }
  bool place(uint32_t v, Point2 p, uint32_t a, uint32_t b, Obstacle& obstacle);
  void takeOut(uint32_t v);
  uint32_t numberFor(uint32_t ring);
  void giveUp(uint32_t v);
  Outcome refusal(uint32_t edited, const Obstacle& obstacle) const;
  Outcome about(Status status, uint32_t v, uint32_t w) const;
  Outcome admitVertex(uint32_t v, Point2 p, Work& work) const;
  Outcome admit(uint32_t v, Point2 p, Work& work) const;

  bool settleInside(uint32_t& culprit);
  Outcome findInsideAnew();
  void orientRings();
  Outcome finish(uint32_t edited);
  void updateSlots();
  void writeSlot(uint32_t slot);
  void joinStrips();

  ConstrainedMesh mesh_;
  uint32_t near_ = 0;           // a vertex of the triangles near the last edit
  double side_ = 0;             // half the box's
  std::vector<uint32_t> ring_;  // of each vertex; kIsland, or kNone for unused numbers
  std::vector<uint32_t> ringSizes_;
  std::vector<uint32_t> unused_;      // unused numbers of vertices
  std::vector<uint8_t> inside_;       // of each triangle
  std::vector<uint32_t> slots_;       // of each triangle: its number in triangles_, or kNone
  std::vector<uint32_t> triangleIn_;  // the reverse
  std::vector<uint32_t> triangles_, changedSlots_;
  std::vector<uint32_t> stack_, among_;
};

}  // namespace sf
