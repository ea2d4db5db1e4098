// Flips of edges after which the triangles need fewer strips and swaps.
//
// Source: Kumar, sec. 4.1: triangles are made so that strips are long.
// Differs: the paper's strips depend on the order in which one uni-monotone polygon is cut up. But
// a tooth of a comb or a star ends a strip in any order. Which diagonal of two triangles is better
// for strips shows only over all polygons. There it is known exactly: the least index counts along
// a spanning forest (strip_forest.h) before and after a flip differ in few terms.
#pragma once
#include <cstdint>
#include <vector>

#include "base/work.h"
#include "polygon/strips/strip_forest.h"
#include "triangles/triangle_mesh.h"

namespace sf {

class StripFlips {
 public:
  /// Flips edges of the forest while that saves indices and no triangle gets much thinner than both
  /// were before. False when the work ended. O(m) time if the effects of flips end nearby, as
  /// nearly all do; effects that reach far are not followed.
  bool run(TriangleMesh& mesh, Work& work);
  /// The cost of the strips along the forest afterwards, in the unit of StripCosts.
  int64_t cost() const { return forest_.total(); }

 private:
  /// An edge of the forest, and the result of flipping it.
  struct Flip {
    uint32_t edge;         // half-edge of the lower triangle
    uint32_t upper;        // number of the triangle that is the upper one afterwards
    StripCosts low, high;  // afterwards
    int saved;             // in the unit of StripCosts
  };

  bool tryFlip(uint32_t t);
  bool isFair(uint32_t h) const;
  bool foresee(uint32_t h, Flip& flip);
  int changeAbove(uint32_t t, StripCosts costs);
  void carryOut(const Flip& flip);

  TriangleMesh* mesh_ = nullptr;
  double thinner_ = 1;
  StripForest forest_;
  struct Change {
    uint32_t triangle;
    StripCosts costs;
  };
  std::vector<Change> above_;      // changes further up by the flip that is looked at
  std::vector<uint32_t> waiting_;  // triangles whose edge upwards has to be looked at
};

}  // namespace sf
