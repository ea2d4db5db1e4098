// Which mode the page is in: fetches rooms when they are first wanted, and follows the address and the history. The
// page stays where it is until a room is there.
import { batch, computed, signal } from '@preact/signals';
import type { Stage } from '../scene/stage.ts';
import { registerKind } from '../state/document.ts';
import { adoptGroup, setDraftAside } from '../state/drafts.ts';
import { complain, settle } from '../state/notice.ts';
import { choose, doc, ensureGroup, groupOf, hover, mode as shown, onStep, put, requestFrame } from '../state/store.ts';
import { openDialog } from './dialogs.tsx';
import type { Mode, Room } from './mode.ts';

export interface OpenedMode {
  readonly mode: Mode;
  readonly room: Room;
}

/** What is known of a mode besides the mode itself. */
interface Entry {
  opened: OpenedMode | null;
  /** Whether it has been shown; and whether there was nothing of it in the draft. */
  isBegun: boolean;
  isFresh: boolean;
  /** Objects of the draft that could not be read. */
  lost: number;
  /** How often it could not be fetched. */
  failures: number;
}

interface RoomsOptions {
  readonly modes: readonly Mode[];
  readonly stage: Stage;
  /** Called before the page goes to another mode. */
  readonly leave: () => void;
}

let options: RoomsOptions | null = null;
const entries = new Map<string, Entry>();

/** The mode that the page is in; null until the first is there. */
export const current = computed(() => entries.get(shown.value)?.opened ?? null);
/** The mode on its way, if any. */
export const awaited = signal<string | null>(null);

/** Opens the mode that the address asks for, and follows the address and the history from now on. */
export function startRooms(given: RoomsOptions): Promise<OpenedMode | null> {
  options = given;
  for (const { id } of given.modes) entries.set(id, { opened: null, isBegun: false, isFresh: false, lost: 0, failures: 0 });
  onStep((id) => {
    if (id !== shown.peek()) chooseMode(id);
  });
  window.addEventListener('hashchange', () => void goTo(idInAddress()));
  window.addEventListener('popstate', () => void goTo(idInAddress()));
  return goTo(idInAddress());
}

/** Goes to a mode; null where it could not be, in which case the page stays and says so, or another has been asked for. */
export async function goTo(id: string): Promise<OpenedMode | null> {
  const mode = modeBy(id);
  const entry = entries.get(mode.id);
  if (options === null || entry === undefined) return null;
  if (mode.id === shown.peek()) {
    awaited.value = null;
    setAddress(mode.id, false);
    return entry.opened;
  }
  awaited.value = mode.id;
  try {
    // At once where it is there already.
    if (entry.opened === null) {
      const { openRoom } = await mode.fetch();
      if (awaited.peek() !== mode.id) return null;
      entry.opened ??= enroll(mode, entry, openRoom, options.stage);
    }
  } catch (error) {
    console.warn(error);
    if (awaited.peek() !== mode.id) return null;
    awaited.value = null;
    // A page without any mode is of no use: the first one, if not this, in its place.
    if (shown.peek() === '' && mode !== options.modes[0]) await goTo(options.modes[0].id);
    else setAddress(shown.peek(), false);
    explain(mode, entry);
    return null;
  }
  show(entry.opened, entry, options);
  return entry.opened;
}

/** Goes to a mode because the user has asked for it: a step in the browser's own history. */
export function chooseMode(id: string): void {
  settle('mode');
  if (id !== shown.peek()) setAddress(id, true);
  void goTo(id);
}

/** The mode that the page is in, once there is one. */
export function firstMode(): Promise<OpenedMode> {
  return new Promise((resolve) => {
    const stop = current.subscribe((now) => {
      if (now === null) return;
      resolve(now);
      queueMicrotask(() => { stop(); });
    });
  });
}

function show({ mode, room }: OpenedMode, entry: Entry, { stage, leave }: RoomsOptions): void {
  leave();
  entry.failures = 0;
  batch(() => {
    awaited.value = null;
    openDialog.value = null;
    // What was said about the mode that is left.
    settle('stroke', 'plane', 'file', 'export', 'mode');
    choose();
    hover.value = null;
    shown.value = mode.id;
  });
  stage.show(mode.id);
  setAddress(mode.id, false);
  if (entry.isBegun) return;
  entry.isBegun = true;
  if (entry.isFresh) room.begin();
  else requestFrame(undefined, true);
  if (entry.lost > 0) {
    complain(`${entry.lost} of the draft’s ${room.nouns[1]} could not be read. They are left out, and the draft is kept.`, 'draft');
  }
}

/** Makes the room, and brings it together with what the document has of its mode. */
function enroll(mode: Mode, entry: Entry, openRoom: (stage: Stage) => Room, stage: Stage): OpenedMode {
  const room = openRoom(stage);
  room.kinds.forEach(registerKind);
  const saved = doc.peek().groups.find((group) => group.mode === mode.id);
  entry.isFresh = saved === undefined;
  if (saved) {
    const { group, lost } = adoptGroup(saved, room.kinds, room.settings);
    const isSound = room.areSettings?.(group.settings) ?? true;
    entry.lost = lost;
    // The draft as it is stays in the browser, for a version of the page that can read all of it.
    if (lost > 0) void setDraftAside();
    put(isSound ? group : { ...group, settings: room.settings });
  }
  ensureGroup(mode.id, room.settings);
  const scene = stage.addScene({
    mode: mode.id,
    dimension: room.dimension,
    group: groupOf(mode.id, room.settings),
    kinds: room.kinds,
    hasPen: room.pen !== undefined,
    failures: room.failures,
  });
  room.draw?.(scene);
  return { mode, room };
}

function explain(mode: Mode, entry: Entry): void {
  entry.failures++;
  const again = { label: 'Try again', run: () => { chooseMode(mode.id); } };
  // Some browsers remember that a script could not be fetched, as long as the page lives.
  const reload = { label: 'Reload the page', run: () => { location.reload(); } };
  const isStuck = entry.failures > 2 && navigator.onLine;
  const text = navigator.onLine ? 'could not be opened.' : 'could not be fetched: there is no connection.';
  complain(`${mode.label} ${text}${isStuck ? ' Your drawing is kept.' : ''}`, 'mode', isStuck ? reload : again);
}

function modeBy(id: string): Mode {
  const { modes } = options ?? { modes: [] };
  return modes.find((each) => each.id === id) ?? modes[0];
}

const idInAddress = (): string => modeBy(location.hash.slice(1)).id;

/** @param isStep whether the browser's button goes back to what was before */
function setAddress(id: string, isStep: boolean): void {
  const hash = id === '' || id === options?.modes[0].id ? '' : `#${id}`;
  if (location.hash === hash) return;
  const address = `${location.pathname}${location.search}${hash}`;
  if (isStep) history.pushState(null, '', address);
  else history.replaceState(null, '', address);
}
