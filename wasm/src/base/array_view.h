// A pointer and a length: how arrays pass between functions of the core.
#pragma once
#include <cstddef>
#include <type_traits>
#include <vector>

#include "base/assert.h"

namespace sf {

/// A view of `size` consecutive elements that somebody else owns. Cheap to copy.
template <class T>
class ArrayView {
 public:
  ArrayView() = default;
  ArrayView(T* data, size_t size) : data_(data), size_(size) {}
  template <class A>
  ArrayView(std::vector<std::remove_const_t<T>, A>& v) : data_(v.data()), size_(v.size()) {}
  template <class A, class U = T, class = std::enable_if_t<std::is_const_v<U>>>
  ArrayView(const std::vector<std::remove_const_t<T>, A>& v) : data_(v.data()), size_(v.size()) {}
  template <class U, class = std::enable_if_t<std::is_same_v<const U, T>>>
  ArrayView(ArrayView<U> v) : data_(v.data()), size_(v.size()) {}

  T* data() const { return data_; }
  size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T* begin() const { return data_; }
  T* end() const { return data_ + size_; }
  T& operator[](size_t i) const {
    SF_ASSERT(i < size_);
    return data_[i];
  }
  ArrayView slice(size_t first, size_t count) const {
    SF_ASSERT(first + count <= size_);
    return {data_ + first, count};
  }

 private:
  T* data_ = nullptr;
  size_t size_ = 0;
};

}  // namespace sf
