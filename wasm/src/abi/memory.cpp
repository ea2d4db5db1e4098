// Memory and result arrays across the C ABI.
#include <cstdlib>

#include "abi/result.h"

extern "C" {

void* sf_alloc(size_t bytes) { return std::malloc(bytes); }

void sf_free(void* pointer) { std::free(pointer); }

const void* sf_result_data(const SfResult* result, uint32_t array) {
  return sf_result_length(result, array) > 0 ? result->arrays[array].data : nullptr;
}

size_t sf_result_length(const SfResult* result, uint32_t array) {
  return result && array < result->arrays.size() ? result->arrays[array].length : 0;
}

void sf_result_free(SfResult* result) { delete result; }

#ifdef __EMSCRIPTEN__
int __real_emscripten_resize_heap(size_t bytes);

/// In place of the linker's (--wrap): grows memory by a fifth at least. Growing it costs the host milliseconds, since all views of
/// it become others, and the heap asks for a page at a time.
__attribute__((used)) int __wrap_emscripten_resize_heap(size_t bytes) {
  const size_t more = __builtin_wasm_memory_size(0) * (65536 / 5);
  if (bytes + more > bytes && __real_emscripten_resize_heap(bytes + more)) return 1;
  return __real_emscripten_resize_heap(bytes);
}
#endif

}  // extern "C"
