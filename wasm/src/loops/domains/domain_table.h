// A hash table of keys of varying length: gives each distinct key the next number.
#pragma once
#include <cstdint>
#include <cstring>
#include <vector>

#include "base/arena.h"
#include "base/array_view.h"

namespace sf {

/// Numbers keys 0, 1, 2, … in the order of their first insertion. Open addressing, at most half
/// full; keys are kept in an arena.
class DomainTable {
 public:
  explicit DomainTable(Work& work) : work_(work), keys_(work) { clear(); }
  ~DomainTable() { work_.release(charged_); }

  /// The number of the key, a new one if it was not there; kNone once memory has run out.
  uint32_t insert(ArrayView<const uint32_t> key) {
    const uint32_t h = hash(key);
    const size_t at = probe(key, h);
    if (slots_[at] != kNone) return slots_[at];
    auto* words = keys_.allocate<uint32_t>(key.size());
    if (!words) return kNone;
    std::memcpy(words, key.data(), key.size() * sizeof(uint32_t));
    const uint32_t id = uint32_t(entries_.size());
    if (entries_.size() == entries_.capacity() && !growEntries()) return kNone;
    entries_.push_back({words, uint32_t(key.size()), h});
    slots_[at] = id;
    if (2 * entries_.size() > slots_.size() && !growSlots()) return kNone;
    return id;
  }
  /// The number of the key, or kNone if it is not there.
  uint32_t find(ArrayView<const uint32_t> key) const { return slots_[probe(key, hash(key))]; }
  ArrayView<const uint32_t> key(uint32_t id) const {
    return {entries_[id].words, entries_[id].size};
  }
  uint32_t size() const { return uint32_t(entries_.size()); }

  void clear() {
    keys_.clear();
    entries_.clear();
    entries_.shrink_to_fit();
    slots_.assign(64, kNone);
    slots_.shrink_to_fit();
    work_.release(charged_);
    charged_ = 0;
  }

 private:
  struct Entry {
    const uint32_t* words;
    uint32_t size;
    uint32_t hash;
  };
  static uint32_t hash(ArrayView<const uint32_t> key) {
    uint64_t h = 0x9E3779B97F4A7C15u ^ key.size();
    for (const uint32_t w : key) {
      h = (h ^ w) * 0xD6E8FEB86659FD93u;
      h ^= h >> 32;
    }
    return uint32_t(h);
  }
  size_t probe(ArrayView<const uint32_t> key, uint32_t h) const {
    const size_t mask = slots_.size() - 1;
    size_t at = h & mask;
    for (; slots_[at] != kNone; at = (at + 1) & mask) {
      const Entry& e = entries_[slots_[at]];
      if (e.hash == h && e.size == key.size() &&
          std::memcmp(e.words, key.data(), key.size() * sizeof(uint32_t)) == 0)
        break;
    }
    return at;
  }
  bool growEntries() {
    const size_t more = entries_.capacity() < 64 ? 64 : entries_.capacity();
    if (!charge(uint64_t(more) * sizeof(Entry))) return false;
    entries_.reserve(entries_.capacity() + more);
    return true;
  }
  bool growSlots() {
    if (!charge(slots_.size() * sizeof(uint32_t))) return false;
    slots_.assign(2 * slots_.size(), kNone);
    const size_t mask = slots_.size() - 1;
    for (uint32_t id = 0; id < entries_.size(); ++id) {
      size_t at = entries_[id].hash & mask;
      while (slots_[at] != kNone) at = (at + 1) & mask;
      slots_[at] = id;
    }
    return true;
  }
  bool charge(uint64_t bytes) {
    charged_ += bytes;
    return work_.charge(bytes);
  }

  Work& work_;
  Arena keys_;
  std::vector<Entry> entries_;
  std::vector<uint32_t> slots_;
  size_t charged_ = 0;
};

}  // namespace sf
