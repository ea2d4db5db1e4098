// The page's state: the document with its history, and how it is looked at. Everything that shows
// state reads these signals; everything that changes the document dispatches a command.
import { batch, computed, signal } from '@preact/signals';
import type { PlaneKind } from '../shapes/plane.ts';
import type { Point } from '../shapes/vec.ts';
import { apply, kEmptyDocument, type Command, type Document } from './document.ts';

const kHistoryLimit = 200;

const past = signal<readonly Document[]>([]);
const future = signal<readonly Document[]>([]);
const current = signal<Document>(kEmptyDocument);
let openGesture: string | null = null;

export const doc = computed(() => current.value);
export const canUndo = computed(() => past.value.length > 0);
export const canRedo = computed(() => future.value.length > 0);

/**
 * Applies a command. Commands of one `gesture` (a drag, a slider's travel) become one step of
 * the history, until `endGesture`.
 */
export function dispatch(command: Command, gesture: string | null = null): void {
  const before = current.peek();
  const after = apply(before, command);
  if (after === before) return;
  batch(() => {
    if (gesture === null || gesture !== openGesture) {
      past.value = [...past.peek().slice(1 - kHistoryLimit), before];
    }
    openGesture = gesture;
    future.value = [];
    current.value = after;
    dropStaleSelection();
  });
}

export function endGesture(): void {
  openGesture = null;
}

/** Goes back to before the open gesture, as if it had not been. */
export function cancelGesture(): void {
  if (openGesture === null) return;
  undo();
  future.value = [];
}

/** Makes the document as it is the first of the history. */
export function forgetHistory(): void {
  openGesture = null;
  batch(() => {
    past.value = [];
    future.value = [];
  });
}

export function undo(): void {
  step(past, future);
}

export function redo(): void {
  step(future, past);
}

function step(from: typeof past, to: typeof past): void {
  const next = from.peek().at(-1);
  if (next === undefined) return;
  openGesture = null;
  batch(() => {
    from.value = from.peek().slice(0, -1);
    to.value = [...to.peek(), current.peek()];
    current.value = next;
    dropStaleSelection();
  });
}

export type Tool = 'select' | 'draw';

/** `vertex` null: the whole curve. */
export interface Selection {
  readonly curve: number;
  readonly vertex: number | null;
}

export const tool = signal<Tool>('select');
export const selection = signal<Selection | null>(null);
export const hover = signal<Selection | null>(null);

export interface Drawing {
  readonly plane: PlaneKind;
  readonly offset: number;
  /** Vertices of a drawn curve. */
  readonly count: number;
  readonly smoothing: number;
  /** The plane in which vertices are dragged. */
  readonly dragIn: 'view' | 'plane';
}
export const drawing = signal<Drawing>({
  plane: 'xy',
  offset: 0,
  count: 24,
  smoothing: 0.4,
  dragIn: 'view',
});

export interface Shown {
  readonly surface: boolean;
  readonly wires: boolean;
  readonly vertices: boolean;
  readonly grid: boolean;
}
export const shown = signal<Shown>({ surface: true, wires: true, vertices: true, grid: true });

/** A passing remark to the user; errors of a span are kept with the span. */
export interface Notice {
  readonly kind: 'info' | 'error';
  readonly text: string;
}
export const notice = signal<Notice | null>(null);

let noticeTimer: ReturnType<typeof setTimeout> | undefined;

/** Shows a remark: an error until the next one, anything else for a few seconds. */
export function say(text: string, kind: Notice['kind'] = 'info'): void {
  clearTimeout(noticeTimer);
  notice.value = { kind, text };
  if (kind === 'info') noticeTimer = setTimeout(() => (notice.value = null), 4500);
}

export function dismissNotice(): void {
  clearTimeout(noticeTimer);
  notice.value = null;
}

function dropStaleSelection(): void {
  const isStale = (s: Selection | null) => {
    if (s === null) return false;
    const curve = current.peek().curves.at(s.curve);
    return curve === undefined || (s.vertex !== null && s.vertex >= curve.length);
  };
  if (isStale(selection.peek())) selection.value = null;
  if (isStale(hover.peek())) hover.value = null;
}

/** A wish to have all curves in view, from a direction or from where the eye is. */
export interface Framing {
  readonly direction?: Point;
  readonly atOnce: boolean;
}
export const framing = signal<Framing | null>(null);

export function requestFrame(direction?: Point, atOnce = false): void {
  framing.value = direction ? { direction, atOnce } : { atOnce };
}

/** Whether a surface is just appearing. */
export const isGrowing = signal(false);
