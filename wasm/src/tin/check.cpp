#include "tin/check.h"

#include <algorithm>
#include <cmath>

#include "base/predicates.h"
#include "base/sort.h"
#include "triangles/triangle_mesh.h"

namespace sf {
namespace {

/// Cells of the grid of borders along one side, at most.
constexpr uint32_t kMostCells = 1024;

class TinChecker {
 public:
  TinChecker(ArrayView<const double> positions, std::vector<uint32_t>& triangles, Work& work,
             std::vector<uint32_t>& twins, TinProblem& problem)
      : positions_(positions), corners_(triangles), work_(work), twins_(twins), problem_(problem) {}

  bool run(bool orient) {
    return checkFaces(orient) && checkPlaces() && findTwins() && checkStars() && checkBorders() &&
           checkCover();
  }

 private:
  bool checkFaces(bool orient);
  bool checkPlaces();
  bool findTwins();
  bool failAtEdge(uint32_t h, uint32_t g);
  bool checkStars();
  bool checkStar(uint32_t v);
  void layGrid();
  bool checkBorders();
  bool checkPair(uint32_t e, uint32_t f);
  bool checkCover();
  bool isCoveredOnce(uint32_t e);
  template <class F>
  void eachCell(uint32_t e, F&& call) const;

  uint32_t vertexCount() const { return uint32_t(positions_.size() / 3); }
  uint32_t from(uint32_t h) const { return corners_[h]; }
  uint32_t to(uint32_t h) const { return corners_[nextInTriangle(h)]; }
  uint32_t apex(uint32_t h) const { return corners_[prevInTriangle(h)]; }
  Point2 at(uint32_t v) const { return {positions_[3 * v], positions_[3 * v + 1]}; }
  Vec3 inSpace(uint32_t v) const {
    return {positions_[3 * v], positions_[3 * v + 1], positions_[3 * v + 2]};
  }
  int turn(uint32_t a, uint32_t b, uint32_t c) const {
    const Point2 p = at(a), q = at(b), r = at(c);
    return orient2d(p.x, p.y, q.x, q.y, r.x, r.y);
  }
  /// Of three vertices on one line, whether b and c are on the same side of a.
  bool isOneSide(uint32_t a, uint32_t b, uint32_t c) const {
    const Point2 p = at(a), q = at(b), r = at(c);
    return q.x != p.x ? (q.x > p.x) == (r.x > p.x) && r.x != p.x : (q.y > p.y) == (r.y > p.y);
  }
  /// Whether b lies between a and c, if all are on one line.
  bool isBetween(uint32_t a, uint32_t b, uint32_t c) const {
    return isOneSide(a, b, c) && isOneSide(c, b, a) && a != b && b != c;
  }
  /// Whether the way from a half-edge's start to p lies in the wedge of its face, its first side included.
  bool isInWedge(uint32_t h, uint32_t p) const {
    const uint32_t v = from(h);
    const int side = turn(v, to(h), p);
    return side == 0 ? isOneSide(v, to(h), p) : side > 0 && turn(v, p, apex(h)) > 0;
  }
  bool doOverlap(uint32_t s, uint32_t t) const;

  bool fail(TinFault fault, uint32_t face, uint32_t other = kNone, uint32_t vertex = kNone,
            uint32_t otherVertex = kNone) {
    if (other < face) std::swap(face, other);
    problem_ = {fault, {face, other}, {vertex, otherVertex}};
    return false;
  }

