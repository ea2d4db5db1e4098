#include "surface/trace.h"

#include <algorithm>
#include <cmath>

#include "base/sort.h"

namespace sf {
namespace {

/// A cell counts as met if a segment comes nearer to it than this share of a cell.
constexpr double kMargin = 0.15;
/// A vertex inside is left out if a segment comes nearer to it than this share of a cell.
constexpr double kNearVertex = 0.35;

}  // namespace

/// The interval that x lies in, searched from a near one.
uint32_t Trace::intervalNear(ArrayView<const double> at, double x, uint32_t near) {
  const uint32_t last = uint32_t(at.size()) - 2;
  for (int steps = 0; steps < 8; ++steps) {
    if (x < at[near] && near > 0)
      --near;
    else if (x >= at[near + 1] && near < last)
      ++near;
    else
      return near;
  }
  const auto after = std::upper_bound(at.begin() + 1, at.end() - 1, x);
  return uint32_t(after - at.begin()) - 1;
}

void Trace::measure() {
  const auto each = [](ArrayView<const double> at, std::vector<double>& margins,
                       std::vector<double>& per) {
    const size_t cells = at.size() - 1;
    margins.resize(cells), per.resize(cells + 1);
    for (size_t i = 0; i < cells; ++i) margins[i] = kMargin * (at[i + 1] - at[i]);
    for (size_t i = 0; i <= cells; ++i) {
      const double before = i > 0 ? at[i] - at[i - 1] : at[1] - at[0];
      const double after = i < cells ? at[i + 1] - at[i] : before;
      per[i] = 1 / std::min(before, after);
    }
  };
  each(us_, marginU_, perU_);
  each(vs_, marginV_, perV_);
  nearStrip_ = nearRow_ = 0;
}

void Trace::run(ArrayView<const Point2> at, ArrayView<const uint32_t> starts,
                ArrayView<const double> us, ArrayView<const double> vs) {
  us_ = us, vs_ = vs;
  measure();
  marks_.clear(), crossings_.clear();
  isNear_.assign(us.size() * vs.size(), 0);
  for (size_t r = 0; r + 1 < starts.size(); ++r) {
    if (starts[r] == starts[r + 1]) continue;
    Point2 a = at[starts[r + 1] - 1];
    for (uint32_t i = starts[r]; i < starts[r + 1]; ++i) {
      markSegment(a, at[i]);
      a = at[i];
    }
  }
  findRuns();
  findBorder();
  findIslands();
}

/// Adds a mark, to that of the segment before if both are in one place.
void Trace::mark(const Mark& mark) {
  if (!marks_.empty()) {
    Mark& last = marks_.back();
    if (last.strip == mark.strip && mark.first <= last.end && last.first <= mark.end) {
      last.first = std::min(last.first, mark.first), last.end = std::max(last.end, mark.end);
      last.sign += mark.sign;
      return;
    }
  }
  marks_.push_back(mark);
}

void Trace::markSegment(Point2 a, Point2 b) {
  const Point2 low = a.x <= b.x ? a : b, high = a.x <= b.x ? b : a;
  const uint32_t strips = uint32_t(us_.size()) - 1, rows = uint32_t(vs_.size()) - 1;
  const uint32_t first = intervalNear(us_, low.x, nearStrip_),
                 last = intervalNear(us_, high.x, first);
  nearStrip_ = first;
  const double slope = high.x > low.x ? (high.y - low.y) / (high.x - low.x) : 0;
  const uint32_t from = first > 0 && low.x - us_[first] < marginU_[first - 1] ? first - 1 : first;
  const uint32_t to =
      last + 1 < strips && us_[last + 1] - high.x < marginU_[last + 1] ? last + 1 : last;
  for (uint32_t s = from; s <= to; ++s) {
    // The part of the segment over this strip and its margin.
    const double margin = marginU_[s];
    const double x0 = std::clamp(us_[s] - margin, low.x, high.x),
                 x1 = std::clamp(us_[s + 1] + margin, low.x, high.x);
    double y0 = x0 <= low.x ? low.y : x0 >= high.x ? high.y : low.y + slope * (x0 - low.x);
    double y1 = x1 >= high.x ? high.y : x1 <= low.x ? low.y : low.y + slope * (x1 - low.x);
    if (high.x == low.x) y0 = low.y, y1 = high.y;
    if (y0 > y1) std::swap(y0, y1);
    const uint32_t r0 = intervalNear(vs_, y0, nearRow_), r1 = intervalNear(vs_, y1, r0);
    nearRow_ = r0;
    const uint32_t lowest = r0 > 0 && y0 - vs_[r0] < marginV_[r0 - 1] ? r0 - 1 : r0;
    const uint32_t highest = r1 + 1 < rows && vs_[r1 + 1] - y1 < marginV_[r1 + 1] ? r1 + 1 : r1;
    const double middle = 0.5 * (us_[s] + us_[s + 1]);
    const bool crosses = low.x <= middle && middle < high.x;
    mark({s, lowest, highest + 1, crosses ? (a.x < b.x ? 1 : -1) : 0});
    markNear(s, lowest, highest + 1, a, b);
  }
  // Lines that it crosses: each from its left end on, without its right one.
  for (uint32_t i = first; i <= last + 1; ++i) {
    const double u = us_[i];
    if (!(low.x <= u && u < high.x)) continue;
    crossings_.push_back({i, low.y + slope * (u - low.x), a.x < b.x ? 1 : -1});
  }
}

/// Marks vertices of a strip's cells that are near to a segment, in units of the cells around them.
void Trace::markNear(uint32_t strip, uint32_t first, uint32_t end, Point2 a, Point2 b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  for (uint32_t i = strip; i <= strip + 1; ++i) {
    const double x = us_[i] - a.x, px = perU_[i], px2 = px * px;
    for (uint32_t j = first; j <= end; ++j) {
      uint8_t& near = isNear_[name(i, j)];
      if (near) continue;
      const double y = vs_[j] - a.y, py = perV_[j], py2 = py * py;
      const double square = dx * dx * px2 + dy * dy * py2, along = x * dx * px2 + y * dy * py2;
      const double t = along <= 0 ? 0 : along >= square ? 1 : along / square;
      const double ex = (x - t * dx) * px, ey = (y - t * dy) * py;
      near = ex * ex + ey * ey < kNearVertex * kNearVertex;
    }
  }
}

void Trace::findRuns() {
  const uint32_t strips = uint32_t(us_.size()) - 1, rows = uint32_t(vs_.size()) - 1;
  // By strips, and within them by rows.
  firsts_.assign(strips + 1, 0);
  for (const Mark& mark : marks_) ++firsts_[mark.strip];
  uint32_t sum = 0;
  for (uint32_t& first : firsts_) sum += first, first = sum - first;
  sorted_.resize(marks_.size());
  for (const Mark& mark : marks_) sorted_[firsts_[mark.strip]++] = mark;
  marks_.swap(sorted_);
  for (uint32_t s = 0, begin = 0; s < strips; begin = firsts_[s++])
    sf::sort(marks_.begin() + begin, marks_.begin() + firsts_[s],
             [](const Mark& a, const Mark& b) { return a.first < b.first; });
  runs.clear(), dirty_.clear();
  dirtyStarts_.assign(1, 0);
  size_t m = 0;
  for (uint32_t s = 0; s < strips; ++s) {
    uint32_t row = 0;
    int winding = 0;
    while (m < marks_.size() && marks_[m].strip == s) {
      const uint32_t first = marks_[m].first;
      if (first > row && winding > 0) runs.push_back({s, row, first});
      uint32_t end = marks_[m].end;
      for (; m < marks_.size() && marks_[m].strip == s && marks_[m].first <= end; ++m)
        end = std::max(end, marks_[m].end), winding += marks_[m].sign;
      dirty_.push_back({s, first, end});
      row = end;
    }
    if (row < rows && winding > 0) runs.push_back({s, row, rows});
    dirtyStarts_.push_back(uint32_t(dirty_.size()));
  }
}

void Trace::findBorder() {
  // Up, right, down, left; to turn left is to go one back.
  enum : uint32_t { kUp, kRight, kDown, kLeft };
  directions_.assign(isNear_.size(), 0);
  isOnBorder_.assign(isNear_.size(), 0);
  const auto leave = [&](uint32_t i, uint32_t j, uint32_t direction) {
    directions_[name(i, j)] |= uint8_t(1u << direction);
  };
  // On the left side of a run go up, along its top right, on the right side down; where two runs share a side, neither.
  const auto sides = [&](uint32_t s, uint32_t first, uint32_t end, size_t beside, size_t besideEnd,
                         bool isLeft) {
    uint32_t row = first;
    const auto pass = [&](uint32_t to) {
      for (; row < to; ++row) {
        if (isLeft)
          leave(s, row, kUp);
        else
          leave(s + 1, row + 1, kDown);
      }
    };
    for (size_t k = beside; k < besideEnd && runs[k].first < end; ++k) {
      if (runs[k].end <= row) continue;
      pass(std::max(row, std::min(runs[k].first, end)));
      row = std::max(row, std::min(runs[k].end, end));
    }
    pass(end);
  };
  const uint32_t strips = uint32_t(us_.size()) - 1;
  std::vector<uint32_t> starts(strips + 2, 0);
  for (const CellRun& run : runs) ++starts[run.strip + 1];
  for (uint32_t s = 0; s < strips; ++s) starts[s + 1] += starts[s];
  starts[strips + 1] = starts[strips];
  for (const CellRun& run : runs) {
    const uint32_t s = run.strip;
    leave(s, run.end, kRight);
    leave(s + 1, run.first, kLeft);
    sides(s, run.first, run.end, s > 0 ? starts[s - 1] : 0, s > 0 ? starts[s] : 0, true);
    sides(s, run.first, run.end, starts[s + 1], starts[s + 2 > strips ? strips : s + 2], false);
  }
  border.clear(), borderStarts.assign(1, 0);
  const uint32_t width = uint32_t(vs_.size());
  for (const CellRun& run : runs) {
    // Every ring has an edge along the top or the bottom of a run.
    for (const bool isTop : {true, false}) {
      uint32_t at = isTop ? name(run.strip, run.end) : name(run.strip + 1, run.first);
      uint32_t direction = isTop ? kRight : kLeft;
      if (!(directions_[at] >> direction & 1)) continue;
      while (directions_[at] >> direction & 1) {
        directions_[at] &= uint8_t(~(1u << direction));
        isOnBorder_[at] = 1;
        border.push_back(at);
        at = direction == kUp      ? at + 1
             : direction == kDown  ? at - 1
             : direction == kRight ? at + width
                                   : at - width;
        // Where whole cells touch at a corner, the one that is left alone stays to the left: turn left if possible.
        for (const uint32_t turned : {direction + 3, direction, direction + 1})
          if (directions_[at] >> (turned & 3) & 1) {
            direction = turned & 3;
            break;
          }
      }
      borderStarts.push_back(uint32_t(border.size()));
    }
  }
}

void Trace::findIslands() {
  islands.clear();
  sf::sort(crossings_.begin(), crossings_.end(), [](const Crossing& a, const Crossing& b) {
    return a.line < b.line || (a.line == b.line && a.v < b.v);
  });
  const uint32_t lines = uint32_t(us_.size()), rows = uint32_t(vs_.size()) - 1;
  size_t c = 0;
  // Inner lines alone: all others are on the sides of the domain.
  for (uint32_t i = 1; i + 1 < lines; ++i) {
    while (c < crossings_.size() && crossings_[c].line < i) ++c;
    int winding = 0;
    // Vertices with marked cells all around: inside marked runs of both strips.
    size_t a = dirtyStarts_[i - 1], b = dirtyStarts_[i];
    const size_t aEnd = dirtyStarts_[i], bEnd = dirtyStarts_[i + 1];
    while (a < aEnd && b < bEnd) {
      const uint32_t first = std::max(dirty_[a].first, dirty_[b].first);
      const uint32_t end = std::min(dirty_[a].end, dirty_[b].end);
      for (uint32_t j = std::max(first, 0u) + 1; j < end && j < rows; ++j) {
        if (isNear_[name(i, j)]) continue;
        while (c < crossings_.size() && crossings_[c].line == i && crossings_[c].v < vs_[j])
          winding += crossings_[c++].sign;
        if (winding > 0) islands.push_back(name(i, j));
      }
      (dirty_[a].end < dirty_[b].end ? a : b) += 1;
    }
  }
}

}  // namespace sf
