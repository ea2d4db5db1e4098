#include "surface/face_mesh.h"

#include <algorithm>
#include <cmath>

#include "polygon/strips/strips.h"
#include "polygon/sweep/sweep.h"
#include "polygon/triangulate.h"
#include "surface/trace.h"
#include "triangles/triangle_mesh.h"

namespace sf {
namespace {

/// Corners of one vertex within this share of the domain are one.
constexpr double kSameCorner = 1e-6;
constexpr int kMostRefinings = 8, kMostRounds = 16;

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
  bool areGrown = false;
};

}  // namespace

struct FaceMesher::State {
  State(const Model& model, Work& work) : model(model), work(work) {}

  const Model& model;
  Work& work;
  Trace trace;
  PolygonTriangulator triangulator;
  PlaneSweep sweep;
  LinkedPolygon linked;
  Visibility seen;

  // Of the face at hand.
  uint32_t face = 0;
  const NurbsSurface* surface = nullptr;
  Rings rings;
  Point2 origin{}, scale{1, 1};
  FaceMesh* mesh = nullptr;
  Density* density = nullptr;
  double tolerance = 0;
  std::vector<double> us, vs, localUs, localVs, gridAt, gridNormals, centers, centerNormals;
  std::vector<uint32_t> gridVertex;
  std::vector<uint8_t> halvedU, halvedV;
  TriangleMesh band;
  std::vector<Point2> bandAt, metric;
  std::vector<uint32_t> bandVertex;  // number in the mesh
  std::vector<uint32_t> quadStrips, quadStarts, quadTriangles;

  // [vertices of the model] where each was met last.
  struct Corner {
    uint32_t face;
    Point2 uv;
  };
  std::vector<Corner> corners;

  Point2 sharedCorner(uint32_t vertex, Point2 uv);
  Point2 scaled(Point2 uv) const {
    return {(uv.x - origin.x) * scale.x, (uv.y - origin.y) * scale.y};
  }
  Point2 unscaled(Point2 p) const { return {origin.x + p.x / scale.x, origin.y + p.y / scale.y}; }

  void begin(uint32_t f, const EdgeSamples& samples, FaceMesh& out);
  FaceProblem problemOf(const Outcome& outcome) const;
  FaceProblem checkRings();
  bool meshGrid(Density::Lines& lines);
  bool layOut(const Density::Lines& lines);
  void quads(Density::Lines& lines, bool& isRefined);
  FaceProblem triangulateBand();
  bool refineBand();
  double deviationAt(Point2 uv, Vec3 at) const;
  uint32_t addVertex(Point2 uv, Vec3 at, Vec3 normal);
  void finish();
};

FaceMesher::FaceMesher(const Model& model, Work& work) : state_(new State(model, work)) {}
FaceMesher::~FaceMesher() = default;

uint32_t FaceMesher::State::addVertex(Point2 uv, Vec3 at, Vec3 normal) {
  mesh->uvs.push_back(uv), mesh->positions.push_back(at), mesh->normals.push_back(normal);
  return uint32_t(mesh->positions.size()) - 1;
}

/// The place of a corner in the domain: that of an earlier one of the same vertex, if they are nearly at one place.
Point2 FaceMesher::State::sharedCorner(uint32_t vertex, Point2 uv) {
  if (corners.size() < model.vertices) corners.resize(model.vertices, {kNone, {}});
  Corner& corner = corners[vertex];
  const BezierSpans &u = surface->u(), &v = surface->v();
  const double nearU = kSameCorner * (u.breaks()[u.count()] - u.breaks()[0]),
               nearV = kSameCorner * (v.breaks()[v.count()] - v.breaks()[0]);
  const bool isSame = corner.face == face && std::fabs(corner.uv.x - uv.x) <= nearU &&
                      std::fabs(corner.uv.y - uv.y) <= nearV;
  if (!isSame) corner = {face, uv};
  return corner.uv;
}

