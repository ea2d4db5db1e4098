// Which faces belong together at an edge of three or more.
#pragma once
#include <array>
#include <cstdint>

#include "base/status.h"
#include "base/vec.h"

namespace sf {

/// Faces around one edge. Two belong together if they go on straight across it, best of all such
/// that they are wound alike. Of two bodies that touch along the edge, each keeps its own faces.
class EdgeFan {
 public:
  static constexpr uint32_t kMost = 16;

  /// The ends of the edge, about unit size.
  EdgeFan(Vec3 low, Vec3 high);
  /// A face with its third vertex; whether it runs from the low end to the high one.
  void add(Vec3 apex, bool runsUp);
  /// Pairs faces, as long as there are two that fit each other clearly better than any other.
  void pair();
  /// The face that face i is paired with, or kNone.
  uint32_t partner(uint32_t i) const { return partners_[i]; }

 private:
  double misfit(uint32_t i, uint32_t j) const;
  bool isClear(uint32_t i, uint32_t j, double misfit) const;

  Vec3 low_, axis_, across_, up_;
  uint32_t count_ = 0;
  std::array<double, kMost> angles_;
  std::array<bool, kMost> runsUp_;
  std::array<bool, kMost> isFlat_;  // no area: it has no angle
  std::array<uint32_t, kMost> partners_;
};

}  // namespace sf
