// SF_ASSERT: invariants of the core, checked in test builds (SF_TESTING), compiled out elsewhere.
#pragma once
#ifdef SF_TESTING
#include <cstdio>
#include <cstdlib>
#define SF_ASSERT(condition)                                                                      \
  ((condition) ? (void)0                                                                          \
               : (std::fprintf(stderr, "%s:%d: SF_ASSERT(%s)\n", __FILE__, __LINE__, #condition), \
                  std::abort()))
#else
#define SF_ASSERT(condition) ((void)0)
#endif
