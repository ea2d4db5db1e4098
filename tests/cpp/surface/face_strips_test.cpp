// Strips over the whole cells of a face and its band: every triangle in one of them, on the right side, and few indices.
#include "surface/face_strips.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>

using namespace sf;

namespace {

/// Cells of a grid, some of which are whole; the others, with all their corners in use, are the band.
struct Cells {
  uint32_t strips, rows;
  std::vector<uint8_t> isWhole;  // [strips][rows]
  std::vector<CellRun> runs;
  GridQuads quads;
  TriangleMesh band;
  StripLinks links;

  Cells(std::mt19937& random, uint32_t strips, uint32_t rows, double whole)
      : strips(strips), rows(rows), isWhole(strips * rows) {
    std::bernoulli_distribution isChosen(whole);
    for (uint8_t& cell : isWhole) cell = isChosen(random);
    for (uint32_t i = 0; i < strips; ++i)
      for (uint32_t j = 0; j < rows; ++j) {
        if (!at(i, j)) continue;
        if (j > 0 && at(i, j - 1))
          ++runs.back().end;
        else
          runs.push_back({i, j, j + 1});
      }
    quads.runs = runs, quads.strips = strips, quads.rows = rows;
    for (uint32_t i = 0; i < strips; ++i) quads.rises.push_back(random() & 1);
    const auto vertex = [&](uint32_t i, uint32_t j) { return i * (rows + 1) + j; };
    for (const CellRun& run : runs)
      for (uint32_t i = run.strip, j = run.first; j < run.end; ++j)
        quads.add(vertex(i, j), vertex(i + 1, j), vertex(i, j + 1), vertex(i + 1, j + 1),
                  quads.rises[i]);
    for (uint32_t i = 0; i < strips; ++i)
      for (uint32_t j = 0; j < rows; ++j)
        if (!at(i, j))
          band.corners.insert(band.corners.end(),
                              {vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j),
                               vertex(i + 1, j + 1), vertex(i, j + 1)});
    Work work;
    REQUIRE(findTwins(band.corners, vertexCount(), work, band.twins));
    REQUIRE(linkStrips(band.twins, work, links));
  }
  bool at(uint32_t i, uint32_t j) const { return isWhole[i * rows + j] != 0; }
  uint32_t vertexCount() const { return (strips + 1) * (rows + 1); }
};

/// A triangle with its least corner first: the same for each side it is seen from.
std::array<uint32_t, 3> turned(uint32_t a, uint32_t b, uint32_t c) {
  std::array<uint32_t, 3> t{a, b, c};
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

}  // namespace

TEST_CASE("FaceStrips: every triangle once, on the side that is asked for") {
  const unsigned seed = 8;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  FaceStrips strips;  // keeps its memory
  for (int round = 0; round < 400; ++round) {
    Cells cells(random, 1 + random() % 12, 1 + random() % 12, 0.25 * double(random() % 5));
    for (const bool alongU : {false, true})
      for (const bool isTurned : {false, true}) {
        cells.quads.alongU = alongU;
        std::vector<uint32_t> vertices, starts;
        Work work;
        REQUIRE(strips.write(cells.quads, cells.vertexCount(), cells.band.corners, cells.band.twins,
                             cells.links, isTurned, work, vertices, starts));
        std::map<std::array<uint32_t, 3>, int> left;
        for (const auto* list : {&cells.quads.triangles, &cells.band.corners})
          for (size_t i = 0; i < list->size(); i += 3) {
            const uint32_t* t = &(*list)[i];
            ++left[isTurned ? turned(t[0], t[2], t[1]) : turned(t[0], t[1], t[2])];
          }
        bool isRight = true;
        for (size_t s = 0; s + 1 < starts.size(); ++s)
          for (uint32_t k = starts[s]; k + 2 < starts[s + 1]; ++k) {
            uint32_t a = vertices[k], b = vertices[k + 1];
            const uint32_t c = vertices[k + 2];
            if (a == b || b == c || c == a) continue;
            if ((k - starts[s]) % 2 == 1) std::swap(a, b);
            isRight &= --left[turned(a, b, c)] == 0;
          }
        CHECK(isRight);
        CHECK(std::all_of(left.begin(), left.end(), [](const auto& t) { return t.second == 0; }));
      }
  }
}

TEST_CASE("FaceStrips: along the grid there are few indices") {
  std::mt19937 random(1);
  FaceStrips strips;
  for (const auto& [across, along] : {std::pair{30u, 3u}, {3u, 30u}, {1u, 40u}, {40u, 1u}}) {
    Cells cells(random, across, along, 1);
    std::fill(cells.quads.rises.begin(), cells.quads.rises.end(), uint8_t(0));
    cells.quads.triangles.clear();
    for (const CellRun& run : cells.runs)
      for (uint32_t j = run.first; j < run.end; ++j) {
        const uint32_t low = run.strip * (along + 1) + j, high = low + along + 1;
        cells.quads.add(low, high, low + 1, high + 1, false);
      }
    cells.quads.alongU = areRowsCheaper(cells.runs, cells.quads.rises);
    CHECK(cells.quads.alongU == (across > along));
    std::vector<uint32_t> vertices, starts;
    Work work;
    REQUIRE(strips.write(cells.quads, cells.vertexCount(), cells.band.corners, cells.band.twins,
                         cells.links, false, work, vertices, starts));
    // A strip for each row at most, with its two indices and the one that may come twice.
    CHECK(starts.size() - 1 <= std::min(across, along));
    CHECK(vertices.size() <= 2 * across * along + 3 * std::min(across, along));
  }
}

TEST_CASE("areRowsCheaper: as counted cell by cell") {
  const unsigned seed = 9;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  for (int round = 0; round < 1000; ++round) {
    const Cells cells(random, 1 + random() % 9, 1 + random() % 9, 0.25 * double(1 + random() % 4));
    uint32_t rows = 0, turns = 0;
    for (uint32_t i = 0; i < cells.strips; ++i)
      for (uint32_t j = 0; j < cells.rows; ++j) {
        if (!cells.at(i, j)) continue;
        const bool isFirst = i == 0 || !cells.at(i - 1, j);
        rows += isFirst;
        turns += !isFirst && cells.quads.rises[i - 1] != cells.quads.rises[i];
      }
    CHECK(areRowsCheaper(cells.runs) == (rows < cells.runs.size()));
    CHECK(areRowsCheaper(cells.runs, cells.quads.rises) ==
          (3 * rows + turns < 3 * cells.runs.size()));
  }
}
