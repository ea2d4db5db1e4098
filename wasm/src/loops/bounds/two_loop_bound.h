// R of relaxed_bound.h for two loops, in arrays over the spanning edges without a hash table.
// Source: none in Zou, Ju, Carr 2013; see relaxed_bound.h.
//
// A domain with both loops on its boundary lies between the access edge and a *closing* edge pq,
// which waits to be closed. Its boundary has a run of loop A that ends at p, and a run of loop B
// from q on, forward or backward. All domains with the same closing edge and direction form a
// *context*. Within it a domain is a *front*, known by its access edge; if that ends at q as
// well, there are two: B is passed not at all or wholly. Contexts do not depend on each other. Of
// each, only the fronts with all of B are kept, which case I needs; when the exact solver needs
// others, their context is computed again.
#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "base/charge.h"
#include "loops/domains/lower_bound.h"
#include "loops/domains/pass.h"
#include "loops/one_loop/angular_transform.h"

namespace sf {

class TwoLoopBound final : public LowerBound {
 public:
  /// Two loops; the root is the edge from `rootVertex` to the next vertex of its loop.
  TwoLoopBound(const Pass& pass, uint32_t rootVertex);

  /// Time: two contexts for each side of a triangle that closes a surface; each context visits all
  /// spanning edges, in time linear in their degrees. Over all triples that is O(a^2 b^2 (a + b))
  /// for loops of a and b vertices. Memory: some numbers for each candidate, and one context. False
  /// when the work ended; or at once, if the time would exceed that of `maxSplits` splits in
  /// RelaxedBound.
  bool compute(uint64_t maxSplits);

  double rootBound() const override { return rootBound_; }
  double value(Shape shape, uint32_t slot) override;
  uint64_t domainCount() const { return domainCount_; }

  /// Memory for the contexts that are kept for the exact solver; at least one is kept. Tests change
  /// it, so that contexts are computed again on small input too.
#ifdef SF_TESTING
  static inline double contextBytes = 48e6;
#else
  static constexpr double contextBytes = 48e6;
#endif

 private:
  /// A candidate edge between the loops. They are numbered by place on A, then by number on B.
  struct SpanningEdge {
    uint32_t edge;    // in the candidate set
    uint32_t place;   // on A, from the root on
    uint32_t number;  // within B
    uint32_t first;   // of its incidences
    uint32_t column;  // number of incidences before it at edges to the same vertex of B
  };
  /// A triangle at a spanning edge: its cost as the first triangle of a front, and the front that
  /// is left after it. The incidences of a spanning edge are consecutive and sorted by angle.
  struct Incidence {
    double theta;
    double base[2];   // w(t) and what fills the run that t cuts off; [1]: B backward
    uint32_t apex;    // place on A, or number within B
    uint32_t rest;    // the triangle's incidence at the edge that is left
    uint32_t column;  // of that incidence, in fronts with all of B
    bool isOnA;
  };
  struct Context {
    uint32_t closing = kNone;  // spanning edge from p to q
    bool reversed = false;     // whether B is passed backward
    uint64_t lastUse = 0;
    std::vector<double> values;  // by incidence, up to the place of p
    std::vector<double> whole;   // of fronts with all of B, by column
  };

  uint32_t vertexA(uint32_t place) const { return firstA_ + (place + rootPlace_) % sizeA_; }
  uint32_t placeOf(uint32_t v) const { return (v - firstA_ + sizeA_ - rootPlace_) % sizeA_; }
  bool isOnA(uint32_t v) const { return v - firstA_ < sizeA_; }
  uint32_t incidenceEnd(uint32_t place) const { return spans_[firstSpan_[place + 1]].first; }
  void findSpanningEdges();
  bool buildIncidences();
  std::vector<uint32_t> chordsByLength() const;
  std::pair<uint32_t, uint32_t> endsOf(uint32_t chord) const;
  uint64_t findContexts(const std::vector<uint32_t>& chords, std::vector<uint8_t>& wanted) const;
  double segmentValue(uint32_t t, uint32_t opposite, uint32_t start, uint32_t end) const;
  bool computeContext(Context& c);
  void computeFront(Context& c, const SpanningEdge& access, uint32_t length);
  void keepStarts(const Context& c);
  bool computeWithHole(uint32_t chord);
  Context& contextOf(uint32_t closing, Segment b);

  const Pass& pass_;
  Charge memory_;
  AngularTransform transform_;
  uint32_t firstA_, sizeA_, rootPlace_, firstB_, sizeB_;
  std::vector<SpanningEdge> spans_;   // and one more, to mark the end of the last one
  std::vector<uint32_t> firstSpan_;   // [sizeA + 1] by place
  std::vector<uint32_t> spanOf_;      // [edges]
  std::vector<uint32_t> columnSize_;  // [sizeB]
  std::vector<Incidence> incidences_;
  std::vector<uint32_t> incidenceOf_;  // [slots]
  std::vector<double> leastPair_;      // [slots]
  std::vector<double> starts_;         // case I: by triangle and direction of B
  std::vector<double> withHole_;       // [slots] the runs of A with B as hole, by access triangle
  std::vector<Context> contexts_;      // those last asked for
  std::vector<uint32_t> contextAt_;    // by closing edge and direction of B: in contexts_, or kNone
  size_t mostContexts_ = 1;
  double contextBytes_ = 0;
  uint64_t uses_ = 0, domainCount_ = 0;
  double rootBound_ = kInfinity;
  // Scratch of one front: triangles on either side of its access edge.
  std::vector<double> innerTheta_, innerBase_, outerTheta_, outerValue_;
  std::vector<uint32_t> outer_;
};

}  // namespace sf
