#include "surface/edge_tree.h"

#include <algorithm>
#include <cmath>

namespace sf {
namespace {

/// An interval shorter than this share of the edge is too short to be halved.
constexpr double kShortest = 1e-10;
/// Into how many pieces an interval is cut to be measured, if its curve is a single polynomial there.
constexpr uint32_t kPieces = 4, kMostPieces = 64;

double distanceFromChord(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 d = b - a;
  const double square = dot(d, d);
  const double x = square > 0 ? std::clamp(dot(p - a, d) / square, 0.0, 1.0) : 0;
  return distance(p, a + x * d);
}

}  // namespace

EdgeTree::EdgeTree(const Model& model, uint32_t edge) : model_(&model), edge_(edge) {
  const ModelEdge& e = model.edges[edge];
  if (!e.isDegenerate) {
    if (e.curve) appendCorners(*e.curve, e.from, e.to, breaks_);
    for (const ModelUse& use : model.uses)
      if (use.edge == edge) use.curve.appendBreaks(e.from, e.to, breaks_);
    std::sort(breaks_.begin(), breaks_.end());
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
}

Vec3 EdgeTree::at(double t) const {
  const ModelEdge& e = model_->edges[edge_];
  if (e.curve) return e.curve->at(t).at;
  const ModelUse& use = model_->uses[e.firstUse];
  const Point2 p = use.curve.at(t);
  return model_->faces[use.face].surface->at(p.x, p.y).at;
}

uint32_t EdgeTree::add(double a, Vec3 from, double b, Vec3 to) {
  Node node{a, b, {}, 0, 0, distance(from, to), kNone, false, false};
  uint32_t pieces = kPieces;
  const ModelEdge& e = model_->edges[edge_];
  if (e.curve) {
    const BezierSpans& spans = e.curve->spans();
    const uint32_t within = spans.spanAt(b) - spans.spanAt(a);
    pieces = std::min(kPieces * (within + 1), kMostPieces);
  }
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
}

void EdgeTree::select(const Fineness& fineness, double longest, std::vector<EdgeSample>& samples) {
  const ModelEdge& e = model_->edges[edge_];
  struct Open {
    uint32_t node;
    Vec3 from, to;
  };
  std::vector<Open> open;
  const double least = kShortest * (e.to - e.from);
  const bool isClosed = e.fromVertex == e.toVertex && !e.isDegenerate;
  for (uint32_t i = 0; i + 1 < breaks_.size(); ++i) {
    open.push_back({i, breakPoints_[i], breakPoints_[i + 1]});
    while (!open.empty()) {
      const Open o = open.back();
      open.pop_back();
      Node* node = &nodes_[o.node];
      bool isHalved = false;
      if (!e.isDegenerate && node->b - node->a > 2 * least) {
        const double allowed = node->isHalved ? fineness.hysteresis() : 1;
        const double tolerance =
            fineness.tolerance(node->middle, 0.5 * node->chord + node->error) * allowed;
        // A closed edge of fewer samples would enclose nothing.
        const bool isRound = isClosed && node->b - node->a > 0.3 * (e.to - e.from);
        isHalved = node->isForced || isRound || node->error > tolerance ||
                   node->turn > fineness.angle() * allowed || node->chord > longest;
      }
      node->isHalved = isHalved;
      if (!isHalved) {
        samples.push_back({node->a, o.from, o.node});
        continue;
      }
      if (node->child == kNone) halve(o.node, o.from, o.to), node = &nodes_[o.node];
      // The first half is the next to be looked at.
      open.push_back({node->child + 1, node->middle, o.to});
      open.push_back({node->child, o.from, node->middle});
    }
  }
  samples.push_back({e.to, breakPoints_.back(), kNone});
}

bool EdgeTree::force(uint32_t node) {
  const ModelEdge& e = model_->edges[edge_];
  if (e.isDegenerate || nodes_[node].b - nodes_[node].a <= 2 * kShortest * (e.to - e.from))
    return false;
  if (!nodes_[node].isForced) ++forced_;
  nodes_[node].isForced = true;
  return true;
}

}  // namespace sf
