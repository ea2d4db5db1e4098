// Files in and out: opened by what is in them, or named with what can open them; saved as downloads.
import type { Item } from '../state/document.ts';
import { complain, say, settle } from '../state/notice.ts';
import { ensureGroup, openItems } from '../state/store.ts';
import { Content } from './content.ts';
import type { FileKind, Mode, Room } from './mode.ts';

/** Files beyond this are not drawn by anyone. */
const kMaxMegabytes = 64;
/** Of more files than this that were opened, not all are named. */
const kMostNames = 3;

/** Where files are opened. */
export interface Destination {
  /** The mode that is shown. */
  readonly mode: Mode;
  readonly room: Room;
  readonly modes: readonly Mode[];
  /** Shows another mode; null if it could not be fetched. */
  readonly go: (modeId: string) => Promise<{ readonly mode: Mode; readonly room: Room } | null>;
}

/** A file that was read, or why not. */
type Outcome = { readonly file: File } & (
  | { readonly is: 'read'; readonly items: readonly Item[]; readonly name: string; readonly warnings: readonly string[] }
  /** Of a format that another mode opens. */
  | { readonly is: 'elsewhere'; readonly what: string; readonly opener: Mode }
  /** Of a format that no mode opens; null: of none that is known. */
  | { readonly is: 'foreign'; readonly what: string | null }
  | { readonly is: 'broken'; readonly reason: string }
);

/**
 * Opens all files that the mode reads, together and in place of what it has, as one step of the history; says so, and
 * says of each other file what it is and what can open it.
 */
export async function openFiles(files: readonly File[], into: Destination): Promise<void> {
  settle('file');
  if (files.length === 0) return;
  const outcomes: Outcome[] = [];
  for (const file of files) outcomes.push(await read(file, into));
  const opened = outcomes.filter((each) => each.is === 'read');
  if (opened.length > 0) {
    // The page may have gone elsewhere meanwhile.
    await into.go(into.mode.id);
    show(opened, into);
  }
  tell(outcomes, into);
}

async function read(file: File, { mode, room, modes }: Destination): Promise<Outcome> {
  const broken = (reason: string): Outcome => ({ file, is: 'broken', reason });
  const megabytes = file.size / 2 ** 20;
  if (megabytes > kMaxMegabytes) return broken(`it has ${Math.round(megabytes)} MB; no more than ${kMaxMegabytes} are opened.`);
  let bytes: Uint8Array;
  try {
    bytes = new Uint8Array(await file.arrayBuffer());
  } catch {
    return broken('the browser could not read it');
  }
  const content = new Content(bytes, file.name.replace(/\.[^.]*$/, ''));
  if (content.head === '') return broken('it is empty');
  const kind = kindIn(mode, content);
  if (kind) {
    try {
      await nextTask();
      const { items, name = content.stem, warnings = [] } = await room.read(kind.id, content);
      await nextTask();
      return { file, is: 'read', items, name, warnings };
    } catch (error) {
      return broken(reasonOf(error, 'what reads files could not be loaded'));
    }
  }
  for (const opener of modes) {
    const what = kindIn(opener, content)?.what;
    if (what !== undefined) return { file, is: 'elsewhere', what, opener };
  }
  return { file, is: 'foreign', what: await nameOf(content) };
}

/** Between the steps of a large file the page has a moment for its user. */
const nextTask = (): Promise<void> => new Promise((resolve) => setTimeout(resolve));

const kindIn = ({ files }: Mode, content: Content): FileKind | undefined => files.find(({ isIt }) => isIt(content));

async function nameOf(content: Content): Promise<string | null> {
  try {
    const { kKnownFiles } = await import('./known_files.ts');
    return kKnownFiles.find(({ isIt }) => isIt(content))?.what ?? null;
  } catch {
    // Without the list of names: as if it had none.
    return null;
  }
}

/** Why something failed, in words; where a script could not be fetched, in these. */
function reasonOf(error: unknown, unfetched: string): string {
  // Browsers agree only on the class and on this word.
  if (error instanceof TypeError && /import/i.test(error.message)) return unfetched;
  return error instanceof Error ? error.message : String(error);
}

function itemsOf(opened: readonly Extract<Outcome, { is: 'read' }>[]): Item[] {
  return opened.flatMap(({ items }) => items);
}

function show(opened: readonly Extract<Outcome, { is: 'read' }>[], { mode, room }: Destination): void {
  const [{ name }] = opened;
  const more = opened.length - 1;
  openItems(ensureGroup(mode.id, room.settings), {
    name: more === 0 ? name : `${name} and ${more} more`,
    items: itemsOf(opened),
  });
}

