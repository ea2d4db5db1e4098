// The samples of an edge, the same for all its faces.
//
// Source: Kumar, sec. 2: no samples are added to one face alone, which would open cracks; sec. 4.2: more samples where those of
// two curves cross though the curves do not.
// Differs: samples are the ends of intervals that are halved, so that those for a coarser tolerance are among those for a finer
// one. How far an interval's chord is off is measured once and kept, so that another tolerance, or a camera that moves, only
// walks down the tree.
#pragma once
#include <cstdint>
#include <vector>

#include "surface/model.h"
#include "surface/sampling.h"

namespace sf {

struct EdgeSample {
  double t;
  Vec3 at;
  uint32_t node;  // the interval that begins here, or kNone at the end
};

class EdgeTree {
 public:
  /// For an edge that some face uses. Intervals begin at its ends and wherever it has a corner in space or in a domain.
  ///   uses  those of the edge
  EdgeTree(const Model& model, uint32_t edge, ArrayView<const uint32_t> uses);

  /// The samples in order of the parameter, both ends included. Two for a degenerate edge.
  ///   longest  most length of an interval
  void select(const Fineness& fineness, double longest, std::vector<EdgeSample>& samples);
  /// Whether another selection would be the one before. It may say no though it would.
  bool isSettled(const Fineness& fineness, double longest) const;
  /// The last selection was thrown away.
  void unsettle() { settled_ = {}; }
  /// Halves an interval from now on, whatever the tolerance. False if it is too short to be halved: its curve is the
  /// culprit, not its samples.
  bool force(uint32_t node);
  /// Halves an interval for as long as no more is allowed than now: the surface of a face is off there, though the edge is not.
  /// False as above.
  bool raise(uint32_t node, const Fineness& fineness);
  /// Where a curve crosses itself, no halving helps: takes an interval, and with it what was halved by force around it, back to
  /// the one above, from now on. False at the top.
  bool freeze(uint32_t node);
  /// Whether two intervals lie closely on both sides of a corner: where they cross, two pieces of the curve overshoot it.
  bool overshoots(uint32_t node, uint32_t other) const;
  /// How many intervals are halved by force.
  uint32_t forced() const { return forced_; }

  /// The place of its beginning, 0, or its end, 1.
  Vec3 end(int which) const { return which == 0 ? breakPoints_.front() : breakPoints_.back(); }

 private:
  struct Node {
    double a, b;
    Vec3 middle;             // of the curve
    double error;            // most distance of the curve from the chord
    double turn;             // of its tangent, radians
    double chord;            // its length
    uint32_t child = kNone;  // the first of two
    uint32_t parent = kNone;
    bool isForced = false, isFrozen = false;
    bool isHalved = false;  // at the last selection
  };

  /// When the last selection stays as it is.
  struct Settled {
    bool isSo = false;
    double angle = 0, hysteresis = 1;
    double leafError = 0, leafChord = 0;  // the largest of intervals that are not halved
    // The least of those that are halved for that reason.
    double halvedError = Sampling::kNoLimit, halvedChord = Sampling::kNoLimit;
  };

  Vec3 at(double t) const;
  bool canHalve(uint32_t node) const;
  uint32_t spansBetween(double a, double b) const;
  uint32_t add(double a, Vec3 from, double b, Vec3 to);
  void halve(uint32_t node, Vec3 from, Vec3 to);

  const Model* model_;
  uint32_t edge_;
  std::vector<double> breaks_;
  std::vector<Vec3> breakPoints_;
  std::vector<Node> nodes_;  // the first are the intervals between breaks
  uint32_t forced_ = 0;
  Vec3 middle_{};  // of a ball around the edge
  double radius_ = 0;
  Settled settled_;
};

}  // namespace sf
