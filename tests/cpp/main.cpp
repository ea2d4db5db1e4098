// The C++ test programs: doctest's runner, and the host function that the core imports.
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

#include "soapfilm.h"

// Lets every call go on; weak, so that a test of progress and cancelling can define its own.
extern "C" __attribute__((weak)) int32_t sf_host_progress(double, double, double) { return 1; }
extern "C" __attribute__((weak)) double sf_host_seconds() { return 0; }
extern "C" __attribute__((weak)) void sf_host_result(const SfResult*) {}
