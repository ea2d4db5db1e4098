// The trimming curves that the loops of a face lack.
//
// Source: Kumar, sec. 2, has all of them given. Files often do not.
// Differs: each is found by inversion of its edge. On surfaces that close, it is found but for whole periods, and which side of
// the domain a seam lies on shows only once the curves of a loop are put in a row.
#pragma once
#include <cstdint>

#include "base/charge.h"
#include "base/work.h"
#include "surface/model.h"

namespace sf {

/// Gives the uses of a face the curves that they lack, by the parameters of their edges, such that consecutive ones meet and
/// all stay in the domain, as far as that can be; outer loops run counter-clockwise where there is a choice. Degenerate edges
/// run straight between their neighbours.
///   lost  out: the first use whose curve is not within its edge's tolerance and `slack` of the surface, or kNone. It and others
///         then still lack theirs
/// False if the work has ended.
bool findMissingCurves(Model& model, uint32_t face, double slack, Work& work, Charge& charge,
                       uint32_t& lost);

}  // namespace sf
