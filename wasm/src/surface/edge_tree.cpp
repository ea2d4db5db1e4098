#include "surface/edge_tree.h"

#include <algorithm>
#include <cmath>

#include "base/sort.h"
#include "surface/density.h"

namespace sf {
namespace {

/// An interval shorter than this share of the edge is too short to be halved.
constexpr double kShortest = 1e-10;
/// Pieces that cross within this share of the edge from their common corner overshoot it.
constexpr double kOvershoot = 0.05;
/// Halving an interval of the whole edge this often makes it too short.
constexpr uint32_t kMostLevels = 40;
/// From this many samples on an edge gets no more: only nonsense has such.
constexpr size_t kMostSamples = 1 << 18;
/// Into how many pieces an interval is cut to be measured, if its curve is a single polynomial there.
constexpr uint32_t kPieces = 4, kMostPieces = 64;

double distanceFromChord(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 d = b - a;
  const double square = dot(d, d);
  const double x = square > 0 ? std::clamp(dot(p - a, d) / square, 0.0, 1.0) : 0;
  return distance(p, a + x * d);
}

/// Appends the parameters at which the edge crosses creases of the surface that it lies on.
void appendCrossings(const Model& model, const ModelEdge& edge, std::vector<double>& at) {
  const ModelUse& use = model.uses[edge.firstUse];
  const NurbsSurface& surface = *model.faces[use.face].surface;
  const uint32_t pieces = std::min(8 * use.curve.curve().spans().count(), 4000u);
  for (const bool alongU : {true, false}) {
    const std::vector<double> creases = creasesOf(surface, alongU);
    if (creases.empty()) continue;
    const auto value = [&](double t) { return alongU ? use.curve.at(t).x : use.curve.at(t).y; };
    double a = edge.from, va = value(a);
    for (uint32_t i = 1; i <= pieces; ++i) {
      const double b = edge.from + (edge.to - edge.from) * i / pieces, vb = value(b);
      for (const double crease : creases) {
        if ((va < crease) == (vb < crease)) continue;
        double low = a, high = b;
        for (int k = 0; k < 60 && low < high; ++k) {
          const double middle = 0.5 * (low + high);
          ((value(middle) < crease) == (va < crease) ? low : high) = middle;
        }
        at.push_back(high);
      }
      a = b, va = vb;
    }
  }
}

}  // namespace

EdgeTree::EdgeTree(const Model& model, uint32_t edge, ArrayView<const uint32_t> uses)
    : model_(&model), edge_(edge) {
  const ModelEdge& e = model.edges[edge];
  if (!e.isDegenerate) {
    if (e.curve) appendCorners(*e.curve, e.from, e.to, breaks_);
    for (const uint32_t u : uses) model.uses[u].curve.appendBreaks(e.from, e.to, breaks_);
    // A curve of space has its corners at its breaks; one that is none, where it crosses creases of its surface.
    if (!e.curve) appendCrossings(model, e, breaks_);
    sf::sort(breaks_.begin(), breaks_.end());
  }
  const double least = kShortest * (e.to - e.from);
  std::vector<double> kept = {e.from};
  for (const double t : breaks_)
    if (t - kept.back() > least && e.to - t > least) kept.push_back(t);
  kept.push_back(e.to);
  breaks_ = kept;
  for (const double t : breaks_) breakPoints_.push_back(at(t));
  for (size_t i = 0; i + 1 < breaks_.size(); ++i)
    add(breaks_[i], breakPoints_[i], breaks_[i + 1], breakPoints_[i + 1]);
  for (const Node& node : nodes_) middle_ = middle_ + (1.0 / double(nodes_.size())) * node.middle;
  for (const Node& node : nodes_)
    radius_ = std::max(radius_, distance(middle_, node.middle) + 0.5 * node.chord + node.error);
}

Vec3 EdgeTree::at(double t) const {
  const ModelEdge& e = model_->edges[edge_];
  if (e.curve) return e.curve->placeAt(t);
  const ModelUse& use = model_->uses[e.firstUse];
  const Point2 p = use.curve.at(t);
  return model_->faces[use.face].surface->tangentsAt(p.x, p.y).at;
}

/// How many spans of the edge's curve end between two parameters, or of the curve and the surface that it has in place of one.
uint32_t EdgeTree::spansBetween(double a, double b) const {
  const ModelEdge& e = model_->edges[edge_];
  const auto count = [](const BezierSpans& spans, double x, double y) {
    const uint32_t i = spans.spanAt(x), k = spans.spanAt(y);
    return i < k ? k - i : i - k;
  };
  if (e.curve) return count(e.curve->spans(), a, b);
  const ModelUse& use = model_->uses[e.firstUse];
  const NurbsSurface& surface = *model_->faces[use.face].surface;
  const Point2 p = use.curve.at(a), q = use.curve.at(b);
  return count(use.curve.curve().spans(), a, b) + count(surface.u(), p.x, q.x) +
         count(surface.v(), p.y, q.y);
}

uint32_t EdgeTree::add(double a, Vec3 from, double b, Vec3 to) {
  Node node{a, b, {}, 0, 0, distance(from, to), kNone, kNone, false, false, false};
  const uint32_t pieces = std::min(kPieces * (1 + spansBetween(a, b)), kMostPieces);
  Vec3 before{}, last = from;
  for (uint32_t i = 1; i <= pieces; ++i) {
    const Vec3 p = i == pieces ? to : at(a + (b - a) * i / pieces);
    const Vec3 secant = p - last;
    node.error = std::max(node.error, distanceFromChord(p, from, to));
    if (i > 1) node.turn += angleBetween(before, secant);
    if (2 * i == pieces) node.middle = p;
    before = secant, last = p;
  }
  // Secants turn by as much as the tangent does between their middles.
  node.turn *= double(pieces) / (pieces - 1);
  nodes_.push_back(node);
  return uint32_t(nodes_.size()) - 1;
}

void EdgeTree::halve(uint32_t node, Vec3 from, Vec3 to) {
  const Node n = nodes_[node];
  const double middle = 0.5 * (n.a + n.b);
  const uint32_t first = add(n.a, from, middle, n.middle);
  add(middle, n.middle, n.b, to);
  nodes_[node].child = first;
  nodes_[first].parent = nodes_[first + 1].parent = node;
}

void EdgeTree::select(const Fineness& fineness, double longest, std::vector<EdgeSample>& samples) {
  const ModelEdge& e = model_->edges[edge_];
  struct Open {
    uint32_t node;
    Vec3 from, to;
  };
  // Halves that wait: one for each level.
  Open open[kMostLevels];
  uint32_t waiting = 0;
  const double least = kShortest * (e.to - e.from);
  const bool isClosed = e.fromVertex == e.toVertex && !e.isDegenerate;
  Settled settled;
  settled.isSo = true, settled.angle = fineness.angle(), settled.hysteresis = fineness.hysteresis();
  for (uint32_t i = 0; i + 1 < breaks_.size(); ++i) {
    open[waiting++] = {i, breakPoints_[i], breakPoints_[i + 1]};
    while (waiting > 0) {
      const Open o = open[--waiting];
      Node* node = &nodes_[o.node];
      bool isHalved = false;
      if (!e.isDegenerate && node->b - node->a > 2 * least && waiting + 2 < kMostLevels &&
          samples.size() < kMostSamples) {
        const double allowed = node->isHalved ? fineness.hysteresis() : 1;
        const double tolerance =
            fineness.tolerance(node->middle, 0.5 * node->chord + node->error) * allowed;
        // A closed edge of fewer samples would enclose nothing.
        const bool isRound = isClosed && node->b - node->a > 0.3 * (e.to - e.from);
        const bool isAnyway = node->isForced || isRound || node->turn > fineness.angle() * allowed;
        isHalved =
            !node->isFrozen && (isAnyway || node->error > tolerance || node->chord > longest);
        if (!isHalved && !node->isFrozen) {
          settled.leafError = std::max(settled.leafError, node->error);
          settled.leafChord = std::max(settled.leafChord, node->chord);
        } else if (isHalved && !isAnyway) {
          double& least = node->error > tolerance ? settled.halvedError : settled.halvedChord;
          least = std::min(least, node->error > tolerance ? node->error : node->chord);
        }
      }
      node->isHalved = isHalved;
      if (!isHalved) {
        samples.push_back({node->a, o.from, o.node});
        continue;
      }
      if (node->child == kNone) halve(o.node, o.from, o.to), node = &nodes_[o.node];
      // The first half is the next to be looked at.
      open[waiting++] = {node->child + 1, node->middle, o.to};
      open[waiting++] = {node->child, o.from, node->middle};
    }
  }
  samples.push_back({e.to, breakPoints_.back(), kNone});
  settled_ = settled;
}

bool EdgeTree::isSettled(const Fineness& fineness, double longest) const {
  const Settled& s = settled_;
  if (!s.isSo || s.angle != fineness.angle() || s.hysteresis != fineness.hysteresis()) return false;
  const auto stays = [](double least, double allowed) {
    return least == Sampling::kNoLimit || least > allowed;
  };
  if (s.leafChord > longest || !stays(s.halvedChord, longest)) return false;
  const Fineness::Range allowed = fineness.range(middle_, radius_);
  return s.leafError <= allowed.least && stays(s.halvedError, s.hysteresis * allowed.greatest);
}

bool EdgeTree::freeze(uint32_t node) {
  settled_ = {};
  const auto relax = [&](uint32_t n) {
    if (nodes_[n].isForced) --forced_;
    nodes_[n].isForced = false;
  };
  relax(node);
  uint32_t up = nodes_[node].parent;
  while (up != kNone && nodes_[up].isForced && nodes_[up].parent != kNone)
    relax(up), up = nodes_[up].parent;
  if (up == kNone) return false;
  relax(up);
  nodes_[up].isFrozen = true;
  return true;
}

bool EdgeTree::overshoots(uint32_t node, uint32_t other) const {
  const Node &a = nodes_[nodes_[node].a < nodes_[other].a ? node : other],
             &b = nodes_[nodes_[node].a < nodes_[other].a ? other : node];
  if (b.a - a.b > kOvershoot * (breaks_.back() - breaks_.front())) return false;
  return std::any_of(breaks_.begin(), breaks_.end(),
                     [&](double t) { return a.b <= t && t <= b.a; });
}

bool EdgeTree::canHalve(uint32_t node) const {
  const ModelEdge& e = model_->edges[edge_];
  return !nodes_[node].isFrozen && !e.isDegenerate &&
         nodes_[node].b - nodes_[node].a > 2 * kShortest * (e.to - e.from);
}

bool EdgeTree::raise(uint32_t node, const Fineness& fineness) {
  if (!canHalve(node)) return false;
  settled_ = {};
  Node& n = nodes_[node];
  const double tolerance = fineness.tolerance(n.middle, 0.5 * n.chord + n.error);
  if (tolerance == Sampling::kNoLimit) return force(node);
  n.error = std::max(n.error, 1.001 * tolerance);
  return true;
}

bool EdgeTree::force(uint32_t node) {
  if (!canHalve(node)) return false;
  settled_ = {};
  if (!nodes_[node].isForced) ++forced_;
  nodes_[node].isForced = true;
  return true;
}

}  // namespace sf
