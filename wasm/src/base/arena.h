// Storage for many small arrays with one lifetime: freed all at once, never moved.
#pragma once
#include <cstdlib>
#include <type_traits>
#include <vector>

#include "base/work.h"

namespace sf {

/// Hands out uninitialised, 8-byte aligned arrays of trivial types; charges each chunk to `work`.
class Arena {
 public:
  explicit Arena(Work& work) : work_(work) {}
  ~Arena() { clear(); }
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  /// `count` elements, or null once the memory limit is reached.
  template <class T>
  T* allocate(size_t count) {
    static_assert(alignof(T) <= 8 && std::is_trivially_destructible_v<T>, "arena of plain data");
    const size_t bytes = (count * sizeof(T) + 8) & ~size_t(7);  // never 0: null means failure
    if (bytes > left_ && !grow(bytes)) return nullptr;
    T* result = reinterpret_cast<T*>(cursor_);
    cursor_ += bytes;
    left_ -= bytes;
    return result;
  }

  void clear() {
    for (const Chunk& c : chunks_) {
      std::free(c.data);
      work_.release(c.bytes);
    }
    chunks_.clear();
    cursor_ = nullptr;
    left_ = 0;
  }

 private:
  struct Chunk {
    void* data;
    size_t bytes;
  };
  bool grow(size_t bytes) {
    // Small problems stay small; large ones take few, large chunks.
    size_t size = chunks_.empty() ? size_t(1) << 13 : 2 * chunks_.back().bytes;
    if (size > size_t(1) << 20) size = size_t(1) << 20;
    if (size < bytes) size = bytes;
    if (!work_.charge(size)) {
      work_.release(size);
      return false;
    }
    void* data = std::malloc(size);
    if (!data) {
      work_.release(size);
      work_.fail(Status::OutOfMemory);
      return false;
    }
    chunks_.push_back({data, size});
    cursor_ = static_cast<char*>(data);
    left_ = size;
    return true;
  }

  Work& work_;
  std::vector<Chunk> chunks_;
  char* cursor_ = nullptr;
  size_t left_ = 0;
};

}  // namespace sf
