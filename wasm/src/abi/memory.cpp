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

}  // extern "C"
