#include "mesh/stitch.h"

#include <algorithm>

#include "base/sort.h"

namespace sf {
namespace {

class Stitcher {
 public:
  Stitcher(const MeshView& mesh, const Rims& rims, uint32_t rim) : mesh_(mesh) {
    for (uint32_t e = rims.starts[rim]; e < rims.starts[rim + 1]; ++e)
      corners_.push_back({e, rims.vertices[e], kNone});
  }

  HoleParts stitch() {
    if (!findPlaces()) return {};
    const uint32_t n = uint32_t(corners_.size());
    depths_.assign(n, kNone);
    for (uint32_t i = 0; i < n; ++i) add(i);
    // From the last corner the rim goes on to the first one.
    bridgeTo(open_.front().vertex);
    if (open_.size() > 2) result_.parts.push_back(std::move(open_));
    return std::move(result_);
  }

 private:
  /// Numbers the places of the corners. False if all are different.
  bool findPlaces() {
    const uint32_t n = uint32_t(corners_.size());
    std::vector<uint32_t> order(n);
    for (uint32_t i = 0; i < n; ++i) order[i] = i;
    const auto less = [](const Vec3& p, const Vec3& q) {
      return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z < q.z;
    };
    const auto at = [&](uint32_t i) { return pointAt(mesh_.positions, corners_[i].vertex); };
    sf::sort(order.begin(), order.end(), [&](uint32_t i, uint32_t j) {
      const Vec3 p = at(i), q = at(j);
      return less(p, q) || (!less(q, p) && i < j);
    });
    places_.resize(n);
    bool isAnySame = false;
    for (uint32_t k = 0; k < n; ++k) {
      const bool isSame = k > 0 && !less(at(order[k - 1]), at(order[k]));
      places_[order[k]] = isSame ? places_[order[k - 1]] : order[k];
      isAnySame |= isSame;
    }
    return isAnySame;
  }

  /// A triangle to the next corner, if the last one has been left out for another at its place.
  void bridgeTo(uint32_t next) {
    if (leftOut_ == kNone) return;
    PartCorner& top = open_.back();
    top.edge = kNone;
    if (top.vertex != next) addTriangle(top.vertex, leftOut_, next);
    leftOut_ = kNone;
  }

  void addTriangle(uint32_t a, uint32_t b, uint32_t c) {
    result_.triangles.insert(result_.triangles.end(), {a, b, c});
  }

  /// Goes on to corner i. What it closes, together with an earlier corner at its place, is a part.
  void add(uint32_t i) {
    const PartCorner corner = corners_[i];
    bridgeTo(corner.vertex);
    uint32_t& depth = depths_[places_[i]];
    if (depth == kNone) {
      depth = uint32_t(open_.size());
      open_.push_back(corner);
      numbers_.push_back(i);
      return;
    }
    const size_t between = open_.size() - 1 - depth;
    const uint32_t twin = open_[depth].vertex, last = open_.back().vertex;
    if (between > 0) addTriangle(last, corner.vertex, twin);
    if (between > 1) {
      std::vector<PartCorner> part(open_.begin() + depth, open_.end());
      part.back().edge = kNone;
      result_.parts.push_back(std::move(part));
    }
    for (size_t k = depth + 1; k < numbers_.size(); ++k) depths_[places_[numbers_[k]]] = kNone;
    open_.resize(depth + 1);
    numbers_.resize(depth + 1);
    leftOut_ = corner.vertex;
  }

  const MeshView& mesh_;
  std::vector<PartCorner> corners_;  // [n] of the rim
  std::vector<uint32_t> places_;     // [n] the first corner at the same place
  std::vector<uint32_t> depths_;     // [n] by places: where in `open_`, or kNone
  std::vector<PartCorner> open_;     // corners so far, without what has been closed
  std::vector<uint32_t> numbers_;    // as in `open_`: of the corners
  uint32_t leftOut_ = kNone;  // the vertex at the place of the last open corner, that went on
  HoleParts result_;
};

}  // namespace

HoleParts stitchRim(const MeshView& mesh, const Rims& rims, uint32_t rim) {
  return Stitcher(mesh, rims, rim).stitch();
}

}  // namespace sf