  ArrayView<const double> positions_;
  std::vector<uint32_t>& corners_;
  Work& work_;
  std::vector<uint32_t>& twins_;
  TinProblem& problem_;
  // Half-edges by the vertex that they leave.
  std::vector<uint32_t> firsts_, leaving_;
  std::vector<uint8_t> isSeen_;  // [3m]
  // Border edges, and the cells of a grid with those that pass through each, or near it.
  std::vector<uint32_t> borders_;
  Point2 low_{}, cell_{1, 1};
  uint32_t columns_ = 1, rows_ = 1;
  std::vector<uint32_t> cellStarts_, inCell_;
  std::vector<uint32_t> stamp_;  // [borders] the query that met it last
  uint32_t query_ = 0;
};

bool TinChecker::checkFaces(bool orient) {
  if (corners_.empty() || corners_.size() % 3 != 0) return fail(TinFault::Empty, kNone);
  for (size_t i = 0; i < positions_.size(); ++i)
    if (!(std::fabs(positions_[i]) <= kLargestCoordinate))
      return fail(TinFault::NotFinite, kNone, kNone, uint32_t(i / 3));
  for (size_t i = 0; i < corners_.size(); ++i)
    if (corners_[i] >= vertexCount()) return fail(TinFault::IndexOutOfRange, uint32_t(i / 3));
  for (uint32_t t = 0; 3 * t < corners_.size(); ++t) {
    uint32_t* c = &corners_[3 * t];
    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) return fail(TinFault::Degenerate, t);
    const int side = turn(c[0], c[1], c[2]);
    if (side == 0) {
      const bool isLine = collinear(inSpace(c[0]), inSpace(c[1]), inSpace(c[2]));
      return fail(isLine ? TinFault::Degenerate : TinFault::Vertical, t);
    }
    if (side < 0 && !orient) return fail(TinFault::Clockwise, t);
    if (side < 0) std::swap(c[1], c[2]);
  }
  return work_.tick(30 * corners_.size());
}

/// Vertices of faces are at different places.
bool TinChecker::checkPlaces() {
  std::vector<uint32_t> used(vertexCount(), 0);
  for (const uint32_t v : corners_) used[v] = 1;
  std::vector<uint32_t> order;
  for (uint32_t v = 0; v < used.size(); ++v)
    if (used[v]) order.push_back(v);
  sf::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    const Point2 p = at(a), q = at(b);
    return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : a < b;
  });
  for (size_t i = 0; i + 1 < order.size(); ++i)
    if (at(order[i]) == at(order[i + 1]))
      return fail(TinFault::RepeatedVertex, kNone, kNone, order[i], order[i + 1]);
  return work_.tick(100 * order.size());
}

bool TinChecker::findTwins() {
  const uint32_t count = uint32_t(corners_.size());
  firsts_.assign(vertexCount() + 1, 0);
  for (const uint32_t v : corners_) ++firsts_[v + 1];
  for (uint32_t v = 0; v < vertexCount(); ++v) firsts_[v + 1] += firsts_[v];
  leaving_.resize(count);
  std::vector<uint32_t> next(firsts_.begin(), firsts_.end() - 1);
  for (uint32_t h = 0; h < count; ++h) leaving_[next[from(h)]++] = h;
  // For each vertex: the half-edge from it to each of its neighbours.
  twins_.assign(count, kNone);
  std::vector<uint32_t> edgeTo(vertexCount(), kNone);
  for (uint32_t v = 0; v < vertexCount(); ++v) {
    const uint32_t begin = firsts_[v], end = firsts_[v + 1];
    for (uint32_t i = begin; i < end; ++i) {
      uint32_t& known = edgeTo[to(leaving_[i])];
      if (known != kNone) return failAtEdge(known, leaving_[i]);
      known = leaving_[i];
    }
    for (uint32_t i = begin; i < end; ++i)
      twins_[prevInTriangle(leaving_[i])] = edgeTo[apex(leaving_[i])];
    for (uint32_t i = begin; i < end; ++i) edgeTo[to(leaving_[i])] = kNone;
  }
  return work_.tick(60 * count);
}

