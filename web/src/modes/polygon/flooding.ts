// Flooding, to look at: the steps in which flooding makes the triangles, taken one after the other.
import { computed, effect, signal, type ReadonlySignal } from '@preact/signals';
import { SoapfilmError, type FloodStep } from 'soapfilm';
import type { Film } from 'soapfilm/worker';
import type { Lines } from '../../shapes/lines.ts';
import { complain, say } from '../../state/notice.ts';
import { createWork, plainFailure } from '../../state/work.ts';
import { flatten, kMode, polygonGroup, type PolygonGroup } from './polygons.ts';
import { isOfPolygon } from './wording.ts';

/** All steps, polygon after polygon, and the triangles that they make in their order. */
export interface Flood {
  readonly positions: Float64Array;
  readonly triangles: Uint32Array;
  readonly steps: readonly FloodStep[];
}

/** A flood on its way, and how many of its steps have been taken. */
export interface Flooding {
  readonly flood: Flood;
  readonly taken: number;
}

/** In how many pictures a flood is shown. */
const kFrames = 300;

/** What is to be flooded. */
const wanted = signal<PolygonGroup | null>(null);
const flooded = signal<Flooding | null>(null);

export const flooding: ReadonlySignal<Flooding | null> = flooded;
export const isFlooding = computed(() => wanted.value !== null);

const work = createWork<PolygonGroup, Flood>({
  mode: kMode,
  verb: 'Flooding',
  // Once the polygons have changed there is nothing more to show.
  input: computed(() => (wanted.value === polygonGroup.value ? wanted.value : null)),
  auto: signal(false),
  part: 'polygons',
  compute: (film, of, { signal: ended }) => floodAll(film, of, ended),
  show: (flood) => {
    flooded.value = flood && flood.steps.length > 0 ? { flood, taken: 0 } : null;
    if (flood?.steps.length === 0) say('There is nothing to flood: only polygons that need no repair are.', 'other');
    if (flooded.peek() === null) wanted.value = null;
  },
  explain: (error) => {
    const failure = plainFailure(error);
    complain(failure.message, 'other');
    return failure;
  },
});
effect(() => {
  if (work.state.value.phase === 'cancelled') wanted.value = null;
});
let nextFrame = 0;
effect(() => {
  if (flooded.value) nextFrame ||= requestAnimationFrame(goOn);
});

/** Floods all polygons that are valid, step by step from now on. */
export function beginFlooding(): void {
  wanted.value = polygonGroup.peek();
  work.start();
}

/** Shows everything for good; says whether there was a flood. */
export function endFlooding(): boolean {
  if (wanted.peek() === null) return false;
  wanted.value = null;
  return true;
}

/** Takes the next steps; after the last everything is shown for good. */
function goOn(): void {
  nextFrame = 0;
  const now = flooded.peek();
  if (now === null) return;
  const { length } = now.flood.steps;
  const taken = now.taken + Math.ceil(length / kFrames);
  if (taken >= length) endFlooding();
  else flooded.value = { ...now, taken };
}

async function floodAll(film: Film, { items }: PolygonGroup, signal: AbortSignal): Promise<Flood> {
  const floods = await Promise.all(
    items.map(async ({ shape }) => {
      const { positions, starts } = shape as Lines;
      try {
        return await film.triangulatePolygon({ positions, starts }, { trace: true, signal });
      } catch (error) {
        if (error instanceof SoapfilmError && isOfPolygon(error)) return null;
        throw error;
      }
    }),
  );
  const { positions, ringStarts, polygonStarts } = flatten(items);
  const triangles = new Uint32Array(floods.reduce((sum, flood) => sum + (flood?.triangles.length ?? 0), 0));
  const steps: FloodStep[] = [];
  let filled = 0;
  floods.forEach((flood, polygon) => {
    if (flood === null) return;
    const first = ringStarts[polygonStarts[polygon]];
    const before = filled / 3;
    for (const { action, left, right, triangles: made } of flood.trace) {
      steps.push({ action, left: first + left, right: first + right, triangles: before + made });
    }
    for (const v of flood.triangles) triangles[filled++] = first + v;
  });
  return { positions, triangles, steps };
}
