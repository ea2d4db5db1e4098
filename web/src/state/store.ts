// The page's state: the document with its history, and how it is looked at. Everything that shows
// state reads these signals; everything that changes the document dispatches a command.
import { signal } from '@preact/signals';
import type { PlaneKind } from '../shapes/plane.ts';
import type { Point } from '../shapes/vec.ts';
import { apply, kEmptyDocument, type Command, type Document } from './document.ts';
import { createHistory } from './history.ts';

export const history = createHistory<Document, Command>(kEmptyDocument, apply, dropStaleSelection);
export const { doc, canUndo, canRedo, dispatch, endGesture, cancelGesture, forgetHistory, undo, redo } = history;

/** What the page is for at the moment: films between curves in space, or polygons in the plane. */
export type Mode = 'film' | 'polygon';
export const mode = signal<Mode>('film');

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

function dropStaleSelection({ curves }: Document): void {
  const isStale = (s: Selection | null) => {
    if (s === null) return false;
    const curve = curves.at(s.curve);
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
