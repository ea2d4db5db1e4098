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

/// The mesh of a model, in flat arrays.
struct Tessellation {
  std::vector<float> positions, normals, uvs;
  std::vector<uint32_t> triangles, faceStarts, strips, stripStarts, edges, edgeStarts, same;
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

  /// False once the work has ended, but not by the limit of time.
  bool tessellate(const Sampling& sampling, const TessellationLimits& limits, Work& work,
                  Tessellation& result);

  const Model& model() const { return model_; }

 private:
  explicit TrimmedSurfaces(Model&& model) : model_(std::move(model)) {}
  void selectEdge(uint32_t edge, const Fineness& fineness);
  void chooseLines(uint32_t face, const Fineness& fineness, double& tolerance);
  bool settle(uint32_t face, const FaceProblem& problem, bool mayFreeze,
              std::vector<uint32_t>& touched, ModelFault& fault);
  void leaveOut(uint32_t face, const ModelFault& fault);
  bool meshAll(const Sampling& sampling, Work& work);
  void assemble(Tessellation& result) const;
  void numberPlaces();

  Model model_;
  std::vector<std::unique_ptr<EdgeTree>> trees_;  // [edges] null where no face uses it
  std::vector<double> longest_;                   // [edges]
  std::vector<Vec3> vertexAt_;
  EdgeSamples samples_;
  std::vector<Density> densities_;
  std::vector<Density::Lines> lines_;
  std::vector<FaceMesh> meshes_;
  std::vector<ModelFault> faults_;            // of faces left out
  std::vector<uint32_t> firstUses_, usesOf_;  // uses by edges
};

}  // namespace sf
