#include "surface/face_strips.h"

#include <algorithm>
#include <numeric>

namespace sf {
namespace {

// Half-edges of a quad's two triangles, by the diagonal.
struct QuadEdges {
  uint32_t bottom, top, left, right, diagonals[2];
};
constexpr QuadEdges kFalling{0, 4, 2, 3, {1, 5}}, kRising{0, 4, 5, 1, {2, 3}};

const QuadEdges& edgesOf(const GridQuads& quads, uint32_t strip) {
  return quads.rises[strip] ? kRising : kFalling;
}

/// Calls back with the number, strip and row of each quad.
template <class F>
void eachQuad(const GridQuads& quads, F&& call) {
  uint32_t q = 0;
  for (const CellRun& run : quads.runs)
    for (uint32_t j = run.first; j < run.end; ++j) call(q++, run.strip, j);
}

/// The indices that a strip takes besides one a triangle, its restart among them.
constexpr uint64_t kStripCost = 3;
/// A join costs at most two indices twice, and saves two and a restart.
constexpr uint32_t kMostSwaps = 2;

}  // namespace

bool areRowsCheaper(ArrayView<const CellRun> runs, ArrayView<const uint8_t> rises) {
  // A row of cells begins where there is none before it; where the diagonal changes along it an index comes twice.
  uint64_t rows = 0, turns = 0;
  size_t before = 0, end = 0;  // runs of the strip before
  for (size_t r = 0; r < runs.size();) {
    const uint32_t strip = runs[r].strip;
    if (!(end > before && runs[before].strip + 1 == strip)) before = end = r;
    const bool isTurn = before < end && !rises.empty() && rises[strip - 1] != rises[strip];
    const size_t first = r;
    size_t b = before;
    for (; r < runs.size() && runs[r].strip == strip; ++r) {
      rows += runs[r].end - runs[r].first;
      while (b < end && runs[b].end <= runs[r].first) ++b;
      for (size_t k = b; k < end && runs[k].first < runs[r].end; ++k) {
        const uint32_t both =
            std::min(runs[k].end, runs[r].end) - std::max(runs[k].first, runs[r].first);
        rows -= both, turns += isTurn ? both : 0;
      }
    }
    before = first, end = r;
  }
  return kStripCost * rows + turns < kStripCost * runs.size();
}

void FaceStrips::placeQuads(const GridQuads& quads) {
  quadAt_.assign(size_t(quads.strips) * quads.rows, kNone);
  eachQuad(quads,
           [&](uint32_t q, uint32_t i, uint32_t j) { quadAt_[size_t(i) * quads.rows + j] = q; });
}

/// Twins between quads, and strips along them.
///   first  the half-edge that the quads begin with
void FaceStrips::linkQuads(const GridQuads& quads, uint32_t first) {
  placeQuads(quads);
  eachQuad(quads, [&](uint32_t q, uint32_t i, uint32_t j) {
    const QuadEdges& edges = edgesOf(quads, i);
    const uint32_t at = first + 6 * q;
    const auto pair = [&](uint32_t h, uint32_t g, bool isLinked) {
      twins_[h] = g, twins_[g] = h;
      if (isLinked) links_.link(h, g);
    };
    pair(at + edges.diagonals[0], at + edges.diagonals[1], true);
    const size_t cell = size_t(i) * quads.rows + j;
    const uint32_t above = j + 1 < quads.rows ? quadAt_[cell + 1] : kNone,
                   beside = i + 1 < quads.strips ? quadAt_[cell + quads.rows] : kNone;
    if (above != kNone) pair(at + edges.top, first + 6 * above + edges.bottom, !quads.alongU);
    if (beside != kNone)
      pair(at + edges.right, first + 6 * beside + edgesOf(quads, i + 1).left, quads.alongU);
  });
}

/// Twins between quads and band.
void FaceStrips::findBorderTwins(uint32_t vertexCount) {
  edgeFrom_.assign(vertexCount, kNone);
  const auto to = [&](uint32_t h) { return corners_[nextInTriangle(h)]; };
  for (uint32_t h = 0; h < twins_.size(); ++h)
    if (twins_[h] == kNone) edgeFrom_[corners_[h]] = h;
  // Of two that leave one vertex, where borders touch, one is met; the other is then joined to nothing.
  for (uint32_t h = 0; h < twins_.size(); ++h) {
    if (twins_[h] != kNone) continue;
    const uint32_t g = edgeFrom_[to(h)];
    if (g == kNone || twins_[g] != kNone || to(g) != corners_[h] || g / 3 == h / 3) continue;
    twins_[h] = g, twins_[g] = h;
  }
}

bool FaceStrips::write(const GridQuads& quads, uint32_t vertexCount, ArrayView<const uint32_t> band,
                       ArrayView<const uint32_t> bandTwins, const StripLinks& links, bool turned,
                       Work& work, std::vector<uint32_t>& vertices, std::vector<uint32_t>& starts) {
  const uint32_t first = uint32_t(band.size());
  corners_.assign(band.begin(), band.end());
  corners_.insert(corners_.end(), quads.triangles.begin(), quads.triangles.end());
  twins_.assign(bandTwins.begin(), bandTwins.end());
  twins_.resize(corners_.size(), kNone);
  links_.bits = links.bits;
  links_.bits.resize(corners_.size() / 3, 0);
  linkQuads(quads, first);
  findBorderTwins(vertexCount);
  if (!joinStripEnds(twins_, kMostSwaps, work, links_)) return false;
  all_.resize(corners_.size() / 3);
  std::iota(all_.begin(), all_.end(), 0);
  return writeStrips(corners_, twins_, links_, all_, work, vertices, starts, turned);
}

}  // namespace sf
