#include "mesh/adjacency.h"

#include <algorithm>
#include <cmath>

#include "base/sort.h"
#include "mesh/edge_pairs.h"

namespace sf {
namespace {

constexpr uint32_t kTickEvery = 4096;

class AdjacencyBuilder {
 public:
  AdjacencyBuilder(const MeshView& mesh, Work& work, Charge& charge, Adjacency& result)
      : faces_(mesh.faces),
        scaled_(mesh.positions),
        vertices_(uint32_t(mesh.positions.size() / 3)),
        faceCount_(uint32_t(mesh.faces.size() / 3)),
        work_(work),
        charge_(charge),
        temporary_(work),
        a_(result) {}

  bool run() {
    const uint64_t m = faceCount_;
    // corners, twins, component, turned; and here links, queue, flags of vertices.
    if (!charge_.add(m * (7 * sizeof(uint32_t) + 1)) ||
        !temporary_.add(m * (4 * sizeof(uint32_t) + 1) + vertices_))
      return false;
    a_ = {};
    a_.vertices = vertices_;
    isLeftOut_.assign(m, 0);
    isAtCut_.assign(vertices_, 0);
    return linkEdges() && windAlike() && turn() && splitVertices() && tell();
  }

 private:
  struct Side {
    uint32_t vertex;  // the greater end of its edge, or the third vertex of its face
    uint32_t half;
  };

  Vec3 at(uint32_t v) const { return scaled_(v); }
  uint32_t from(uint32_t h) const { return faces_[h]; }
  uint32_t to(uint32_t h) const { return faces_[nextInTriangle(h)]; }
  bool linkEdges();
  bool linkAtEdge(std::vector<Side>& run);
  bool pairAtEdge(std::vector<Side>& run);
  bool windAlike();
  void turnTheLess(uint32_t first, uint32_t end);
  bool turn();
  bool splitVertices();
  bool tell();

