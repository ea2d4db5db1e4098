#include "surface/density.h"
#include <cstdio>
#include <cstdlib>

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
  // The columns that overlap with it.
  const auto first = std::upper_bound(columns_.begin(), columns_.end(), a,
                                      [](double t, const Column& c) { return t < c.to; });
  const auto end = std::lower_bound(first, columns_.end(), b,
                                    [](const Column& c, double t) { return c.from < t; });
  double form = 0, turn = 0, twist = 0, speed = 0;
  for (auto c = first; c != end; ++c)
    form = std::max(form, c->form), turn = std::max(turn, c->turn),
    twist = std::max(twist, c->twist),
    speed += c->speed * (std::min(b, c->to) - std::max(a, c->from));
  const double h = b - a;
  Node node;
  node.a = a, node.b = b;
  node.error = form * h * h / 8;
  node.turn = turn * h, node.twist = twist * h;
  node.length = speed;
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

/// Columns without values, some in each span, within a range; a surface is looked at in the middle of each.
std::vector<LineTree::Column> columnsIn(const BezierSpans& spans, double from, double to) {
  std::vector<LineTree::Column> columns;
  const uint32_t count = spans.degree() + (spans.degree() < 3 ? 2 : 1);
  for (uint32_t s = 0; s < spans.count(); ++s) {
    const double a = std::max(spans.breaks()[s], from), b = std::min(spans.breaks()[s + 1], to);
    if (!(a < b)) continue;
    // Narrower towards the ends, where splines have their largest second derivatives.
    const auto place = [&](uint32_t i) {
      return i == count ? b : a + (b - a) * 0.5 * (1 - std::cos(kPi * i / count));
    };
    for (uint32_t i = 0; i < count; ++i) columns.push_back({place(i), place(i + 1), 0, 0, 0, 0});
  }
  return columns;
}

double middleOf(const LineTree::Column& column) { return 0.5 * (column.from + column.to); }

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

/// The length of intervals of which half of a tree's length is made, from the longest on. The many short ones at a narrow
/// bend are not usual.
double usualLength(const LineTree& tree, const LineTree::Choice& choice) {
  std::vector<double> lengths;
  double total = 0;
  for (const uint32_t n : choice.nodes) {
    lengths.push_back(tree.length(n));
    total += lengths.back();
  }
  std::sort(lengths.begin(), lengths.end());
  double above = 0;
  size_t i = lengths.size();
  while (i > 1 && above < total / 2) above += lengths[--i];
  return lengths[std::min(i, lengths.size() - 1)];
}

}  // namespace

double Density::longest(const Lines& lines) const {
  if (lines.u.nodes.size() == 1 && lines.v.nodes.size() == 1) return Sampling::kNoLimit;
  return std::max(usualLength(u, lines.u), usualLength(v, lines.v));
}

Density::Density(const NurbsSurface& surface, Box2 box) {
  std::vector<LineTree::Column> columnsU = columnsIn(surface.u(), box.u0, box.u1),
                                columnsV = columnsIn(surface.v(), box.v0, box.v1);
  const size_t nu = columnsU.size(), nv = columnsV.size();
  std::vector<double> us, vs;
  for (const auto& c : columnsU) us.push_back(middleOf(c));
  for (const auto& c : columnsV) vs.push_back(middleOf(c));
  double twist = 0, size = 0;
  for (size_t i = 0; i < nu; ++i)
    for (size_t j = 0; j < nv; ++j) {
      const SurfacePoint p = surface.at(us[i], vs[j]);
      least = i + j == 0 ? p.at : lowest(least, p.at);
      greatest = i + j == 0 ? p.at : highest(greatest, p.at);
      const Vec3 m = p.normal();
      const double area = length(m), speedU = length(p.u), speedV = length(p.v);
      LineTree::Column &cu = columnsU[i], &cv = columnsV[j];
      cu.speed += speedU * (cv.to - cv.from) / (box.v1 - box.v0);
      cv.speed += speedV * (cu.to - cu.from) / (box.u1 - box.u0);
      size = std::max({size, speedU * (box.u1 - box.u0), speedV * (box.v1 - box.v0)});
      if (!(area > 1e-12 * speedU * speedV)) continue;
      const Vec3 n = (1 / area) * m;
      cu.form = std::max(cu.form, std::fabs(dot(n, p.uu)));
      cv.form = std::max(cv.form, std::fabs(dot(n, p.vv)));
      const double mixed = std::fabs(dot(n, p.uv));
      cu.twist = std::max(cu.twist, mixed), cv.twist = std::max(cv.twist, mixed);
      twist = std::max(twist, mixed);
      // How fast the unit normal turns: the part of its derivative across it.
      const Vec3 mu = cross(p.uu, p.v) + cross(p.u, p.uv), mv = cross(p.uv, p.v) + cross(p.u, p.vv);
      cu.turn = std::max(cu.turn, length(mu - dot(mu, n) * n) / area);
      cv.turn = std::max(cv.turn, length(mv - dot(mv, n) * n) / area);
    }
  speedU_ = speedV_ = 0;
  for (const auto& c : columnsU) speedU_ += c.speed * (c.to - c.from) / (box.u1 - box.u0);
  for (const auto& c : columnsV) speedV_ += c.speed * (c.to - c.from) / (box.v1 - box.v0);
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
    bool isOff = true;
    for (uint32_t k = 0; k < kMostDepth && isOff; ++k) {
      isOff = false;
      std::vector<double> us, vs;
      u.lines(lines.u, us), v.lines(lines.v, vs);
      std::vector<uint8_t> halvedU(us.size() - 1), halvedV(vs.size() - 1);
      for (size_t i = 0; i + 1 < us.size(); ++i)
        for (size_t j = 0; j + 1 < vs.size(); ++j) {
          const uint32_t nu = lines.u.nodes[i], nv = lines.v.nodes[j];
          const double hu = us[i + 1] - us[i], hv = vs[j + 1] - vs[j];
          if (std::min(u.twist(nu) * hv, v.twist(nv) * hu) <= 4 * tolerance) continue;
          (u.length(nu) >= v.length(nv) ? halvedU[i] : halvedV[j]) = 1;
          isOff = true;
        }
      u.halve(halvedU, lines.u), v.halve(halvedV, lines.v);
    }
  }
  if (isFlat() || fineness.aspect() == Sampling::kNoLimit) return;
  if (lines.u.nodes.size() == 1 && lines.v.nodes.size() == 1) return;
  const double lu = usualLength(u, lines.u), lv = usualLength(v, lines.v);
  if (getenv("DBG"))
    fprintf(stderr, "lines %zu %zu len %g %g tol %g\n", lines.u.nodes.size(), lines.v.nodes.size(),
            lu, lv, tolerance);
  u.shorten(fineness.aspect() * lv, lines.u);
  v.shorten(fineness.aspect() * lu, lines.v);
}

}  // namespace sf
