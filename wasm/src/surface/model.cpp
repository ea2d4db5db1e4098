#include "surface/model.h"

#include <algorithm>
#include <cmath>

#include "base/sort.h"
#include "base/union_find.h"
#include "surface/missing_curves.h"

namespace sf {
namespace {

/// How far a trimming curve may leave the domain, or the next one may begin, in the domain's size.
constexpr double kDomainSlack = 1e-6;
/// A face with a curve that leaves the domain by more than that is not looked at any further.
constexpr double kFarOutside = 0.5;
/// Weights may differ by this factor. Beyond it, what has the smaller ones is lost to rounding.
constexpr double kLargestRatio = 1e10;
/// How far curves may be apart beyond what their edge tells, in the model's diagonal.
constexpr double kSpaceSlack = 1e-5;
/// Consecutive curves may be this much of the domain apart if they meet in space.
constexpr double kLargestGap = 0.05;
/// Points within this share of the diagonal are one.
constexpr double kSamePoint = 1e-9;
/// And what rounding may make of one, in its coordinates.
constexpr double kRounding = 1e-14;
/// In how many places of each span curves are looked at, but at its end.
constexpr uint32_t kLooks = 4, kMostLooks = 64;
/// Nanoseconds of one look, nearly.
constexpr uint64_t kLookCost = 400;

/// Places farther out do not fit into 32 bits, in which meshes have them; nor do those of smaller models.
constexpr double kFarthest = 1e37, kLeastDiagonal = 1e-35;

bool isAcceptedNumber(double x) { return std::fabs(x) <= kLargestCoordinate; }
bool areAccepted(ArrayView<const double> numbers) {
  return std::all_of(numbers.begin(), numbers.end(), isAcceptedNumber);
}

bool areInReach(ArrayView<const double> places) {
  return std::all_of(places.begin(), places.end(),
                     [](double x) { return std::fabs(x) <= kFarthest; });
}

/// Reads both arrays from front to back. After a read that does not fit, `fits` is false, and all that follows is empty.
class Reader {
 public:
  explicit Reader(const ModelArrays& arrays) : arrays_(arrays) {}
  bool fits = true;

  uint32_t count() {
    if (nextCount_ >= arrays_.shape.size()) return fits = false, 0;
    return arrays_.shape[nextCount_++];
  }
  ArrayView<const double> numbers(uint64_t size) {
    if (!fits || size > arrays_.numbers.size() - nextNumber_)
      return fits = false, ArrayView<const double>();
    nextNumber_ += size_t(size);
    return arrays_.numbers.slice(nextNumber_ - size_t(size), size_t(size));
  }
  bool isAtEnd() const {
    return nextCount_ == arrays_.shape.size() && nextNumber_ == arrays_.numbers.size();
  }
  /// Whether a list of that many things, each of at least one count, can follow.
  bool holds(uint32_t things) const { return things <= arrays_.shape.size() - nextCount_; }

