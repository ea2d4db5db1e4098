// Where the grid of a face is whole, and where trimming curves cut it.
//
// Source: Kumar, sec. 3: intersections of the trimming polygons with the strips between u-lines, each sorted along v and marked
// by the side on which the polygon lies; between them quads, and around them a planar straight-line graph for the triangulator.
// Differs:
// - Each segment marks the rows of cells that it meets in each strip. Rows that are not marked are whole, inside or outside,
//   and which follows from the signs of the segments below. So strips need not be matched with their neighbours, the two cases
//   of figure 2 are none, and segments along a line are like all others.
// - Cells that a segment only comes near to count as met. So no vertex of the grid is much nearer to a trimming curve than a
//   part of a cell, triangles between them are not thin, and rounding decides nothing.
#pragma once
#include <cstdint>
#include <vector>

#include "base/array_view.h"
#include "base/point2.h"

namespace sf {

/// Rows of whole cells in a strip between two u-lines.
struct CellRun {
  uint32_t strip, first, end;
};

class Trace {
 public:
  /// Traces rings over the grid of some lines, which cover them.
  ///   at       the rings' vertices; the polygon is to the left of each ring
  ///   starts   [r+1]
  ///   us, vs   rising, at least two each
  void run(ArrayView<const Point2> at, ArrayView<const uint32_t> starts, ArrayView<const double> us,
           ArrayView<const double> vs);

  /// Whole cells inside, in order of strips and rows.
  std::vector<CellRun> runs;
  // A vertex of the grid is named by i (number of v-lines) + j for the lines i and j.
  /// The border of the whole cells: rings of vertices, the cells to the right of each.
  std::vector<uint32_t> border;
  std::vector<uint32_t> borderStarts;  // [s+1]
  /// Vertices inside the polygon, between the border and the trimming curves, and not too near to these.
  std::vector<uint32_t> islands;

 private:
  struct Mark {
    uint32_t strip, first, end;  // rows
    int sign;  // 1 if the polygon lies above it along the middle of the strip, -1 below, 0 if it ends before
  };
  struct Crossing {
    uint32_t line;
    double v;
    int sign;
  };

  void measure();
  void markSegment(Point2 a, Point2 b);
  void markNear(uint32_t strip, uint32_t first, uint32_t end, Point2 a, Point2 b);
  void mark(const Mark& mark);
  void findRuns();
  void findBorder();
  void findIslands();
  static uint32_t intervalNear(ArrayView<const double> at, double x, uint32_t near);
  uint32_t name(uint32_t i, uint32_t j) const { return i * uint32_t(vs_.size()) + j; }

  ArrayView<const double> us_, vs_;
  // [cells] How near to a strip or a row a segment has to come to count as within; [lines] the reciprocals of distances
  // to the nearer line beside each.
  std::vector<double> marginU_, marginV_, perU_, perV_;
  uint32_t nearStrip_ = 0, nearRow_ = 0;  // of the last segment
  std::vector<Mark> marks_, sorted_;
  std::vector<uint32_t> firsts_;
  std::vector<Crossing> crossings_;
  std::vector<uint32_t> dirtyStarts_;  // [strips+1]
  std::vector<CellRun> dirty_;
  std::vector<uint8_t> isNear_;      // [vertices] too near to a trimming curve
  std::vector<uint8_t> directions_;  // [vertices] bits of the border's edges that leave
  std::vector<uint8_t> isOnBorder_;
};

}  // namespace sf
