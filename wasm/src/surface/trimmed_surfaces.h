// A model that is tessellated again and again: what is known of it between calls.
//
// Source: Kumar.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "surface/density.h"
#include "surface/edge_tree.h"
#include "surface/face_mesh.h"
#include "surface/mesh_layout.h"
#include "surface/model.h"
#include "surface/sampling.h"

namespace sf {

enum class SurfaceReport : uint32_t {
#define SF_SURFACE_REPORT(name, value, meaning) name = (value),
  SF_SURFACE_REPORT_CHOICES(SF_SURFACE_REPORT)
#undef SF_SURFACE_REPORT
};

struct Report {
  SurfaceReport report;
  uint32_t face = kNone;
  uint32_t fault = kNone;
  double value = 0;
};

/// What is told of a mesh besides its layout.
struct Tessellation {
  std::vector<uint32_t> edges, edgeStarts, same;
  std::vector<uint32_t> faces;  // those that the call has changed
  std::vector<Report> reports;
  Vec3 origin{};
  double deviation = 0, tolerance = 0;
};

struct TessellationLimits {
  double maxTriangles = Sampling::kNoLimit, maxSeconds = Sampling::kNoLimit;
  Clock clock = nullptr;
};

class TrimmedSurfaces {
 public:
  /// Takes over a model that has been read. Finds where loops cross or lie wrongly: their faces are left out.
  ///   faults  those of reading; others are added, in the order of faces
  static std::unique_ptr<TrimmedSurfaces> open(Model&& model, Work& work, Charge& charge,
                                               std::vector<ModelFault>& faults);

  /// Tessellates from scratch; the mesh is then in layout(). False once the work has ended, but not by the limit of time.
  bool tessellate(const Sampling& sampling, const TessellationLimits& limits, Work& work,
                  Tessellation& result);
  /// Makes the mesh one of another sampling, from what there is. Vertices that stay keep their numbers, unless their face
  /// outgrows its block or all is laid out again; the ranges of layout() tell.
  bool update(const Sampling& sampling, const TessellationLimits& limits, Work& work,
              Tessellation& result);
  const MeshLayout& layout() const { return layout_; }

  /// Moves a pole of a face's surface, or of the trimming curve of a use; the next update follows. Edges of the face, or that
  /// edge, must be of this face alone: from then on they lie where the surface has them. Seams cannot be opened, nor edges that
  /// are points.
  ///   weight   positive, or 0: stays
  ///   fault    out: why it is refused; the model is then as before
  bool movePole(uint32_t face, uint32_t pole, Vec3 to, double weight, Work& work,
                ModelFault& fault);
  bool moveTrim(uint32_t face, uint32_t loop, uint32_t use, uint32_t pole, Point2 to, Work& work,
                ModelFault& fault);

  const Model& model() const { return model_; }

 private:
  explicit TrimmedSurfaces(Model&& model) : model_(std::move(model)) {}
  bool selectEdge(uint32_t edge, const Fineness& fineness);
  bool settle(uint32_t face, const FaceProblem& problem, bool mayFreeze,
              std::vector<uint32_t>& touched, ModelFault& fault);
  bool raiseOff(const FaceProblem& problem, const Fineness& fineness,
                std::vector<uint32_t>& touched);
  void leaveOut(uint32_t face, const ModelFault& fault);
  bool meshFaces(const Sampling& sampling, bool updates, Work& work);
  bool chooseAll(const Sampling& sampling, const Fineness& fineness, bool updates, Work& work);
  bool fewEnough(const Sampling& given, const TessellationLimits& limits, bool updates, Work& work,
                 Sampling& used, double& factor);
  void tell(const Sampling& sampling, double factor, bool isOver, Tessellation& result);
  void findSame(const std::vector<uint32_t>& faces, Tessellation& result);
  void numberPlaces();
  void plantTree(uint32_t edge);
  void replant(uint32_t face, ArrayView<const uint32_t> edges);
  bool checkAgain(uint32_t face, Work& work, ModelFault& fault);
  std::vector<uint32_t> edgesOf(uint32_t face) const;
  bool isAlone(uint32_t edge, uint32_t face) const;

  Model model_;
  std::vector<std::unique_ptr<EdgeTree>> trees_;  // [edges] null where no face uses it
  std::vector<double> longest_;                   // [edges]
  std::vector<Vec3> vertexAt_;
  EdgeSamples samples_;
  std::vector<EdgeSample> samplesBefore_;
  std::vector<Density> densities_;
  // Of each face: the lines it has; those that were chosen before any were added where it was measured to be off; what they
  // were chosen for, and what is allowed now.
  std::vector<Density::Lines> lines_, chosen_;
  std::vector<Allowance> chosenFor_, allowances_;
  std::vector<FaceMesh> meshes_;
  std::vector<uint8_t> isReversed_, isChanged_;  // [faces]
  std::unique_ptr<FaceMesher> mesher_;
  MeshLayout layout_;
  std::vector<uint32_t> same_;  // [vertices of the layout]
  bool isMeshed_ = false;
  std::vector<uint8_t> isEdited_;             // [faces] since they were meshed
  std::vector<ModelFault> faults_;            // of faces left out
  std::vector<uint32_t> firstUses_, usesOf_;  // uses by edges
};

}  // namespace sf
