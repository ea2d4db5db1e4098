// Two doubles at once, in one register of SSE2 or of WebAssembly's SIMD.
#pragma once
#include <cstdint>

namespace sf {

using Double2 = double __attribute__((vector_size(16)));
/// The result of comparing two of them: all bits of a number are set where it holds, else none.
using Int2 = int64_t __attribute__((vector_size(16)));

inline Double2 swapped(Double2 v) { return __builtin_shufflevector(v, v, 1, 0); }
inline Double2 magnitudes(Double2 v) { return (Double2)((Int2)v & INT64_MAX); }
/// The greater number in each place; that of `b` where `a` is NaN.
inline Double2 greater(Double2 a, Double2 b) { return a > b ? a : b; }
inline Double2 lesser(Double2 a, Double2 b) { return a < b ? a : b; }

}  // namespace sf
