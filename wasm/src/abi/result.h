// Result arrays on their way out of the core.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "soapfilm.h"

/// A list of arrays of any element type; each is moved in and lives as long as the result.
struct SfResult {
  struct Array {
    std::shared_ptr<const void> owner;
    const void* data;
    size_t length;
  };
  std::vector<Array> arrays;

  /// Appends an array; its index is the number of arrays before.
  ///   perElement  how many elements the host sees for each T, for arrays of small structs
  template <class T>
  void add(std::vector<T> values, size_t perElement = 1) {
    auto owner = std::make_shared<const std::vector<T>>(std::move(values));
    arrays.push_back({owner, owner->data(), owner->size() * perElement});
  }
};
