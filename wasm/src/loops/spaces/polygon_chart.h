// The cheap splits of every segment of one polygon, in which near-optimal surfaces are looked for.
// Source: eq. 2 of Zou, Ju, Carr 2013, sec. 3.1, truncated: of the triangles that may stand across
// a segment only the few cheapest are kept, in place of all of them.
// Differs: eq. 2 needs the best inner triangle for each outer one. Dihedral angles are distances on
// the sphere of normals, so a triangle whose cost exceeds that of another by at least the angle
// between the two is never needed; of the others the cheapest are nearly always enough. In return
// it has only single precision, tries a handful of triangles for each of n^2 / 2 segments, and
// proves nothing.
#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "base/charge.h"
#include "base/work.h"
#include "loops/problem/candidate_set.h"

namespace sf {

class PolygonChart {
 public:
  /// A corner of a closed polygon over vertices of the loops; a vertex may be at several corners.
  struct Corner {
    uint32_t vertex;
    bool hasFace;  // a face is given across the edge to the next corner,
    Vec3 normal;   // with this unit normal, for the polygon's direction
  };

  /// A triangle: its corners in the order of the polygon, and its excess. That is how much more
  /// than the best surface the best one with this triangle costs, of those in the chart.
  struct Triangle {
    float excess;
    uint32_t corner[3];  // increasing
  };

  /// weights: without own weights; `normals` is not read.
  PolygonChart(const LoopSet& loops, const TriangleWeights& weights, Work& work);

  /// Fills the chart. False when the work ended. O(n^2) segments, each O(n) steps of a fraction of
  /// a nanosecond and some ten triangles; of long polygons only O(n log n) segments are kept.
  bool compute(std::vector<Corner> corners);

  /// The cost of the best surface in the chart, in single precision; infinity if there is none.
  double best() const { return best_; }
  /// The best surface: appends n - 2 triangles with excess 0. The first is at the edge that closes
  /// the polygon, the last corner with the first. Precondition: best() is finite.
  void trace(std::vector<Triangle>& triangles) const;
  /// Appends up to `most` triangles whose excess is at most `excess`: those of least excess.
  void nearBest(double excess, size_t most, std::vector<Triangle>& triangles);

  /// Bytes that a polygon of n corners takes.
  static double bytesFor(uint32_t n);

 private:
  static constexpr uint32_t kSplits = 4, kRoom = 32;
  using Float4 = float __attribute__((vector_size(16)));
  /// Splits of a segment, by increasing cost, with the unit normals of their triangles.
  struct Splits {
    Float4 cost;  // infinity: none
    Float4 x, y, z;
  };
  struct Segment {
    uint32_t first, last;
    uint32_t apex[kSplits];
  };
  using Ranked = std::pair<float, uint32_t>;
  struct Normal {
    float x, y, z;
  };
  /// The apexes tried for a segment: costs and normals, and room for a group of four more.
  struct Tried {
    uint32_t count;
    uint32_t apex[kRoom + 4];
    float cost[kRoom + 4], x[kRoom + 4], y[kRoom + 4], z[kRoom + 4];
  };

  static Splits noSplits();
  Float4 angles(Float4 ax, Float4 ay, Float4 az, Float4 bx, Float4 by, Float4 bz) const;
  Float4 costsFrom(const Splits& splits, Normal normal) const;
  void weigh(uint32_t first, uint32_t last, Tried& tried) const;
  void choose(Tried& tried, Splits& splits, Segment& segment) const;
  template <bool wanted>
  float boundApexes(uint32_t first, uint32_t last);
  void selectApexes(uint32_t first, uint32_t last, float most);
  void narrowApexes(uint32_t first, float most);
  void tryApexes(uint32_t first, uint32_t last, Splits& splits, Segment& segment);
  bool split(uint32_t first, uint32_t last, Splits& splits, Segment& segment);
  float price(uint32_t first, uint32_t last) const { return price_[last] - price_[first]; }
  void findPrices();
  void keep(const Splits& splits, const Segment& segment);
  static void keepLeast(std::vector<Ranked>& ranked, size_t count);
  bool computeLength(uint32_t length);
  void addEdges();
  void weighRoot();

  const LoopSet& loops_;
  float areaWeight_, perimeterWeight_, angle_[4];
  Work& work_;
  Charge memory_;
  uint64_t charged_ = 0;
  std::vector<Corner> corners_;
  std::vector<Normal> positions_;  // from the first corner
  uint32_t n_ = 0;
  double best_ = 0;
  std::vector<Splits> splits_;  // by segment
  std::vector<Segment> segments_;
  std::vector<float> cost_;       // [n^2] by first and last, and by last and first
  std::vector<uint32_t> number_;  // the same, where the cost is finite
  float gap_ = 0;                 // how far above the least bound splits are tried first
  float gapSum_ = 0;              // of the segments of one length: cost beyond the least bound
  std::vector<float> bound_;      // scratch
  std::vector<uint32_t> apexes_;  // scratch: those to try
  uint32_t apexCount_ = 0;
  Tried tried_;                 // scratch
  std::vector<float> price_;    // of the edges before each corner, once it is needed
  std::vector<Ranked> ranked_;  // scratch: by bound, first corners
};

}  // namespace sf
