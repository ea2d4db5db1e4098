#include "triangles/locate.h"

#include "base/turn.h"

namespace sf {
namespace {

using Place = TriangleMesh::Place;

double side(const TriangleMesh& mesh, uint32_t h, Point2 p) {
  return turn(mesh.at[mesh.from(h)], mesh.at[mesh.to(h)], p);
}

/// Where p lies in the triangle of h, if it does.
Place inside(const TriangleMesh& mesh, uint32_t h, Point2 p) {
  Place place{h, false};
  for (int k = 0; k < 3; ++k, h = nextInTriangle(h)) {
    const double s = side(mesh, h, p);
    if (s < 0) return {};
    if (s == 0) place = {h, true};
  }
  return place;
}

}  // namespace

uint32_t Locator::random() {
  random_ ^= random_ << 13;
  random_ ^= random_ >> 17;
  random_ ^= random_ << 5;
  return random_;
}

Place Locator::walk(const TriangleMesh& mesh, uint32_t h, Point2 p, uint32_t steps) {
  for (uint32_t entered = kNone; steps > 0; --steps) {
    if (random() & 0x10000) h = nextInTriangle(h);
    uint32_t exit = kNone;
    for (int k = 0; k < 3 && exit == kNone; ++k, h = nextInTriangle(h))
      if (h != entered && side(mesh, h, p) < 0) exit = h;
    if (exit == kNone) return inside(mesh, h, p);
    h = entered = mesh.twins[exit];
    if (h == kNone) return {};
  }
  return {};
}

Place Locator::locate(const TriangleMesh& mesh, uint32_t h, Point2 p) {
  const Place place = walk(mesh, h, p, 8 * mesh.triangleCount());
  if (place.edge != kNone) return place;
  for (uint32_t t = 0; t < mesh.triangleCount(); ++t) {
    const Place found = mesh.inUse(t) ? inside(mesh, 3 * t, p) : Place{};
    if (found.edge != kNone) return found;
  }
  return {};
}

}  // namespace sf
