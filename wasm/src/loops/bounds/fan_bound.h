// A lower bound on all surfaces from what happens around single vertices.
// Source: none in Zou, Ju, Carr 2013. Lagrangian decomposition (Guignard, Kim 1987) with subgradient
// ascent, for a property that the paper's surfaces have: the triangles at a vertex form one fan, from
// the one loop edge there to the other.
//
// Half of each dihedral angle belongs to either end of its edge, a third of each triangle's weight to
// each corner. Then the cost of a surface is the sum of the costs of its n fans, and the cheapest
// walks from loop edge to loop edge in the n vertex links bound it from below, of all choices with
// n + 2k - 4 triangles in total. Fans that are chosen by themselves disagree: a triangle is used at
// one corner but not at another. Multipliers that sum to zero over the corners of each triangle charge
// for that without changing the cost of any surface. For dihedral weights the bound so found is the
// optimum itself, or within a few per cent of it, at a price that grows with the number of
// candidates and not with that of domains.
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
  /// For sums only. Charges what it takes, mostly the labels of all walks: see bytesFor.
  FanBound(const LoopSet& loops, const CandidateSet& set, const std::vector<double>& triangleCost,
           Measure measure, Work& work);

  /// Up to `steps` steps of ascent, fewer once the bound stands still or reaches `target`. False
  /// when the work ended.
  ///   target  cost of a known surface, or infinity
  bool ascend(uint32_t steps, double target);

  /// No surface costs less. Infinity if some vertex has no fan: there is no surface.
  double lowerBound() const { return best_; }

  /// What fans cost where the bound is best, to see by it which triangles and domains are dear.
  FanCosts costs() const;
  const FanLinks& links() const { return links_; }

  /// About how many nanoseconds a step of ascent takes.
  double timeOfStep() const { return kTimeOfLabel * double(walks_.size()); }

  /// Grows with the square of the number of edges at a vertex, so that hubs make it large.
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
  double triangleTotal_;            // n + 2k - 4
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
