// A tree of boxes about the triangles of a mesh.
// Source: Smits 1998, "Efficiency issues for ray tracing", for the order of nodes, which needs no stack; Ericson 2004,
// "Real-time collision detection", ch. 6.
#pragma once
#include <cstdint>
#include <vector>

#include "base/charge.h"
#include "base/vec.h"
#include "base/work.h"
#include "mesh/mesh.h"

namespace sf {

struct Box {
  Vec3 low, high;

  static Box of(Vec3 p) { return {p, p}; }
  static Box ofTriangle(MeshView mesh, uint32_t face);
  void add(const Box& other);
  bool meets(const Box& b) const {
    return low.x <= b.high.x && b.low.x <= high.x && low.y <= b.high.y && b.low.y <= high.y &&
           low.z <= b.high.z && b.low.z <= high.z;
  }
  /// The largest magnitude of a coordinate in it.
  double reach() const;
};

class TriangleTree {
 public:
  /// Makes the tree for the faces [from, to) of a mesh. O(m log m) time, about 70 bytes a face, which are charged to
  /// `charge`, and 30 more meanwhile. False when the work ended.
  bool build(MeshView mesh, uint32_t from, uint32_t to, Work& work, Charge& charge);
  /// Fits the boxes to other positions of the same faces. O(m) time.
  void refit(MeshView mesh);

  bool empty() const { return nodes_.empty(); }
  /// The box of all faces; the tree must not be empty.
  const Box& box() const { return nodes_[0].box; }

  /// Calls visit(face) for the faces whose boxes may meet a box, until it says false. Whether it never did.
  template <class Visit>
  bool visit(const Box& box, Visit&& visit) const {
    for (uint32_t i = 0; i < nodes_.size();) {
      const Node& node = nodes_[i];
      if (!node.box.meets(box)) {
        i = node.next;
        continue;
      }
      for (uint32_t k = 0; k < node.count; ++k)
        if (!visit(faces_[node.first + k])) return false;
      ++i;
    }
    return true;
  }

 private:
  // In preorder: the first child follows its parent, the second one is the `next` of the first.
  struct Node {
    Box box;
    uint32_t next;   // the node after all below this one
    uint32_t first;  // leaves: in faces_
    uint32_t count;  // 0 for the others
  };
  struct Item {
    Vec3 centre;
    uint32_t face;
  };
  void divide(ArrayView<Item> items, Work& work);

  std::vector<Node> nodes_;
  std::vector<uint32_t> faces_;
};

}  // namespace sf
