#include "mesh/crease.h"

#include <algorithm>
#include <cmath>

namespace sf {
namespace {

/// Where a crease ends at the rim, as a place in the rim, and the unit direction in which it would go on.
struct CreaseEnd {
  uint32_t place;
  Vec3 direction;
};

/// How far a rim may be from a crease that it runs along, in mean lengths of its edges.
constexpr double kOnCurve = 0.25;

Vec3 unit(Vec3 v) {
  const double l = length(v);
  return l > 0 ? (1 / l) * v : v;
}

class Parting {
 public:
  Parting(const MeshView& mesh, const Rims& rims, uint32_t rim, const Creases& creases)
      : mesh_(mesh),
        rims_(rims),
        first_(rims.starts[rim]),
        count_(rims.starts[rim + 1] - first_),
        creases_(creases) {
    step_ = rims.rims[rim].length / count_;
  }

  HoleParts part() {
    findEnds();
    if (ends_.size() == 2) joinTwo();
    if (ends_.size() == 3) joinThree();
    if (ends_.size() == 4) joinFour();
    for (const auto& part : result_.parts)
      if (part.size() < 3) return {};
    result_.areBetweenCreases = true;
    return std::move(result_);
  }

 private:
  uint32_t vertexAt(uint32_t place) const { return rims_.vertices[first_ + place % count_]; }
  Vec3 at(uint32_t vertex) const { return pointAt(mesh_.positions, vertex); }

  void findEnds() {
    std::vector<uint32_t> others, further;
    for (uint32_t i = 0; i < count_; ++i) {
      const uint32_t v = vertexAt(i);
      creases_.others(v, others);
      if (others.size() != 1) continue;
      const Vec3 last = unit(at(v) - at(others[0]));
      Vec3 direction = last;
      creases_.others(others[0], further);
      further.erase(std::remove(further.begin(), further.end(), v), further.end());
      // As it bends, so it goes on.
      if (further.size() == 1)
        direction = unit(last + 0.5 * (last - unit(at(others[0]) - at(further[0]))));
      ends_.push_back({i, direction});
    }
  }

  /// Points between two, numbered in the result; from the first to the second.
  template <class Curve>
  std::vector<uint32_t> points(double distance, Curve&& curve) {
    std::vector<uint32_t> numbers;
    const uint32_t pieces = uint32_t(std::min(1000.0, std::max(1.0, std::round(distance / step_))));
    for (uint32_t k = 1; k < pieces; ++k) {
      numbers.push_back(uint32_t(result_.points.size()));
      result_.points.push_back(curve(double(k) / pieces));
    }
    return numbers;
  }

  /// The rim from one end to another, then the numbered points, in order.
  void addPart(const CreaseEnd& from, const CreaseEnd& to, const std::vector<uint32_t>& back) {
    std::vector<PartCorner> part;
    appendRim(from.place, to.place, false, part);
    part.push_back({kNone, vertexAt(to.place), kNone});
    appendPoints(back, part);
    result_.parts.push_back(std::move(part));
  }

  /// The corners from one place of the rim to before another.
  void appendRim(uint32_t from, uint32_t to, bool isCrease, std::vector<PartCorner>& part) const {
    for (uint32_t k = 0; (from + k) % count_ != to; ++k) {
      const uint32_t place = (from + k) % count_;
      part.push_back({first_ + place, vertexAt(place), kNone, isCrease});
    }
  }

  void appendPoints(const std::vector<uint32_t>& numbers, std::vector<PartCorner>& part) const {
    for (const uint32_t point : numbers) part.push_back({kNone, kNone, point});
  }

  /// Points on the curve between two ends that leaves both as their creases do, from the first to the second.
  std::vector<uint32_t> join(const CreaseEnd& a, const CreaseEnd& b) {
    const Vec3 p = at(vertexAt(a.place)), q = at(vertexAt(b.place));
    const double l = length(q - p);
    return points(l, [&](double s) {
      const double s2 = s * s, s3 = s2 * s;
      return (2 * s3 - 3 * s2 + 1) * p + ((s3 - 2 * s2 + s) * l) * a.direction +
             (3 * s2 - 2 * s3) * q - ((s3 - s2) * l) * b.direction;
    });
  }

  /// How far two ends are from each other, and how much a crease between them would have to turn.
  double costOf(const CreaseEnd& a, const CreaseEnd& b) const {
    const Vec3 d = at(vertexAt(b.place)) - at(vertexAt(a.place));
    return length(d) * std::exp(angleBetween(a.direction, d) + angleBetween(b.direction, -d));
  }

