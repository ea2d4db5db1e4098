#include "polygon/session/constrained_mesh.h"

#include <algorithm>
#include <cmath>

#include "base/metric.h"
#include "base/turn.h"
#include "triangles/insertion_order.h"

namespace sf {
namespace {

// Flips a triangle before insertion is thought cheaper.
constexpr uint32_t kFlipsToAdopt = 2;

}  // namespace

void ConstrainedMesh::reset(double side, int exponent, size_t size) {
  exponent_ = exponent;
  mesh.corners.clear(), mesh.twins.clear(), mesh.unused.clear(), links.bits.clear();
  changed.clear(), stamps_.clear();
  at.resize(kCorners + size), metric_.resize(at.size());
  next.resize(at.size(), kNone), prev.resize(at.size(), kNone);
  mesh.edgeFrom.assign(at.size(), kNone);
  mesh.at = at, mesh.metric = metric_;
  setPosition(0, {-side, -side}), setPosition(1, {side, -side});
  setPosition(2, {side, side}), setPosition(3, {-side, side});
  const uint32_t h = mesh.create(0, 1, 2), g = mesh.create(0, 2, 3);
  mesh.setTwins(h + 2, g);
  for (uint32_t v = 0; v < 3; ++v) mesh.edgeFrom[v] = h + v;
  mesh.edgeFrom[3] = g + 2;
  touch(0), touch(1);
}

bool ConstrainedMesh::insertAll(std::vector<uint32_t>& vertices, ArrayView<const uint32_t> ringNext,
                                Work& work, uint32_t& refused, Obstacle& obstacle) {
  sortForInsertion(mesh.metric, vertices);
  uint32_t near = 0;
  for (const uint32_t v : vertices) {
    refused = v;
    if (!insertPoint(v, near, obstacle)) return false;
    legalize(kNone);
    forgetChanges();
    near = v;
    if (!work.tick(1500)) return false;
  }
  for (const uint32_t v : vertices) {
    refused = v;
    if (ringNext[v] == kNone) continue;
    if (!insertEdge(v, ringNext[v], obstacle)) return false;
    next[v] = ringNext[v], prev[ringNext[v]] = v;
    legalizeChanged(kNone);
    forgetChanges();
    if (!work.tick(300)) return false;
  }
  return true;
}

bool ConstrainedMesh::adopt(const std::vector<uint32_t>& corners,
                            ArrayView<const uint32_t> ringNext, Work& work) {
  mesh.corners = corners;
  if (!findTwins(mesh.corners, uint32_t(at.size()), work, mesh.twins)) return false;
  uint32_t border = 0;
  pending_.clear();
  for (uint32_t h = 0; h < corners.size(); ++h) {
    mesh.edgeFrom[corners[h]] = h;
    if (h % 3 == 0 && mesh.orient(corners[h], corners[h + 1], corners[h + 2]) <= 0) return false;
    if (mesh.twins[h] == kNone)
      ++border;
    else if (h < mesh.twins[h] && ringNext[mesh.from(h)] != mesh.to(h) &&
             ringNext[mesh.to(h)] != mesh.from(h))
      pending_.push_back(h);
  }
  if (border != kCorners || !work.tick(20 * uint32_t(corners.size()))) return false;
  for (uint32_t v = kCorners; v < at.size(); ++v)
    if (ringNext[v] != kNone) next[v] = ringNext[v], prev[ringNext[v]] = v;
  const uint32_t count = mesh.triangleCount();
  stamps_.assign(count, stamp_), links.bits.assign(count, 0);  // so that flips note nothing
  const bool done = legalize(kFlipsToAdopt * count) > 0;
  forgetChanges();
  return done && work.tick(200 * count);
}

void ConstrainedMesh::setPosition(uint32_t v, Point2 p) {
  if (v >= at.size()) {
    at.resize(size_t(v) + 1), metric_.resize(at.size());
    next.resize(at.size(), kNone), prev.resize(at.size(), kNone);
    mesh.edgeFrom.resize(at.size(), kNone);
    mesh.at = at, mesh.metric = metric_;
  }
  at[v] = p;
  metric_[v] = scaledDown(p, exponent_);
}

void ConstrainedMesh::forgetChanges() {
  changed.clear();
  ++stamp_;
}

void ConstrainedMesh::touch(uint32_t t) {
  if (t >= stamps_.size()) stamps_.resize(size_t(t) + 1, 0), links.bits.resize(size_t(t) + 1, 0);
  for (uint32_t h = 3 * t; h < 3 * t + 3; ++h)
    if (links.linked(h)) links.cut(h, mesh.twins[h]);
  if (stamps_[t] == stamp_) return;
  stamps_[t] = stamp_;
  changed.push_back(t);
}

void ConstrainedMesh::flip(uint32_t h) {
  touch(h / 3), touch(mesh.twins[h] / 3);
  mesh.flip(h);
}

bool ConstrainedMesh::insertPoint(uint32_t v, uint32_t near, Obstacle& obstacle) {
  obstacle = {};
  const TriangleMesh::Place place = locator_.locate(mesh, mesh.edgeFrom[near], at[v]);
  SF_ASSERT(place.edge != kNone);
  for (uint32_t h = place.edge / 3 * 3, k = 0; k < 3; ++k)
    if (at[mesh.from(h + k)] == at[v]) {
      obstacle.vertex = mesh.from(h + k);
      return false;
    }
  if (place.onEdge && isFixed(place.edge)) {
    obstacle.edge = fixedFrom(place.edge);
    return false;
  }
  touch(place.edge / 3);
  if (place.onEdge) touch(mesh.twins[place.edge] / 3);
  pending_.clear();
  mesh.insert(place, v, pending_);
  for (const uint32_t h : pending_) touch(h / 3);
  return true;
}

bool ConstrainedMesh::isConvex(uint32_t h) const {
  const uint32_t a = mesh.from(h), b = mesh.to(h), c = mesh.apex(h), d = mesh.apex(mesh.twins[h]);
  return mesh.orient(a, d, c) > 0 && mesh.orient(b, c, d) > 0;
}

void ConstrainedMesh::removePoint(uint32_t v) {
  uint32_t degree = 0, h = mesh.edgeFrom[v];
  do {
    ++degree;
    h = around(h);
  } while (h != mesh.edgeFrom[v]);
  // Flips take edges away from v. With five triangles or more, some ear of the ring around v has v
  // strictly on the inner side: an ear of any triangulation of the ring that does not touch v.
  for (uint32_t tried = 0; degree > 3 && tried < degree;) {
    const uint32_t after = around(h);
    if (isConvex(h)) {
      flip(h);
      --degree;
      tried = 0;
    } else {
      ++tried;
    }
    h = after;
  }
  SF_ASSERT(degree <= 4);
  old_.clear();
  uint32_t ring[4];
  for (uint32_t i = 0; i < degree; ++i, h = around(h)) {
    old_.push_back(h / 3);
    ring[i] = mesh.to(h);
  }
  if (degree == 3) {
    corners_ = {ring[0], ring[1], ring[2]};
  } else {  // v lies on a diagonal of four
    const uint32_t s = mesh.orient(ring[0], ring[2], v) == 0 ? 0 : 1;
    corners_ = {ring[s], ring[s + 1], ring[s + 2], ring[s + 2], ring[(s + 3) % 4], ring[s]};
  }
  replace(old_, corners_);
  mesh.edgeFrom[v] = kNone;
}

/// Puts triangles in the place of others that cover the same.
void ConstrainedMesh::replace(const std::vector<uint32_t>& old,
                              const std::vector<uint32_t>& corners) {
  sides_.clear();
  for (const uint32_t t : old) touch(t);
  for (const uint32_t t : old)
    for (uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
      const uint32_t g = mesh.twins[h];
      if (g != kNone && std::find(old.begin(), old.end(), g / 3) == old.end())
        sides_.push_back({mesh.from(g), mesh.to(g), g});
    }
  for (const uint32_t t : old) mesh.discard(t);
  for (size_t i = 0; i < corners.size(); i += 3) {
    const uint32_t h = mesh.create(corners[i], corners[i + 1], corners[i + 2]);
    touch(h / 3);
    for (uint32_t k = 0; k < 3; ++k) {
      mesh.edgeFrom[corners[i + k]] = h + k;
      sides_.push_back({corners[i + k], corners[i + (k + 1) % 3], h + k});
    }
  }
  // Twins are the two sides of one pair of vertices.
  const auto key = [](const Side& s) {
    return uint64_t(std::min(s.a, s.b)) << 32 | std::max(s.a, s.b);
  };
  std::sort(sides_.begin(), sides_.end(),
            [&](const Side& p, const Side& q) { return key(p) < key(q); });
  for (size_t i = 0; i + 1 < sides_.size(); ++i)
    if (key(sides_[i]) == key(sides_[i + 1])) {
      SF_ASSERT(sides_[i].a == sides_[i + 1].b);
      mesh.setTwins(sides_[i].half, sides_[i + 1].half);
    }
}

bool ConstrainedMesh::isEar(const std::vector<uint32_t>& ring, size_t i) const {
  const size_t n = ring.size();
  const uint32_t a = ring[(i + n - 1) % n], b = ring[i], c = ring[(i + 1) % n];
  if (mesh.orient(a, b, c) <= 0) return false;
  for (const uint32_t v : ring)
    if (v != a && v != b && v != c && mesh.orient(a, b, v) >= 0 && mesh.orient(b, c, v) >= 0 &&
        mesh.orient(c, a, v) >= 0)
      return false;
  return true;
}

/// Appends triangles that fill a ring, counter-clockwise, which may run along edges both ways.
void ConstrainedMesh::fill(std::vector<uint32_t>& ring, std::vector<uint32_t>& corners) const {
  // Whatever triangles fill it form a tree, and a leaf of the tree is an ear:
  // so there always is one.
  size_t i = 1;
  for (size_t tried = 0; ring.size() > 2 && tried <= ring.size();) {
    const size_t n = ring.size();
    i %= n;
    if (!isEar(ring, i)) {
      ++i, ++tried;
      continue;
    }
    corners.insert(corners.end(), {ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]});
    ring.erase(ring.begin() + std::ptrdiff_t(i));
    i += n - 2;  // the vertex before
    tried = 0;
  }
  SF_ASSERT(ring.size() == 2);
}