  ArrayView<const uint32_t> faces_;
  UnitScale scaled_;
  uint32_t vertices_, faceCount_;
  Work& work_;
  Charge& charge_;    // of the result
  Charge temporary_;  // of what follows
  Adjacency& a_;
  std::vector<uint8_t> isLeftOut_;  // [m]
  std::vector<uint8_t> isAtCut_;    // [n] at an end of a non-manifold edge or seam
  // [3m] in the input's numbers: the half-edge on the other side, wound either way
  std::vector<uint32_t> links_;
  std::vector<uint32_t> queue_;  // faces, component after component
  Defect nonManifoldEdges_{DefectKind::NonManifoldEdge, {}, {}, {}},
      nonManifoldVertices_{DefectKind::NonManifoldVertex, {}, {}, {}},
      flipped_{DefectKind::Flipped, {}, {}, {}}, duplicates_{DefectKind::DuplicateFace, {}, {}, {}},
      degenerate_{DefectKind::DegenerateFace, {}, {}, {}},
      notOrientable_{DefectKind::NotOrientable, {}, {}, {}},
      unused_{DefectKind::UnusedVertex, {}, {}, {}};
};

/// Links the two faces of each edge, and pairs of faces where there are more. Leaves out faces that
/// name a vertex twice, and those on the vertices of an earlier one.
bool AdjacencyBuilder::linkEdges() {
  links_.assign(3 * size_t(faceCount_), kNone);
  Charge charge(work_);
  if (!charge.add((vertices_ + uint64_t(2)) * sizeof(uint32_t) + links_.size() * sizeof(Side)))
    return false;
  // Half-edges by the lesser end of their edges.
  std::vector<uint32_t> starts(size_t(vertices_) + 2, 0);
  for (uint32_t f = 0; f < faceCount_; ++f) {
    if (f % kTickEvery == 0 && !work_.tick(5 * kTickEvery)) return false;
    const uint32_t* v = &faces_[3 * size_t(f)];
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) {
      isLeftOut_[f] = 1;
      if (!push(degenerate_.faces, f, charge_)) return false;
      continue;
    }
    for (uint32_t h = 3 * f; h < 3 * f + 3; ++h) ++starts[size_t(std::min(from(h), to(h))) + 2];
  }
  for (size_t v = 2; v < starts.size(); ++v) starts[v] += starts[v - 1];
  std::vector<Side> sides(starts.back());
  for (uint32_t h = 0; h < 3 * faceCount_; ++h) {
    if (h % kTickEvery == 0 && !work_.tick(10 * kTickEvery)) return false;
    if (isLeftOut_[h / 3]) continue;
    const uint32_t least = std::min(from(h), to(h));
    sides[starts[size_t(least) + 1]++] = {from(h) ^ to(h) ^ least, h};
  }
  std::vector<Side> run;
  for (uint32_t v = 0; v < vertices_; ++v) {
    const uint32_t first = starts[v], end = starts[v + 1];
    if (first == end) continue;
    if (!work_.tick(20 * (end - first))) return false;
    sf::sort(sides.begin() + first, sides.begin() + end, [](const Side& a, const Side& b) {
      return a.vertex != b.vertex ? a.vertex < b.vertex : a.half < b.half;
    });
    for (uint32_t i = first, j; i < end; i = j) {
      for (j = i + 1; j < end && sides[j].vertex == sides[i].vertex;) ++j;
      if (j - i == 1) continue;
      if (!reserve(run, j - i, charge)) return false;
      run.assign(sides.begin() + i, sides.begin() + j);
      if (!linkAtEdge(run)) return false;
    }
  }
  sf::sort(duplicates_.faces.begin(), duplicates_.faces.end());
  return true;
}

/// Faces with the same third vertex at one edge are the same; they meet at their other edges, too.
bool AdjacencyBuilder::linkAtEdge(std::vector<Side>& run) {
  for (Side& s : run) s.vertex = faces_[prevInTriangle(s.half)];
  if (run.size() > 2 || run[0].vertex == run[1].vertex) {
    sf::sort(run.begin(), run.end(), [](const Side& a, const Side& b) {
      return a.vertex != b.vertex ? a.vertex < b.vertex : a.half < b.half;
    });
    size_t kept = 1;
    for (size_t i = 1; i < run.size(); ++i) {
      const uint32_t f = run[i].half / 3;
      if (run[i].vertex != run[kept - 1].vertex) {
        run[kept++] = run[i];
      } else if (!isLeftOut_[f]) {
        isLeftOut_[f] = 1;
        if (!push(duplicates_.faces, f, charge_)) return false;
      }
    }
    run.resize(kept);
  }
  if (run.size() > 2) return pairAtEdge(run);
  if (run.size() == 2) links_[run[0].half] = run[1].half, links_[run[1].half] = run[0].half;
  return true;
}

bool AdjacencyBuilder::pairAtEdge(std::vector<Side>& run) {
  sf::sort(run.begin(), run.end(), [](const Side& a, const Side& b) { return a.half < b.half; });
  const uint32_t low = std::min(from(run[0].half), to(run[0].half));
  const uint32_t high = std::max(from(run[0].half), to(run[0].half));
  isAtCut_[low] = isAtCut_[high] = 1;
  if (!push(nonManifoldEdges_.edges, low, charge_) || !push(nonManifoldEdges_.edges, high, charge_))
    return false;
  EdgeFan fan(at(low), at(high));
  if (run.size() <= EdgeFan::kMost) {
    for (const Side& s : run) fan.add(at(s.vertex), from(s.half) == low);
    fan.pair();
  }
  for (size_t i = 0; i < run.size(); ++i) {
    const uint32_t other = run.size() <= EdgeFan::kMost ? fan.partner(uint32_t(i)) : kNone;
    if (other != kNone) {
      links_[run[i].half] = run[other].half;
    } else if (!push(a_.cut, run[i].half, charge_) ||
               !push(nonManifoldEdges_.faces, run[i].half / 3, charge_)) {
      return false;
    }
  }
  return true;
}

/// Finds components, and in each the faces to turn; cuts those that no choice makes alike.
bool AdjacencyBuilder::windAlike() {
  a_.turned.assign(faceCount_, 0);
  a_.component.assign(faceCount_, kNone);
  queue_.reserve(faceCount_);
  for (uint32_t seed = 0; seed < faceCount_; ++seed) {
    if (isLeftOut_[seed] || a_.component[seed] != kNone) continue;
    const size_t first = queue_.size();
    queue_.push_back(seed);
    a_.component[seed] = a_.components;
    bool isMixed = false;
    for (size_t next = first; next < queue_.size(); ++next) {
      if (next % kTickEvery == 0 && !work_.tick(30 * kTickEvery)) return false;
      const uint32_t f = queue_[next];
      for (uint32_t h = 3 * f; h < 3 * f + 3; ++h) {
        const uint32_t g = links_[h];
        if (g == kNone || a_.component[g / 3] != kNone) continue;
        const bool runsAlike = from(h) == from(g);
        a_.component[g / 3] = a_.components;
        a_.turned[g / 3] = a_.turned[f] ^ uint8_t(runsAlike);
        isMixed |= a_.turned[g / 3] != 0;
        queue_.push_back(g / 3);
      }
    }
    ++a_.components;
    if (isMixed) turnTheLess(uint32_t(first), uint32_t(queue_.size()));
  }
  for (uint32_t h = 0; h < 3 * faceCount_; ++h) {
    const uint32_t g = links_[h];
    if (g == kNone || g < h) continue;
    const bool runsAlike = from(h) == from(g);
    if ((a_.turned[h / 3] ^ a_.turned[g / 3]) == uint8_t(runsAlike)) continue;
    links_[h] = links_[g] = kNone;
    isAtCut_[from(h)] = isAtCut_[to(h)] = 1;
    if (!reserve(a_.seams, a_.seams.size() + 4, charge_)) return false;
    a_.seams.insert(a_.seams.end(), {h, g, g, h});
    for (const uint32_t v : {std::min(from(h), to(h)), std::max(from(h), to(h))})
      if (!push(notOrientable_.edges, v, charge_)) return false;
    for (const uint32_t f : {h / 3, g / 3})
      if (!push(notOrientable_.faces, f, charge_)) return false;
  }
  return work_.tick(3 * faceCount_);
}

/// Of the faces of one component in the queue, leaves those of more area as they are.
void AdjacencyBuilder::turnTheLess(uint32_t first, uint32_t end) {
  double area[2] = {0, 0};
  for (uint32_t i = first; i < end; ++i) {
    const uint32_t f = queue_[i], *v = &faces_[3 * size_t(f)];
    area[a_.turned[f]] += length(cross(at(v[1]) - at(v[0]), at(v[2]) - at(v[0])));
  }
  if (area[1] <= area[0]) return;
  for (uint32_t i = first; i < end; ++i) a_.turned[queue_[i]] ^= 1;
}

/// From the input's half-edges to those of the turned faces.
bool AdjacencyBuilder::turn() {
  // Face a, c, b has the edges of a, b, c in the order 2, 1, 0.
  const auto turned = [&](uint32_t h) {
    return h == kNone || !a_.turned[h / 3] ? h : 3 * (h / 3) + 2 - h % 3;
  };
  a_.twins.resize(links_.size());
  a_.corners.resize(links_.size());
  for (uint32_t f = 0; f < faceCount_; ++f) {
    if (f % kTickEvery == 0 && !work_.tick(10 * kTickEvery)) return false;
    const uint32_t h = 3 * f;
    const bool isTurned = a_.turned[f] != 0;
    if (isTurned && !push(flipped_.faces, f, charge_)) return false;
    for (uint32_t i = 0; i < 3; ++i) {
      a_.twins[turned(h + i)] = turned(links_[h + i]);
      const uint32_t k = isTurned && i > 0 ? 3 - i : i;
      a_.corners[h + i] = isLeftOut_[f] ? kNone : faces_[h + k];
    }
  }
  for (uint32_t& h : a_.cut) h = turned(h);
  sf::sort(a_.cut.begin(), a_.cut.end());
  struct Pair {
    uint32_t first, second;
  };
  std::vector<Pair> pairs;
  Charge charge(work_);
  if (!reserve(pairs, a_.seams.size() / 2, charge)) return false;
  for (size_t i = 0; i < a_.seams.size(); i += 2)
    pairs.push_back({turned(a_.seams[i]), turned(a_.seams[i + 1])});
  sf::sort(pairs.begin(), pairs.end(),
           [](const Pair& p, const Pair& q) { return p.first < q.first; });
  for (size_t i = 0; i < pairs.size(); ++i)
    a_.seams[2 * i] = pairs[i].first, a_.seams[2 * i + 1] = pairs[i].second;
  return true;
}

/// Gives every fan of corners around a vertex a working vertex; the fan of the first corner keeps
/// the input's.
bool AdjacencyBuilder::splitVertices() {
  enum : uint8_t { kUnseen, kOneFan, kSeveral };
  std::vector<uint8_t> fans(vertices_, kUnseen);
  std::vector<uint8_t> isDone(a_.corners.size(), 0);
  Charge charge(work_);
  if (!charge.add(vertices_ + a_.corners.size())) return false;
  for (uint32_t h = 0; h < a_.corners.size(); ++h) {
    if (h % kTickEvery == 0 && !work_.tick(20 * kTickEvery)) return false;
    const uint32_t v = a_.corners[h];
    if (v == kNone || isDone[h]) continue;
    uint32_t worker = v;
    if (fans[v] == kUnseen) {
      fans[v] = kOneFan;
    } else {
      fans[v] = kSeveral;
      worker = vertices_ + uint32_t(a_.splitOf.size());
      if (!push(a_.splitOf, v, charge_)) return false;
    }
    // One way round until the rim or the beginning, then the other way.
    uint32_t g = h;
    do {
      isDone[g] = 1, a_.corners[g] = worker;
      g = a_.twins[prevInTriangle(g)];
    } while (g != kNone && g != h);
    if (g == h) continue;
    for (g = h; a_.twins[g] != kNone;) {
      g = nextInTriangle(a_.twins[g]);
      isDone[g] = 1, a_.corners[g] = worker;
    }
  }
  for (uint32_t v = 0; v < vertices_; ++v) {
    if (fans[v] == kUnseen && !push(unused_.vertices, v, charge_)) return false;
    if (fans[v] == kSeveral && !isAtCut_[v] && !push(nonManifoldVertices_.vertices, v, charge_))
      return false;
  }
  return true;
}

bool AdjacencyBuilder::tell() {
  const auto tidy = [](std::vector<uint32_t>& list) {
    sf::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  };
  tidy(nonManifoldEdges_.faces);
  tidy(notOrientable_.faces);
  for (Defect* d : {&nonManifoldEdges_, &nonManifoldVertices_, &flipped_, &duplicates_,
                    &degenerate_, &notOrientable_, &unused_}) {
    if (!d->faces.empty() || !d->edges.empty() || !d->vertices.empty())
      a_.defects.push_back(std::move(*d));
  }
  return true;
}

}  // namespace

