#include "surface/missing_curves.h"

#include <algorithm>
#include <cmath>

#include "surface/inversion.h"

namespace sf {
namespace {

/// Consecutive curves may be this much of the domain apart if they meet in space.
constexpr double kLargestGap = 0.05;
/// A curve that leaves the domain by less, in its size, is drawn in if that is within tolerance.
constexpr double kOverhang = 0.02;
/// A curve that stays this near to the border, in the domain's size, runs along it.
constexpr double kBorder = 1e-6;
/// Most choices that are tried for one loop.
constexpr size_t kMostChoices = 20000;
/// Bytes of a piece of a curve, with the factors that it is made by.
constexpr uint64_t kPieceBytes = 400;

Point2 operator+(Point2 a, Point2 b) { return {a.x + b.x, a.y + b.y}; }
Point2 operator-(Point2 a, Point2 b) { return {a.x - b.x, a.y - b.y}; }
Point2 operator*(double s, Point2 a) { return {s * a.x, s * a.y}; }

/// Brings a joint that is outside, in one coordinate, to the border. From there the curve cannot lead out: the points beside
/// the joint go no further. Those of other joints may well lie outside while the curve does not.
void keepWithin(std::vector<Point2>& points, size_t joint, double low, double high,
                double Point2::*coordinate) {
  double& at = points[joint].*coordinate;
  if (at > low && at < high) return;
  at = std::clamp(at, low, high);
  const size_t first = joint - (joint > 0), last = std::min(joint + 1, points.size() - 1);
  double off = 0;
  bool leadsOut = false;
  for (const size_t i : {first, last}) {
    double& x = points[i].*coordinate;
    leadsOut |= x < low || x > high;
    x = std::clamp(x, low, high);
    off = std::max(off, std::fabs(x - at));
  }
  // Along the border there is no corner.
  if (leadsOut && off <= kBorder * (high - low))
    points[first].*coordinate = points[last].*coordinate = at;
}

/// A use of a loop, and where its curve can lie.
struct Placed {
  uint32_t use;
  bool isGiven = false,
       isFree = false;         // free: degenerate, it runs wherever its neighbours leave it
  FoundCurve curve;            // by the edge's parameter
  std::vector<Point2> shifts;  // by which it may be moved
  Point2 from{}, to{};         // its ends in the order of the loop, not moved
};

class LoopFiller {
 public:
  LoopFiller(Model& model, const Inversion& surface, double slack, Work& work, Charge& charge)
      : m_(model), surface_(surface), slack_(slack), work_(work), charge_(charge) {}
  bool fill(uint32_t loop);
  /// The use whose curve is not found, or kNone. Others of its loop then have none either.
  uint32_t lost() const { return lost_; }

 private:
  const ModelEdge& edgeOf(const Placed& p) const { return m_.edges[m_.uses[p.use].edge]; }
  double slackOf(const Placed& p) const { return slack_ + edgeOf(p).tolerance; }
  bool place(Placed& p);
  void findShifts(Placed& p) const;
  bool liesWithin(const Placed& p, Point2 shift) const;
  bool meet(const Placed& a, Point2 end, const Placed& b, Point2 begin, bool isFree) const;
  void choose();
  bool follows(size_t i) const;
  bool meetsAsChosen(size_t ia, size_t ib, bool isFree) const;
  void judge();
  void search();
  double area() const;
  size_t next(size_t i) const { return i + 1 == loop_.size() ? 0 : i + 1; }
  void joinEnds(size_t a, size_t b);
  void runFree(size_t first);
  bool store(Placed& p);

