#include "surface/face_mesh.h"

#include <algorithm>
#include <cmath>

#include "base/turn.h"
#include "polygon/strips/strips.h"
#include "polygon/sweep/sweep.h"
#include "polygon/triangulate.h"
#include "surface/band_patch.h"
#include "surface/face_strips.h"
#include "surface/trace.h"
#include "triangles/triangle_mesh.h"

namespace sf {
namespace {

/// Corners of one vertex within this share of the domain are one.
constexpr double kSameCorner = 1e-6;
constexpr int kMostRefinings = 12, kMostRounds = 64;
/// A band whose vertices have become so many times as many is left as it is: refining does not seem to help.
constexpr size_t kMostAdded = 16;
/// An edge that crosses a crease nearer to one of its ends than this, as a share of it, ends there.
constexpr double kNearEnd = 1e-3;
/// Shorter intervals of an edge, as a share of it, are not halved because its surface is off.
constexpr double kShortInterval = 1e-8;
/// Memory for a place of the grid, its vertices and triangles, about.
constexpr double kBytesAPlace = 300;
constexpr int kMostFlipRounds = 3;
/// Squares of sines: angles above 25 degrees are good, and one is better than another if it is so by a tenth.
constexpr double kGoodAngle = 0.18, kBetter = 1.2;
/// A band that changes in more places than this is made anew.
constexpr size_t kMostChanges = 64;

Vec3 middle(Vec3 a, Vec3 b) { return 0.5 * (a + b); }
Point2 middle(Point2 a, Point2 b) { return {0.5 * (a.x + b.x), 0.5 * (a.y + b.y)}; }

/// The polygon of a face's loops.
struct Rings {
  std::vector<Point2> at;               // in the scaled domain
  std::vector<Point2> uvs;              // in the domain
  std::vector<uint32_t> starts, loops;  // the loop of each ring
  std::vector<uint32_t> vertex;         // number in the mesh
  std::vector<uint32_t> use,
      sample;  // the use and the sample of its edge where the segment after each begins

  void clear() {
    at.clear(), uvs.clear(), starts.clear(), loops.clear();
    vertex.clear(), use.clear(), sample.clear();
  }
};

}  // namespace

void FaceMesh::clear() {
  positions.clear(), normals.clear(), uvs.clear(), roles.clear(), unused.clear();
  triangles.clear(), strips.clear(), stripStarts.clear(), useVertices.clear(), useStarts.clear();
  us.clear(), vs.clear(), gridStrips.clear(), poles.clear(), band.clear(), bandOff.clear();
  bandTwins.clear(), bandLinks.bits.clear();
  border.clear(), usePlaces.clear(), useTs.clear(), gridVertices.clear();
  deviation = excess = 0;
}

struct FaceMesher::State {
  explicit State(const Model& model) : model(model) {}

  const Model& model;
  Work* work = nullptr;  // of the call
  Trace trace;
  PolygonTriangulator triangulator;
  BandPatch patch;
  PlaneSweep sweep;
  LinkedPolygon linked;
  Visibility seen;
  std::vector<std::vector<Point2>>
      knownUvs;  // [uses][intervals of the edge] where each begins, or NaN
  // [vertices of the model] where each was met last.
  struct Corner {
    uint32_t run;  // of this mesher
    Point2 uv;
    uint32_t vertex;
  };
  std::vector<Corner> corners;
  // Of one loop.
  std::vector<Point2> loopUvs;
  std::vector<double> loopTs;
  std::vector<uint32_t> loopPlaces, loopUses, loopNumbers, loopFirsts, loopVertices;
  std::vector<Vec3> loopAt;
  // For the triangulators.
  std::vector<double> xy, islandXy;
  std::vector<uint32_t> starts, vertices, changed;
  std::vector<uint32_t> bandFound;
  std::vector<double> middleUs, middleVs;
  std::vector<uint32_t> known, opposite;
  std::vector<uint8_t> isNew, isFresh;

  // Of the face at hand.
  uint32_t face = 0;
  const NurbsSurface* surface = nullptr;
  const EdgeSamples* samples = nullptr;
  Rings rings;
  std::vector<uint32_t> ringOf;  // [vertices] the place in the rings, if it is wanted
  Point2 origin{}, scale{1, 1};
  FaceMesh* mesh = nullptr;
  Density* density = nullptr;
  Allowance allowance;
  bool updates = false, acceptsEdges = false;
  std::vector<double> us, vs, localUs, localVs, gridAt, gridNormals, centers, centerNormals;
  std::vector<uint8_t> isNewU, isNewV;  // [cells] whether the interval was none before
  std::vector<FaceMesh::Strip> gridStrips;
  std::vector<uint32_t> gridVertex;
  std::vector<uint8_t> halvedU, halvedV;
  std::vector<uint32_t> oldUseVertices, oldUseStarts, oldUsePlaces, oldBorder, oldGrid;
  std::vector<double> oldUseTs, oldUs, oldVs;
  std::vector<uint32_t> oldLineU, oldLineV;  // [lines] their number before, or kNone
  std::vector<uint8_t> isMet;                // [vertices] on a ring in this run
  uint32_t runs = 0;
  TriangleMesh band;
  std::vector<double> bandOff;
  std::vector<Point2> bandAt;
  // Of a band that was patched: the triangles that stay, as they were, and their strips.
  std::vector<uint32_t> oldCorners;
  StripLinks bandLinks;
  GridQuads quads;
  FaceStrips faceStrips;

  Point2 scaled(Point2 uv) const {
    return {(uv.x - origin.x) * scale.x, (uv.y - origin.y) * scale.y};
  }
  Point2 unscaled(Point2 p) const { return {origin.x + p.x / scale.x, origin.y + p.y / scale.y}; }

