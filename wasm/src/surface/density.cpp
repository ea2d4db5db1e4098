#include "surface/density.h"

#include <algorithm>
#include <cmath>

#include "base/sort.h"

namespace sf {
namespace {

constexpr uint32_t kMostDepth = 20;
/// A form that moves a surface by less than this share of its size is rounding.
constexpr double kRounding = 1e-12;
/// Tangents that turn by more than this, in radians, make a crease.
constexpr double kCrease = 1e-3;
constexpr int kMostLooks = 4;
/// Most cells of a grid.
constexpr double kMostCells = 1 << 21;
/// Most intervals of one parameter.
constexpr size_t kMostLines = 1 << 14;
/// How often more is allowed to keep to that; the last time makes everything allowed.
constexpr int kMostTries = 11;
constexpr double kHalfway = 1.38;
/// Cells up to this aspect have triangles beside them that are as good as can be in space.
constexpr double kLongCell = 4.5;
/// A face is divided into so many parts each way where a picture needs parts of it finer, and not if all of it may be as fine
/// as its nearest point at no more than this loss.
constexpr uint32_t kPartLevels = 4, kParts = 1u << kPartLevels;
constexpr double kOneTolerance = 0.7;
/// The most that is ever allowed, of the radius of a face's ball: past that a closed surface could become two sides of one triangle.
constexpr double kCoarsest = 0.15;
/// How often the smallest parts are quartered, to see which of it is shown and how near it is.
constexpr int kNearLevels = 7;
/// How many cells an interval of an edge may be long.
constexpr double kEdgeCells = 3;

}  // namespace

LineTree::LineTree(std::vector<Column> columns, std::vector<double> breaks)
    : columns_(std::move(columns)) {
  for (const Column& column : columns_)
    if (column.form > 0 || column.turn > 0) isFlat_ = false;
  for (size_t i = 0; i + 1 < breaks.size(); ++i) add(breaks[i], breaks[i + 1]);
  roots_ = uint32_t(nodes_.size());
  for (size_t i = 1; i + 1 < breaks.size(); ++i) creases_.push_back(breaks[i]);
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
  open_.assign(choice.nodes.rbegin(), choice.nodes.rend());
  std::vector<uint32_t>& open = open_;
  choice.nodes.clear();
  const double least = std::ldexp(nodes_[roots_ - 1].b - nodes_[0].a, -int(kMostDepth));
  while (!open.empty()) {
    const uint32_t n = open.back();
    open.pop_back();
    const bool isFull = choice.nodes.size() + open.size() > kMostLines;
    if (!isFull && nodes_[n].b - nodes_[n].a > least && isHalved(nodes_[n])) {
      const uint32_t child = childOf(n);
      open.push_back(child + 1), open.push_back(child);
    } else {
      choice.nodes.push_back(n);
    }
  }
}

template <class F>
void LineTree::choose(double share, F&& allowed, double turn, Choice& choice) {
  choice.nodes.resize(roots_);
  for (uint32_t i = 0; i < roots_; ++i) choice.nodes[i] = i;
  refine([&](const Node& n) { return n.error > share * allowed(n.a, n.b) || n.turn > turn; },
         choice);
  choice.error = 0;
  for (const uint32_t n : choice.nodes)
    if (nodes_[n].error > 0)
      choice.error = std::max(choice.error, nodes_[n].error / allowed(nodes_[n].a, nodes_[n].b));
}

void LineTree::shorten(double longest, Choice& choice) {
  refine([&](const Node& n) { return n.length > longest; }, choice);
}

void LineTree::halve(const std::vector<uint8_t>& halved, Choice& choice) {
  std::vector<uint32_t> nodes;
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

/// A range's ends, and the creases within.
std::vector<double> breaksIn(const std::vector<double>& creases, double from, double to) {
  std::vector<double> breaks = {from};
  const double least = 1e-9 * (to - from);
  for (const double t : creases)
    if (t > breaks.back() + least && t < to - least) breaks.push_back(t);
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
  sf::sort(lengths.begin(), lengths.end());
  double above = 0;
  size_t i = lengths.size();
  while (i > 1 && above < total / 2) above += lengths[--i];
  return lengths[std::min(i, lengths.size() - 1)];
}

/// Halves columns beside which a surface is quite another one: the peaks of heavy weights and of crowded knots are narrow.
/// Whether there were any.
bool refineColumns(std::vector<LineTree::Column>& columns) {
  constexpr double kUnlike = 4, kLittleTurn = 0.02;
  constexpr size_t kMostColumns = 160;
  const size_t count = columns.size();
  if (count >= kMostColumns) return false;
  std::vector<uint8_t> isHalved(count, 0);
  bool any = false;
  for (size_t i = 0; i + 1 < count; ++i) {
    const LineTree::Column &a = columns[i], &b = columns[i + 1];
    const double turnA = a.turn * (a.to - a.from), turnB = b.turn * (b.to - b.from);
    const auto isUnlike = [](double x, double y) {
      return std::max(x, y) > kUnlike * std::min(x, y);
    };
    if ((std::max(turnA, turnB) > kLittleTurn && isUnlike(a.turn, b.turn)) ||
        isUnlike(a.speed, b.speed))
      isHalved[i] = isHalved[i + 1] = 1, any = true;
  }
  if (!any) return false;
  std::vector<LineTree::Column> halved;
  for (size_t i = 0; i < count; ++i) {
    const double from = columns[i].from, to = columns[i].to, middle = 0.5 * (from + to);
    if (isHalved[i]) halved.push_back({from, middle, 0, 0, 0, 0});
    halved.push_back({isHalved[i] ? middle : from, to, 0, 0, 0, 0});
  }
  columns.swap(halved);
  return true;
}

}  // namespace

/// How many cells some lines make.
static double cellsOf(const Density::Lines& lines) {
  return double(lines.u.nodes.size()) * double(lines.v.nodes.size());
}

double Density::longest(const Lines& lines) const {
  if (lines.u.nodes.size() == 1 && lines.v.nodes.size() == 1) return Sampling::kNoLimit;
  return kEdgeCells * std::max(usualLength(u, lines.u), usualLength(v, lines.v));
}

std::vector<double> creasesOf(const NurbsSurface& surface, bool alongU) {
  const BezierSpans &spans = alongU ? surface.u() : surface.v(),
                    &others = alongU ? surface.v() : surface.u();
  std::vector<double> creases;
  for (uint32_t s = 1; s < spans.count(); ++s) {
    const double t = spans.breaks()[s], before = t - 1e-7 * (t - spans.breaks()[s - 1]);
    bool isCrease = false;
    for (uint32_t o = 0; o < others.count() && !isCrease; ++o)
      for (const double x : {0.15, 0.5, 0.85}) {
        const double w = others.breaks()[o] + x * (others.breaks()[o + 1] - others.breaks()[o]);
        const SurfacePoint a = alongU ? surface.at(before, w) : surface.at(w, before),
                           b = alongU ? surface.at(t, w) : surface.at(w, t);
        if (angleBetween(alongU ? a.u : a.v, alongU ? b.u : b.v) > kCrease) isCrease = true;
      }
    if (isCrease) creases.push_back(t);
  }
  return creases;
}

Point2 Density::shortening(const Lines& lines) const {
  const double lu = usualLength(u, lines.u), lv = usualLength(v, lines.v);
  if (isFlat() || !(lu > 0 && lv > 0)) return {1, 1};
  return {std::min(1.0, kLongCell * lv / lu), std::min(1.0, kLongCell * lu / lv)};
}

Density::Density(const NurbsSurface& surface, Box2 box) : box_(box) {
  std::vector<LineTree::Column> columnsU = columnsIn(surface.u(), box.u0, box.u1),
                                columnsV = columnsIn(surface.v(), box.v0, box.v1);
  for (int round = 0;; ++round) {
    look(surface, box, columnsU, columnsV);
    if (round == kMostLooks) break;
    const bool isRefined = refineColumns(columnsU);
    if (!refineColumns(columnsV) && !isRefined) break;
    // Halved columns are without values until they are looked at.
    for (auto* columns : {&columnsU, &columnsV})
      for (LineTree::Column& c : *columns) c = {c.from, c.to, 0, 0, 0, 0};
  }
  // Half of a usual span.
  const auto halfSpan = [](const BezierSpans& spans) {
    return 0.5 * (spans.breaks()[spans.count()] - spans.breaks()[0]) / spans.count();
  };
  farU_ = halfSpan(surface.u()), farV_ = halfSpan(surface.v());
  u = LineTree(std::move(columnsU), breaksIn(creasesOf(surface, true), box.u0, box.u1));
  v = LineTree(std::move(columnsV), breaksIn(creasesOf(surface, false), box.v0, box.v1));
}

/// Looks at the surface in the middle of all pairs of columns.
void Density::look(const NurbsSurface& surface, Box2 box, std::vector<LineTree::Column>& columnsU,
                   std::vector<LineTree::Column>& columnsV) {
  const double du = box.u1 - box.u0, dv = box.v1 - box.v0;
  bool isFirst = true;
  double size = 0;
  formU_ = formV_ = twist_ = speedU_ = speedV_ = 0;
  for (LineTree::Column& cu : columnsU)
    for (LineTree::Column& cv : columnsV) {
      const SurfacePoint p = surface.at(middleOf(cu), middleOf(cv));
      least = isFirst ? p.at : lowest(least, p.at);
      greatest = isFirst ? p.at : highest(greatest, p.at);
      isFirst = false;
      const Vec3 m = p.normal();
      const double area = length(m), speedU = length(p.u), speedV = length(p.v);
      cu.speed += speedU * (cv.to - cv.from) / dv, cv.speed += speedV * (cu.to - cu.from) / du;
      size = std::max({size, speedU * du, speedV * dv});
      if (!(area > 1e-12 * speedU * speedV)) continue;
      const Vec3 n = (1 / area) * m;
      cu.form = std::max(cu.form, std::fabs(dot(n, p.uu)));
      cv.form = std::max(cv.form, std::fabs(dot(n, p.vv)));
      const double mixed = std::fabs(dot(n, p.uv));
      cu.twist = std::max(cu.twist, mixed), cv.twist = std::max(cv.twist, mixed);
      // How fast the unit normal turns: the part of its derivative across it.
      const Vec3 mu = cross(p.uu, p.v) + cross(p.u, p.uv), mv = cross(p.uv, p.v) + cross(p.u, p.vv);
      cu.turn = std::max(cu.turn, length(mu - dot(mu, n) * n) / area);
      cv.turn = std::max(cv.turn, length(mv - dot(mv, n) * n) / area);
    }
  const auto round = [&](LineTree::Column& c, double width) {
    if (c.form * width * width < kRounding * size) c.form = 0;
    if (c.turn * width < 1e-9) c.turn = 0;
  };
  for (LineTree::Column& c : columnsU) {
    round(c, du);
    formU_ = std::max(formU_, c.form), twist_ = std::max(twist_, c.twist);
    speedU_ += c.speed * (c.to - c.from) / du;
  }
  for (LineTree::Column& c : columnsV) {
    round(c, dv);
    formV_ = std::max(formV_, c.form);
    speedV_ += c.speed * (c.to - c.from) / dv;
  }
  if (twist_ * du * dv < kRounding * size) twist_ = 0;
}

Allowance Density::allowanceOf(const NurbsSurface& surface, const Fineness& fineness) {
  // All of the face at once where that makes no difference.
  const Vec3 center = 0.5 * (least + greatest);
  const double radius = 0.55 * distance(least, greatest);
  const double finest = fineness.tolerance(center, radius);
  if (finest == Sampling::kNoLimit || finest > kOneTolerance * fineness.tolerance(center, 0))
    return Allowance(std::min(finest, kCoarsest * radius));
  if (balls_.empty()) findBalls(surface);
  std::vector<double> parts(kParts * kParts);
  fillParts(fineness, 0, 0, 0, parts);
  for (double& part : parts) part = std::min(part, kCoarsest * radius);
  return Allowance(box_, kParts, std::move(parts));
}

/// Where the balls of a level begin.
static uint32_t firstBall(uint32_t level) { return ((1u << 2 * level) - 1) / 3; }

void Density::findBalls(const NurbsSurface& surface) {
  // Nine places of each of the smallest parts, of which neighbours share those between them.
  constexpr uint32_t kPlaces = 2 * kParts + 1;
  std::vector<double> us, vs, at(3 * kPlaces * kPlaces), normals(at.size());
  for (uint32_t i = 0; i < kPlaces; ++i) {
    const double x = double(i) / (kPlaces - 1);
    us.push_back(box_.u0 + x * (box_.u1 - box_.u0)),
        vs.push_back(box_.v0 + x * (box_.v1 - box_.v0));
  }
  surface.grid(us, vs, at.data(), normals.data());
  const auto place = [&](uint32_t i, uint32_t j) {
    const double* p = &at[3 * (size_t(i) * kPlaces + j)];
    return Vec3{p[0], p[1], p[2]};
  };
  balls_.resize(firstBall(kPartLevels + 1));
  nets_.resize(kParts * kParts);
  for (uint32_t i = 0; i < kParts; ++i)
    for (uint32_t j = 0; j < kParts; ++j) {
      Net& net = nets_[i * kParts + j];
      net = {{place(2 * i, 2 * j), place(2 * i, 2 * j + 2), place(2 * i + 2, 2 * j),
              place(2 * i + 2, 2 * j + 2)},
             0};
      Ball& ball = balls_[firstBall(kPartLevels) + i * kParts + j];
      ball = {place(2 * i + 1, 2 * j + 1), 0};
      for (uint32_t k = 0; k < 9; ++k) {
        const Vec3 p = place(2 * i + k / 3, 2 * j + k % 3);
        ball.radius = std::max(ball.radius, distance(ball.middle, p));
        net.off = std::max(net.off, distance(p, net.at(0.5 * (k / 3), 0.5 * (k % 3))));
      }
      // What lies between may be a little farther out.
      ball.radius *= 1.1, net.off *= 1.5;
    }
  for (uint32_t level = kPartLevels; level-- > 0;)
    for (uint32_t i = 0; i < 1u << level; ++i)
      for (uint32_t j = 0; j < 1u << level; ++j) {
        Ball& ball = balls_[firstBall(level) + (i << level) + j];
        const auto child = [&](uint32_t k) -> const Ball& {
          return balls_[firstBall(level + 1) + ((2 * i + k / 2) << (level + 1)) + 2 * j + k % 2];
        };
        ball = {0.25 * (child(0).middle + child(1).middle + child(2).middle + child(3).middle), 0};
        for (uint32_t k = 0; k < 4; ++k)
          ball.radius =
              std::max(ball.radius, distance(ball.middle, child(k).middle) + child(k).radius);
      }
}

/// The finest tolerance of a net, from quarters of quarters where a camera is near.
double Density::finestOf(const Fineness& fineness, const Net& net, int levels) {
  const Vec3 middle = net.at(0.5, 0.5);
  double radius = 0;
  for (const Vec3& corner : net.corners) radius = std::max(radius, distance(middle, corner));
  const double finest = fineness.tolerance(middle, radius + net.off);
  if (levels == 0 || finest == Sampling::kNoLimit || radius < net.off ||
      finest > kOneTolerance * fineness.tolerance(middle, 0))
    return finest;
  double least = Sampling::kNoLimit;
  for (const double x : {0.0, 0.5})
    for (const double y : {0.0, 0.5}) {
      const Net quarter{
          {net.at(x, y), net.at(x, y + 0.5), net.at(x + 0.5, y), net.at(x + 0.5, y + 0.5)},
          net.off};
      least = std::min(least, finestOf(fineness, quarter, levels - 1));
    }
  return least;
}

/// Fills the parts of a quarter of a quarter, and so on: as one where its nearest point makes little difference.
void Density::fillParts(const Fineness& fineness, uint32_t level, uint32_t i, uint32_t j,
                        std::vector<double>& parts) const {
  const Ball& ball = balls_[firstBall(level) + (i << level) + j];
  double finest = fineness.tolerance(ball.middle, ball.radius);
  const bool isNear =
      finest < Sampling::kNoLimit && finest < kOneTolerance * fineness.tolerance(ball.middle, 0);
  if (isNear && level == kPartLevels) {
    finest = finestOf(fineness, nets_[i * kParts + j], kNearLevels);
  } else if (isNear) {
    for (uint32_t k = 0; k < 4; ++k)
      fillParts(fineness, level + 1, 2 * i + k / 2, 2 * j + k % 2, parts);
    return;
  }
  const uint32_t size = kParts >> level;
  for (uint32_t a = i * size; a < (i + 1) * size; ++a)
    std::fill(&parts[a * kParts + j * size], &parts[a * kParts + j * size] + size, finest);
}

void Density::choose(const Allowance& wanted, const Fineness& fineness, Lines& lines) {
  // A grid that does not fit into memory is made coarser; that the face is then off is measured and told.
  Allowance allowance = wanted;
  double turn = fineness.angle() < kPi ? fineness.angle() : Sampling::kNoLimit;
  for (int k = 0; k < kMostTries; ++k) {
    chooseAny(allowance, turn, lines);
    const double cells = cellsOf(lines);
    if (cells <= kMostCells) break;
    // About as many as errors are smaller; where there are as many as can be, that says nothing.
    const double factor = std::max(std::ldexp(1, 1 << k), cells / kMostCells);
    allowance = allowance.times(factor), turn *= factor;
  }
  shapeCells(fineness.aspect(), lines);
}

void Density::chooseAny(const Allowance& allowance, double turn, Lines& lines) {
  const auto allowedU = [&](double a, double b) { return allowance.betweenU(a, b); };
  const auto allowedV = [&](double a, double b) { return allowance.betweenV(a, b); };
  // The errors of both directions add up: of all ways to share what is allowed, the one with the fewest cells.
  constexpr double kShares[] = {1, 0.75, 0.5, 0.25, 0.125};
  u.choose(1, allowedU, turn, lines.u);
  v.choose(1, allowedV, turn, lines.v);
  if (cellsOf(lines) > kMostCells) return;
  // The most that each may be.
  if (lines.u.error + lines.v.error > 1) {
    Density::Lines best;
    double fewest = Sampling::kNoLimit;
    LineTree::Choice byShare[5];
    for (int k = 0; k < 5; ++k) v.choose(kShares[k], allowedV, turn, byShare[k]);
    for (const double share : kShares) {
      LineTree::Choice cu;
      u.choose(share, allowedU, turn, cu);
      for (const LineTree::Choice& cv : byShare) {
        if (cu.error + cv.error > 1) continue;
        const double cells = double(cu.nodes.size()) * double(cv.nodes.size());
        if (cells < fewest) fewest = cells, best.u = cu, best.v = cv;
        break;
      }
    }
    if (fewest == Sampling::kNoLimit) {
      u.choose(0.5, allowedU, turn, best.u);
      v.choose(0.5, allowedV, turn, best.v);
    }
    lines = best;
  }
  // A twisted surface that is straight along both parameters is off by a quarter of its twist.
  if (twist_ > 0 && allowance.least() < Sampling::kNoLimit) {
    bool isOff = true;
    for (uint32_t k = 0; k < kMostDepth && isOff && cellsOf(lines) <= kMostCells; ++k) {
      isOff = false;
      std::vector<double> us, vs;
      u.lines(lines.u, us), v.lines(lines.v, vs);
      std::vector<uint8_t> halvedU(us.size() - 1), halvedV(vs.size() - 1);
      for (size_t i = 0; i + 1 < us.size(); ++i)
        for (size_t j = 0; j + 1 < vs.size(); ++j) {
          const uint32_t nu = lines.u.nodes[i], nv = lines.v.nodes[j];
          const double hu = us[i + 1] - us[i], hv = vs[j + 1] - vs[j];
          const double off = std::min(u.twist(nu) * hv, v.twist(nv) * hu) / 4;
          if (off <= allowance.at({us[i] + hu / 2, vs[j] + hv / 2})) continue;
          (u.length(nu) >= v.length(nv) ? halvedU[i] : halvedV[j]) = 1;
          isOff = true;
        }
      u.halve(halvedU, lines.u), v.halve(halvedV, lines.v);
    }
  }
}

/// Halves intervals that are too long for their width.
void Density::shapeCells(double aspect, Lines& lines) {
  if (isFlat() || aspect == Sampling::kNoLimit) return;
  if (lines.u.nodes.size() == 1 && lines.v.nodes.size() == 1) return;
  const double lu = usualLength(u, lines.u), lv = usualLength(v, lines.v);
  if (!(lu > 0 && lv > 0)) return;
  // Halves are about as near to the aspect as what is a little shorter than this; cells that are nearly square rather stay so.
  double most = std::min(kHalfway, 0.6 + 0.45 * aspect) * aspect;
  // Where that would be too many, longer cells.
  const double cells = cellsOf(lines);
  most = std::max(most, std::max(lu / lv, lv / lu) * 2 * cells / kMostCells);
  u.shorten(most * lv, lines.u);
  v.shorten(most * lu, lines.v);
}

}  // namespace sf
