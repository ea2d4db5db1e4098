// Memory charged to the budget for as long as a scope lasts.
#pragma once
#include <vector>

#include "base/work.h"

namespace sf {

class Charge {
 public:
  explicit Charge(Work& work) : work_(work) {}
  ~Charge() { work_.release(bytes_); }
  Charge(const Charge&) = delete;
  Charge& operator=(const Charge&) = delete;

  /// Charges `bytes` more; false once the limit is exceeded.
  bool add(uint64_t bytes) {
    bytes_ += bytes;
    return work_.charge(bytes);
  }
  uint64_t bytes() const { return bytes_; }

 private:
  Work& work_;
  uint64_t bytes_ = 0;
};

/// Makes room in a list for `size` elements, and charges it first; false beyond the limit.
template <class T>
bool reserve(std::vector<T>& list, size_t size, Charge& charge) {
  if (size <= list.capacity()) return true;
  if (!charge.add(uint64_t(size - list.capacity()) * sizeof(T))) return false;
  list.reserve(size);
  return true;
}

/// push_back that first charges the memory it needs; false beyond the limit.
template <class T>
bool push(std::vector<T>& list, const T& item, Charge& charge) {
  const size_t size = list.size();
  if (size == list.capacity() && !reserve(list, size < 16 ? 16 : 2 * size, charge)) return false;
  list.push_back(item);
  return true;
}

}  // namespace sf