/// Of two faces that run along an edge in one direction: they lie over each other if they are all that the edge has, or if the faces
/// at one of its ends turn more than once around; else the edge has too many.
bool TinChecker::failAtEdge(uint32_t h, uint32_t g) {
  const uint32_t v = from(h), w = to(h);
  uint32_t count = 0;
  for (uint32_t k = 0; k < corners_.size(); ++k)
    count += (from(k) == v && to(k) == w) || (from(k) == w && to(k) == v);
  const auto turns = [&](uint32_t end) {
    double sum = 0;
    for (uint32_t i = firsts_[end]; i < firsts_[end + 1]; ++i) {
      const Point2 o = at(end), p = at(to(leaving_[i])), q = at(apex(leaving_[i]));
      const double x = p.x - o.x, y = p.y - o.y, s = q.x - o.x, t = q.y - o.y;
      sum += std::atan2(x * t - y * s, x * s + y * t);
    }
    return sum / 6.283185307179586;
  };
  constexpr double kOnce = 1 + 1e-9;
  const bool isFold = apex(h) != apex(g) && (count == 2 || turns(v) > kOnce || turns(w) > kOnce);
  return isFold ? fail(TinFault::Overlap, h / 3, g / 3)
                : fail(TinFault::NonManifold, h / 3, g / 3, v, w);
}

bool TinChecker::checkStars() {
  isSeen_.assign(corners_.size(), 0);
  for (uint32_t v = 0; v < vertexCount(); ++v)
    if (!checkStar(v)) return false;
  return work_.tick(60 * corners_.size());
}

/// The faces around a vertex turn once at most, and do not lie over each other. They form fans: closed ones, or ones that begin
/// and end at the border.
bool TinChecker::checkStar(uint32_t v) {
  const uint32_t begin = firsts_[v], end = firsts_[v + 1];
  // Where a fan begins no other face may be.
  const auto isFree = [&](uint32_t start) {
    for (uint32_t i = begin; i < end; ++i)
      if (leaving_[i] != start && isInWedge(leaving_[i], to(start)))
        return fail(TinFault::Overlap, start / 3, leaving_[i] / 3);
    return true;
  };
  for (const bool isOpen : {true, false})
    for (uint32_t i = begin; i < end; ++i) {
      const uint32_t start = leaving_[i];
      if (isSeen_[start] || (isOpen && twins_[start] != kNone)) continue;
      if (!isFree(start)) return false;
      for (uint32_t h = start; h != kNone && !isSeen_[h]; h = twins_[prevInTriangle(h)])
        isSeen_[h] = 1;
    }
  return true;
}

/// Calls back with the cells that a border edge passes through, and with some beside them.
template <class F>
void TinChecker::eachCell(uint32_t e, F&& call) const {
  const Point2 a = at(from(borders_[e])), b = at(to(borders_[e]));
  const auto index = [](double x, uint32_t count) {
    return x <= 0 ? 0u : x >= count ? count - 1 : uint32_t(x);
  };
  const auto column = [&](double x) { return index((x - low_.x) / cell_.x, columns_); };
  const auto row = [&](double y) { return index((y - low_.y) / cell_.y, rows_); };
  const uint32_t lowest = row(std::min(a.y, b.y)), highest = row(std::max(a.y, b.y));
  const double left = std::min(a.x, b.x), right = std::max(a.x, b.x);
  for (uint32_t r = lowest; r <= highest; ++r) {
    double from = left, to = right;
    if (lowest < highest) {
      // Half a cell more all around, for what rounding takes.
      const double slope = (b.x - a.x) / (b.y - a.y);
      const double x0 = a.x + (low_.y + (r - 0.5) * cell_.y - a.y) * slope,
                   x1 = a.x + (low_.y + (r + 1.5) * cell_.y - a.y) * slope;
      from = std::max(left, std::min(x0, x1)), to = std::min(right, std::max(x0, x1));
      if (!(from <= to)) from = left, to = right;
    }
    const uint32_t first = column(from - 0.5 * cell_.x), last = column(to + 0.5 * cell_.x);
    for (uint32_t c = first; c <= last; ++c) call(r * columns_ + c);
  }
}

