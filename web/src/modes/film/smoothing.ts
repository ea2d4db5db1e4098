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

/** The smoothed surface of what was spanned last; null where none is asked for, or it is not there yet. */
export const smoothed = computed(() => (film.value.settings.smooth === 'none' ? null : latest.value));

/** More would be slow to draw and tell nothing more. */
const kMostVertices = 20_000;

export const smoothing = createWork<{ readonly of: Surface; readonly kind: SmoothKind }, Smoothed>({
  mode: kMode,
  verb: 'Smoothing',
  part: 'meshes',
  input: computed(() => {
    const [of, kind] = [surface.value, film.value.settings.smooth];
    return of === null || isStale.value || kind === 'none' ? null : { of, kind };
  }),
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
