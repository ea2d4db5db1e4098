#include "polygon/strips/strip_flips.h"

#include <cmath>

#include "base/charge.h"

namespace sf {
namespace {

// How much thinner triangles may get to save indices, and how much while there are more than kMany
// indices a triangle. Measured: 2 costs half a degree of 18 of the mean smallest angle on random
// polygons, 4 costs 1.4.
constexpr double kThinner = 2, kMuchThinner = 4;
constexpr double kMany = 1.48;
// How far up a flip's effect is followed.
constexpr size_t kFarthest = 24;
constexpr size_t kRounds = 4;  // looks at each edge, on average at most

// The greatest cotangent of an angle of triangle a, b, c, which turns left: large where it is thin.
double thinness(Point2 a, Point2 b, Point2 c) {
  const double abx = b.x - a.x, aby = b.y - a.y, bcx = c.x - b.x, bcy = c.y - b.y;
  const double cax = a.x - c.x, cay = a.y - c.y, twiceArea = abx * bcy - aby * bcx;
  const double atA = -(abx * cax + aby * cay), atB = -(abx * bcx + aby * bcy);
  const double atC = -(bcx * cax + bcy * cay);
  return std::fmax(atA, std::fmax(atB, atC)) / twiceArea;
}

bool equal(const StripCosts& a, const StripCosts& b) {
  return a.ends == b.ends && a.turns[0][0] == b.turns[0][0] && a.turns[0][1] == b.turns[0][1] &&
         a.turns[1][0] == b.turns[1][0] && a.turns[1][1] == b.turns[1][1];
}

}  // namespace

/// Whether the shapes of the triangles allow a flip of edge h.
bool StripFlips::isFair(uint32_t h) const {
  const TriangleMesh& m = *mesh_;
  const uint32_t a = m.from(h), b = m.to(h), c = m.apex(h), d = m.apex(m.twins[h]);
  const Point2 p = m.metric[a], q = m.metric[b], r = m.metric[c], s = m.metric[d];
  const double now = std::fmax(thinness(p, q, r), thinness(q, p, s));
  const double then = std::fmax(thinness(p, s, r), thinness(q, r, s));
  if (!(then <= thinner_ * now)) return false;
  return m.orient(a, d, c) > 0 && m.orient(b, c, d) > 0;
}

/// Puts into above_ what changes above t if its costs become `costs`. Returns how much more the
/// whole then costs, without t itself; a large number if that is not known.
int StripFlips::changeAbove(uint32_t t, StripCosts costs) {
  constexpr int kUnknown = 1 << 20;
  const std::vector<uint32_t>& twins = mesh_->twins;
  int change = 0;
  above_.clear();
  for (StripCosts before = forest_.costs[t]; !equal(before, costs);) {
    const uint32_t in = forest_.up[t];
    if (in == kNone) return change;
    if (above_.size() == kFarthest) return kUnknown;
    const uint32_t upper = twins[in] / 3;
    StripForest::Below below = forest_.below(twins, upper);
    for (int place = 0; place < 3; ++place)
      if (below.costs[place] == &forest_.costs[t]) below.costs[place] = &costs;
    const StripCosts now = StripForest::costsOf(below);
    before = forest_.costs[upper];
    change += now.own - before.own;
    above_.push_back({upper, now});
    costs = now;
    t = upper;
  }
  return change;
}

/// Finds the result of flipping edge h, from a triangle to the one above it;
/// false if that saves no indices.
bool StripFlips::foresee(uint32_t h, Flip& flip) {
  // By TriangleMesh::flip triangle t of h gets the sides next(g) and prev(h), and triangle u of its
  // twin g the sides next(h) and prev(g).
  const uint32_t g = mesh_->twins[h], t = h / 3, u = g / 3;
  const auto costsAcross = [&](uint32_t side) {
    const uint32_t child = forest_.childAcross(mesh_->twins, side);
    return child == kNone ? nullptr : &forest_.costs[child];
  };
  const StripCosts* const byT[2] = {costsAcross(nextInTriangle(g)), costsAcross(prevInTriangle(h))};
  const StripCosts* const byU[2] = {costsAcross(nextInTriangle(h)), costsAcross(prevInTriangle(g))};
  const bool tIsUpper = forest_.up[u] == nextInTriangle(g);
  const bool isRoot = forest_.up[u] == kNone;
  // Counter-clockwise, t is h (once next(g)), the diagonal, prev(h), and u likewise.
  StripForest::Below low, high;
  const StripCosts* const* lower = tIsUpper ? byU : byT;
  low.costs[0] = lower[1], low.costs[1] = lower[0];
  flip.low = StripForest::costsOf(low);
  if (tIsUpper)
    high.costs[0] = &flip.low, high.costs[1] = byT[1];
  else if (isRoot)
    high.costs[0] = byU[0], high.costs[1] = &flip.low, high.costs[2] = byU[1];
  else
    high.costs[0] = byU[0], high.costs[1] = &flip.low;
  flip.high = StripForest::costsOf(high);
  flip.edge = h;
  flip.upper = tIsUpper ? t : u;
  flip.saved = forest_.costs[t].own + forest_.costs[u].own - flip.low.own - flip.high.own -
               changeAbove(u, flip.high);
  return flip.saved > 0;
}

void StripFlips::carryOut(const Flip& flip) {
  const uint32_t h = flip.edge, g = mesh_->twins[h], t = h / 3, u = g / 3;
  if (flip.upper == t) {
    forest_.up[t] = h;
    forest_.up[u] = nextInTriangle(g);
  } else {
    forest_.up[t] = nextInTriangle(h);
  }
  // Triangles below name their own half-edges, which stay; the roots' sides may turn around.
  mesh_->flip(h);
  forest_.costs[flip.upper] = flip.high;
  forest_.costs[flip.upper == t ? u : t] = flip.low;
  for (const Change& change : above_) forest_.costs[change.triangle] = change.costs;
}

/// Flips the edge from t upwards if that saves indices.
bool StripFlips::tryFlip(uint32_t t) {
  const uint32_t h = forest_.up[t];
  Flip flip;
  if (h == kNone || !isFair(h) || !foresee(h, flip)) return false;
  carryOut(flip);
  const uint32_t both[2] = {h / 3,
                            flip.upper == h / 3 ? mesh_->twins[nextInTriangle(h)] / 3 : flip.upper};
  for (const uint32_t s : both)
    for (uint32_t side = 3 * s; side < 3 * s + 3; ++side) {
      const uint32_t child = forest_.childAcross(mesh_->twins, side);
      waiting_.push_back(child == kNone ? s : child);
    }
  return true;
}

bool StripFlips::run(TriangleMesh& mesh, Work& work) {
  const uint64_t count = mesh.twins.size() / 3;
  Charge charge(work);
  if (!charge.add(count * (sizeof(StripCosts) + 24))) return false;
  mesh_ = &mesh;
  if (!forest_.grow(mesh.twins, work)) return false;
  for (const double thinner : {kThinner, kMuchThinner}) {
    thinner_ = thinner;
    waiting_.assign(forest_.order.rbegin(), forest_.order.rend());
    for (size_t i = 0; i < waiting_.size() && i < kRounds * count; ++i) {
      tryFlip(waiting_[i]);
      if (!work.tick(256)) return false;
    }
    if (double(cost()) <= (kMany - 1) * StripForest::kIndex * double(count)) break;
  }
  return true;
}

}  // namespace sf
