// The surface smoothed between its curves, where the settings ask for it: a soap film, or a plate.
import { computed, signal } from '@preact/signals';
import type { SmoothSurface } from 'soapfilm';
import { createWork, plainFailure } from '../../state/work.ts';
import { film, kMode } from './film.ts';
import type { SmoothKind } from './settings.ts';
import { isStale, surface, type Surface } from './spanning.ts';

/** A smoothed surface, and the one that it comes from. */
export interface Smoothed {
  readonly surface: SmoothSurface;
  readonly of: Surface;
  readonly kind: SmoothKind;
  readonly seconds: number;
}

const latest = signal<Smoothed | null>(null);

/** More would be slow to draw and tell nothing more. */
const kMostVertices = 20_000;

const input = computed(() => {
  const [of, kind] = [surface.value, film.value.settings.smooth];
  return of === null || isStale.value || kind === 'none' ? null : { of, kind };
});

export const smoothing = createWork<{ readonly of: Surface; readonly kind: SmoothKind }, Smoothed>({
  mode: kMode,
  verb: 'Smoothing',
  part: 'meshes',
  input,
  async compute(library, { of, kind }, { signal: ends }) {
    const since = performance.now();
    const { positions, triangles } = of.span;
    const found = await library.smoothSurface({ positions, triangles }, { kind, maxNewVertices: kMostVertices, signal: ends });
    return { surface: found, of, kind, seconds: (performance.now() - since) / 1000 };
  },
  show: (found) => {
    // While the next one is on its way the last one stands in for it.
    if (found !== null || surface.peek() === null || film.peek().settings.smooth === 'none') latest.value = found;
  },
  explain: plainFailure,
});

/** Whether a smoothed surface is what the settings ask for, of what was spanned last. */
const isWanted = ({ of, kind }: Smoothed): boolean => of === surface.value && kind === film.value.settings.smooth;

/** Whether one is asked for that is still to come. */
export const isSmoothing = computed(
  () => input.value !== null && !isOver() && !(latest.value !== null && isWanted(latest.value)),
);

const isOver = (): boolean => ['failed', 'cancelled'].includes(smoothing.state.value.phase);

/** The smoothed surface: another one only while what is asked for is still to come. Null where there is none. */
export const smoothed = computed(() => {
  if (latest.value === null || film.value.settings.smooth === 'none') return null;
  return isSmoothing.value || isWanted(latest.value) ? latest.value : null;
});
