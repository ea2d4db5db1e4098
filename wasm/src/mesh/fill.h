// Holes filled: each group of rims gets the surface of least cost, refined and faired until it goes on what is around.
//
// Source: Zou, Ju, Carr 2013, sec. 5: every hole with its islands is spanned by Delaunay triangles, with the angles to
// the faces along the rim counted. Liepa 2003: refined and faired afterwards.
// Differs: one rim is spanned among all triangles where that is quick. What would intersect after fairing goes only so
// far that it does not.
#pragma once
#include <cstdint>
#include <vector>

#include "base/work.h"
#include "loops/span.h"
#include "mesh/bvh.h"
#include "mesh/crease.h"
#include "mesh/group.h"
#include "mesh/hole_part.h"
#include "mesh/intersect.h"
#include "mesh/refine.h"

namespace sf {

enum class Fairing : uint8_t { None, Bending, Curvature, Auto };

struct FillOptions {
  double areaWeight = 0, perimeterWeight = 0, dihedralWeight = 1;  // as in SpanOptions
  Space space = Space::Auto;
  Fairing fairing = Fairing::Auto;
  RefineOptions refining;  // new vertices on creases and chords are counted too
  bool inFloats = false;   // whether coordinates of new vertices are rounded to single precision
  double crease = 0.698;   // edges between faces that differ by more, in radians, go on; 0: none do
  double maxSeconds = 1e300;  // by `clock`, which is null if it limits nothing
  Clock clock = nullptr;
};

enum class FillStatus : uint8_t { Filled, SelfIntersecting, Failed };

enum class FillReason : uint8_t {
  None,
  NoSurface,       // the candidates hold none
  RimsIntersect,   // rims cross or touch each other
  RepeatedVertex,  // two vertices of the rims are in one place
  DuplicateFace,  // the patch would have a face or an edge that is there already, and may have no vertices of its own
  TooLarge,          // for the memory that there is
  InsertedVertices,  // only a surface with vertices on the rim was found: see `FilledHole::splits`
  Stitched,     // filled, in part at least by triangles without area between vertices in one place
  OpposedRims,  // a rim runs the other way round than the rest: a part of the mesh is inside out
  TimeLimit,  // it took too long; filled, with the best surface until then, and perhaps not refined
};

/// A vertex to be put on an edge of a rim, at (1 - parameter) `tail` + parameter `head`.
struct RimSplit {
  uint32_t face, tail, head;  // of the input
  double parameter;
};

/// A hole's patch. Vertices from `MeshView`'s count on are its own, numbered on from those of earlier patches.
struct FilledHole {
  FillStatus status = FillStatus::Failed;
  FillReason reason = FillReason::None;
  double cost = 0, lowerBound = 0;
  bool optimal = false;
  double rimAngleBefore = 0, rimAngleAfter = 0;  // mean angle to the faces along the rim, radians
  uint32_t fairnessUsed = 0;                     // k of the fairing, 0: none
  double movedLess = 0;                          // share of fairing that was taken back, 0 to 1
  /// Faces numbered as in the filled mesh. Patches of other holes are not looked at.
  std::vector<FacePair> intersections;
  uint32_t firstFace = 0, endFace = 0;  // in the filled mesh
  /// With InsertedVertices: where the rims have to be split for the hole to be filled. None where the rims have edges
  /// with other faces, which the splits would come apart from, or where there are more than `maxNewVertices`.
  std::vector<RimSplit> splits;
};

/// What filling has to know of a mesh, whichever hole it is.
struct Surroundings {
  std::vector<uint32_t> fanStarts, fans;  // [n+1], [3m] faces at each input vertex that count
  std::vector<uint8_t> isOfTwoRims;       // [n]
  TriangleTree tree;                      // of all faces
};

/// O(m log m) time. Memory is charged to `charge`. False once the work has ended.
bool survey(const MeshView& mesh, const Adjacency& adjacency, const Rims& rims, Work& work,
            Charge& charge, Surroundings& result);

/// Fills the groups of one mesh, one after the other. The mesh and what is known of it must outlive it.
class HoleFiller {
 public:
  HoleFiller(const MeshView& mesh, const Adjacency& adjacency, const Rims& rims,
             const Surroundings& around, Work& work);

  /// Fills a hole that is bounded by some rims. Its vertices and faces are appended.
  /// Errors: OutOfMemory, Stopped; nothing is appended then. What is wrong with the hole is said in `result`.
  Status fill(ArrayView<const uint32_t> rims, const FillOptions& options, FilledHole& result);

  ArrayView<const double> newPositions() const { return newPositions_; }  // [3a]
  ArrayView<const uint32_t> newFaces() const { return newFaces_; }        // [3b]
  /// The same, moved out: the last that is asked for.
  std::vector<double> takePositions() { return std::move(newPositions_); }
  std::vector<uint32_t> takeFaces() { return std::move(newFaces_); }

 private:
  struct Corner;
  struct Hole;
  Status fillWhole(ArrayView<const uint32_t> rims, const FillOptions& options, FilledHole& result);
  Status fillApart(const Hole& hole, ArrayView<const uint32_t> rims, const FillOptions& options,
                   FilledHole& result);
  Status fillPart(Hole& hole, const FillOptions& options, FilledHole& result);
  bool isStitchedWell(uint32_t rim, uint32_t firstFace) const;
  Status fillParts(const HoleParts& parts, const FillOptions& options, FilledHole& result,
                   bool& isDone);
  Status span(Hole& hole, const FillOptions& options, FilledHole& result);
  Vec3 placeToSpan(const Hole& hole, const Corner& corner) const;
  bool areFans(const Hole& hole, uint32_t firstFace) const;
  void appendFace(uint32_t face, std::vector<uint32_t>& triangles) const;
  std::vector<RimSplit> splitsOf(const Hole& hole, const Span& span) const;
  void surround(Hole& hole, double crease);
  void takeRings(Hole& hole, std::vector<uint32_t>& faces);
  void takeSide(Hole& hole, double crease, std::vector<uint32_t>& faces);
  bool append(const Hole& hole);
  bool findPairs(const Hole& hole, std::vector<FacePair>& pairs);
  bool findOwnPairs(uint32_t from, uint32_t to, std::vector<FacePair>& pairs);
  double rimAngle(const Hole& hole, double* largest) const;
  bool isTakenChord(const Hole& hole, uint32_t a, uint32_t b) const;
  uint32_t countTakenChords(const Hole& hole) const;
  void splitChords(Hole& hole, bool inFloats);
  bool isTaken(uint32_t a, uint32_t b) const;
  bool isBorderTaken(const Hole& hole) const;
  /// Whether a face of the mesh has vertices a, b, and c unless that is kNone.
  bool isInFace(uint32_t a, uint32_t b, uint32_t c) const;
  uint32_t faceCount() const { return uint32_t((mesh_.faces.size() + newFaces_.size()) / 3); }
  uint32_t vertexCount() const {
    return uint32_t((mesh_.positions.size() + newPositions_.size()) / 3);
  }
  Vec3 point(uint32_t vertex) const;

  MeshView mesh_;
  const Adjacency& adjacency_;
  const Rims& rims_;
  const Surroundings& around_;
  Work& work_;
  Charge charge_;
  std::vector<uint32_t> local_;  // [n] scratch: number in the hole, or kNone
  std::vector<double> newPositions_;
  std::vector<uint32_t> newFaces_;
};

}  // namespace sf
