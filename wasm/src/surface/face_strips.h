// Triangle strips over a face: along its whole cells and over the band, joined.
//
// Source: Kumar, sec. 3: one strip for each run of quads; sec. 4.1 for the band.
// Differs: runs go along u or along v, whichever way there are fewer of them, and strips that end side by side are joined: those of
// the grid with each other and with those of the band. The paper has two kinds of strips that never meet.
#pragma once
#include <cstdint>
#include <vector>

#include "base/array_view.h"
#include "base/work.h"
#include "polygon/strips/strips.h"
#include "surface/trace.h"

namespace sf {

/// The whole cells of a face, two triangles each.
struct GridQuads {
  ArrayView<const CellRun> runs;  // as Trace has them
  uint32_t strips = 0, rows = 0;  // cells along u and along v
  std::vector<uint8_t> rises;     // [strips] whether diagonals go up with u
  bool alongU = false;            // which way strips go
  std::vector<uint32_t>
      triangles{};  // [6q] in the order of runs, counter-clockwise, each quad from its lowest corner

  /// Appends the quad with the corners a, b on its lower and c, d on its upper side, along u.
  void add(uint32_t a, uint32_t b, uint32_t c, uint32_t d, bool isRising) {
    if (isRising)
      triangles.insert(triangles.end(), {a, b, d, a, d, c});
    else
      triangles.insert(triangles.end(), {a, b, c, b, d, c});
  }
};

/// Whether rows of whole cells, along u, take fewer indices than the runs along v. O(runs) time.
///   rises  [strips] which diagonals rise; empty: not known yet
bool areRowsCheaper(ArrayView<const CellRun> runs, ArrayView<const uint8_t> rises = {});

/// Whether strips along cells begin without an index twice if diagonals rise.
///   turned  whether triangles are clockwise: of a face that is seen from its other side
inline bool startsEasilyRising(bool alongU, bool turned) { return alongU != turned; }

class FaceStrips {
 public:
  /// Writes the strips of a face. False when the work ended.
  ///   vertexCount  numbers of vertices are below it
  ///   band         [3b] triangles, counter-clockwise, and their twins
  ///   links        the strips of the band by themselves
  ///   turned       strips of the triangles' other sides
  ///   vertices, starts  out: as writeStrips has them
  /// O(m) time and memory, for all triangles of the face.
  bool write(const GridQuads& quads, uint32_t vertexCount, ArrayView<const uint32_t> band,
             ArrayView<const uint32_t> bandTwins, const StripLinks& links, bool turned, Work& work,
             std::vector<uint32_t>& vertices, std::vector<uint32_t>& starts);

 private:
  void placeQuads(const GridQuads& quads);
  void linkQuads(const GridQuads& quads, uint32_t first);
  void findBorderTwins(uint32_t vertexCount);

  std::vector<uint32_t> corners_, twins_, all_;
  StripLinks links_;
  std::vector<uint32_t> quadAt_;  // [cells] the number of the quad there, or kNone
  std::vector<uint32_t>
      edgeFrom_;  // [vertices] a half-edge without a twin that leaves it, or kNone
};

}  // namespace sf
