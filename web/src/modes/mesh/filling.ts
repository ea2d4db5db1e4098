// Filling the holes that are to be filled, in the worker. Patches are kept: only those that are missing, or were made in
// another way, are computed.
import { computed, signal } from '@preact/signals';
import type { HoleFillOptions } from 'soapfilm';
import { createWork } from '../../state/work.ts';
import { found, holes, settings, wishFor } from './holes.ts';
import type { Hole } from './grouping.ts';
import { currentAmong, dueAmong, keyOf, patchesIn, type Patch, type Patches } from './patches.ts';
import { kMode, type MeshSettings, type Smoothness } from './settings.ts';
import type { Found } from './whole.ts';
import { explain } from './wording.ts';

interface Job extends Found {
  readonly holes: readonly Hole[];
  readonly manner: string;
  readonly options: HoleFillOptions;
}

const kFairness: Record<Smoothness, NonNullable<HoleFillOptions['fairness']>> = { none: 0, direction: 1, curvature: 2, auto: 'auto' };

const optionsOf = ({ smoothness, density, candidates, creases, creaseAngle }: MeshSettings): HoleFillOptions => ({
  fairness: kFairness[smoothness],
  density,
  candidates,
  creases: creases && creaseAngle,
});
/** The same for settings that make the same patches. */
const mannerOf = (of: MeshSettings): string => JSON.stringify(optionsOf(of));

const kept = signal<Patches>(new Map());

const wanted = computed(() => holes.value.filter((hole) => wishFor(hole) === 'fill'));

/** Changes exactly where there is something else to do. */
const jobKey = computed(() => [mannerOf(settings.value), ...wanted.value.map(keyOf)].join('\n'));

const job = computed<Job | null>(() => {
  const now = found.value;
  if (now === null || jobKey.value.indexOf('\n') < 0) return null;
  return { ...now, holes: wanted.peek(), manner: mannerOf(settings.peek()), options: optionsOf(settings.peek()) };
});

/** The patch of a hole, if it is to have one and has: perhaps one that was made in another way. */
export function patchOf(hole: Hole): Patch | null {
  const patch = wishFor(hole) === 'fill' ? kept.value.get(keyOf(hole)) : undefined;
  return patch && patch.of === found.value?.of ? patch : null;
}

/** Those of all holes, in their order. */
export const patches = computed<readonly Patch[]>(() => wanted.value.flatMap((hole) => patchOf(hole) ?? []));

/** Whether every hole that is to be filled has what the settings ask for. */
export const isSettled = computed(() => {
  const now = found.value;
  return now !== null && wanted.value.every(currentAmong(wanted.value, kept.value, { of: now.of, manner: mannerOf(settings.value) }));
});

export const filling = createWork<Job, Patches>({
  mode: kMode,
  verb: 'Filling',
  input: job,
  part: 'meshes',
  async compute(_, of, watch) {
    const todo = dueAmong(of.holes, kept.peek(), of, of.report);
    if (todo.length === 0) return new Map();
    const result = await of.session.fillHoles({
      ...of.options,
      groups: todo.map(({ loops }) => loops),
      // By name, so that open rims are filled too.
      holes: todo.map((_, i) => i),
      output: 'patches',
      signal: watch.signal,
      onProgress: (fraction) => { watch.progress(fraction); },
    });
    return patchesIn(result, todo, of);
  },
  show: (made, of) => {
    if (made === null || of === null) return;
    const others = [...kept.peek()].filter(([, patch]) => patch.of === of.of);
    kept.value = new Map([...others, ...made]);
  },
  explain,
});