/// Lays out the rings, and their vertices in the mesh.
void FaceMesher::State::begin(uint32_t f, const EdgeSamples& samples, FaceMesh& out) {
  face = f, mesh = &out, out = {};
  surface = model.faces[f].surface.get();
  rings = {};
  rings.starts.push_back(0);
  std::vector<Point2> uvs;
  std::vector<uint32_t> places, uses, numbers;
  std::vector<Vec3> at;
  out.useStarts.push_back(0);
  for (uint32_t l = model.faces[f].firstLoop; l < model.faces[f].endLoop; ++l) {
    const ModelLoop& loop = model.loops[l];
    uvs.clear(), places.clear(), uses.clear(), numbers.clear(), at.clear();
    std::vector<uint32_t> firsts;
    for (uint32_t u = loop.firstUse; u < loop.endUse; ++u) {
      const ModelUse& use = model.uses[u];
      const ModelEdge& edge = model.edges[use.edge];
      const std::vector<EdgeSample>& of = samples.of[use.edge];
      const uint32_t count = uint32_t(of.size());
      firsts.push_back(uint32_t(uvs.size()));
      for (uint32_t k = 0; k + 1 < count; ++k) {
        const uint32_t s = use.isReversed ? count - 1 - k : k;
        Point2 uv = use.curve.at(of[s].t);
        uint32_t place = samples.firstPlace[use.edge] + s - 1;
        if (k == 0) {
          // Where two uses meet, in the middle between them.
          const uint32_t b = u == loop.firstUse ? loop.endUse - 1 : u - 1;
          const ModelUse& before = model.uses[b];
          const ModelEdge& edgeBefore = model.edges[before.edge];
          const Point2 end = before.curve.at(before.isReversed ? edgeBefore.from : edgeBefore.to);
          uv = middle(uv, end);
          place = use.isReversed ? edge.toVertex : edge.fromVertex;
          uv = sharedCorner(place, uv);
        }
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
    std::vector<uint32_t> vertexOf(n);
    for (uint32_t i = 0; i < n; ++i) {
      if (i > 0 && places[i] == places[i - 1]) {
        vertexOf[i] = vertexOf[i - 1];
        continue;
      }
      if (i > 0 && i + 1 == n && places[i] == places[0]) {
        vertexOf[i] = vertexOf[0];
        continue;
      }
      vertexOf[i] = addVertex(uvs[i], at[i], {});
    }
    for (uint32_t k = 0; k < n; ++k) {
      const uint32_t i = turns ? n - 1 - k : k;
      // Turned round, the segment after a vertex is the one before it.
      const uint32_t segment = turns ? (i == 0 ? n - 1 : i - 1) : i;
      rings.uvs.push_back(uvs[i]);
      rings.at.push_back({});
      rings.vertex.push_back(vertexOf[i]);
      rings.use.push_back(uses[segment]), rings.sample.push_back(numbers[segment]);
    }
    mesh->edgeVertices = uint32_t(mesh->positions.size());
    rings.starts.push_back(uint32_t(rings.at.size()));
    rings.loops.push_back(l - model.faces[f].firstLoop);
    for (uint32_t u = 0; u < firsts.size(); ++u) {
      const uint32_t end = u + 1 < firsts.size() ? firsts[u + 1] : n;
      for (uint32_t i = firsts[u]; i <= end; ++i)
        mesh->useVertices.push_back(vertexOf[i == n ? 0 : i]);
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
  Outcome outcome = sweep.run({xy, starts, {}, false}, true, true, work, linked, seen);
  if (outcome.ok()) return {};
  if (outcome.loop != kNone) outcome.loop = order[outcome.loop];
  if (outcome.otherLoop != kNone) outcome.otherLoop = order[outcome.otherLoop];
  return problemOf(outcome);
}

FaceProblem FaceMesher::check(uint32_t face, const EdgeSamples& samples) {
  State& s = *state_;
  FaceMesh mesh;
  s.begin(face, samples, mesh);
  const BezierSpans &u = s.surface->u(), &v = s.surface->v();
  s.origin = {u.breaks()[0], v.breaks()[0]};
  s.scale = {1 / (u.breaks()[u.count()] - s.origin.x), 1 / (v.breaks()[v.count()] - s.origin.y)};
  for (size_t i = 0; i < s.rings.at.size(); ++i) s.rings.at[i] = s.scaled(s.rings.uvs[i]);
  return s.checkRings();
}

double FaceMesher::State::deviationAt(Point2 uv, Vec3 at) const {
  const SurfacePoint p = surface->at(uv.x, uv.y);
  const Vec3 n = p.normal();
  const double size = length(n);
  const Vec3 d = p.at - at;
  // Where there is no normal, all of the distance counts.
  return size > 0 ? std::fabs(dot(d, n)) / size : length(d);
}

bool FaceMesher::State::layOut(const Density::Lines& lines) {
  density->u.lines(lines.u, us), density->v.lines(lines.v, vs);
  localUs.clear(), localVs.clear();
  for (const double u : us) localUs.push_back((u - origin.x) * scale.x);
  for (const double v : vs) localVs.push_back((v - origin.y) * scale.y);
  if (!work.tick(20 * us.size() * vs.size())) return false;
  trace.run(rings.at, rings.starts, localUs, localVs);
  return true;
}

/// Quads of the whole cells, in one strip a run, and whether lines have to be added for them.
void FaceMesher::State::quads(Density::Lines& lines, bool& isRefined) {
  const uint32_t nv = uint32_t(vs.size());
  isRefined = false;
  quadStrips.clear(), quadStarts.assign(1, 0), quadTriangles.clear();
  gridAt.resize(3 * us.size() * vs.size()), gridNormals.resize(gridAt.size());
  if (trace.runs.empty() && trace.islands.empty()) return;
  surface->grid(us, vs, gridAt.data(), gridNormals.data());
  const auto at = [&](const std::vector<double>& of, size_t i) {
    return Vec3{of[3 * i], of[3 * i + 1], of[3 * i + 2]};
  };
  std::vector<double> middleUs, middleVs;
  for (size_t i = 0; i + 1 < us.size(); ++i) middleUs.push_back(0.5 * (us[i] + us[i + 1]));
  for (size_t j = 0; j + 1 < vs.size(); ++j) middleVs.push_back(0.5 * (vs[j] + vs[j + 1]));
  if (!trace.runs.empty()) {
    centers.resize(3 * middleUs.size() * middleVs.size()), centerNormals.resize(centers.size());
    surface->grid(middleUs, middleVs, centers.data(), centerNormals.data());
  }
  halvedU.assign(middleUs.size(), 0), halvedV.assign(middleVs.size(), 0);
  const auto vertex = [&](uint32_t i, uint32_t j) {
    const uint32_t name = i * nv + j;
    uint32_t& v = gridVertex[name];
    if (v == kNone) v = addVertex({us[i], vs[j]}, at(gridAt, name), at(gridNormals, name));
    return v;
  };
  double deviation = 0;
  for (const CellRun& run : trace.runs) {
    const uint32_t i = run.strip;
    double up = 0, down = 0;  // the largest deviations of both diagonals
    for (uint32_t j = run.first; j < run.end; ++j) {
      const size_t c = size_t(i) * (nv - 1) + j;
      const Vec3 n = at(centerNormals, c), m = at(centers, c);
      const auto off = [&](uint32_t a, uint32_t b) {
        return std::fabs(dot(n, middle(at(gridAt, a), at(gridAt, b)) - m));
      };
      const double cellUp = off(i * nv + j, (i + 1) * nv + j + 1);
      const double cellDown = off((i + 1) * nv + j, i * nv + j + 1);
      up = std::max(up, cellUp), down = std::max(down, cellDown);
    }
    const bool isUp = up < down;
    const double worst = std::min(up, down);
    if (worst > tolerance)
      for (uint32_t j = run.first; j < run.end; ++j) {
        const size_t c = size_t(i) * (nv - 1) + j;
        const uint32_t a = isUp ? i * nv + j : (i + 1) * nv + j;
        const uint32_t b = isUp ? (i + 1) * nv + j + 1 : i * nv + j + 1;
        const double off = std::fabs(
            dot(at(centerNormals, c), middle(at(gridAt, a), at(gridAt, b)) - at(centers, c)));
        if (off <= tolerance) continue;
        const double eu = density->u.error(lines.u.nodes[i]),
                     ev = density->v.error(lines.v.nodes[j]);
        const bool alongU =
            eu > 2 * ev || (ev <= 2 * eu && density->u.length(lines.u.nodes[i]) >=
                                                density->v.length(lines.v.nodes[j]));
        (alongU ? halvedU[i] : halvedV[j]) = 1;
        isRefined = true;
      }
    deviation = std::max(deviation, worst);
    for (uint32_t j = run.first; j <= run.end; ++j) {
      const uint32_t a = vertex(i, j), b = vertex(i + 1, j);
      // The first triangle of a strip is the way round it is: from the left line for diagonals that fall.
      quadStrips.push_back(isUp ? b : a), quadStrips.push_back(isUp ? a : b);
      if (j == run.end) break;
      const uint32_t c = vertex(i, j + 1), d = vertex(i + 1, j + 1);
      if (isUp)
        quadTriangles.insert(quadTriangles.end(), {a, b, d, a, d, c});
      else
        quadTriangles.insert(quadTriangles.end(), {a, b, c, b, d, c});
    }
    quadStarts.push_back(uint32_t(quadStrips.size()));
  }
  if (!isRefined) mesh->deviation = std::max(mesh->deviation, deviation);
}

/// The grid's quads, with lines added until all are near the surface.
bool FaceMesher::State::meshGrid(Density::Lines& lines) {
  const size_t ringVertices = mesh->positions.size();
  for (int k = 0;; ++k) {
    if (!layOut(lines)) return false;
    gridVertex.assign(us.size() * vs.size(), kNone);
    bool isRefined = false;
    quads(lines, isRefined);
    if (!isRefined || k == kMostRefinings) return true;
    density->u.halve(halvedU, lines.u), density->v.halve(halvedV, lines.v);
    mesh->positions.resize(ringVertices), mesh->normals.resize(ringVertices);
    mesh->uvs.resize(ringVertices);
  }
}

/// Triangles between the grid and the trimming curves.
FaceProblem FaceMesher::State::triangulateBand() {
  const uint32_t nv = uint32_t(vs.size());
  std::vector<double> xy, islands;
  std::vector<uint32_t> starts = {0};
  bandVertex.clear(), bandAt.clear();
  const auto add = [&](Point2 p, uint32_t vertex) {
    xy.push_back(p.x), xy.push_back(p.y);
    bandAt.push_back(p), bandVertex.push_back(vertex);
  };
  for (size_t r = 0; r + 1 < rings.starts.size(); ++r) {
    for (uint32_t i = rings.starts[r]; i < rings.starts[r + 1]; ++i)
      add(rings.at[i], rings.vertex[i]);
    starts.push_back(uint32_t(bandAt.size()));
  }
  for (size_t r = 0; r + 1 < trace.borderStarts.size(); ++r) {
    for (uint32_t i = trace.borderStarts[r]; i < trace.borderStarts[r + 1]; ++i) {
      const uint32_t name = trace.border[i];
      add({localUs[name / nv], localVs[name % nv]}, gridVertex[name]);
    }
    starts.push_back(uint32_t(bandAt.size()));
  }
  for (const uint32_t name : trace.islands) {
    const uint32_t i = name / nv, j = name % nv;
    const Vec3 at{gridAt[3 * name], gridAt[3 * name + 1], gridAt[3 * name + 2]};
    const Vec3 n{gridNormals[3 * name], gridNormals[3 * name + 1], gridNormals[3 * name + 2]};
    gridVertex[name] = addVertex({us[i], vs[j]}, at, n);
    islands.push_back(localUs[i]), islands.push_back(localVs[j]);
    bandAt.push_back({localUs[i], localVs[j]}), bandVertex.push_back(gridVertex[name]);
  }
  PolygonOptions options;
  options.delaunay = true;
  PolygonTriangulation found;
  const Outcome outcome =
      triangulator.triangulate({xy, starts, islands, true}, options, work, found);
  if (!work.going()) return problemOf({work.status()});
  if (!outcome.ok()) {
    const FaceProblem problem = checkRings();
    if (problem.kind != FaceProblem::Kind::None) return problem;
    // The rings are those of a polygon, and the grid keeps clear of them.
    SF_ASSERT(false);
    FaceProblem unknown;
    unknown.kind = FaceProblem::Kind::Crossing, unknown.fault = SurfaceFault::Degenerate;
    return unknown;
  }
  band.corners.swap(found.triangles);
  return {};
}

/// Adds points inside until triangles of the band are near the surface.
bool FaceMesher::State::refineBand() {
  band.unused.clear(), band.edgeFrom.clear();
  if (!findTwins(band.corners, uint32_t(bandAt.size()), work, band.twins)) return false;
  if (density->isFlat()) return true;
  const auto at = [&](uint32_t v) { return mesh->positions[bandVertex[v]]; };
  std::vector<uint32_t> known;  // corners of the triangles that are near
  std::vector<uint32_t> opposite;
  const size_t most = 64 + 4 * bandAt.size();
  double deviation = 0;
  const double quick = 0.25 * tolerance;
  for (int round = 0; round < kMostRounds; ++round) {
    deviation = 0;
    band.at = bandAt, band.metric = bandAt;
    struct Spot {
      uint32_t half;  // of the triangle, or of the edge
      uint32_t corners[3];
      bool onEdge;
      double off;
    };
    std::vector<Spot> spots;
    known.resize(band.corners.size(), kNone);
    const uint32_t triangles = band.triangleCount();
    std::vector<uint8_t> isNew(triangles);
    for (uint32_t t = 0; t < triangles; ++t)
      isNew[t] = known[3 * t] != band.corners[3 * t] ||
                 known[3 * t + 1] != band.corners[3 * t + 1] ||
                 known[3 * t + 2] != band.corners[3 * t + 2];
    for (uint32_t t = 0; t < triangles; ++t) {
      if (!isNew[t]) continue;
      const uint32_t* c = &band.corners[3 * t];
      Spot worst{kNone, {c[0], c[1], c[2]}, false, tolerance};
      const auto consider = [&](uint32_t half, bool onEdge, double off) {
        deviation = std::max(deviation, off);
        if (off > worst.off) worst.half = half, worst.onEdge = onEdge, worst.off = off;
      };
      for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t h = 3 * t + k, twin = band.twins[h];
        if (twin == kNone || (twin < h && isNew[twin / 3])) continue;
        const uint32_t a = band.from(h), b = band.to(h);
        if (density->bound(unscaled(bandAt[a]), unscaled(bandAt[b])) < quick) continue;
        const Point2 uv = unscaled(middle(bandAt[a], bandAt[b]));
        consider(h, true, deviationAt(uv, middle(at(a), at(b))));
      }
      const Point2 p = bandAt[c[0]], q = bandAt[c[1]], r = bandAt[c[2]];
      const double bound = std::max({density->bound(unscaled(p), unscaled(q)),
                                     density->bound(unscaled(q), unscaled(r)),
                                     density->bound(unscaled(r), unscaled(p))});
      if (bound >= quick &&
          !(bandVertex[c[0]] == bandVertex[c[1]] || bandVertex[c[1]] == bandVertex[c[2]] ||
            bandVertex[c[2]] == bandVertex[c[0]])) {
        const Point2 uv = unscaled({(p.x + q.x + r.x) / 3, (p.y + q.y + r.y) / 3});
        const Vec3 centroid = (1.0 / 3) * (at(c[0]) + at(c[1]) + at(c[2]));
        consider(3 * t, false, deviationAt(uv, centroid));
      }
      if (worst.half != kNone)
        spots.push_back(worst);
      else
        std::copy(c, c + 3, &known[3 * t]);
    }
    if (spots.empty() || bandAt.size() > most || round + 1 == kMostRounds) break;
    if (!work.tick(400 * spots.size() + 300 * triangles)) return false;
    for (const Spot& spot : spots) {
      // What an earlier insertion of the round has changed is looked at again in the next one.
      const uint32_t t = spot.half / 3;
      if (!std::equal(spot.corners, spot.corners + 3, &band.corners[3 * t])) continue;
      const uint32_t a = band.from(spot.half), b = band.to(spot.half), c = band.apex(spot.half);
      const Point2 p = bandAt[a], q = bandAt[b], r = bandAt[c];
      const Point2 place =
          spot.onEdge ? middle(p, q) : Point2{(p.x + q.x + r.x) / 3, (p.y + q.y + r.y) / 3};
      const Point2 uv = unscaled(place);
      const SurfacePoint s = surface->at(uv.x, uv.y);
      const uint32_t v = uint32_t(bandAt.size());
      bandAt.push_back(place);
      band.at = bandAt, band.metric = bandAt;
      // Rounding may have moved the point off its edge, even out of both triangles.
      const uint32_t g = spot.onEdge ? band.twins[spot.half] : kNone;
      bool fits = band.orient(a, v, c) > 0 && band.orient(v, b, c) > 0;
      if (spot.onEdge)
        fits = fits && band.orient(b, v, band.apex(g)) > 0 && band.orient(v, a, band.apex(g)) > 0;
      else
        fits = fits && band.orient(a, b, v) > 0;
      if (!fits) {
        bandAt.pop_back();
        continue;
      }
      bandVertex.push_back(addVertex(uv, s.at, surface->normalAt(uv.x, uv.y)));
      opposite.clear();
      band.insert({spot.half, spot.onEdge}, v, opposite);
      legalize(band, opposite, 64, work);
      known.resize(band.corners.size(), kNone);
    }
  }
  mesh->deviation = std::max(mesh->deviation, deviation);
  return work.going();
}

/// Triangles and strips of the whole face, on its own side.
void FaceMesher::State::finish() {
  for (size_t v = 0; v < mesh->edgeVertices; ++v)
    mesh->normals[v] = surface->normalAt(mesh->uvs[v].x, mesh->uvs[v].y);
  std::vector<uint32_t> corners;
  for (uint32_t t = 0; t < band.triangleCount(); ++t) {
    const uint32_t a = bandVertex[band.corners[3 * t]], b = bandVertex[band.corners[3 * t + 1]],
                   c = bandVertex[band.corners[3 * t + 2]];
    if (a != b && b != c && c != a) corners.insert(corners.end(), {a, b, c});
  }
  std::vector<uint32_t> twins, strips, starts;
  findTwins(corners, uint32_t(mesh->positions.size()), work, twins);
  makeStrips(corners, twins, work, strips, starts);
  mesh->triangles.swap(quadTriangles);
  mesh->triangles.insert(mesh->triangles.end(), corners.begin(), corners.end());
  mesh->strips.swap(quadStrips), mesh->stripStarts.swap(quadStarts);
  const uint32_t first = uint32_t(mesh->strips.size());
  mesh->strips.insert(mesh->strips.end(), strips.begin(), strips.end());
  for (size_t i = 1; i < starts.size(); ++i) mesh->stripStarts.push_back(first + starts[i]);
  if (!model.faces[face].isReversed) return;
  for (size_t i = 0; i < mesh->triangles.size(); i += 3)
    std::swap(mesh->triangles[i + 1], mesh->triangles[i + 2]);
  for (Vec3& n : mesh->normals) n = -n;
  // A strip turned round: backwards if it has an odd number of indices, else with its first one twice.
  std::vector<uint32_t> turned, turnedStarts = {0};
  for (size_t s = 0; s + 1 < mesh->stripStarts.size(); ++s) {
    const uint32_t from = mesh->stripStarts[s], to = mesh->stripStarts[s + 1];
    if ((to - from) % 2 == 1) {
      for (uint32_t i = to; i > from; --i) turned.push_back(mesh->strips[i - 1]);
    } else {
      turned.push_back(mesh->strips[from]);
      turned.insert(turned.end(), mesh->strips.begin() + from, mesh->strips.begin() + to);
    }
    turnedStarts.push_back(uint32_t(turned.size()));
  }
  mesh->strips.swap(turned), mesh->stripStarts.swap(turnedStarts);
}

FaceProblem FaceMesher::run(uint32_t face, const EdgeSamples& samples, Density& density,
                            Density::Lines& lines, double tolerance, FaceMesh& mesh) {
  State& s = *state_;
  s.density = &density, s.tolerance = tolerance;
  s.begin(face, samples, mesh);
  const auto positive = [](double x) { return x > 0 && std::isfinite(x) ? x : 1; };
  std::vector<double> us, vs;
  density.u.lines(lines.u, us), density.v.lines(lines.v, vs);
  s.origin = {us[0], vs[0]}, s.scale = {positive(density.speedU()), positive(density.speedV())};
  for (size_t i = 0; i < s.rings.at.size(); ++i) s.rings.at[i] = s.scaled(s.rings.uvs[i]);
  FaceProblem ended;
  ended.kind = FaceProblem::Kind::Ended;
  if (!s.meshGrid(lines)) return ended;
  const FaceProblem problem = s.triangulateBand();
  if (problem.kind != FaceProblem::Kind::None) return problem;
  if (!s.refineBand()) return ended;
  s.finish();
  return s.work.going() ? FaceProblem{} : ended;
}

}  // namespace sf