  Corner& cornerOf(uint32_t vertex, Point2 uv);
  Point2 placeOf(uint32_t use, const EdgeSample& sample);
  void begin(uint32_t f, const EdgeSamples& all, FaceMesh& out);
  FaceProblem problemOf(const Outcome& outcome) const;
  FaceProblem checkRings();
  bool meshGrid(Density::Lines& lines);
  bool layOut(const Density::Lines& lines);
  void measureCells(const Density::Lines& lines, bool& isRefined);
  void writeQuads();
  uint32_t gridVertexAt(uint32_t name);
  void makeIslands();
  FaceProblem triangulateBand();
  bool patchBand();
  void findChanges(std::vector<Box2>& changed) const;
  FaceProblem refineBand();
  void noteIfOff(uint32_t from, uint32_t to, FaceProblem& problem);
  void improveAngles();
  Point2 splitOf(uint32_t a, uint32_t b, double& share) const;
  double deviationAt(Point2 uv, Vec3 at) const;
  double allowedIn(size_t triangle) const;
  uint32_t addVertex(Point2 uv, Vec3 at, Vec3 normal, FaceMesh::Role role);
  void linkBand();
  void finish();
};

FaceMesher::FaceMesher(const Model& model) : state_(new State(model)) {}
FaceMesher::~FaceMesher() = default;

uint32_t FaceMesher::State::addVertex(Point2 uv, Vec3 at, Vec3 normal, FaceMesh::Role role) {
  uint32_t v;
  if (mesh->unused.empty()) {
    v = uint32_t(mesh->positions.size());
    mesh->uvs.push_back(uv), mesh->positions.push_back(at), mesh->normals.push_back(normal);
    mesh->roles.push_back(role), mesh->poles.push_back(v), isMet.push_back(1);
  } else {
    v = mesh->unused.back();
    mesh->unused.pop_back();
    mesh->uvs[v] = uv, mesh->positions[v] = at, mesh->normals[v] = normal;
    mesh->roles[v] = role, mesh->poles[v] = v, isMet[v] = 1;
  }
  return v;
}

/// A corner of the face: where one of the same vertex was met before in this run, if they are nearly at one place.
FaceMesher::State::Corner& FaceMesher::State::cornerOf(uint32_t vertex, Point2 uv) {
  if (corners.size() < model.vertices) corners.resize(model.vertices, {0, {}, kNone});
  Corner& corner = corners[vertex];
  const BezierSpans &u = surface->u(), &v = surface->v();
  const double nearU = kSameCorner * (u.breaks()[u.count()] - u.breaks()[0]),
               nearV = kSameCorner * (v.breaks()[v.count()] - v.breaks()[0]);
  const bool isSame = corner.run == runs && std::fabs(corner.uv.x - uv.x) <= nearU &&
                      std::fabs(corner.uv.y - uv.y) <= nearV;
  if (!isSame) corner = {runs, uv, kNone};
  return corner;
}

/// The place of a sample in the domain of a use.
Point2 FaceMesher::State::placeOf(uint32_t use, const EdgeSample& sample) {
  if (sample.node == kNone) return model.uses[use].curve.at(sample.t);
  if (knownUvs.size() < model.uses.size()) knownUvs.resize(model.uses.size());
  std::vector<Point2>& known = knownUvs[use];
  if (known.size() <= sample.node) known.resize(sample.node + 1, {std::nan(""), 0});
  // The first half of an interval begins where that does, so the parameter is one with the node.
  Point2& uv = known[sample.node];
  if (std::isnan(uv.x)) uv = model.uses[use].curve.at(sample.t);
  return uv;
}

/// Lays out the rings, and their vertices in the mesh.
void FaceMesher::State::begin(uint32_t f, const EdgeSamples& all, FaceMesh& out) {
  face = f, mesh = &out, samples = &all;
  if (!updates) out.clear();
  surface = model.faces[f].surface.get();
  isMet.assign(out.positions.size(), 0);
  ++runs;
  oldUseVertices.swap(out.useVertices), oldUseStarts.swap(out.useStarts);
  oldUsePlaces.swap(out.usePlaces), oldUseTs.swap(out.useTs);
  oldBorder.swap(out.border), oldGrid.swap(out.gridVertices);
  oldUs = out.us, oldVs = out.vs;
  out.useVertices.clear(), out.useStarts.clear(), out.usePlaces.clear(), out.useTs.clear();
  out.border.clear();
  const uint32_t firstUse = model.loops[model.faces[f].firstLoop].firstUse;
  rings.clear();
  rings.starts.push_back(0);
  std::vector<Point2>& uvs = loopUvs;
  std::vector<uint32_t>&places = loopPlaces, &uses = loopUses, &numbers = loopNumbers;
  std::vector<double>& ts = loopTs;
  std::vector<uint32_t>&firsts = loopFirsts, &vertexOf = loopVertices;
  std::vector<Vec3>& at = loopAt;
  out.useStarts.push_back(0);
  for (uint32_t l = model.faces[f].firstLoop; l < model.faces[f].endLoop; ++l) {
    const ModelLoop& loop = model.loops[l];
    uvs.clear(), places.clear(), uses.clear(), numbers.clear(), at.clear(), firsts.clear();
    vertexOf.clear(), ts.clear();
    for (uint32_t u = loop.firstUse; u < loop.endUse; ++u) {
      const ModelUse& use = model.uses[u];
      const ModelEdge& edge = model.edges[use.edge];
      const std::vector<EdgeSample>& of = all.of[use.edge];
      const uint32_t count = uint32_t(of.size());
      firsts.push_back(uint32_t(uvs.size()));
      const size_t inFace = u - firstUse;
      size_t known = 0, knownEnd = 0;
      if (updates && inFace + 1 < oldUseStarts.size())
        known = oldUseStarts[inFace], knownEnd = oldUseStarts[inFace + 1];
      for (uint32_t k = 0; k + 1 < count; ++k) {
        Corner* corner = nullptr;
        const uint32_t s = use.isReversed ? count - 1 - k : k;
        Point2 uv = placeOf(u, of[s]);
        uint32_t place = all.firstPlace[use.edge] + s - 1;
        if (k == 0) {
          // Where two uses meet, in the middle between them.
          const uint32_t b = u == loop.firstUse ? loop.endUse - 1 : u - 1;
          const ModelUse& before = model.uses[b];
          const ModelEdge& edgeBefore = model.edges[before.edge];
          const Point2 end = before.curve.at(before.isReversed ? edgeBefore.from : edgeBefore.to);
          uv = middle(uv, end);
          place = use.isReversed ? edge.toVertex : edge.fromVertex;
          corner = &cornerOf(place, uv);
          uv = corner->uv;
        }
        uint32_t v = corner ? corner->vertex : kNone;
        // The vertex of the last run at the same sample.
        while (known < knownEnd &&
               (use.isReversed ? oldUseTs[known] > of[s].t : oldUseTs[known] < of[s].t))
          ++known;
        if (v == kNone && known < knownEnd && oldUseTs[known] == of[s].t) {
          v = oldUsePlaces[known];
          if (!(out.uvs[v] == uv && out.positions[v] == of[s].at)) v = kNone;
        }
        if (v == kNone)
          v = addVertex(uv, of[s].at, surface->normalAt(uv.x, uv.y), FaceMesh::Role::Edge);
        isMet[v] = 1, out.roles[v] = FaceMesh::Role::Edge;
        if (corner) corner->vertex = v;
        vertexOf.push_back(v), ts.push_back(of[s].t);
        uvs.push_back(uv), places.push_back(place), at.push_back(of[s].at);
        uses.push_back(u);
        // The interval after the vertex, as the loop runs.
        numbers.push_back(use.isReversed ? s - 1 : s);
      }
    }
    const uint32_t n = uint32_t(uvs.size());
    double area = 0;
    for (uint32_t i = 0; i < n; ++i) {
      const Point2 a = uvs[i], b = uvs[i + 1 == n ? 0 : i + 1], o = uvs[0];
      area += (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
    }
    const bool turns = (area < 0) == loop.isOuter;
    // One vertex at a pole: neighbours at one place are one.
    for (uint32_t i = 0; i < n; ++i)
      out.poles[vertexOf[i]] = i > 0 && places[i] == places[i - 1] ? out.poles[vertexOf[i - 1]]
                               : i > 0 && i + 1 == n && places[i] == places[0]
                                   ? out.poles[vertexOf[0]]
                                   : vertexOf[i];
    for (uint32_t k = 0; k < n; ++k) {
      const uint32_t i = turns ? n - 1 - k : k;
      // Turned round, the segment after a vertex is the one before it.
      const uint32_t segment = turns ? (i == 0 ? n - 1 : i - 1) : i;
      rings.uvs.push_back(uvs[i]);
      rings.at.push_back({});
      rings.vertex.push_back(vertexOf[i]);
      rings.use.push_back(uses[segment]), rings.sample.push_back(numbers[segment]);
    }
    rings.starts.push_back(uint32_t(rings.at.size()));
    rings.loops.push_back(l - model.faces[f].firstLoop);
    for (uint32_t u = 0; u < firsts.size(); ++u) {
      const uint32_t end = u + 1 < firsts.size() ? firsts[u + 1] : n;
      for (uint32_t i = firsts[u]; i <= end; ++i) {
        const uint32_t v = vertexOf[i == n ? 0 : i];
        const ModelUse& use = model.uses[loop.firstUse + u];
        const ModelEdge& edge = model.edges[use.edge];
        mesh->useVertices.push_back(out.poles[v]);
        mesh->usePlaces.push_back(v);
        mesh->useTs.push_back(i < end ? ts[i] : use.isReversed ? edge.from : edge.to);
      }
      mesh->useStarts.push_back(uint32_t(mesh->useVertices.size()));
    }
  }
}

FaceProblem FaceMesher::State::problemOf(const Outcome& outcome) const {
  FaceProblem problem;
  switch (outcome.status) {
    case Status::SelfIntersecting:
      problem.fault = SurfaceFault::TrimSelfIntersects;
      break;
    case Status::HolesOverlap:
      problem.fault = SurfaceFault::TrimsCross;
      break;
    case Status::NestedHole:
    case Status::HoleOutside:
      problem.fault =
          outcome.otherVertex != kNone ? SurfaceFault::TrimsCross : SurfaceFault::HoleOutside;
      break;
    case Status::DegeneratePolygon:
      problem.fault = SurfaceFault::Degenerate;
      break;
    default:
      problem.kind = FaceProblem::Kind::Ended;
      return problem;
  }
  problem.kind = FaceProblem::Kind::Crossing;
  const auto place = [&](uint32_t ring, uint32_t vertex, uint32_t& use, uint32_t& sample,
                         uint32_t& loop) {
    if (ring == kNone) return;
    loop = rings.loops[ring];
    if (vertex == kNone) return;
    const uint32_t i = rings.starts[ring] + vertex;
    use = rings.use[i], sample = rings.sample[i];
  };
  place(outcome.loop, outcome.vertex, problem.use, problem.sample, problem.loop);
  place(outcome.otherLoop, outcome.otherVertex, problem.otherUse, problem.otherSample,
        problem.otherLoop);
  return problem;
}

/// Sweeps over the rings alone, the outer one first.
FaceProblem FaceMesher::State::checkRings() {
  std::vector<double> xy;
  std::vector<uint32_t> starts = {0}, order;
  const uint32_t count = uint32_t(rings.loops.size());
  for (const bool isOuter : {true, false})
    for (uint32_t r = 0; r < count; ++r)
      if (model.loops[model.faces[face].firstLoop + rings.loops[r]].isOuter == isOuter)
        order.push_back(r);
  for (const uint32_t r : order) {
    for (uint32_t i = rings.starts[r]; i < rings.starts[r + 1]; ++i)
      xy.push_back(rings.at[i].x), xy.push_back(rings.at[i].y);
    starts.push_back(uint32_t(xy.size() / 2));
  }
  Outcome outcome = sweep.run({xy, starts, {}, false}, true, true, *work, linked, seen);
  if (outcome.ok()) return {};
  if (outcome.loop != kNone) outcome.loop = order[outcome.loop];
  if (outcome.otherLoop != kNone) outcome.otherLoop = order[outcome.otherLoop];
  return problemOf(outcome);
}

void FaceMesher::forget(uint32_t use) {
  if (use < state_->knownUvs.size()) state_->knownUvs[use].clear();
}

FaceProblem FaceMesher::check(uint32_t face, const EdgeSamples& samples, Work& work) {
  State& s = *state_;
  s.work = &work;
  FaceMesh mesh;
  s.updates = false;
  s.begin(face, samples, mesh);
  const BezierSpans &u = s.surface->u(), &v = s.surface->v();
  s.origin = {u.breaks()[0], v.breaks()[0]};
  s.scale = {1 / (u.breaks()[u.count()] - s.origin.x), 1 / (v.breaks()[v.count()] - s.origin.y)};
  for (size_t i = 0; i < s.rings.at.size(); ++i) s.rings.at[i] = s.scaled(s.rings.uvs[i]);
  return s.checkRings();
}

double FaceMesher::State::deviationAt(Point2 uv, Vec3 at) const {
  const TangentPoint p = surface->tangentsAt(uv.x, uv.y);
  const Vec3 n = p.normal();
  const double size = length(n);
  const Vec3 d = p.at - at;
  // Where there is no normal, all of the distance counts.
  return size > 0 ? std::fabs(dot(d, n)) / size : length(d);
}

/// The tolerance in the middle of a triangle of the band.
double FaceMesher::State::allowedIn(size_t triangle) const {
  const uint32_t* c = &band.corners[3 * triangle];
  const Point2 a = mesh->uvs[c[0]], b = mesh->uvs[c[1]], d = mesh->uvs[c[2]];
  return allowance.at({(a.x + b.x + d.x) / 3, (a.y + b.y + d.y) / 3});
}

bool FaceMesher::State::layOut(const Density::Lines& lines) {
  density->u.lines(lines.u, us), density->v.lines(lines.v, vs);
  localUs.clear(), localVs.clear();
  for (const double u : us) localUs.push_back((u - origin.x) * scale.x);
  for (const double v : vs) localVs.push_back((v - origin.y) * scale.y);
  const uint64_t places = uint64_t(us.size()) * vs.size();
  if (!work->fits(double(places) * kBytesAPlace)) work->fail(Status::OutOfMemory);
  if (!work->tick(100 * places + 300 * rings.at.size())) return false;
  trace.run(rings.at, rings.starts, localUs, localVs);
  // Intervals and strips that the last run had too.
  const auto findNew = [](const std::vector<double>& before, const std::vector<double>& now,
                          std::vector<uint8_t>& isNew, auto&& met) {
    isNew.assign(now.size() - 1, 1);
    size_t k = 0;
    for (size_t i = 0; i + 1 < now.size(); ++i) {
      while (k + 1 < before.size() && before[k] < now[i]) ++k;
      if (k + 1 < before.size() && before[k] == now[i] && before[k + 1] == now[i + 1])
        isNew[i] = 0, met(i, k);
    }
  };
  gridStrips.assign(us.size() - 1, {false, 0});
  findNew(mesh->us, us, isNewU, [&](size_t i, size_t k) {
    gridStrips[i] = mesh->gridStrips[k];
    if (gridStrips[i].off > allowance.betweenU(us[i], us[i + 1])) isNewU[i] = 1;
  });
  findNew(mesh->vs, vs, isNewV, [](size_t, size_t) {});
  const auto findOld = [](const std::vector<double>& before, const std::vector<double>& now,
                          std::vector<uint32_t>& old) {
    old.assign(now.size(), kNone);
    for (size_t i = 0, k = 0; i < now.size(); ++i) {
      while (k < before.size() && before[k] < now[i]) ++k;
      if (k < before.size() && before[k] == now[i]) old[i] = uint32_t(k);
    }
  };
  if (updates) findOld(oldUs, us, oldLineU), findOld(oldVs, vs, oldLineV);
  return true;
}

/// How far new cells are off the surface: which diagonal the quads of a strip have, and whether lines have to be added.
void FaceMesher::State::measureCells(const Density::Lines& lines, bool& isRefined) {
  const size_t nu = us.size(), nv = vs.size();
  isRefined = false;
  mesh->excess = 0;
  halvedU.assign(nu - 1, 0), halvedV.assign(nv - 1, 0);
  quads.alongU = areRowsCheaper(trace.runs);
  // A strip that has no whole cells any more is not off.
  for (size_t i = 0, r = 0; i < gridStrips.size(); ++i) {
    if (r == trace.runs.size() || trace.runs[r].strip != i) gridStrips[i].off = 0;
    while (r < trace.runs.size() && trace.runs[r].strip == i) ++r;
  }
  if (trace.runs.empty()) return;
  const auto at = [](const std::vector<double>& of, size_t i) {
    return Vec3{of[3 * i], of[3 * i + 1], of[3 * i + 2]};
  };
  middleUs.clear(), middleVs.clear();
  for (size_t i = 0; i + 1 < nu; ++i) middleUs.push_back(0.5 * (us[i] + us[i + 1]));
  for (size_t j = 0; j + 1 < nv; ++j) middleVs.push_back(0.5 * (vs[j] + vs[j + 1]));
  // All at once, or in an update one by one.
  if (!updates) {
    centers.resize(3 * middleUs.size() * middleVs.size()), centerNormals.resize(centers.size());
    surface->grid(middleUs, middleVs, centers.data(), centerNormals.data());
  }
  const auto offs = [&](uint32_t i, uint32_t j, double(&off)[2]) {
    Vec3 m, n;
    if (!updates) {
      const size_t c = size_t(i) * (nv - 1) + j;
      m = at(centers, c), n = at(centerNormals, c);
    } else {
      const TangentPoint p = surface->tangentsAt(middleUs[i], middleVs[j]);
      m = p.at, n = p.normal();
      const double size = length(n);
      n = size > 0 ? (1 / size) * n : Vec3{};
    }
    const auto corner = [&](size_t a) { return mesh->positions[gridVertexAt(uint32_t(a))]; };
    const size_t low = i * nv + j, high = low + nv;
    const Vec3 a = corner(low), b = corner(high), c = corner(low + 1), d = corner(high + 1);
    off[0] = std::fabs(dot(n, middle(b, c) - m)), off[1] = std::fabs(dot(n, middle(a, d) - m));
    const double du = us[i + 1] - us[i], dv = vs[j + 1] - vs[j];
    if (!density->isFar(du, dv)) return;
    // The middle alone does not tell.
    for (const double x : {0.25, 0.75})
      for (const double y : {0.25, 0.75}) {
        const Point2 uv{us[i] + x * du, vs[j] + y * dv};
        // On the triangles below and above each diagonal.
        const Vec3 falling =
            x + y < 1 ? a + x * (b - a) + y * (c - a) : d + (1 - x) * (c - d) + (1 - y) * (b - d);
        const Vec3 rising = x > y ? a + x * (b - a) + y * (d - b) : a + y * (c - a) + x * (d - c);
        off[0] = std::max(off[0], deviationAt(uv, falling));
        off[1] = std::max(off[1], deviationAt(uv, rising));
      }
  };
  for (size_t r = 0; r < trace.runs.size();) {
    const uint32_t i = trace.runs[r].strip;
    size_t end = r;
    while (end < trace.runs.size() && trace.runs[end].strip == i) ++end;
    FaceMesh::Strip& strip = gridStrips[i];
    double most[2] = {0, 0};
    const auto each = [&](auto&& look) {
      for (size_t k = r; k < end; ++k)
        for (uint32_t j = trace.runs[k].first; j < trace.runs[k].end; ++j) {
          if (!isNewU[i] && !isNewV[j]) continue;
          double off[2];
          offs(i, j, off);
          look(j, off);
        }
    };
    each([&](uint32_t, const double(&off)[2]) {
      most[0] = std::max(most[0], off[0]), most[1] = std::max(most[1], off[1]);
    });
    if (isNewU[i]) {
      // Of two diagonals that both are near enough, the one whose strips need no index to begin with.
      const bool easy = startsEasilyRising(quads.alongU, model.faces[face].isReversed);
      const bool isNear = most[easy] <= 0.7 * allowance.betweenU(us[i], us[i + 1]);
      strip = {isNear ? easy : most[1] < most[0], 0};
    }
    strip.off = std::max(strip.off, most[strip.rises]);
    if (most[strip.rises] > allowance.betweenU(us[i], us[i + 1])) {
      each([&](uint32_t j, const double(&off)[2]) {
        const double allowed = allowance.at({middleUs[i], middleVs[j]});
        mesh->excess = std::max(mesh->excess, off[strip.rises] / allowed);
        if (off[strip.rises] <= allowed) return;
        const uint32_t nodeU = lines.u.nodes[i], nodeV = lines.v.nodes[j];
        const double eu = density->u.error(nodeU), ev = density->v.error(nodeV);
        const bool alongU =
            eu > 2 * ev || (ev <= 2 * eu && density->u.length(nodeU) >= density->v.length(nodeV));
        (alongU ? halvedU[i] : halvedV[j]) = 1;
        isRefined = true;
      });
    }
    r = end;
  }
}

/// The vertex at a place of the grid.
uint32_t FaceMesher::State::gridVertexAt(uint32_t name) {
  uint32_t& v = gridVertex[name];
  if (v != kNone) return v;
  const uint32_t nv = uint32_t(vs.size());
  const Point2 uv{us[name / nv], vs[name % nv]};
  if (updates) {
    const uint32_t oldU = oldLineU[name / nv], oldV = oldLineV[name % nv];
    if (oldU != kNone && oldV != kNone) v = oldGrid[oldU * oldVs.size() + oldV];
    if (v != kNone) return v;
    const TangentPoint p = surface->tangentsAt(uv.x, uv.y);
    return v = addVertex(uv, p.at, surface->normalOf(p, uv.x, uv.y), FaceMesh::Role::Grid);
  }
  const double *p = &gridAt[3 * size_t(name)], *n = &gridNormals[3 * size_t(name)];
  return v = addVertex(uv, {p[0], p[1], p[2]}, {n[0], n[1], n[2]}, FaceMesh::Role::Grid);
}

/// The grid, with lines added until all its quads are near the surface.
bool FaceMesher::State::meshGrid(Density::Lines& lines) {
  const size_t ringVertices = mesh->positions.size();
  for (int k = 0;; ++k) {
    if (!layOut(lines)) return false;
    gridVertex.assign(us.size() * vs.size(), kNone);
    if (!updates && !(trace.runs.empty() && trace.islands.empty())) {
      gridAt.resize(3 * us.size() * vs.size()), gridNormals.resize(gridAt.size());
      surface->grid(us, vs, gridAt.data(), gridNormals.data());
    }
    bool isRefined = false;
    measureCells(lines, isRefined);
    if (!isRefined || k == kMostRefinings) break;
    density->u.halve(halvedU, lines.u), density->v.halve(halvedV, lines.v);
    if (updates) {
      // What this round has made is there for the next.
      for (uint32_t name = 0; name < gridVertex.size(); ++name) {
        const uint32_t oldU = oldLineU[name / vs.size()], oldV = oldLineV[name % vs.size()];
        if (gridVertex[name] == kNone && oldU != kNone && oldV != kNone)
          gridVertex[name] = oldGrid[oldU * oldVs.size() + oldV];
      }
      oldGrid.swap(gridVertex), oldUs = us, oldVs = vs;
      continue;
    }
    mesh->positions.resize(ringVertices), mesh->normals.resize(ringVertices);
    mesh->uvs.resize(ringVertices), mesh->roles.resize(ringVertices);
    mesh->poles.resize(ringVertices), isMet.resize(ringVertices);
  }
  for (const FaceMesh::Strip& strip : gridStrips)
    mesh->deviation = std::max(mesh->deviation, strip.off);
  writeQuads();
  return true;
}

/// Triangles of the whole cells.
void FaceMesher::State::writeQuads() {
  const uint32_t nv = uint32_t(vs.size());
  quads.runs = trace.runs;
  quads.strips = uint32_t(us.size()) - 1, quads.rows = nv - 1;
  quads.rises.clear(), quads.triangles.clear();
  for (const FaceMesh::Strip& strip : gridStrips) quads.rises.push_back(strip.rises);
  quads.alongU = areRowsCheaper(trace.runs, quads.rises);
  for (const CellRun& run : trace.runs) {
    const uint32_t i = run.strip;
    for (uint32_t j = run.first; j < run.end; ++j) {
      const uint32_t low = i * nv + j, high = low + nv;
      quads.add(gridVertexAt(low), gridVertexAt(high), gridVertexAt(low + 1),
                gridVertexAt(high + 1), quads.rises[i]);
    }
  }
}

/// Vertices of the grid between quads and trimming curves.
void FaceMesher::State::makeIslands() {
  for (const uint32_t name : trace.islands) gridVertexAt(name);
}

/// Triangles between the grid and the trimming curves, all of them.
FaceProblem FaceMesher::State::triangulateBand() {
  xy.clear(), islandXy.clear(), vertices.clear(), starts.assign(1, 0);
  std::vector<double>& islands = islandXy;
  const auto add = [&](Point2 p, uint32_t vertex) {
    xy.push_back(p.x), xy.push_back(p.y);
    vertices.push_back(vertex);
  };
  for (size_t r = 0; r + 1 < rings.starts.size(); ++r) {
    for (uint32_t i = rings.starts[r]; i < rings.starts[r + 1]; ++i)
      add(rings.at[i], rings.vertex[i]);
    starts.push_back(uint32_t(vertices.size()));
  }
  const auto place = [&](uint32_t name) {
    return Point2{localUs[name / vs.size()], localVs[name % vs.size()]};
  };
  for (size_t r = 0; r + 1 < trace.borderStarts.size(); ++r) {
    for (uint32_t i = trace.borderStarts[r]; i < trace.borderStarts[r + 1]; ++i)
      add(place(trace.border[i]), gridVertexAt(trace.border[i]));
    starts.push_back(uint32_t(vertices.size()));
  }
  for (const uint32_t name : trace.islands) {
    const Point2 p = place(name);
    islands.push_back(p.x), islands.push_back(p.y);
    vertices.push_back(gridVertexAt(name));
  }
  const Outcome outcome = triangulator.floodDelaunay({xy, starts, islands, true}, *work, bandFound);
  if (!work->going()) return problemOf({work->status()});
  if (!outcome.ok()) {
    const FaceProblem problem = checkRings();
    if (problem.kind != FaceProblem::Kind::None) return problem;
    // The rings are those of a polygon, and the grid keeps clear of them.
    SF_ASSERT(false);
    FaceProblem unknown;
    unknown.kind = FaceProblem::Kind::Crossing, unknown.fault = SurfaceFault::Degenerate;
    return unknown;
  }
  band.corners.clear();
  for (const uint32_t v : bandFound) band.corners.push_back(vertices[v]);
  bandOff.assign(band.corners.size() / 3, Sampling::kNoLimit);
  oldCorners.clear();
  return {};
}

/// Where the band may be another one than it was.
void FaceMesher::State::findChanges(std::vector<Box2>& changed) const {
  const auto add = [&](Point2 a, Point2 b) {
    changed.push_back(
        {std::min(a.x, b.x), std::max(a.x, b.x), std::min(a.y, b.y), std::max(a.y, b.y)});
  };
  // Between lines that were there before and are still there, all of the strip.
  const auto addStrips = [&](const std::vector<double>& before, const std::vector<double>& now,
                             bool alongU) {
    const double inf = Sampling::kNoLimit;
    size_t i = 0, k = 0;
    while (i + 1 < now.size() && k + 1 < before.size()) {
      size_t ni = i + 1, nk = k + 1;
      while (now[ni] != before[nk]) (now[ni] < before[nk] ? ni : nk) += 1;
      if (ni > i + 1 || nk > k + 1) {
        const Point2 from = scaled(alongU ? Point2{now[i], origin.y} : Point2{origin.x, now[i]}),
                     to = scaled(alongU ? Point2{now[ni], origin.y} : Point2{origin.x, now[ni]});
        if (alongU)
          changed.push_back({from.x, to.x, -inf, inf});
        else
          changed.push_back({-inf, inf, from.y, to.y});
      }
      i = ni, k = nk;
    }
  };
  addStrips(mesh->us, us, true);
  addStrips(mesh->vs, vs, false);
  // Of a use, from each vertex that stays to the next one that stays, if there are others between.
  const auto at = [&](uint32_t v) { return scaled(mesh->uvs[v]); };
  for (size_t u = 0; u + 1 < oldUseStarts.size(); ++u) {
    const uint32_t *a = &oldUsePlaces[oldUseStarts[u]],
                   *aEnd = &oldUsePlaces[0] + oldUseStarts[u + 1];
    const uint32_t *b = &mesh->usePlaces[mesh->useStarts[u]],
                   *bEnd = &mesh->usePlaces[0] + mesh->useStarts[u + 1];
    while (a + 1 < aEnd && b + 1 < bEnd) {
      const uint32_t *na = a + 1, *nb = b + 1;
      // Old vertices that are still met are those of the new list, in the same order.
      while (na + 1 < aEnd && !(isMet[*na] && mesh->roles[*na] == FaceMesh::Role::Edge)) ++na;
      while (nb + 1 < bEnd && *nb != *na) ++nb;
      if (na > a + 1 || nb > b + 1) {
        Box2 box{Sampling::kNoLimit, -Sampling::kNoLimit, Sampling::kNoLimit, -Sampling::kNoLimit};
        const auto include = [&](Point2 p) {
          box.u0 = std::min(box.u0, p.x), box.u1 = std::max(box.u1, p.x);
          box.v0 = std::min(box.v0, p.y), box.v1 = std::max(box.v1, p.y);
        };
        for (const uint32_t* v = a; v <= na; ++v) include(at(*v));
        for (const uint32_t* v = b; v <= nb; ++v) include(at(*v));
        // Of some width, or nothing would overlap with one that lies along a line.
        const double margin = 1e-9 * (localUs.back() - localUs[0] + localVs.back() - localVs[0]);
        box.u0 -= margin, box.u1 += margin, box.v0 -= margin, box.v1 += margin;
        changed.push_back(box);
      }
      a = na, b = nb;
    }
  }
  // Around vertices that have come to the band.
  std::vector<uint8_t> wasThere(mesh->positions.size(), 0);
  for (const uint32_t v : oldBorder) wasThere[v] = 1;
  const size_t nv = vs.size();
  const auto addAround = [&](uint32_t name) {
    if (wasThere[gridVertex[name]]) return;
    const size_t i = name / nv, j = name % nv;
    add({localUs[i > 0 ? i - 1 : 0], localVs[j > 0 ? j - 1 : 0]},
        {localUs[std::min(i + 1, us.size() - 1)], localVs[std::min(j + 1, nv - 1)]});
  };
  for (const uint32_t name : trace.islands) addAround(name);
  for (const uint32_t name : trace.border) addAround(name);
}

/// The band of the last run, where it still fits, and triangles where it does not. False if it has to be made anew.
bool FaceMesher::State::patchBand() {
  if (mesh->band.empty() || oldUseStarts.size() != mesh->useStarts.size()) return false;
  std::vector<uint32_t> border, islands;
  for (size_t r = 0; r + 1 < rings.starts.size(); ++r)
    for (uint32_t i = rings.starts[r]; i < rings.starts[r + 1]; ++i) {
      border.push_back(rings.vertex[i]);
      border.push_back(rings.vertex[i + 1 == rings.starts[r + 1] ? rings.starts[r] : i + 1]);
    }
  for (size_t r = 0; r + 1 < trace.borderStarts.size(); ++r)
    for (uint32_t i = trace.borderStarts[r]; i < trace.borderStarts[r + 1]; ++i) {
      const uint32_t next = i + 1 == trace.borderStarts[r + 1] ? trace.borderStarts[r] : i + 1;
      border.push_back(gridVertexAt(trace.border[i])),
          border.push_back(gridVertexAt(trace.border[next]));
    }
  for (const uint32_t name : trace.islands) islands.push_back(gridVertexAt(name));
  std::vector<Box2> changed;
  findChanges(changed);
  if (changed.size() > kMostChanges) return false;
  // A vertex that is inside the quads now is none of the band.
  std::vector<uint8_t> isGone(mesh->positions.size(), 1);
  for (const uint32_t v : border) isGone[v] = 0;
  for (const uint32_t v : islands) isGone[v] = 0;
  for (uint32_t v = 0; v < isGone.size(); ++v)
    if (mesh->roles[v] == FaceMesh::Role::Added) isGone[v] = 0;
  bandAt.resize(mesh->positions.size());
  for (uint32_t v = 0; v < bandAt.size(); ++v) bandAt[v] = scaled(mesh->uvs[v]);
  size_t kept = 0;
  std::vector<uint8_t> stays;
  band.corners = mesh->band;
  if (!patch.run({bandAt, border, islands, isGone, changed}, triangulator, *work, mesh->bandTwins,
                 band.corners, kept, stays))
    return false;
  bandOff.clear();
  for (size_t t = 0; t < stays.size(); ++t)
    if (stays[t]) bandOff.push_back(mesh->bandOff[t]);
  bandOff.resize(band.corners.size() / 3, Sampling::kNoLimit);
  // Strips of what stays, in their new places.
  bandLinks.bits.clear(), oldCorners.clear();
  for (size_t t = 0; t < stays.size(); ++t) {
    if (!stays[t]) continue;
    bandLinks.bits.push_back(mesh->bandLinks.bits[t]);
    oldCorners.insert(oldCorners.end(), &mesh->band[3 * t], &mesh->band[3 * t] + 3);
  }
  return true;
}

/// Notes the edge of the model from one vertex to the next of a ring if the surface is off it.
void FaceMesher::State::noteIfOff(uint32_t from, uint32_t to, FaceProblem& problem) {
  if (ringOf.empty()) {
    ringOf.assign(mesh->positions.size(), kNone);
    for (uint32_t i = 0; i < rings.vertex.size(); ++i) ringOf[rings.vertex[i]] = i;
  }
  const uint32_t i = from < ringOf.size() ? ringOf[from] : kNone;
  if (i == kNone) return;
  const size_t ring =
      size_t(std::upper_bound(rings.starts.begin(), rings.starts.end(), i) - rings.starts.begin());
  const uint32_t next = i + 1 == rings.starts[ring] ? rings.starts[ring - 1] : i + 1;
  if (rings.vertex[next] != to) return;
  const uint32_t use = rings.use[i], sample = rings.sample[i];
  const std::vector<EdgeSample>& of = samples->of[model.uses[use].edge];
  const ModelEdge& edge = model.edges[model.uses[use].edge];
  if (of[sample + 1].t - of[sample].t < kShortInterval * (edge.to - edge.from)) return;
  bool isOff = false;
  for (const double share : {0.25, 0.5, 0.75}) {
    const Point2 uv =
        model.uses[use].curve.at(of[sample].t + share * (of[sample + 1].t - of[sample].t));
    const Vec3 chord = of[sample].at + share * (of[sample + 1].at - of[sample].at);
    isOff |= deviationAt(uv, chord) > allowance.at(uv) + edge.tolerance;
  }
  if (isOff) problem.off.push_back({use, sample});
}

/// Where an edge of the band is to be looked at and divided: where it crosses a crease, or in the middle.
///   share  out: of the way from a to b
Point2 FaceMesher::State::splitOf(uint32_t a, uint32_t b, double& share) const {
  const Point2 p = mesh->uvs[a], q = mesh->uvs[b];
  const auto crosses = [&](double from, double to, double crease) {
    share = (crease - from) / (to - from);
    return share > kNearEnd && share < 1 - kNearEnd;
  };
  for (const double crease : density->u.creases())
    if (p.x != q.x && crosses(p.x, q.x, crease)) return {crease, p.y + share * (q.y - p.y)};
  for (const double crease : density->v.creases())
    if (p.y != q.y && crosses(p.y, q.y, crease)) return {p.x + share * (q.x - p.x), crease};
  share = 0.5;
  return unscaled(middle(bandAt[a], bandAt[b]));
}

/// Adds points inside until triangles of the band are near the surface.
FaceProblem FaceMesher::State::refineBand() {
  FaceProblem ended, off;
  ended.kind = FaceProblem::Kind::Ended, off.kind = FaceProblem::Kind::EdgeOff;
  ringOf.clear();
  band.unused.clear(), band.edgeFrom.clear();
  bandAt.resize(mesh->positions.size());
  for (uint32_t v = 0; v < bandAt.size(); ++v) bandAt[v] = scaled(mesh->uvs[v]);
  if (!findTwins(band.corners, uint32_t(bandAt.size()), *work, band.twins)) return ended;
  isFresh.resize(bandOff.size());
  for (size_t t = 0; t < bandOff.size(); ++t) isFresh[t] = bandOff[t] == Sampling::kNoLimit;
  if (density->isFlat()) {
    std::fill(bandOff.begin(), bandOff.end(), 0);
    improveAngles();
    return {};
  }
  const auto at = [&](uint32_t v) -> Vec3 { return mesh->positions[v]; };
  known = band.corners;  // corners of the triangles whose deviation is known
  for (size_t t = 0; t < bandOff.size(); ++t)
    if (isFresh[t] || (bandOff[t] > allowance.least() && bandOff[t] > allowedIn(t)))
      known[3 * t] = kNone;
  const size_t mostVertices = kMostAdded * (64 + bandAt.size());
  struct Spot {
    uint32_t half;  // of the triangle, or of the edge
    uint32_t corners[3];
    bool onEdge;
    double off;
  };
  std::vector<Spot> spots;
  for (int round = 0;; ++round) {
    band.at = bandAt, band.metric = bandAt;
    spots.clear();
    known.resize(band.corners.size(), kNone);
    const uint32_t triangles = band.triangleCount();
    isNew.resize(triangles), bandOff.resize(triangles);
    for (uint32_t t = 0; t < triangles; ++t)
      isNew[t] = !std::equal(&known[3 * t], &known[3 * t] + 3, &band.corners[3 * t]);
    for (uint32_t t = 0; t < triangles; ++t) {
      if (!isNew[t]) continue;
      const uint32_t* c = &band.corners[3 * t];
      const double allowed = allowedIn(t), quick = 0.25 * allowed;
      Spot worst{kNone, {c[0], c[1], c[2]}, false, allowed};
      double most = 0;
      const auto consider = [&](uint32_t half, bool onEdge, double here) {
        most = std::max(most, here);
        if (here > worst.off) worst.half = half, worst.onEdge = onEdge, worst.off = here;
      };
      double bound = 0;
      for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t h = 3 * t + k, twin = band.twins[h];
        const uint32_t a = band.from(h), b = band.to(h);
        const double edge = density->bound(mesh->uvs[a], mesh->uvs[b]);
        bound = std::max(bound, edge);
        if (twin == kNone || (twin < h && isNew[twin / 3]) || edge < quick) continue;
        double share;
        const Point2 uv = splitOf(a, b, share);
        consider(h, true, deviationAt(uv, at(a) + share * (at(b) - at(a))));
      }
      const auto pole = [&](int k) { return mesh->poles[c[k]]; };
      if (bound >= quick && pole(0) != pole(1) && pole(1) != pole(2) && pole(2) != pole(0)) {
        const Point2 p = bandAt[c[0]], q = bandAt[c[1]], r = bandAt[c[2]];
        const Point2 uv = unscaled({(p.x + q.x + r.x) / 3, (p.y + q.y + r.y) / 3});
        const Vec3 centroid = (1.0 / 3) * (at(c[0]) + at(c[1]) + at(c[2]));
        double inside = deviationAt(uv, centroid);
        const Point2 a = mesh->uvs[c[0]], b = mesh->uvs[c[1]], d = mesh->uvs[c[2]];
        const double du = std::max({a.x, b.x, d.x}) - std::min({a.x, b.x, d.x}),
                     dv = std::max({a.y, b.y, d.y}) - std::min({a.y, b.y, d.y});
        // The middles alone do not tell: look at those between them and the corners too.
        for (int k = 0; k < 3 && density->isFar(du, dv); ++k) {
          const Point2 e = mesh->uvs[c[k]];
          const Point2 place{0.5 * (uv.x + e.x), 0.5 * (uv.y + e.y)};
          inside = std::max(inside, deviationAt(place, middle(centroid, at(c[k]))));
        }
        consider(3 * t, false, inside);
      }
      bandOff[t] = most;
      if (worst.half == kNone) {
        std::copy(c, c + 3, &known[3 * t]);
        continue;
      }
      spots.push_back(worst);
      // Points inside are of no use where it is the edge that is off.
      for (uint32_t k = 0; k < 3 && !worst.onEdge && !acceptsEdges; ++k)
        if (band.twins[3 * t + k] == kNone) noteIfOff(c[k], c[(k + 1) % 3], off);
    }
    if (!off.off.empty()) return off;
    if (spots.empty() || bandAt.size() > mostVertices || round + 1 == kMostRounds) break;
    if (!work->tick(400 * spots.size() + 300 * triangles)) return ended;
    for (const Spot& spot : spots) {
      // What an earlier insertion of the round has changed is looked at again in the next one.
      const uint32_t t = spot.half / 3;
      if (!std::equal(spot.corners, spot.corners + 3, &band.corners[3 * t])) continue;
      const uint32_t a = band.from(spot.half), b = band.to(spot.half), c = band.apex(spot.half);
      const Point2 p = bandAt[a], q = bandAt[b], r = bandAt[c];
      const Point2 place =
          spot.onEdge ? middle(p, q) : Point2{(p.x + q.x + r.x) / 3, (p.y + q.y + r.y) / 3};
      const Point2 uv = unscaled(place);
      // Rounding may move the point off its edge, even out of both triangles.
      const Point2 to = scaled(uv);
      const auto turns = [&](Point2 x, Point2 y, Point2 z) { return turn(x, y, z) > 0; };
      bool fits = turns(p, to, r) && turns(to, q, r);
      if (spot.onEdge) {
        const Point2 s = bandAt[band.apex(band.twins[spot.half])];
        fits = fits && turns(q, to, s) && turns(to, p, s);
        // Beside a triangle without width, as along a side of the domain, the other diagonal does without it.
        if (!fits && turns(r, s, q) && turns(s, r, p)) band.flip(spot.half);
      } else {
        fits = fits && turns(p, q, to);
      }
      if (!fits) continue;
      const TangentPoint added = surface->tangentsAt(uv.x, uv.y);
      const uint32_t v =
          addVertex(uv, added.at, surface->normalOf(added, uv.x, uv.y), FaceMesh::Role::Added);
      if (v == bandAt.size())
        bandAt.push_back(to);
      else
        bandAt[v] = to;
      band.at = bandAt, band.metric = bandAt;
      opposite.clear();
      band.insert({spot.half, spot.onEdge}, v, opposite);
      legalize(band, opposite, 64, *work);
      known.resize(band.corners.size(), kNone);
    }
  }
  improveAngles();
  for (size_t t = 0; t < bandOff.size(); ++t) {
    mesh->deviation = std::max(mesh->deviation, bandOff[t]);
    if (bandOff[t] > allowance.least())
      mesh->excess = std::max(mesh->excess, bandOff[t] / allowedIn(t));
  }
  return work->going() ? FaceProblem{} : ended;
}

/// Flips edges of the band where the least angle of both triangles in space becomes larger, and the new edge is near the
/// surface. Delaunay triangles of the domain are such of space only where it is not stretched there.
void FaceMesher::State::improveAngles() {
  const auto at = [&](uint32_t v) -> Vec3 { return mesh->positions[v]; };
  // The square of the sine of the least angle: twice the area over the two longer sides.
  const auto quality = [&](uint32_t a, uint32_t b, uint32_t c) {
    const Vec3 p = at(a), q = at(b), r = at(c);
    const Vec3 n = cross(q - p, r - p);
    const Vec3 d = q - p, e = r - q, f = p - r;
    const double x = dot(d, d), y = dot(e, e), z = dot(f, f);
    const double shortest = std::min({x, y, z}), product = x * y * z;
    return product > 0 ? dot(n, n) * shortest / product : 0;
  };
  band.at = bandAt, band.metric = bandAt;
  for (int round = 0; round < kMostFlipRounds; ++round) {
    bool any = false;
    for (uint32_t h = 0; h < band.corners.size(); ++h) {
      const uint32_t g = band.twins[h];
      if (g == kNone || g < h) continue;
      // What stays was looked at before.
      const auto stays = [&](uint32_t t) { return t < isFresh.size() && !isFresh[t]; };
      if (stays(h / 3) && stays(g / 3)) continue;
      const uint32_t a = band.from(h), b = band.to(h), c = band.apex(h), d = band.apex(g);
      const auto pole = [&](uint32_t v) { return mesh->poles[v] != v; };
      if (pole(a) || pole(b) || pole(c) || pole(d)) continue;
      const double before = std::min(quality(a, b, c), quality(b, a, d));
      if (before > kGoodAngle) continue;
      const double after = std::min(quality(c, d, b), quality(d, c, a));
      if (after <= kBetter * before) continue;
      if (!(turn(bandAt[c], bandAt[d], bandAt[b]) > 0 && turn(bandAt[d], bandAt[c], bandAt[a]) > 0))
        continue;
      double off = std::max(bandOff[h / 3], bandOff[g / 3]);
      const Point2 uv = unscaled(middle(bandAt[c], bandAt[d]));
      const double allowed = allowance.at(uv);
      if (density->bound(mesh->uvs[c], mesh->uvs[d]) >= 0.25 * allowed) {
        const double here = deviationAt(uv, middle(at(c), at(d)));
        if (here > allowed) continue;
        off = std::max(off, here);
      }
      band.flip(h);
      bandOff[h / 3] = bandOff[g / 3] = off;
      any = true;
    }
    if (!any) break;
  }
}

/// Strips of the band: all anew, or in an update those of triangles that have changed, joined to what stays.
void FaceMesher::State::linkBand() {
  if (oldCorners.empty()) {
    linkStrips(band.twins, *work, bandLinks);
    return;
  }
  const uint32_t count = band.triangleCount();
  std::vector<uint8_t>& bits = bandLinks.bits;
  bits.resize(count, 0);
  isNew.assign(count, 1);
  for (uint32_t t = 0; 3 * t < oldCorners.size(); ++t)
    isNew[t] = !std::equal(&oldCorners[3 * t], &oldCorners[3 * t] + 3, &band.corners[3 * t]);
  changed.clear();
  for (uint32_t t = 0; t < count; ++t) {
    if (isNew[t]) bits[t] = 0;
    bool isCut = isNew[t] != 0;
    for (uint32_t h = 3 * t; h < 3 * t + 3 && !isNew[t]; ++h) {
      if (!bandLinks.linked(h)) continue;
      const uint32_t g = band.twins[h];
      if (g != kNone && !isNew[g / 3]) continue;
      bits[t] &= uint8_t(~(1u << (h % 3)));
      isCut = true;
    }
    if (isCut) changed.push_back(t);
  }
  joinStrips(band.twins, changed, bandLinks, [](uint32_t) { return true; });
}

/// Triangles and strips of the whole face, on its own side, and what the next update begins with.
void FaceMesher::State::finish() {
  mesh->us = us, mesh->vs = vs, mesh->gridStrips = gridStrips;
  mesh->gridVertices = gridVertex;
  for (const uint32_t v : rings.vertex) mesh->border.push_back(v);
  for (const uint32_t name : trace.border) mesh->border.push_back(gridVertex[name]);
  for (const uint32_t name : trace.islands) mesh->border.push_back(gridVertex[name]);
  // Numbers of vertices that are no longer there.
  for (const uint32_t v : band.corners) isMet[v] = 1;
  for (const uint32_t v : gridVertex)
    if (v != kNone) isMet[v] = 1;
  for (uint32_t v = 0; v < isMet.size() && updates; ++v) {
    if (isMet[v] || mesh->roles[v] == FaceMesh::Role::None) continue;
    mesh->roles[v] = FaceMesh::Role::None;
    mesh->unused.push_back(v);
  }
  linkBand();
  const bool isReversed = model.faces[face].isReversed;
  if (!faceStrips.write(quads, uint32_t(mesh->positions.size()), band.corners, band.twins,
                        bandLinks, isReversed, *work, mesh->strips, mesh->stripStarts))
    return;
  for (uint32_t& v : mesh->strips) v = mesh->poles[v];
  mesh->triangles = quads.triangles;
  for (uint32_t t = 0; t < band.triangleCount(); ++t) {
    const uint32_t a = mesh->poles[band.corners[3 * t]], b = mesh->poles[band.corners[3 * t + 1]],
                   c = mesh->poles[band.corners[3 * t + 2]];
    if (a != b && b != c && c != a) mesh->triangles.insert(mesh->triangles.end(), {a, b, c});
  }
  for (size_t i = 0; i < mesh->triangles.size() && isReversed; i += 3)
    std::swap(mesh->triangles[i + 1], mesh->triangles[i + 2]);
  mesh->band.swap(band.corners), mesh->bandTwins.swap(band.twins);
  mesh->bandOff.swap(bandOff), mesh->bandLinks.bits.swap(bandLinks.bits);
}

FaceProblem FaceMesher::run(uint32_t face, const EdgeSamples& samples, Density& density,
                            Density::Lines& lines, const Allowance& allowance, bool updates,
                            bool acceptsEdges, Work& work, FaceMesh& mesh) {
  State& s = *state_;
  s.work = &work;
  s.density = &density, s.allowance = allowance;
  s.updates = updates && !mesh.band.empty(), s.acceptsEdges = acceptsEdges;
  s.begin(face, samples, mesh);
  mesh.deviation = mesh.excess = 0;
  const auto positive = [](double x) { return x > 0 && std::isfinite(x) ? x : 1; };
  std::vector<double> us, vs;
  density.u.lines(lines.u, us), density.v.lines(lines.v, vs);
  s.origin = {us[0], vs[0]}, s.scale = {positive(density.speedU()), positive(density.speedV())};
  const Point2 shorter = density.shortening(lines);
  s.scale.x *= shorter.x, s.scale.y *= shorter.y;
  for (size_t i = 0; i < s.rings.at.size(); ++i) s.rings.at[i] = s.scaled(s.rings.uvs[i]);
  FaceProblem problem;
  problem.kind = FaceProblem::Kind::Ended;
  if (s.meshGrid(lines)) {
    s.makeIslands();
    problem = {};
    if (!s.updates || !s.patchBand()) problem = s.triangulateBand();
    if (problem.kind == FaceProblem::Kind::None) {
      problem = s.refineBand();
      if (problem.kind == FaceProblem::Kind::None) s.finish();
      // All of it at one place, or along a line: perhaps for want of samples.
      if (problem.kind == FaceProblem::Kind::None && mesh.triangles.empty()) {
        problem.kind = FaceProblem::Kind::Crossing, problem.fault = SurfaceFault::Degenerate;
        problem.loop = 0;
      }
      if (!work.going()) problem.kind = FaceProblem::Kind::Ended;
    }
  }
  if (problem.kind != FaceProblem::Kind::None) mesh.clear();
  return problem;
}

}  // namespace sf
