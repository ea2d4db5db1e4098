// The C++ test program: doctest's runner, and the host function that the core imports.
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>
