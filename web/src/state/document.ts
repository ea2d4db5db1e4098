// The document: objects with ids and kinds, in groups with settings. Immutable; commands, which are data, make the
// next one. What an object is made of only its kind knows.
import { unionOf, type Box, type Point } from '../shapes/vec.ts';

/** No two groups or objects of a document ever have the same. */
export type Id = number;

/** An object of the document. */
export interface Item<S = unknown> {
  readonly id: Id;
  readonly kind: string;
  /** Plain data, typed arrays included: it is saved as it is. */
  readonly shape: S;
}

/** Objects that are worked on together in one mode, such as the curves of a film, with the settings of that work. */
export interface Group<S extends object = object> {
  readonly id: Id;
  readonly mode: string;
  readonly name: string;
  /** Plain data of one level. */
  readonly settings: S;
  readonly items: readonly Item[];
}

export interface Document {
  readonly groups: readonly Group[];
}

/** One part of an object, such as a ring of a polygon, or one of its handles, such as a vertex. */
export interface Place {
  readonly item: Id;
  readonly part: number;
  /** Null: the whole part. Handles are numbered through all parts of their object. */
  readonly handle: number | null;
}

/** What the document knows of a kind of object. Shapes are never changed. */
export interface Kind<S> {
  readonly name: string;
  /** Its parts can be chosen, but are neither moved nor removed. */
  readonly isFixed?: boolean;
  boxOf(shape: S): Box;
  /** `[parts + 1]` the first handle of each part, and the number of all. */
  partStarts(shape: S): ArrayLike<number>;
  handleAt(shape: S, handle: number): Point;
  move(shape: S, places: readonly Place[], by: Point): S;
  /** Null: nothing of it is left. */
  remove(shape: S, places: readonly Place[]): S | null;
  /** What was saved as a shape; null if it is none. */
  read(saved: unknown): S | null;
}

export type Command = { readonly group: Id } & (
  | { readonly type: 'add'; readonly items: readonly Item[] }
  /** Puts a shape in place of an object's. */
  | { readonly type: 'reshape'; readonly item: Id; readonly shape: unknown }
  | { readonly type: 'move'; readonly places: readonly Place[]; readonly by: Point }
  | { readonly type: 'delete'; readonly places: readonly Place[] }
  | { readonly type: 'clear' }
  | { readonly type: 'open'; readonly name: string; readonly items: readonly Item[]; readonly settings?: object }
  | { readonly type: 'set'; readonly settings: object }
);

export const kUntitled = 'Untitled';

let lastId = 0;
export const newId = (): Id => ++lastId;

/** Lets no new id be one of a document that comes from elsewhere. */
export function reserveIds({ groups }: Document): void {
  for (const { id, items } of groups) lastId = Math.max(lastId, id, ...items.map((item) => item.id));
}

export const newItem = <S>({ name }: Pick<Kind<S>, 'name'>, shape: S): Item<S> => ({ id: newId(), kind: name, shape });

const kinds = new Map<string, Kind<unknown>>();

/** Makes a kind known, before the first object of it. */
export function registerKind<S>(kind: Kind<S>): void {
  kinds.set(kind.name, kind);
}

export function kindOf({ kind }: Item): Kind<unknown> {
  const found = kinds.get(kind);
  if (found === undefined) throw new Error(`There is no kind of object “${kind}”.`);
  return found;
}

/** The group after a command for it; the same object where nothing changes. */
export function apply(group: Group, command: Command): Group {
  const { items } = group;
  switch (command.type) {
    case 'add':
      return command.items.length === 0 ? group : { ...group, items: [...items, ...command.items] };
    case 'reshape':
      return withShapes(group, new Set([command.item]), () => command.shape);
    case 'move': {
      if (command.by.every((x) => x === 0)) return group;
      const of = placesByItem(command.places);
      return withShapes(group, new Set(of.keys()), (item) => kindOf(item).move(item.shape, of.get(item.id) ?? [], command.by));
    }
    case 'delete': {
      const of = placesByItem(command.places);
      return withShapes(group, new Set(of.keys()), (item) => kindOf(item).remove(item.shape, of.get(item.id) ?? []));
    }
    case 'clear':
      return items.length === 0 ? group : { ...group, name: kUntitled, items: [] };
    case 'open':
      return { ...group, name: command.name, items: command.items, settings: command.settings ?? group.settings };
    case 'set': {
      const settings = { ...group.settings, ...command.settings };
      return isSame(settings, group.settings) ? group : { ...group, settings };
    }
  }
}

/** The group with other shapes in some of its objects; null takes an object out. */
function withShapes(group: Group, of: ReadonlySet<Id>, next: (item: Item) => unknown): Group {
  if (!group.items.some(({ id }) => of.has(id))) return group;
  const items = group.items.flatMap((item) => {
    if (!of.has(item.id)) return item;
    const shape = next(item);
    return shape === null ? [] : { ...item, shape };
  });
  return { ...group, items };
}

function placesByItem(places: readonly Place[]): Map<Id, Place[]> {
  const found = new Map<Id, Place[]>();
  for (const place of places) {
    const list = found.get(place.item);
    if (list) list.push(place);
    else found.set(place.item, [place]);
  }
  return found;
}

/** Whether two values of plain data are equal. */
export function isSame(a: unknown, b: unknown): boolean {
  if (Object.is(a, b)) return true;
  if (typeof a !== 'object' || typeof b !== 'object' || a === null || b === null) return false;
  const keys = Object.keys(a);
  if (keys.length !== Object.keys(b).length) return false;
  return keys.every((key) => isSame(a[key as keyof typeof a], b[key as keyof typeof b]));
}

/** Whether parts and handles of an object have the same numbers in both groups. */
export function isNumberedAlike(id: Id, before: Group, after: Group): boolean {
  const [a, b] = [before, after].map(({ items }) => items.find((item) => item.id === id));
  if (a === undefined || b === undefined) return false;
  if (a.shape === b.shape) return true;
  const kind = kindOf(a);
  return isSame(kind.partStarts(a.shape), kind.partStarts(b.shape));
}

/** The handles that a place stands for. */
export function handlesAt(kind: Kind<unknown>, shape: unknown, { part, handle }: Place): number[] {
  if (handle !== null) return [handle];
  const starts = kind.partStarts(shape);
  return Array.from({ length: starts[part + 1] - starts[part] }, (_, i) => starts[part] + i);
}

/** The boxes of shapes, which never change. */
const boxes = new WeakMap<object, Box>();

export function boxOfItem(item: Item): Box {
  const shape = item.shape as object;
  const known = boxes.get(shape);
  if (known) return known;
  const box = kindOf(item).boxOf(shape);
  boxes.set(shape, box);
  return box;
}

export const boxOfGroup = ({ items }: Group): Box => unionOf(items.map(boxOfItem));
