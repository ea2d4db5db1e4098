#include "surface/trimmed_surfaces.h"

#include <algorithm>
#include <cmath>

namespace sf {
namespace {

/// The sampling at which loops are checked when a model is opened, in its diagonal.
constexpr double kCheckTolerance = 1e-3;

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

void TrimmedSurfaces::selectEdge(uint32_t edge, const Fineness& fineness) {
  std::vector<EdgeSample>& of = samples_.of[edge];
  of.clear();
  trees_[edge]->select(fineness, longest_[edge], of);
  // Bit by bit the same for all edges that end there.
  of.front().at = vertexAt_[model_.edges[edge].fromVertex];
  of.back().at = vertexAt_[model_.edges[edge].toVertex];
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
  return false;
}

void TrimmedSurfaces::leaveOut(uint32_t face, const ModelFault& fault) {
  model_.faces[face].isLeftOut = true;
  meshes_[face] = {};
  faults_.push_back(fault);
}

std::unique_ptr<TrimmedSurfaces> TrimmedSurfaces::open(Model&& model, Work& work, Charge& charge,
                                                       std::vector<ModelFault>& faults) {
  (void)charge;
  std::unique_ptr<TrimmedSurfaces> opened(new TrimmedSurfaces(std::move(model)));
  TrimmedSurfaces& s = *opened;
  const Model& m = s.model_;
  const size_t edges = m.edges.size(), faces = m.faces.size();
  s.trees_.resize(edges), s.samples_.of.resize(edges);
  s.longest_.assign(edges, Sampling::kNoLimit);
  s.vertexAt_.resize(m.vertices);
  s.densities_.resize(faces), s.lines_.resize(faces), s.meshes_.resize(faces);
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
    s.trees_[e] = std::make_unique<EdgeTree>(
        m, e,
        ArrayView<const uint32_t>(s.usesOf_.data() + s.firstUses_[e],
                                  s.firstUses_[e + 1] - s.firstUses_[e]));
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
  FaceMesher mesher(m, work);
  std::vector<uint32_t> open;
  for (uint32_t f = uint32_t(faces); f-- > 0;)
    if (!m.faces[f].isLeftOut) open.push_back(f);
  std::vector<uint32_t> touched;
  while (!open.empty() && work.going()) {
    const uint32_t f = open.back();
    const FaceProblem problem = mesher.check(f, s.samples_);
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

void TrimmedSurfaces::chooseLines(uint32_t face, const Fineness& fineness, double& tolerance) {
  const Density& density = densities_[face];
  const Vec3 center = 0.5 * (density.least + density.greatest);
  tolerance = fineness.tolerance(center, 0.55 * distance(density.least, density.greatest));
  densities_[face].choose(tolerance, fineness, lines_[face]);
}

bool TrimmedSurfaces::meshAll(const Sampling& sampling, Work& work) {
  const Fineness fineness(sampling);
  const uint32_t faces = uint32_t(model_.faces.size()), edges = uint32_t(model_.edges.size());
  std::vector<double> tolerances(faces, 0);
  std::fill(longest_.begin(), longest_.end(), Sampling::kNoLimit);
  for (uint32_t f = 0; f < faces; ++f) {
    if (model_.faces[f].isLeftOut) continue;
    chooseLines(f, fineness, tolerances[f]);
    if (sampling.aspect == Sampling::kNoLimit) continue;
    const double longest = densities_[f].longest(lines_[f]);
    for (uint32_t l = model_.faces[f].firstLoop; l < model_.faces[f].endLoop; ++l)
      for (uint32_t u = model_.loops[l].firstUse; u < model_.loops[l].endUse; ++u) {
        double& of = longest_[model_.uses[u].edge];
        of = std::min(of, longest);
      }
  }
  for (uint32_t e = 0; e < edges; ++e)
    if (trees_[e]) selectEdge(e, fineness);
  numberPlaces();
  FaceMesher mesher(model_, work);
  std::vector<uint32_t> open;
  std::vector<uint8_t> isOpen(faces, 0);
  for (uint32_t f = faces; f-- > 0;)
    if (!model_.faces[f].isLeftOut) open.push_back(f), isOpen[f] = 1;
  const double total = double(open.size());
  size_t done = 0;
  std::vector<uint32_t> touched;
  while (!open.empty()) {
    const uint32_t f = open.back();
    const FaceProblem problem =
        mesher.run(f, samples_, densities_[f], lines_[f], tolerances[f], meshes_[f]);
    if (problem.kind == FaceProblem::Kind::Ended) return false;
    if (problem.kind == FaceProblem::Kind::None) {
      open.pop_back(), isOpen[f] = 0;
      work.setFraction(double(++done) / total);
      if (!work.tick(1000)) return false;
      continue;
    }
    ModelFault fault{};
    touched.clear();
    if (settle(f, problem, true, touched, fault)) {
      for (const uint32_t e : touched) {
        selectEdge(e, fineness);
        // The other faces of the edge have to follow.
        for (uint32_t i = firstUses_[e]; i < firstUses_[e + 1]; ++i) {
          const uint32_t other = model_.uses[usesOf_[i]].face;
          if (isOpen[other] || model_.faces[other].isLeftOut) continue;
          isOpen[other] = 1;
          open.insert(open.begin(), other);
        }
      }
      // Places are renumbered, so faces that are done refer to old ones: they are found by edge when all is put together.
      numberPlaces();
    } else {
      leaveOut(f, fault);
      open.pop_back(), isOpen[f] = 0;
    }
  }
  return true;
}

void TrimmedSurfaces::assemble(Tessellation& result) const {
  const uint32_t faces = uint32_t(model_.faces.size());
  size_t vertices = 0, corners = 0, indices = 0;
  for (const FaceMesh& mesh : meshes_)
    vertices += mesh.positions.size(), corners += mesh.triangles.size(),
        indices += mesh.strips.size();
  result.positions.resize(3 * vertices), result.normals.resize(3 * vertices);
  result.uvs.resize(2 * vertices), result.same.resize(vertices);
  result.triangles.resize(corners), result.strips.resize(indices);
  result.faceStarts.assign(1, 0), result.stripStarts.assign(1, 0);
  result.origin = 0.5 * (model_.least + model_.greatest);
  std::vector<uint32_t> firstAt(samples_.places, kNone), bases(faces);
  uint32_t base = 0;
  size_t corner = 0, index = 0;
  for (uint32_t f = 0; f < faces; ++f) {
    const FaceMesh& mesh = meshes_[f];
    bases[f] = base;
    for (uint32_t v = 0; v < mesh.positions.size(); ++v) {
      const Vec3 p = mesh.positions[v] - result.origin, n = mesh.normals[v];
      const size_t at = size_t(base) + v;
      result.positions[3 * at] = float(p.x), result.positions[3 * at + 1] = float(p.y);
      result.positions[3 * at + 2] = float(p.z);
      result.normals[3 * at] = float(n.x), result.normals[3 * at + 1] = float(n.y);
      result.normals[3 * at + 2] = float(n.z);
      result.uvs[2 * at] = float(mesh.uvs[v].x), result.uvs[2 * at + 1] = float(mesh.uvs[v].y);
      result.same[at] = uint32_t(at);
    }
    // Vertices on edges: the first one of the same sample.
    for (size_t k = 0; k + 1 < mesh.useStarts.size(); ++k) {
      const ModelUse& use = model_.uses[model_.loops[model_.faces[f].firstLoop].firstUse + k];
      const ModelEdge& edge = model_.edges[use.edge];
      const uint32_t count = mesh.useStarts[k + 1] - mesh.useStarts[k];
      for (uint32_t i = 0; i < count; ++i) {
        const uint32_t s = use.isReversed ? count - 1 - i : i;
        const uint32_t place = s == 0           ? edge.fromVertex
                               : s + 1 == count ? edge.toVertex
                                                : samples_.firstPlace[use.edge] + s - 1;
        const uint32_t v = base + mesh.useVertices[mesh.useStarts[k] + i];
        if (firstAt[place] == kNone) firstAt[place] = v;
        result.same[v] = firstAt[place];
      }
    }
    for (const uint32_t v : mesh.triangles) result.triangles[corner++] = base + v;
    for (const uint32_t v : mesh.strips) result.strips[index++] = base + v;
    result.faceStarts.push_back(uint32_t(corner / 3));
    const uint32_t firstStrip = result.stripStarts.back();
    for (size_t s = 1; s < mesh.stripStarts.size(); ++s)
      result.stripStarts.push_back(firstStrip + mesh.stripStarts[s]);
    result.deviation = std::max(result.deviation, mesh.deviation);
    base += uint32_t(mesh.positions.size());
  }
  // Edges: along the first use that is there.
  result.edgeStarts.assign(1, 0);
  for (uint32_t e = 0; e < model_.edges.size(); ++e) {
    for (uint32_t i = firstUses_[e]; i < firstUses_[e + 1] && !model_.edges[e].isDegenerate; ++i) {
      const ModelUse& use = model_.uses[usesOf_[i]];
      if (model_.faces[use.face].isLeftOut) continue;
      const FaceMesh& mesh = meshes_[use.face];
      const uint32_t first = model_.loops[model_.faces[use.face].firstLoop].firstUse;
      const uint32_t k = usesOf_[i] - first;
      for (uint32_t v = mesh.useStarts[k]; v < mesh.useStarts[k + 1]; ++v)
        result.edges.push_back(bases[use.face] + mesh.useVertices[v]);
      break;
    }
    result.edgeStarts.push_back(uint32_t(result.edges.size()));
  }
}

bool TrimmedSurfaces::tessellate(const Sampling& given, const TessellationLimits& limits,
                                 Work& work, Tessellation& result) {
  Sampling sampling = given;
  if (limits.maxSeconds < Sampling::kNoLimit) work.limitStage(limits.maxSeconds, limits.clock);
  bool isDone = meshAll(sampling, work);
  const auto triangles = [&] {
    size_t corners = 0;
    for (const FaceMesh& mesh : meshes_) corners += mesh.triangles.size();
    return double(corners) / 3;
  };
  // Few enough triangles: errors fall with the square of lengths, so about with their number.
  double factor = 1;
  for (int k = 0; isDone && triangles() > limits.maxTriangles && k < 40; ++k) {
    factor *= std::max(1.15, triangles() / limits.maxTriangles);
    sampling.tolerance = given.tolerance * factor, sampling.pixels = given.pixels * factor;
    sampling.angle = given.angle * factor, sampling.aspect = given.aspect * std::sqrt(factor);
    isDone = meshAll(sampling, work);
  }
  const bool isOver = work.endStage();
  if (!isDone && !isOver) return false;
  result = {};
  result.tolerance = sampling.tolerance;
  assemble(result);
  for (const ModelFault& fault : faults_)
    result.reports.push_back({SurfaceReport::LeftOut, fault.face, uint32_t(fault.fault), 0});
  uint32_t forced = 0;
  for (const auto& tree : trees_) forced += tree ? tree->forced() : 0;
  if (forced > 0)
    result.reports.push_back({SurfaceReport::CrossingSamples, kNone, kNone, double(forced)});
  if (factor > 1)
    result.reports.push_back({SurfaceReport::ToleranceRaised, kNone, kNone, sampling.tolerance});
  for (uint32_t f = 0; f < meshes_.size() && !sampling.camera; ++f)
    if (meshes_[f].deviation > sampling.tolerance)
      result.reports.push_back({SurfaceReport::AboveTolerance, f, kNone, meshes_[f].deviation});
  if (isOver) result.reports.push_back({SurfaceReport::TimeOver, kNone, kNone, 0});
  return true;
}

}  // namespace sf