  /// Joins four ends in two pairs that do not cross, which leaves a part between them.
  void joinFour() {
    std::vector<CreaseEnd> e = ends_;
    if (costOf(e[1], e[2]) + costOf(e[3], e[0]) < costOf(e[0], e[1]) + costOf(e[2], e[3]))
      std::rotate(e.begin(), e.begin() + 1, e.end());
    const std::vector<uint32_t> first = join(e[0], e[1]), second = join(e[2], e[3]);
    addPart(e[0], e[1], {first.rbegin(), first.rend()});
    addPart(e[2], e[3], {second.rbegin(), second.rend()});
    addPart(e[1], e[2], second);
    std::vector<PartCorner> between = std::move(result_.parts.back());
    result_.parts.pop_back();
    addPart(e[3], e[0], first);
    std::vector<PartCorner>& last = result_.parts.back();
    last.insert(last.begin(), between.begin(), between.end());
  }

  /// Joins two ends by a curve.
  void joinTwo() {
    const CreaseEnd &a = ends_[0], &b = ends_[1];
    const std::vector<uint32_t> there = join(a, b);
    // Where the rim itself runs along the crease, there is one part, on the other side of it.
    for (const bool isFirst : {true, false}) {
      const CreaseEnd &from = isFirst ? a : b, &to = isFirst ? b : a;
      if (!runsAlong(from.place, to.place, there)) continue;
      result_.points.clear();
      result_.parts.emplace_back();
      appendRim(to.place, from.place, false, result_.parts.back());
      appendRim(from.place, to.place, true, result_.parts.back());
      return;
    }
    std::vector<uint32_t> back(there.rbegin(), there.rend());
    addPart(a, b, back);
    addPart(b, a, there);
  }

  /// Whether the rim from one place to another keeps to the curve between them, which may run either way.
  bool runsAlong(uint32_t from, uint32_t to, const std::vector<uint32_t>& curve) const {
    Vec3 p = at(vertexAt(from)), q = at(vertexAt(to));
    if (!curve.empty() &&
        distance(result_.points[curve[0]], q) < distance(result_.points[curve[0]], p))
      std::swap(p, q);
    for (uint32_t k = 1; (from + k) % count_ != to; ++k) {
      const Vec3 x = at(vertexAt(from + k));
      double nearest = 1e300;
      Vec3 before = p;
      for (size_t i = 0; i <= curve.size(); ++i) {
        const Vec3 after = i < curve.size() ? result_.points[curve[i]] : q;
        const Vec3 d = after - before;
        const double l = dot(d, d),
                     t = l > 0 ? std::min(1.0, std::max(0.0, dot(x - before, d) / l)) : 0;
        nearest = std::min(nearest, length(x - before - t * d));
        before = after;
      }
      if (nearest > kOnCurve * step_) return false;
    }
    return true;
  }

  /// Joins three ends at the point nearest to the lines on which they go on.
  void joinThree() {
    double m[3][3] = {}, r[3] = {};
    for (const CreaseEnd& end : ends_) {
      const Vec3 p = at(vertexAt(end.place));
      const double d[3] = {end.direction.x, end.direction.y, end.direction.z},
                   c[3] = {p.x, p.y, p.z};
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) {
          const double q = (i == k) - d[i] * d[k];
          m[i][k] += q, r[i] += q * c[k];
        }
    }
    const Vec3 a{m[0][0], m[1][0], m[2][0]}, b{m[0][1], m[1][1], m[2][1]},
        c{m[0][2], m[1][2], m[2][2]}, s{r[0], r[1], r[2]};
    const double whole = dot(a, cross(b, c));
    // Lines that are nearly parallel meet nowhere.
    if (!(whole > 1e-3)) return;
    const Vec3 corner =
        (1 / whole) * Vec3{dot(s, cross(b, c)), dot(a, cross(s, c)), dot(a, cross(b, s))};
    if (joinAtRim(corner)) return;
    const uint32_t centre = uint32_t(result_.points.size());
    result_.points.push_back(corner);
    std::vector<uint32_t> arms[3];
    for (int i = 0; i < 3; ++i) {
      const Vec3 p = at(vertexAt(ends_[i].place));
      arms[i] = points(length(corner - p), [&](double t) { return p + t * (corner - p); });
    }
    for (int i = 0; i < 3; ++i) {
      const int k = (i + 1) % 3;
      std::vector<uint32_t> back = arms[k];
      back.push_back(centre);
      back.insert(back.end(), arms[i].rbegin(), arms[i].rend());
      addPart(ends_[i], ends_[k], back);
    }
  }

