// Spans of loops as hands draw them, ended early: what the short and the long tests of them share.
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

/// Spans the loops with bestSoFar and has the work end after `ticks` calls of the progress function. The fault
/// may be: a status that no such problem has; an answer, or a surface on the way, that is none (spanFault);
/// an answer dearer than one on the way; a bound that is not proven by then, below zero though no weight is,
/// falls, or exceeds the answer.
HandRun spanUntil(const Problem& problem, uint32_t ticks);

/// A problem of that kind of loops: options drawn at random on all default paths, spaces and objectives, with
/// faces across the loops and triangles to begin from now and then.
///   most  about how many vertices at most, sizes drawn log-uniformly
Problem handProblem(Hand kind, uint32_t most, Random& random);

/// Draws `count` of those problems, ends most of them after `ticks` calls and some sooner, and checks (doctest) that
/// none is at fault and that at least half of them have a surface.
void expectHandAnswers(Hand kind, uint32_t seed, int count, uint32_t most, uint32_t ticks);

}  // namespace sftest