  Model& m_;
  const Inversion& surface_;
  double slack_;
  Work& work_;
  Charge& charge_;
  std::vector<Placed> loop_;  // from a use that is not free
  std::vector<uint32_t> chosen_, best_;
  double bestArea_ = 0;
  double sense_ = 1;
  uint32_t lost_ = kNone;
};

/// What is known of a use before its neighbours are. False if its curve is not found.
bool LoopFiller::place(Placed& p) {
  const ModelUse& use = m_.uses[p.use];
  const ModelEdge& edge = m_.edges[use.edge];
  p.shifts.assign(1, {0, 0});
  if (use.curve.isFound()) {
    p.isGiven = true;
    p.from = use.curve.at(edge.from), p.to = use.curve.at(edge.to);
  } else if (edge.isDegenerate) {
    p.isFree = true;
    return true;
  } else {
    if (!edge.curve || !surface_.find(*edge.curve, edge.from, edge.to, slackOf(p), work_, p.curve))
      return false;
    findShifts(p);
    p.from = p.curve.points.front(), p.to = p.curve.points.back();
  }
  if (use.isReversed) std::swap(p.from, p.to);
  return true;
}

/// Whether a curve moved by whole periods is in the domain, or can be drawn in.
bool LoopFiller::liesWithin(const Placed& p, Point2 shift) const {
  const Point2 low = surface_.least(), high = surface_.greatest();
  const std::vector<Point2>& points = p.curve.points;
  for (size_t i = 0; i < points.size(); i += 3) {
    const Point2 at = points[i] + shift;
    const Point2 in{std::clamp(at.x, low.x, high.x), std::clamp(at.y, low.y, high.y)};
    if (in == at) continue;
    const double t = p.curve.breaks[i / 3];
    if (distance(surface_.placeAt(in), edgeOf(p).curve->placeAt(t)) > 0.5 * slackOf(p))
      return false;
  }
  return true;
}

void LoopFiller::findShifts(Placed& p) const {
  Point2 low = p.curve.points[0], high = low;
  for (size_t i = 3; i < p.curve.points.size(); i += 3) {
    const Point2 at = p.curve.points[i];
    low = {std::min(low.x, at.x), std::min(low.y, at.y)};
    high = {std::max(high.x, at.x), std::max(high.y, at.y)};
  }
  // The numbers of periods by which the box comes into the domain, or the one that brings it to the middle.
  struct Periods {
    double from, to, middle;
  };
  const auto periods = [](double a, double b, double least, double greatest, double period) {
    if (period == 0) return Periods{0, 0, 0};
    return Periods{std::ceil((least - a) / period - kOverhang),
                   std::floor((greatest - b) / period + kOverhang),
                   std::round((0.5 * (least + greatest) - 0.5 * (a + b)) / period)};
  };
  const Point2 least = surface_.least(), greatest = surface_.greatest(), size = surface_.period();
  const Periods u = periods(low.x, high.x, least.x, greatest.x, size.x),
                v = periods(low.y, high.y, least.y, greatest.y, size.y);
  p.shifts.clear();
  for (double i = u.from; i <= u.to; ++i)
    for (double k = v.from; k <= v.to; ++k) {
      const Point2 shift{i * size.x, k * size.y};
      if (liesWithin(p, shift)) p.shifts.push_back(shift);
    }
  if (p.shifts.empty()) p.shifts.push_back({u.middle * size.x, v.middle * size.y});
}

/// Whether one use ends where another begins. If degenerate edges lie between, they lead from one to the other.
bool LoopFiller::meet(const Placed& a, Point2 end, const Placed& b, Point2 begin,
                      bool isFree) const {
  const double allowed = slackOf(a) + slackOf(b);
  const Vec3 p = surface_.placeAt(end), q = surface_.placeAt(begin);
  if (distance(p, q) > allowed) return false;
  const Point2 way = begin - end, size = surface_.size();
  if (isFree) return distance(p, surface_.placeAt(end + 0.5 * way)) <= allowed;
  return std::max(std::fabs(way.x) / size.x, std::fabs(way.y) / size.y) <= kLargestGap;
}

/// Twice the area around which the loop runs as chosen.
double LoopFiller::area() const {
  double sum = 0;
  Point2 last{}, first{};
  bool isFirst = true;
  const auto add = [&](Point2 p) {
    if (isFirst)
      first = p, isFirst = false;
    else
      sum += (last.x - first.x) * (p.y - first.y) - (p.x - first.x) * (last.y - first.y);
    last = p;
  };
  for (size_t i = 0; i < loop_.size(); ++i) {
    const Placed& p = loop_[i];
    if (p.isFree) continue;
    const ModelUse& use = m_.uses[p.use];
    const Point2 shift = p.shifts[chosen_[i]];
    const size_t steps = p.isGiven ? 16 : p.curve.breaks.size() - 1;
    for (size_t k = 0; k <= steps; ++k) {
      const size_t s = use.isReversed ? steps - k : k;
      const ModelEdge& edge = edgeOf(p);
      add(p.isGiven ? use.curve.at(edge.from + (edge.to - edge.from) * double(s) / double(steps))
                    : p.curve.points[3 * s] + shift);
    }
  }
  return sum;
}

/// Whether use i begins where the last one before it ends that is not free, as both are chosen.
bool LoopFiller::follows(size_t i) const {
  if (i == 0 || loop_[i].isFree) return true;
  size_t before = i - 1;
  while (loop_[before].isFree) --before;
  return meetsAsChosen(before, i, before + 1 < i);
}

/// The same for two uses of the loop, with free ones between them or not.
bool LoopFiller::meetsAsChosen(size_t ia, size_t ib, bool isFree) const {
  const Placed &a = loop_[ia], &b = loop_[ib];
  return meet(a, a.to + a.shifts[chosen_[ia]], b, b.from + b.shifts[chosen_[ib]], isFree);
}

/// Keeps the choices made if the loop closes, and runs around more area than those kept so far.
void LoopFiller::judge() {
  size_t last = loop_.size() - 1;
  while (loop_[last].isFree) --last;
  if (!meetsAsChosen(last, 0, last + 1 < loop_.size())) return;
  const double area = sense_ * this->area();
  if (!best_.empty() && area <= bestArea_) return;
  bestArea_ = area, best_ = chosen_;
}

/// Tries the shifts of all uses, one after the other. Free ones have one, which counts for nothing.
void LoopFiller::search() {
  chosen_.assign(loop_.size(), 0), best_.clear();
  std::vector<uint32_t> next(loop_.size(), 0);
  size_t tries = kMostChoices + loop_.size();
  for (size_t i = 0;; --tries) {
    // Back to a use that has a shift left.
    while (next[i] == loop_[i].shifts.size()) {
      if (i == 0) return;
      --i;
    }
    if (tries == 0) return;
    chosen_[i] = next[i]++;
    if (!follows(i)) continue;
    if (i + 1 < loop_.size())
      next[++i] = 0;
    else
      judge();
  }
}

/// Chooses the shift of each use, and moves the curves found.
void LoopFiller::choose() {
  search();
  if (best_.empty()) best_.assign(loop_.size(), 0);
  const Point2 low = surface_.least(), high = surface_.greatest();
  for (size_t i = 0; i < loop_.size(); ++i) {
    Placed& p = loop_[i];
    if (p.isFree || p.isGiven) continue;
    const Point2 shift = p.shifts[best_[i]];
    std::vector<Point2>& points = p.curve.points;
    const bool isWithin = liesWithin(p, shift);
    for (Point2& at : points) at = at + shift;
    if (!isWithin) continue;
    for (size_t k = 0; k < points.size(); k += 3) {
      keepWithin(points, k, low.x, high.x, &Point2::x);
      keepWithin(points, k, low.y, high.y, &Point2::y);
    }
  }
}

/// Lets the end of one use and the beginning of the next be the same point, if they meet.
void LoopFiller::joinEnds(size_t ia, size_t ib) {
  Placed &a = loop_[ia], &b = loop_[ib];
  const auto end = [&](Placed& p, bool isAtEnd) {
    return isAtEnd != m_.uses[p.use].isReversed ? p.curve.points.size() - 1 : 0;
  };
  const size_t ea = a.isGiven ? 0 : end(a, true), eb = b.isGiven ? 0 : end(b, false);
  const Point2 pa = a.isGiven ? a.to : a.curve.points[ea],
               pb = b.isGiven ? b.from : b.curve.points[eb];
  if (!meet(a, pa, b, pb, false)) return;
  const Point2 low = surface_.least(), high = surface_.greatest();
  // What lies on the border stays there.
  const auto middle = [](double x, double y, double from, double to) {
    return x == from || x == to ? x : y == from || y == to ? y : 0.5 * (x + y);
  };
  const Point2 joint =
      a.isGiven   ? pa
      : b.isGiven ? pb
                  : Point2{middle(pa.x, pb.x, low.x, high.x), middle(pa.y, pb.y, low.y, high.y)};
  const auto move = [&](Placed& p, size_t at) {
    if (p.isGiven) return;
    // The point next to it as well: the direction stays.
    const size_t beside = at == 0 ? 1 : at - 1;
    p.curve.points[beside] = p.curve.points[beside] + (joint - p.curve.points[at]);
    p.curve.points[at] = joint;
  };
  move(a, ea), move(b, eb);
}

/// Lays the degenerate uses from this one on between their neighbours.
void LoopFiller::runFree(size_t first) {
  size_t count = 1;
  while (first + count < loop_.size() && loop_[first + count].isFree) ++count;
  const auto end = [&](const Placed& p, bool isAtEnd) {
    if (p.isGiven) return isAtEnd ? p.to : p.from;
    return isAtEnd != m_.uses[p.use].isReversed ? p.curve.points.back() : p.curve.points.front();
  };
  const Point2 from = end(loop_[first - 1], true),
               to = end(loop_[first + count == loop_.size() ? 0 : first + count], false);
  for (size_t k = 0; k < count; ++k) {
    Placed& p = loop_[first + k];
    const auto at = [&](size_t i) { return from + (double(i) / double(count)) * (to - from); };
    Point2 a = at(k), b = k + 1 == count ? to : at(k + 1);
    ModelUse& use = m_.uses[p.use];
    if (use.isReversed) std::swap(a, b);
    use.curve = TrimCurve(a, b, edgeOf(p).from, edgeOf(p).to);
  }
}

bool LoopFiller::store(Placed& p) {
  const size_t pieces = p.curve.breaks.size() - 1;
  if (!charge_.add(kPieceBytes * pieces)) return false;
  m_.uses[p.use].curve = TrimCurve(p.curve.breaks, p.curve.points);
  return true;
}

bool LoopFiller::fill(uint32_t number) {
  const ModelLoop& loop = m_.loops[number];
  // The first use that is not free begins the row.
  uint32_t begin = loop.firstUse;
  const auto isFree = [&](uint32_t u) {
    return !m_.uses[u].curve.isFound() && m_.edges[m_.uses[u].edge].isDegenerate;
  };
  while (begin < loop.endUse && isFree(begin)) ++begin;
  if (begin == loop.endUse) return true;
  loop_.clear();
  for (uint32_t u = begin, k = loop.firstUse; k < loop.endUse; ++k, u = m_.after(u)) {
    Placed p;
    p.use = u;
    if (!place(p)) return lost_ = u, false;
    loop_.push_back(std::move(p));
  }
  sense_ = loop.isOuter ? 1 : -1;
  choose();
  for (size_t i = 0; i < loop_.size(); ++i)
    if (!loop_[i].isFree && !loop_[next(i)].isFree) joinEnds(i, next(i));
  for (size_t i = 0; i < loop_.size(); ++i)
    if (loop_[i].isFree && !loop_[i - 1].isFree) runFree(i);
  for (Placed& p : loop_)
    if (!p.isFree && !p.isGiven && !store(p)) return false;
  return true;
}

}  // namespace

bool findMissingCurves(Model& model, uint32_t number, double slack, Work& work, Charge& charge,
                       uint32_t& lost) {
  lost = kNone;
  const ModelFace& face = model.faces[number];
  const auto isMissing = [&](uint32_t loop) {
    for (uint32_t u = model.loops[loop].firstUse; u < model.loops[loop].endUse; ++u)
      if (!model.uses[u].curve.isFound()) return true;
    return false;
  };
  std::vector<uint32_t> loops;
  for (uint32_t l = face.firstLoop; l < face.endLoop; ++l)
    if (isMissing(l)) loops.push_back(l);
  if (loops.empty()) return true;
  const Inversion surface(*face.surface, slack);
  LoopFiller filler(model, surface, slack, work, charge);
  for (const uint32_t l : loops)
    if (!filler.fill(l)) break;
  lost = filler.lost();
  return work.going();
}

}  // namespace sf
