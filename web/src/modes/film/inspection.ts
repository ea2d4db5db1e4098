// `window.__soapfilm`: the film's state, read-only, for its own tests and for a look from the console.
import { computed } from '@preact/signals';
import { inWindow, valuesOf, type Inspection } from '../../inspection.ts';
import type { Viewpoint } from '../../scene/viewpoint.ts';
import { pointAt, type Lines } from '../../shapes/lines.ts';
import { notice } from '../../state/notice.ts';
import { canRedo, canUndo, chosen, mode, selection, tool } from '../../state/store.ts';
import { film } from './film.ts';
import { isGrowing } from './film_scene.ts';
import { curvesOf, listOf } from './settings.ts';
import { isStale, none, spanning, surface } from './spanning.ts';

export function exposeFilm(viewpoint: Viewpoint, canvas: HTMLCanvasElement): void {
  const document = computed(() => ({ name: film.value.name, settings: film.value.settings, curves: curvesOf(film.value).map(listOf) }));
  const solve = computed(() => {
    const state = spanning.state.value;
    return state.phase === 'done' && none.value ? { phase: 'none' as const, ...none.value } : state;
  });
  const selected = computed(() => {
    const at = chosen.value;
    const curve = film.value.items.findIndex(({ id }) => id === at?.item);
    return at === null || curve < 0 ? null : { curve, vertex: at.handle };
  });
  const whereIs: Inspection['whereIs'] = (curve, vertex) => {
    const { x, y } = viewpoint.project(pointAt(film.peek().items[curve].shape as Lines, vertex));
    return inWindow(canvas, x, y);
  };
  const signals = { document, solve, surface, isStale, isGrowing, selection: selected, places: selection, mode, tool, notice, canUndo, canRedo };
  window.__soapfilm = Object.assign(valuesOf(signals), { whereIs });
}