/** Says what has become of the files, in one remark. */
function tell(outcomes: readonly Outcome[], into: Destination): void {
  const opened = outcomes.filter((each) => each.is === 'read');
  const elsewhere = outcomes.filter((each) => each.is === 'elsewhere');
  const foreign = outcomes.filter((each) => each.is === 'foreign');
  const sentences: string[] = [];
  if (opened.length > 0) {
    sentences.push(`Opened ${listed(quoted(opened), kMostNames)}: ${countOf(itemsOf(opened).length, ...into.room.nouns)}.`);
  }
  for (const warning of new Set(opened.flatMap(({ warnings }) => warnings))) sentences.push(ended(warning));
  for (const each of outcomes) {
    if (each.is === 'broken') sentences.push(`Could not open “${each.file.name}”: ${ended(each.reason)}`);
  }
  for (const alike of alikeIn(elsewhere)) {
    const [{ what, opener }] = alike;
    const names = listed(quoted(alike));
    const are = alike.length === 1 ? `${names} is ${what}` : `${names} are each ${what}`;
    sentences.push(`${are}: the mode ${opener.label} opens ${alike.length === 1 ? 'it' : 'them'}.`);
  }
  for (const alike of alikeIn(foreign)) {
    const [{ what }] = alike;
    const is = alike.length === 1 ? 'it is' : 'each is';
    sentences.push(`Could not open ${listed(quoted(alike))}: ${is} ${what ? `${what}, which no mode opens` : 'in no format that is known here'}.`);
  }
  if (foreign.length > 0) sentences.push(`${into.mode.label} opens ${listed(into.mode.files.map(({ what }) => what), undefined, 'or')}.`);
  const text = sentences.join(' ');
  if (opened.length === outcomes.length) say(text, 'file');
  else if (elsewhere.length === 0) complain(text, 'file');
  else {
    const { opener } = elsewhere[0];
    const files = elsewhere.filter((each) => each.opener === opener).map(({ file }) => file);
    complain(text, 'file', { label: `Open in ${opener.label}`, run: () => void openIn(opener, files, into) });
  }
}

async function openIn(mode: Mode, files: readonly File[], from: Destination): Promise<void> {
  const there = await from.go(mode.id);
  if (there) await openFiles(files, { ...from, ...there });
}

/** Those of the same format together. */
function alikeIn<T extends { readonly what: string | null }>(outcomes: readonly T[]): T[][] {
  const found = new Map<string | null, T[]>();
  for (const each of outcomes) found.set(each.what, [...(found.get(each.what) ?? []), each]);
  return [...found.values()];
}

const quoted = (outcomes: readonly Outcome[]): string[] => outcomes.map(({ file }) => `“${file.name}”`);

/** "a, b and c"; of more than `most`: "a, b and 2 more". */
export function listed(words: readonly string[], most = Infinity, last = 'and'): string {
  const parts = words.length > most ? [...words.slice(0, most - 1), `${words.length - most + 1} more`] : words;
  return parts.length < 2 ? parts.join('') : `${parts.slice(0, -1).join(', ')} ${last} ${parts[parts.length - 1]}`;
}

const ended = (sentence: string): string => (/[.!?]$/.test(sentence) ? sentence : `${sentence}.`);

/** The name of a document as a file name without its extension. */
export function fileStem(name: string): string {
  const stem = name.toLowerCase().replace(/[^a-z0-9]+/g, '-').replace(/^-|-$/g, '');
  return stem === '' ? 'soapfilm' : stem;
}

/** Downloads what `write` makes, once it can; says so if it cannot. */
export function save(fileName: string, type: string, write: () => string | Blob | Promise<string | Blob>): void {
  settle('export');
  // Within a promise, so that errors of all kinds arrive in one place.
  Promise.resolve().then(write).then(
    (data) => {
      download(fileName, data, type);
    },
    (error: unknown) => {
      complain(`Could not save “${fileName}”: ${ended(reasonOf(error, 'what writes files could not be loaded'))}`, 'export');
    },
  );
}

function download(fileName: string, data: string | Blob, type: string): void {
  const url = URL.createObjectURL(typeof data === 'string' ? new Blob([data], { type }) : data);
  const link = document.createElement('a');
  link.href = url;
  link.download = fileName;
  link.click();
  // Safari reads the address only after the click has been handled.
  setTimeout(() => {
    URL.revokeObjectURL(url);
  }, 10_000);
}

/** "1 curve", "3 curves". */
export function countOf(count: number, noun: string, plural = `${noun}s`): string {
  return `${count.toLocaleString('en')} ${count === 1 ? noun : plural}`;
}
