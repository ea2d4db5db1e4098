// Which mode the page is in: fetches rooms when they are first wanted, and follows the address and the history. The
// page stays where it is until a room is there.
import { batch, computed, signal } from '@preact/signals';
import type { Stage } from '../scene/stage.ts';
import { registerKind } from '../state/document.ts';
import { adoptGroup } from '../state/drafts.ts';
import { complain, dismissNotice, settle } from '../state/notice.ts';
import { choose, doc, ensureGroup, groupOf, hover, mode as shown, put, requestFrame, shownByStep } from '../state/store.ts';
import type { Mode, Room } from './mode.ts';

export interface OpenedMode {
  readonly mode: Mode;
  readonly room: Room;
}

let modes: readonly Mode[] = [];
let stage: Stage | null = null;
const opened = new Map<string, OpenedMode>();

/** The mode that the page is in; null until the first is there. */
export const current = computed(() => opened.get(shown.value) ?? null);
/** The mode on its way, if any. */
export const awaited = signal<string | null>(null);

/** How often fetching each mode has failed. */
const failures = new Map<string, number>();

export const allModes = (): readonly Mode[] => modes;

/** Opens the mode that the address asks for, and follows the address and the history from now on. */
export function startRooms(all: readonly Mode[], theStage: Stage): Promise<OpenedMode | null> {
  modes = all;
  stage = theStage;
  shownByStep.value = (id) => void goTo(id);
  window.addEventListener('hashchange', () => void goTo(idInAddress()));
  return goTo(idInAddress());
}

/** Goes to a mode; null where it could not be fetched, in which case the page stays and says so. */
export async function goTo(id: string): Promise<OpenedMode | null> {
  const mode = modes.find((each) => each.id === id) ?? modes[0];
  if (mode.id === shown.peek()) {
    awaited.value = null;
    setAddress(mode.id);
    return current.peek();
  }
  awaited.value = mode.id;
  let found = opened.get(mode.id) ?? null;
  if (found === null) {
    let fetched: Awaited<ReturnType<Mode['fetch']>>;
    try {
      fetched = await mode.fetch();
    } catch (error) {
      console.warn(error);
      if (awaited.peek() !== mode.id) return null;
      awaited.value = null;
      setAddress(shown.peek());
      explain(mode);
      return null;
    }
    found = opened.get(mode.id) ?? enroll(mode, fetched.openRoom);
    // Another may have been asked for meanwhile.
    if (awaited.peek() !== mode.id) return found;
  }
  failures.delete(mode.id);
  const { room } = found;
  batch(() => {
    awaited.value = null;
    // What a remark says is about the mode that is left; a step that was undone elsewhere keeps its own.
    dismissNotice();
    choose();
    hover.value = null;
    shown.value = mode.id;
  });
  stage?.show(mode.id);
  setAddress(mode.id);
  if (!begun.has(mode.id)) {
    begun.add(mode.id);
    if (fresh.has(mode.id)) room.begin();
    else requestFrame(undefined, true);
  }
  return found;
}

/** Modes that have been shown, and those whose group was not in the draft. */
const begun = new Set<string>();
const fresh = new Set<string>();

function enroll(mode: Mode, openRoom: (stage: Stage) => Room): OpenedMode {
  if (stage === null) throw new Error('There is no stage.');
  const room = openRoom(stage);
  room.kinds.forEach(registerKind);
  const saved = doc.peek().groups.find((group) => group.mode === mode.id);
  if (saved === undefined) fresh.add(mode.id);
  else {
    const { group, lost } = adoptGroup({ ...saved, settings: { ...room.settings, ...saved.settings } }, room.kinds);
    put(group);
    if (lost > 0) complain(`${lost} objects of the draft could not be read and were left out.`, 'draft');
  }
  ensureGroup(mode.id, room.settings);
  const group = groupOf(mode.id, room.settings);
  const scene = stage.addScene({ mode: mode.id, dimension: room.dimension, group, kinds: room.kinds, failures: room.failures });
  room.draw?.(scene);
  const made = { mode, room };
  opened.set(mode.id, made);
  return made;
}

function explain(mode: Mode): void {
  const count = (failures.get(mode.id) ?? 0) + 1;
  failures.set(mode.id, count);
  const again = { label: 'Try again', run: () => void goTo(mode.id) };
  // Some browsers remember that a script could not be fetched, as long as the page lives.
  const reload = { label: 'Reload the page', run: () => { location.reload(); } };
  const isStuck = count > 2 && navigator.onLine;
  const text = navigator.onLine ? 'could not be fetched.' : 'could not be fetched: there is no connection.';
  complain(`${mode.label} ${text}${isStuck ? ' Your drawing is kept.' : ''}`, 'mode', isStuck ? reload : again);
}

const idInAddress = (): string => location.hash.slice(1) || modes[0].id;

function setAddress(id: string): void {
  if (id === '' || idInAddress() === id) return;
  const { pathname, search } = location;
  // A step back in the browser's history is a step between modes.
  history.pushState(null, '', `${pathname}${search}${id === modes[0].id ? '' : `#${id}`}`);
}

/** Goes to a mode because a button asks for it. */
export function chooseMode(id: string): void {
  settle('mode');
  void goTo(id);
}
