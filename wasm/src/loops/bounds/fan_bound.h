// A lower bound on all surfaces from what happens around single vertices.
// Source: none in Zou, Ju, Carr 2013. Lagrangian decomposition (Guignard, Kim 1987) with
// subgradient ascent, for a property that the paper's surfaces have: the triangles at a vertex form
// one fan, from the one loop edge there to the other.
//
// Give half of each dihedral angle to either end of its edge, and a third of each triangle's weight
// to each corner. Then a surface costs as much as its n fans together. Choose a walk from loop edge
// to loop edge in each of the n vertex links, with 3 (n + 2k - 4) triangles in total: the cheapest
// choice bounds the surfaces from below. Fans chosen one by one disagree: a triangle is used at one
// corner but not at another. Multipliers that sum to zero over the corners of each triangle charge
// for that, and do not change the cost of any surface. For dihedral weights the bound is the
// optimum itself, or within a few per cent of it. Its price grows with the number of candidates,
// not with that of domains.
#pragma once
#include <cstdint>
#include <vector>

#include "base/charge.h"
#include "loops/bounds/fan_estimate.h"
#include "loops/bounds/fan_links.h"
#include "loops/one_loop/angular_transform.h"
#include "loops/problem/candidate_set.h"
#include "loops/problem/weight.h"

namespace sf {

class FanBound {
 public:
  /// For sums only. Charges its memory, mostly labels of walks: see bytesFor.
  FanBound(const LoopSet& loops, const CandidateSet& set, const std::vector<double>& triangleCost,
           Measure measure, Work& work);

  /// Up to `steps` steps of ascent, fewer once the bound stands still or reaches `target`. False
  /// when the work ended.
  ///   target  cost of a known surface, or infinity
  bool ascend(uint32_t steps, double target);

  /// No surface costs less. Infinity if some vertex has no fan: then there is no surface.
  double lowerBound() const { return best_; }

  /// The costs of fans at which the bound is best.
  /// They show which triangles and domains are too dear.
  FanCosts costs() const;
  const FanLinks& links() const { return links_; }

  /// About how many nanoseconds a step of ascent takes.
  double timeOfStep() const { return kTimeOfLabel * double(walks_.size()); }

  /// Bytes that it takes. Grows with the square of the number of edges at a vertex, so that hubs
  /// make it large.
  static double bytesFor(const LoopSet& loops, const CandidateSet& set);

 private:
  /// Where the labels at a vertex begin.
  struct Labels {
    size_t firstWalk, firstCheapest;
  };
  using Vertex = FanLinks::Vertex;

  static constexpr double kTimeOfLabel = 12;

  double evaluate();
  double rounding(double bound) const;
  void labelWalks(uint32_t vertex);
  uint32_t arrivedFrom(const Vertex& v, const double* arrive, uint32_t left) const;
  double shareOut();
  void traceWalk(uint32_t vertex, uint32_t length);
  void gradient();

  FanLinks links_;
  Measure measure_;
  Work& work_;
  Charge memory_;
  double triangleTotal_;            // n + 2k - 4, the triangles of a surface
  std::vector<double> third_;       // [c] a third of w(t)
  std::vector<double> multiplier_;  // [3c]
  std::vector<double> bestMultiplier_;
  double price_ = 0, bestPrice_ = 0;  // of a triangle at a corner: what one more would save
  std::vector<Labels> labels_;        // by vertex
  std::vector<double> walks_;         // labels of arrivals, by vertex, length less 1, and spoke
  std::vector<double> cheapest_;  // by vertex and length less 1: the cheapest walk of that length
  std::vector<uint32_t> length_;  // [n] of the walk chosen at each vertex
  std::vector<uint32_t> used_;    // [3c] how often the walks use each corner
  std::vector<uint32_t> usedCorners_;
  std::vector<double> gradient_, direction_;  // [3c] of this step, and of the last one
  double best_ = -kInfinity, bestRounding_ = 0;
  double stride_ = 0;  // how far above the best bound the next step aims
  uint32_t idle_ = 0;
  std::vector<double> leave_;  // scratch
  AngularTransform transform_;
};

}  // namespace sf
