// What a stored draft has to be like. What it was once stored as, and by which version of the page, nobody knows.
import type { Document, Group, Id, Item, Kind } from './document.ts';

/** A draft as it is stored. */
interface Draft {
  readonly version: typeof kVersion;
  /** When it was stored, in milliseconds since 1970. */
  readonly time: number;
  readonly doc: Document;
}

const kVersion = 1;
/** Ids beyond this are none that the page has made, and would soon be too large to count on. */
const kMostIds = 2 ** 48;

/** `version`: stored by another version of the page. */
export type Problem = 'version' | 'broken';

export const draftOf = (doc: Document, time: number): Draft => ({ version: kVersion, time, doc });

/** What has been stored as a draft; null: nothing. Shapes are for their kinds to read. */
export function readDraft(stored: unknown): { readonly doc: Document } | { readonly problem: Problem } | null {
  if (stored === undefined) return null;
  if (!isRecord(stored)) return { problem: 'broken' };
  if (stored.version !== kVersion) return { problem: typeof stored.version === 'number' ? 'version' : 'broken' };
  const groups = isRecord(stored.doc) ? listOf(stored.doc.groups, readGroup) : null;
  if (groups === null) return { problem: 'broken' };
  const ids = groups.flatMap(({ id, items }) => [id, ...items.map((item) => item.id)]);
  return new Set(ids).size === ids.length ? { doc: { groups } } : { problem: 'broken' };
}

function readGroup(stored: unknown): Group | null {
  if (!isRecord(stored)) return null;
  const { id, mode, name, settings } = stored;
  const items = listOf(stored.items, readItem);
  if (!isId(id) || typeof mode !== 'string' || typeof name !== 'string' || !isRecord(settings) || items === null) return null;
  return { id, mode, name, settings, items };
}

function readItem(stored: unknown): Item | null {
  if (!isRecord(stored) || !isId(stored.id) || typeof stored.kind !== 'string') return null;
  const { id, kind, shape } = stored;
  return typeof shape === 'object' && shape !== null ? { id, kind, shape } : null;
}

/** A list of which every entry can be read. */
function listOf<T>(stored: unknown, read: (entry: unknown) => T | null): T[] | null {
  if (!Array.isArray(stored)) return null;
  const entries = stored.map(read);
  return entries.every((entry) => entry !== null) ? entries : null;
}

const isId = (value: unknown): value is Id => Number.isInteger(value) && (value as number) > 0 && (value as number) < kMostIds;

/** Whether it is a plain object. */
export function isRecord(value: unknown): value is Record<string, unknown> {
  return typeof value === 'object' && value !== null && Object.prototype.toString.call(value) === '[object Object]';
}

/**
 * The group with the objects that its kinds can read, and the number of others. Settings that are missing, or of another
 * type than in `settings`, are taken from there; those that are not in it go.
 */
export function adoptGroup<S extends object>(
  group: Group,
  kinds: readonly Pick<Kind<unknown>, 'name' | 'read'>[],
  settings = group.settings as S,
): { readonly group: Group<S>; readonly lost: number } {
  const items = group.items.flatMap((item) => {
    const shape = kinds.find(({ name }) => name === item.kind)?.read(item.shape) ?? null;
    return shape === null ? [] : { ...item, shape };
  });
  return { group: { ...group, items, settings: like(settings, group.settings) }, lost: group.items.length - items.length };
}

/** What was saved, where it has the types of the settings. */
function like<S extends object>(settings: S, saved: object): S {
  const entries = Object.entries(settings).map(([key, preset]: [string, unknown]) => {
    const value = (saved as Record<string, unknown>)[key];
    return [key, isLike(preset, value) ? value : preset];
  });
  return Object.fromEntries(entries) as S;
}

function isLike(preset: unknown, value: unknown): boolean {
  if (preset === null || value === null) return preset === value;
  if (typeof preset !== typeof value || Array.isArray(preset) !== Array.isArray(value)) return false;
  if (typeof preset === 'number') return Number.isFinite(value);
  if (typeof preset !== 'object' || Array.isArray(preset)) return true;
  return Object.entries(preset).every(([key, each]) => isLike(each, (value as Record<string, unknown>)[key]));
}