 private:
  ModelArrays arrays_;
  size_t nextCount_ = 0, nextNumber_ = 0;
};

struct CurveArrays {
  uint32_t degree = 0, poles = 0;
  ArrayView<const double> knots, at, weights;
};

CurveArrays readCurve(Reader& in, uint32_t dimension, double* domain = nullptr) {
  CurveArrays c;
  c.degree = in.count(), c.poles = in.count();
  const uint32_t knots = in.count(), isRational = in.count();
  if (domain) {
    const ArrayView<const double> ends = in.numbers(2);
    if (in.fits) domain[0] = ends[0], domain[1] = ends[1];
  }
  c.knots = in.numbers(knots), c.at = in.numbers(uint64_t(dimension) * c.poles);
  if (isRational) c.weights = in.numbers(c.poles);
  return c;
}

/// The fault of knots, poles and weights, if there is one.
bool findFault(const KnotVector& knots, uint64_t poles, SurfaceFault& fault) {
  if (areKnots(knots, size_t(poles)) && areAccepted(knots.knots)) return false;
  const bool isFinite = areAccepted(knots.knots);
  fault = isFinite ? SurfaceFault::BadKnots : SurfaceFault::NotFinite;
  return true;
}
bool findFault(ArrayView<const double> poles, ArrayView<const double> weights,
               SurfaceFault& fault) {
  fault = SurfaceFault::NotFinite;
  if (!areAccepted(poles) || !areAccepted(weights)) return true;
  if (weights.empty()) return false;
  fault = SurfaceFault::BadWeights;
  const auto [least, most] = std::minmax_element(weights.begin(), weights.end());
  return !(*least > 0) || !(*most <= kLargestRatio * *least);
}
bool findFault(const CurveArrays& c, SurfaceFault& fault) {
  return findFault({c.degree, c.knots}, c.poles, fault) || findFault(c.at, c.weights, fault);
}

std::vector<double> copyOf(ArrayView<const double> a) { return {a.begin(), a.end()}; }

/// Makes room for one more in a list that grows; false beyond the limit of memory.
template <class T>
bool grow(std::vector<T>& list, Charge& charge) {
  return list.size() < list.capacity() ||
         reserve(list, std::max<size_t>(16, 2 * list.size()), charge);
}

/// The box of a face's domain, larger by a share of its size.
void domainOf(const ModelFace& face, double share, Vec3& low, Vec3& high) {
  const ArrayView<const double> u = face.surface->u().breaks(), v = face.surface->v().breaks();
  low = {u[0], v[0], -1}, high = {u[u.size() - 1], v[v.size() - 1], 1};
  const Vec3 slack = share * (high - low);
  low = low - slack, high = high + slack;
}

Vec3 onSurface(const Model& model, const ModelUse& use, double t) {
  const Point2 p = use.curve.at(t);
  return model.faces[use.face].surface->tangentsAt(p.x, p.y).at;
}

/// Whether something holds at parameters all along an edge: its ends, the breaks of its curves, and some between these; the more
/// of them the more spans of the surface a use runs through. True too once the work has ended.
///   use  one of its uses, whose curve is there, or null
template <class F>
bool allAlong(const Model& model, const ModelEdge& edge, const ModelUse* use, Work& work,
              F&& holds) {
  std::vector<double> stops{edge.from};
  const auto addBreaks = [&](const NurbsCurve& curve) {
    for (const double t : curve.spans().breaks())
      if (edge.from < t && t < edge.to) stops.push_back(t);
  };
  if (edge.curve) addBreaks(*edge.curve);
  if (use) addBreaks(use->curve.curve());
  stops.push_back(edge.to);
  sf::sort(stops.begin(), stops.end());
  const auto spanNumbers = [&](double t) {
    const NurbsSurface& surface = *model.faces[use->face].surface;
    const Point2 p = use->curve.at(t);
    return std::pair<uint32_t, uint32_t>(surface.u().spanAt(p.x), surface.v().spanAt(p.y));
  };
  const auto apart = [](uint32_t a, uint32_t b) { return a < b ? b - a : a - b; };
  for (size_t i = 0; i + 1 < stops.size(); ++i) {
    const double a = stops[i], b = stops[i + 1];
    if (!(a < b)) continue;
    uint32_t looks = kLooks;
    if (use) {
      const auto from = spanNumbers(a), to = spanNumbers(b);
      looks *= 1 + apart(from.first, to.first) + apart(from.second, to.second);
      looks = std::min(looks, kMostLooks);
    }
    for (uint32_t k = 0; k < looks; ++k)
      if (!holds(a + (b - a) * k / looks)) return false;
    if (!work.tick(looks * kLookCost)) return true;
  }
  return holds(edge.to);
}

/// The model under way, and what is found wrong with it.
class ModelReader {
 public:
  ModelReader(const ModelArrays& arrays, Work& work, Charge& charge, Model& model)
      : in_(arrays), work_(work), charge_(charge), m_(model) {}

