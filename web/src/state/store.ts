// The page's state: the document with its history, and how it is looked at. Everything that shows state reads these
// signals; everything that changes the document dispatches a command.
import { batch, computed, signal, type ReadonlySignal } from '@preact/signals';
import type { PlaneKind } from '../shapes/plane.ts';
import type { Box, Point } from '../shapes/vec.ts';
import {
  isNumberedAlike,
  kindOf,
  kUntitled,
  newId,
  type Group,
  type Id,
  type Item,
  type Place,
} from './document.ts';
import { createHistory } from './history.ts';
import { settle } from './notice.ts';

/** The mode that the page is in; empty until the first is there. */
export const mode = signal('');

let showMode: (mode: string) => void = () => undefined;
/** Says what shows the mode of a change that undo or redo has made. */
export function onStep(show: (mode: string) => void): void {
  showMode = show;
}

export const { doc, canUndo, canRedo, isLive, dispatch, endGesture, cancelGesture, undo, redo, put } = createHistory(
  (before, after, isStep) => {
    dropStalePlaces(before, after);
    // A complaint about what was tried is answered by what has been done since.
    settle('stroke', 'plane', 'file', 'export');
    if (isStep) showMode(after.mode);
  },
);

/** The group that a mode works on: made, with such settings, where the document has none. */
export function ensureGroup<S extends object>(of: string, settings: S): Group<S> {
  const found = doc.peek().groups.find((group) => group.mode === of);
  if (found) return found as Group<S>;
  const made: Group<S> = { id: newId(), mode: of, name: kUntitled, settings, items: [] };
  put(made);
  return made;
}

/** A mode's group as it changes; an empty one with such settings until `ensureGroup` has made it. */
export function groupOf<S extends object>(of: string, settings: S): ReadonlySignal<Group<S>> {
  const none: Group<S> = { id: 0, mode: of, name: kUntitled, settings, items: [] };
  return computed(() => (doc.value.groups.find((group) => group.mode === of) as Group<S> | undefined) ?? none);
}

/** The group of the mode that the page is in; null until it is there. */
export const group = computed(() => doc.value.groups.find((each) => each.mode === mode.value) ?? null);

/** Changes settings of a group; changes of one `gesture` are one step until the change that is not `passing`. */
export function setIn<S extends object>({ id }: Group<S>, settings: Partial<S>, gesture?: string, passing = false): void {
  dispatch({ type: 'set', group: id, settings }, gesture);
  if (gesture !== undefined && !passing) endGesture();
}

/** What a group is to hold in place of what it has. */
export interface Opening {
  readonly name: string;
  readonly items: readonly Item[];
  readonly settings?: object;
  /** From the objects towards the viewer; absent: as it is. */
  readonly view?: Point;
}

/** Opens objects in a group, as one step of the history, and has them in view. */
export function openItems({ id }: Group, { view, ...opened }: Opening): void {
  choose();
  dispatch({ type: 'open', group: id, ...opened });
  requestFrame(view);
}

/** Opens them as what was there from the beginning. */
export function beginWith(group: Group, { view, ...opened }: Opening): void {
  put({ ...group, ...opened });
  requestFrame(view, true);
}

export type Tool = 'select' | 'draw';
export const tool = signal<Tool>('select');

/** What is chosen, in the group that is shown: the last is the one that was chosen last. */
export const selection = signal<readonly Place[]>([]);
export const hover = signal<Place | null>(null);

/** The place chosen last, if any. */
export const chosen = computed(() => selection.value.at(-1) ?? null);

export function choose(...places: readonly (Place | null)[]): void {
  selection.value = places.filter((place) => place !== null);
}

export const isSamePlace = (a: Place | null, b: Place | null): boolean =>
  a?.item === b?.item && a?.part === b?.part && a?.handle === b?.handle;

export const isChosen = (place: Place): boolean => selection.peek().some((each) => isSamePlace(each, place));

/** For sets and maps of places. */
export const keyOf = ({ item, part, handle }: Place): string => `${item} ${part} ${handle ?? ''}`;

/** Whether what is at a place can be moved and removed. */
export function isMovable({ item: id }: Place): boolean {
  const item = itemBy(id);
  return item !== undefined && !kindOf(item).isFixed;
}

export function itemBy(id: Id): Item | undefined {
  return group.peek()?.items.find((item) => item.id === id);
}

/** Places of objects whose parts or handles have other numbers now would stand for something else. */
function dropStalePlaces(before: Group, after: Group): void {
  if (after.mode !== mode.peek()) return;
  const alike = new Map<Id, boolean>();
  const isStale = ({ item }: Place): boolean => {
    if (!alike.has(item)) alike.set(item, isNumberedAlike(item, before, after));
    return alike.get(item) !== true;
  };
  batch(() => {
    const kept = selection.peek().filter((place) => !isStale(place));
    if (kept.length < selection.peek().length) selection.value = kept;
    if (hover.peek() !== null && isStale(hover.peek() as Place)) hover.value = null;
  });
}

/** All parts of the group that is shown, in order. */
function allParts(): Place[] {
  return (group.peek()?.items ?? []).flatMap((item) => {
    const { length } = kindOf(item).partStarts(item.shape);
    return Array.from({ length: length - 1 }, (_, part): Place => ({ item: item.id, part, handle: null }));
  });
}

/** Chooses the next part of all objects, or the one before; wraps round. */
export function stepPart(step: 1 | -1): void {
  const parts = allParts();
  if (parts.length === 0) return;
  const at = chosen.peek();
  const from = at === null ? -1 : parts.findIndex((each) => isSamePlace(each, { ...at, handle: null }));
  choose(parts[from < 0 ? (step > 0 ? 0 : parts.length - 1) : (from + step + parts.length) % parts.length]);
}

/** Chooses the next handle of the chosen part, or the one before; wraps round. */
export function stepHandle(step: 1 | -1): void {
  const at = chosen.peek() ?? allParts().at(0);
  const item = at && itemBy(at.item);
  if (!item) return;
  const starts = kindOf(item).partStarts(item.shape);
  const [first, end] = [starts[at.part], starts[at.part + 1]];
  if (first === end) return;
  const from = at.handle ?? (step > 0 ? end - 1 : first);
  choose({ ...at, handle: first + ((from - first + step + end - first) % (end - first)) });
}

/** How a stroke becomes a closed line. */
export interface Pen {
  /** Its vertices. */
  readonly count: number;
  readonly smoothing: number;
}

/** The plane that is drawn in, in modes that are in space. */
export interface DrawingPlane {
  readonly plane: PlaneKind;
  readonly offset: number;
  /** The plane in which vertices are dragged. */
  readonly dragIn: 'view' | 'plane';
}
export const drawingPlane = signal<DrawingPlane>({ plane: 'xy', offset: 0, dragIn: 'view' });

export interface Shown {
  readonly surface: boolean;
  readonly wires: boolean;
  readonly vertices: boolean;
  readonly grid: boolean;
}
export const shown = signal<Shown>({ surface: true, wires: true, vertices: true, grid: true });

/** A wish to have all objects in view, or only what is in a box; from a direction or from where the eye is. */
export interface Framing {
  readonly direction?: Point | undefined;
  readonly atOnce: boolean;
  readonly box?: Box | undefined;
}
export const framing = signal<Framing | null>(null);

export function requestFrame(direction?: Point, atOnce = false, box?: Box): void {
  framing.value = { direction, atOnce, box };
}
