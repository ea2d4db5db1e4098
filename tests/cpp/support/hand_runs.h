// Spans of hand-drawn loops that are ended early: shared by the short and the long tests.
#pragma once
#include <string>

#include "support/cases.h"
#include "support/hand_loops.h"

namespace sftest {

struct HandRun {
  std::string fault;  // what is wrong, or ""
  sf::Outcome outcome;
  sf::Span span;
};

/// Spans the loops with bestSoFar, and ends the work after `ticks` calls of the progress function.
/// Faults are: a status that no such problem has; an answer or a reported surface that is invalid
/// (spanFault); an answer dearer than a reported surface; a bound that is not proven at that time,
/// is below zero though no weight is, falls, or exceeds the answer.
///   bestSoFar  else a call that is stopped has to end with Stopped
HandRun spanUntil(const Problem& problem, uint32_t ticks, bool bestSoFar = true);

/// A problem with loops of that kind. Its options are drawn at random from all default paths,
/// spaces and objectives, now and then with faces across the loops and triangles to begin from.
///   most  about the largest number of vertices; sizes are drawn log-uniformly
Problem handProblem(Hand kind, uint32_t most, Random& random);

/// Draws `count` of those problems. Ends most of them after `ticks` calls and some sooner. Checks
/// (doctest) that none is at fault and that at least half of them have a surface.
void expectHandAnswers(Hand kind, uint32_t seed, int count, uint32_t most, uint32_t ticks);

}  // namespace sftest