  bool read();
  void findBox();
  void checkSize();
  void runAroundDomains();
  void countUses();
  void findPoints();
  void findCurves();
  void checkUses();
  void unite();
  std::vector<ModelFault> faults;

 private:
  void readEdge(ModelEdge& edge, uint32_t number);
  void readFace(ModelFace& face, uint32_t number);
  void readUse(ModelUse& use, uint32_t place, uint32_t loopInFace);
  void fail(SurfaceFault fault, uint32_t face, uint32_t loop = kNone, uint32_t use = kNone,
            uint32_t edge = kNone);
  bool appendDomain(uint32_t face);
  void runAroundDomain(uint32_t face, const ModelLoop& loop);
  bool isPoint(const ModelEdge& edge, const ModelUse& use);
  bool checkUse(uint32_t use);
  void failUse(SurfaceFault fault, uint32_t use);

  Reader in_;
  Work& work_;
  Charge& charge_;
  Model& m_;
  double samePoint_ = 0;
  struct EdgeFault {
    bool isFaulty = false;
    SurfaceFault fault = SurfaceFault::BadEdge;
  };
  std::vector<EdgeFault> edgeFaults_;
  std::vector<Vec3> lows_, highs_;  // the boxes of faces
};

void ModelReader::fail(SurfaceFault fault, uint32_t face, uint32_t loop, uint32_t use,
                       uint32_t edge) {
  if (m_.faces[face].isLeftOut || m_.faces[face].isSuspect) return;
  // Where a loop that leaves the domain also crosses another, that is the better thing to say.
  (fault == SurfaceFault::TrimOutside ? m_.faces[face].isSuspect : m_.faces[face].isLeftOut) = true;
  faults.push_back({fault, face, loop, use, kNone, edge});
}

void ModelReader::failUse(SurfaceFault fault, uint32_t use) {
  const ModelUse& u = m_.uses[use];
  fail(fault, u.face, u.loop - m_.faces[u.face].firstLoop, use - m_.loops[u.loop].firstUse, u.edge);
}

void ModelReader::readEdge(ModelEdge& edge, uint32_t number) {
  EdgeFault& bad = edgeFaults_[number];
  const auto fail = [&](SurfaceFault fault) {
    if (!bad.isFaulty) bad = {true, fault};
  };
  const uint32_t flags = in_.count();
  const ArrayView<const double> numbers = in_.numbers(3);
  if (!in_.fits) return;
  edge.isDegenerate = (flags & 1) != 0;
  edge.tolerance = numbers[0], edge.from = numbers[1], edge.to = numbers[2];
  if (!areAccepted(numbers) || edge.tolerance < 0)
    fail(SurfaceFault::NotFinite);
  else if (!(edge.from < edge.to))
    fail(SurfaceFault::BadDomain);
  if ((flags & 2) == 0) return;
  const CurveArrays c = readCurve(in_, 3);
  if (!in_.fits || bad.isFaulty) return;
  SurfaceFault fault;
  if (findFault(c, fault)) return fail(fault);
  if (!areInReach(c.at)) return fail(SurfaceFault::NotFinite);
  const NurbsCurveView view{{c.degree, c.knots}, 3, c.at, c.weights};
  if (!charge_.add(bytesOf(view))) return void(in_.fits = false);
  edge.curve = std::make_unique<NurbsCurve>(view);
  const ArrayView<const double> breaks = edge.curve->spans().breaks();
  const double slack = kDomainSlack * (edge.to - edge.from);
  if (edge.from < breaks[0] - slack || edge.to > breaks[breaks.size() - 1] + slack)
    fail(SurfaceFault::BadDomain);
}

void ModelReader::readFace(ModelFace& face, uint32_t number) {
  const uint32_t flags = in_.count();
  const uint32_t degreeU = in_.count(), polesU = in_.count(), knotsU = in_.count();
  const uint32_t degreeV = in_.count(), polesV = in_.count(), knotsV = in_.count();
  const uint32_t isRational = in_.count(), outer = in_.count(), loops = in_.count();
  const uint64_t poles = uint64_t(polesU) * polesV;
  const KnotVector u{degreeU, in_.numbers(knotsU)}, v{degreeV, in_.numbers(knotsV)};
  const ArrayView<const double> at = in_.numbers(poles < 1ull << 40 ? 3 * poles : ~0ull);
  const ArrayView<const double> weights =
      isRational ? in_.numbers(poles) : ArrayView<const double>();
  if (!in_.fits) return;
  face.isReversed = (flags & 1) != 0;
  face.firstLoop = uint32_t(m_.loops.size());
  const NurbsSurfaceView view{u, v, at, weights};
  SurfaceFault fault;
  if (findFault(u, polesU, fault) || findFault(v, polesV, fault) || findFault(view, fault)) {
    fail(fault, number);
  } else {
    const size_t copied = u.knots.size() + v.knots.size() + at.size() + weights.size();
    if (!charge_.add(bytesOf(view) + copied * sizeof(double))) return void(in_.fits = false);
    face.arrays = {degreeU, degreeV, copyOf(u.knots), copyOf(v.knots), copyOf(at), copyOf(weights)};
    face.surface = std::make_unique<NurbsSurface>(face.arrays.surface());
    Vec3 &low = lows_[number], &high = highs_[number];
    low = high = {at[0], at[1], at[2]};
    for (size_t i = 3; i < at.size(); i += 3)
      low = lowest(low, {at[i], at[i + 1], at[i + 2]}),
      high = highest(high, {at[i], at[i + 1], at[i + 2]});
  }
  if (outer > loops) fail(SurfaceFault::Degenerate, number);
  if (!in_.holds(loops)) return void(in_.fits = false);
  for (uint32_t l = 0; l < loops && in_.fits; ++l) {
    ModelLoop loop;
    loop.face = number, loop.isOuter = l + 1 == outer;
    loop.firstUse = uint32_t(m_.uses.size());
    const uint32_t uses = in_.count();
    if (!in_.holds(uses)) return void(in_.fits = false);
    if (uses == 0) fail(SurfaceFault::Degenerate, number, l);
    for (uint32_t k = 0; k < uses && in_.fits; ++k) {
      ModelUse use;
      use.face = number, use.loop = uint32_t(m_.loops.size());
      readUse(use, k, l);
      if (!grow(m_.uses, charge_)) return void(in_.fits = false);
      m_.uses.push_back(std::move(use));
    }
    loop.endUse = uint32_t(m_.uses.size());
    if (!push(m_.loops, loop, charge_)) in_.fits = false;
  }
  if (outer == 0 && !appendDomain(number)) in_.fits = false;
  face.endLoop = uint32_t(m_.loops.size());
}

/// A loop around the domain of a face without an outer one, after those given. Its edges come once the model's size is known.
bool ModelReader::appendDomain(uint32_t number) {
  ModelLoop loop;
  loop.face = number, loop.isOuter = loop.isDomain = true;
  loop.firstUse = uint32_t(m_.uses.size()), loop.endUse = loop.firstUse + 4;
  for (int k = 0; k < 4; ++k) {
    ModelUse use;
    use.face = number, use.loop = uint32_t(m_.loops.size());
    if (!grow(m_.uses, charge_)) return false;
    m_.uses.push_back(std::move(use));
  }
  return push(m_.loops, loop, charge_);
}

void ModelReader::readUse(ModelUse& use, uint32_t place, uint32_t loopInFace) {
  const uint32_t edge = in_.count(), flags = in_.count();
  use.isReversed = (flags & 1) != 0, use.isSeam = (flags & 2) != 0;
  double domain[2] = {};
  CurveArrays c;
  if (flags & 4) c = readCurve(in_, 2, domain);
  if (!in_.fits) return;
  const auto fail = [&](SurfaceFault fault) {
    this->fail(fault, use.face, loopInFace, place, edge);
  };
  if (edge >= m_.edges.size()) return fail(SurfaceFault::BadEdge);
  use.edge = edge;
  const ModelEdge& e = m_.edges[edge];
  if (edgeFaults_[edge].isFaulty) return fail(edgeFaults_[edge].fault);
  if (!(flags & 4)) return e.curve || e.isDegenerate ? void() : fail(SurfaceFault::BadEdge);
  SurfaceFault fault;
  if (findFault(c, fault)) return fail(fault);
  const KnotVector knots{c.degree, c.knots};
  const double slack = kDomainSlack * (e.to - e.from);
  // Where the domain of a p-curve differs from its edge's range, or its knots do not reach as far.
  if (!(std::fabs(domain[0] - e.from) <= slack && std::fabs(domain[1] - e.to) <= slack &&
        knots.from() <= e.from + slack && knots.to() >= e.to - slack))
    return fail(SurfaceFault::BadDomain);
  const size_t copied = c.knots.size() + c.at.size() + c.weights.size();
  if (!charge_.add(bytesOf(NurbsCurveView{knots, 2, c.at, c.weights}) + copied * sizeof(double)))
    return void(in_.fits = false);
  use.arrays = {c.degree, 0, copyOf(c.knots), {}, copyOf(c.at), copyOf(c.weights)};
  use.curve = TrimCurve(use.arrays.curve());
}

bool ModelReader::read() {
  const uint32_t faces = in_.count(), edges = in_.count();
  if (!in_.fits || !in_.holds(faces) || !in_.holds(edges)) return false;
  const uint64_t perFace = sizeof(ModelFace) + 2 * sizeof(Vec3) + sizeof(ModelFault),
                 perEdge = sizeof(ModelEdge) + sizeof(EdgeFault);
  if (!charge_.add(faces * perFace + edges * perEdge)) return false;
  m_.faces.resize(faces), m_.edges.resize(edges);
  edgeFaults_.resize(edges), lows_.resize(faces), highs_.resize(faces);
  for (uint32_t e = 0; e < edges && in_.fits; ++e) readEdge(m_.edges[e], e);
  for (uint32_t f = 0; f < faces && in_.fits; ++f) {
    readFace(m_.faces[f], f);
    if (!work_.tick(kLookCost * (1 + m_.faces[f].arrays.poles.size()))) return false;
  }
  return in_.fits && in_.isAtEnd();
}

/// The box of the faces that are left, if there are any, and what counts as one point in it.
void ModelReader::findBox() {
  bool isFirst = true;
  for (uint32_t f = 0; f < m_.faces.size(); ++f) {
    if (m_.faces[f].isLeftOut) continue;
    m_.least = isFirst ? lows_[f] : lowest(m_.least, lows_[f]);
    m_.greatest = isFirst ? highs_[f] : highest(m_.greatest, highs_[f]);
    isFirst = false;
  }
  const double rounding = kRounding * std::max(length(m_.least), length(m_.greatest));
  samePoint_ = std::max(kSamePoint * m_.diagonal(), rounding);
  m_.slack = std::max(kSpaceSlack * m_.diagonal(), rounding);
}

/// Models without any size have no faces.
void ModelReader::checkSize() {
  if (m_.diagonal() >= kLeastDiagonal) return;
  for (uint32_t f = 0; f < m_.faces.size(); ++f) fail(SurfaceFault::Degenerate, f);
}

/// Leads the loop around the domain of a face along its sides.
void ModelReader::runAroundDomain(uint32_t number, const ModelLoop& loop) {
  const NurbsSurface& s = *m_.faces[number].surface;
  const BezierSpans &u = s.u(), &v = s.v();
  const double u0 = u.breaks()[0], u1 = u.breaks()[u.count()], v0 = v.breaks()[0],
               v1 = v.breaks()[v.count()];
  const Point2 corners[4] = {{u0, v0}, {u1, v0}, {u1, v1}, {u0, v1}};
  const auto side = [&](int k, double x) {
    const Point2 a = corners[k], b = corners[(k + 1) & 3];
    return s.at(a.x + x * (b.x - a.x), a.y + x * (b.y - a.y)).at;
  };
  const uint32_t looks = 4 * kLooks * std::max(u.count(), v.count());
  const auto all = [&](auto&& holds) {
    for (uint32_t i = 0; i <= looks; ++i)
      if (!holds(double(i) / looks)) return false;
    return true;
  };
  uint32_t edges[4];
  for (int k = 0; k < 4; ++k) {
    ModelUse& use = m_.uses[loop.firstUse + k];
    const Point2 a = corners[k], b = corners[(k + 1) & 3];
    // The third side runs backwards along the first one where the surface closes; so does the fourth along the second.
    const bool closes = k >= 2 && !m_.edges[edges[k - 2]].isDegenerate && all([&](double x) {
                          return distance(side(k, x), side(k - 2, 1 - x)) <= samePoint_;
                        });
    if (closes) {
      use.edge = edges[k] = edges[k - 2];
      use.isReversed = use.isSeam = true;
      m_.uses[loop.firstUse + k - 2].isSeam = true;
      use.curve = TrimCurve(b, a, 0, 1);
    } else {
      ModelEdge edge;
      edge.isDegenerate =
          all([&](double x) { return distance(side(k, x), side(k, 0)) <= samePoint_; });
      use.edge = edges[k] = uint32_t(m_.edges.size());
      use.curve = TrimCurve(a, b, 0, 1);
      if (!grow(m_.edges, charge_)) return;
      m_.edges.push_back(std::move(edge));
    }
  }
}

void ModelReader::runAroundDomains() {
  for (const ModelLoop& loop : m_.loops)
    if (loop.isDomain && !m_.faces[loop.face].isLeftOut && work_.going())
      runAroundDomain(loop.face, loop);
}

/// Whether all of an edge is one point.
bool ModelReader::isPoint(const ModelEdge& edge, const ModelUse& use) {
  if (!edge.curve && !use.curve.isFound()) return false;
  const auto placeAt = [&](double t) {
    return edge.curve ? edge.curve->placeAt(t) : onSurface(m_, use, t);
  };
  const Vec3 first = placeAt(edge.from);
  if (distance(placeAt(0.5 * (edge.from + edge.to)), first) > samePoint_) return false;
  return allAlong(m_, edge, edge.curve ? nullptr : &use, work_,
                  [&](double t) { return distance(placeAt(t), first) <= samePoint_; });
}

/// Edges that are points, though they do not say so, are degenerate.
void ModelReader::findPoints() {
  for (ModelEdge& edge : m_.edges)
    if (edge.uses > 0 && !edge.isDegenerate)
      edge.isDegenerate = isPoint(edge, m_.uses[edge.firstUse]);
}

void ModelReader::countUses() {
  for (ModelEdge& edge : m_.edges) edge.firstUse = kNone, edge.uses = 0;
  for (uint32_t u = 0; u < m_.uses.size(); ++u) {
    if (m_.faces[m_.uses[u].face].isLeftOut) continue;
    ModelEdge& edge = m_.edges[m_.uses[u].edge];
    if (edge.firstUse == kNone) edge.firstUse = u;
    ++edge.uses;
  }
}

/// Where curves of space have none in the domain.
void ModelReader::findCurves() {
  for (uint32_t f = 0; f < m_.faces.size(); ++f) {
    if (m_.faces[f].isLeftOut) continue;
    uint32_t lost;
    if (!findMissingCurves(m_, f, m_.slack, work_, charge_, lost)) return;
    if (lost != kNone) failUse(SurfaceFault::EdgeApart, lost);
  }
}

/// Whether a use's curve stays in the domain, with its edge, and ends where the next one begins.
bool ModelReader::checkUse(uint32_t number) {
  ModelUse& use = m_.uses[number];
  if (!use.curve.isFound()) return failUse(SurfaceFault::EdgeApart, number), false;
  const ModelEdge& edge = m_.edges[use.edge];
  if (!staysInDomain(m_, number, kDomainSlack)) {
    failUse(SurfaceFault::TrimOutside, number);
    // So far out the surface is of no use to say more.
    if (!staysInDomain(m_, number, kFarOutside)) m_.faces[use.face].isLeftOut = true;
    return false;
  }
  const BezierSpans &u = m_.faces[use.face].surface->u(), &v = m_.faces[use.face].surface->v();
  if (!edge.curve && !edge.isDegenerate && m_.uses[edge.firstUse].face != use.face)
    return failUse(SurfaceFault::BadEdge, number), false;
  if (!runsWithEdge(m_, number, work_)) return failUse(SurfaceFault::EdgeApart, number), false;
  const uint32_t next = m_.after(number);
  const ModelUse& after = m_.uses[next];
  if (!after.curve.isFound()) return failUse(SurfaceFault::EdgeApart, next), false;
  const ModelEdge& edgeAfter = m_.edges[after.edge];
  const double tEnd = use.isReversed ? edge.from : edge.to,
               tBegin = after.isReversed ? edgeAfter.to : edgeAfter.from;
  const Point2 end = use.curve.at(tEnd), begin = after.curve.at(tBegin);
  const double gap = std::max(std::fabs(end.x - begin.x) / (u.breaks()[u.count()] - u.breaks()[0]),
                              std::fabs(end.y - begin.y) / (v.breaks()[v.count()] - v.breaks()[0]));
  const double apart = distance(onSurface(m_, use, tEnd), onSurface(m_, after, tBegin)),
               allowed = m_.slack + edge.tolerance + edgeAfter.tolerance;
  if (gap > kDomainSlack && (gap > kLargestGap || apart > allowed))
    return failUse(SurfaceFault::TrimOpen, number), false;
  return true;
}

void ModelReader::checkUses() {
  for (uint32_t u = 0; u < m_.uses.size() && work_.tick(kLookCost); ++u)
    if (!m_.faces[m_.uses[u].face].isLeftOut) checkUse(u);
}

/// Numbers the vertices.
void ModelReader::unite() {
  const auto end = [&](uint32_t use, bool isAtEnd) {
    const ModelUse& u = m_.uses[use];
    return 2 * u.edge + uint32_t(isAtEnd != u.isReversed);
  };
  if (!charge_.add(6 * sizeof(uint32_t) * m_.edges.size())) return;
  UnionFind ends(uint32_t(2 * m_.edges.size()));
  for (uint32_t u = 0; u < m_.uses.size(); ++u)
    if (!m_.faces[m_.uses[u].face].isLeftOut) ends.unite(end(u, true), end(m_.after(u), false));
  for (uint32_t e = 0; e < m_.edges.size(); ++e)
    if (m_.edges[e].isDegenerate) ends.unite(2 * e, 2 * e + 1);
  // Loops that touch do so at a vertex of both.
  struct Corner {
    Point2 at;
    uint32_t end;
  };
  std::vector<Corner> corners;
  for (const ModelFace& face : m_.faces) {
    if (face.isLeftOut || face.endLoop - face.firstLoop < 2) continue;
    corners.clear();
    Vec3 low, high;
    domainOf(face, 0, low, high);
    const Vec3 near = kDomainSlack * (high - low);
    for (uint32_t use = m_.loops[face.firstLoop].firstUse; use < m_.loops[face.endLoop - 1].endUse;
         ++use) {
      const ModelEdge& edge = m_.edges[m_.uses[use].edge];
      if (edge.isDegenerate) continue;
      const Corner corner{m_.uses[use].curve.at(m_.uses[use].isReversed ? edge.to : edge.from),
                          end(use, false)};
      if (!push(corners, corner, charge_)) return;
    }
    sf::sort(corners.begin(), corners.end(),
             [](const Corner& a, const Corner& b) { return a.at.x < b.at.x; });
    // Runs of corners with nearly the same u can be long; in each by v.
    for (size_t first = 0, last = 0; first < corners.size(); first = last) {
      do ++last;
      while (last < corners.size() && corners[last].at.x - corners[last - 1].at.x <= near.x);
      sf::sort(corners.begin() + first, corners.begin() + last,
               [](const Corner& a, const Corner& b) { return a.at.y < b.at.y; });
      for (size_t i = first; i < last; ++i)
        for (size_t k = i + 1; k < last && corners[k].at.y - corners[i].at.y <= near.y; ++k)
          if (std::fabs(corners[k].at.x - corners[i].at.x) <= near.x)
            ends.unite(corners[i].end, corners[k].end);
    }
    if (!work_.tick(100 * corners.size())) return;
  }
  std::vector<uint32_t> numbers(2 * m_.edges.size(), kNone);
  m_.vertices = 0;
  for (uint32_t e = 0; e < m_.edges.size(); ++e)
    for (const bool isAtEnd : {false, true}) {
      uint32_t& number = numbers[ends.rootOf(2 * e + uint32_t(isAtEnd))];
      if (number == kNone) number = m_.vertices++;
      (isAtEnd ? m_.edges[e].toVertex : m_.edges[e].fromVertex) = number;
    }
}

}  // namespace

bool findFault(const NurbsSurfaceView& surface, SurfaceFault& fault) {
  if (findFault(surface.poles, surface.weights, fault)) return true;
  fault = SurfaceFault::NotFinite;
  return !areInReach(surface.poles);
}

bool runsWithEdge(const Model& model, uint32_t number, Work& work) {
  const ModelUse& use = model.uses[number];
  const ModelEdge& edge = model.edges[use.edge];
  const ModelUse& first = model.uses[edge.firstUse];
  if (!edge.curve && !edge.isDegenerate && edge.firstUse == number) return true;
  const Vec3 begin = onSurface(model, use, edge.from);
  return allAlong(model, edge, &use, work, [&](double t) {
    const Vec3 at = edge.isDegenerate ? begin
                    : edge.curve      ? edge.curve->placeAt(t)
                                      : onSurface(model, first, t);
    return distance(onSurface(model, use, t), at) <= model.slack + edge.tolerance;
  });
}

bool staysInDomain(const Model& model, uint32_t number, double share) {
  const ModelUse& use = model.uses[number];
  const ModelEdge& edge = model.edges[use.edge];
  Vec3 low, high;
  domainOf(model.faces[use.face], share, low, high);
  return liesWithin(use.curve.curve(), edge.from, edge.to, low, high);
}

bool readModel(const ModelArrays& arrays, Work& work, Charge& charge, Model& model,
               std::vector<ModelFault>& faults) {
  ModelReader reader(arrays, work, charge, model);
  if (!reader.read()) return model = {}, false;
  reader.findBox();
  reader.checkSize();
  reader.runAroundDomains();
  reader.countUses();
  reader.findPoints();
  reader.findCurves();
  reader.checkUses();
  if (!work.going()) return model = {}, false;
  // Of the faces that are left.
  reader.countUses();
  reader.findBox();
  reader.unite();
  faults.swap(reader.faults);
  std::stable_sort(faults.begin(), faults.end(),
                   [](const ModelFault& a, const ModelFault& b) { return a.face < b.face; });
  if (!work.going()) model = {};
  return work.going();
}

}  // namespace sf
