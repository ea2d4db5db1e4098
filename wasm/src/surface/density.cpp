#include "surface/density.h"

#include <algorithm>
#include <cmath>

namespace sf {
namespace {

constexpr uint32_t kMostDepth = 20;
/// A form that moves a surface by less than this share of its size is rounding.
constexpr double kRounding = 1e-12;

}  // namespace

LineTree::LineTree(std::vector<Column> columns, std::vector<double> breaks)
    : columns_(std::move(columns)) {
  for (const Column& column : columns_)
    if (column.form > 0 || column.turn > 0) isFlat_ = false;
  for (size_t i = 0; i + 1 < breaks.size(); ++i) add(breaks[i], breaks[i + 1]);
  roots_ = uint32_t(nodes_.size());
}

uint32_t LineTree::add(double a, double b) {
  // The columns within, and the next one on either side.
  const auto before = [](const Column& c, double t) { return c.at < t; };
  auto first = std::lower_bound(columns_.begin(), columns_.end(), a, before);
  auto end = std::lower_bound(first, columns_.end(), b, before);
  if (first != columns_.begin() && (first == columns_.end() || first->at > a)) --first;
  if (end != columns_.end()) ++end;
  double form = 0, turn = 0, speed = 0;
  for (auto c = first; c != end; ++c)
    form = std::max(form, c->form), turn = std::max(turn, c->turn), speed += c->speed;
  const double h = b - a;
  Node node;
  node.a = a, node.b = b;
  node.error = form * h * h / 8;
  node.turn = turn * h;
  node.length = speed / double(std::max<ptrdiff_t>(end - first, 1)) * h;
  nodes_.push_back(node);
  return uint32_t(nodes_.size()) - 1;
}

uint32_t LineTree::childOf(uint32_t node) {
  if (nodes_[node].child == kNone) {
    const double a = nodes_[node].a, b = nodes_[node].b, middle = 0.5 * (a + b);
    const uint32_t first = add(a, middle);
    add(middle, b);
    nodes_[node].child = first;
  }
  return nodes_[node].child;
}

template <class F>
void LineTree::refine(F&& isHalved, Choice& choice) {
  std::vector<uint32_t> open(choice.nodes.rbegin(), choice.nodes.rend());
  choice.nodes.clear();
  choice.error = 0;
  const double least = std::ldexp(nodes_[roots_ - 1].b - nodes_[0].a, -int(kMostDepth));
  while (!open.empty()) {
    const uint32_t n = open.back();
    open.pop_back();
    if (nodes_[n].b - nodes_[n].a > least && isHalved(nodes_[n])) {
      const uint32_t child = childOf(n);
      open.push_back(child + 1), open.push_back(child);
    } else {
      choice.nodes.push_back(n);
      choice.error = std::max(choice.error, nodes_[n].error);
    }
  }
}

void LineTree::choose(double error, double turn, double hysteresis, Choice& choice) {
  choice.nodes.resize(roots_);
  for (uint32_t i = 0; i < roots_; ++i) choice.nodes[i] = i;
  refine(
      [&](const Node& n) {
        const double allowed = n.isHalved ? hysteresis : 1;
        return n.error > error * allowed || n.turn > turn * allowed;
      },
      choice);
}

void LineTree::shorten(double longest, Choice& choice) {
  refine([&](const Node& n) { return n.length > longest; }, choice);
}

void LineTree::halve(const std::vector<uint8_t>& halved, Choice& choice) {
  std::vector<uint32_t> nodes;
  choice.error = 0;
  const double least = std::ldexp(nodes_[roots_ - 1].b - nodes_[0].a, -int(kMostDepth));
  for (size_t i = 0; i < choice.nodes.size(); ++i) {
    const uint32_t n = choice.nodes[i];
    if (halved[i] && nodes_[n].b - nodes_[n].a > least) {
      const uint32_t child = childOf(n);
      nodes.push_back(child), nodes.push_back(child + 1);
    } else {
      nodes.push_back(n);
    }
  }
  choice.nodes.swap(nodes);
  for (const uint32_t n : choice.nodes) choice.error = std::max(choice.error, nodes_[n].error);
}

void LineTree::keep(const Choice& choice) {
  for (Node& n : nodes_) n.isHalved = n.child != kNone;
  for (const uint32_t n : choice.nodes) {
    // Nothing below it is halved.
    std::vector<uint32_t> open = {n};
    while (!open.empty()) {
      Node& node = nodes_[open.back()];
      open.pop_back();
      node.isHalved = false;
      if (node.child != kNone) open.push_back(node.child), open.push_back(node.child + 1);
    }
  }
}

void LineTree::lines(const Choice& choice, std::vector<double>& at) const {
  at.clear();
  for (const uint32_t n : choice.nodes) at.push_back(nodes_[n].a);
  at.push_back(nodes_[choice.nodes.back()].b);
}

namespace {

/// Values of one parameter to look at a surface: some in each span, within a range.
std::vector<double> placesIn(const BezierSpans& spans, double from, double to) {
  std::vector<double> places;
  const uint32_t count = spans.degree() + (spans.degree() < 3 ? 2 : 1);
  for (uint32_t s = 0; s < spans.count(); ++s) {
    const double a = std::max(spans.breaks()[s], from), b = std::min(spans.breaks()[s + 1], to);
    if (!(a < b)) continue;
    // Not at the ends: there derivatives are those of a neighbour.
    for (uint32_t i = 0; i < count; ++i) {
      const double x = (i + 0.5) / count;
      // Denser towards the ends, where splines have their largest second derivatives.
      places.push_back(a + (b - a) * 0.5 * (1 - std::cos(kPi * x)));
    }
  }
  return places;
}

/// A range's ends, and the creases within: knots of full multiplicity where tangents or normals jump.
std::vector<double> creasesIn(const BezierSpans& spans, double from, double to,
                              const std::vector<uint8_t>& isCrease) {
  std::vector<double> breaks = {from};
  const double least = 1e-9 * (to - from);
  for (uint32_t s = 1; s < spans.count(); ++s) {
    const double t = spans.breaks()[s];
    if (isCrease[s] && t > breaks.back() + least && t < to - least) breaks.push_back(t);
  }
  breaks.push_back(to);
  return breaks;
}

double usualLength(const LineTree& tree, const LineTree::Choice& choice) {
  std::vector<double> lengths;
  for (const uint32_t n : choice.nodes) lengths.push_back(tree.length(n));
  const auto middle = lengths.begin() + ptrdiff_t(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

}  // namespace

double Density::longest(const Lines& lines) const {
  if (lines.u.nodes.size() == 1 && lines.v.nodes.size() == 1) return Sampling::kNoLimit;
  return std::max(usualLength(u, lines.u), usualLength(v, lines.v));
}

Density::Density(const NurbsSurface& surface, Box2 box) {
  const std::vector<double> us = placesIn(surface.u(), box.u0, box.u1),
                            vs = placesIn(surface.v(), box.v0, box.v1);
  const size_t nu = us.size(), nv = vs.size();
  std::vector<LineTree::Column> columnsU(nu), columnsV(nv);
  for (size_t i = 0; i < nu; ++i) columnsU[i] = {us[i], 0, 0, 0};
  for (size_t j = 0; j < nv; ++j) columnsV[j] = {vs[j], 0, 0, 0};
  double twist = 0, size = 0;
  for (size_t i = 0; i < nu; ++i)
    for (size_t j = 0; j < nv; ++j) {
      const SurfacePoint p = surface.at(us[i], vs[j]);
      least = i + j == 0 ? p.at : lowest(least, p.at);
      greatest = i + j == 0 ? p.at : highest(greatest, p.at);
      const Vec3 m = p.normal();
      const double area = length(m), speedU = length(p.u), speedV = length(p.v);
      LineTree::Column &cu = columnsU[i], &cv = columnsV[j];
      cu.speed += speedU / double(nv), cv.speed += speedV / double(nu);
      size = std::max({size, speedU * (box.u1 - box.u0), speedV * (box.v1 - box.v0)});
      if (!(area > 1e-12 * speedU * speedV)) continue;
      const Vec3 n = (1 / area) * m;
      cu.form = std::max(cu.form, std::fabs(dot(n, p.uu)));
      cv.form = std::max(cv.form, std::fabs(dot(n, p.vv)));
      twist = std::max(twist, std::fabs(dot(n, p.uv)));
      // How fast the unit normal turns: the part of its derivative across it.
      const Vec3 mu = cross(p.uu, p.v) + cross(p.u, p.uv), mv = cross(p.uv, p.v) + cross(p.u, p.vv);
      cu.turn = std::max(cu.turn, length(mu - dot(mu, n) * n) / area);
      cv.turn = std::max(cv.turn, length(mv - dot(mv, n) * n) / area);
    }
  speedU_ = speedV_ = 0;
  for (const auto& c : columnsU) speedU_ += c.speed / double(nu);
  for (const auto& c : columnsV) speedV_ += c.speed / double(nv);
  const double du = box.u1 - box.u0, dv = box.v1 - box.v0;
  const auto round = [&](LineTree::Column& c, double width) {
    if (c.form * width * width < kRounding * size) c.form = 0;
    if (c.turn * width < 1e-9) c.turn = 0;
  };
  for (auto& c : columnsU) round(c, du);
  for (auto& c : columnsV) round(c, dv);
  for (const auto& c : columnsU) formU_ = std::max(formU_, c.form);
  for (const auto& c : columnsV) formV_ = std::max(formV_, c.form);
  twist_ = twist * du * dv < kRounding * size ? 0 : twist;
  // Creases: where the directions of derivatives on both sides of a break differ.
  const auto findCreases = [&](const BezierSpans& spans, const std::vector<double>& across,
                               bool alongU) {
    std::vector<uint8_t> isCrease(spans.count() + 1, 0);
    for (uint32_t s = 1; s < spans.count(); ++s) {
      const double t = spans.breaks()[s];
      const double before = t - 1e-7 * (t - spans.breaks()[s - 1]);
      for (const double w : across) {
        const SurfacePoint a = alongU ? surface.at(before, w) : surface.at(w, before),
                           b = alongU ? surface.at(t, w) : surface.at(w, t);
        const Vec3 da = alongU ? a.u : a.v, db = alongU ? b.u : b.v;
        if (angleBetween(da, db) > 1e-3) isCrease[s] = 1;
      }
    }
    return isCrease;
  };
  u = LineTree(std::move(columnsU),
               creasesIn(surface.u(), box.u0, box.u1, findCreases(surface.u(), vs, true)));
  v = LineTree(std::move(columnsV),
               creasesIn(surface.v(), box.v0, box.v1, findCreases(surface.v(), us, false)));
}

void Density::choose(double tolerance, const Fineness& fineness, Lines& lines) {
  const double turn = fineness.angle() < kPi ? fineness.angle() : Sampling::kNoLimit;
  // The errors of both directions add up: of all ways to share the tolerance, the one with the fewest cells.
  constexpr double kShares[] = {1, 0.75, 0.5, 0.25, 0.125};
  Density::Lines best;
  double fewest = Sampling::kNoLimit;
  LineTree::Choice byShare[5];
  for (int k = 0; k < 5; ++k)
    v.choose(kShares[k] * tolerance, turn, fineness.hysteresis(), byShare[k]);
  for (const double share : kShares) {
    LineTree::Choice cu;
    u.choose(share * tolerance, turn, fineness.hysteresis(), cu);
    for (const LineTree::Choice& cv : byShare) {
      if (cu.error + cv.error > tolerance) continue;
      const double cells = double(cu.nodes.size()) * double(cv.nodes.size());
      if (cells >= fewest) break;
      fewest = cells, best.u = cu, best.v = cv;
      break;
    }
  }
  if (fewest == Sampling::kNoLimit) {
    u.choose(tolerance / 2, turn, 1, best.u);
    v.choose(tolerance / 2, turn, 1, best.v);
  }
  lines = best;
  // A twisted surface that is straight along both parameters is off by a quarter of its twist.
  if (twist_ > 0 && tolerance < Sampling::kNoLimit) {
    for (int k = 0; k < 2 * int(kMostDepth); ++k) {
      std::vector<double> us, vs;
      u.lines(lines.u, us), v.lines(lines.v, vs);
      double hu = 0, hv = 0;
      for (size_t i = 0; i + 1 < us.size(); ++i) hu = std::max(hu, us[i + 1] - us[i]);
      for (size_t j = 0; j + 1 < vs.size(); ++j) hv = std::max(hv, vs[j + 1] - vs[j]);
      if (twist_ * hu * hv / 4 <= tolerance) break;
      const bool alongU = hu * speedU_ >= hv * speedV_;
      LineTree::Choice& longer = alongU ? lines.u : lines.v;
      std::vector<uint8_t> halved;
      const std::vector<double>& at = alongU ? us : vs;
      for (size_t i = 0; i + 1 < at.size(); ++i)
        halved.push_back(at[i + 1] - at[i] > 0.75 * (alongU ? hu : hv));
      (alongU ? u : v).halve(halved, longer);
    }
  }
  if (isFlat() || fineness.aspect() == Sampling::kNoLimit) return;
  if (lines.u.nodes.size() == 1 && lines.v.nodes.size() == 1) return;
  const double lu = usualLength(u, lines.u), lv = usualLength(v, lines.v);
  u.shorten(fineness.aspect() * lv, lines.u);
  v.shorten(fineness.aspect() * lu, lines.v);
}

}  // namespace sf
