// R of relaxed_bound.h for two loops and many candidates, in dense arrays without a hash table.
// Source: none in Zou, Ju, Carr 2013; see relaxed_bound.h.
//
// A domain that has both loops on its boundary lies between a *closing* edge, which waits, and the
// access edge: a run of loop A before its end p, and a run of loop B from q on, forward or backward.
// All domains with the same closing edge and direction form a *context*. In it, each is a
// *front*: how far the access edge is from p along A and from q along B. Contexts do not depend on
// each other. Only what case I asks of one, the fronts with all of B, is kept; when the exact solver
// asks for others, their context is computed again.
#pragma once
#include <cstdint>
#include <vector>

#include "base/charge.h"
#include "loops/angular_transform.h"
#include "loops/lower_bound.h"
#include "loops/pass.h"

namespace sf {

class TwoLoopBound final : public LowerBound {
 public:
  /// Two loops; the root is the edge from `rootVertex` to the next vertex of its loop.
  TwoLoopBound(const Pass& pass, uint32_t rootVertex);

  /// O(a^2 b^2) fronts, a and b the sizes of the loops, each linear in the degree of its edge;
  /// O(a b (a + b)) numbers of memory. False when the work ended.
  bool compute();

  double rootBound() const override { return rootBound_; }
  double value(Shape shape, uint32_t slot) override;
  uint64_t domainCount() const { return domainCount_; }

  /// Of the contexts that are kept for the exact solver; at least one is. Tests change it, so that
  /// contexts are computed again on small input too.
#ifdef SF_TESTING
  static inline double contextBytes = 48e6;
#else
  static constexpr double contextBytes = 48e6;
#endif

 private:
  struct Context {
    uint32_t end = kNone;   // place of p in loop A
    uint32_t first = 0;     // vertex q of loop B
    bool reversed = false;  // whether B is passed backward
    uint64_t lastUse = 0;
    std::vector<size_t> offset;  // by place on A and length on B: first value, or kNoEdge
    std::vector<double> values;  // by offset and index of the slot at the access edge
  };
  static constexpr size_t kNoEdge = ~size_t(0);
  /// A triangle at an edge between the loops: what it costs by itself as the first of a front, and
  /// where the front that is left goes on.
  struct Incidence {
    double theta;
    double base[2];  // w(t) joined with what fills the run that t cuts off; for B passed backward
    uint32_t apex;   // place on A, or number within B
    bool isOnA;
    uint32_t ownIndex;  // of the slot at this edge
    uint32_t index;     // of the slot at the edge that is left
  };

  uint32_t vertexA(uint32_t place) const { return firstA_ + (place + rootPlace_) % sizeA_; }
  uint32_t placeOf(uint32_t v) const { return (v - firstA_ + sizeA_ - rootPlace_) % sizeA_; }
  bool buildIncidences();
  uint32_t vertexB(const Context& c, uint32_t length) const {
    const uint32_t at = c.first - firstB_;
    return firstB_ + (c.reversed ? at + 2 * sizeB_ - length : at + length) % sizeB_;
  }
  uint32_t lengthTo(const Context& c, uint32_t v) const {
    const uint32_t step = v + sizeB_ - c.first;
    return (c.reversed ? 2 * sizeB_ - step : step) % sizeB_;
  }
  double segmentValue(uint32_t t, uint32_t opposite, uint32_t start, uint32_t end) const;
  bool computeContext(Context& c);
  void computeFront(Context& c, uint32_t place, uint32_t length);
  bool computeWithHole(uint32_t x, uint32_t y);
  size_t contextNumber(uint32_t end, uint32_t b, bool reversed) const {
    return (size_t(end) * sizeB_ + (b - firstB_)) * 2 + reversed;
  }
  Context& contextOf(Segment a, Segment b);
  double& start(uint32_t place, uint32_t end, uint32_t b, bool reversed) {
    return starts_[contextNumber(end, b, reversed) * sizeA_ + place];
  }
  void apply(uint32_t edge, double* values);

  const Pass& pass_;
  Charge memory_;
  AngularTransform transform_;
  uint32_t firstA_, sizeA_, rootPlace_, firstB_, sizeB_;
  std::vector<double> leastPair_;   // [slots]
  std::vector<double> starts_;      // case I: by place on A, end of A, vertex and direction of B
  std::vector<size_t> holeOffset_;  // [sizeA^2] domains of one run of A with B as hole
  std::vector<double> holeValues_;
  std::vector<Context> contexts_;  // those last asked for
  std::vector<uint32_t>
      contextAt_;  // by end of A, vertex and direction of B: in contexts_, or kNone
  size_t mostContexts_ = 1;
  double contextBytes_ = 0;
  uint64_t uses_ = 0, domainCount_ = 0;
  double rootBound_ = kInfinity;
  std::vector<size_t> firstIncidence_;  // [sizeA sizeB + 1] of the edges between place and number
  std::vector<Incidence> incidences_;   // by edge and angle
  std::vector<double> innerTheta_, innerBase_, outerTheta_, outerValue_;
  std::vector<uint32_t> outerIndex_;
};

}  // namespace sf
