// A triangulated box whose vertices come and go, with edges that are kept: a planar straight-line
// graph.
//
// It covers all of the box, whatever its fixed edges enclose. So walking to a point or along an
// edge through triangles finds whatever is in the way. All triangles are of positive area; those
// that a change makes are tested exactly.
//
// Source: Kumar, sec. 5: point location by walking across triangles, deletion of the triangles that
// a new feature meets, triangulation of the hole that arises.
// Differs: holes are filled by cutting ears, which takes them as they come, with edges that dangle
// in them; their triangles are then made Delaunay by flips. Walks start at the place of the edit,
// so no list of strips per grid row is needed to find one.
#pragma once
#include <cstdint>
#include <vector>

#include "polygon/strips/strips.h"
#include "triangles/locate.h"
#include "triangles/triangle_mesh.h"

namespace sf {

class ConstrainedMesh {
 public:
  /// Vertices 0 to 3 are the corners of the box.
  static constexpr uint32_t kCorners = 4;

  /// What keeps a point or an edge from being inserted: a vertex at the same place or on the edge,
  /// or the fixed edge from vertex `edge` to the next of its ring.
  struct Obstacle {
    uint32_t vertex = kNone;
    uint32_t edge = kNone;
  };

  /// Makes an empty box with corners at (-side, -side) and (side, side), and room for `size`
  /// points. Coordinates times 2^-exponent are of about unit size.
  void reset(double side, int exponent, size_t size);
  /// Places vertex v, which is not in the triangles.
  void setPosition(uint32_t v, Point2 p);

  /// Inserts the vertices into an empty box, fixes the edges v - ringNext[v] of those that have
  /// one, and makes the triangles constrained Delaunay. False if `obstacle` is in the way of vertex
  /// `refused` or of its edge; or, with no obstacle, when the work ended. Near-linear but for
  /// unnatural inputs.
  ///   vertices  reordered
  bool insertAll(std::vector<uint32_t>& vertices, ArrayView<const uint32_t> ringNext, Work& work,
                 uint32_t& refused, Obstacle& obstacle);
  /// Takes over triangles of an empty box, which must lie on both sides of all edges
  /// v - ringNext[v]. Fixes these edges, and makes the triangles constrained Delaunay. False if the
  /// triangles do not fit together or are not of positive area, if more than a few flips a triangle
  /// are needed, or when the work ended; the box has to be emptied then. O(m) time.
  ///   corners  [3m]
  bool adopt(const std::vector<uint32_t>& corners, ArrayView<const uint32_t> ringNext, Work& work);
  /// Makes v a vertex of the triangles, walking to it from vertex `near`.
  bool insertPoint(uint32_t v, uint32_t near, Obstacle& obstacle);
  /// Removes v, none of whose edges may be fixed, from the triangles.
  void removePoint(uint32_t v);
  /// Makes a-b an edge of the triangles. It is fixed once a and b are neighbours by next and prev.
  bool insertEdge(uint32_t a, uint32_t b, Obstacle& obstacle);
  /// Moves v to p if all triangles around it keep positive area. They do not count as changed.
  bool shiftPoint(uint32_t v, Point2 p);
  /// Makes edges Delaunay by at most `budget` flips: the edges around the point inserted or shifted
  /// last, and those that flips put in question. Fixed edges stay. Returns how many flips are left.
  uint32_t legalize(uint32_t budget);
  /// The same for the edges of all changed triangles.
  void legalizeChanged(uint32_t budget);

  bool contains(uint32_t v) const { return mesh.edgeFrom[v] != kNone; }
  /// Whether the edge of half-edge h is fixed.
  bool isFixed(uint32_t h) const {
    const uint32_t a = mesh.from(h), b = mesh.to(h);
    return next[a] == b || prev[a] == b;
  }
  /// The half-edge after h around the vertex where both start, counter-clockwise.
  uint32_t around(uint32_t h) const { return mesh.twins[prevInTriangle(h)]; }

  /// Begins a new list of changed triangles.
  void forgetChanges();
  /// Notes that triangle t is about to change, and cuts its strips.
  void touch(uint32_t t);
  bool isChanged(uint32_t t) const { return stamps_[t] == stamp_; }

  TriangleMesh mesh;
  std::vector<Point2> at;
  std::vector<uint32_t> next, prev;  // along fixed edges; kNone for vertices on none
  StripLinks links;
  std::vector<uint32_t> changed;  // triangles, some of them perhaps no longer in use

 private:
  void flip(uint32_t h);
  void replace(const std::vector<uint32_t>& old, const std::vector<uint32_t>& corners);
  void fill(std::vector<uint32_t>& ring, std::vector<uint32_t>& corners) const;
  bool isEar(const std::vector<uint32_t>& ring, size_t i) const;
  uint32_t leaveTowards(uint32_t a, uint32_t b, Obstacle& obstacle) const;
  uint32_t fixedFrom(uint32_t h) const {
    return next[mesh.from(h)] == mesh.to(h) ? mesh.from(h) : mesh.to(h);
  }
  bool isConvex(uint32_t h) const;

  std::vector<Point2> metric_;
  int exponent_ = 0;
  std::vector<uint32_t> stamps_;
  uint32_t stamp_ = 1;
  Locator locator_;
  std::vector<uint32_t> pending_, old_, left_, right_, corners_;
  struct Side {
    uint32_t a, b, half;
  };
  std::vector<Side> sides_;
};

}  // namespace sf
