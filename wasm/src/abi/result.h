// Result arrays on their way out of the core.
#pragma once
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "abi/tables.h"

/// The arrays of one table, by name. Each is moved in, and lives as long as the result.
struct SfResult {
  struct Array {
    void* owner = nullptr;
    void (*destroy)(void* owner) = nullptr;
    const void* data = nullptr;
    size_t length = 0;
  };
  std::vector<Array> arrays;

  /// Holds `count` arrays, all of them empty.
  explicit SfResult(size_t count) : arrays(count) {}
  SfResult(const SfResult&) = delete;
  SfResult& operator=(const SfResult&) = delete;
  ~SfResult() {
    for (const Array& array : arrays)
      if (array.destroy) array.destroy(array.owner);
  }

  /// Fills an array, once. Its elements have the table's type, or are structs made of that type.
  template <auto name, class T, class Allocator>
  void put(std::vector<T, Allocator> values) {
    using Element = typename sf::ElementOf<name>::Type;
    static_assert(std::is_same_v<T, Element> ||
                      (std::is_trivially_copyable_v<T> && !std::is_arithmetic_v<T> &&
                       alignof(T) == alignof(Element) && sizeof(T) % sizeof(Element) == 0),
                  "not what the table says");
    using Owner = std::vector<T, Allocator>;
    const auto destroy = [](void* owner) { delete static_cast<Owner*>(owner); };
    auto* owner = new Owner(std::move(values));
    // A number is as large as the alignment of the element that it is in.
    const size_t numbers = sizeof(T) / alignof(Element);
    arrays[size_t(name)] = {owner, destroy, owner->data(), owner->size() * numbers};
  }
};
