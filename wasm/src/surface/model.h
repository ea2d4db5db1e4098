// Trimmed surfaces with shared edges, as they come: read from two flat arrays, checked, and ready to be sampled.
//
// Source: Kumar, sec. 2: a face is the part of a surface's domain that its trimming curves leave.
// Differs: faces of a model share edges, each with a curve of space and one in the domain of every face; what lies outside of
// its own rules is refused by name.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "base/array_view.h"
#include "base/charge.h"
#include "base/point2.h"
#include "base/status.h"
#include "base/vec.h"
#include "base/work.h"
#include "surface/nurbs_curve.h"
#include "surface/nurbs_surface.h"
#include "surface/trim_curve.h"

namespace sf {

/// What is wrong with a face. The values cross the C ABI, whose table says what each means.
enum class SurfaceFault : uint32_t {
#define SF_SURFACE_FAULT(name, value, meaning) name = (value),
  SF_SURFACE_FAULT_CHOICES(SF_SURFACE_FAULT)
#undef SF_SURFACE_FAULT
};

/// A fault and its place; kNone where a number does not apply.
struct ModelFault {
  SurfaceFault fault;
  uint32_t face = kNone, loop = kNone, use = kNone;  // loop counted in its face, use in its loop
  uint32_t otherLoop = kNone, edge = kNone;
};

struct ModelEdge {
  double from = 0, to = 1;            // its parameter's range
  double tolerance = 0;               // how far its curves may be apart in space
  bool isDegenerate = false;          // all of it is one point
  std::unique_ptr<NurbsCurve> curve;  // of space, or null: the edge is S(p(t)) of its first use
  uint32_t firstUse = kNone, uses = 0;
  // Vertices of the model at its ends. Ends that meet in a loop are one vertex.
  uint32_t fromVertex = kNone, toVertex = kNone;
};

/// The arrays of a spline that can be edited.
struct SplineArrays {
  uint32_t degreeU = 0, degreeV = 0;  // of a curve: degreeU
  std::vector<double> knotsU, knotsV, poles, weights;

  NurbsSurfaceView surface() const {
    return {{degreeU, knotsU}, {degreeV, knotsV}, poles, weights};
  }
  NurbsCurveView curve() const { return {{degreeU, knotsU}, 2, poles, weights}; }
};

/// An edge in a loop of a face.
struct ModelUse {
  uint32_t edge = kNone, face = kNone, loop = kNone;  // loop counted through all faces
  bool isReversed = false;  // the loop runs from the edge's `to` to its `from`
  bool isSeam = false;
  TrimCurve curve;      // in the domain, by the edge's parameter
  SplineArrays arrays;  // of it; empty if it was found, or made around a domain
};

struct ModelLoop {
  uint32_t face = kNone, firstUse = 0, endUse = 0;
  bool isOuter = false;
  bool isDomain = false;  // not given: around the domain of a face that has no outer loop
};

struct ModelFace {
  std::unique_ptr<NurbsSurface> surface;
  SplineArrays arrays;      // of it
  bool isReversed = false;  // its normal is -(Su x Sv)
  bool isLeftOut = false;   // faulty: it has no part in anything
  bool isSuspect = false;   // its fault is named, and a better one may be found once it is sampled
  uint32_t firstLoop = 0, endLoop = 0;
};

/// The model in flat arrays. All counts are of `shape`, all else is of `numbers`, in this order:
///   shape    faces, edges;
///            for each edge: flags (1 degenerate, 2 with a curve); with a curve: degree, poles, knots, rational (0 or 1)
///            for each face: flags (1 reversed); degree u, poles u, knots u, degree v, poles v, knots v, rational; outer
///              loop + 1, or 0: the domain is what is inside, and all loops are holes; loops;
///              for each loop: uses; for each use: edge, flags (1 reversed, 2 seam, 4 with a curve); with a curve:
///              degree, poles, knots, rational
///   numbers  for each edge: tolerance, from, to; with a curve: knots, poles [3n], weights if rational
///            for each face: knots u, knots v, poles [3n] index iu * count v + iv, weights if rational;
///              for each use with a curve: domain from, to; knots, poles [2n], weights if rational
struct ModelArrays {
  ArrayView<const uint32_t> shape;
  ArrayView<const double> numbers;
};

struct Model {
  std::vector<ModelEdge> edges;
  std::vector<ModelUse> uses;  // loop by loop
  std::vector<ModelLoop> loops;
  std::vector<ModelFace> faces;
  uint32_t vertices = 0;
  Vec3 least{}, greatest{};  // the box of all poles of faces that are not left out
  double slack = 0;          // how far curves may be apart beyond their edge's tolerance
  double diagonal() const { return length(greatest - least); }

  /// A use of a loop after or before another, around the loop.
  uint32_t after(uint32_t use) const {
    const ModelLoop& loop = loops[uses[use].loop];
    return use + 1 == loop.endUse ? loop.firstUse : use + 1;
  }
  uint32_t before(uint32_t use) const {
    const ModelLoop& loop = loops[uses[use].loop];
    return use == loop.firstUse ? loop.endUse - 1 : use - 1;
  }
};

/// Whether something is wrong with the poles and weights of a surface, and what.
bool findFault(const NurbsSurfaceView& surface, SurfaceFault& fault);

/// Whether a use's curve, on its surface, runs with its edge within tolerance: with its curve of space, or if it has none with
/// the edge's first use; if the edge is degenerate, it stays where it begins. True too once the work has ended.
bool runsWithEdge(const Model& model, uint32_t use, Work& work);

/// Whether a use's curve stays in the domain of its face, or leaves it by no more than this share of its size.
bool staysInDomain(const Model& model, uint32_t use, double share = 1e-6);

/// Reads a model. Faces with faults are left out, and named. A face without an outer loop gets one around its domain, after its
/// own. The edges are new ones after those given; they are shared where the surface closes, and degenerate where it has a pole.
/// What is checked here: all that can be said of a curve or a surface alone, of the ends of uses, and of curves against
/// their edge; that curves cross, and loops lie wrongly, shows once they are sampled (faults.h).
///   faults  out: in the order of faces, the first of each face. For an edge that is itself bad, of the first face that uses it
/// False if the arrays do not fit their own counts (nothing is kept then), or the work has ended.
bool readModel(const ModelArrays& arrays, Work& work, Charge& charge, Model& model,
               std::vector<ModelFault>& faults);

}  // namespace sf
