// Work on the document in threads, of all kinds through one queue: when it begins, what takes its place, progress,
// and one way to end it.
import { batch, computed, effect, signal, type ReadonlySignal } from '@preact/signals';
import { SoapfilmError, type Part } from 'soapfilm';
import { createWorker, type Film } from 'soapfilm/worker';
import type { Point } from '../shapes/vec.ts';
import type { Place } from './document.ts';
import { isLive, mode as shownMode } from './store.ts';

/** A part of an object that is at fault, one of its handles, or the edge from that handle to the next. */
export interface Fault {
  readonly place: Place;
  readonly isEdge: boolean;
}

/** Why work failed: a stable code, what to tell the user, and what to mark. */
export interface Failure {
  readonly code: string;
  readonly message: string;
  readonly faults: readonly Fault[];
  /** Where it lies, if that is known. */
  readonly point?: Point;
}

/** `Detail`: what the work tells besides how much is done. */
export type WorkState<Detail> =
  | { readonly phase: 'idle' | 'done' | 'cancelled' }
  | { readonly phase: 'running'; readonly fraction: number; readonly since: number; readonly detail: Detail | null }
  | ({ readonly phase: 'failed' } & Failure);

export interface Watch<Detail> {
  readonly signal: AbortSignal;
  /** Whether a gesture is under way, so that the result is a passing one. */
  readonly live: boolean;
  /** Milliseconds since the work began. */
  elapsed(): number;
  progress(fraction: number, detail?: Detail): void;
  /** Asks for the work to be done again once the gesture has ended. */
  onlyForNow(): void;
}

export interface WorkOptions<Input extends object, Result, Detail> {
  /** The mode that it is for. */
  readonly mode: string;
  /** What is done: "Spanning". */
  readonly verb: string;
  /** What there is to do; null: nothing. Another object whenever it has changed, and only then. */
  readonly input: ReadonlySignal<Input | null>;
  /** The part of the library that does it. */
  readonly part: Part;
  readonly compute: (film: Film, input: Input, watch: Watch<Detail>) => Promise<Result>;
  /** Called, within a batch, with what came of it; null: nothing, or there was nothing to do. */
  readonly show: (result: Result | null, input: Input | null, live: boolean) => void;
  readonly explain: (error: unknown, input: Input) => Failure;
  /** Called when work begins, if what was shown is of another input. */
  readonly begin?: (input: Input) => void;
  /** Whether changes are worked on without being asked; by default yes. */
  readonly auto?: ReadonlySignal<boolean>;
  /** Whether work is begun during gestures however long it took before; by default only work that was quick. */
  readonly alwaysLive?: boolean;
}

export interface Work<Detail = unknown> {
  readonly mode: string;
  /** What is done: "Spanning". */
  readonly verb: string;
  readonly state: ReadonlySignal<WorkState<Detail>>;
  /** Begins, in place of what is still running. */
  readonly start: () => void;
  /** Ends what is running; what it has found so far is kept if it can be. */
  readonly end: () => void;
}

/** A change arrives in pieces (slider, drag): wait this long for the next. */
const kSettleMs = 60;
/** During a gesture work this quick is let finish; slower work waits for the gesture's end. */
const kLiveMs = 250;

const all = signal<readonly Work[]>([]);

/** The work that is running for the mode that is shown, if any. */
export const busy = computed(
  () => all.value.find(({ mode, state }) => mode === shownMode.value && state.value.phase === 'running') ?? null,
);

/** Ends all that is running for the mode that is shown; says whether there was anything. */
export function endShownWork(): boolean {
  const running = all.peek().filter(({ mode, state }) => mode === shownMode.peek() && state.peek().phase === 'running');
  for (const work of running) work.end();
  return running.length > 0;
}

const threads = new Map<Part, Promise<Film>>();
/** Holes are shared out among so many threads at the most. */
const kMostThreads = 4;

/** Only calls about meshes are shared out; one core is left to the page. */
const threadsOf = (part: Part): number =>
  part === 'meshes' ? Math.max(1, Math.min(kMostThreads, navigator.hardwareConcurrency - 1)) : 1;