/// The half-edge across which a-b leaves the triangles around a; kNone if a-b is an edge already,
/// or if a vertex is in the way.
uint32_t ConstrainedMesh::leaveTowards(uint32_t a, uint32_t b, Obstacle& obstacle) const {
  uint32_t h = mesh.edgeFrom[a];
  do {
    const uint32_t x = mesh.to(h), y = mesh.apex(h);
    if (x == b || y == b) return kNone;
    const int right = mesh.orient(a, b, x);
    if (right == 0 && below(at[a], at[x]) == below(at[a], at[b])) {
      obstacle.vertex = x;
      return kNone;
    }
    if (right < 0 && mesh.orient(a, b, y) > 0) return nextInTriangle(h);
    h = around(h);
  } while (h != mesh.edgeFrom[a]);
  SF_ASSERT(false);
  return kNone;
}

bool ConstrainedMesh::insertEdge(uint32_t a, uint32_t b, Obstacle& obstacle) {
  obstacle = {};
  uint32_t h = leaveTowards(a, b, obstacle);
  if (h == kNone) return obstacle.vertex == kNone;
  // The triangles that a-b meets, and the vertices along them on either side.
  old_.assign(1, h / 3);
  right_ = {a, mesh.from(h)};
  left_ = {a, mesh.to(h)};
  for (;;) {
    if (isFixed(h)) {
      obstacle.edge = fixedFrom(h);
      return false;
    }
    const uint32_t g = mesh.twins[h], w = mesh.apex(g);
    old_.push_back(g / 3);
    if (w == b) break;
    const int side = mesh.orient(a, b, w);
    if (side == 0) {
      obstacle.vertex = w;
      return false;
    }
    (side > 0 ? left_ : right_).push_back(w);
    h = side > 0 ? nextInTriangle(g) : prevInTriangle(g);
  }
  right_.push_back(b);
  left_.push_back(b);
  std::reverse(left_.begin(), left_.end());
  corners_.clear();
  fill(right_, corners_);
  fill(left_, corners_);
  SF_ASSERT(corners_.size() == 3 * old_.size());
  replace(old_, corners_);
  return true;
}

