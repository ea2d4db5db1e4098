#include "mesh/bvh.h"

#include <cmath>

#include "base/sort.h"

namespace sf {
namespace {

constexpr size_t kLeaf = 4;

double along(Vec3 p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

}  // namespace

Box Box::ofTriangle(MeshView mesh, uint32_t face) {
  Box box = of(pointAt(mesh.positions, mesh.faces[3 * size_t(face)]));
  for (size_t k = 1; k < 3; ++k)
    box.add(of(pointAt(mesh.positions, mesh.faces[3 * size_t(face) + k])));
  return box;
}

void Box::add(const Box& b) { low = lowest(low, b.low), high = highest(high, b.high); }

double Box::reach() const {
  double most = 0;
  for (const Vec3& p : {low, high})
    most = std::fmax(most, std::fmax(std::fabs(p.x), std::fmax(std::fabs(p.y), std::fabs(p.z))));
  return most;
}

bool TriangleTree::build(MeshView mesh, uint32_t from, uint32_t to, Work& work, Charge& charge) {
  nodes_.clear(), faces_.clear();
  const size_t count = to - from;
  if (count == 0) return work.going();
  Charge items(work);
  // There are fewer nodes than faces, unless there is but one of each.
  if (!items.add(count * sizeof(Item)) || !reserve(faces_, count, charge) ||
      !reserve(nodes_, count + 1, charge))
    return false;
  std::vector<Item> list(count);
  for (uint32_t f = from; f < to; ++f) {
    const uint32_t* v = &mesh.faces[3 * size_t(f)];
    const Vec3 a = pointAt(mesh.positions, v[0]), b = pointAt(mesh.positions, v[1]),
               c = pointAt(mesh.positions, v[2]);
    list[f - from] = {(1.0 / 3) * a + (1.0 / 3) * b + (1.0 / 3) * c, f};
  }
  divide(list, work);
  refit(mesh);
  return work.going();
}

/// Adds the node of some faces and all nodes below. Each half has a third of them at least, or the number of calls
/// on each other would not be logarithmic.
void TriangleTree::divide(ArrayView<Item> items, Work& work) {
  const uint32_t at = uint32_t(nodes_.size());
  nodes_.push_back({Box{}, 0, uint32_t(faces_.size()), 0});
  if (items.size() <= kLeaf || !work.tick(uint32_t(items.size()) * 8)) {
    nodes_[at].count = uint32_t(items.size());
    for (const Item& item : items) faces_.push_back(item.face);
  } else {
    Box box = Box::of(items[0].centre);
    for (const Item& item : items) box.add(Box::of(item.centre));
    const Vec3 extent = box.high - box.low;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                     : extent.y >= extent.z                       ? 1
                                                                  : 2;
    auto less = [axis](const Item& a, const Item& b) {
      return along(a.centre, axis) < along(b.centre, axis);
    };
    // Quickselect, content with anything near the median.
    const size_t least = items.size() / 3, most = items.size() - least;
    size_t low = 0, high = items.size(), half = high / 2;
    for (int tries = 0; high - low > 2 && tries < 64; ++tries) {
      const size_t split = low + sorting::partition(items.data() + low, high - low, less);
      if (split >= least && split <= most) {
        half = split;
        break;
      }
      (split < least ? low : high) = split;
    }
    divide(items.slice(0, half), work);
    divide(items.slice(half, items.size() - half), work);
  }
  nodes_[at].next = uint32_t(nodes_.size());
}

void TriangleTree::refit(MeshView mesh) {
  for (size_t i = nodes_.size(); i-- > 0;) {
    Node& node = nodes_[i];
    if (node.count == 0) {
      node.box = nodes_[i + 1].box;
      node.box.add(nodes_[nodes_[i + 1].next].box);
      continue;
    }
    node.box = Box::ofTriangle(mesh, faces_[node.first]);
    for (uint32_t k = 1; k < node.count; ++k)
      node.box.add(Box::ofTriangle(mesh, faces_[node.first + k]));
  }
}

}  // namespace sf