/** The threads for a part of the library; made when first wanted, and again after that has failed. */
function threadsFor(part: Part): Promise<Film> {
  const known = threads.get(part);
  if (known) return known;
  const made = createWorker({ parts: [part], size: threadsOf(part) });
  threads.set(part, made);
  made.catch(() => threads.delete(part));
  return made;
}

/** Works on what there is to do whenever it changes, from now on. */
export function createWork<Input extends object, Result, Detail = never>(
  options: WorkOptions<Input, Result, Detail>,
): Work<Detail> {
  const { input, part, compute, show, explain, begin, auto, alwaysLive = false } = options;
  const state = signal<WorkState<Detail>>({ phase: 'idle' });
  let running: AbortController | null = null;
  let timer: ReturnType<typeof setTimeout> | undefined;
  let lastMs = 0;
  /** What was worked on last, and whether the result is to do only while a gesture lasts. */
  let begun: { readonly input: Input | null; onlyForNow: boolean } = { input: null, onlyForNow: false };

  const isAuto = (): boolean => auto?.peek() ?? true;
  const isDue = (): boolean => begun.input !== input.peek() || (begun.onlyForNow && !isLive.peek());

  const schedule = (): void => {
    clearTimeout(timer);
    timer = setTimeout(
      () => {
        if (isLive.peek() && (running !== null || (lastMs > kLiveMs && !alwaysLive))) return;
        start();
      },
      isLive.peek() ? 0 : kSettleMs,
    );
  };

  const run = async (of: Input, live: boolean): Promise<void> => {
    const mine = new AbortController();
    const since = performance.now();
    const isMine = () => running === mine;
    running = mine;
    state.value = { phase: 'running', fraction: 0, since, detail: null };
    try {
      const film = await Promise.race([threadsFor(part), whenAborted(mine.signal)]);
      if (!isMine()) return;
      // Starting the threads says nothing of the work.
      const begunAt = performance.now();
      const result = await compute(film, of, {
        signal: mine.signal,
        live,
        elapsed: () => performance.now() - since,
        onlyForNow: () => {
          if (isMine()) begun.onlyForNow = true;
        },
        progress: (fraction, detail) => {
          if (isMine()) state.value = { phase: 'running', fraction, since, detail: detail ?? null };
        },
      });
      if (!isMine()) return;
      running = null;
      lastMs = performance.now() - begunAt;
      batch(() => {
        show(result, of, live);
        state.value = { phase: 'done' };
      });
    } catch (error) {
      if (!isMine()) return;
      running = null;
      if (mine.signal.aborted) {
        state.value = { phase: 'cancelled' };
        return;
      }
      batch(() => {
        show(null, of, live);
        state.value = { phase: 'failed', ...explain(error, of) };
      });
    }
    if (isAuto() && isDue()) schedule();
  };

  const start = (): void => {
    clearTimeout(timer);
    // What comes of the work under way is of no interest any more.
    const dropped = running;
    running = null;
    dropped?.abort();
    const [of, live] = [input.peek(), isLive.peek()];
    begun = { input: of, onlyForNow: false };
    batch(() => {
      if (of === null) {
        show(null, null, live);
        state.value = { phase: 'idle' };
      } else {
        begin?.(of);
        void run(of, live);
      }
    });
  };

  const work: Work<Detail> = {
    mode: options.mode,
    verb: options.verb,
    state,
    start,
    end() {
      clearTimeout(timer);
      running?.abort();
    },
  };
  all.value = [...all.peek(), work];
  effect(() => {
    const [now] = [input.value, isLive.value, auto?.value];
    if (!isDue()) return;
    if (now === null) start();
    else if (isAuto()) schedule();
  });
  return work;
}

/** Threads that are on their way are not worth waiting for any more. */
const whenAborted = (signal: AbortSignal): Promise<never> =>
  new Promise((_, reject) => {
    signal.addEventListener('abort', () => {
      reject(new SoapfilmError('cancelled', 'The work was cancelled'));
    });
  });

/** The failure of an error without a place. */
export function plainFailure(error: unknown): Failure {
  const code = error instanceof SoapfilmError ? error.code : 'crashed';
  const words = error instanceof Error ? error.message : String(error);
  return { code, message: code === 'load-failed' ? `soapfilm could not be loaded: ${words}` : words, faults: [] };
}