  /// Joins the ends at a vertex of the rim, if one is where their lines meet. Where the rim itself runs along a crease
  /// to there, nothing is between the two.
  bool joinAtRim(Vec3 corner) {
    uint32_t x = 0;
    for (uint32_t i = 1; i < count_; ++i)
      if (distance(at(vertexAt(i)), corner) < distance(at(vertexAt(x)), corner)) x = i;
    const Vec3 centre = at(vertexAt(x));
    if (distance(centre, corner) > kOnCurve * step_) return false;
    // In order around the rim, from there on.
    std::vector<uint32_t> places;
    for (const CreaseEnd& end : ends_)
      if (end.place > x) places.push_back(end.place);
    for (const CreaseEnd& end : ends_)
      if (end.place < x) places.push_back(end.place);
    const size_t m = places.size();
    const bool beginsAlong = runsAlong(x, places[0], {}),
               endsAlong = runsAlong(places[m - 1], x, {});
    // Each part from an end to the next one, the first and the last of them from and to the vertex itself.
    std::vector<PartCorner> part;
    appendRim(x, places[0], beginsAlong, part);
    for (size_t i = 0; i < m; ++i) {
      // Past an end up to which the rim runs along the crease, or after which it does, a part goes on.
      const bool goesOn = i == 0 ? beginsAlong : i == m - 1 && endsAlong;
      if (!goesOn) {
        const Vec3 p = at(vertexAt(places[i]));
        const std::vector<uint32_t> arm =
            points(length(centre - p), [&](double t) { return p + t * (centre - p); });
        part.push_back({kNone, vertexAt(places[i]), kNone});
        appendPoints(arm, part);
        result_.parts.push_back(std::move(part));
        part = {{kNone, vertexAt(x), kNone}};
        appendPoints({arm.rbegin(), arm.rend()}, part);
      }
      const bool isLast = i == m - 1;
      appendRim(places[i], isLast ? x : places[i + 1], isLast && endsAlong, part);
    }
    result_.parts.push_back(std::move(part));
    return true;
  }

  const MeshView& mesh_;
  const Rims& rims_;
  uint32_t first_, count_;
  const Creases& creases_;
  double step_;
  std::vector<CreaseEnd> ends_;
  HoleParts result_;
};

}  // namespace

Creases::Creases(const MeshView& mesh, const Adjacency& adjacency,
                 const std::vector<uint32_t>& fanStarts, const std::vector<uint32_t>& fans,
                 double angle)
    : mesh_(mesh),
      adjacency_(adjacency),
      fanStarts_(fanStarts),
      fans_(fans),
      cosine_(std::cos(angle)) {}

Vec3 Creases::normal(uint32_t face) const {
  const uint32_t* f = mesh_.faces.data() + 3 * size_t(face);
  const Vec3 a = pointAt(mesh_.positions, f[0]);
  const Vec3 n = cross(pointAt(mesh_.positions, f[1]) - a, pointAt(mesh_.positions, f[2]) - a);
  return adjacency_.turned[face] ? -1.0 * n : n;
}

bool Creases::isSharp(uint32_t half) const {
  const uint32_t twin = adjacency_.twins[half];
  if (twin == kNone) return false;
  const Vec3 a = normal(half / 3), b = normal(twin / 3);
  const double size = length(a) * length(b);
  return size > 0 && dot(a, b) < cosine_ * size;
}

void Creases::others(uint32_t vertex, std::vector<uint32_t>& found) const {
  found.clear();
  for (uint32_t i = fanStarts_[vertex]; i < fanStarts_[vertex + 1]; ++i)
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t h = 3 * fans_[i] + k, tail = adjacency_.tail(h), head = adjacency_.head(h);
      if ((tail != vertex && head != vertex) || !isSharp(h)) continue;
      const uint32_t other = tail == vertex ? head : tail;
      if (std::find(found.begin(), found.end(), other) == found.end()) found.push_back(other);
    }
}

HoleParts partHole(const MeshView& mesh, const Rims& rims, uint32_t rim, const Creases& creases) {
  return Parting(mesh, rims, rim, creases).part();
}

}  // namespace sf
