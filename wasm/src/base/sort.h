// Sorting in a tenth of the code size of std::sort, which is compiled anew for each type and order:
// there are dozens of these, and most sort few items.
// Source: Musser 1997, "Introspective sorting and selection algorithms": quicksort by the median of
// three, heapsort after too many bad splits, insertion sort for short ranges.
#pragma once
#include <cstddef>
#include <utility>

namespace sf {

/// The order of operator<.
struct Ascending {
  template <class T>
  bool operator()(const T& a, const T& b) const {
    return a < b;
  }
};

namespace sorting {

constexpr size_t kShort = 16;

template <class T, class Less>
void insertionSort(T* items, size_t count, Less& less) {
  for (size_t i = 1; i < count; ++i) {
    if (!less(items[i], items[i - 1])) continue;
    T item = std::move(items[i]);
    size_t j = i;
    do items[j] = std::move(items[j - 1]);
    while (--j > 0 && less(item, items[j - 1]));
    items[j] = std::move(item);
  }
}

/// Lets the item at `at` sink into the heap below it.
template <class T, class Less>
void sink(T* items, size_t at, size_t count, Less& less) {
  T item = std::move(items[at]);
  for (size_t child; (child = 2 * at + 1) < count; at = child) {
    if (child + 1 < count && less(items[child], items[child + 1])) ++child;
    if (!less(item, items[child])) break;
    items[at] = std::move(items[child]);
  }
  items[at] = std::move(item);
}

template <class T, class Less>
void heapSort(T* items, size_t count, Less& less) {
  for (size_t i = count / 2; i-- > 0;) sink(items, i, count, less);
  for (size_t end = count; end-- > 1;) {
    std::swap(items[0], items[end]);
    sink(items, 0, end, less);
  }
}

/// Puts small items to the left and returns how many there are: at least one, not all. None of them
/// is greater than any item on the right.
template <class T, class Less>
size_t partition(T* items, size_t count, Less& less) {
  T &first = items[0], &middle = items[count / 2], &last = items[count - 1];
  if (less(middle, first)) std::swap(middle, first);
  if (less(last, middle)) {
    std::swap(last, middle);
    if (less(middle, first)) std::swap(middle, first);
  }
  // The first and the last item stop the scans.
  const T pivot = middle;
  T *i = items, *j = items + count - 1;
  for (;;) {
    do ++i;
    while (less(*i, pivot));
    do --j;
    while (less(pivot, *j));
    if (i >= j) return size_t(j + 1 - items);
    std::swap(*i, *j);
  }
}

/// Loops over the longer side and calls itself for the shorter: at most log2(count) calls deep.
template <class T, class Less>
void introsort(T* items, size_t count, int badSplits, Less& less) {
  while (count > kShort) {
    if (badSplits-- == 0) return heapSort(items, count, less);
    const size_t left = partition(items, count, less), right = count - left;
    if (left < right) {
      introsort(items, left, badSplits, less);
      items += left, count = right;
    } else {
      introsort(items + left, right, badSplits, less);
      count = left;
    }
  }
  insertionSort(items, count, less);
}

}  // namespace sorting

/// Sorts the items from `first` to before `last`, which must be contiguous in memory. Equal items
/// come in an order that depends on all items. O(n log n) comparisons, no allocation.
///   less  a strict weak order
template <class Iterator, class Less = Ascending>
void sort(Iterator first, Iterator last, Less less = {}) {
  const size_t count = size_t(last - first);
  if (count < 2) return;
  int depth = 0;
  for (size_t n = count; n > 0; n /= 2) depth += 2;
  sorting::introsort(&*first, count, depth, less);
}

/// Puts the item that would come at `nth` if all were sorted there, those before it in front and those after it
/// behind. O(n) comparisons as a rule, O(n log n) at worst; otherwise as `sort`.
template <class Iterator, class Less = Ascending>
void select(Iterator first, Iterator nth, Iterator last, Less less = {}) {
  size_t count = size_t(last - first), at = size_t(nth - first);
  if (at >= count) return;
  auto* items = &*first;
  int depth = 0;
  for (size_t n = count; n > 0; n /= 2) depth += 2;
  while (count > sorting::kShort) {
    if (depth-- == 0) return sorting::heapSort(items, count, less);
    const size_t left = sorting::partition(items, count, less);
    if (at < left) {
      count = left;
    } else {
      items += left, count -= left, at -= left;
    }
  }
  sorting::insertionSort(items, count, less);
}

}  // namespace sf
