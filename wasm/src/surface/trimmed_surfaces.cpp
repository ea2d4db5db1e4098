#include "surface/trimmed_surfaces.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/sort.h"

namespace sf {
namespace {

/// The sampling at which loops are checked when a model is opened, in its diagonal.
constexpr double kCheckTolerance = 1e-3;
/// What is known of a face's lines, and of an edge's intervals, about.
constexpr uint64_t kColumnBytes = 4096, kTreeBytes = 1024;

/// What the mesh of a face takes, with its part of the layout.
double bytesOf(const FaceMesh& mesh) {
  return 112.0 * double(mesh.positions.size()) + 24.0 * double(mesh.triangles.size());
}

Box2 boxOf(const Model& model, uint32_t face, const EdgeSamples& samples) {
  const BezierSpans &u = model.faces[face].surface->u(), &v = model.faces[face].surface->v();
  const Box2 domain{u.breaks()[0], u.breaks()[u.count()], v.breaks()[0], v.breaks()[v.count()]};
  Box2 box{domain.u1, domain.u0, domain.v1, domain.v0};
  for (uint32_t l = model.faces[face].firstLoop; l < model.faces[face].endLoop; ++l) {
    if (!model.loops[l].isOuter) continue;
    for (uint32_t use = model.loops[l].firstUse; use < model.loops[l].endUse; ++use)
      for (const EdgeSample& s : samples.of[model.uses[use].edge]) {
        const Point2 p = model.uses[use].curve.at(s.t);
        box.u0 = std::min(box.u0, p.x), box.u1 = std::max(box.u1, p.x);
        box.v0 = std::min(box.v0, p.y), box.v1 = std::max(box.v1, p.y);
      }
  }
  // Between samples the curve may bulge a little; and where the box is nearly the domain, it is the domain.
  const double du = 0.05 * (box.u1 - box.u0), dv = 0.05 * (box.v1 - box.v0);
  box.u0 = std::max(domain.u0, box.u0 - du), box.u1 = std::min(domain.u1, box.u1 + du);
  box.v0 = std::max(domain.v0, box.v0 - dv), box.v1 = std::min(domain.v1, box.v1 + dv);
  if (!(box.u0 < box.u1)) box.u0 = domain.u0, box.u1 = domain.u1;
  if (!(box.v0 < box.v1)) box.v0 = domain.v0, box.v1 = domain.v1;
  return box;
}

}  // namespace

void TrimmedSurfaces::numberPlaces() {
  uint32_t next = model_.vertices;
  samples_.firstPlace.resize(model_.edges.size());
  for (size_t e = 0; e < model_.edges.size(); ++e) {
    samples_.firstPlace[e] = next;
    if (samples_.of[e].size() > 2) next += uint32_t(samples_.of[e].size()) - 2;
  }
  samples_.places = next;
}

/// Chooses the samples of an edge. Whether they are others than before.
bool TrimmedSurfaces::selectEdge(uint32_t edge, const Fineness& fineness) {
  if (trees_[edge]->isSettled(fineness, longest_[edge])) return false;
  std::vector<EdgeSample>& of = samples_.of[edge];
  std::vector<EdgeSample>& before = samplesBefore_;
  before.clear();
  before.swap(of);
  trees_[edge]->select(fineness, longest_[edge], of);
  // Bit by bit the same for all edges that end there.
  of.front().at = vertexAt_[model_.edges[edge].fromVertex];
  of.back().at = vertexAt_[model_.edges[edge].toVertex];
  return !std::equal(
      of.begin(), of.end(), before.begin(), before.end(),
      [](const EdgeSample& a, const EdgeSample& b) { return a.t == b.t && a.at == b.at; });
}

/// Halves the intervals at fault. False if that cannot help: the face is to be left out.
///   mayFreeze  a crossing of a curve with itself that is too narrow to be seen at coarser samplings is stepped over
bool TrimmedSurfaces::settle(uint32_t face, const FaceProblem& problem, bool mayFreeze,
                             std::vector<uint32_t>& touched, ModelFault& fault) {
  bool isHalved = false;
  const auto halve = [&](uint32_t use, uint32_t sample) {
    const uint32_t edge = model_.uses[use].edge;
    const std::vector<EdgeSample>& of = samples_.of[edge];
    if (sample + 1 >= of.size() || !trees_[edge]->force(of[sample].node)) return;
    isHalved = true;
    touched.push_back(edge);
  };
  const uint32_t firstLoop = model_.faces[face].firstLoop;
  if (problem.use != kNone) halve(problem.use, problem.sample);
  if (problem.otherUse != kNone) halve(problem.otherUse, problem.otherSample);
  const bool isWhole = problem.use == kNone || problem.fault == SurfaceFault::Degenerate;
  if (isWhole && problem.loop != kNone && problem.fault == SurfaceFault::Degenerate) {
    // Too few samples for a loop, or a spike: all of it gets more, unless it has many already.
    const ModelLoop& loop = model_.loops[firstLoop + problem.loop];
    size_t count = 0;
    for (uint32_t u = loop.firstUse; u < loop.endUse; ++u)
      count += samples_.of[model_.uses[u].edge].size() - 1;
    if (count < 64 * size_t(loop.endUse - loop.firstUse))
      for (uint32_t u = loop.firstUse; u < loop.endUse; ++u)
        for (uint32_t s = 0; s + 1 < samples_.of[model_.uses[u].edge].size(); ++s) halve(u, s);
    else if (problem.use == kNone)
      isHalved = false;
  }
  if (isHalved) return true;
  const auto overshoots = [&] {
    const uint32_t edge = model_.uses[problem.use].edge;
    const std::vector<EdgeSample>& of = samples_.of[edge];
    return edge == model_.uses[problem.otherUse].edge &&
           trees_[edge]->overshoots(of[problem.sample].node, of[problem.otherSample].node);
  };
  if (problem.use != kNone && problem.otherUse != kNone &&
      problem.fault != SurfaceFault::Degenerate && (mayFreeze || overshoots())) {
    bool isFrozen = false;
    const auto freeze = [&](uint32_t use, uint32_t sample) {
      const uint32_t edge = model_.uses[use].edge;
      const std::vector<EdgeSample>& of = samples_.of[edge];
      if (sample + 1 >= of.size() || !trees_[edge]->freeze(of[sample].node)) return;
      isFrozen = true;
      touched.push_back(edge);
    };
    freeze(problem.use, problem.sample);
    freeze(problem.otherUse, problem.otherSample);
    if (isFrozen) return true;
  }
  fault.fault = problem.fault, fault.face = face;
  fault.loop = problem.loop, fault.otherLoop = problem.otherLoop;
  if (fault.otherLoop == fault.loop) fault.otherLoop = kNone;
  if (problem.fault == SurfaceFault::TrimSelfIntersects && problem.use != kNone)
    fault.use = problem.use - model_.loops[firstLoop + problem.loop].firstUse;
  if (problem.fault == SurfaceFault::TrimsCross && fault.otherLoop < fault.loop)
    std::swap(fault.loop, fault.otherLoop);
  if (problem.fault == SurfaceFault::HoleOutside) fault.otherLoop = kNone;
  // A loop that was not given is not named: what crosses it leaves the domain.
  if (fault.otherLoop != kNone && model_.loops[firstLoop + fault.otherLoop].isDomain)
    fault.fault = SurfaceFault::TrimOutside, fault.otherLoop = kNone;
  return false;
}

/// Halves the intervals of edges that their surface is off. False if none can be halved.
bool TrimmedSurfaces::raiseOff(const FaceProblem& problem, const Fineness& fineness,
                               std::vector<uint32_t>& touched) {
  for (const FaceProblem::Interval& at : problem.off) {
    const uint32_t edge = model_.uses[at.use].edge;
    if (trees_[edge]->raise(samples_.of[edge][at.sample].node, fineness)) touched.push_back(edge);
  }
  return !touched.empty();
}

void TrimmedSurfaces::leaveOut(uint32_t face, const ModelFault& fault) {
  model_.faces[face].isLeftOut = true;
  meshes_[face] = {};
  faults_.push_back(fault);
}

void TrimmedSurfaces::plantTree(uint32_t edge) {
  const uint32_t first = firstUses_[edge], end = firstUses_[edge + 1];
  trees_[edge] = std::make_unique<EdgeTree>(
      model_, edge, ArrayView<const uint32_t>(usesOf_.data() + first, end - first));
}

std::unique_ptr<TrimmedSurfaces> TrimmedSurfaces::open(Model&& model, Work& work, Charge& charge,
                                                       std::vector<ModelFault>& faults) {
  constexpr uint64_t kPerFace = sizeof(FaceMesh) + sizeof(Density) + 2 * sizeof(Density::Lines) +
                                2 * sizeof(Allowance) + kColumnBytes,
                     kPerEdge = sizeof(EdgeTree) + kTreeBytes;
  if (!charge.add(kPerFace * model.faces.size() + kPerEdge * model.edges.size())) return nullptr;
  std::unique_ptr<TrimmedSurfaces> opened(new TrimmedSurfaces(std::move(model)));
  TrimmedSurfaces& s = *opened;
  const Model& m = s.model_;
  const size_t edges = m.edges.size(), faces = m.faces.size();
  s.trees_.resize(edges), s.samples_.of.resize(edges);
  s.longest_.assign(edges, Sampling::kNoLimit);
  s.vertexAt_.resize(m.vertices);
  s.densities_.resize(faces), s.lines_.resize(faces), s.meshes_.resize(faces);
  s.chosen_.resize(faces), s.chosenFor_.resize(faces), s.allowances_.resize(faces);
  s.isChanged_.assign(faces, 0), s.isEdited_.assign(faces, 0);
  for (const ModelFace& face : m.faces) s.isReversed_.push_back(face.isReversed);
  s.mesher_ = std::make_unique<FaceMesher>(m);
  // The uses of each edge, in faces that are there.
  s.firstUses_.assign(edges + 1, 0);
  const auto counts = [&](const ModelUse& use) { return !m.faces[use.face].isLeftOut; };
  for (const ModelUse& use : m.uses)
    if (counts(use)) ++s.firstUses_[use.edge + 1];
  for (size_t e = 0; e < edges; ++e) s.firstUses_[e + 1] += s.firstUses_[e];
  s.usesOf_.resize(s.firstUses_[edges]);
  std::vector<uint32_t> next(s.firstUses_.begin(), s.firstUses_.end() - 1);
  for (uint32_t u = 0; u < m.uses.size(); ++u)
    if (counts(m.uses[u])) s.usesOf_[next[m.uses[u].edge]++] = u;
  std::vector<uint8_t> isPlaced(m.vertices, 0);
  for (uint32_t e = 0; e < edges; ++e) {
    if (s.firstUses_[e] == s.firstUses_[e + 1]) continue;
    s.plantTree(e);
    const ModelEdge& edge = m.edges[e];
    for (const uint32_t v : {edge.fromVertex, edge.toVertex}) {
      if (isPlaced[v]) continue;
      isPlaced[v] = 1;
      s.vertexAt_[v] = s.trees_[e]->end(v == edge.fromVertex ? 0 : 1);
    }
  }
  // Loops, at one sampling for all.
  Sampling sampling;
  sampling.tolerance = kCheckTolerance * m.diagonal();
  const Fineness fineness(sampling);
  for (uint32_t e = 0; e < edges; ++e)
    if (s.trees_[e]) s.selectEdge(e, fineness);
  s.numberPlaces();
  std::vector<uint32_t> open;
  for (uint32_t f = uint32_t(faces); f-- > 0;)
    if (!m.faces[f].isLeftOut) open.push_back(f);
  std::vector<uint32_t> touched;
  while (!open.empty() && work.going()) {
    const uint32_t f = open.back();
    const FaceProblem problem = s.mesher_->check(f, s.samples_, work);
    if (problem.kind == FaceProblem::Kind::Ended) return nullptr;
    if (problem.kind == FaceProblem::Kind::None) {
      open.pop_back();
      continue;
    }
    ModelFault fault{};
    touched.clear();
    if (s.settle(f, problem, false, touched, fault)) {
      for (const uint32_t e : touched) s.selectEdge(e, fineness);
      s.numberPlaces();
    } else {
      if (!m.faces[f].isSuspect) {
        s.leaveOut(f, fault);
        faults.push_back(fault);
      } else if (fault.fault == SurfaceFault::TrimsCross) {
        for (ModelFault& known : faults)
          if (known.face == f) known = fault;
      }
      open.pop_back();
    }
  }
  if (!work.going()) return nullptr;
  for (ModelFace& face : s.model_.faces) face.isLeftOut |= face.isSuspect;
  for (uint32_t f = 0; f < faces; ++f)
    if (!m.faces[f].isLeftOut)
      s.densities_[f] = Density(*m.faces[f].surface, boxOf(m, f, s.samples_));
  std::stable_sort(faults.begin(), faults.end(),
                   [](const ModelFault& a, const ModelFault& b) { return a.face < b.face; });
  s.faults_ = faults;
  return opened;
}

/// Chooses the lines of all faces and the samples of all edges, and marks the faces that change.
bool TrimmedSurfaces::chooseAll(const Sampling& sampling, const Fineness& fineness, bool updates,
                                Work& work) {
  const uint32_t faces = uint32_t(model_.faces.size()), edges = uint32_t(model_.edges.size());
  std::fill(longest_.begin(), longest_.end(), Sampling::kNoLimit);
  const auto sameNodes = [](const LineTree::Choice& a, const LineTree::Choice& b) {
    return a.nodes == b.nodes;
  };
  for (uint32_t f = 0; f < faces; ++f) {
    isChanged_[f] = !updates;
    if (model_.faces[f].isLeftOut) {
      isChanged_[f] = 0;
      continue;
    }
    Density& density = densities_[f];
    Allowance allowance = density.allowanceOf(*model_.faces[f].surface, fineness);
    // While a camera moves, lines are chosen for a little less than is allowed, and stay for as long as they are then not
    // much too many.
    const bool isLazy = updates && sampling.camera != nullptr;
    const double factor = sampling.hysteresis * sampling.hysteresis;
    const bool stays = isLazy && chosenFor_[f].isWithin(allowance, factor) &&
                       meshes_[f].excess <= 1 && !isEdited_[f];
    if (!stays) {
      const Allowance target = isLazy ? allowance.times(sampling.hysteresis) : allowance;
      Density::Lines lines;
      density.choose(target, fineness, lines);
      const bool isSame =
          updates && sameNodes(lines.u, chosen_[f].u) && sameNodes(lines.v, chosen_[f].v);
      if (!isSame) {
        chosen_[f] = lines, lines_[f] = lines;
        isChanged_[f] = 1;
      } else if (meshes_[f].deviation > allowance.least() || isEdited_[f]) {
        isChanged_[f] = 1;
      }
      chosenFor_[f] = target, allowances_[f] = std::move(allowance);
      if (!work.tick(100 * (chosen_[f].u.nodes.size() + chosen_[f].v.nodes.size()))) return false;
    }
    if (sampling.aspect == Sampling::kNoLimit) continue;
    const double longest = density.longest(chosen_[f]);
    for (uint32_t l = model_.faces[f].firstLoop; l < model_.faces[f].endLoop; ++l)
      for (uint32_t u = model_.loops[l].firstUse; u < model_.loops[l].endUse; ++u) {
        double& of = longest_[model_.uses[u].edge];
        of = std::min(of, longest);
      }
  }
  for (uint32_t e = 0; e < edges; ++e) {
    if (!trees_[e] || !selectEdge(e, fineness)) continue;
    for (uint32_t i = firstUses_[e]; i < firstUses_[e + 1]; ++i) {
      const uint32_t f = model_.uses[usesOf_[i]].face;
      isChanged_[f] = !model_.faces[f].isLeftOut;
    }
    if (!work.tick(100 * samples_.of[e].size())) return false;
  }
  numberPlaces();
  return true;
}

/// Meshes the faces that change.
bool TrimmedSurfaces::meshFaces(const Sampling& sampling, bool updates, Work& work) {
  const Fineness fineness(sampling);
  double bytes = 0;
  for (const FaceMesh& mesh : meshes_) bytes += bytesOf(mesh);
  if (!chooseAll(sampling, fineness, updates, work)) return false;
  const uint32_t faces = uint32_t(model_.faces.size());
  std::vector<uint32_t> open;
  std::vector<uint8_t> isOpen(isChanged_);
  for (uint32_t f = faces; f-- > 0;)
    if (isChanged_[f]) open.push_back(f);
  const double total = double(open.size());
  size_t done = 0;
  std::vector<uint32_t> touched;
  bool acceptsEdges = false;
  while (!open.empty()) {
    const uint32_t f = open.back();
    bytes -= bytesOf(meshes_[f]);
    const FaceProblem problem = mesher_->run(f, samples_, densities_[f], lines_[f], allowances_[f],
                                             updates, acceptsEdges, work, meshes_[f]);
    acceptsEdges = false;
    bytes += bytesOf(meshes_[f]);
    if (!work.fits(bytes)) work.fail(Status::OutOfMemory);
    if (problem.kind == FaceProblem::Kind::Ended || !work.going()) return false;
    if (problem.kind == FaceProblem::Kind::None) {
      open.pop_back(), isOpen[f] = 0, isEdited_[f] = 0;
      work.setFraction(double(++done) / total);
      if (!work.tick(1000)) return false;
      continue;
    }
    ModelFault fault{};
    touched.clear();
    const bool isOff = problem.kind == FaceProblem::Kind::EdgeOff;
    if (isOff ? raiseOff(problem, fineness, touched) : settle(f, problem, true, touched, fault)) {
      for (const uint32_t e : touched) {
        selectEdge(e, fineness);
        // The other faces of the edge have to follow.
        for (uint32_t i = firstUses_[e]; i < firstUses_[e + 1]; ++i) {
          const uint32_t other = model_.uses[usesOf_[i]].face;
          if (isOpen[other] || model_.faces[other].isLeftOut) continue;
          isOpen[other] = isChanged_[other] = 1;
          open.insert(open.begin(), other);
        }
      }
      numberPlaces();
    } else if (isOff) {
      acceptsEdges = true;
    } else {
      leaveOut(f, fault);
      open.pop_back(), isOpen[f] = 0;
    }
  }
  return true;
}

/// Finds the first vertex at the place of each anew, for faces that have changed and those beside them, and the vertices along
/// edges.
void TrimmedSurfaces::findSame(const std::vector<uint32_t>& faces, Tessellation& result) {
  const std::vector<uint32_t>& bases = layout_.vertexStarts;
  const auto placeOf = [&](const ModelUse& use, uint32_t u) {
    return u - model_.loops[model_.faces[use.face].firstLoop].firstUse;
  };
  // Not so of faces left out, and when time was over before a face could follow its edges.
  const auto isMeshed = [&](uint32_t u) {
    const ModelUse& use = model_.uses[u];
    const std::vector<uint32_t>& starts = meshes_[use.face].useStarts;
    const uint32_t k = placeOf(use, u);
    return k + 1 < starts.size() && starts[k + 1] - starts[k] == samples_.of[use.edge].size();
  };
  // The vertex of a use at a sample of its edge.
  const auto vertexOf = [&](uint32_t u, uint32_t sample) {
    const ModelUse& use = model_.uses[u];
    const FaceMesh& mesh = meshes_[use.face];
    const uint32_t k = placeOf(use, u);
    const uint32_t place =
        use.isReversed ? mesh.useStarts[k + 1] - 1 - sample : mesh.useStarts[k] + sample;
    return bases[use.face] + mesh.useVertices[place];
  };
  const auto eachUse = [&](uint32_t edge, auto&& look) {
    for (uint32_t i = firstUses_[edge]; i < firstUses_[edge + 1]; ++i)
      if (isMeshed(usesOf_[i])) look(usesOf_[i]);
  };
  const uint32_t before = uint32_t(same_.size());
  same_.resize(layout_.vertices());
  for (uint32_t v = before; v < same_.size(); ++v) same_[v] = v;
  std::vector<uint8_t> isDone(model_.edges.size(), 0);
  for (const uint32_t f : faces)
    for (uint32_t v = 0; v < meshes_[f].positions.size(); ++v) same_[bases[f] + v] = bases[f] + v;
  for (const uint32_t f : faces)
    for (const uint32_t e : edgesOf(f)) {
      // Faces left out may name edges that there are none of.
      if (e >= isDone.size() || isDone[e] || samples_.of[e].size() < 3) continue;
      isDone[e] = 1;
      for (uint32_t s = 1; s + 1 < samples_.of[e].size(); ++s) {
        uint32_t first = kNone;
        eachUse(e, [&](uint32_t u) { first = std::min(first, vertexOf(u, s)); });
        eachUse(e, [&](uint32_t u) { same_[vertexOf(u, s)] = first; });
      }
    }
  // At the ends of edges all faces meet.
  std::vector<uint32_t> firstAt(model_.vertices, kNone);
  const auto eachEnd = [&](auto&& look) {
    for (uint32_t e = 0; e < model_.edges.size(); ++e)
      eachUse(e, [&](uint32_t u) {
        look(model_.edges[e].fromVertex, vertexOf(u, 0));
        look(model_.edges[e].toVertex, vertexOf(u, uint32_t(samples_.of[e].size()) - 1));
      });
  };
  eachEnd([&](uint32_t place, uint32_t v) { firstAt[place] = std::min(firstAt[place], v); });
  eachEnd([&](uint32_t place, uint32_t v) { same_[v] = firstAt[place]; });
  result.same = same_;
  // Edges: along the first use that is there.
  result.edges.clear(), result.edgeStarts.assign(1, 0);
  for (uint32_t e = 0; e < model_.edges.size(); ++e) {
    uint32_t first = kNone;
    if (!model_.edges[e].isDegenerate) eachUse(e, [&](uint32_t u) { first = std::min(first, u); });
    for (uint32_t s = 0; first != kNone && s < samples_.of[e].size(); ++s)
      result.edges.push_back(vertexOf(first, s));
    result.edgeStarts.push_back(uint32_t(result.edges.size()));
  }
}

/// Meshes with a tolerance that is raised until there are few enough triangles.
///   factor  out: by how much
bool TrimmedSurfaces::fewEnough(const Sampling& given, const TessellationLimits& limits,
                                bool updates, Work& work, Sampling& used, double& factor) {
  used = given, factor = 1;
  const auto triangles = [&] {
    size_t corners = 0;
    for (const FaceMesh& mesh : meshes_) corners += mesh.triangles.size();
    return double(corners) / 3;
  };
  bool isDone = meshFaces(used, updates, work);
  // Longer cells before a coarser tolerance.
  for (int k = 0; isDone && triangles() > limits.maxTriangles && used.aspect < Sampling::kNoLimit;
       ++k) {
    used.aspect = k < 2 ? 4 * used.aspect : Sampling::kNoLimit;
    isDone = meshFaces(used, false, work);
  }
  // Errors fall with the square of lengths, so about with the number of triangles.
  for (int k = 0; isDone && triangles() > limits.maxTriangles && k < 40; ++k) {
    // Then all is as coarse as it can be.
    if (given.tolerance * factor > distance(model_.least, model_.greatest) &&
        (!given.camera || given.pixels * factor > given.camera->width + given.camera->height))
      break;
    factor *= std::max(1.15, triangles() / std::max(limits.maxTriangles, 1.0));
    used.tolerance = given.tolerance * factor, used.pixels = given.pixels * factor;
    used.angle = given.angle * factor;
    isDone = meshFaces(used, false, work);
  }
  return isDone;
}

void TrimmedSurfaces::tell(const Sampling& sampling, double factor, bool isOver,
                           Tessellation& result) {
  result.origin = 0.5 * (model_.least + model_.greatest);
  result.tolerance = sampling.tolerance;
  for (const FaceMesh& mesh : meshes_)
    result.deviation = std::max(result.deviation, mesh.deviation);
  for (const ModelFault& fault : faults_)
    result.reports.push_back({SurfaceReport::LeftOut, fault.face, uint32_t(fault.fault), 0});
  uint32_t forced = 0;
  for (const auto& tree : trees_) forced += tree ? tree->forced() : 0;
  if (forced > 0)
    result.reports.push_back({SurfaceReport::CrossingSamples, kNone, kNone, double(forced)});
  if (factor > 1)
    result.reports.push_back({SurfaceReport::ToleranceRaised, kNone, kNone, sampling.tolerance});
  for (uint32_t f = 0; f < meshes_.size(); ++f)
    if (meshes_[f].excess > 1)
      result.reports.push_back({SurfaceReport::AboveTolerance, f, kNone, meshes_[f].deviation});
  if (isOver) result.reports.push_back({SurfaceReport::TimeOver, kNone, kNone, 0});
}

bool TrimmedSurfaces::tessellate(const Sampling& given, const TessellationLimits& limits,
                                 Work& work, Tessellation& result) {
  if (limits.maxSeconds < Sampling::kNoLimit) work.limitStage(limits.maxSeconds, limits.clock);
  Sampling used;
  double factor;
  isMeshed_ = false;
  for (FaceMesh& mesh : meshes_) mesh.clear();
  const bool isDone = fewEnough(given, limits, false, work, used, factor);
  const bool isOver = work.endStage();
  if (!isDone && !isOver) return false;
  result = {};
  isMeshed_ = isDone;
  layout_.layOut(meshes_, isReversed_, 0.5 * (model_.least + model_.greatest));
  for (uint32_t f = 0; f < meshes_.size(); ++f) result.faces.push_back(f);
  same_.clear();
  findSame(result.faces, result);
  tell(used, factor, isOver, result);
  return true;
}

bool TrimmedSurfaces::update(const Sampling& given, const TessellationLimits& limits, Work& work,
                             Tessellation& result) {
  if (!isMeshed_) return tessellate(given, limits, work, result);
  if (limits.maxSeconds < Sampling::kNoLimit) work.limitStage(limits.maxSeconds, limits.clock);
  Sampling used;
  double factor;
  isMeshed_ = false;
  const bool isDone = fewEnough(given, limits, true, work, used, factor);
  const bool isOver = work.endStage();
  if (!isDone && !isOver) return false;
  result = {};
  isMeshed_ = isDone;
  for (uint32_t f = 0; f < meshes_.size(); ++f)
    if (isChanged_[f]) result.faces.push_back(f);
  if (layout_.rewrite(meshes_, isReversed_, result.faces)) {
    findSame(result.faces, result);
  } else {
    std::vector<uint32_t> all(meshes_.size());
    std::iota(all.begin(), all.end(), 0);
    same_.clear();
    findSame(all, result);
  }
  tell(used, factor, isOver, result);
  return true;
}

std::vector<uint32_t> TrimmedSurfaces::edgesOf(uint32_t face) const {
  std::vector<uint32_t> edges;
  for (uint32_t l = model_.faces[face].firstLoop; l < model_.faces[face].endLoop; ++l)
    for (uint32_t u = model_.loops[l].firstUse; u < model_.loops[l].endUse; ++u)
      edges.push_back(model_.uses[u].edge);
  sf::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// Whether no other face has an edge, nor its ends.
bool TrimmedSurfaces::isAlone(uint32_t edge, uint32_t face) const {
  for (uint32_t i = firstUses_[edge]; i < firstUses_[edge + 1]; ++i)
    if (model_.uses[usesOf_[i]].face != face) return false;
  return true;
}

/// Begins edges of a face anew, where its surface and its curves have them now.
void TrimmedSurfaces::replant(uint32_t face, ArrayView<const uint32_t> edges) {
  for (const uint32_t e : edges) {
    plantTree(e);
    for (uint32_t i = firstUses_[e]; i < firstUses_[e + 1]; ++i) mesher_->forget(usesOf_[i]);
    for (const int end : {0, 1})
      vertexAt_[end == 0 ? model_.edges[e].fromVertex : model_.edges[e].toVertex] =
          trees_[e]->end(end);
    samples_.of[e].clear();
  }
  // Edges that end at a vertex that has moved.
  for (const auto& tree : trees_)
    if (tree) tree->unsettle();
  densities_[face] = Density(*model_.faces[face].surface, boxOf(model_, face, samples_));
}

/// Whether the loops of a face are still right, at the sampling of the first check.
bool TrimmedSurfaces::checkAgain(uint32_t face, Work& work, ModelFault& fault) {
  Sampling sampling;
  sampling.tolerance = kCheckTolerance * model_.diagonal();
  const Fineness fineness(sampling);
  const std::vector<uint32_t> edges = edgesOf(face);
  std::vector<std::vector<EdgeSample>> before;
  for (const uint32_t e : edges) before.push_back(samples_.of[e]), selectEdge(e, fineness);
  numberPlaces();
  std::vector<uint32_t> touched;
  bool isRight = false;
  for (;;) {
    const FaceProblem problem = mesher_->check(face, samples_, work);
    isRight = problem.kind == FaceProblem::Kind::None;
    if (problem.kind != FaceProblem::Kind::Crossing) break;
    touched.clear();
    if (!settle(face, problem, false, touched, fault)) break;
    for (const uint32_t e : touched) selectEdge(e, fineness);
    numberPlaces();
  }
  // With the samples of the check the box around the face is known.
  if (isRight)
    densities_[face] = Density(*model_.faces[face].surface, boxOf(model_, face, samples_));
  for (size_t i = 0; i < edges.size(); ++i)
    samples_.of[edges[i]].swap(before[i]), trees_[edges[i]]->unsettle();
  numberPlaces();
  return isRight;
}

bool TrimmedSurfaces::movePole(uint32_t face, uint32_t pole, Vec3 to, double weight, Work& work,
                               ModelFault& fault) {
  ModelFace& f = model_.faces[face];
  fault = {SurfaceFault::BadEdge, face, kNone, kNone, kNone, kNone};
  const std::vector<uint32_t> edges = edgesOf(face);
  for (const uint32_t e : edges)
    if (!isAlone(e, face)) return fault.edge = e, false;
  SplineArrays other = f.arrays;
  double* at = &other.poles[3 * size_t(pole)];
  at[0] = to.x, at[1] = to.y, at[2] = to.z;
  if (weight > 0) {
    if (other.weights.empty()) other.weights.assign(other.poles.size() / 3, 1);
    other.weights[pole] = weight;
  }
  SurfaceFault bad;
  if (findFault(other.surface(), bad)) return fault.fault = bad, false;
  // Loops lie in the domain, so they stay right. Edges lie where the surface has them now.
  std::vector<std::unique_ptr<NurbsCurve>> curves(edges.size());
  const auto exchange = [&] {
    std::swap(f.arrays, other);
    f.surface = std::make_unique<NurbsSurface>(f.arrays.surface());
    for (size_t i = 0; i < edges.size(); ++i) std::swap(model_.edges[edges[i]].curve, curves[i]);
  };
  exchange();
  // Seams must not open, and poles stay points.
  const auto tears = [&](uint32_t edge) {
    return std::any_of(usesOf_.begin() + firstUses_[edge], usesOf_.begin() + firstUses_[edge + 1],
                       [&](uint32_t use) { return !runsWithEdge(model_, use, work); });
  };
  const auto torn = std::find_if(edges.begin(), edges.end(), tears);
  if (torn != edges.end()) {
    exchange();
    return fault.edge = *torn, false;
  }
  replant(face, edges);
  if (!checkAgain(face, work, fault)) {
    exchange();
    replant(face, edges);
    return false;
  }
  meshes_[face] = {};
  isEdited_[face] = 1;
  return true;
}

bool TrimmedSurfaces::moveTrim(uint32_t face, uint32_t loop, uint32_t use, uint32_t pole, Point2 to,
                               Work& work, ModelFault& fault) {
  const uint32_t number = model_.loops[model_.faces[face].firstLoop + loop].firstUse + use;
  fault = {SurfaceFault::BadEdge, face, loop, use, kNone, model_.uses[number].edge};
  // Poles that have to move: this one, and at an end of the curve that of the neighbour that meets it there.
  struct Move {
    uint32_t use, pole;
  };
  std::vector<Move> moves = {{number, pole}};
  const auto poleAt = [&](uint32_t u, uint32_t k) {
    const std::vector<double>& poles = model_.uses[u].arrays.poles;
    return Point2{poles[2 * size_t(k)], poles[2 * size_t(k) + 1]};
  };
  const auto lastOf = [&](uint32_t u) {
    return uint32_t(model_.uses[u].arrays.poles.size() / 2) - 1;
  };
  for (const bool isLast : {false, true}) {
    if (pole != (isLast ? lastOf(number) : 0)) continue;
    const bool isAtEnd = isLast != model_.uses[number].isReversed;
    const uint32_t other = isAtEnd ? model_.after(number) : model_.before(number);
    if (model_.uses[other].arrays.poles.empty()) return false;
    // The neighbour's pole that lies there: its first one, or its last.
    const uint32_t k = isAtEnd != model_.uses[other].isReversed ? 0 : lastOf(other);
    if (other == number && k == pole) continue;
    const Point2 a = poleAt(number, pole), b = poleAt(other, k);
    const BezierSpans& u = model_.faces[face].surface->u();
    const double size = u.breaks()[u.count()] - u.breaks()[0];
    if (std::hypot(a.x - b.x, a.y - b.y) < 1e-6 * size) moves.push_back({other, k});
  }
  std::vector<uint32_t> edges;
  for (const Move& move : moves) {
    const uint32_t e = model_.uses[move.use].edge;
    // The face must be alone with the edge, and the edge be used once.
    if (model_.uses[move.use].arrays.poles.empty() || firstUses_[e + 1] - firstUses_[e] != 1)
      return fault.edge = e, false;
    if (std::find(edges.begin(), edges.end(), e) == edges.end()) edges.push_back(e);
  }
  const auto set = [&](const Move& move, Point2 p) {
    ModelUse& u = model_.uses[move.use];
    u.arrays.poles[2 * size_t(move.pole)] = p.x, u.arrays.poles[2 * size_t(move.pole) + 1] = p.y;
    u.curve = TrimCurve(u.arrays.curve());
  };
  std::vector<Point2> before;
  for (const Move& move : moves) before.push_back(poleAt(move.use, move.pole)), set(move, to);
  bool isRight = true;
  for (const Move& move : moves)
    if (!staysInDomain(model_, move.use)) fault.fault = SurfaceFault::TrimOutside, isRight = false;
  std::vector<std::unique_ptr<NurbsCurve>> curves;
  for (const uint32_t e : edges) curves.push_back(std::move(model_.edges[e].curve));
  replant(face, edges);
  if (isRight) isRight = checkAgain(face, work, fault);
  if (!isRight) {
    for (size_t i = 0; i < moves.size(); ++i) set(moves[i], before[i]);
    for (size_t i = 0; i < edges.size(); ++i) model_.edges[edges[i]].curve = std::move(curves[i]);
    replant(face, edges);
  }
  isEdited_[face] = 1;
  return isRight;
}

}  // namespace sf
