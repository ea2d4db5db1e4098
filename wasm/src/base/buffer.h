// Vectors whose new elements are not set to zero: for memory that is about to be written anyway.
#pragma once
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace sf {

/// std::allocator, except that elements made without a value are not initialised.
template <class T>
struct LeaveAsIs : std::allocator<T> {
  template <class U>
  struct rebind {  // NOLINT(readability-identifier-naming): the standard's name
    using other = LeaveAsIs<U>;
  };
  LeaveAsIs() = default;
  template <class U>
  LeaveAsIs(const LeaveAsIs<U>&) {}

  template <class U>
  void construct(U* at) {
    ::new (static_cast<void*>(at)) U;
  }
  template <class U, class... Args>
  void construct(U* at, Args&&... args) {
    ::new (static_cast<void*>(at)) U(std::forward<Args>(args)...);
  }
};

/// A vector whose `resize` leaves new elements uninitialised.
template <class T>
using Buffer = std::vector<T, LeaveAsIs<T>>;

}  // namespace sf
