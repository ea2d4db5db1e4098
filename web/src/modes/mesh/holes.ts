// Finding the holes of the meshes, in the worker, and what has been decided about them.
import { computed, signal } from '@preact/signals';
import type { MeshSessionHandle } from 'soapfilm/worker';
import { isSame } from '../../state/document.ts';
import { choose, dispatch, hover, mode, selection, setIn } from '../../state/store.ts';
import { createWork } from '../../state/work.ts';
import { holesOf, join, split, type Hole } from './grouping.ts';
import { kMode, kNoChoices, meshGroup, type Choices, type MeshSettings } from './settings.ts';
import { countTwins, weld } from './weld.ts';
import { idsOf, loopAt, meshIn, noteRims, placeOf, shapeOf, wholeOf, type Found, type Whole } from './whole.ts';
import { explain } from './wording.ts';

const items = computed(() => meshGroup.value.items);

/** All meshes as one; null: there are none. Another object only where the meshes have changed. */
export const whole = computed(() => (items.value.length > 0 ? wholeOf(items.value) : null));

const latest = signal<Found | null>(null);

/** What was found in the meshes as they are. */
export const found = computed(() => (latest.value !== null && latest.value.of === whole.value ? latest.value : null));

export const finding = createWork<Whole, MeshSessionHandle>({
  mode: kMode,
  verb: 'Looking for holes',
  input: whole,
  part: 'meshes',
  begin: forget,
  async compute(film, of, { signal: ends }) {
    const session = await film.createMeshSession(meshIn(of), { signal: ends });
    if (ends.aborted) session.dispose();
    return session;
  },
  show: (session, of) => {
    forget();
    if (session === null || of === null) return;
    const { report } = session;
    noteRims(of, report);
    latest.value = { of, report, session };
  },
  explain,
});

/** A mesh that is gone stays open no longer. */
function forget(): void {
  latest.peek()?.session.dispose();
  latest.value = null;
}

/** How many vertices of rims lie where another one does: seams rather than holes. */
export const twins = computed(() => {
  const now = found.value;
  if (now === null) return 0;
  const { loops } = now.report;
  return countTwins(now.of, loops.flatMap(({ vertices }) => [...vertices]));
});

/** Makes one vertex of those at the same place. */
export function weldAll(): void {
  const { id, name, settings: present } = meshGroup.peek();
  const shared = items.peek().map((item) => ({ ...item, shape: weld(shapeOf(item)) }));
  // Loops have other numbers then.
  dispatch({ type: 'open', group: id, name, items: shared, settings: { ...present, of: [], ...kNoChoices } });
}

export const settings = computed(() => meshGroup.value.settings);

/** What has been decided about the meshes as they are. */
export const choices = computed<Choices>(() => (isSame(settings.value.of, idsOf(items.value)) ? settings.value : kNoChoices));

const groups = computed(() => choices.value.groups);

export const holes = computed<readonly Hole[]>(() => (found.value ? holesOf(found.value.report, groups.value) : []));

/** The number of the hole that each loop is of. */
const holeOfLoop = computed(() => new Map(holes.value.flatMap(({ loops }, h) => loops.map((loop) => [loop, h] as const))));

const wishes = computed(() => ({ filled: new Set(choices.value.filled), left: new Set(choices.value.left) }));

/** What is to become of a hole, by its outer rim. */
export function wishFor({ loops }: Hole): 'fill' | 'leave' | null {
  const { filled, left } = wishes.value;
  return filled.has(loops[0]) ? 'fill' : left.has(loops[0]) ? 'leave' : null;
}

/** The numbers of the holes with a loop that is chosen, in the order of choosing. */
export const chosenHoles = computed<readonly number[]>(() => {
  const of = whole.value;
  if (of === null || mode.value !== kMode) return [];
  const numbers = selection.value.flatMap((place) => holeOfLoop.value.get(loopAt(of, place) ?? -1) ?? []);
  return [...new Set(numbers)];
});

