// What the C ABI generates from the tables of soapfilm_tables.h.
#pragma once
#include <cstddef>
#include <cstdint>

#include "soapfilm.h"

// NOLINTBEGIN(bugprone-macro-parentheses): macros that make declarations

/// How many entries a table has.
#define SF_COUNT_ONE(...) +1
#define SF_COUNT(table) (0 table(SF_COUNT_ONE))

/// Ties an enum of the core to its table. If only one of them has a value, or if they number it
/// differently, this does not compile.
#define SF_TIED(name, value, meaning)                 \
  case Tied::name:                                    \
    static_assert(int(Tied::name) == (value), #name); \
    break;
#define SF_TIE(check, Enum, table)                                                           \
  _Pragma("GCC diagnostic push") _Pragma("GCC diagnostic error \"-Wswitch\"") constexpr bool \
  check(Enum choice) {                                                                       \
    using Tied = Enum;                                                                       \
    switch (choice) { table(SF_TIED) }                                                       \
    return true;                                                                             \
  }                                                                                          \
  static_assert(check(Enum{}), #Enum);                                                       \
  _Pragma("GCC diagnostic pop")

// NOLINTEND(bugprone-macro-parentheses)

namespace sf {

/// The element type that the table gives an array of a result.
template <auto array>
struct ElementOf;

#define SF_ELEMENT(prefix, element, name) \
  template <>                             \
  struct ElementOf<prefix##_##name> {     \
    using Type = element;                 \
  };
#define SF_ARRAY(type, name, meaning) SF_ELEMENT(SfSpan, type, name)
SF_SPAN_ARRAYS(SF_ARRAY)
#undef SF_ARRAY
#define SF_ARRAY(type, name, meaning) SF_ELEMENT(SfPolygon, type, name)
SF_POLYGON_ARRAYS(SF_ARRAY)
#undef SF_ARRAY
#define SF_ARRAY(type, name, meaning) SF_ELEMENT(SfOpened, type, name)
SF_OPENED_ARRAYS(SF_ARRAY)
#undef SF_ARRAY
#define SF_ARRAY(type, name, meaning) SF_ELEMENT(SfEdit, type, name)
SF_EDIT_ARRAYS(SF_ARRAY)
#undef SF_ARRAY
#define SF_ARRAY(type, name, meaning) SF_ELEMENT(SfState, type, name)
SF_STATE_ARRAYS(SF_ARRAY)
#undef SF_ARRAY
#define SF_ARRAY(type, name, meaning) SF_ELEMENT(SfHoles, type, name)
SF_HOLES_ARRAYS(SF_ARRAY)
#undef SF_ARRAY
#define SF_ARRAY(type, name, meaning) SF_ELEMENT(SfCrossings, type, name)
SF_CROSSINGS_ARRAYS(SF_ARRAY)
#undef SF_ARRAY
#define SF_ARRAY(type, name, meaning) SF_ELEMENT(SfWeld, type, name)
SF_WELD_ARRAYS(SF_ARRAY)
#undef SF_ARRAY
#define SF_ARRAY(type, name, meaning) SF_ELEMENT(SfCarry, type, name)
SF_CARRY_ARRAYS(SF_ARRAY)
#undef SF_ARRAY
#define SF_ARRAY(type, name, meaning) SF_ELEMENT(SfFill, type, name)
SF_FILL_ARRAYS(SF_ARRAY)
#undef SF_ARRAY
#define SF_ARRAY(type, name, meaning) SF_ELEMENT(SfSmooth, type, name)
SF_SMOOTH_ARRAYS(SF_ARRAY)
#undef SF_ARRAY
#define SF_ARRAY(type, name, meaning) SF_ELEMENT(SfSurfaces, type, name)
SF_SURFACES_ARRAYS(SF_ARRAY)
#undef SF_ARRAY
#define SF_ARRAY(type, name, meaning) SF_ELEMENT(SfTessellation, type, name)
SF_TESSELLATION_ARRAYS(SF_ARRAY)
#undef SF_ARRAY
#define SF_ARRAY(type, name, meaning) SF_ELEMENT(SfChange, type, name)
SF_CHANGE_ARRAYS(SF_ARRAY)
#undef SF_ARRAY
#define SF_ARRAY(type, name, meaning) SF_ELEMENT(SfMove, type, name)
SF_MOVE_ARRAYS(SF_ARRAY)
#undef SF_ARRAY

}  // namespace sf