void TinChecker::layGrid() {
  borders_.clear();
  for (uint32_t h = 0; h < twins_.size(); ++h)
    if (twins_[h] == kNone) borders_.push_back(h);
  Point2 high = low_ = at(from(borders_[0]));
  for (const uint32_t h : borders_) {
    const Point2 p = at(from(h));
    low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  columns_ = rows_ = std::min(kMostCells, uint32_t(std::sqrt(double(borders_.size()))) + 1);
  const auto sizeOf = [](double size, uint32_t count) {
    return size > 0 && std::isfinite(size / count) && size / count > 0 ? size / count : 1;
  };
  cell_ = {sizeOf(high.x - low_.x, columns_), sizeOf(high.y - low_.y, rows_)};
  cellStarts_.assign(size_t(columns_) * rows_ + 1, 0);
  for (uint32_t e = 0; e < borders_.size(); ++e)
    eachCell(e, [&](uint32_t cell) { ++cellStarts_[cell + 1]; });
  for (size_t c = 0; c + 1 < cellStarts_.size(); ++c) cellStarts_[c + 1] += cellStarts_[c];
  inCell_.resize(cellStarts_.back());
  std::vector<uint32_t> next(cellStarts_.begin(), cellStarts_.end() - 1);
  for (uint32_t e = 0; e < borders_.size(); ++e)
    eachCell(e, [&](uint32_t cell) { inCell_[next[cell]++] = e; });
  stamp_.assign(borders_.size(), 0);
  query_ = 0;
}

/// Borders do not cross, and no face lies beside a border where another one touches it.
bool TinChecker::checkBorders() {
  layGrid();
  for (size_t c = 0; c + 1 < cellStarts_.size(); ++c) {
    for (uint32_t i = cellStarts_[c]; i < cellStarts_[c + 1]; ++i)
      for (uint32_t k = i + 1; k < cellStarts_[c + 1]; ++k)
        if (!checkPair(borders_[inCell_[i]], borders_[inCell_[k]])) return false;
    const uint64_t here = cellStarts_[c + 1] - cellStarts_[c];
    if (!work_.tick(20 * here * here)) return false;
  }
  return true;
}

bool TinChecker::checkPair(uint32_t e, uint32_t f) {
  const uint32_t a = from(e), b = to(e), c = from(f), d = to(f);
  const Point2 pa = at(a), pb = at(b), pc = at(c), pd = at(d);
  if (std::max(pa.x, pb.x) < std::min(pc.x, pd.x) || std::max(pc.x, pd.x) < std::min(pa.x, pb.x) ||
      std::max(pa.y, pb.y) < std::min(pc.y, pd.y) || std::max(pc.y, pd.y) < std::min(pa.y, pb.y))
    return true;
  const int ec = turn(a, b, c), ed = turn(a, b, d), fa = turn(c, d, a), fb = turn(c, d, b);
  if (ec * ed < 0 && fa * fb < 0) return fail(TinFault::Overlap, e / 3, f / 3);
  // Faces of a vertex within an edge reach to the edge's own side if any of their sides does.
  const auto touches = [&](uint32_t edge, uint32_t v, int side) {
    if (side != 0 || !isBetween(from(edge), v, to(edge))) return true;
    for (uint32_t i = firsts_[v]; i < firsts_[v + 1]; ++i) {
      const uint32_t h = leaving_[i];
      if (turn(from(edge), to(edge), to(h)) > 0 || turn(from(edge), to(edge), apex(h)) > 0)
        return fail(TinFault::Overlap, edge / 3, h / 3);
    }
    return true;
  };
  return touches(e, c, ec) && touches(e, d, ed) && touches(f, a, fa) && touches(f, b, fb);
}

/// Along each border, faces are the only ones beside it.
bool TinChecker::checkCover() {
  std::vector<uint8_t> isDone(corners_.size(), 0);
  for (const uint32_t start : borders_) {
    if (isDone[start]) continue;
    // The border from here on: a fan's other end is the next edge's start.
    uint32_t chosen = start;
    for (uint32_t h = start; !isDone[h];) {
      isDone[h] = 1;
      if (at(from(chosen)).x == at(to(chosen)).x) chosen = h;
      uint32_t g = nextInTriangle(h);
      while (twins_[g] != kNone) g = nextInTriangle(twins_[g]);
      h = g;
    }
    if (!isCoveredOnce(chosen)) {
      for (uint32_t t = 0; 3 * t < corners_.size(); ++t)
        if (t != chosen / 3 && doOverlap(t, chosen / 3))
          return fail(TinFault::Overlap, t, chosen / 3);
      return fail(TinFault::Overlap, chosen / 3);
    }
    if (!work_.tick(1000)) return false;
  }
  return true;
}

/// Whether one face alone covers the place beside the lower end of a border edge, on the edge's own side. Looks at all border
/// edges above and below, a little behind that end; if the edge is upright, from the side.
bool TinChecker::isCoveredOnce(uint32_t e) {
  const bool isUpright = at(from(e)).x == at(to(e)).x;
  // Turned by a right angle, so that no edge that is asked for is upright.
  const auto along = [&](uint32_t v) { return isUpright ? at(v).y : at(v).x; };
  const auto isForward = [&](uint32_t h) { return along(from(h)) < along(to(h)); };
  const uint32_t first = isForward(e) ? from(e) : to(e), last = isForward(e) ? to(e) : from(e);
  const double x = along(first);
  int cover = 0;
  ++query_;
  const auto look = [&](uint32_t f) {
    if (stamp_[f] == query_) return;
    stamp_[f] = query_;
    const uint32_t h = borders_[f];
    const uint32_t a = isForward(h) ? from(h) : to(h), b = isForward(h) ? to(h) : from(h);
    if (!(along(a) <= x && x < along(b))) return;
    int side = turn(a, b, first);
    if (side == 0) side = turn(a, b, last);
    // Left of the direction of growing x is above.
    const bool isBelow = side > 0 || (side == 0 && isForward(e));
    if (isBelow) cover += isForward(h) ? 1 : -1;
  };
  const auto index = [&](double place, double from, double size, uint32_t count) {
    const double i = (place - from) / size;
    return i <= 0 ? 0u : i >= count ? count - 1 : uint32_t(i);
  };
  if (isUpright) {
    const uint32_t row = index(x, low_.y, cell_.y, rows_);
    for (uint32_t i = cellStarts_[row * columns_]; i < cellStarts_[(row + 1) * columns_]; ++i)
      look(inCell_[i]);
  } else {
    const uint32_t column = index(x, low_.x, cell_.x, columns_);
    for (uint32_t r = 0; r < rows_; ++r) {
      const uint32_t cell = r * columns_ + column;
      for (uint32_t i = cellStarts_[cell]; i < cellStarts_[cell + 1]; ++i) look(inCell_[i]);
    }
  }
  return cover == 1;
}

/// Whether the inner parts of two faces meet: no side of either has all of the other beyond it.
bool TinChecker::doOverlap(uint32_t s, uint32_t t) const {
  const auto isApart = [&](uint32_t one, uint32_t other) {
    for (uint32_t h = 3 * one; h < 3 * one + 3; ++h) {
      bool isBeyond = true;
      for (uint32_t k = 0; k < 3; ++k)
        isBeyond &= turn(from(h), to(h), corners_[3 * other + k]) <= 0;
      if (isBeyond) return true;
    }
    return false;
  };
  return !isApart(s, t) && !isApart(t, s);
}

}  // namespace

bool checkTin(ArrayView<const double> positions, std::vector<uint32_t>& triangles, bool orient,
              Work& work, std::vector<uint32_t>& twins, TinProblem& problem) {
  problem = {};
  return TinChecker(positions, triangles, work, twins, problem).run(orient);
}

}  // namespace sf
