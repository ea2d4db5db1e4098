// Spanning the document in the worker: when to begin, when to cancel, and what came of it.
import { batch, computed, effect, signal } from '@preact/signals';
import { SoapfilmError, type Span, type SpaceUsed } from 'soapfilm';
import { createWorker } from 'soapfilm/worker';
import { isReshaped, spanOptions, toLoopSet, type Document } from './document.ts';
import { doc } from './store.ts';
import { describeFailure, type Failure } from './wording.ts';

export type Solve =
  | { readonly phase: 'idle' }
  | {
      readonly phase: 'running';
      readonly fraction: number;
      readonly bestCost: number;
      readonly lowerBound: number;
      readonly since: number;
    }
  | { readonly phase: 'done' }
  | { readonly phase: 'none'; readonly reason: string; readonly candidates: SpaceUsed }
  | { readonly phase: 'cancelled' }
  | ({ readonly phase: 'failed' } & Failure);

/** A surface, what it spans, and how it should come into view. */
export interface Surface {
  readonly span: Span;
  readonly of: Document;
  readonly entrance: 'grow' | 'at-once';
}

export const solve = signal<Solve>({ phase: 'idle' });
export const surface = signal<Surface | null>(null);
/** Whether changes are spanned without being asked. */
export const auto = signal(true);

/** Whether the surface shown spans other curves or settings than the document's. */
export const isStale = computed(() => {
  const of = surface.value?.of;
  return of !== undefined && (of.curves !== doc.value.curves || of.settings !== doc.value.settings);
});

/** A change arrives in pieces (slider, drag): wait this long for the next. */
const kSettle = 60;
/** During a drag a span this quick is let finish; a slower one waits for the drag's end. */
const kLiveSeconds = 0.25;
/** Surfaces on the way are shown after this long: before that they would only flicker. */
const kShowBest = 3000;

let film: ReturnType<typeof createWorker> | null = null;
let running: AbortController | null = null;
let timer: ReturnType<typeof setTimeout> | undefined;
let lastSeconds = 0;
let isLive = false;
/** What the last span begun is of. */
let begun: Document | null = null;

/** Marks the changes that follow as passing ones of a drag or a slider, shown without ceremony. */
export function setLive(live: boolean): void {
  const ended = isLive && !live;
  isLive = live;
  if (ended && auto.peek() && isDue()) schedule();
}

/** Begins to span the document, in place of any span still running. */
export function startSpan(): void {
  clearTimeout(timer);
  dropRunning();
  const of = doc.peek();
  begun = of;
  batch(() => {
    const before = surface.peek()?.of;
    if (before && !isKin(before, of)) surface.value = null;
    if (of.curves.length === 0) solve.value = { phase: 'idle' };
    else void run(of, isLive);
  });
}

/** Whether a surface of one document, faded, can stand in for that of another for a while. */
function isKin(before: Document, after: Document): boolean {
  return isReshaped(before, after) || before.curves.some((curve) => after.curves.includes(curve));
}

/** Ends the running span, with its best surface so far; without one, the surface shown stays. */
export function endSpan(): void {
  clearTimeout(timer);
  running?.abort();
}

/** Ends the running span, and with it all interest in what comes of it. */
function dropRunning(): void {
  const dropped = running;
  running = null;
  dropped?.abort();
}

async function run(of: Document, live: boolean): Promise<void> {
  const mine = new AbortController();
  const since = performance.now();
  const isMine = () => running === mine;
  running = mine;
  solve.value = { phase: 'running', fraction: 0, bestCost: Infinity, lowerBound: 0, since };
  try {
    const worker = await (film ??= createWorker({ parts: ['loops'] }));
    if (!isMine()) return;
    const outcome = await worker.spanLoops(toLoopSet(of.curves), {
      ...spanOptions(of),
      signal: mine.signal,
      bestSoFar: !live,
      onBest: (span) => {
        if (!isMine() || performance.now() - since < kShowBest) return;
        surface.value = { span, of, entrance: 'at-once' };
      },
      onProgress: (fraction, bestCost, lowerBound) => {
        if (isMine()) solve.value = { phase: 'running', fraction, bestCost, lowerBound, since };
      },
    });
    if (!isMine()) return;
    running = null;
    lastSeconds = (performance.now() - since) / 1000;
    batch(() => {
      if (outcome.found) {
        const before = surface.peek()?.of;
        const isModest = live || (before !== undefined && isReshaped(before, of));
        surface.value = { span: outcome, of, entrance: isModest ? 'at-once' : 'grow' };
        solve.value = { phase: 'done' };
      } else {
        surface.value = null;
        solve.value = { phase: 'none', reason: outcome.reason, candidates: outcome.candidates };
      }
    });
  } catch (error) {
    if (!isMine()) return;
    running = null;
    if (mine.signal.aborted) {
      solve.value = { phase: 'cancelled' };
      return;
    }
    // A worker that could not be made is tried again with the next span.
    if (error instanceof SoapfilmError && error.code === 'load-failed') film = null;
    batch(() => {
      surface.value = null;
      solve.value = { phase: 'failed', ...describeFailure(error, of.curves) };
    });
  }
  if (auto.peek() && isDue()) schedule();
}

/** Whether the document has changed since the last span began. */
function isDue(): boolean {
  const now = doc.peek();
  return begun === null || begun.curves !== now.curves || begun.settings !== now.settings;
}

function schedule(): void {
  clearTimeout(timer);
  timer = setTimeout(() => {
    if (isLive && (running !== null || lastSeconds > kLiveSeconds)) return;
    startSpan();
  }, isLive ? 0 : kSettle);
}

/** Spans the document whenever it changes, from now on. */
export function followDocument(): void {
  effect(() => {
    const { curves } = doc.value;
    if (!isDue()) return;
    if (curves.length === 0) startSpan();
    else if (auto.value) schedule();
  });
}
