#include "triangles/triangle_mesh.h"

#include "base/charge.h"
#include "base/predicates.h"
#include "base/turn.h"

namespace sf {
namespace {

// Edges that are done are dropped now and then.
constexpr size_t kForget = 1u << 16;

}  // namespace

bool findTwins(ArrayView<const uint32_t> corners, uint32_t vertexCount, Work& work,
               std::vector<uint32_t>& twins) {
  const uint32_t count = uint32_t(corners.size());
  Charge charge(work);
  if (!charge.add(4 * (uint64_t(count) + vertexCount + 1))) return false;
  // The half-edges out of each vertex, in one array.
  std::vector<uint32_t> starts(size_t(vertexCount) + 1, 0), out(count);
  for (const uint32_t v : corners) ++starts[v];
  for (uint32_t v = 0, sum = 0; v <= vertexCount; ++v) starts[v] = sum += starts[v];
  for (uint32_t h = count; h-- > 0;) out[--starts[corners[h]]] = h;

  const auto end = [&](uint32_t h) { return corners[nextInTriangle(h)]; };
  const auto degree = [&](uint32_t v) { return starts[v + 1] - starts[v]; };
  twins.assign(count, kNone);
  for (uint32_t h = 0; h < count; ++h) {
    if (twins[h] != kNone) continue;
    const uint32_t a = corners[h], b = end(h);
    // The twin runs from b to a. Searching at the end with fewer half-edges keeps the whole linear:
    // in a planar graph the lesser degrees of all edges have a linear sum.
    const bool atB = degree(b) <= degree(a);
    const uint32_t v = atB ? b : a;
    for (uint32_t i = starts[v]; i < starts[v + 1]; ++i) {
      const uint32_t g = atB ? out[i] : prevInTriangle(out[i]);
      if (twins[g] != kNone || corners[g] != b || end(g) != a) continue;
      twins[h] = g, twins[g] = h;
      break;
    }
    if (!work.tick(16)) return false;
  }
  return true;
}

int TriangleMesh::orient(uint32_t a, uint32_t b, uint32_t c) const {
  const double t = turn(at[a], at[b], at[c]);
  return t > 0 ? 1 : t < 0 ? -1 : 0;
}

bool TriangleMesh::isIllegal(uint32_t h) const {
  const uint32_t g = twins[h];
  if (g == kNone) return false;
  const uint32_t v[4] = {from(h), to(h), apex(h), apex(g)};
  const Point2 a = metric[v[0]], b = metric[v[1]], c = metric[v[2]], d = metric[v[3]];
  if (incircle(a.x, a.y, b.x, b.y, c.x, c.y, d.x, d.y) <= 0) return false;
  // Always true if `metric` is `at`; otherwise the angles of `metric` may be all wrong.
  return orient(v[0], v[3], v[2]) > 0 && orient(v[1], v[2], v[3]) > 0;
}

void ClosableTwins::close(uint32_t h) {
  if (of.size() < end + size_t(2)) of.resize(of.size() + of.size() / 8 + 2);
  const uint32_t g = of[h], c = addClosed();
  pair(h, c), pair(g, c + 1);
}

void ClosableTwins::open() {
  for (uint32_t c = outside + 2; c < end; c += 2) pair(of[c], of[c + 1]);
  end = outside + 2;
}

void ClosableTwins::fromPlain(ArrayView<const uint32_t> plain) {
  const uint32_t halves = uint32_t(plain.size());
  reset(halves, 0);
  // The half-edge opposite corner k begins at the next corner.
  for (uint32_t h = 0; h < halves; ++h) {
    const uint32_t g = plain[nextInTriangle(h)];
    of[h] = g == kNone ? outside : prevInTriangle(g);
  }
}

void ClosableTwins::toPlain(ArrayView<uint32_t> plain) {
  open();
  for (uint32_t h = 0; h < plain.size(); ++h) {
    const uint32_t g = of[prevInTriangle(h)];
    plain[h] = g == outside ? kNone : nextInTriangle(g);
  }
}

uint32_t TriangleMesh::create(uint32_t a, uint32_t b, uint32_t c) {
  uint32_t h = uint32_t(corners.size());
  if (unused.empty()) {
    corners.resize(corners.size() + 3);
    twins.resize(corners.size());
  } else {
    h = 3 * unused.back();
    unused.pop_back();
  }
  corners[h] = a, corners[h + 1] = b, corners[h + 2] = c;
  twins[h] = twins[h + 1] = twins[h + 2] = kNone;
  return h;
}

void TriangleMesh::discard(uint32_t t) {
  for (uint32_t h = 3 * t; h < 3 * t + 3; ++h) corners[h] = twins[h] = kNone;
  unused.push_back(t);
}

void TriangleMesh::findEdges() {
  edgeFrom.assign(at.size(), kNone);
  for (uint32_t h = 0; h < corners.size(); ++h)
    if (edgeFrom[corners[h]] == kNone || twins[h] == kNone) edgeFrom[corners[h]] = h;
}

void TriangleMesh::flip(uint32_t h) {
  const uint32_t g = twins[h], h1 = nextInTriangle(h), g1 = nextInTriangle(g);
  const uint32_t c = apex(h), d = apex(g), acrossH1 = twins[h1], acrossG1 = twins[g1];
  moveEdge(g1, h);  // from a
  moveEdge(h1, g);  // from b
  corners[h1] = d;
  corners[g1] = c;
  setTwins(h, acrossG1);
  setTwins(g, acrossH1);
  setTwins(h1, g1);
}

void TriangleMesh::splitTriangle(uint32_t h, uint32_t v) {
  const uint32_t h1 = nextInTriangle(h), h2 = prevInTriangle(h);
  const uint32_t b = corners[h1], c = corners[h2];
  const uint32_t across1 = twins[h1], across2 = twins[h2];
  const uint32_t p = create(b, c, v), q = create(c, corners[h], v);
  moveEdge(h1, p);
  moveEdge(h2, q);
  corners[h2] = v;
  setTwins(p, across1);
  setTwins(q, across2);
  setTwins(h1, p + 2);     // b v
  setTwins(p + 1, q + 2);  // c v
  setTwins(q + 1, h2);     // a v
  if (!edgeFrom.empty()) edgeFrom[v] = h2;
}

void TriangleMesh::splitEdge(uint32_t h, uint32_t v) {
  const uint32_t g = twins[h], h1 = nextInTriangle(h), g1 = nextInTriangle(g);
  const uint32_t a = corners[h], b = corners[h1], c = apex(h), d = apex(g);
  const uint32_t acrossBc = twins[h1], acrossAd = twins[g1];
  // h: a v c, p: v b c; g: b v d, q: v a d.
  const uint32_t p = create(v, b, c), q = create(v, a, d);
  moveEdge(h1, p + 1);
  moveEdge(g1, q + 1);
  corners[h1] = v;
  corners[g1] = v;
  setTwins(p + 1, acrossBc);
  setTwins(q + 1, acrossAd);
  setTwins(h1, p + 2);  // v c
  setTwins(g1, q + 2);  // v d
  setTwins(h, q);       // a v
  setTwins(g, p);       // b v
  if (!edgeFrom.empty()) edgeFrom[v] = h1;
}

void TriangleMesh::insert(Place place, uint32_t v, std::vector<uint32_t>& opposite) {
  if (place.onEdge)
    splitEdge(place.edge, v);
  else
    splitTriangle(place.edge, v);
  // The edges around v: opposite to it in the triangle of each half-edge out of it.
  const uint32_t first = place.onEdge ? nextInTriangle(place.edge) : prevInTriangle(place.edge);
  uint32_t h = first;
  do {
    opposite.push_back(nextInTriangle(h));
    h = twins[prevInTriangle(h)];
  } while (h != first);
}

uint32_t legalize(TriangleMesh& mesh, std::vector<uint32_t>& edges, uint32_t budget, Work& work) {
  // First come, first served, so that a budget is spent on all of the mesh.
  for (size_t i = 0; i < edges.size() && budget > 0; ++i) {
    const uint32_t h = edges[i];
    if (!work.tick(32)) break;
    if (!mesh.isIllegal(h)) continue;
    const uint32_t g = mesh.twins[h];
    mesh.flip(h);
    --budget;
    edges.insert(edges.end(), {h, prevInTriangle(h), g, prevInTriangle(g)});
    if (i >= kForget) {
      edges.erase(edges.begin(), edges.begin() + ptrdiff_t(i) + 1);
      i = size_t(-1);
    }
  }
  edges.clear();
  return budget;
}

}  // namespace sf
