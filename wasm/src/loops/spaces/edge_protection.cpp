#include "loops/spaces/edge_protection.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/charge.h"
#include "base/predicates.h"
#include "base/sort.h"
#include "delaunay/delaunay.h"

namespace sf {
namespace {

// Limits on where a piece is split, as shares of its length: next to an encroacher,
// and at a corner.
constexpr double kLeastShare = 0.3, kGreatestRadius = 0.9;
// The share of the missing pieces, most encroached upon first, that are split in one round.
constexpr double kWorstShare = 0.25;

class Protection {
 public:
  Protection(const LoopSet& loops, Work& work) : loops_(loops), work_(work), charge_(work) {}

  Status run(ProtectedLoops& result) {
    if (!start()) return work_.status();
    Status status = Status::Ok;
    while (status == Status::Ok && !missing_.empty()) status = splitMissing();
    if (status != Status::Ok) return status;
    return handBack(result);
  }

 private:
  // A vertex in the diametral ball of a missing piece of a loop edge.
  struct Encroacher {
    uint32_t vertex = kNone;
    double cosine = 0;  // of the angle at which it sees the piece
  };

  bool start();
  bool tetrahedralize(const std::vector<uint32_t>& ranks);
  bool findMissing();
  bool breakTies();
  void findEncroachers();
  void chooseWorst();
  double shareBefore(uint32_t a) const;
  Status splitMissing();
  Status handBack(ProtectedLoops& result);

  bool isInput(uint32_t v) const { return v < loops_.vertexCount(); }
  Vec3 positionAt(uint32_t edge, double t) const;