bool ConstrainedMesh::shiftPoint(uint32_t v, Point2 p) {
  const uint32_t first = mesh.edgeFrom[v];
  uint32_t h = first;
  do {
    if (turn(p, at[mesh.to(h)], at[mesh.apex(h)]) <= 0) return false;
    h = around(h);
  } while (h != first);
  setPosition(v, p);
  do {
    pending_.insert(pending_.end(), {h, nextInTriangle(h)});
    h = around(h);
  } while (h != first);
  return true;
}

void ConstrainedMesh::legalizeChanged(uint32_t budget) {
  for (const uint32_t t : changed)
    if (mesh.inUse(t)) pending_.insert(pending_.end(), {3 * t, 3 * t + 1, 3 * t + 2});
  legalize(budget);
}

uint32_t ConstrainedMesh::legalize(uint32_t budget) {
  while (!pending_.empty() && budget > 0) {
    const uint32_t h = pending_.back();
    pending_.pop_back();
    if (!mesh.inUse(h / 3) || mesh.twins[h] == kNone || isFixed(h) || !mesh.isIllegal(h)) continue;
    const uint32_t g = mesh.twins[h];
    flip(h);
    --budget;
    pending_.insert(pending_.end(), {h, prevInTriangle(h), g, prevInTriangle(g)});
  }
  pending_.clear();
  return budget;
}

}  // namespace sf