export const hoveredHole = computed<number | null>(() => {
  const [of, place] = [whole.value, hover.value];
  if (of === null || place === null || mode.value !== kMode) return null;
  return holeOfLoop.value.get(loopAt(of, place) ?? -1) ?? null;
});

const outerRim = (hole: number) => {
  const of = whole.peek();
  const loop = holes.peek().at(hole)?.loops[0];
  return of && loop !== undefined ? placeOf(of, loop) : null;
};

/** Chooses holes by their numbers. */
export function chooseHoles(...numbers: readonly number[]): void {
  choose(...numbers.map(outerRim));
}

export function hoverHole(hole: number | null): void {
  hover.value = hole === null ? null : outerRim(hole);
}

/** Changes settings; those of one `gesture` are one step until the change that is not `passing`. */
export function set(change: Partial<MeshSettings>, gesture?: string, passing = false): void {
  setIn(meshGroup.peek(), change, gesture, passing);
}

function decide(change: Partial<Choices>, rest: Partial<MeshSettings> = {}): void {
  const { filled, left, groups: said } = choices.peek();
  set({ of: idsOf(items.peek()), filled, left, groups: said, ...change, ...rest });
}

const plus = (list: readonly number[], more: readonly number[]): number[] => [...new Set([...list, ...more])];
const minus = (list: readonly number[], less: readonly number[]): number[] => {
  const gone = new Set(less);
  return list.filter((x) => !gone.has(x));
};

export function fill(of: readonly Hole[]): void {
  const loops = of.flatMap((hole) => hole.loops);
  const { filled, left } = choices.peek();
  decide({ filled: plus(filled, loops), left: minus(left, loops) });
}

export function leave(of: readonly Hole[]): void {
  const loops = of.flatMap((hole) => hole.loops);
  const { filled, left } = choices.peek();
  decide({ filled: minus(filled, loops), left: plus(left, loops) });
}

/** The holes that filling all is about. */
const isMeant = (hole: Hole, openRims: boolean): boolean => wishFor(hole) !== 'leave' && (openRims || !hole.isOpenRim);

/** Whether filling all would fill any more. */
export const isAnyLeft = computed(() => holes.value.some((hole) => isMeant(hole, settings.value.openRims) && wishFor(hole) !== 'fill'));

export const fillAll = (): void => { fill(holes.peek().filter((hole) => isMeant(hole, settings.peek().openRims))); };

/** All holes are as if nothing had been said about filling them. */
export const openAll = (): void => { decide({ filled: [], left: [] }); };

/** Open rims are filled, or no more, where all else has been filled. */
export function setOpenRims(openRims: boolean): void {
  const all = holes.peek();
  const isAllFilled = all.every((hole) => !isMeant(hole, false) || wishFor(hole) === 'fill');
  const loops = all.flatMap((hole) => (hole.isOpenRim && isMeant(hole, true) ? hole.loops : []));
  const { filled } = choices.peek();
  if (!openRims) decide({ filled: minus(filled, loops) }, { openRims });
  else if (isAllFilled && filled.length > 0) decide({ filled: plus(filled, loops) }, { openRims });
  else set({ openRims });
}

export function splitHole(hole: Hole): void {
  const [first] = hole.loops;
  decide({ groups: split(choices.peek().groups, hole) });
  chooseHoles(holeOfLoop.peek().get(first) ?? 0);
}

export function joinHoles(of: readonly Hole[]): void {
  const report = found.peek()?.report;
  if (!report || of.length < 2) return;
  const loops = of.flatMap((hole) => hole.loops);
  const { filled, left } = choices.peek();
  // Filled if any of them was.
  const isFilled = of.some((hole) => wishFor(hole) === 'fill');
  decide({
    groups: join(choices.peek().groups, of, report),
    filled: isFilled ? plus(filled, loops) : filled,
    left: minus(left, loops),
  });
  chooseHoles(holeOfLoop.peek().get(loops[0]) ?? 0);
}