  const LoopSet& loops_;
  Work& work_;
  Charge charge_;
  int exponent_ = 0;
  std::optional<Tetrahedralization> cells_;
  // Vertices, input first. A piece of a loop edge is named by its first vertex.
  std::vector<Vec3> p_;                    // scaled
  std::vector<uint32_t> next_, previous_;  // along the loops
  std::vector<uint32_t> edge_;             // input edge of the piece, by its first vertex
  std::vector<double> t_;                  // place of the piece's first vertex on that edge
  std::vector<uint32_t> missing_;          // pieces that are no edges of the tetrahedralization
  std::vector<uint8_t> isPresent_;
  std::vector<Encroacher> encroacher_;  // of the missing pieces
};

bool Protection::start() {
  uint32_t n = loops_.vertexCount();
  constexpr size_t kBytesPerVertex =
      sizeof(Vec3) + 3 * sizeof(uint32_t) + sizeof(double) + 1 + sizeof(Encroacher);
  if (!charge_.add(uint64_t(n) * kBytesPerVertex)) return false;
  exponent_ = scaleToUnit(loops_.positions(), p_);
  next_.resize(n), previous_.resize(n), edge_.resize(n);
  t_.assign(n, 0);
  for (uint32_t v = 0; v < n; ++v) {
    next_[v] = loops_.next(v);
    previous_[v] = loops_.previous(v);
    edge_[v] = v;
  }
  if (!tetrahedralize({})) return false;
  return missing_.empty() || !cells_->hadTies() || breakTies();
}

bool Protection::tetrahedralize(const std::vector<uint32_t>& ranks) {
  cells_.emplace(work_);
  return cells_->add(p_, ranks) && findMissing();
}

bool Protection::findMissing() {
  missing_.clear();
  if (cells_->dimension() < 2) return true;
  isPresent_.assign(p_.size(), 0);
  cells_->forEachEdge([&](uint32_t a, uint32_t b) {
    if (next_[a] == b) isPresent_[a] = 1;
    if (next_[b] == a) isPresent_[b] = 1;
  });
  for (uint32_t v = 0; v < p_.size(); ++v)
    if (!isPresent_[v]) missing_.push_back(v);
  return work_.tick(uint32_t(std::min<size_t>(50 * p_.size(), 1u << 30)));
}

// Of co-spherical points the two of least rank are always joined. So the ends of missing edges get
// the least ranks, as long as that makes fewer edges missing.
bool Protection::breakTies() {
  constexpr int kTries = 6;
  uint32_t n = uint32_t(p_.size());
  std::vector<uint32_t> ranks(n), order, best, fewest = missing_;
  std::vector<uint8_t> seen(n, 0);
  for (int i = 0; i < kTries && !missing_.empty(); ++i) {
    for (uint32_t v : missing_)
      for (uint32_t end : {v, next_[v]})
        if (!seen[end]) seen[end] = 1, order.push_back(end);
    uint32_t rank = 0;
    for (uint32_t v : order) ranks[v] = rank++;
    for (uint32_t v = 0; v < n; ++v)
      if (!seen[v]) ranks[v] = rank++;
    if (!tetrahedralize(ranks)) return false;
    if (missing_.size() < fewest.size()) {
      fewest = missing_;
      best = ranks;
    }
  }
  return missing_.size() == fewest.size() || tetrahedralize(best);
}

// For each missing piece the vertex that sees it at the widest angle, more than 90 degrees. There
// is one among the Delaunay neighbours of either end: let the piece from a to b leave the star of a
// through the facet x y z. If x, y, z were outside of the piece's diametral ball B, they would lie
// in the half space where the power to the circumsphere S of a x y z is at most that to B. But the
// piece leaves that triangle's half space at a, since b is outside of S.
void Protection::findEncroachers() {
  encroacher_.assign(p_.size(), {});
  auto consider = [&](uint32_t a, uint32_t x) {
    uint32_t b = next_[a];
    if (isPresent_[a] || x == a || x == b) return;
    Vec3 u = p_[a] - p_[x], v = p_[b] - p_[x];
    double cosine = dot(u, v) / (length(u) * length(v));
    Encroacher& e = encroacher_[a];
    if (cosine < e.cosine || (cosine == e.cosine && x < e.vertex)) e = {x, cosine};
  };
  cells_->forEachEdge([&](uint32_t u, uint32_t v) {
    consider(u, v), consider(previous_[u], v);
    consider(v, u), consider(previous_[v], u);
  });
}

// Keeps only the pieces that are most encroached upon, and no two of them at one vertex: often one
// split brings back the others. Star shapes take a fifth of the vertices that
// they would take otherwise.
void Protection::chooseWorst() {
  std::vector<double> cosines;
  for (uint32_t a : missing_) cosines.push_back(encroacher_[a].cosine);
  auto quantile = cosines.begin() + std::ptrdiff_t(double(cosines.size()) * kWorstShare);
  sf::select(cosines.begin(), quantile, cosines.end());
  double limit = *quantile + 1e-9;  // symmetric pieces are treated alike
  auto isWorse = [&](uint32_t b, uint32_t a) {
    double x = encroacher_[b].cosine, y = encroacher_[a].cosine;
    return !isPresent_[b] && (x < y || (x == y && b < a));
  };
  auto canWait = [&](uint32_t a) {
    return encroacher_[a].cosine > limit || isWorse(next_[a], a) || isWorse(previous_[a], a);
  };
  missing_.erase(std::remove_if(missing_.begin(), missing_.end(), canWait), missing_.end());
}

// Where to split the piece from a to next_[a], as a share of its length.
//
// At an acute corner where the other edge's vertices encroach, the split lies on the sphere around
// the corner through the other edge's nearest vertex; the two pieces of equal length at the corner
// do not encroach on each other. Anywhere else it lies next to the encroacher.
//
// Pieces cannot get arbitrarily short: a piece far from the vertices of other edges, compared with
// its length, can only be encroached upon from the neighbouring edge at an acute corner. Away from
// the corner that edge is as far as the corner, times a constant. At the corner a split on the
// sphere makes no piece shorter than those there, unless the radius is close to the piece's length:
// then one halving makes both edges' pieces half as long, and they are of equal length again.
double Protection::shareBefore(uint32_t a) const {
  uint32_t b = next_[a], x = encroacher_[a].vertex;
  if (x == kNone) return 0.5;
  auto isOn = [&](uint32_t edge, uint32_t farEnd) {
    return isInput(x) ? x == farEnd : edge_[x] == edge;
  };
  double size = distance(p_[a], p_[b]);
  auto corner = [&](uint32_t at, uint32_t neighbour) {
    double radius = distance(p_[at], p_[neighbour]) / size;
    return radius < kGreatestRadius ? radius : 0.5;
  };
  if (isInput(a) && isOn(loops_.previous(a), loops_.previous(a))) return corner(a, previous_[a]);
  if (isInput(b) && isOn(b, loops_.next(b))) return 1 - corner(b, next_[b]);
  double foot = dot(p_[x] - p_[a], p_[b] - p_[a]) / (size * size);
  return std::min(std::max(foot, kLeastShare), 1 - kLeastShare);
}

Vec3 Protection::positionAt(uint32_t edge, double t) const {
  auto snap = [](double x) { return std::fabs(x) < 0x1p-200 ? 0.0 : x; };
  Vec3 a = p_[edge], p = a + t * (p_[loops_.next(edge)] - a);
  return {snap(p.x), snap(p.y), snap(p.z)};
}

Status Protection::splitMissing() {
  findEncroachers();
  chooseWorst();
  uint32_t first = uint32_t(p_.size());
  size_t limit = 50 * size_t(loops_.vertexCount()) + 1000;
  if (p_.size() + missing_.size() > loops_.vertexCount() + limit) return Status::NotFound;
  std::vector<double> share(missing_.size());
  for (size_t i = 0; i < missing_.size(); ++i) share[i] = shareBefore(missing_[i]);
  for (size_t i = 0; i < missing_.size(); ++i) {
    uint32_t a = missing_[i], b = next_[a], v = uint32_t(p_.size());
    double from = t_[a], to = isInput(b) ? 1 : t_[b], t = from + share[i] * (to - from);
    if (!(from < t && t < to)) return Status::NotFound;
    p_.push_back(positionAt(edge_[a], t));
    edge_.push_back(edge_[a]);
    t_.push_back(t);
    next_.push_back(b), previous_.push_back(a);
    next_[a] = v, previous_[b] = v;
  }
  if (!cells_->add(ArrayView<const Vec3>(p_).slice(first, p_.size() - first)))
    return work_.status();
  for (uint32_t v = first; v < p_.size(); ++v)
    if (cells_->duplicateOf(v) != v) return Status::NotFound;
  return findMissing() ? Status::Ok : work_.status();
}

Status Protection::handBack(ProtectedLoops& result) {
  result = {};
  uint32_t n = loops_.vertexCount();
  std::vector<uint32_t> starts = {0}, place(p_.size());
  std::vector<Vec3> positions;
  for (uint32_t c = 0; c < loops_.loopCount(); ++c) {
    uint32_t v = loops_.first(c);
    do {
      place[v] = uint32_t(positions.size());
      if (isInput(v)) {
        positions.push_back(loops_.position(v));
        result.origin.push_back(v);
      } else {
        Vec3 p = p_[v];
        positions.push_back(
            {std::ldexp(p.x, exponent_), std::ldexp(p.y, exponent_), std::ldexp(p.z, exponent_)});
        result.origin.push_back(n + uint32_t(result.inserted.size()));
        result.inserted.push_back({c, edge_[v] - loops_.first(c), t_[v]});
      }
      v = next_[v];
    } while (v != loops_.first(c));
    starts.push_back(uint32_t(positions.size()));
  }
  result.loops = LoopSet(positions, starts);
  if (!sortedFacets(*cells_, work_, result.facets, place)) return work_.status();
  return Status::Ok;
}

}  // namespace

Status protectEdges(const LoopSet& loops, Work& work, ProtectedLoops& result) {
  return Protection(loops, work).run(result);
}

}  // namespace sf
