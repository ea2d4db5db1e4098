// Spanning the curves in the worker, and what came of it.
import { computed, signal } from '@preact/signals';
import type { NoSpan, Span, SpaceUsed } from 'soapfilm';
import { isSame } from '../../state/document.ts';
import { createWork } from '../../state/work.ts';
import { film, kMode } from './film.ts';
import { curvesOf, isReshaped, spanOptions, toLoopSet, type FilmGroup } from './settings.ts';
import { describeFailure } from './wording.ts';

/** What is known while a span runs. */
export interface Bounds {
  readonly bestCost: number;
  readonly lowerBound: number;
}

/** A surface, what it spans, and how it should come into view. */
export interface Surface {
  readonly span: Span;
  readonly of: FilmGroup;
  readonly entrance: 'grow' | 'at-once';
}

export const surface = signal<Surface | null>(null);
/** Why there is no surface, where the triangles allow none. */
export const none = signal<{ readonly reason: string; readonly candidates: SpaceUsed } | null>(null);
/** Whether changes are spanned without being asked. */
export const auto = signal(true);

/** The curves, if there are any: the same object while only what comes after the span is another. */
let spannable: FilmGroup | null = null;
const input = computed(() => {
  const now = film.value;
  if (now.items.length === 0) spannable = null;
  else if (spannable === null || !spansAlike(spannable, now)) spannable = now;
  return spannable;
});

/** Whether two groups have the same span. */
function spansAlike(a: FilmGroup, b: FilmGroup): boolean {
  const { weights, objective, candidates } = b.settings;
  return a.items === b.items && isSame({ ...a.settings, weights, objective, candidates }, a.settings);
}

/** Whether the surface shown spans other curves or settings than the document's. */
export const isStale = computed(() => {
  const of = surface.value?.of;
  return of !== undefined && !spansAlike(of, film.value);
});

/** Surfaces on the way are shown after this long: before that they would only flicker. */
const kShowBestMs = 3000;

export const spanning = createWork<FilmGroup, Span | NoSpan, Bounds>({
  mode: kMode,
  verb: 'Spanning',
  part: 'loops',
  input,
  auto,
  begin: (of) => {
    const before = surface.peek()?.of;
    if (before && !isKin(before, of)) surface.value = null;
  },
  compute: (library, of, watch) =>
    library.spanLoops(toLoopSet(curvesOf(of)), {
      ...spanOptions(of),
      signal: watch.signal,
      bestSoFar: !watch.live,
      onBest: (span) => {
        if (!watch.signal.aborted && watch.elapsed() > kShowBestMs) surface.value = { span, of, entrance: 'at-once' };
      },
      onProgress: (fraction, bestCost, lowerBound) => {
        watch.progress(fraction, { bestCost, lowerBound });
      },
    }),
  show: (outcome, of, live) => {
    none.value = outcome?.found === false ? outcome : null;
    if (of === null || !outcome?.found) {
      surface.value = null;
      return;
    }
    const before = surface.peek()?.of;
    const isModest = live || (before !== undefined && isReshaped(before, of));
    surface.value = { span: outcome, of, entrance: isModest ? 'at-once' : 'grow' };
  },
  explain: (error, of) => describeFailure(error, of),
});

/** Whether a surface of one group, faded, can stand in for that of another for a while. */
function isKin(before: FilmGroup, after: FilmGroup): boolean {
  return isReshaped(before, after) || before.items.some((item) => after.items.includes(item));
}
