// What stays in the core between calls, by number.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

namespace sf {

/// Things of one type that are kept. One that is dropped frees its number for a later one.
template <class T>
class Kept {
 public:
  uint32_t keep(std::unique_ptr<T> thing) {
    for (uint32_t i = 0; i < things_.size(); ++i)
      if (!things_[i]) return things_[i] = std::move(thing), i;
    things_.push_back(std::move(thing));
    return uint32_t(things_.size()) - 1;
  }
  /// Null if there is none of that number.
  T* find(uint32_t number) { return number < things_.size() ? things_[number].get() : nullptr; }
  void drop(uint32_t number) {
    if (find(number)) things_[number] = nullptr;
  }

 private:
  std::vector<std::unique_ptr<T>> things_;
};

}  // namespace sf