bool Adjacency::isCut(uint32_t h) const { return std::binary_search(cut.begin(), cut.end(), h); }

uint32_t Adjacency::acrossSeam(uint32_t h) const {
  size_t low = 0, high = seams.size() / 2;
  while (low < high) {
    const size_t middle = (low + high) / 2;
    if (seams[2 * middle] < h)
      low = middle + 1;
    else
      high = middle;
  }
  return low < seams.size() / 2 && seams[2 * low] == h ? seams[2 * low + 1] : kNone;
}

Outcome checkMesh(const MeshView& mesh) {
  for (size_t i = 0; i < mesh.positions.size(); ++i)
    if (!(std::fabs(mesh.positions[i]) <= kLargestCoordinate))
      return {Status::NotFinite, kNone, uint32_t(i / 3)};
  for (size_t i = 0; i < mesh.faces.size(); ++i)
    if (mesh.faces[i] >= mesh.positions.size() / 3)
      return {Status::BadMesh, kNone, uint32_t(i / 3)};
  return {};
}

UnitScale::UnitScale(ArrayView<const double> positions) : positions_(positions.data()) {
  double largest = 0;
  for (const double x : positions) largest = std::max(largest, std::fabs(x));
  int exponent = 0;
  if (largest > 0) std::frexp(largest, &exponent);
  factor = std::ldexp(1.0, -std::max(-1000, exponent));
}

bool buildAdjacency(const MeshView& mesh, Work& work, Charge& charge, Adjacency& result) {
  return AdjacencyBuilder(mesh, work, charge, result).run();
}

}  // namespace sf
