// Result arrays on their way out of the core.
#pragma once
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "soapfilm.h"

/// A list of arrays of any element type; each is moved in and lives as long as the result.
struct SfResult {
  struct Array {
    void* owner;
    void (*destroy)(void* owner);
    const void* data;
    size_t length;
  };
  std::vector<Array> arrays;

  SfResult() = default;
  SfResult(const SfResult&) = delete;
  SfResult& operator=(const SfResult&) = delete;
  ~SfResult() {
    for (const Array& array : arrays) array.destroy(array.owner);
  }

  /// Appends an array; its index is the number of arrays before.
  ///   perElement  how many elements the host sees for each T, for arrays of small structs
  template <class T>
  void add(std::vector<T> values, size_t perElement = 1) {
    using Owner = std::vector<T>;
    const auto destroy = [](void* owner) { delete static_cast<Owner*>(owner); };
    auto* owner = new Owner(std::move(values));
    arrays.push_back({owner, destroy, owner->data(), owner->size() * perElement});
  }
};
